//! Hyperbolic functions and their inverses.

use naga::MathFunction;

use super::derivative::{call, square};
use super::{Derivative, Gpu, Row, Typing, Weight};
use crate::ir::Prim;
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
            // sech² a: 1 - tanh² a cancels where tanh a is near ±1
            derivative: Derivative::Partial(|g, args, _, _| {
                let sech = call(g, Prim::Sech, args[0]);
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
            prim: Prim::Sech,
            mnemonic: "sech",
            names: &["sech"],
            usage: "sech(a)",
            doc: "hyperbolic secant, 1/cosh(a)",
            typing: Typing::Analytic(1),
            real: Some(|a| 1.0 / real::cosh(a[0])),
            complex: Some(|a| a[0].cosh().inverse()),
            // -sech tanh: by the rule of quotients it is 0 · ∞ where cosh overflows
            derivative: Derivative::Partial(|g, args, value, _| {
                let tanh = call(g, Prim::Tanh, args[0]);
                let product = g.mul(value, tanh);
                g.neg(product)
            }),
            gpu: Gpu::Library("real_sech", None),
            gpu_complex: "complex_sech",
            cost: Weight {
                real: 16,
                complex: 44,
            },
        },
        Row {
            prim: Prim::Csch,
            mnemonic: "csch",
            names: &["csch"],
            usage: "csch(a)",
            doc: "hyperbolic cosecant, 1/sinh(a)",
            typing: Typing::Analytic(1),
            real: Some(|a| 1.0 / real::sinh(a[0])),
            complex: Some(|a| a[0].sinh().inverse()),
            // -csch / tanh
            derivative: Derivative::Partial(|g, args, value, _| {
                let tanh = call(g, Prim::Tanh, args[0]);
                let quotient = g.div(value, tanh);
                g.neg(quotient)
            }),
            gpu: Gpu::Library("real_csch", None),
            gpu_complex: "complex_csch",
            cost: Weight {
                real: 16,
                complex: 44,
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
            derivative: Derivative::Partial(|g, args, _, _| call(g, Prim::AsinhSlope, args[0])),
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
            derivative: Derivative::Partial(|g, args, _, _| call(g, Prim::AcoshSlope, args[0])),
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
            derivative: Derivative::Partial(|g, args, _, _| call(g, Prim::AtanhSlope, args[0])),
            gpu: Gpu::Library("real_atanh", Some(MathFunction::Atanh)),
            gpu_complex: "complex_atanh",
            cost: Weight {
                real: 16,
                complex: 50,
            },
        },
    ]
}
