//! Exponential, sine, cosine and logarithmic integrals, and those of Fresnel.

use super::defined::{Partial, named};
use super::derivative::{call, reciprocal, scaled, square};
use super::{Row, Typing};
use crate::ir::{Graph, Id, Prim};

pub fn rows() -> Vec<Row> {
    let mut rows: Vec<Row> = exponential().into();
    rows.extend(fresnel());
    rows
}

fn row(
    prim: Prim,
    names: &'static [&'static str],
    usage: &'static str,
    doc: &'static str,
    partial: Partial,
) -> Row {
    named(prim, names, usage, doc, Typing::Analytic(1), partial, 400)
}

fn exponential() -> [Row; 5] {
    [
        row(
            Prim::ExpintE1,
            &["expint_e1"],
            "expint_e1(z)",
            "exponential integral E₁, the integral of exp(-t)/t from z to ∞, cut along the negative real axis; \
             NaN for reals there",
            // -e^(-z)/z
            |g, args, _, _| {
                let turned = g.neg(args[0]);
                let wave = call(g, Prim::Exp, turned);
                g.div(wave, turned)
            },
        ),
        row(
            Prim::ExpintEi,
            &["expint_ei"],
            "expint_ei(z)",
            "exponential integral Ei, the principal value of the integral of exp(t)/t from -∞ to z, \
             cut along the negative real axis",
            |g, args, _, _| {
                let wave = call(g, Prim::Exp, args[0]);
                g.div(wave, args[0])
            },
        ),
        row(
            Prim::Sinint,
            &["sinint"],
            "sinint(z)",
            "sine integral, of sinc from 0 to z",
            |g, args, _, _| call(g, Prim::Sinc, args[0]),
        ),
        row(
            Prim::Cosint,
            &["cosint"],
            "cosint(z)",
            "cosine integral, of cos(t)/t from ∞ to z, cut along the negative real axis; NaN for reals there",
            |g, args, _, _| {
                let wave = call(g, Prim::Cos, args[0]);
                g.div(wave, args[0])
            },
        ),
        row(
            Prim::Logint,
            &["logint"],
            "logint(z)",
            "logarithmic integral Ei(log z), the principal value of the integral of 1/log(t) from 0 to z; \
             NaN for negative reals",
            |g, args, _, _| {
                let log = call(g, Prim::Log, args[0]);
                reciprocal(g, log)
            },
        ),
    ]
}

/// π z²/2
fn phase(g: &mut Graph, z: Id) -> Id {
    let square = square(g, z);
    scaled(g, std::f64::consts::FRAC_PI_2, square)
}

fn fresnel() -> [Row; 2] {
    [
        row(
            Prim::FresnelS,
            &["fresnel_s"],
            "fresnel_s(z)",
            "Fresnel's integral of sin(πt²/2) from 0 to z",
            |g, args, _, _| {
                let phase = phase(g, args[0]);
                call(g, Prim::Sin, phase)
            },
        ),
        row(
            Prim::FresnelC,
            &["fresnel_c"],
            "fresnel_c(z)",
            "Fresnel's integral of cos(πt²/2) from 0 to z",
            |g, args, _, _| {
                let phase = phase(g, args[0]);
                call(g, Prim::Cos, phase)
            },
        ),
    ]
}
