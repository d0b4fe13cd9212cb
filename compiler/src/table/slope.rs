//! Slopes: derivatives of other rows that are operations of their own, so that they can be differentiated again.
//!
//! Written out by sums and quotients, the derivative of 1/√((1 - x)(1 + x)) is a difference of 1 + x and 1 - x, and
//! that of x/√(x² + y²) has the factor 1 - (x/r)²: both lose every digit near 0. The rules here do not cancel.

use super::derivative::{call, nonzero, plus, scaled};
use super::{Derivative, Gpu, Row, Typing, Weight};
use crate::ir::{Graph, Id, Prim};
use crate::reference::slope;

pub fn rows() -> Vec<Row> {
    vec![
        Row {
            prim: Prim::PowShift,
            mnemonic: "pow_shift",
            names: &[],
            usage: "",
            doc: "a^(b + c) for a whole constant c, the sum not rounded: powers in the derivatives of a^b",
            typing: Typing::Analytic(3),
            real: Some(|a| slope::pow_shift(a[0], a[1], a[2])),
            complex: Some(|a| slope::complex_pow_shift(a[0], a[1], a[2])),
            derivative: Derivative::Partial(pow_shift_partial),
            gpu: Gpu::Library("real_pow_shift", None),
            gpu_complex: "complex_pow_shift",
            cost: Weight {
                real: 18,
                complex: 62,
            },
        },
        Row {
            prim: Prim::AtanSlope,
            mnemonic: "atan_slope",
            names: &[],
            usage: "",
            doc: "1/(1 + a²), the derivative of atan",
            typing: Typing::Analytic(1),
            real: Some(|a| slope::atan(a[0])),
            complex: Some(|a| slope::complex_atan(a[0])),
            // -2 a v²
            derivative: Derivative::Partial(|g, args, value, _| quadratic(g, -2.0, args[0], value)),
            gpu: Gpu::Library("real_atan_slope", None),
            gpu_complex: "complex_atan_slope",
            cost: Weight {
                real: 6,
                complex: 36,
            },
        },
        Row {
            prim: Prim::AtanhSlope,
            mnemonic: "atanh_slope",
            names: &[],
            usage: "",
            doc: "1/(1 - a²), the derivative of atanh",
            typing: Typing::Analytic(1),
            real: Some(|a| slope::atanh(a[0])),
            complex: Some(|a| slope::complex_atanh(a[0])),
            // 2 a v²
            derivative: Derivative::Partial(|g, args, value, _| quadratic(g, 2.0, args[0], value)),
            gpu: Gpu::Library("real_atanh_slope", None),
            gpu_complex: "complex_atanh_slope",
            cost: Weight {
                real: 7,
                complex: 36,
            },
        },
        Row {
            prim: Prim::AsinSlope,
            mnemonic: "asin_slope",
            names: &[],
            usage: "",
            doc: "1/√(1 - a²) with the cuts of asin, whose derivative it is",
            typing: Typing::Analytic(1),
            real: Some(|a| slope::asin(a[0])),
            complex: Some(|a| slope::complex_asin(a[0])),
            // a v³
            derivative: Derivative::Partial(|g, args, value, _| cubic(g, args[0], value)),
            gpu: Gpu::Library("real_asin_slope", None),
            gpu_complex: "complex_asin_slope",
            cost: Weight {
                real: 11,
                complex: 62,
            },
        },
        Row {
            prim: Prim::AsinhSlope,
            mnemonic: "asinh_slope",
            names: &[],
            usage: "",
            doc: "1/√(1 + a²) with the cuts of asinh, whose derivative it is",
            typing: Typing::Analytic(1),
            real: Some(|a| slope::asinh(a[0])),
            complex: Some(|a| slope::complex_asinh(a[0])),
            // -a v³
            derivative: Derivative::Partial(|g, args, value, _| {
                let product = cubic(g, args[0], value);
                g.neg(product)
            }),
            gpu: Gpu::Library("real_asinh_slope", None),
            gpu_complex: "complex_asinh_slope",
            cost: Weight {
                real: 12,
                complex: 62,
            },
        },
        Row {
            prim: Prim::AcoshSlope,
            mnemonic: "acosh_slope",
            names: &[],
            usage: "",
            doc: "1/(√(a - 1) √(a + 1)), the derivative of acosh",
            typing: Typing::Analytic(1),
            real: Some(|a| slope::acosh(a[0])),
            complex: Some(|a| slope::complex_acosh(a[0])),
            // -a v³
            derivative: Derivative::Partial(|g, args, value, _| {
                let product = cubic(g, args[0], value);
                g.neg(product)
            }),
            gpu: Gpu::Library("real_acosh_slope", None),
            gpu_complex: "complex_acosh_slope",
            cost: Weight {
                real: 15,
                complex: 62,
            },
        },
        Row {
            prim: Prim::Direction,
            mnemonic: "direction",
            names: &[],
            usage: "",
            doc: "x/r for r = hypot(x, y), the derivative of hypot; 0 at the origin",
            typing: Typing::Real(3),
            real: Some(|a| slope::direction(a[0], a[1], 0.0, a[2])),
            complex: None,
            derivative: Derivative::Partial(direction_partial),
            gpu: Gpu::Library("real_direction", None),
            gpu_complex: "",
            cost: Weight {
                real: 5,
                complex: 0,
            },
        },
        Row {
            prim: Prim::Direction3,
            mnemonic: "direction3",
            names: &[],
            usage: "",
            doc: "x/r for r = |(x, y, z)|, the derivative of the length; 0 at the origin",
            typing: Typing::Real(4),
            real: Some(|a| slope::direction(a[0], a[1], a[2], a[3])),
            complex: None,
            derivative: Derivative::Partial(direction3_partial),
            gpu: Gpu::Library("real_direction3", None),
            gpu_complex: "",
            cost: Weight {
                real: 5,
                complex: 0,
            },
        },
    ]
}

/// ∂(a^(b+c)): as of a power; c is a constant.
fn pow_shift_partial(g: &mut Graph, args: &[Id], value: Id, k: usize) -> Id {
    let &[base, exponent, shift] = args else {
        return value;
    };
    let Some(constant) = g
        .as_real(shift)
        .or_else(|| g.as_complex(shift).map(|(re, _)| re))
    else {
        return g.real(f64::NAN);
    };
    if k == 2 {
        return g.real(0.0);
    }
    power_partial(g, base, exponent, constant, value, k)
}

/// For the value v = a^(b+c): ∂v/∂a = (b + c) a^(b+c-1), and 0 where a and b + c are; ∂v/∂b = v log a, and 0 at a = 0.
/// A rounded b + c - 1 would cost |b log a| units: the sum is carried.
pub fn power_partial(g: &mut Graph, a: Id, b: Id, c: f64, value: Id, k: usize) -> Id {
    let is_complex = g.ty(a) == crate::ir::Ty::Complex;
    let constant = |g: &mut Graph, v: f64| {
        if is_complex {
            g.complex(v, 0.0)
        } else {
            g.real(v)
        }
    };
    let zero = constant(g, 0.0);
    let at_zero = g.apply(Prim::Equal, &[a, zero]);
    if k == 0 {
        let factor = if c == 0.0 { b } else { plus(g, b, c) };
        let power = shifted_power(g, a, b, c - 1.0);
        let product = g.mul(factor, power);
        // only there: for b = 0 alone the mixed derivative 1/a would be lost
        let flat = g.apply(Prim::Equal, &[factor, zero]);
        let both = g.apply(Prim::And, &[flat, at_zero]);
        return g.apply(Prim::Select, &[both, zero, product]);
    }
    let log = call(g, Prim::Log, a);
    let product = g.mul(value, log);
    g.apply(Prim::Select, &[at_zero, zero, product])
}

/// a^(b + c); as a plain power where b is a constant and nothing is rounded.
fn shifted_power(g: &mut Graph, a: Id, b: Id, c: f64) -> Id {
    let short = |v: f64| f64::from(v as f32) == v;
    let known = match g.as_complex(b) {
        Some((re, im)) => Some((re, im)),
        None => g.as_real(b).map(|re| (re, 0.0)),
    };
    let is_complex = g.ty(a) == crate::ir::Ty::Complex;
    if let Some((re, im)) = known.filter(|&(re, _)| short(re) && short(re + c)) {
        let sum = if is_complex {
            g.complex(re + c, im)
        } else {
            g.real(re + c)
        };
        return g.apply(Prim::Pow, &[a, sum]);
    }
    let shift = if is_complex {
        g.complex(c, 0.0)
    } else {
        g.real(c)
    };
    g.apply(Prim::PowShift, &[a, b, shift])
}

/// c · a v², as (a v) v: neither factor overflows before the product does.
fn quadratic(g: &mut Graph, c: f64, a: Id, v: Id) -> Id {
    let once = g.mul(a, v);
    let twice = g.mul(once, v);
    scaled(g, c, twice)
}

/// a v³, likewise.
fn cubic(g: &mut Graph, a: Id, v: Id) -> Id {
    let once = g.mul(a, v);
    let twice = g.mul(once, v);
    g.mul(twice, v)
}

/// ∂(x/r)/∂x = (y/r)²/r and ∂(x/r)/∂y = -(x/r)(y/r)/r. By the third operand, the length of the first two, nothing:
/// what its change adds is counted with them.
fn direction_partial(g: &mut Graph, args: &[Id], value: Id, k: usize) -> Id {
    let &[x, y, r] = args else { return value };
    if k == 2 {
        return g.real(0.0);
    }
    let sine = g.apply(Prim::Direction, &[y, x, r]);
    turn_rate(g, if k == 0 { sine } else { value }, sine, r, k == 0)
}

/// ∂(x/r)/∂x = (h/r)²/r with h = hypot(y, z), and ∂(x/r)/∂y = -(x/r)(y/r)/r.
fn direction3_partial(g: &mut Graph, args: &[Id], value: Id, k: usize) -> Id {
    let &[x, y, z, r] = args else { return value };
    match k {
        0 => {
            let h = g.apply(Prim::Hypot, &[y, z]);
            let sine = g.apply(Prim::Direction, &[h, x, r]);
            turn_rate(g, sine, sine, r, true)
        }
        1 => {
            let sine = g.apply(Prim::Direction3, &[y, x, z, r]);
            turn_rate(g, value, sine, r, false)
        }
        2 => {
            let sine = g.apply(Prim::Direction3, &[z, x, y, r]);
            turn_rate(g, value, sine, r, false)
        }
        _ => g.real(0.0),
    }
}

/// ±a (b/r), and 0 where r is: the quotient first, for a b may underflow where this does not.
fn turn_rate(g: &mut Graph, a: Id, b: Id, r: Id, positive: bool) -> Id {
    let divisor = nonzero(g, r);
    let rate = g.div(b, divisor);
    let product = g.mul(a, rate);
    if positive { product } else { g.neg(product) }
}

/// x/r, for the length r of a point with the coordinate x; 0 at the origin.
pub fn direction(g: &mut Graph, point: &[Id], k: usize, length: Id) -> Id {
    match (point, k) {
        (&[x, y], 0) | (&[y, x], 1) => g.apply(Prim::Direction, &[x, y, length]),
        (&[x, y, z], 0) | (&[y, x, z], 1) | (&[y, z, x], 2) => {
            g.apply(Prim::Direction3, &[x, y, z, length])
        }
        _ => g.real(f64::NAN),
    }
}
