//! Exponentials and logarithms.

use std::f64::consts::{LN_2, LN_10};

use naga::MathFunction;

use super::derivative::{call, plus, reciprocal, scaled};
use super::{Derivative, Gpu, Row, Typing, Weight};
use crate::ir::Prim;
use crate::reference::real;

pub fn rows() -> Vec<Row> {
    vec![
        Row {
            prim: Prim::Exp,
            mnemonic: "exp",
            names: &["exp"],
            usage: "exp(a)",
            doc: "exponential",
            typing: Typing::Analytic(1),
            real: Some(|a| real::exp(a[0])),
            complex: Some(|a| a[0].exp()),
            derivative: Derivative::Partial(|_, _, value, _| value),
            gpu: Gpu::Library("real_exp", Some(MathFunction::Exp)),
            gpu_complex: "complex_exp",
            cost: Weight {
                real: 8,
                complex: 26,
            },
        },
        Row {
            prim: Prim::Exp2,
            mnemonic: "exp2",
            names: &["exp2"],
            usage: "exp2(x)",
            doc: "2 to the power x",
            typing: Typing::Real(1),
            real: Some(|a| real::exp2(a[0])),
            complex: None,
            // ln 2 · 2^x
            derivative: Derivative::Partial(|g, _, value, _| scaled(g, LN_2, value)),
            gpu: Gpu::Library("real_exp2", Some(MathFunction::Exp2)),
            gpu_complex: "",
            cost: Weight {
                real: 8,
                complex: 0,
            },
        },
        Row {
            prim: Prim::Expm1,
            mnemonic: "expm1",
            names: &["expm1"],
            usage: "expm1(a)",
            doc: "exp(a) - 1 without cancellation near 0",
            typing: Typing::Analytic(1),
            real: Some(|a| real::expm1(a[0])),
            complex: Some(|a| a[0].expm1()),
            derivative: Derivative::Partial(|g, args, _, _| call(g, Prim::Exp, args[0])),
            gpu: Gpu::Library("real_expm1", None),
            gpu_complex: "complex_expm1",
            cost: Weight {
                real: 12,
                complex: 34,
            },
        },
        Row {
            prim: Prim::Log,
            mnemonic: "log",
            names: &["log", "ln"],
            usage: "log(a), ln(a)",
            doc: "natural logarithm, cut along the negative real axis; NaN for negative reals",
            typing: Typing::Analytic(1),
            real: Some(|a| real::log(a[0])),
            complex: Some(|a| a[0].log()),
            derivative: Derivative::Partial(|g, args, _, _| reciprocal(g, args[0])),
            gpu: Gpu::Library("real_log", Some(MathFunction::Log)),
            gpu_complex: "complex_log",
            cost: Weight {
                real: 8,
                complex: 26,
            },
        },
        Row {
            prim: Prim::Log2,
            mnemonic: "log2",
            names: &["log2", "lb"],
            usage: "log2(x)",
            doc: "logarithm to base 2",
            typing: Typing::Real(1),
            real: Some(|a| real::log2(a[0])),
            complex: None,
            // 1 / (x ln 2)
            derivative: Derivative::Partial(|g, args, _, _| {
                let scale = g.real(1.0 / LN_2);
                g.div(scale, args[0])
            }),
            gpu: Gpu::Library("real_log2", Some(MathFunction::Log2)),
            gpu_complex: "",
            cost: Weight {
                real: 8,
                complex: 0,
            },
        },
        Row {
            prim: Prim::Log10,
            mnemonic: "log10",
            names: &["log10", "lg"],
            usage: "log10(x)",
            doc: "logarithm to base 10",
            typing: Typing::Real(1),
            real: Some(|a| real::log10(a[0])),
            complex: None,
            // 1 / (x ln 10)
            derivative: Derivative::Partial(|g, args, _, _| {
                let scale = g.real(1.0 / LN_10);
                g.div(scale, args[0])
            }),
            gpu: Gpu::Library("real_log10", None),
            gpu_complex: "",
            cost: Weight {
                real: 9,
                complex: 0,
            },
        },
        Row {
            prim: Prim::Log1p,
            mnemonic: "log1p",
            names: &["log1p"],
            usage: "log1p(a)",
            doc: "log(1 + a) without cancellation near 0, cut as that",
            typing: Typing::Analytic(1),
            real: Some(|a| real::log1p(a[0])),
            complex: Some(|a| a[0].log1p()),
            derivative: Derivative::Partial(|g, args, _, _| {
                let sum = plus(g, args[0], 1.0);
                reciprocal(g, sum)
            }),
            gpu: Gpu::Library("real_log1p", None),
            gpu_complex: "complex_log1p",
            cost: Weight {
                real: 12,
                complex: 34,
            },
        },
    ]
}
