//! Functions whose values are definitions in the language; here are their types and derivatives.

use super::derivative::{call, plus, scaled, square};
use super::{DEFINED, Derivative, Gpu, Row, Typing, Weight};
use crate::ir::{Graph, Id, Op, Prim};

pub(super) type Partial = fn(&mut Graph, &[Id], Id, usize) -> Id;

/// The last member of a family that there is a definition of.
pub fn last_order(prim: Prim) -> u8 {
    match prim {
        Prim::Faddeeva(_) => 3,
        Prim::Hypergeometric(_) => 6,
        Prim::JacobiSn(_)
        | Prim::JacobiCn(_)
        | Prim::JacobiDn(_)
        | Prim::GegenbauerC(_)
        | Prim::LaguerreL(_)
        | Prim::Zeta(_)
        | Prim::DirichletBeta(_)
        | Prim::HurwitzZeta(_) => 2,
        Prim::WeierstrassP(_) => 3,
        Prim::WeierstrassPInvariants(_) => 5,
        Prim::JacobiTheta1(_)
        | Prim::JacobiTheta2(_)
        | Prim::JacobiTheta3(_)
        | Prim::JacobiTheta4(_) => 4,
        _ => 1,
    }
}

/// Whether the last member of a family has a derivative all the same: by those before it.
pub fn is_closed(prim: Prim) -> bool {
    matches!(
        prim,
        Prim::WeierstrassP(_)
            | Prim::WeierstrassPInvariants(_)
            | Prim::JacobiSn(_)
            | Prim::JacobiCn(_)
            | Prim::JacobiDn(_)
            | Prim::GegenbauerC(_)
            | Prim::LaguerreL(_)
            | Prim::Hypergeometric(_)
            | Prim::HurwitzZeta(_)
            | Prim::EisensteinE2(_)
            | Prim::EisensteinE4(_)
            | Prim::EisensteinE6(_)
    )
}

/// Whether an operation has no derivative by its k-th operand: third derivatives by a parameter and of Hurwitz's function by s, second
/// ones of ℘ by its lattice.
pub fn is_missing(prim: Prim, k: usize) -> bool {
    match prim {
        Prim::JacobiSn(2..)
        | Prim::JacobiCn(2..)
        | Prim::JacobiDn(2..)
        | Prim::GegenbauerC(2..)
        | Prim::LaguerreL(2..)
        | Prim::WeierstrassP(2..)
        | Prim::JacobiTheta1(3..)
        | Prim::JacobiTheta2(3..)
        | Prim::JacobiTheta3(3..)
        | Prim::JacobiTheta4(3..) => k == 1,
        Prim::WeierstrassPInvariants(2..) => k > 0,
        Prim::HurwitzZeta(2..) => k == 0,
        Prim::Hypergeometric(3..) => k < 3,
        _ => false,
    }
}

pub(super) fn order(g: &Graph, value: Id) -> u8 {
    match g.node(value).op {
        Op::Apply(prim) => prim.order().unwrap_or(0),
        _ => 0,
    }
}

pub(super) fn undefined(g: &mut Graph) -> Id {
    g.real(f64::NAN)
}

/// A row of a function that is written by its name.
pub(super) fn named(
    prim: Prim,
    names: &'static [&'static str],
    usage: &'static str,
    doc: &'static str,
    typing: Typing,
    partial: Partial,
    cost: u16,
) -> Row {
    let mnemonic = names.first().copied().unwrap_or("");
    Row {
        prim,
        mnemonic,
        names,
        usage,
        doc,
        typing,
        real: None,
        complex: None,
        derivative: Derivative::Partial(partial),
        gpu: match typing {
            // reals are widened before
            Typing::Complex(_) => Gpu::Structural,
            _ => Gpu::Defined,
        },
        gpu_complex: match typing {
            Typing::Real(_) => "",
            _ => DEFINED,
        },
        cost: Weight {
            real: cost,
            complex: cost,
        },
    }
}

pub fn rows() -> Vec<Row> {
    let mut rows = Vec::new();
    rows.extend(errors());
    rows.extend(zetas());
    rows.extend(airy());
    rows.extend(elliptic());
    rows.extend(modular());
    rows
}

fn errors() -> [Row; 4] {
    use Typing::{Analytic, Complex};
    [
        Row {
            mnemonic: "faddeeva",
            ..named(
                Prim::Faddeeva(0),
                &["faddeeva", "wofz"],
                "faddeeva(z)",
                "exp(-z²) erfc(-i z), the plasma dispersion function",
                Complex(1),
                |g, args, value, _| {
                    let n = order(g, value);
                    call(g, Prim::Faddeeva(n + 1), args[0])
                },
                700,
            )
        },
        named(
            Prim::LambertW,
            &["lambertw"],
            "lambertw(z, k)",
            "branch k of the inverse of w exp(w); for reals k is 0 or -1, NaN below -1/e",
            Analytic(2),
            lambert_partial,
            600,
        ),
        named(
            Prim::Loggamma,
            &["loggamma"],
            "loggamma(z)",
            "logarithm of gamma, its principal branch: cut along the negative real axis; NaN for negative reals",
            Analytic(1),
            |g, args, _, _| call(g, Prim::Digamma, args[0]),
            600,
        ),
        named(
            Prim::Dilogarithm,
            &["dilog"],
            "dilog(z)",
            "dilogarithm Li₂, cut along the real axis above 1; NaN for reals there",
            Analytic(1),
            // -log(1 - z)/z
            |g, args, _, _| {
                let turned = g.neg(args[0]);
                call(g, Prim::Log1pRel(0), turned)
            },
            400,
        ),
    ]
}

/// 1/((1 + W) e^W) (DLMF 4.13.4): e^-W, which is W/z, from the one of these that is good.
fn lambert_partial(g: &mut Graph, args: &[Id], value: Id, k: usize) -> Id {
    if k == 1 {
        return g.real(0.0);
    }
    let below = plus(g, value, 1.0);
    let turned = g.neg(value);
    let inner = call(g, Prim::Exp, turned);
    let outer = g.div(value, args[0]);
    let size = call(g, Prim::Abs, value);
    let one = g.real(1.0);
    let near = g.apply(Prim::Less, &[size, one]);
    let factor = g.apply(Prim::Select, &[near, inner, outer]);
    g.div(factor, below)
}

fn zetas() -> [Row; 3] {
    let family = |prim, names, usage, doc, partial, cost| {
        named(prim, names, usage, doc, Typing::Analytic(1), partial, cost)
    };
    [
        family(
            Prim::Zeta(0),
            &["zeta"],
            "zeta(s)",
            "Riemann's zeta function, for |im s| ≤ 500",
            |g, args, value, _| {
                let n = order(g, value);
                call(g, Prim::Zeta(n + 1), args[0])
            },
            9000,
        ),
        family(
            Prim::DirichletEta(0),
            &["dirichlet_eta"],
            "dirichlet_eta(s)",
            "Dirichlet's eta function (1 - 2^(1 - s)) zeta(s), for |im s| ≤ 500",
            |g, args, _, _| call(g, Prim::DirichletEta(1), args[0]),
            9000,
        ),
        family(
            Prim::DirichletBeta(0),
            &["dirichlet_beta"],
            "dirichlet_beta(s)",
            "Dirichlet's beta function, the sum of (-1)^n (2n + 1)^(-s), for |im s| ≤ 500",
            |g, args, value, _| {
                let n = order(g, value);
                call(g, Prim::DirichletBeta(n + 1), args[0])
            },
            9000,
        ),
    ]
}

fn airy() -> [Row; 4] {
    // the second derivative is the argument times the function (DLMF 9.2.1)
    let row = |prim, names, usage, doc, partial| {
        named(prim, names, usage, doc, Typing::Analytic(1), partial, 900)
    };
    [
        row(
            Prim::AiryAi,
            &["airy_ai"],
            "airy_ai(z)",
            "Airy function Ai",
            |g, args, _, _| call(g, Prim::AiryAiPrime, args[0]),
        ),
        row(
            Prim::AiryAiPrime,
            &["airy_ai_prime"],
            "airy_ai_prime(z)",
            "derivative of the Airy function Ai",
            |g, args, _, _| {
                let value = call(g, Prim::AiryAi, args[0]);
                g.mul(args[0], value)
            },
        ),
        row(
            Prim::AiryBi,
            &["airy_bi"],
            "airy_bi(z)",
            "Airy function Bi",
            |g, args, _, _| call(g, Prim::AiryBiPrime, args[0]),
        ),
        row(
            Prim::AiryBiPrime,
            &["airy_bi_prime"],
            "airy_bi_prime(z)",
            "derivative of the Airy function Bi",
            |g, args, _, _| {
                let value = call(g, Prim::AiryBi, args[0]);
                g.mul(args[0], value)
            },
        ),
    ]
}

fn elliptic() -> [Row; 4] {
    [
        named(
            Prim::EllipticK,
            &["elliptic_k"],
            "elliptic_k(m)",
            "complete elliptic integral of the first kind of the parameter m = k², cut above 1; NaN for reals there",
            Typing::Analytic(1),
            // (K - D)/(2 (1 - m))
            |g, args, value, _| {
                let d = call(g, Prim::EllipticD(0), args[0]);
                let above = g.sub(value, d);
                let rest = g.neg(args[0]);
                let rest = plus(g, rest, 1.0);
                let below = scaled(g, 2.0, rest);
                g.div(above, below)
            },
            200,
        ),
        named(
            Prim::EllipticE,
            &["elliptic_e"],
            "elliptic_e(m)",
            "complete elliptic integral of the second kind of the parameter m = k², cut above 1; NaN for reals there",
            Typing::Analytic(1),
            |g, args, _, _| {
                let d = call(g, Prim::EllipticD(0), args[0]);
                scaled(g, -0.5, d)
            },
            400,
        ),
        Row {
            mnemonic: "elliptic_d",
            ..named(
                Prim::EllipticD(0),
                &[],
                "",
                "D(m) = (K(m) - E(m))/m, and C(m) = (2 D(m) - K(m))/m",
                Typing::Analytic(1),
                // (D - C)/(2 (1 - m))
                |g, args, value, _| {
                    let c = call(g, Prim::EllipticD(1), args[0]);
                    let above = g.sub(value, c);
                    let rest = g.neg(args[0]);
                    let rest = plus(g, rest, 1.0);
                    let below = scaled(g, 2.0, rest);
                    g.div(above, below)
                },
                300,
            )
        },
        Row {
            mnemonic: "weierstrass_p",
            ..named(
                Prim::WeierstrassP(0),
                &["weierstrass_p"],
                "weierstrass_p(z, τ)",
                "Weierstrass's ℘ of the lattice of 1 and τ",
                Typing::Complex(2),
                weierstrass_partial,
                1500,
            )
        },
    ]
}

/// By z and by τ the next members; ℘″ = 6 ℘² - g₂/2 (DLMF 23.3.12), g₂ = (4π⁴/3) E₄ (DLMF 23.12.5), and that differentiated by τ.
fn weierstrass_partial(g: &mut Graph, args: &[Id], value: Id, k: usize) -> Id {
    let third = 2.0 / 3.0 * std::f64::consts::PI.powi(4);
    match (k, order(g, value)) {
        (0, 0) => g.apply(Prim::WeierstrassP(1), args),
        (0, 1) => {
            let value = g.apply(Prim::WeierstrassP(0), args);
            let square = square(g, value);
            let curve = scaled(g, 6.0, square);
            let e4 = call(g, Prim::EisensteinE4(0), args[1]);
            let fixed = scaled(g, third, e4);
            g.sub(curve, fixed)
        }
        (0, 2) | (1, 1) => g.apply(Prim::WeierstrassP(3), args),
        (0, 3) => {
            let [value, moved] = [0, 2].map(|n| g.apply(Prim::WeierstrassP(n), args));
            let product = g.mul(value, moved);
            let curve = scaled(g, 12.0, product);
            let slope = call(g, Prim::EisensteinE4(1), args[1]);
            let fixed = scaled(g, third, slope);
            g.sub(curve, fixed)
        }
        (1, 0) => g.apply(Prim::WeierstrassP(2), args),
        _ => undefined(g),
    }
}

/// c · π i · a
fn turned(g: &mut Graph, c: f64, a: Id) -> Id {
    let factor = g.complex(0.0, c * std::f64::consts::PI);
    g.mul(factor, a)
}

/// The first derivatives are the next members; the second ones by the equations of Ramanujan for the first,
///   E₂′ = (πi/6) (E₂² - E₄), E₄′ = (2πi/3) (E₂ E₄ - E₆), E₆′ = πi (E₂ E₆ - E₄²)
/// (Zagier, Elliptic modular forms and their applications, in: The 1-2-3 of Modular Forms, 2008, proposition 15), differentiated.
fn eisenstein(g: &mut Graph, args: &[Id], value: Id, _: usize) -> Id {
    let prim = match g.node(value).op {
        Op::Apply(prim) => prim,
        _ => return undefined(g),
    };
    if prim.order() == Some(0) {
        return g.apply(prim.with_order(1), args);
    }
    let families = [
        Prim::EisensteinE2(0),
        Prim::EisensteinE4(0),
        Prim::EisensteinE6(0),
    ];
    let [e2, e4, e6] = families.map(|form| call(g, form, args[0]));
    let [d2, d4, d6] = families.map(|form| call(g, form.with_order(1), args[0]));
    let (left, right, last, factor) = match prim {
        Prim::EisensteinE2(_) => ((e2, d2), (e2, d2), d4, 1.0 / 6.0),
        Prim::EisensteinE4(_) => ((d2, e4), (e2, d4), d6, 2.0 / 3.0),
        _ => {
            let product = g.mul(e4, d4);
            ((d2, e6), (e2, d6), scaled(g, 2.0, product), 1.0)
        }
    };
    let [left, right] = [left, right].map(|(a, b)| g.mul(a, b));
    let sum = g.add(left, right);
    let rest = g.sub(sum, last);
    turned(g, factor, rest)
}

fn modular() -> [Row; 7] {
    let form = |prim, names, usage, doc, partial| {
        named(prim, names, usage, doc, Typing::Complex(1), partial, 900)
    };
    [
        form(
            Prim::EisensteinE2(0),
            &["eisenstein_e2"],
            "eisenstein_e2(τ)",
            "Eisenstein series E₂ = 1 - 24 (q + 3q² + …), q = exp(2πiτ), of im τ > 0",
            eisenstein,
        ),
        form(
            Prim::EisensteinE4(0),
            &["eisenstein_e4"],
            "eisenstein_e4(τ)",
            "Eisenstein series E₄ = 1 + 240 (q + 9q² + …), q = exp(2πiτ), of im τ > 0",
            eisenstein,
        ),
        form(
            Prim::EisensteinE6(0),
            &["eisenstein_e6"],
            "eisenstein_e6(τ)",
            "Eisenstein series E₆ = 1 - 504 (q + 33q² + …), q = exp(2πiτ), of im τ > 0",
            eisenstein,
        ),
        form(
            Prim::KleinJ,
            &["klein_j"],
            "klein_j(τ)",
            "Klein's invariant J of im τ > 0, 1 at i and 0 at exp(2πi/3); j is 1728 J",
            // -2πi J E₆/E₄
            |g, args, value, _| {
                let e4 = call(g, Prim::EisensteinE4(0), args[0]);
                let e6 = call(g, Prim::EisensteinE6(0), args[0]);
                let ratio = g.div(e6, e4);
                let product = g.mul(value, ratio);
                turned(g, -2.0, product)
            },
        ),
        form(
            Prim::DedekindEta,
            &["dedekind_eta"],
            "dedekind_eta(τ)",
            "Dedekind's eta function of im τ > 0",
            // (πi/12) E₂ η
            |g, args, value, _| {
                let e2 = call(g, Prim::EisensteinE2(0), args[0]);
                let product = g.mul(e2, value);
                turned(g, 1.0 / 12.0, product)
            },
        ),
        form(
            Prim::ModularLambda,
            &["modular_lambda"],
            "modular_lambda(τ)",
            "elliptic modular function λ = θ₂⁴/θ₃⁴ of im τ > 0",
            // πi λ (1 - λ) θ₃⁴
            |g, args, _, _| {
                let slope = call(g, Prim::ModularLambdaSlope(0), args[0]);
                turned(g, 1.0, slope)
            },
        ),
        Row {
            mnemonic: "modular_lambda_slope",
            ..form(
                Prim::ModularLambdaSlope(0),
                &[],
                "",
                "θ₂⁴ θ₄⁴/θ₃⁴ as a function of τ, and θ₄⁴ - θ₂⁴",
                // (πi/3) (E₂ + 2 (θ₄⁴ - θ₂⁴)) times it
                |g, args, value, _| {
                    let e2 = call(g, Prim::EisensteinE2(0), args[0]);
                    let powers = call(g, Prim::ModularLambdaSlope(1), args[0]);
                    let twice = scaled(g, 2.0, powers);
                    let sum = g.add(e2, twice);
                    let product = g.mul(value, sum);
                    turned(g, 1.0 / 3.0, product)
                },
            )
        },
    ]
}
