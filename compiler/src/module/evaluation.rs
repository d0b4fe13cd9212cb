//! What can be asked of a formula at a point: its value, its gradient, its derivative.

use super::ModuleError;
use crate::derive::{ComplexVariable, forward, gradient, jet};
use crate::formula::{Formula, column_names};
use crate::ir::{Graph, Id, Ty};
use crate::lower::{LowerError, Output};
use crate::stable::finish;
use crate::types::Type;

/// What is computed at a point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum What {
    /// The value.
    #[default]
    Value,
    /// The value, and its partial derivatives by every real input.
    Gradient,
    /// The value, and f′; for a function of a complex variable that is not holomorphic, ∂f/∂z and ∂f/∂z̄.
    Derivative,
    /// The value, its partial derivatives by every real input, and its second derivatives: those by two inputs once,
    /// as they do not depend on the order.
    Hessian,
}

/// Results of a formula at a point, as IR.
#[derive(Clone, Debug)]
pub struct Evaluation {
    /// The IR.
    pub graph: Graph,
    /// What is computed: the value's nodes first.
    pub roots: Vec<Id>,
    /// The real columns of the results, each a part of a root.
    pub columns: Vec<Output>,
    /// Names of the columns.
    pub names: Vec<String>,
}

/// Derives what is asked of a formula.
///
/// # Errors
/// It makes no sense for the formula's types, or an operation has no derivative rule.
pub fn evaluation(formula: &Formula, what: What) -> Result<Evaluation, ModuleError> {
    let (graph, roots) = formula.graph.compacted(&formula.value);
    let mut out = Evaluation {
        graph,
        roots: Vec::new(),
        columns: Vec::new(),
        names: Vec::new(),
    };
    let value_names = column_names(&formula.name, formula.ty);
    for &root in &roots {
        out.push(root);
    }
    out.names = value_names.clone();
    match what {
        What::Value => {}
        What::Gradient => {
            out.gradient(formula, &roots, &value_names)?;
        }
        What::Hessian => out.hessian(formula, &roots, &value_names)?,
        What::Derivative => out.derivative(formula, &roots)?,
    }
    Ok(out)
}

/// [`evaluation`] with the formula's stability rewrites: what is compiled for the GPU.
///
/// # Errors
/// As [`evaluation`].
pub fn stable_evaluation(formula: &Formula, what: What) -> Result<Evaluation, ModuleError> {
    let mut out = evaluation(&formula.stabilised(), what)?;
    (out.graph, out.roots) = finish(out.graph, out.roots, formula.rewrites);
    Ok(out)
}

impl Evaluation {
    fn push(&mut self, root: Id) {
        let k = self.roots.len();
        self.roots.push(root);
        if self.graph.ty(root) == Ty::Complex {
            self.columns.extend([Output::Re(k), Output::Im(k)]);
        } else {
            self.columns.push(Output::Node(k));
        }
    }

    fn gradient(
        &mut self,
        formula: &Formula,
        roots: &[Id],
        value_names: &[String],
    ) -> Result<Vec<Vec<Id>>, ModuleError> {
        let scalars = formula.scalars();
        if scalars.contains(&Ty::Complex) || !matches!(formula.ty, Type::Real | Type::Vector(_)) {
            return Err(demand(
                "a gradient is of a real function of reals; ask for the derivative",
            ));
        }
        let leaves = self.leaves(formula);
        let columns = formula.columns();
        let mut gradients = Vec::new();
        for (&root, name) in roots.iter().zip(value_names) {
            let derived =
                gradient(&mut self.graph, root, &leaves).map_err(LowerError::NoDerivative)?;
            for (&partial, column) in derived.partials.iter().zip(&columns) {
                self.push(partial);
                self.names.push(format!("d{name}/d{column}"));
            }
            gradients.push(derived.partials);
        }
        Ok(gradients)
    }

    /// Second derivatives, behind the gradient.
    fn hessian(
        &mut self,
        formula: &Formula,
        roots: &[Id],
        value_names: &[String],
    ) -> Result<(), ModuleError> {
        let gradients = self.gradient(formula, roots, value_names)?;
        let leaves = self.leaves(formula);
        let columns = formula.columns();
        let (zero, one) = (self.graph.real(0.0), self.graph.real(1.0));
        for (partials, name) in gradients.into_iter().zip(value_names) {
            for (i, first) in columns.iter().enumerate() {
                for j in i..columns.len() {
                    let seed = [(leaves[j], one)];
                    let second = forward(&mut self.graph, &partials[i..=i], &seed)
                        .map_err(LowerError::NoDerivative)?;
                    self.push(second[0].unwrap_or(zero));
                    self.names.push(format!("d2{name}/d{first}d{}", columns[j]));
                }
            }
        }
        Ok(())
    }

    fn leaves(&mut self, formula: &Formula) -> Vec<Id> {
        let scalars = formula.scalars().into_iter().enumerate();
        scalars
            .map(|(k, ty)| Formula::leaf(&mut self.graph, k, ty))
            .collect()
    }

    fn derivative(&mut self, formula: &Formula, roots: &[Id]) -> Result<(), ModuleError> {
        let name = &formula.name;
        let g = &mut self.graph;
        match *formula.scalars().as_slice() {
            [Ty::Complex] if matches!(formula.ty, Type::Real | Type::Complex) => {
                let z = Formula::leaf(g, 0, Ty::Complex);
                let jet = jet(g, roots[0], ComplexVariable::Whole(z))
                    .map_err(LowerError::NoDerivative)?;
                self.push(jet.dz);
                let primed = if jet.dzbar.is_some() {
                    format!("∂{name}")
                } else {
                    format!("{name}'")
                };
                self.names.extend(column_names(&primed, Type::Complex));
                if let Some(dzbar) = jet.dzbar {
                    self.push(dzbar);
                    self.names
                        .extend(column_names(&format!("∂̄{name}"), Type::Complex));
                }
                Ok(())
            }
            [Ty::Real] => {
                let x = Formula::leaf(g, 0, Ty::Real);
                let one = g.real(1.0);
                let slopes = forward(g, roots, &[(x, one)]).map_err(LowerError::NoDerivative)?;
                let zero = g.real(0.0);
                for slope in slopes {
                    let slope = slope.unwrap_or(zero);
                    let slope = if formula.ty == Type::Complex {
                        self.graph.widen(slope)
                    } else {
                        slope
                    };
                    self.push(slope);
                }
                self.names
                    .extend(column_names(&format!("{name}'"), formula.ty));
                Ok(())
            }
            _ => Err(demand(
                "a derivative is of a function of one variable; ask for the gradient",
            )),
        }
    }
}

fn demand(message: &str) -> ModuleError {
    ModuleError::Lower(LowerError::Demand(message.to_owned()))
}
