//! Theta functions, elliptic functions, and series: their values are definitions in the language.

use super::defined::{named, order, undefined};
use super::derivative::{call, plus, scaled, square};
use super::{Row, Typing};
use crate::ir::{Graph, Id, Prim, Ty};

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

/// The next derivative by z; by q that by the heat equation ∂²θ/∂z² = -4 q ∂θ/∂q (DLMF 20.13.1), and of θ₃ and θ₄ next to q = 0 by the
/// sum itself.
fn theta(g: &mut Graph, args: &[Id], value: Id, k: usize) -> Id {
    let prim = member(g, value);
    let n = order(g, value);
    if k == 0 {
        return g.apply(prim.with_order(n + 1), args);
    }
    let curve = g.apply(prim.with_order(n + 2), args);
    let below = scaled(g, -4.0, args[1]);
    let slope = g.div(curve, below);
    let sign = match prim {
        Prim::JacobiTheta3(_) => 1.0,
        Prim::JacobiTheta4(_) => -1.0,
        _ => return slope,
    };
    let near = is_near_zero(g, args);
    let sum = sum_by_nome(g, args, sign, n);
    g.apply(Prim::Select, &[near, sum, slope])
}

/// Whether |q| < 1/16 and |q|³ e^(2 |im z|) < 1: five terms of the sum are enough then, and with more than the first one that counts the
/// heat equation loses no digits of a second derivative elsewhere.
fn is_near_zero(g: &mut Graph, args: &[Id]) -> Id {
    let size = call(g, Prim::Abs, args[1]);
    let grown = if g.ty(args[0]) == Ty::Complex {
        let height = call(g, Prim::Im, args[0]);
        let height = call(g, Prim::Abs, height);
        let power = scaled(g, 2.0 / 3.0, height);
        let growth = call(g, Prim::Exp, power);
        g.mul(size, growth)
    } else {
        size
    };
    let sixteen = scaled(g, 16.0, size);
    let most = g.apply(Prim::Max, &[sixteen, grown]);
    let one = g.real(1.0);
    g.apply(Prim::Less, &[most, one])
}

/// The n-th derivative by z, n ≤ 2, of Σ 2 (±1)ʲ j² q^(j² - 1) cos 2jz, j from 1 to 5, which is that of θ₃ or θ₄ by q (DLMF 20.2.3-4).
fn sum_by_nome(g: &mut Graph, args: &[Id], sign: f64, n: u8) -> Id {
    let twice = scaled(g, 2.0, args[0]);
    let cosine = call(g, Prim::Cos, twice);
    let double = scaled(g, 2.0, cosine);
    // of the multiple angles before: cos 0 and cos 2z, or sin 0 and sin 2z
    let (mut before, mut wave) = if n == 1 {
        (g.real(0.0), call(g, Prim::Sin, twice))
    } else {
        (g.real(1.0), cosine)
    };
    let turned = if n == 0 { 1.0 } else { -1.0 };
    let mut sum = None;
    for j in 1..=5 {
        let order = f64::from(j);
        let factor = 2.0 * sign.powi(j) * turned * order.powi(2) * (2.0 * order).powi(n.into());
        let product = if j == 1 {
            wave
        } else {
            let power = g.apply(Prim::PowInt(j * j - 1), &[args[1]]);
            g.mul(power, wave)
        };
        let term = scaled(g, factor, product);
        sum = Some(sum.map_or(term, |sum| g.add(sum, term)));
        let next = g.mul(double, wave);
        let next = g.sub(next, before);
        (before, wave) = (wave, next);
    }
    sum.unwrap_or_else(|| undefined(g))
}

fn member(g: &Graph, value: Id) -> Prim {
    match g.node(value).op {
        crate::ir::Op::Apply(prim) => prim,
        _ => Prim::JacobiTheta3(0),
    }
}

fn jacobi() -> [Row; 3] {
    let row = |prim, names, usage, doc| {
        let typing = Typing::Analytic(2);
        named(prim, names, usage, doc, typing, jacobi_partial, 1200)
    };
    [
        row(
            Prim::JacobiSn(0),
            &["jacobi_sn"],
            "jacobi_sn(u, m)",
            "elliptic function sn of the parameter m = k²",
        ),
        row(
            Prim::JacobiCn(0),
            &["jacobi_cn"],
            "jacobi_cn(u, m)",
            "elliptic function cn of the parameter m = k²",
        ),
        row(
            Prim::JacobiDn(0),
            &["jacobi_dn"],
            "jacobi_dn(u, m)",
            "elliptic function dn of the parameter m = k²",
        ),
    ]
}

/// By u: cn dn, -sn dn and -m sn cn (DLMF 22.13.1-3), and of the derivatives by m those of the product; by m the next member.
fn jacobi_partial(g: &mut Graph, args: &[Id], value: Id, k: usize) -> Id {
    let (prim, n) = (member(g, value), order(g, value));
    if k == 1 {
        return g.apply(prim.with_order(n + 1), args);
    }
    let others: [fn(u8) -> Prim; 2] = match prim {
        Prim::JacobiSn(_) => [Prim::JacobiCn, Prim::JacobiDn],
        Prim::JacobiCn(_) => [Prim::JacobiSn, Prim::JacobiDn],
        _ => [Prim::JacobiSn, Prim::JacobiCn],
    };
    let mut slope = product_by_m(g, args, others, n);
    if matches!(prim, Prim::JacobiDn(_)) {
        slope = g.mul(args[1], slope);
        if n > 0 {
            let before = product_by_m(g, args, others, n - 1);
            let before = scaled(g, n.into(), before);
            slope = g.add(slope, before);
        }
    }
    if matches!(prim, Prim::JacobiSn(_)) {
        slope
    } else {
        g.neg(slope)
    }
}

/// The n-th derivative by m of a product of two of these functions, n ≤ 2.
fn product_by_m(g: &mut Graph, args: &[Id], factors: [fn(u8) -> Prim; 2], n: u8) -> Id {
    let [left, right] = factors;
    let mut term = |j: u8| {
        let [a, b] = [left(j), right(n - j)].map(|prim| g.apply(prim, args));
        let product = g.mul(a, b);
        if n == 2 && j == 1 {
            scaled(g, 2.0, product)
        } else {
            product
        }
    };
    let terms: Vec<Id> = (0..=n).map(&mut term).collect();
    terms
        .into_iter()
        .reduce(|sum, term| g.add(sum, term))
        .unwrap_or_else(|| undefined(g))
}

fn weierstrass() -> Row {
    Row {
        mnemonic: "weierstrass_p_invariants",
        ..named(
            Prim::WeierstrassPInvariants(0),
            &["weierstrass_p_invariants"],
            "weierstrass_p_invariants(z, g₂, g₃)",
            "Weierstrass's ℘ with ℘′² = 4℘³ - g₂℘ - g₃",
            Typing::Complex(3),
            invariants_partial,
            2000,
        )
    }
}

/// The members are ℘, its derivatives by z, g₂ and g₃, and those of the last two by z. ℘″ = 6 ℘² - g₂/2 (DLMF 23.3.12), and that
/// differentiated by g₂ and g₃.
fn invariants_partial(g: &mut Graph, args: &[Id], value: Id, k: usize) -> Id {
    let member = |n| Prim::WeierstrassPInvariants(n);
    let next = match (k, order(g, value)) {
        (0, 0) => 1,
        (1, 0) => 2,
        (2, 0) => 3,
        (0, 2) | (1, 1) => 4,
        (0, 3) | (2, 1) => 5,
        (0, 1) => {
            let p = g.apply(member(0), args);
            let square = square(g, p);
            let curve = scaled(g, 6.0, square);
            let fixed = scaled(g, 0.5, args[1]);
            return g.sub(curve, fixed);
        }
        (0, n) => {
            let [p, moved] = [0, n - 2].map(|n| g.apply(member(n), args));
            let product = g.mul(p, moved);
            let curve = scaled(g, 12.0, product);
            return if n == 4 { plus(g, curve, -0.5) } else { curve };
        }
        _ => return undefined(g),
    };
    g.apply(member(next), args)
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
            Prim::Hypergeometric(0),
            &["hypergeometric", "hyp2f1"],
            "hypergeometric(a, b, c, z)",
            "Gauss's ₂F₁, where |z| or |z/(z - 1)| is below 0.97; NaN elsewhere, and where terms cancel",
            Typing::Analytic(4),
            hypergeometric,
            3000,
        ),
    ]
}

/// The members are F, its derivatives by a and c, and the second ones by a, by a and b, by a and c, and by c; by b as by a, in which F is
/// symmetric.
fn hypergeometric(g: &mut Graph, args: &[Id], value: Id, k: usize) -> Id {
    let n = order(g, value);
    if k == 3 {
        return hypergeometric_by_argument(g, args, n);
    }
    let next = match (n, k) {
        (0, 0 | 1) => 1,
        (0, _) => 2,
        (1, 0) => 3,
        (1, 1) => 4,
        (1, _) | (2, 0 | 1) => 5,
        (2, _) => 6,
        _ => return undefined(g),
    };
    // the member is the derivative by the first parameter
    let is_turned = k == 1 && n != 1;
    let turned = [args[1], args[0], args[2], args[3]];
    let of = if is_turned { &turned } else { args };
    g.apply(Prim::Hypergeometric(next), of)
}

/// By z (a b/c) F(a + 1, b + 1; c + 1; z) (DLMF 15.5.1), and of the derivatives by parameters those of this product.
fn hypergeometric_by_argument(g: &mut Graph, args: &[Id], n: u8) -> Id {
    let [a, b, c] = [0, 1, 2].map(|k| plus(g, args[k], 1.0));
    let above = [a, b, c, args[3]];
    let turned = [b, a, c, args[3]];
    let product = g.mul(args[0], args[1]);
    let factor = g.div(product, args[2]);
    let [of_a, of_b] = [1, 0].map(|k| g.div(args[k], args[2]));
    let mut term = |member: u8, of: &[Id], factor: Id, times: f64, over: u8| {
        let value = g.apply(Prim::Hypergeometric(member), of);
        let factor = (0..over).fold(factor, |factor, _| g.div(factor, args[2]));
        let product = g.mul(factor, value);
        if times == 1.0 {
            product
        } else {
            scaled(g, times, product)
        }
    };
    let mut terms = vec![term(n, &above, factor, 1.0, 0)];
    match n {
        1 => terms.push(term(0, &above, of_a, 1.0, 0)),
        2 => terms.push(term(0, &above, factor, -1.0, 1)),
        3 => terms.push(term(1, &above, of_a, 2.0, 0)),
        4 => {
            terms.push(term(1, &above, of_b, 1.0, 0));
            terms.push(term(1, &turned, of_a, 1.0, 0));
        }
        5 => {
            terms.push(term(2, &above, of_a, 1.0, 0));
            terms.push(term(1, &above, factor, -1.0, 1));
            terms.push(term(0, &above, of_a, -1.0, 1));
        }
        6 => {
            terms.push(term(2, &above, factor, -2.0, 1));
            terms.push(term(0, &above, factor, 2.0, 2));
        }
        _ => {}
    }
    if n == 4 {
        let value = g.apply(Prim::Hypergeometric(0), &above);
        terms.push(g.div(value, args[2]));
    }
    let first = terms[0];
    terms[1..].iter().fold(first, |sum, &term| g.add(sum, term))
}

/// ∂/∂a ζ(s, a) = -s ζ(s + 1, a) (DLMF 25.11.17), and its derivatives by s.
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
    // (s ζ)⁽ⁿ⁾ = s ζ⁽ⁿ⁾ + n ζ⁽ⁿ⁻¹⁾
    let before = g.apply(Prim::HurwitzZeta(n - 1), &[above, args[1]]);
    let before = scaled(g, f64::from(n), before);
    let sum = g.add(before, product);
    g.neg(sum)
}
