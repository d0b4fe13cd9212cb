//! Rounding, remainders, signs, minimum and maximum, and numbers for lattice points.

use naga::MathFunction;

use super::{Derivative, Gpu, Row, Typing, Weight};
use crate::ir::Prim;
use crate::reference::hash::hash;
use crate::reference::real;

const CHEAP: Weight = Weight {
    real: 1,
    complex: 0,
};

pub fn rows() -> Vec<Row> {
    vec![
        Row {
            prim: Prim::Floor,
            mnemonic: "floor",
            names: &["floor"],
            usage: "floor(x)",
            doc: "greatest integer not above x",
            typing: Typing::Real(1),
            real: Some(|a| a[0].floor()),
            complex: None,
            derivative: Derivative::Zero,
            gpu: Gpu::Builtin(MathFunction::Floor),
            gpu_complex: "",
            cost: CHEAP,
        },
        Row {
            prim: Prim::Ceil,
            mnemonic: "ceil",
            names: &["ceil"],
            usage: "ceil(x)",
            doc: "least integer not below x",
            typing: Typing::Real(1),
            real: Some(|a| a[0].ceil()),
            complex: None,
            derivative: Derivative::Zero,
            gpu: Gpu::Builtin(MathFunction::Ceil),
            gpu_complex: "",
            cost: CHEAP,
        },
        Row {
            prim: Prim::Round,
            mnemonic: "round",
            names: &["round"],
            usage: "round(x)",
            doc: "nearest integer, halves away from zero",
            typing: Typing::Real(1),
            real: Some(|a| real::round(a[0])),
            complex: None,
            derivative: Derivative::Zero,
            gpu: Gpu::Library("real_round", None),
            gpu_complex: "",
            cost: Weight {
                real: 3,
                complex: 0,
            },
        },
        Row {
            prim: Prim::Trunc,
            mnemonic: "trunc",
            names: &["trunc"],
            usage: "trunc(x)",
            doc: "x without its fraction",
            typing: Typing::Real(1),
            real: Some(|a| a[0].trunc()),
            complex: None,
            derivative: Derivative::Zero,
            gpu: Gpu::Builtin(MathFunction::Trunc),
            gpu_complex: "",
            cost: CHEAP,
        },
        Row {
            prim: Prim::Fract,
            mnemonic: "fract",
            names: &["fract", "frac"],
            usage: "fract(x)",
            doc: "x - floor(x), below 1 always",
            typing: Typing::Real(1),
            real: Some(|a| real::fract(a[0])),
            complex: None,
            derivative: Derivative::Partial(|g, _, _, _| g.real(1.0)),
            gpu: Gpu::Library("real_fract", None),
            gpu_complex: "",
            cost: Weight {
                real: 3,
                complex: 0,
            },
        },
        Row {
            prim: Prim::Mod,
            mnemonic: "mod",
            names: &["mod"],
            usage: "mod(a, b)",
            doc: "a - b floor(a/b), with the sign of b",
            typing: Typing::Real(2),
            real: Some(|a| real::modulo(a[0], a[1])),
            complex: None,
            // ∂/∂a = 1, ∂/∂b = -floor(a/b) = (mod(a, b) - a)/b: the floor of a rounded quotient can be off by one
            derivative: Derivative::Partial(|g, args, value, k| {
                if k == 0 {
                    return g.real(1.0);
                }
                let difference = g.sub(value, args[0]);
                g.div(difference, args[1])
            }),
            gpu: Gpu::Library("real_mod", None),
            gpu_complex: "",
            cost: Weight {
                real: 8,
                complex: 0,
            },
        },
        Row {
            prim: Prim::Sign,
            mnemonic: "sign",
            names: &["sign", "sgn"],
            usage: "sign(x)",
            doc: "-1, 0 or 1",
            typing: Typing::Real(1),
            real: Some(|a| real::sign(a[0])),
            complex: None,
            derivative: Derivative::Zero,
            gpu: Gpu::Library("real_sign", None),
            gpu_complex: "",
            cost: CHEAP,
        },
        Row {
            prim: Prim::Min,
            mnemonic: "min",
            names: &["min"],
            usage: "min(a, b, …)",
            doc: "least; the other operand where one is NaN",
            typing: Typing::Real(2),
            real: Some(|a| a[0].min(a[1])),
            complex: None,
            derivative: Derivative::Structural,
            gpu: Gpu::Builtin(MathFunction::Min),
            gpu_complex: "",
            cost: CHEAP,
        },
        Row {
            prim: Prim::Max,
            mnemonic: "max",
            names: &["max"],
            usage: "max(a, b, …)",
            doc: "greatest; the other operand where one is NaN",
            typing: Typing::Real(2),
            real: Some(|a| a[0].max(a[1])),
            complex: None,
            derivative: Derivative::Structural,
            gpu: Gpu::Builtin(MathFunction::Max),
            gpu_complex: "",
            cost: CHEAP,
        },
        Row {
            prim: Prim::Hash,
            mnemonic: "hash",
            names: &["hash"],
            usage: "hash(x, y, z, w)",
            doc: "a number in [0, 1) for each point of the lattice of integers, 24 bits, the same on every adapter; arguments are rounded down",
            typing: Typing::Real(4),
            real: Some(hash),
            complex: None,
            derivative: Derivative::Zero,
            gpu: Gpu::Library("real_hash", None),
            gpu_complex: "",
            // the words of y, z and w are shared with the neighbours along x
            cost: Weight {
                real: 20,
                complex: 0,
            },
        },
    ]
}
