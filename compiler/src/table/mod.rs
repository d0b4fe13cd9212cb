//! The operator table: every operation is defined here, once.
//!
//! The checker, the evaluator, the simplifier, the derivatives, the lowering, the cost count, the function
//! reference and the generated tests read it. Adding an operation is adding a row (and its [`Prim`]).

mod arithmetic;
mod bessel;
mod bounds;
mod cardinal;
mod comparison;
mod complex;
mod defined;
mod derivative;
mod domain;
mod elliptic;
mod exponential;
mod exponential_integral;
mod hyperbolic;
mod integral;
mod library;
mod number;
mod polynomial;
mod rounding;
mod slope;
mod special;
mod trigonometric;
mod typing;
mod whole;

use std::mem::{Discriminant, discriminant};
use std::sync::OnceLock;

use naga::{BinaryOperator, MathFunction, UnaryOperator};
use rustc_hash::FxHashMap;

pub use bounds::{Bound, Bounds, Metric, bounds, bounds_of};
pub use domain::outside;
pub use integral::MAX_MOMENT;
pub use library::{Direct, Meaning, meaning};
pub use number::Number;
pub(crate) use slope::direction;
pub use special::MAX_POLYGAMMA;
pub use typing::Typing;
pub use whole::{Whole, whole};

use crate::ir::{Graph, Id, Prim};
use crate::reference::Complex;
use crate::reference::bessel::MAX_SPHERICAL;

/// One operation.
#[derive(Debug)]
pub struct Row {
    /// The operation in the IR. For integer powers, one of the family.
    pub prim: Prim,
    /// Its word in the text form of the IR.
    pub mnemonic: &'static str,
    /// Names in the language, the first is the usual one; empty where there is only a sign.
    pub names: &'static [&'static str],
    /// How it is written, such as `atan2(y, x)` or `a + b`; empty where only derivatives make it.
    pub usage: &'static str,
    /// One line: what it is.
    pub doc: &'static str,
    /// Types of operands and result.
    pub typing: Typing,
    /// Value on reals in `f64`.
    pub real: Option<fn(&[f64]) -> f64>,
    /// Value on complex numbers in `f64`, on the principal branch (cuts and signed zeros after C99 Annex G).
    pub complex: Option<fn(&[Complex]) -> Complex>,
    /// Derivative.
    pub derivative: Derivative,
    /// What a shader does on reals.
    pub gpu: Gpu,
    /// Name of the shader function on complex numbers; empty where the lowering writes it out or has none, and
    /// [`DEFINED`] where there is a definition in the language.
    pub gpu_complex: &'static str,
    /// Weights of the cost count.
    pub cost: Weight,
}

/// Stands for the shader function on complex numbers where there is a definition in the language, see [`crate::defined`].
pub const DEFINED: &str = "defined";

/// Cost of one operation; one addition of reals is 1.
#[derive(Clone, Copy, Debug)]
pub struct Weight {
    /// On reals.
    pub real: u16,
    /// On complex numbers.
    pub complex: u16,
}

/// How an operation is differentiated.
#[derive(Clone, Copy, Debug)]
pub enum Derivative {
    /// Locally constant: the derivative is zero wherever it exists.
    Zero,
    /// The partial derivative by the k-th operand, given the operands and the value. For complex operands this
    /// is the complex derivative; the operation is holomorphic.
    Partial(fn(&mut Graph, &[Id], Id, usize) -> Id),
    /// The pass itself knows: the operation is linear, a product, a quotient, a choice, or not holomorphic.
    Structural,
    /// There is no rule yet.
    Missing,
}

/// What a shader does on reals.
#[derive(Clone, Copy, Debug)]
pub enum Gpu {
    /// A WGSL operator of two operands.
    Binary(BinaryOperator),
    /// A WGSL operator of one operand.
    Unary(UnaryOperator),
    /// A WGSL built-in that is good enough on every tier (exact, or correctly rounded).
    Builtin(MathFunction),
    /// A function of the shader math library, and the built-in of the fast tier where there is one.
    Library(&'static str, Option<MathFunction>),
    /// A function of the shader math library for all of a family, whose last operand says which it is.
    Family(&'static str),
    /// The definition of its mnemonic in the language, see [`crate::defined`].
    Defined,
    /// The lowering writes it out.
    Structural,
}

/// Two functions of one argument that a shader computes together, where both are wanted.
#[derive(Clone, Copy, Debug)]
pub struct Pair {
    /// The other function.
    pub partner: Prim,
    /// The place of this function's value in the pair.
    pub place: u32,
    /// Shader function on reals, giving two reals.
    pub gpu: &'static str,
    /// Shader function on complex numbers, giving four reals.
    pub gpu_complex: &'static str,
    /// What the second value costs when the first is computed.
    pub extra: Weight,
}

/// The pair that a function belongs to.
#[must_use]
pub fn pair(prim: Prim) -> Option<Pair> {
    let extra = Weight {
        real: 3,
        complex: 8,
    };
    let circular = |partner, place| Pair {
        partner,
        place,
        gpu: "real_sincos",
        gpu_complex: "complex_sincos",
        extra,
    };
    let hyperbolic = |partner, place| Pair {
        partner,
        place,
        gpu: "real_sinhcosh",
        gpu_complex: "complex_sinhcosh",
        extra,
    };
    match prim {
        Prim::Sin => Some(circular(Prim::Cos, 0)),
        Prim::Cos => Some(circular(Prim::Sin, 1)),
        Prim::Sinh => Some(hyperbolic(Prim::Cosh, 0)),
        Prim::Cosh => Some(hyperbolic(Prim::Sinh, 1)),
        _ => None,
    }
}

impl Row {
    /// The usual name, or the sign where there is no name: `sin`, `+`.
    #[must_use]
    pub fn sign(&self) -> &'static str {
        let is_operand = |c: char| c.is_ascii_lowercase() || c == ' ';
        let written = self.usage.rsplit(", ").next().unwrap_or(self.usage);
        self.names
            .first()
            .copied()
            .unwrap_or_else(|| written.trim_matches(is_operand))
    }

    /// Whether its value on reals, or on complex numbers, is a definition in the language.
    #[must_use]
    pub fn is_defined(&self, complex: bool) -> bool {
        if complex {
            self.gpu_complex == DEFINED
        } else {
            matches!(self.gpu, Gpu::Defined)
        }
    }

    /// Whether there is a way to write it; others only derivatives make.
    #[must_use]
    pub fn is_written(&self) -> bool {
        !self.usage.is_empty()
    }

    /// The operation's value, in `f64`; `None` where the operand types do not fit.
    #[must_use]
    pub fn evaluate(&self, prim: Prim, operands: &[Number]) -> Option<Number> {
        number::evaluate(self, prim, operands)
    }
}

/// Every row.
pub fn rows() -> &'static [Row] {
    static ROWS: OnceLock<Vec<Row>> = OnceLock::new();
    ROWS.get_or_init(|| {
        let mut rows = Vec::new();
        rows.extend(arithmetic::rows());
        rows.extend(complex::rows());
        rows.extend(exponential::rows());
        rows.extend(trigonometric::rows());
        rows.extend(hyperbolic::rows());
        rows.extend(cardinal::rows());
        rows.extend(integral::rows());
        rows.extend(rounding::rows());
        rows.extend(comparison::rows());
        rows.extend(special::rows());
        rows.extend(defined::rows());
        rows.extend(bessel::rows());
        rows.extend(exponential_integral::rows());
        rows.extend(polynomial::rows());
        rows.extend(elliptic::rows());
        rows.extend(slope::rows());
        rows
    })
}

/// The row of a primitive.
#[must_use]
pub fn row(prim: Prim) -> &'static Row {
    static INDEX: OnceLock<FxHashMap<Discriminant<Prim>, &'static Row>> = OnceLock::new();
    let index = INDEX.get_or_init(|| rows().iter().map(|r| (discriminant(&r.prim), r)).collect());
    // A unit test holds that every primitive has a row; the first row stands in for one that has not.
    index
        .get(&discriminant(&prim))
        .copied()
        .unwrap_or(&rows()[0])
}

/// How an operation is differentiated: as its row says, and of a family not beyond its last member.
#[must_use]
pub fn derivative(prim: Prim) -> Derivative {
    if prim.order().is_some_and(|n| n >= last_order(prim)) && !defined::is_closed(prim) {
        return Derivative::Missing;
    }
    row(prim).derivative
}

/// Whether an operation that is differentiated by its operands has no derivative by the k-th one.
#[must_use]
pub fn is_missing(prim: Prim, k: usize) -> bool {
    defined::is_missing(prim, k)
}

/// The row of the function that a user has written: the operation's own, or where it has no name that of which it is a derivative.
#[must_use]
pub fn written(prim: Prim) -> &'static Row {
    let of = match prim {
        Prim::EllipticD(_) => Prim::EllipticK,
        Prim::ModularLambdaSlope(_) => Prim::ModularLambda,
        Prim::DigammaRise => Prim::EulerBeta,
        other => other,
    };
    row(of)
}

/// What an operation lacks that has no derivative, or none by some of its operands, in words.
#[must_use]
pub fn lacking(prim: Prim) -> &'static str {
    match prim {
        Prim::JacobiSn(_) | Prim::JacobiCn(_) | Prim::JacobiDn(_) => "third derivative by m",
        Prim::GegenbauerC(_) | Prim::LaguerreL(_) => "third derivative by a",
        Prim::Hypergeometric(_) => "third derivative by a, b, c",
        Prim::EllipticD(_) | Prim::ModularLambdaSlope(_) => "third derivative",
        Prim::HurwitzZeta(_) | Prim::Zeta(_) | Prim::DirichletBeta(_) => "third derivative by s",
        Prim::DirichletEta(_) => "second derivative by s",
        Prim::WeierstrassP(_) => "second derivative by τ",
        Prim::WeierstrassPInvariants(_) => "second derivative by g₂ or g₃",
        _ => "derivative",
    }
}

/// The last member of a family that there is a function for.
pub(crate) fn last_order(prim: Prim) -> u8 {
    match prim {
        Prim::Polygamma(_) => MAX_POLYGAMMA,
        Prim::Erfcx(_) => integral::MAX_MOMENT,
        Prim::SphericalJ(_) | Prim::SphericalIScaled(_) => MAX_SPHERICAL,
        Prim::GaussMassMoment(_) => integral::MAX_MASS_MOMENT,
        _ if row(prim).is_defined(true) => defined::last_order(prim),
        _ => integral::MAX_MOMENT,
    }
}

/// The row of a function by its name or alias in the language.
#[must_use]
pub fn by_name(name: &str) -> Option<&'static Row> {
    static INDEX: OnceLock<FxHashMap<&'static str, &'static Row>> = OnceLock::new();
    let index = INDEX.get_or_init(|| {
        rows()
            .iter()
            .flat_map(|r| r.names.iter().map(move |&n| (n, r)))
            .collect()
    });
    index.get(name).copied()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lower::Precision;

    #[test]
    fn names_and_mnemonics_are_unique() {
        let mut names: Vec<&str> = rows()
            .iter()
            .flat_map(|r| r.names.iter().copied())
            .collect();
        let mut mnemonics: Vec<&str> = rows().iter().map(|r| r.mnemonic).collect();
        for list in [&mut names, &mut mnemonics] {
            let count = list.len();
            list.sort_unstable();
            list.dedup();
            assert_eq!(list.len(), count);
        }
    }

    /// Every library function that a row names exists in the shader library of every format.
    #[test]
    fn shader_functions_exist() {
        for precision in Precision::ALL {
            let known: Vec<&str> = crate::link::number_module(precision.into())
                .functions
                .iter()
                .filter_map(|(_, f)| f.name.as_deref())
                .collect();
            let missing: Vec<&str> = needed().filter(|name| !known.contains(name)).collect();
            assert!(missing.is_empty(), "{precision:?} lacks {missing:?}");
        }
    }

    /// Names of the library functions that rows name, and of those that the lowering writes by itself.
    fn needed() -> impl Iterator<Item = &'static str> {
        let named = |row: &'static Row| {
            let real = match row.gpu {
                Gpu::Library(name, _) | Gpu::Family(name) => name,
                _ => "",
            };
            let both = pair(row.prim).map_or(["", ""], |p| [p.gpu, p.gpu_complex]);
            [real, row.gpu_complex, both[0], both[1]]
        };
        let written = [
            "make_infinity",
            "make_nan",
            "real_powi",
            "rounded",
            "complex_square",
            "complex_inverse",
            "complex_powi",
        ];
        rows()
            .iter()
            .flat_map(named)
            .chain(written)
            .filter(|name| !name.is_empty() && *name != DEFINED)
    }
}
