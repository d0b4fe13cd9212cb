//! What the functions of the shader library mean, by their names: for those who run a shader in `f64`.

use std::sync::OnceLock;

use rustc_hash::FxHashMap;

use super::{Gpu, Number, Row, pair, row, rows};
use crate::ir::Prim;
use crate::reference::Complex;

/// What a function of the shader library computes, whatever the format of its numbers: lowering calls no other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Meaning {
    /// An operation of the table.
    Operation(Prim),
    /// Two operations of one operand, computed together.
    Both(Prim, Prim),
    /// An integer power; the exponent is the last operand.
    IntegerPower,
    /// An operation of a family; which one is the last operand.
    Family(Prim),
    /// a², of a real or a complex number.
    Square,
    /// 1/w of a complex number.
    Inverse,
    /// f x^(y + c) of (x, y, c, f)
    ScaledPower,
    /// A NaN.
    Nan,
    /// The infinity with the operand's sign.
    Infinity,
    /// The operand itself, in another format or cut off from how it was made.
    Same,
    /// The number of two words, in the tier's format.
    FromWords,
    /// The two words of a number, in the tier's format.
    ToWords,
}

/// Names that no row tells: operators and built-ins in the wide formats, and what lowering writes by itself.
const WRITTEN: &[(&str, Meaning)] = &[
    ("real_add", Meaning::Operation(Prim::Add)),
    ("add32", Meaning::Operation(Prim::Add)),
    ("real_sub", Meaning::Operation(Prim::Sub)),
    ("real_mul", Meaning::Operation(Prim::Mul)),
    ("real_div", Meaning::Operation(Prim::Div)),
    ("real_square", Meaning::Square),
    ("real_less", Meaning::Operation(Prim::Less)),
    ("real_less_equal", Meaning::Operation(Prim::LessEqual)),
    ("real_equal", Meaning::Operation(Prim::Equal)),
    ("real_not_equal", Meaning::Operation(Prim::NotEqual)),
    ("real_abs", Meaning::Operation(Prim::Abs)),
    ("real_floor", Meaning::Operation(Prim::Floor)),
    ("real_ceil", Meaning::Operation(Prim::Ceil)),
    ("real_trunc", Meaning::Operation(Prim::Trunc)),
    ("real_sqrt", Meaning::Operation(Prim::Sqrt)),
    ("real_min", Meaning::Operation(Prim::Min)),
    ("real_max", Meaning::Operation(Prim::Max)),
    ("real_powi", Meaning::IntegerPower),
    ("complex_powi", Meaning::IntegerPower),
    ("complex_square", Meaning::Square),
    ("complex_inverse", Meaning::Inverse),
    ("real_scaled_power", Meaning::ScaledPower),
    ("make_nan", Meaning::Nan),
    ("make_infinity", Meaning::Infinity),
    ("rounded", Meaning::Same),
    ("real_from_f32", Meaning::Same),
    ("real_to_f32", Meaning::Same),
    ("real_from_words", Meaning::FromWords),
    ("real_to_words", Meaning::ToWords),
];

/// The meaning of a library function that lowering calls, or of the one of its name in another format.
#[must_use]
pub fn meaning(name: &str) -> Option<Meaning> {
    static INDEX: OnceLock<FxHashMap<String, Meaning>> = OnceLock::new();
    let index = INDEX.get_or_init(|| {
        let mut index = FxHashMap::default();
        for row in rows() {
            for name in [library_name(row), row.gpu_complex] {
                let meaning = match row.prim.order() {
                    Some(_) => Meaning::Family(row.prim),
                    None => Meaning::Operation(row.prim),
                };
                if name != super::DEFINED {
                    index.insert(name.to_owned(), meaning);
                }
            }
            for (prim, name) in crate::defined::shader_names(row) {
                index.insert(name, Meaning::Operation(prim));
            }
            let pair = pair(row.prim).filter(|pair| pair.place == 0);
            for (pair, name) in pair.iter().flat_map(|p| [(p, p.gpu), (p, p.gpu_complex)]) {
                index.insert(name.to_owned(), Meaning::Both(row.prim, pair.partner));
            }
        }
        index.extend(WRITTEN.iter().map(|&(name, m)| (name.to_owned(), m)));
        index.remove("");
        index
    });
    index.get(name).copied()
}

fn library_name(row: &Row) -> &'static str {
    match row.gpu {
        Gpu::Library(name, _) | Gpu::Family(name) => name,
        _ => "",
    }
}

/// A function on numbers of one kind: the quick way to a row's value.
#[derive(Clone, Copy, Debug)]
pub enum Direct {
    /// Reals to a real.
    Real(fn(&[f64]) -> f64),
    /// Complex numbers to a complex number.
    Complex(fn(&[Complex]) -> Complex),
}

impl Meaning {
    /// The functions that give the values, where all operands are of one kind and so are the values.
    #[must_use]
    pub fn direct(self, complex: bool) -> Option<Vec<Direct>> {
        match self {
            Self::Both(first, second) => {
                let part = |prim| Self::Operation(prim).one(complex);
                Some(vec![part(first)?, part(second)?])
            }
            _ => self.one(complex).map(|direct| vec![direct]),
        }
    }

    fn one(self, complex: bool) -> Option<Direct> {
        let found = match self {
            Self::Operation(prim) if complex => row(prim).complex.map(Direct::Complex),
            Self::Operation(prim) => row(prim).real.map(Direct::Real),
            Self::Square if !complex => Some(Direct::Real(|a| a[0] * a[0])),
            Self::Square => Some(Direct::Complex(|z| z[0].square())),
            Self::Inverse => Some(Direct::Complex(|z| z[0].inverse())),
            Self::ScaledPower => Some(Direct::Real(|a| {
                a[3] * crate::reference::slope::pow_shift(a[0], a[1], a[2])
            })),
            Self::Nan => Some(Direct::Real(|_| f64::NAN)),
            Self::Infinity => Some(Direct::Real(|a| f64::INFINITY.copysign(a[0]))),
            Self::Same => Some(Direct::Real(|a| a[0])),
            _ => None,
        };
        // the parts and the length of a complex number are real
        found.filter(|_| !(complex && matches!(self, Self::Operation(p) if is_part(p))))
    }

    /// The value of operands of any kind; `integer` is the exponent or the order. `None` where they do not fit.
    #[must_use]
    pub fn evaluate(self, operands: &[Number], integer: i32) -> Option<[Option<Number>; 2]> {
        let one = |prim: Prim| row(prim).evaluate(prim, operands);
        Some(match self {
            Self::Operation(prim) => [Some(one(prim)?), None],
            Self::Both(first, second) => [Some(one(first)?), Some(one(second)?)],
            Self::IntegerPower => [Some(one(Prim::PowInt(integer))?), None],
            Self::Family(prim) => [
                Some(one(prim.with_order(u8::try_from(integer).ok()?))?),
                None,
            ],
            _ => return None,
        })
    }
}

fn is_part(prim: Prim) -> bool {
    super::Typing::Part == row(prim).typing
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_have_their_meaning() {
        let check =
            |name: &str, expected: Meaning| assert_eq!(meaning(name), Some(expected), "{name}");
        check("real_sin", Meaning::Operation(Prim::Sin));
        check("complex_sin", Meaning::Operation(Prim::Sin));
        check("real_sincos", Meaning::Both(Prim::Sin, Prim::Cos));
        check("complex_sinhcosh", Meaning::Both(Prim::Sinh, Prim::Cosh));
        check("real_div", Meaning::Operation(Prim::Div));
        assert_eq!(meaning("two_sum"), None);
        assert_eq!(meaning(""), None);
    }

    #[test]
    fn values() {
        let value = |name: &str, x: f64, n: i32| {
            let [value, _] = meaning(name)
                .unwrap()
                .evaluate(&[Number::Real(x)], n)
                .unwrap();
            value.unwrap()
        };
        assert_eq!(value("real_powi", 3.0, -2), Number::Real(1.0 / 9.0));
        assert_eq!(value("real_sincos", 0.0, 0), Number::Real(0.0));
        let scaled = meaning("real_scaled_power").unwrap().direct(false).unwrap();
        let [Direct::Real(f)] = scaled.as_slice() else {
            panic!("no function");
        };
        assert_eq!(f(&[2.0, 3.0, 1.0, 0.5]), 8.0);
        assert_eq!(
            meaning("complex_sincos")
                .unwrap()
                .direct(true)
                .map(|d| d.len()),
            Some(2)
        );
        assert!(meaning("complex_abs").unwrap().direct(true).is_none());
    }
}
