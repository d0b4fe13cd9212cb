//! Built-in functions of known values.
//!
//! What IEEE 754 does not define is computed in `f64` and rounded, which no machine does better; functions of vectors are in terms of
//! sums and products in the order of the components. Only numbers that are zero or normal are taken and given: machines
//! treat others differently.

use naga::{Literal, MathFunction};

use super::fold::{each, pairs, plain};
use super::known::Known;

/// A function of one to three known values.
pub fn math(fun: MathFunction, args: &[&Known]) -> Option<Known> {
    if let Some(known) = geometry(fun, args) {
        return known;
    }
    match *args {
        [a] => each(a, &|x| one(fun, x)),
        [a, b] => pairs(a, b, &|x, y| two(fun, x, y)),
        [a, low, high] if fun == MathFunction::Clamp => {
            let raised = pairs(a, low, &|x, y| extreme(MathFunction::Max, x, y))?;
            pairs(&raised, high, &|x, y| extreme(MathFunction::Min, x, y))
        }
        [a, b, c] => triples([a, b, c], &|x, y, z| three(fun, x, y, z)),
        _ => None,
    }
}

fn one(fun: MathFunction, x: Literal) -> Option<Literal> {
    match x {
        Literal::F32(x) => of_number(fun, x).map(Literal::F32),
        Literal::I32(x) if fun == MathFunction::Abs => Some(Literal::I32(x.wrapping_abs())),
        _ => None,
    }
}

fn of_number(fun: MathFunction, x: f32) -> Option<f32> {
    use MathFunction as F;
    match fun {
        F::Abs => Some(x.abs()),
        F::Floor => Some(x.floor()),
        F::Ceil => Some(x.ceil()),
        F::Trunc => Some(x.trunc()),
        F::Round => Some(x.round_ties_even()),
        F::Fract => plain(x - plain(x)?.floor()),
        F::Sqrt => plain(plain(x)?.sqrt()),
        _ => rounded(elementary(fun)?(f64::from(plain(x)?))),
    }
}

fn elementary(fun: MathFunction) -> Option<fn(f64) -> f64> {
    use MathFunction as F;
    Some(match fun {
        F::Sin => f64::sin,
        F::Cos => f64::cos,
        F::Tan => f64::tan,
        F::Asin => f64::asin,
        F::Acos => f64::acos,
        F::Atan => f64::atan,
        F::Exp => f64::exp,
        F::Exp2 => f64::exp2,
        F::Log => f64::ln,
        F::Log2 => f64::log2,
        F::InverseSqrt => |x| 1.0 / x.sqrt(),
        F::Radians => f64::to_radians,
        F::Degrees => f64::to_degrees,
        _ => return None,
    })
}

#[allow(clippy::cast_possible_truncation, reason = "rounding is meant")]
fn rounded(x: f64) -> Option<f32> {
    plain(x as f32)
}

fn two(fun: MathFunction, x: Literal, y: Literal) -> Option<Literal> {
    let (Literal::F32(a), Literal::F32(b)) = (x, y) else {
        return extreme(fun, x, y);
    };
    let double: fn(f64, f64) -> f64 = match fun {
        MathFunction::Pow => f64::powf,
        MathFunction::Atan2 => f64::atan2,
        _ => return extreme(fun, x, y),
    };
    rounded(double(f64::from(plain(a)?), f64::from(plain(b)?))).map(Literal::F32)
}

fn extreme(fun: MathFunction, x: Literal, y: Literal) -> Option<Literal> {
    match (fun, x, y) {
        // of zeros of different sign machines take either
        (_, Literal::F32(x), Literal::F32(y)) if x == y && x.to_bits() != y.to_bits() => None,
        (MathFunction::Min, Literal::F32(x), Literal::F32(y)) => Some(Literal::F32(x.min(y))),
        (MathFunction::Max, Literal::F32(x), Literal::F32(y)) => Some(Literal::F32(x.max(y))),
        (MathFunction::Min, Literal::U32(x), Literal::U32(y)) => Some(Literal::U32(x.min(y))),
        (MathFunction::Max, Literal::U32(x), Literal::U32(y)) => Some(Literal::U32(x.max(y))),
        (MathFunction::Min, Literal::I32(x), Literal::I32(y)) => Some(Literal::I32(x.min(y))),
        (MathFunction::Max, Literal::I32(x), Literal::I32(y)) => Some(Literal::I32(x.max(y))),
        _ => None,
    }
}

/// `mix` and `smoothstep`, as WGSL has them.
fn three(fun: MathFunction, x: f32, y: f32, z: f32) -> Option<f32> {
    let (x, y, z) = (plain(x)?, plain(y)?, plain(z)?);
    match fun {
        MathFunction::Mix => plain(x * (1.0 - z) + y * z),
        MathFunction::SmoothStep => {
            let t = plain((z - x) / (y - x))?.clamp(0.0, 1.0);
            plain(t * t * (3.0 - 2.0 * t))
        }
        _ => None,
    }
}

/// The function of each component of three values; a number stands for equal components.
fn triples(args: [&Known; 3], f: &impl Fn(f32, f32, f32) -> Option<f32>) -> Option<Known> {
    let number = |known: &Known, k: usize| match known {
        Known::Scalar(Literal::F32(x)) => Some(*x),
        _ => match known.part(k)? {
            Known::Scalar(Literal::F32(x)) => Some(*x),
            _ => None,
        },
    };
    let at = |k: usize| {
        let [x, y, z] = args.map(|known| number(known, k));
        f(x?, y?, z?).map(|value| Known::Scalar(Literal::F32(value)))
    };
    let composite = args.iter().find_map(|known| match known {
        Known::Composite(ty, parts) => Some((*ty, parts.len())),
        Known::Scalar(_) => None,
    });
    match composite {
        None => at(0),
        Some((ty, count)) => {
            let parts: Option<Vec<Known>> = (0..count).map(at).collect();
            Some(Known::Composite(ty, parts?))
        }
    }
}

/// A function of whole vectors; `None` for others, and `Some(None)` where it has no plain value.
fn geometry(fun: MathFunction, args: &[&Known]) -> Option<Option<Known>> {
    use MathFunction as F;
    let vectors: Option<Vec<Vec<f32>>> = args.iter().map(|known| numbers(known)).collect();
    let scalar = |x: Option<f32>| x.map(|x| Known::Scalar(Literal::F32(x)));
    let like_first = |parts: Option<Vec<f32>>| match args[0] {
        Known::Composite(ty, _) => {
            let known = |x| Known::Scalar(Literal::F32(x));
            parts.map(|parts| Known::Composite(*ty, parts.into_iter().map(known).collect()))
        }
        Known::Scalar(_) => None,
    };
    let wanted = matches!(
        fun,
        F::Dot | F::Length | F::Distance | F::Normalize | F::Cross
    );
    let Some(vectors) = vectors.filter(|_| wanted) else {
        return wanted.then_some(None);
    };
    Some(match (fun, vectors.as_slice()) {
        (F::Dot, [a, b]) => scalar(dot(a, b)),
        (F::Length, [a]) => scalar(length(a)),
        (F::Distance, [a, b]) => {
            let apart: Option<Vec<f32>> = a.iter().zip(b).map(|(x, y)| plain(x - y)).collect();
            scalar(apart.and_then(|v| length(&v)))
        }
        (F::Normalize, [a]) => {
            let size = length(a).filter(|&size| size != 0.0);
            like_first(size.and_then(|size| a.iter().map(|x| plain(x / size)).collect()))
        }
        (F::Cross, [a, b]) if a.len() == 3 && b.len() == 3 => {
            let part = |(i, j): (usize, usize)| {
                let (first, second) = (plain(a[i] * b[j])?, plain(a[j] * b[i])?);
                plain(first - second)
            };
            like_first([(1, 2), (2, 0), (0, 1)].into_iter().map(part).collect())
        }
        _ => None,
    })
}

/// The components of a vector of plain numbers.
fn numbers(known: &Known) -> Option<Vec<f32>> {
    let Known::Composite(_, parts) = known else {
        return None;
    };
    let number = |part: &Known| match part {
        Known::Scalar(Literal::F32(x)) => plain(*x),
        _ => None,
    };
    parts.iter().map(number).collect()
}

fn dot(a: &[f32], b: &[f32]) -> Option<f32> {
    let mut terms = a.iter().zip(b).map(|(x, y)| plain(x * y));
    let first = terms.next()??;
    terms.try_fold(first, |sum, term| plain(sum + term?))
}

fn length(a: &[f32]) -> Option<f32> {
    dot(a, a).map(f32::sqrt)
}
