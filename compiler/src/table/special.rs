//! The gamma function and its logarithmic derivatives.

use super::{Derivative, Gpu, Row, Typing, Weight};
use crate::ir::{Graph, Id, Op, Prim};
use crate::reference::real;

/// The last of the derivatives of digamma that there is a function for: four derivatives of trigamma.
pub const MAX_POLYGAMMA: u8 = 5;

/// ψ⁽ⁿ⁺¹⁾
fn polygamma_partial(g: &mut Graph, args: &[Id], value: Id, _: usize) -> Id {
    match g.node(value).op {
        Op::Apply(Prim::Polygamma(n)) if n < MAX_POLYGAMMA => {
            g.apply(Prim::Polygamma(n + 1), &[args[0]])
        }
        _ => g.real(f64::NAN),
    }
}

pub fn rows() -> Vec<Row> {
    vec![
        Row {
            prim: Prim::Gamma,
            mnemonic: "gamma",
            names: &["gamma", "Γ"],
            usage: "gamma(a)",
            doc: "gamma function; n! is gamma(n + 1)",
            typing: Typing::Analytic(1),
            real: Some(|a| real::gamma(a[0])),
            complex: Some(|a| a[0].gamma()),
            // Γ ψ (DLMF 5.2.2)
            derivative: Derivative::Partial(|g, args, value, _| {
                let digamma = g.apply(Prim::Digamma, &[args[0]]);
                g.mul(value, digamma)
            }),
            gpu: Gpu::Library("real_gamma", None),
            gpu_complex: "complex_gamma",
            cost: Weight {
                real: 40,
                complex: 120,
            },
        },
        Row {
            prim: Prim::Lgamma,
            mnemonic: "lgamma",
            names: &["lgamma"],
            usage: "lgamma(x)",
            doc: "log |gamma(x)| for real x",
            typing: Typing::Real(1),
            real: Some(|a| real::lgamma(a[0])),
            complex: None,
            derivative: Derivative::Partial(|g, args, _, _| g.apply(Prim::Digamma, &[args[0]])),
            gpu: Gpu::Library("real_lgamma", None),
            gpu_complex: "",
            cost: Weight {
                real: 40,
                complex: 0,
            },
        },
        Row {
            prim: Prim::Digamma,
            mnemonic: "digamma",
            names: &["digamma", "psi"],
            usage: "digamma(a)",
            doc: "ψ, the logarithmic derivative of gamma",
            typing: Typing::Analytic(1),
            real: Some(|a| real::digamma(a[0])),
            complex: Some(|a| a[0].digamma()),
            derivative: Derivative::Partial(|g, args, _, _| g.apply(Prim::Trigamma, &[args[0]])),
            gpu: Gpu::Library("real_digamma", None),
            gpu_complex: "complex_digamma",
            cost: Weight {
                real: 40,
                complex: 100,
            },
        },
        Row {
            prim: Prim::Trigamma,
            mnemonic: "trigamma",
            names: &["trigamma"],
            usage: "trigamma(a)",
            doc: "ψ′, the derivative of digamma",
            typing: Typing::Analytic(1),
            real: Some(|a| real::trigamma(a[0])),
            complex: Some(|a| a[0].trigamma()),
            derivative: Derivative::Partial(|g, args, _, _| {
                g.apply(Prim::Polygamma(2), &[args[0]])
            }),
            gpu: Gpu::Library("real_trigamma", None),
            gpu_complex: "complex_trigamma",
            cost: Weight {
                real: 40,
                complex: 100,
            },
        },
        Row {
            prim: Prim::Polygamma(2),
            mnemonic: "polygamma",
            names: &[],
            usage: "",
            doc: "ψ⁽ⁿ⁾, a higher derivative of digamma",
            typing: Typing::Analytic(1),
            real: None,
            complex: None,
            derivative: Derivative::Partial(polygamma_partial),
            gpu: Gpu::Family("real_polygamma"),
            gpu_complex: "complex_polygamma",
            cost: Weight {
                real: 60,
                complex: 160,
            },
        },
    ]
}
