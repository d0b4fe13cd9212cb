//! Where special functions are not numbers, as far as a constant operand tells.

use crate::ir::Prim;

/// The greatest imaginary part of the argument of zeta functions.
const STRIP: f64 = 500.0;
const UPPER: &str = "τ must lie above the real axis";
const IN_STRIP: &str = "|im s| must be at most 500";

/// What an operation asks of its operands that these are not; operands that are no constants are `None`, others real and
/// imaginary part.
#[must_use]
pub fn outside(prim: Prim, args: &[Option<(f64, f64)>]) -> Option<&'static str> {
    let at = |k: usize| args.get(k).copied().flatten();
    match prim {
        Prim::JacobiTheta1(_)
        | Prim::JacobiTheta2(_)
        | Prim::JacobiTheta3(_)
        | Prim::JacobiTheta4(_) => {
            let (re, im) = at(1)?;
            (re.hypot(im) >= 1.0).then_some("|q| must be below 1")
        }
        Prim::WeierstrassP(_) => (at(1)?.1 <= 0.0).then_some(UPPER),
        Prim::EisensteinE2(_)
        | Prim::EisensteinE4(_)
        | Prim::EisensteinE6(_)
        | Prim::KleinJ
        | Prim::DedekindEta
        | Prim::ModularLambda => (at(0)?.1 <= 0.0).then_some(UPPER),
        Prim::Zeta(_) | Prim::DirichletEta(_) | Prim::DirichletBeta(_) => {
            (at(0)?.1.abs() > STRIP).then_some(IN_STRIP)
        }
        Prim::HurwitzZeta(_) => hurwitz(at(0), at(1)),
        Prim::EulerBeta => {
            let left = [at(0), at(1)].into_iter().flatten().any(|a| a.0 < -32.0);
            left.then_some("a and b must lie right of -32")
        }
        Prim::Hypergeometric(_) => hypergeometric([at(0), at(1), at(2), at(3)]),
        _ => None,
    }
}

fn hurwitz(s: Option<(f64, f64)>, a: Option<(f64, f64)>) -> Option<&'static str> {
    if a.is_some_and(|(re, im)| re <= 0.0 || im != 0.0) {
        return Some("a must be real and positive");
    }
    let (re, im) = s?;
    if re < 0.0 {
        return Some("re s must not be negative");
    }
    (im.abs() > STRIP).then_some(IN_STRIP)
}

fn hypergeometric([a, b, c, z]: [Option<(f64, f64)>; 4]) -> Option<&'static str> {
    let ends = |v: Option<(f64, f64)>| match v {
        Some((re, im)) => im == 0.0 && re <= 0.0 && re == re.round(),
        None => false,
    };
    // a series that ends is a polynomial
    if ends(a) || ends(b) {
        return None;
    }
    if ends(c) {
        return Some("c must not be 0, -1, …");
    }
    let (re, im) = z?;
    let size = re.hypot(im);
    let turned = size / (re - 1.0).hypot(im);
    (size >= 0.97 && turned >= 0.97).then_some("|z| or |z/(z - 1)| must be below 0.97")
}
