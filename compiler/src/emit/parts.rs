//! What functions are made of: the expressions of each part, before they are lowered.

use smallvec::smallvec;

use super::constants::fixed;
use super::request::EmitWhat;
use crate::derive::forward;
use crate::formula::{Formula, Input, column_names};
use crate::integrate::{Otherwise, field_integral, shifted_field_integral};
use crate::ir::{Op, Prim, Ty};
use crate::lower::LowerError;
use crate::module::{Evaluation, ModuleError, What, stable_evaluation};
use crate::program::{ParamInfo, Picture};
use crate::stable::finish;
use crate::types::Type;

/// The expressions of a function.
pub(super) struct Part {
    pub(super) what: EmitWhat,
    /// The function of the formula, or the integral of it.
    pub(super) formula: Formula,
    pub(super) evaluation: Evaluation,
    /// How many of the first results are the value.
    pub(super) values: usize,
    /// A remark on how it is computed.
    pub(super) remark: String,
    /// Whether parameters of the program have become constants in it.
    pub(super) is_fixed: bool,
}

/// Derives what a part computes, of the formula for the parameters' values where those are given.
pub(super) fn part(
    picture: &Picture,
    what: EmitWhat,
    values: Option<&[ParamInfo]>,
) -> Result<Part, ModuleError> {
    match values.and_then(|values| fixed(&picture.formula, values)) {
        Some(formula) => Ok(Part {
            is_fixed: true,
            ..of_formula(&formula, what)?
        }),
        None => of_formula(&picture.formula, what),
    }
}

fn of_formula(formula: &Formula, what: EmitWhat) -> Result<Part, ModuleError> {
    let mut out = match what {
        EmitWhat::Integral
        | EmitWhat::ShiftedIntegral
        | EmitWhat::Transmittance
        | EmitWhat::Opacity => integral(formula, what)?,
        EmitWhat::Directional => directional(formula)?,
        _ => {
            let asked = match what {
                EmitWhat::Gradient | EmitWhat::Partials => What::Gradient,
                EmitWhat::Derivative => What::Derivative,
                EmitWhat::Hessian => What::Hessian,
                _ => What::Value,
            };
            Part {
                what,
                formula: formula.clone(),
                evaluation: stable_evaluation(formula, asked)?,
                values: formula.value.len(),
                remark: String::new(),
                is_fixed: false,
            }
        }
    };
    if what == EmitWhat::Partials {
        let evaluation = &mut out.evaluation;
        evaluation.roots.drain(..out.values);
        evaluation
            .names
            .drain(..out.values.min(evaluation.names.len()));
        out.values = 0;
    }
    name_results(&mut out);
    Ok(out)
}

/// The value and its derivative along a direction: one tangent, whatever the number of variables.
fn directional(formula: &Formula) -> Result<Part, ModuleError> {
    let scalars = formula.scalars();
    if scalars.is_empty() || scalars.iter().any(|&s| s != Ty::Real) {
        return Err(ModuleError::Lower(LowerError::Demand(
            "a derivative along a direction is of a function of reals; ask for the derivative"
                .to_owned(),
        )));
    }
    let stable = formula.stabilised();
    let (mut graph, mut roots) = stable.graph.compacted(&stable.value);
    let mut seeds = Vec::new();
    for (k, &ty) in scalars.iter().enumerate() {
        let leaf = Formula::leaf(&mut graph, k, ty);
        seeds.push((leaf, Formula::leaf(&mut graph, scalars.len() + k, ty)));
    }
    let slopes = forward(&mut graph, &roots, &seeds).map_err(LowerError::NoDerivative)?;
    let zero = graph.real(0.0);
    let values = roots.len();
    for (k, slope) in slopes.into_iter().enumerate() {
        let slope = slope.unwrap_or(zero);
        let is_complex = graph.ty(roots[k]) == Ty::Complex && graph.ty(slope) != Ty::Complex;
        roots.push(if is_complex {
            graph.widen(slope)
        } else {
            slope
        });
    }
    let (graph, roots) = finish(graph, roots, formula.rewrites);
    let mut names = column_names(&formula.name, formula.ty);
    names.extend(column_names(&format!("d{}", formula.name), formula.ty));
    let directions = formula.inputs.iter().map(|input| Input {
        name: format!("d{}", input.name),
        ty: input.ty,
    });
    let mut along = formula.clone();
    along.inputs.extend(directions.collect::<Vec<_>>());
    Ok(Part {
        what: EmitWhat::Directional,
        formula: along,
        evaluation: Evaluation {
            graph,
            roots,
            columns: Vec::new(),
            names,
        },
        values,
        remark: String::new(),
        is_fixed: false,
    })
}

/// The integral along a ray, or what hangs on it.
fn integral(formula: &Formula, what: EmitWhat) -> Result<Part, ModuleError> {
    let make = if what == EmitWhat::ShiftedIntegral {
        shifted_field_integral
    } else {
        field_integral
    };
    let made = make(formula, Otherwise::Quadrature).map_err(LowerError::NoIntegral)?;
    let is_closed = made.integral.numerical.is_empty();
    let of = match what {
        EmitWhat::Transmittance => "exp(-τ) of the integral τ",
        EmitWhat::Opacity => "1 - exp(-τ) of the integral τ",
        _ => "the integral",
    };
    let how = if is_closed {
        "in closed form"
    } else {
        "in part by quadrature"
    };
    let formula = of_depth(made.into_formula(formula), what);
    Ok(Part {
        what,
        evaluation: stable_evaluation(&formula, What::Value)?,
        values: formula.value.len(),
        remark: format!("{of} along o + t d from t = a to t = b, {how}"),
        formula,
        is_fixed: false,
    })
}

/// An optical depth, or the transmittance or the opacity of it.
fn of_depth(mut depth: Formula, what: EmitWhat) -> Formula {
    let &[value] = depth.value.as_slice() else {
        return depth;
    };
    let g = &mut depth.graph;
    let turned = g.neg(value);
    let value = match what {
        EmitWhat::Transmittance => g.apply(Prim::Exp, &[turned]),
        EmitWhat::Opacity => {
            let change = g.apply(Prim::Expm1, &[turned]);
            g.neg(change)
        }
        _ => return depth,
    };
    depth.value = smallvec![value];
    depth
}

/// Names the results that the user gave no name to, so that the text says what they are.
fn name_results(part: &mut Part) {
    if part.what == EmitWhat::Value || part.evaluation.roots.len() < 2 {
        return;
    }
    let members = result_names(part);
    if part.values == 1 {
        let (graph, root) = (&mut part.evaluation.graph, part.evaluation.roots[0]);
        if matches!(graph.node(root).op, Op::Apply(_)) {
            graph.rename(root, &part.formula.name);
        }
    }
    for (k, name) in members.iter().enumerate().skip(part.values) {
        let root = part.evaluation.roots[k];
        let graph = &mut part.evaluation.graph;
        if matches!(graph.node(root).op, Op::Apply(_)) && graph.name(root).is_none() {
            graph.set_name(root, name);
        }
    }
}

/// A name for each result: `value`, `df_dx`, `d2f_dx_dy`.
pub(super) fn result_names(part: &Part) -> Vec<String> {
    let formula = &part.formula;
    let roots = part.evaluation.roots.len();
    let letters = ["x", "y", "z", "w"];
    let of_value = |k: usize| {
        if part.values == 1 {
            "value".to_owned()
        } else {
            format!("value_{}", letters[k.min(3)])
        }
    };
    let is_vector = matches!(formula.ty, Type::Vector(_));
    let count = formula.value.len();
    let name = &formula.name;
    let of_component = |k: usize| {
        if is_vector {
            format!("{name}_{}", letters[k.min(3)])
        } else {
            name.clone()
        }
    };
    let columns: Vec<String> = formula
        .columns()
        .iter()
        .map(|c| c.replace('.', "_"))
        .collect();
    let mut out: Vec<String> = (0..part.values).map(of_value).collect();
    match part.what {
        EmitWhat::Gradient | EmitWhat::Partials | EmitWhat::Hessian => {
            for k in 0..count {
                out.extend(columns.iter().map(|c| format!("d{}_d{c}", of_component(k))));
            }
            if part.what == EmitWhat::Hessian {
                for k in 0..count {
                    for (i, first) in columns.iter().enumerate() {
                        for second in &columns[i..] {
                            out.push(format!("d2{}_d{first}_d{second}", of_component(k)));
                        }
                    }
                }
            }
        }
        EmitWhat::Directional => {
            out.extend((0..count).map(|k| format!("d{}", of_component(k))));
        }
        EmitWhat::Derivative if roots == 2 * part.values => {
            out.extend((0..count).map(|k| format!("d{}", of_component(k))));
        }
        EmitWhat::Derivative => {
            out.extend(["dz", "dzbar"].map(|v| format!("d{name}_{v}")));
        }
        _ => {}
    }
    out.truncate(roots);
    while out.len() < roots {
        out.push(format!("result_{}", out.len()));
    }
    out
}
