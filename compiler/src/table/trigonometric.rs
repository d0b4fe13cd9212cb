//! Circular functions and their inverses.

use naga::MathFunction;

use super::derivative::{call, plus, reciprocal, sqrt_one_minus_square, square, turn};
use super::{Derivative, Gpu, Row, Typing, Weight};
use crate::ir::{Graph, Id, Prim, Ty};
use crate::reference::real;

pub fn rows() -> Vec<Row> {
    vec![
        Row {
            prim: Prim::Sin,
            mnemonic: "sin",
            names: &["sin"],
            usage: "sin(a)",
            doc: "sine",
            typing: Typing::Analytic(1),
            real: Some(|a| real::sin(a[0])),
            complex: Some(|a| a[0].sin()),
            derivative: Derivative::Partial(|g, args, _, _| call(g, Prim::Cos, args[0])),
            gpu: Gpu::Library("real_sin", Some(MathFunction::Sin)),
            gpu_complex: "complex_sin",
            cost: Weight {
                real: 8,
                complex: 34,
            },
        },
        Row {
            prim: Prim::Cos,
            mnemonic: "cos",
            names: &["cos"],
            usage: "cos(a)",
            doc: "cosine",
            typing: Typing::Analytic(1),
            real: Some(|a| real::cos(a[0])),
            complex: Some(|a| a[0].cos()),
            derivative: Derivative::Partial(|g, args, _, _| {
                let sin = call(g, Prim::Sin, args[0]);
                g.neg(sin)
            }),
            gpu: Gpu::Library("real_cos", Some(MathFunction::Cos)),
            gpu_complex: "complex_cos",
            cost: Weight {
                real: 8,
                complex: 34,
            },
        },
        Row {
            prim: Prim::Tan,
            mnemonic: "tan",
            names: &["tan"],
            usage: "tan(a)",
            doc: "tangent",
            typing: Typing::Analytic(1),
            real: Some(|a| real::tan(a[0])),
            complex: Some(|a| a[0].tan()),
            derivative: Derivative::Partial(tan_partial),
            gpu: Gpu::Library("real_tan", Some(MathFunction::Tan)),
            gpu_complex: "complex_tan",
            cost: Weight {
                real: 12,
                complex: 40,
            },
        },
        Row {
            prim: Prim::Asin,
            mnemonic: "asin",
            names: &["asin", "arcsin"],
            usage: "asin(a)",
            doc: "inverse sine; NaN for reals beyond [-1, 1], cuts there on the real axis",
            typing: Typing::Analytic(1),
            real: Some(|a| real::asin(a[0])),
            complex: Some(|a| a[0].asin()),
            // 1 / √(1 - a²)
            derivative: Derivative::Partial(|g, args, _, _| {
                let root = sqrt_one_minus_square(g, args[0]);
                reciprocal(g, root)
            }),
            gpu: Gpu::Library("real_asin", Some(MathFunction::Asin)),
            gpu_complex: "complex_asin",
            cost: Weight {
                real: 12,
                complex: 60,
            },
        },
        Row {
            prim: Prim::Acos,
            mnemonic: "acos",
            names: &["acos", "arccos"],
            usage: "acos(a)",
            doc: "inverse cosine; NaN for reals beyond [-1, 1], cuts there on the real axis",
            typing: Typing::Analytic(1),
            real: Some(|a| real::acos(a[0])),
            complex: Some(|a| a[0].acos()),
            // -1 / √(1 - a²)
            derivative: Derivative::Partial(|g, args, _, _| {
                let root = sqrt_one_minus_square(g, args[0]);
                let minus = g.real(-1.0);
                g.div(minus, root)
            }),
            gpu: Gpu::Library("real_acos", Some(MathFunction::Acos)),
            gpu_complex: "complex_acos",
            cost: Weight {
                real: 12,
                complex: 60,
            },
        },
        Row {
            prim: Prim::Atan,
            mnemonic: "atan",
            names: &["atan", "arctan"],
            usage: "atan(a)",
            doc: "inverse tangent, cuts on the imaginary axis beyond ±i",
            typing: Typing::Analytic(1),
            real: Some(|a| real::atan(a[0])),
            complex: Some(|a| a[0].atan()),
            derivative: Derivative::Partial(atan_partial),
            gpu: Gpu::Library("real_atan", Some(MathFunction::Atan)),
            gpu_complex: "complex_atan",
            cost: Weight {
                real: 12,
                complex: 50,
            },
        },
        Row {
            prim: Prim::Atan2,
            mnemonic: "atan2",
            names: &["atan2"],
            usage: "atan2(y, x)",
            doc: "angle of the point (x, y), in [-π, π]",
            typing: Typing::Real(2),
            real: Some(|a| real::atan2(a[0], a[1])),
            complex: None,
            derivative: Derivative::Partial(atan2_partial),
            gpu: Gpu::Library("real_atan2", Some(MathFunction::Atan2)),
            gpu_complex: "",
            cost: Weight {
                real: 16,
                complex: 0,
            },
        },
        Row {
            prim: Prim::Sinc,
            mnemonic: "sinc",
            names: &["sinc"],
            usage: "sinc(x)",
            doc: "sin(x)/x, and 1 at 0",
            typing: Typing::Real(1),
            real: Some(|a| real::sinc(a[0])),
            complex: None,
            derivative: Derivative::Partial(sinc_partial),
            gpu: Gpu::Library("real_sinc", None),
            gpu_complex: "",
            cost: Weight {
                real: 12,
                complex: 0,
            },
        },
    ]
}

/// 1 + tan² a for reals; for complex numbers 1/cos² a, which does not cancel where tan a is near ±i.
fn tan_partial(g: &mut Graph, args: &[Id], value: Id, _: usize) -> Id {
    if g.ty(value) == Ty::Real {
        let square = square(g, value);
        return plus(g, square, 1.0);
    }
    let cos = call(g, Prim::Cos, args[0]);
    let sec = reciprocal(g, cos);
    square(g, sec)
}

/// 1 / (1 + a²); for complex numbers as 1/(1 + i a) · 1/(1 - i a), whose factors do not overflow.
fn atan_partial(g: &mut Graph, args: &[Id], _: Id, _: usize) -> Id {
    if g.ty(args[0]) == Ty::Real {
        let square = square(g, args[0]);
        let sum = plus(g, square, 1.0);
        return reciprocal(g, sum);
    }
    let turned = turn(g, args[0]);
    let above = plus(g, turned, 1.0);
    let one = g.real(1.0);
    let below = g.sub(one, turned);
    let (above, below) = (reciprocal(g, above), reciprocal(g, below));
    g.mul(above, below)
}

/// ∂/∂y = (x/r)/r and ∂/∂x = -(y/r)/r with r = hypot(x, y), which neither overflow nor underflow early.
fn atan2_partial(g: &mut Graph, args: &[Id], _: Id, k: usize) -> Id {
    let &[y, x] = args else { return args[0] };
    let r = g.apply(Prim::Hypot, &[x, y]);
    let numerator = if k == 0 { x } else { g.neg(y) };
    let cosine = g.div(numerator, r);
    g.div(cosine, r)
}

/// (cos x - sinc x)/x away from 0; for |x| < 1 its Taylor series Σ (-1)ᵏ 2k x²ᵏ⁻¹/(2k+1)!, whose first omitted
/// term is below 2⁻⁵³ of the first.
fn sinc_partial(g: &mut Graph, args: &[Id], value: Id, _: usize) -> Id {
    let x = args[0];
    let xx = square(g, x);
    let mut series = g.real(0.0);
    for k in (1..=9_i32).rev() {
        let factorial: f64 = (1..=2 * k + 1).map(f64::from).product();
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        let coefficient = g.real(sign * 2.0 * f64::from(k) / factorial);
        let product = g.mul(series, xx);
        series = g.add(coefficient, product);
    }
    let near = g.mul(series, x);
    let cos = call(g, Prim::Cos, x);
    let difference = g.sub(cos, value);
    let far = g.div(difference, x);
    let size = call(g, Prim::Abs, x);
    let one = g.real(1.0);
    let small = g.apply(Prim::Less, &[size, one]);
    g.apply(Prim::Select, &[small, near, far])
}
