//! Bessel functions of whole order, and Euler's beta function.

use super::defined::{Partial, named};
use super::derivative::{call, plus, scaled};
use super::whole::known;
use super::{Row, Typing};
use crate::ir::{Graph, Id, Prim};

/// The same function of the order n + step, times a factor.
fn neighbour(g: &mut Graph, prim: Prim, args: &[Id], step: f64, factor: f64) -> Id {
    let order = match known(g, args[0]) {
        Some(n) => g.real(n + step),
        None => plus(g, args[0], step),
    };
    let value = g.apply(prim, &[order, args[1]]);
    scaled(g, factor, value)
}

/// Half of the sum of the neighbours, each times its factor: for the order 0 the one above, times `zero`.
fn half_sum(g: &mut Graph, prim: Prim, args: &[Id], below: f64, above: f64, zero: f64) -> Id {
    if known(g, args[0]) == Some(0.0) {
        return neighbour(g, prim, args, 1.0, zero);
    }
    let low = neighbour(g, prim, args, -1.0, below / 2.0);
    let high = neighbour(g, prim, args, 1.0, above / 2.0);
    g.add(low, high)
}

fn by_order(g: &mut Graph) -> Id {
    g.real(0.0)
}

pub fn rows() -> Vec<Row> {
    let mut rows: Vec<Row> = bessel().into();
    rows.extend(beta());
    rows
}

/// Derivatives: DLMF 10.6.1-2 and 10.29.1-3.
fn bessel() -> [Row; 4] {
    let row = |prim, names, usage, doc, typing, partial: Partial| {
        named(prim, names, usage, doc, typing, partial, 600)
    };
    [
        row(
            Prim::BesselJ,
            &["besselj"],
            "besselj(n, z)",
            "Bessel function J of whole order n, |n| ≤ 50, for complex z |n| ≤ 10",
            Typing::Analytic(2),
            |g, args, _, k| match k {
                0 => by_order(g),
                _ => half_sum(g, Prim::BesselJ, args, 1.0, -1.0, -1.0),
            },
        ),
        row(
            Prim::BesselY,
            &["bessely"],
            "bessely(n, x)",
            "Bessel function Y of whole order n, |n| ≤ 50; NaN for negative reals",
            Typing::Real(2),
            |g, args, _, k| match k {
                0 => by_order(g),
                _ => half_sum(g, Prim::BesselY, args, 1.0, -1.0, -1.0),
            },
        ),
        row(
            Prim::BesselI,
            &["besseli"],
            "besseli(n, x)",
            "modified Bessel function I of whole order n, |n| ≤ 50",
            Typing::Real(2),
            |g, args, _, k| match k {
                0 => by_order(g),
                _ => half_sum(g, Prim::BesselI, args, 1.0, 1.0, 1.0),
            },
        ),
        row(
            Prim::BesselK,
            &["besselk"],
            "besselk(n, x)",
            "modified Bessel function K of whole order n, |n| ≤ 50; NaN for negative reals",
            Typing::Real(2),
            |g, args, _, k| match k {
                0 => by_order(g),
                _ => half_sum(g, Prim::BesselK, args, -1.0, -1.0, -1.0),
            },
        ),
    ]
}

fn beta() -> [Row; 2] {
    [
        named(
            Prim::EulerBeta,
            &["euler_beta"],
            "euler_beta(a, b)",
            "Euler's beta function Γ(a) Γ(b)/Γ(a + b), for arguments right of -32",
            Typing::Analytic(2),
            // B (ψ(a) - ψ(a + b)) (DLMF 5.12.1, 5.2.2)
            |g, args, value, k| {
                let own = if k == 0 {
                    [args[0], args[1]]
                } else {
                    [args[1], args[0]]
                };
                let rise = g.apply(Prim::DigammaRise, &own);
                let product = g.mul(value, rise);
                g.neg(product)
            },
            300,
        ),
        Row {
            mnemonic: "digamma_rise",
            ..named(
                Prim::DigammaRise,
                &[],
                "",
                "ψ(a + b) - ψ(a)",
                Typing::Analytic(2),
                |g, args, _, k| {
                    let sum = g.add(args[0], args[1]);
                    let far = call(g, Prim::Trigamma, sum);
                    if k == 1 {
                        return far;
                    }
                    let near = call(g, Prim::Trigamma, args[0]);
                    g.sub(far, near)
                },
                200,
            )
        },
    ]
}
