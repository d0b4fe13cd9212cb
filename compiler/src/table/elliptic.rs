//! Theta functions, elliptic functions, and series: their values are definitions in the language.

use super::defined::{Partial, named, order, undefined};
use super::derivative::{call, plus, scaled, square};
use super::{Row, Typing};
use crate::ir::{Graph, Id, Prim};

pub fn rows() -> Vec<Row> {
    let mut rows = Vec::new();
    rows.extend(thetas());
    rows.extend(jacobi());
    rows.push(weierstrass());
    rows.extend(series());
    rows
}

fn thetas() -> [Row; 4] {
    let row =
        |prim, names, usage, doc| named(prim, names, usage, doc, Typing::Analytic(2), theta, 2500);
    [
        row(
            Prim::JacobiTheta1(0),
            &["jacobi_theta1"],
            "jacobi_theta1(z, q)",
            "theta function θ₁ of the nome q, |q| < 1: 2 q^(1/4) (sin z - q² sin 3z + …), cut along the negative real q",
        ),
        row(
            Prim::JacobiTheta2(0),
            &["jacobi_theta2"],
            "jacobi_theta2(z, q)",
            "theta function θ₂ of the nome q, |q| < 1: 2 q^(1/4) (cos z + q² cos 3z + …), cut along the negative real q",
        ),
        row(
            Prim::JacobiTheta3(0),
            &["jacobi_theta3"],
            "jacobi_theta3(z, q)",
            "theta function θ₃ of the nome q, |q| < 1: 1 + 2 (q cos 2z + q⁴ cos 4z + …)",
        ),
        row(
            Prim::JacobiTheta4(0),
            &["jacobi_theta4"],
            "jacobi_theta4(z, q)",
            "theta function θ₄ of the nome q, |q| < 1: 1 - 2 (q cos 2z - q⁴ cos 4z + …)",
        ),
    ]
}

/// The next derivative by z; by q that by the heat equation ∂²θ/∂z² = -4 q ∂θ/∂q (DLMF 20.13.1), and at q = 0, where θ₁ and θ₂ have
/// none, the first term.
fn theta(g: &mut Graph, args: &[Id], value: Id, k: usize) -> Id {
    let prim = member(g, value);
    let n = order(g, value);
    if k == 0 {
        return g.apply(prim.with_order(n + 1), args);
    }
    if n > 2 {
        return undefined(g);
    }
    let curve = g.apply(prim.with_order(n + 2), args);
    let below = scaled(g, -4.0, args[1]);
    let slope = g.div(curve, below);
    let Some(first) = first_term(g, prim, args[0], n) else {
        return slope;
    };
    let zero = g.real(0.0);
    let vanishes = g.apply(Prim::Equal, &[args[1], zero]);
    g.apply(Prim::Select, &[vanishes, first, slope])
}

fn member(g: &Graph, value: Id) -> Prim {
    match g.node(value).op {
        crate::ir::Op::Apply(prim) => prim,
        _ => Prim::JacobiTheta3(0),
    }
}

/// The n-th derivative by z of ±2 cos 2z; `None` of θ₁ and θ₂.
fn first_term(g: &mut Graph, prim: Prim, z: Id, n: u8) -> Option<Id> {
    let sign = match prim {
        Prim::JacobiTheta3(_) => 1.0,
        Prim::JacobiTheta4(_) => -1.0,
        _ => return None,
    };
    let twice = scaled(g, 2.0, z);
    Some(match n {
        0 => {
            let wave = call(g, Prim::Cos, twice);
            scaled(g, 2.0 * sign, wave)
        }
        1 => {
            let wave = call(g, Prim::Sin, twice);
            scaled(g, -4.0 * sign, wave)
        }
        _ => {
            let wave = call(g, Prim::Cos, twice);
            scaled(g, -8.0 * sign, wave)
        }
    })
}

fn jacobi() -> [Row; 3] {
    // DLMF 22.13.1-3
    let row = |prim, names, usage, doc, partial: Partial| {
        named(prim, names, usage, doc, Typing::Analytic(2), partial, 1200)
    };
    [
        row(
            Prim::JacobiSn,
            &["jacobi_sn"],
            "jacobi_sn(u, m)",
            "elliptic function sn of the parameter m = k²; no derivative by m",
            |g, args, _, k| {
                let (cn, dn) = (g.apply(Prim::JacobiCn, args), g.apply(Prim::JacobiDn, args));
                by_argument(g, k, |g| g.mul(cn, dn))
            },
        ),
        row(
            Prim::JacobiCn,
            &["jacobi_cn"],
            "jacobi_cn(u, m)",
            "elliptic function cn of the parameter m = k²; no derivative by m",
            |g, args, _, k| {
                let (sn, dn) = (g.apply(Prim::JacobiSn, args), g.apply(Prim::JacobiDn, args));
                by_argument(g, k, |g| {
                    let product = g.mul(sn, dn);
                    g.neg(product)
                })
            },
        ),
        row(
            Prim::JacobiDn,
            &["jacobi_dn"],
            "jacobi_dn(u, m)",
            "elliptic function dn of the parameter m = k²; no derivative by m",
            |g, args, _, k| {
                let (sn, cn) = (g.apply(Prim::JacobiSn, args), g.apply(Prim::JacobiCn, args));
                let m = args[1];
                by_argument(g, k, |g| {
                    let product = g.mul(sn, cn);
                    let scaled = g.mul(m, product);
                    g.neg(scaled)
                })
            },
        ),
    ]
}

fn by_argument(g: &mut Graph, k: usize, derivative: impl FnOnce(&mut Graph) -> Id) -> Id {
    if k == 0 { derivative(g) } else { undefined(g) }
}

fn weierstrass() -> Row {
    Row {
        mnemonic: "weierstrass_p_invariants",
        ..named(
            Prim::WeierstrassPInvariants(0),
            &["weierstrass_p_invariants"],
            "weierstrass_p_invariants(z, g₂, g₃)",
            "Weierstrass's ℘ with ℘′² = 4℘³ - g₂℘ - g₃; no derivative by g₂ or g₃",
            Typing::Complex(3),
            // ℘″ = 6 ℘² - g₂/2 (DLMF 23.3.12)
            |g, args, value, k| match (k, order(g, value)) {
                (0, 0) => g.apply(Prim::WeierstrassPInvariants(1), args),
                (0, _) => {
                    let p = g.apply(Prim::WeierstrassPInvariants(0), args);
                    let square = square(g, p);
                    let curve = scaled(g, 6.0, square);
                    let fixed = scaled(g, 0.5, args[1]);
                    g.sub(curve, fixed)
                }
                _ => undefined(g),
            },
            2000,
        )
    }
}

fn series() -> [Row; 2] {
    [
        named(
            Prim::HurwitzZeta(0),
            &["hurwitz_zeta"],
            "hurwitz_zeta(s, a)",
            "Hurwitz's zeta function, the sum of (k + a)^(-s), for re s ≥ 0, |im s| ≤ 500 and real a > 0",
            Typing::Analytic(2),
            hurwitz,
            9000,
        ),
        named(
            Prim::Hypergeometric,
            &["hypergeometric", "hyp2f1"],
            "hypergeometric(a, b, c, z)",
            "Gauss's ₂F₁, where |z| or |z/(z - 1)| is below 0.97; NaN elsewhere, and where terms cancel; no derivative by a, b, c",
            Typing::Analytic(4),
            // (a b/c) F(a + 1, b + 1; c + 1; z) (DLMF 15.5.1)
            |g, args, _, k| {
                if k != 3 {
                    return undefined(g);
                }
                let [a, b, c] = [0, 1, 2].map(|k| plus(g, args[k], 1.0));
                let next = g.apply(Prim::Hypergeometric, &[a, b, c, args[3]]);
                let product = g.mul(args[0], args[1]);
                let factor = g.div(product, args[2]);
                g.mul(factor, next)
            },
            3000,
        ),
    ]
}

/// ∂/∂a ζ(s, a) = -s ζ(s + 1, a) (DLMF 25.11.17), and its derivative by s.
fn hurwitz(g: &mut Graph, args: &[Id], value: Id, k: usize) -> Id {
    let n = order(g, value);
    if k == 0 {
        return g.apply(Prim::HurwitzZeta(n + 1), args);
    }
    let above = plus(g, args[0], 1.0);
    let next = g.apply(Prim::HurwitzZeta(n), &[above, args[1]]);
    let product = g.mul(args[0], next);
    if n == 0 {
        return g.neg(product);
    }
    let value = g.apply(Prim::HurwitzZeta(0), &[above, args[1]]);
    let sum = g.add(value, product);
    g.neg(sum)
}
