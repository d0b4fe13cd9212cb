//! Hyperbolic functions and their inverses.

use naga::MathFunction;

use super::derivative::{call, from, plus, reciprocal, square, turn};
use super::{Derivative, Gpu, Row, Typing, Weight};
use crate::ir::{Graph, Id, Prim, Ty};
use crate::reference::real;

pub fn rows() -> Vec<Row> {
    vec![
        Row {
            prim: Prim::Sinh,
            mnemonic: "sinh",
            names: &["sinh"],
            usage: "sinh(a)",
            doc: "hyperbolic sine",
            typing: Typing::Analytic(1),
            real: Some(|a| real::sinh(a[0])),
            complex: Some(|a| a[0].sinh()),
            derivative: Derivative::Partial(|g, args, _, _| call(g, Prim::Cosh, args[0])),
            gpu: Gpu::Library("real_sinh", Some(MathFunction::Sinh)),
            gpu_complex: "complex_sinh",
            cost: Weight {
                real: 12,
                complex: 34,
            },
        },
        Row {
            prim: Prim::Cosh,
            mnemonic: "cosh",
            names: &["cosh"],
            usage: "cosh(a)",
            doc: "hyperbolic cosine",
            typing: Typing::Analytic(1),
            real: Some(|a| real::cosh(a[0])),
            complex: Some(|a| a[0].cosh()),
            derivative: Derivative::Partial(|g, args, _, _| call(g, Prim::Sinh, args[0])),
            gpu: Gpu::Library("real_cosh", Some(MathFunction::Cosh)),
            gpu_complex: "complex_cosh",
            cost: Weight {
                real: 12,
                complex: 34,
            },
        },
        Row {
            prim: Prim::Tanh,
            mnemonic: "tanh",
            names: &["tanh"],
            usage: "tanh(a)",
            doc: "hyperbolic tangent",
            typing: Typing::Analytic(1),
            real: Some(|a| real::tanh(a[0])),
            complex: Some(|a| a[0].tanh()),
            // 1/cosh² a: 1 - tanh² a cancels where tanh a is near ±1
            derivative: Derivative::Partial(|g, args, _, _| {
                let cosh = call(g, Prim::Cosh, args[0]);
                let sech = reciprocal(g, cosh);
                square(g, sech)
            }),
            gpu: Gpu::Library("real_tanh", Some(MathFunction::Tanh)),
            gpu_complex: "complex_tanh",
            cost: Weight {
                real: 12,
                complex: 40,
            },
        },
        Row {
            prim: Prim::Asinh,
            mnemonic: "asinh",
            names: &["asinh", "arsinh"],
            usage: "asinh(a)",
            doc: "inverse hyperbolic sine, cuts on the imaginary axis beyond ±i",
            typing: Typing::Analytic(1),
            real: Some(|a| real::asinh(a[0])),
            complex: Some(|a| a[0].asinh()),
            derivative: Derivative::Partial(asinh_partial),
            gpu: Gpu::Library("real_asinh", Some(MathFunction::Asinh)),
            gpu_complex: "complex_asinh",
            cost: Weight {
                real: 16,
                complex: 60,
            },
        },
        Row {
            prim: Prim::Acosh,
            mnemonic: "acosh",
            names: &["acosh", "arcosh"],
            usage: "acosh(a)",
            doc: "inverse hyperbolic cosine, cut on the real axis below 1; NaN for reals below 1",
            typing: Typing::Analytic(1),
            real: Some(|a| real::acosh(a[0])),
            complex: Some(|a| a[0].acosh()),
            // 1 / (√(a - 1) √(a + 1))
            derivative: Derivative::Partial(|g, args, _, _| {
                let (below, above) = (plus(g, args[0], -1.0), plus(g, args[0], 1.0));
                let (below, above) = (call(g, Prim::Sqrt, below), call(g, Prim::Sqrt, above));
                let root = g.mul(below, above);
                reciprocal(g, root)
            }),
            gpu: Gpu::Library("real_acosh", Some(MathFunction::Acosh)),
            gpu_complex: "complex_acosh",
            cost: Weight {
                real: 16,
                complex: 60,
            },
        },
        Row {
            prim: Prim::Atanh,
            mnemonic: "atanh",
            names: &["atanh", "artanh"],
            usage: "atanh(a)",
            doc: "inverse hyperbolic tangent, cuts on the real axis beyond ±1; NaN for reals there",
            typing: Typing::Analytic(1),
            real: Some(|a| real::atanh(a[0])),
            complex: Some(|a| a[0].atanh()),
            derivative: Derivative::Partial(atanh_partial),
            gpu: Gpu::Library("real_atanh", Some(MathFunction::Atanh)),
            gpu_complex: "complex_atanh",
            cost: Weight {
                real: 16,
                complex: 50,
            },
        },
    ]
}

/// 1 / √(1 + a²): 1/hypot(1, x) for reals, 1 / (√(1 + i a) √(1 - i a)) for complex numbers; neither overflows.
fn asinh_partial(g: &mut Graph, args: &[Id], _: Id, _: usize) -> Id {
    let one = g.real(1.0);
    if g.ty(args[0]) == Ty::Real {
        let root = g.apply(Prim::Hypot, &[one, args[0]]);
        return reciprocal(g, root);
    }
    let turned = turn(g, args[0]);
    let (above, below) = (plus(g, turned, 1.0), from(g, 1.0, turned));
    let (above, below) = (call(g, Prim::Sqrt, above), call(g, Prim::Sqrt, below));
    let root = g.mul(above, below);
    reciprocal(g, root)
}

/// 1 / ((1 - a)(1 + a)); for complex numbers by factors, which do not overflow.
fn atanh_partial(g: &mut Graph, args: &[Id], _: Id, _: usize) -> Id {
    let (below, above) = (from(g, 1.0, args[0]), plus(g, args[0], 1.0));
    if g.ty(args[0]) == Ty::Real {
        let product = g.mul(below, above);
        return reciprocal(g, product);
    }
    let (below, above) = (reciprocal(g, below), reciprocal(g, above));
    g.mul(below, above)
}
