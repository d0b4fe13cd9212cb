//! Circular functions and their inverses.

use naga::MathFunction;

use super::derivative::{call, plus, square};
use super::slope::direction;
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
            prim: Prim::Sec,
            mnemonic: "sec",
            names: &["sec"],
            usage: "sec(a)",
            doc: "secant, 1/cos(a)",
            typing: Typing::Analytic(1),
            real: Some(|a| 1.0 / real::cos(a[0])),
            complex: Some(|a| a[0].cos().inverse()),
            // sec tan: by the rule of quotients it is 0 · ∞ where cos overflows
            derivative: Derivative::Partial(|g, args, value, _| {
                let tan = call(g, Prim::Tan, args[0]);
                g.mul(value, tan)
            }),
            gpu: Gpu::Library("real_sec", None),
            gpu_complex: "complex_sec",
            cost: Weight {
                real: 12,
                complex: 44,
            },
        },
        Row {
            prim: Prim::Csc,
            mnemonic: "csc",
            names: &["csc"],
            usage: "csc(a)",
            doc: "cosecant, 1/sin(a)",
            typing: Typing::Analytic(1),
            real: Some(|a| 1.0 / real::sin(a[0])),
            complex: Some(|a| a[0].sin().inverse()),
            // -csc / tan
            derivative: Derivative::Partial(|g, args, value, _| {
                let tan = call(g, Prim::Tan, args[0]);
                let quotient = g.div(value, tan);
                g.neg(quotient)
            }),
            gpu: Gpu::Library("real_csc", None),
            gpu_complex: "complex_csc",
            cost: Weight {
                real: 12,
                complex: 44,
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
            derivative: Derivative::Partial(|g, args, _, _| call(g, Prim::AsinSlope, args[0])),
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
            derivative: Derivative::Partial(|g, args, _, _| {
                let slope = call(g, Prim::AsinSlope, args[0]);
                g.neg(slope)
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
            derivative: Derivative::Partial(|g, args, _, _| call(g, Prim::AtanSlope, args[0])),
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
    ]
}

/// 1 + tan² a for reals; for complex numbers 1/cos² a, which does not cancel where tan a is near ±i.
fn tan_partial(g: &mut Graph, args: &[Id], value: Id, _: usize) -> Id {
    if g.ty(value) == Ty::Real {
        let square = square(g, value);
        return plus(g, square, 1.0);
    }
    let sec = call(g, Prim::Sec, args[0]);
    square(g, sec)
}

/// ∂/∂y = (x/r)/r and ∂/∂x = -(y/r)/r with r = hypot(x, y), which neither overflow nor underflow early.
fn atan2_partial(g: &mut Graph, args: &[Id], _: Id, k: usize) -> Id {
    let &[y, x] = args else { return args[0] };
    let r = g.apply(Prim::Hypot, &[x, y]);
    let cosine = direction(g, &[x, y], k, r);
    let rate = g.div(cosine, r);
    if k == 0 { rate } else { g.neg(rate) }
}
