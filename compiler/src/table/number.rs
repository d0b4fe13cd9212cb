//! Values of the `f64` reference, and the evaluation of one operation.

use super::Row;
use crate::ir::Prim;
use crate::reference;
use crate::reference::complex::{Complex, complex};

/// A value in `f64`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Number {
    /// A real number.
    Real(f64),
    /// A complex number.
    Complex(Complex),
    /// A truth value.
    Truth(bool),
}

impl Number {
    pub(crate) fn widened(self) -> Option<Complex> {
        match self {
            Self::Real(re) => Some(complex(re, 0.0)),
            Self::Complex(z) => Some(z),
            Self::Truth(_) => None,
        }
    }

    fn real(self) -> Option<f64> {
        if let Self::Real(x) = self {
            Some(x)
        } else {
            None
        }
    }
}

pub(super) fn evaluate(row: &Row, prim: Prim, operands: &[Number]) -> Option<Number> {
    if let Some(value) = structural(prim, operands) {
        return Some(value);
    }
    if row.is_defined(false) || row.is_defined(true) && operands.iter().any(|v| v.real().is_none())
    {
        return crate::defined::value(prim, operands);
    }
    if let Some(reals) = operands
        .iter()
        .map(|v| v.real())
        .collect::<Option<ArgBuffer<f64>>>()
    {
        return Some(Number::Real(row.real?(&reals)));
    }
    let operands = operands
        .iter()
        .map(|v| v.widened())
        .collect::<Option<ArgBuffer<Complex>>>()?;
    Some(Number::Complex(row.complex?(&operands)))
}

type ArgBuffer<T> = smallvec::SmallVec<[T; 4]>;

/// Operations whose operand or result types are not all alike.
fn structural(prim: Prim, operands: &[Number]) -> Option<Number> {
    use Number::{Complex as C, Real as R, Truth as T};
    Some(match (prim, operands) {
        (Prim::PowInt(n), &[R(x)]) => R(reference::real::powi(x, n)),
        (Prim::PowInt(n), &[C(z)]) => C(z.powi(n)),
        (Prim::Polygamma(n), &[R(x)]) => R(reference::polygamma::polygamma(n, x)),
        (Prim::Polygamma(n), &[C(z)]) => C(z.polygamma(n)),
        (Prim::AtanQuotient(n), &[R(x)]) => R(reference::rational::atan_quotient(n, x)),
        (Prim::Log1pRel(n), &[R(x)]) => R(reference::rational::log1prel(n, x)),
        (Prim::Log1pRel(n), &[C(z)]) => C(z.log1prel(n)),
        (Prim::SphericalJ(n), &[R(x)]) => R(reference::bessel::spherical_j(n, x)),
        (Prim::SphericalIScaled(n), &[R(x)]) => R(reference::bessel::spherical_i_scaled(n, x)),
        (Prim::GaussMassMoment(n), &[R(c), R(w)]) => R(reference::erf::mass_moment(n, c, w)),
        (Prim::Erfcx(n), &[R(x)]) => R(reference::erf::erfcx(n, x)),
        (Prim::Complex, &[R(re), R(im)]) => C(complex(re, im)),
        (Prim::Re, &[C(z)]) => R(z.re),
        (Prim::Im, &[C(z)]) => R(z.im),
        (Prim::Abs, &[C(z)]) => R(z.abs()),
        (Prim::Arg, &[C(z)]) => R(z.arg()),
        // mixed arithmetic does not widen the real operand (C99 Annex G.5.1)
        (Prim::Add, &[R(x), C(z)] | &[C(z), R(x)]) => C(complex(z.re + x, z.im)),
        (Prim::Sub, &[C(z), R(x)]) => C(complex(z.re - x, z.im)),
        (Prim::Sub, &[R(x), C(z)]) => C(complex(x - z.re, -z.im)),
        (Prim::Mul, &[R(x), C(z)] | &[C(z), R(x)]) => C(complex(z.re * x, z.im * x)),
        (Prim::Div, &[C(z), R(x)]) => C(complex(z.re / x, z.im / x)),
        (Prim::Less, &[R(a), R(b)]) => T(a < b),
        (Prim::LessEqual, &[R(a), R(b)]) => T(a <= b),
        (Prim::Equal, &[R(a), R(b)]) => T(a == b),
        (Prim::NotEqual, &[R(a), R(b)]) => T(a != b),
        (Prim::Equal, &[C(a), C(b)]) => T(a == b),
        (Prim::NotEqual, &[C(a), C(b)]) => T(a != b),
        (Prim::And, &[T(a), T(b)]) => T(a && b),
        (Prim::Or, &[T(a), T(b)]) => T(a || b),
        (Prim::Not, &[T(a)]) => T(!a),
        (Prim::Select, &[T(c), a, b]) => {
            if c {
                a
            } else {
                b
            }
        }
        _ => return None,
    })
}
