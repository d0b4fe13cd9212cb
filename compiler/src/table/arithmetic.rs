//! Sums, products, powers, roots and lengths.

use naga::{BinaryOperator, MathFunction, UnaryOperator};

use super::derivative::{reciprocal, square};
use super::slope::{direction, power_partial};
use super::{Derivative, Gpu, Row, Typing, Weight};
use crate::ir::{Graph, Id, Prim};
use crate::reference::real;

pub fn rows() -> Vec<Row> {
    vec![
        Row {
            prim: Prim::Neg,
            mnemonic: "neg",
            names: &[],
            usage: "-a",
            doc: "negation",
            typing: Typing::Arithmetic(1),
            real: Some(|a| -a[0]),
            complex: Some(|a| -a[0]),
            derivative: Derivative::Structural,
            gpu: Gpu::Unary(UnaryOperator::Negate),
            gpu_complex: "",
            cost: Weight {
                real: 1,
                complex: 2,
            },
        },
        Row {
            prim: Prim::Add,
            mnemonic: "add",
            names: &[],
            usage: "a + b",
            doc: "sum",
            typing: Typing::Arithmetic(2),
            real: Some(|a| a[0] + a[1]),
            complex: Some(|a| a[0] + a[1]),
            derivative: Derivative::Structural,
            gpu: Gpu::Binary(BinaryOperator::Add),
            gpu_complex: "",
            cost: Weight {
                real: 1,
                complex: 2,
            },
        },
        Row {
            prim: Prim::Sub,
            mnemonic: "sub",
            names: &[],
            usage: "a - b",
            doc: "difference",
            typing: Typing::Arithmetic(2),
            real: Some(|a| a[0] - a[1]),
            complex: Some(|a| a[0] - a[1]),
            derivative: Derivative::Structural,
            gpu: Gpu::Binary(BinaryOperator::Subtract),
            gpu_complex: "",
            cost: Weight {
                real: 1,
                complex: 2,
            },
        },
        Row {
            prim: Prim::Mul,
            mnemonic: "mul",
            names: &[],
            usage: "a b, a * b",
            doc: "product",
            typing: Typing::Arithmetic(2),
            real: Some(|a| a[0] * a[1]),
            complex: Some(|a| a[0] * a[1]),
            derivative: Derivative::Structural,
            gpu: Gpu::Binary(BinaryOperator::Multiply),
            gpu_complex: "complex_mul",
            cost: Weight {
                real: 1,
                complex: 6,
            },
        },
        Row {
            prim: Prim::Div,
            mnemonic: "div",
            names: &[],
            usage: "a / b",
            doc: "quotient",
            typing: Typing::Arithmetic(2),
            real: Some(|a| a[0] / a[1]),
            complex: Some(|a| a[0] / a[1]),
            derivative: Derivative::Structural,
            gpu: Gpu::Binary(BinaryOperator::Divide),
            gpu_complex: "complex_div",
            cost: Weight {
                real: 4,
                complex: 14,
            },
        },
        Row {
            prim: Prim::PowInt(2),
            mnemonic: "powint",
            names: &[],
            usage: "a^3, a³",
            doc: "power with a constant integer exponent, by multiplication",
            typing: Typing::Analytic(1),
            real: None,
            complex: None,
            derivative: Derivative::Structural,
            gpu: Gpu::Structural,
            gpu_complex: "complex_powi",
            cost: Weight {
                real: 16,
                complex: 40,
            },
        },
        Row {
            prim: Prim::Pow,
            mnemonic: "pow",
            names: &["pow"],
            usage: "a^b, pow(a, b)",
            doc: "power; NaN for a negative real base and an exponent that is not an integer",
            typing: Typing::Analytic(2),
            real: Some(|a| real::pow(a[0], a[1])),
            complex: Some(|a| a[0].pow(a[1])),
            derivative: Derivative::Partial(pow_partial),
            gpu: Gpu::Library("real_pow", Some(MathFunction::Pow)),
            gpu_complex: "complex_pow",
            cost: Weight {
                real: 16,
                complex: 60,
            },
        },
        Row {
            prim: Prim::Sqrt,
            mnemonic: "sqrt",
            names: &["sqrt"],
            usage: "√a, sqrt(a)",
            doc: "square root, cut along the negative real axis; NaN for negative reals",
            typing: Typing::Analytic(1),
            real: Some(|a| real::sqrt(a[0])),
            complex: Some(|a| a[0].sqrt()),
            // 1 / (2 √a)
            derivative: Derivative::Partial(|g, _, value, _| {
                let half = g.real(0.5);
                g.div(half, value)
            }),
            gpu: Gpu::Builtin(MathFunction::Sqrt),
            gpu_complex: "complex_sqrt",
            cost: Weight {
                real: 4,
                complex: 20,
            },
        },
        Row {
            prim: Prim::Cbrt,
            mnemonic: "cbrt",
            names: &["cbrt"],
            usage: "cbrt(x)",
            doc: "real cube root, odd",
            typing: Typing::Real(1),
            real: Some(|a| real::cbrt(a[0])),
            complex: None,
            // (1/cbrt x)²/3: with the square below the fraction bar its own derivative at 0 would be 0 · ∞
            derivative: Derivative::Partial(|g, _, value, _| {
                let inverse = reciprocal(g, value);
                let square = square(g, inverse);
                let three = g.real(3.0);
                g.div(square, three)
            }),
            gpu: Gpu::Library("real_cbrt", None),
            gpu_complex: "",
            cost: Weight {
                real: 16,
                complex: 0,
            },
        },
        Row {
            prim: Prim::Hypot,
            mnemonic: "hypot",
            names: &["hypot"],
            usage: "hypot(x, y)",
            doc: "√(x² + y²) without overflow; its derivative at the origin is 0",
            typing: Typing::Real(2),
            real: Some(|a| real::hypot(a[0], a[1])),
            complex: None,
            derivative: Derivative::Partial(length_partial),
            gpu: Gpu::Library("real_hypot", None),
            gpu_complex: "",
            cost: Weight {
                real: 8,
                complex: 0,
            },
        },
        Row {
            prim: Prim::Hypot3,
            mnemonic: "hypot3",
            names: &[],
            usage: "length(p)",
            doc: "√(x² + y² + z²) without overflow; its derivative at the origin is 0",
            typing: Typing::Real(3),
            real: Some(|a| real::hypot3(a[0], a[1], a[2])),
            complex: None,
            derivative: Derivative::Partial(length_partial),
            gpu: Gpu::Library("real_hypot3", None),
            gpu_complex: "",
            cost: Weight {
                real: 10,
                complex: 0,
            },
        },
    ]
}

/// ∂|p|/∂p_k = p_k / |p|, and 0 at the origin.
fn length_partial(g: &mut Graph, args: &[Id], value: Id, k: usize) -> Id {
    direction(g, args, k, value)
}

/// ∂(a^b)/∂a = b a^(b-1), which is finite at a = 0 where a^b b/a is not, and 0 for a = b = 0; ∂(a^b)/∂b = a^b log a, and 0
/// at a = 0.
fn pow_partial(g: &mut Graph, args: &[Id], value: Id, k: usize) -> Id {
    let &[base, exponent] = args else {
        return value;
    };
    power_partial(g, base, exponent, 0.0, value, k)
}
