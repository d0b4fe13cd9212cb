//! Waves and exponentials divided by their argument.
//!
//! Written as quotients, their derivatives cancel near 0: (z cos z - sin z)/z² is a difference of like terms. Here they are
//! power series there.

use super::derivative::{call, square};
use super::{Derivative, Gpu, Row, Typing, Weight};
use crate::ir::{Graph, Id, Prim, Ty};
use crate::reference::{cardinal, real};

pub fn rows() -> Vec<Row> {
    vec![
        Row {
            prim: Prim::Sinc,
            mnemonic: "sinc",
            names: &["sinc"],
            usage: "sinc(a)",
            doc: "sin(a)/a, and 1 at 0",
            typing: Typing::Analytic(1),
            real: Some(|a| real::sinc(a[0])),
            complex: Some(|a| a[0].sinc()),
            derivative: Derivative::Partial(sinc_partial),
            gpu: Gpu::Library("real_sinc", None),
            gpu_complex: "complex_sinc",
            cost: Weight {
                real: 12,
                complex: 46,
            },
        },
        Row {
            prim: Prim::Sinhc,
            mnemonic: "sinhc",
            names: &["sinhc"],
            usage: "sinhc(a)",
            doc: "sinh(a)/a, and 1 at 0",
            typing: Typing::Analytic(1),
            real: Some(|a| cardinal::sinhc(a[0])),
            complex: Some(|a| a[0].sinhc()),
            derivative: Derivative::Partial(sinhc_partial),
            gpu: Gpu::Library("real_sinhc", None),
            gpu_complex: "complex_sinhc",
            cost: Weight {
                real: 12,
                complex: 46,
            },
        },
        Row {
            prim: Prim::Exprel,
            mnemonic: "exprel",
            names: &["exprel"],
            usage: "exprel(a)",
            doc: "(exp(a) - 1)/a, and 1 at 0",
            typing: Typing::Analytic(1),
            real: Some(|a| cardinal::exprel(a[0])),
            complex: Some(|a| a[0].exprel()),
            derivative: Derivative::Partial(exprel_partial),
            gpu: Gpu::Library("real_exprel", None),
            gpu_complex: "complex_exprel",
            cost: Weight {
                real: 14,
                complex: 46,
            },
        },
    ]
}

/// (cos z - sinc z)/z, near 0 Σ (-1)ᵏ 2k z²ᵏ⁻¹/(2k+1)!.
fn sinc_partial(g: &mut Graph, args: &[Id], value: Id, _: usize) -> Id {
    let z = args[0];
    let near = odd_series(g, z, -1.0);
    let along = slope_along(g, z, value, Prim::Cos);
    if g.ty(z) == Ty::Real {
        return near_zero(g, z, near, along);
    }
    let across = slope_across(g, z, value, Prim::Tan);
    let far = far_from_axis(g, z, Prim::Im, along, across);
    near_zero(g, z, near, far)
}

/// (cosh z - sinhc z)/z, near 0 Σ 2k z²ᵏ⁻¹/(2k+1)!.
fn sinhc_partial(g: &mut Graph, args: &[Id], value: Id, _: usize) -> Id {
    let z = args[0];
    let near = odd_series(g, z, 1.0);
    let across = slope_across(g, z, value, Prim::Tanh);
    if g.ty(z) == Ty::Real {
        return near_zero(g, z, near, across);
    }
    let along = slope_along(g, z, value, Prim::Cosh);
    let far = far_from_axis(g, z, Prim::Re, along, across);
    near_zero(g, z, near, far)
}

/// (f(z) - value)/z with f the derivative of the wave.
fn slope_along(g: &mut Graph, z: Id, value: Id, f: Prim) -> Id {
    let f = call(g, f, z);
    let difference = g.sub(f, value);
    g.div(difference, z)
}

/// value (1/t(z) - 1/z) with t the tangent: it does not overflow before the value does.
fn slope_across(g: &mut Graph, z: Id, value: Id, t: Prim) -> Id {
    let one = g.real(1.0);
    let tangent = call(g, t, z);
    let (left, right) = (g.div(one, tangent), g.div(one, z));
    let rate = g.sub(left, right);
    g.mul(value, rate)
}

/// The first where the part of z that lets a wave grow is at most 1, else the second.
fn far_from_axis(g: &mut Graph, z: Id, part: Prim, along: Id, across: Id) -> Id {
    let part = call(g, part, z);
    let size = call(g, Prim::Abs, part);
    let one = g.real(1.0);
    let grows = g.apply(Prim::Less, &[one, size]);
    g.apply(Prim::Select, &[grows, across, along])
}

/// (exp z - exprel z)/z, near 0 Σ k zᵏ⁻¹/(k+1)!; right of 0 exprel z + (1 - exprel z)/z, where exp z may overflow.
pub(super) fn exprel_partial(g: &mut Graph, args: &[Id], value: Id, _: usize) -> Id {
    const TERMS: i32 = 18;
    let z = args[0];
    let factorial = |n: i32| -> f64 { (1..=n).map(f64::from).product() };
    let coefficient = |k: i32| f64::from(k) / factorial(k + 1);
    let near = horner(g, z, (1..=TERMS).rev().map(coefficient));
    let exp = call(g, Prim::Exp, z);
    let difference = g.sub(exp, value);
    let left = g.div(difference, z);
    let one = g.real(1.0);
    let rest = g.sub(one, value);
    let rest = g.div(rest, z);
    let right = g.add(value, rest);
    let re = if g.ty(z) == Ty::Real {
        z
    } else {
        call(g, Prim::Re, z)
    };
    let zero = g.real(0.0);
    let is_left = g.apply(Prim::Less, &[re, zero]);
    let far = g.apply(Prim::Select, &[is_left, left, right]);
    near_zero(g, z, near, far)
}

/// Σ signᵏ 2k z²ᵏ⁻¹/(2k+1)! to where for |z| < 1 the first omitted term is below 2⁻⁵³ of the first.
fn odd_series(g: &mut Graph, z: Id, sign: f64) -> Id {
    let factorial = |n: i32| -> f64 { (1..=n).map(f64::from).product() };
    let coefficient = |k: i32| sign.powi(k) * 2.0 * f64::from(k) / factorial(2 * k + 1);
    let zz = square(g, z);
    let series = horner(g, zz, (1..=9).rev().map(coefficient));
    g.mul(series, z)
}

/// A polynomial from its coefficients, that of the highest power first.
pub(super) fn horner(g: &mut Graph, z: Id, mut coefficients: impl Iterator<Item = f64>) -> Id {
    let mut sum = g.real(coefficients.next().unwrap_or(0.0));
    for c in coefficients {
        let product = g.mul(sum, z);
        let c = g.real(c);
        sum = g.add(c, product);
    }
    sum
}

/// One form for |z| < 1, another elsewhere.
fn near_zero(g: &mut Graph, z: Id, near: Id, far: Id) -> Id {
    let size = call(g, Prim::Abs, z);
    let one = g.real(1.0);
    let small = g.apply(Prim::Less, &[size, one]);
    g.apply(Prim::Select, &[small, near, far])
}
