//! What a template asks for: the stubs that are found in it are filled in, and nothing else is compiled.

use naga::{Function, GlobalVariable, Handle};

use super::column::Column;
use super::reciprocal::reciprocal;
use super::substitute::substitute;
use crate::derive::{ComplexVariable, forward, gradient, jet};
use crate::formula::Formula;
use crate::integrate::{Otherwise, field_integral, of_integrals};
use crate::ir::{Graph, Id, Ty, has_branches};
use crate::link::{Linker, Provider};
use crate::lower::{Argument, Interface, Leaves, LowerError, NagaTypes, Output, Precision, lower};
use crate::stable::finish;

/// Names of the stubs that are filled from a formula.
pub const DEMANDS: [&str; 11] = [
    "field",
    "field_colour",
    "field_grad",
    "field_jet2",
    "field_ray",
    "field_integral",
    "field_column",
    "map",
    "map_jet",
    "chart_jet",
    "chart_jet_inverse",
];

/// Fills the stubs of a scene from one formula.
#[derive(Debug)]
pub struct Demand<'f> {
    /// What is shown.
    pub formula: &'f Formula,
    /// The function that gives the colours, if there is one.
    pub colour: Option<&'f Formula>,
    /// The column of the scene's medium, where that is taken in closed form.
    pub column: Option<Column>,
    /// Which forms of functions are called.
    pub precision: Precision,
}

/// Roots in a graph, and how they make up the result of a stub.
pub(super) struct Answer {
    pub(super) graph: Graph,
    pub(super) roots: Vec<Id>,
    pub(super) inputs: Vec<Argument>,
    pub(super) output: Output,
}

impl Provider for Demand<'_> {
    fn provide(
        &mut self,
        name: &str,
        stub: &Function,
        linker: &mut Linker,
    ) -> Result<Option<Function>, LowerError> {
        let types = NagaTypes::insert(&mut linker.out.types);
        let answer = match name {
            "field" => self.value(),
            "field_grad" => self.gradient(stub)?,
            "field_colour" => self.colours(stub)?,
            "field_jet2" => self.second_jet(stub)?,
            "field_ray" => self.ray(types)?,
            "field_integral" => self.integral()?,
            "field_column" => self.column(stub)?,
            "map" => self.map(),
            "map_jet" => {
                let (graph, roots) = self.graph();
                self.jet(graph, &roots, self.point_inputs(), stub, types)?
            }
            "chart_jet" => {
                let (graph, roots) = self.graph();
                self.jet(graph, &roots, self.chart_inputs(), stub, types)?
            }
            "chart_jet_inverse" => {
                let formula = self.formula.stabilised();
                let (graph, roots) = reciprocal(&formula.graph, &formula.value, &formula.scalars());
                self.jet(graph, &roots, vec![Argument::Whole(0)], stub, types)?
            }
            _ => return Ok(None),
        };
        let interface = Interface {
            declaration: stub.clone(),
            inputs: answer.inputs,
            leaves: uniforms(linker, "view", self.precision)?,
            output: answer.output,
            precision: self.precision,
            wide: false,
        };
        let rewrites = match name {
            "field_integral" => of_integrals(self.formula.rewrites),
            _ => self.formula.rewrites,
        };
        let (graph, roots) = finish(answer.graph, answer.roots, rewrites);
        lower(&graph, &roots, interface, linker).map(Some)
    }
}

/// The uniforms that parameters and the clock are read from.
pub fn uniforms(
    linker: &mut Linker,
    clock: &str,
    precision: Precision,
) -> Result<Leaves, LowerError> {
    if precision.format().is_wide() {
        return Ok(Leaves::Words(linker.global("wide")?));
    }
    let params: Handle<GlobalVariable> = linker.global("params")?;
    let clock = linker.global(clock)?;
    Ok(Leaves::Uniforms { params, clock })
}

impl Demand<'_> {
    fn graph(&self) -> (Graph, Vec<Id>) {
        let formula = self.formula.stabilised();
        formula.graph.compacted(&formula.value)
    }

    /// The stub's one argument is a point of space, or of the plane as seen from the view's centre: a complex input is
    /// all of it, real inputs are its components.
    fn point_inputs(&self) -> Vec<Argument> {
        let scalars = self.formula.scalars();
        if scalars == [Ty::Complex] {
            return vec![Argument::OffsetPoint(0)];
        }
        let place = |k: usize| {
            let k = u32::try_from(k).unwrap_or(0);
            if self.dimension() == 3 {
                Argument::Component(0, k)
            } else {
                Argument::Offset(0, k)
            }
        };
        (0..scalars.len()).map(place).collect()
    }

    fn leaves(&self, graph: &mut Graph) -> Vec<Id> {
        let scalars = self.formula.scalars();
        scalars
            .iter()
            .enumerate()
            .map(|(k, &ty)| Formula::leaf(graph, k, ty))
            .collect()
    }

    fn value(&self) -> Answer {
        let (graph, roots) = self.graph();
        Answer {
            graph,
            roots,
            inputs: self.point_inputs(),
            output: Output::Node(0),
        }
    }

    /// Of the function that gives colours: a real number three times and 1, a vector and 2; zeros where there is none.
    fn colours(&self, stub: &Function) -> Result<Answer, LowerError> {
        let result = stub
            .result
            .as_ref()
            .ok_or(LowerError::NoForm("colours"))?
            .ty;
        let Some(colour) = self.colour else {
            let output = Output::Zero(result);
            return Ok(Answer {
                graph: Graph::new(),
                roots: Vec::new(),
                inputs: Vec::new(),
                output,
            });
        };
        let own = Self {
            formula: colour,
            ..*self
        };
        let (mut graph, mut roots) = own.graph();
        let parts = match roots.as_slice() {
            [_] => [0, 0, 0, 1],
            _ => [0, 1, 2, 3],
        };
        let kind = graph.real(if roots.len() == 1 { 1.0 } else { 2.0 });
        roots.push(kind);
        Ok(Answer {
            graph,
            roots,
            inputs: own.point_inputs(),
            output: Output::Compose(result, parts.map(Output::Node).to_vec()),
        })
    }

    /// All partial derivatives and the value; partials by coordinates that the formula does not take are zero.
    fn gradient(&self, stub: &Function) -> Result<Answer, LowerError> {
        let (mut graph, roots) = self.graph();
        let leaves = self.leaves(&mut graph);
        let result = stub
            .result
            .as_ref()
            .ok_or(LowerError::NoForm("a gradient"))?
            .ty;
        let derived = gradient(&mut graph, roots[0], &leaves).map_err(LowerError::NoDerivative)?;
        let zero = graph.real(0.0);
        let mut roots = vec![derived.value, zero];
        let mut parts: Vec<Output> = Vec::new();
        for partial in derived.partials {
            parts.push(Output::Node(roots.len()));
            roots.push(partial);
        }
        let dimension = if stub.arguments.is_empty() {
            0
        } else {
            self.dimension()
        };
        while parts.len() < dimension {
            parts.push(Output::Node(1));
        }
        parts.push(Output::Node(0));
        let output = Output::Compose(result, parts);
        Ok(Answer {
            graph,
            roots,
            inputs: self.point_inputs(),
            output,
        })
    }

    /// Value, first and second derivatives of a real function of the plane, in the order of `Jet2`: f, ∂f/∂x, ∂f/∂y,
    /// ∂²f/∂x², ∂²f/∂x∂y, ∂²f/∂y², and whether they may jump. Derivatives by coordinates that the formula does not take are
    /// zero.
    fn second_jet(&self, stub: &Function) -> Result<Answer, LowerError> {
        let (mut graph, roots) = self.graph();
        let leaves = self.leaves(&mut graph);
        let result = stub.result.as_ref().ok_or(LowerError::NoForm("a jet"))?.ty;
        let derived = gradient(&mut graph, roots[0], &leaves).map_err(LowerError::NoDerivative)?;
        let (zero, one) = (graph.real(0.0), graph.real(1.0));
        let jumps = graph.truth(has_branches(&graph, &[derived.value]));
        let mut roots = vec![derived.value, zero, zero, zero, zero, zero];
        for (k, &partial) in derived.partials.iter().enumerate().take(2) {
            roots[1 + k] = partial;
            for (j, &leaf) in leaves.iter().enumerate().skip(k).take(2 - k) {
                let second = forward(&mut graph, &[partial], &[(leaf, one)])
                    .map_err(LowerError::NoDerivative)?;
                roots[3 + k + j] = second[0].unwrap_or(zero);
            }
        }
        roots.push(jumps);
        let parts = (0..roots.len()).map(Output::Node).collect();
        Ok(Answer {
            graph,
            roots,
            inputs: self.point_inputs(),
            output: Output::Compose(result, parts),
        })
    }

    /// Dimension of the space that real formulas live in.
    fn dimension(&self) -> usize {
        if self.formula.scalars().len() == 3 {
            3
        } else {
            2
        }
    }

    /// Value and derivative along the ray o + t d: one tangent, not three.
    fn ray(&self, types: NagaTypes) -> Result<Answer, LowerError> {
        let mut graph = Graph::new();
        let inputs: Vec<Argument> = (0..2)
            .flat_map(|a| (0..3).map(move |k| Argument::Component(a, k)))
            .chain([Argument::Whole(2)])
            .collect();
        let t = Formula::leaf(&mut graph, 6, Ty::Real);
        let formula = self.formula.stabilised();
        let roots = substitute(&formula.graph, &formula.value, &mut graph, |g, k| {
            let k = usize::from(k);
            let (o, d) = (
                Formula::leaf(g, k, Ty::Real),
                Formula::leaf(g, k + 3, Ty::Real),
            );
            let step = g.mul(t, d);
            g.add(o, step)
        });
        let one = graph.real(1.0);
        let slope = forward(&mut graph, &roots, &[(t, one)]).map_err(LowerError::NoDerivative)?[0];
        let slope = slope.unwrap_or_else(|| graph.real(0.0));
        let output = Output::Compose(types.vec2, vec![Output::Node(0), Output::Node(1)]);
        Ok(Answer {
            graph,
            roots: vec![roots[0], slope],
            inputs,
            output,
        })
    }

    /// The integral along the ray o + t d from t = a to t = b, in closed form; by quadrature what has none.
    fn integral(&self) -> Result<Answer, LowerError> {
        let made =
            field_integral(self.formula, Otherwise::Quadrature).map_err(LowerError::NoIntegral)?;
        let inputs = (0..2)
            .flat_map(|a| (0..3).map(move |k| Argument::Component(a, k)))
            .chain([Argument::Whole(2), Argument::Whole(3)])
            .collect();
        Ok(Answer {
            roots: vec![made.integral.value],
            graph: made.graph,
            inputs,
            output: Output::Node(0),
        })
    }

    fn map(&self) -> Answer {
        let (mut graph, roots) = self.graph();
        let root = graph.widen(roots[0]);
        Answer {
            graph,
            roots: vec![root],
            inputs: self.point_inputs(),
            output: Output::Node(0),
        }
    }

    /// The stub's one argument is a complex number of the world as it is: a complex input is all of it, real inputs are
    /// its parts.
    fn chart_inputs(&self) -> Vec<Argument> {
        match self.formula.scalars().as_slice() {
            [Ty::Complex] => vec![Argument::Whole(0)],
            _ => vec![Argument::Component(0, 0), Argument::Component(0, 1)],
        }
    }

    /// Value and both Wirtinger derivatives by the complex variable that `inputs` are: one complex input, or its parts; and
    /// the power of two that all are by.
    fn jet(
        &self,
        mut graph: Graph,
        roots: &[Id],
        inputs: Vec<Argument>,
        stub: &Function,
        types: NagaTypes,
    ) -> Result<Answer, LowerError> {
        let variable = match (inputs.as_slice(), self.formula.scalars().as_slice()) {
            ([_, _], [x, y]) => ComplexVariable::Parts(
                Formula::leaf(&mut graph, 0, *x),
                Formula::leaf(&mut graph, 1, *y),
            ),
            _ => ComplexVariable::Whole(Formula::leaf(&mut graph, 0, Ty::Complex)),
        };
        let result = stub.result.as_ref().ok_or(LowerError::NoForm("a jet"))?.ty;
        let jet = jet(&mut graph, roots[0], variable).map_err(LowerError::NoDerivative)?;
        let mut roots = vec![jet.value, jet.dz];
        roots.extend(jet.dzbar);
        let all = [0, 1, roots.len() - 1];
        let dzbar = match jet.dzbar {
            Some(_) => Output::Scaled(2, all),
            None => Output::Zero(types.vec2),
        };
        let [value, dz] = [0, 1].map(|k| Output::Scaled(k, all));
        let output = Output::Compose(result, vec![value, dz, dzbar, Output::Exponent(all)]);
        Ok(Answer {
            graph,
            roots,
            inputs,
            output,
        })
    }
}
