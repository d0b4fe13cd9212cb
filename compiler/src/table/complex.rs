//! Parts of complex numbers.

use naga::MathFunction;

use super::{Derivative, Gpu, Row, Typing, Weight};
use crate::ir::Prim;

pub fn rows() -> Vec<Row> {
    vec![
        Row {
            prim: Prim::Complex,
            mnemonic: "complex",
            names: &["complex"],
            usage: "complex(x, y)",
            doc: "x + i y",
            typing: Typing::MakeComplex,
            real: None,
            complex: None,
            derivative: Derivative::Structural,
            gpu: Gpu::Structural,
            gpu_complex: "",
            cost: Weight {
                real: 0,
                complex: 0,
            },
        },
        Row {
            prim: Prim::Re,
            mnemonic: "re",
            names: &["re", "real"],
            usage: "re(z)",
            doc: "real part",
            typing: Typing::Part,
            real: Some(|a| a[0]),
            complex: None,
            derivative: Derivative::Structural,
            gpu: Gpu::Structural,
            gpu_complex: "",
            cost: Weight {
                real: 0,
                complex: 0,
            },
        },
        Row {
            prim: Prim::Im,
            mnemonic: "im",
            names: &["im", "imag"],
            usage: "im(z)",
            doc: "imaginary part",
            typing: Typing::Part,
            real: Some(|_| 0.0),
            complex: None,
            derivative: Derivative::Structural,
            gpu: Gpu::Structural,
            gpu_complex: "",
            cost: Weight {
                real: 0,
                complex: 0,
            },
        },
        Row {
            prim: Prim::Conj,
            mnemonic: "conj",
            names: &["conj"],
            usage: "conj(z)",
            doc: "complex conjugate",
            typing: Typing::Analytic(1),
            real: Some(|a| a[0]),
            complex: Some(|a| a[0].conj()),
            derivative: Derivative::Structural,
            gpu: Gpu::Structural,
            gpu_complex: "",
            cost: Weight {
                real: 0,
                complex: 1,
            },
        },
        Row {
            prim: Prim::Abs,
            mnemonic: "abs",
            names: &["abs"],
            usage: "|a|, abs(a)",
            doc: "absolute value or modulus; its derivative at 0 is 0",
            typing: Typing::Part,
            real: Some(|a| a[0].abs()),
            complex: None,
            derivative: Derivative::Structural,
            gpu: Gpu::Builtin(MathFunction::Abs),
            gpu_complex: "complex_abs",
            cost: Weight {
                real: 1,
                complex: 8,
            },
        },
        Row {
            prim: Prim::Arg,
            mnemonic: "arg",
            names: &["arg"],
            usage: "arg(z)",
            doc: "argument in [-π, π], cut along the negative real axis",
            typing: Typing::Part,
            real: Some(|a| 0.0_f64.atan2(a[0])),
            complex: None,
            derivative: Derivative::Structural,
            gpu: Gpu::Structural,
            gpu_complex: "complex_arg",
            cost: Weight {
                real: 2,
                complex: 16,
            },
        },
    ]
}
