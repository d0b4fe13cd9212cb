//! Columns of a density along rays: what scenes of media integrate.

use smallvec::smallvec;

use super::{FieldIntegral, Otherwise, Problem, field_integral};
use crate::check::Bounds;
use crate::formula::Formula;
use crate::ir::{Graph, Id, Prim, Ty};

/// Values of a function that make up a density.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Values {
    /// All.
    Both,
    /// Those above 0.
    Positive,
    /// Those below 0.
    Negative,
}

/// |f|^power of some values of a function f of space, and 0 elsewhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Density {
    /// The exponent, above 0.
    pub power: f64,
    /// The values that count.
    pub values: Values,
}

impl Density {
    /// The integral of the density along a ray, in closed form.
    ///
    /// # Errors
    /// The function is no real function of space, or the density has no closed form.
    pub fn column(self, formula: &Formula) -> Result<FieldIntegral, Problem> {
        let (graph, value) = formula.to_compile();
        let mut of = Formula {
            graph: graph.clone(),
            value: value.into(),
            derived: None,
            ..formula.clone()
        };
        if let [value] = *value
            && of.graph.ty(value) == Ty::Real
        {
            of.value = smallvec![self.expression(&mut of.graph, value)];
        }
        field_integral(&of, Otherwise::Refuse)
    }

    fn expression(self, g: &mut Graph, f: Id) -> Id {
        // conditions that always come out the same would only be in the way of a closed form
        let range = Bounds::default().of(g, f, false);
        let size = match self.values {
            Values::Both if self.power % 2.0 == 0.0 || range.lo >= 0.0 => f,
            Values::Both if range.hi <= 0.0 => g.neg(f),
            Values::Both => g.apply(Prim::Abs, &[f]),
            Values::Positive => above_zero(g, f, (range.lo, range.hi)),
            Values::Negative => {
                let turned = g.neg(f);
                above_zero(g, turned, (-range.hi, -range.lo))
            }
        };
        power(g, size, self.power)
    }
}

/// max(f, 0)
fn above_zero(g: &mut Graph, f: Id, (lo, hi): (f64, f64)) -> Id {
    let zero = g.real(0.0);
    match (lo >= 0.0, hi <= 0.0) {
        (true, _) => f,
        (_, true) => zero,
        _ => g.apply(Prim::Max, &[f, zero]),
    }
}

#[allow(clippy::cast_possible_truncation, reason = "a small whole number")]
fn power(g: &mut Graph, base: Id, exponent: f64) -> Id {
    match exponent {
        1.0 => base,
        n if n.fract() == 0.0 && n.abs() <= 64.0 => g.apply(Prim::PowInt(n as i32), &[base]),
        _ => {
            let exponent = g.real(exponent);
            g.apply(Prim::Pow, &[base, exponent])
        }
    }
}
