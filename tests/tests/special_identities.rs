//! Functional equations of special functions at random points. Every term is a product of factors; what a factor may be off by is
//! what is declared: its value and its derivative, by the unit of the format.

use pullback_compiler::What;
use pullback_compiler::lower::Precision;
use pullback_runtime::executor::Arithmetic;
use pullback_tests::accuracy::evaluators::{Machine, Point};
use pullback_tests::accuracy::subjects::formula;

type Complex = [f64; 2];

/// A sum of products that vanishes, of formulas in z; `region` has the least and greatest re z and im z.
struct Identity {
    terms: &'static [&'static [&'static str]],
    region: [f64; 4],
}

const fn identity(terms: &'static [&'static [&'static str]], region: [f64; 4]) -> Identity {
    Identity { terms, region }
}

const PLANE: [f64; 4] = [-3.0, 3.0, -3.0, 3.0];
const UPPER: [f64; 4] = [-0.9, 0.9, 0.4, 1.8];
const DISC: [f64; 4] = [-0.55, 0.55, -0.55, 0.55];

/// 4 (℘(z + w) + ℘(z) + ℘(w)) (℘(z) - ℘(w))² = (℘′(z) - ℘′(w))² (DLMF 23.10.1), multiplied out, w = 0.25 + 0.5i.
macro_rules! addition {
    ($p:literal, $d:literal, $lattice:literal) => {
        [
            &[
                sum!("4", $p, $lattice),
                at!("", $p, $lattice),
                at!("", $p, $lattice),
            ] as &[&str],
            &[
                sum!("-8", $p, $lattice),
                at!("", $p, $lattice),
                fixed!("", $p, $lattice),
            ],
            &[
                sum!("4", $p, $lattice),
                fixed!("", $p, $lattice),
                fixed!("", $p, $lattice),
            ],
            &[
                at!("4", $p, $lattice),
                at!("", $p, $lattice),
                at!("", $p, $lattice),
            ],
            &[
                at!("-4", $p, $lattice),
                at!("", $p, $lattice),
                fixed!("", $p, $lattice),
            ],
            &[
                at!("-4", $p, $lattice),
                fixed!("", $p, $lattice),
                fixed!("", $p, $lattice),
            ],
            &[
                fixed!("4", $p, $lattice),
                fixed!("", $p, $lattice),
                fixed!("", $p, $lattice),
            ],
            &[at!("-1", $d, $lattice), at!("", $d, $lattice)],
            &[at!("2", $d, $lattice), fixed!("", $d, $lattice)],
            &[fixed!("-1", $d, $lattice), fixed!("", $d, $lattice)],
        ]
    };
}
macro_rules! sum {
    ($c:literal, $p:literal, $lattice:literal) => {
        concat!($c, " ", $p, "(z + 0.25 + 0.5i, ", $lattice, ")")
    };
}
macro_rules! at {
    ($c:literal, $p:literal, $lattice:literal) => {
        concat!($c, " ", $p, "(z, ", $lattice, ")")
    };
}
macro_rules! fixed {
    ($c:literal, $p:literal, $lattice:literal) => {
        concat!($c, " ", $p, "(0.25 + 0.5i, ", $lattice, ")")
    };
}
const IDENTITIES: [(&str, Identity); 19] = [
    (
        "Γ(z) Γ(1 - z) sin πz = π",
        identity(
            &[&["gamma(z)", "gamma(1 - z)", "sin(pi z)"], &["-pi + 0i"]],
            PLANE,
        ),
    ),
    (
        "Γ(z) Γ(z + 1/2) = 2^(1 - 2z) √π Γ(2z)",
        identity(
            &[
                &["gamma(z)", "gamma(z + 1/2)"],
                &["-sqrt(pi) + 0i", "exp(log(2) (1 - 2 z))", "gamma(2 z)"],
            ],
            PLANE,
        ),
    ),
    (
        "e^(log Γ) = Γ",
        identity(&[&["exp(loggamma(z))"], &["-gamma(z)"]], PLANE),
    ),
    (
        "ζ(1 - s) = 2 (2π)^-s cos(πs/2) Γ(s) ζ(s)",
        identity(
            &[
                &["zeta(1 - z)"],
                &["-2 exp(-log(2 pi) z)", "cos(pi z/2)", "gamma(z)", "zeta(z)"],
            ],
            [-3.0, 4.0, 0.2, 14.0],
        ),
    ),
    (
        "ζ(s, a) = a^-s + ζ(s, a + 1)",
        identity(
            &[
                &["hurwitz_zeta(z, 0.75)"],
                &["-hurwitz_zeta(z, 1.75)"],
                &["-exp(-log(0.75) z)"],
            ],
            [0.1, 6.0, -20.0, 20.0],
        ),
    ),
    (
        "W e^W = z",
        identity(
            &[&["lambertw(z, 0)", "exp(lambertw(z, 0))"], &["-z"]],
            PLANE,
        ),
    ),
    (
        "W e^W = z, branch 2",
        identity(
            &[&["lambertw(z, 2)", "exp(lambertw(z, 2))"], &["-z"]],
            PLANE,
        ),
    ),
    (
        "Ai Bi′ - Ai′ Bi = 1/π",
        identity(
            &[
                &["airy_ai(z)", "airy_bi_prime(z)"],
                &["-airy_ai_prime(z)", "airy_bi(z)"],
                &["-1/pi + 0i"],
            ],
            PLANE,
        ),
    ),
    (
        "addition theorem of sn",
        identity(
            &[
                &["jacobi_sn(z + 0.25 + 0.5i, 0.5)"],
                &[
                    "-0.5 jacobi_sn(z + 0.25 + 0.5i, 0.5)",
                    "jacobi_sn(z, 0.5)^2",
                    "jacobi_sn(0.25 + 0.5i, 0.5)^2",
                ],
                &[
                    "-jacobi_sn(z, 0.5)",
                    "jacobi_cn(0.25 + 0.5i, 0.5)",
                    "jacobi_dn(0.25 + 0.5i, 0.5)",
                ],
                &[
                    "-jacobi_sn(0.25 + 0.5i, 0.5)",
                    "jacobi_cn(z, 0.5)",
                    "jacobi_dn(z, 0.5)",
                ],
            ],
            PLANE,
        ),
    ),
    (
        "sn² + cn² = 1 for m > 1",
        identity(
            &[
                &["jacobi_sn(z, 2.5)^2"],
                &["jacobi_cn(z, 2.5)^2"],
                &["-1 + 0i"],
            ],
            PLANE,
        ),
    ),
    (
        "dn² + m sn² = 1",
        identity(
            &[
                &["jacobi_dn(z, 0.25 + 0.5i)^2"],
                &["(0.25 + 0.5i) jacobi_sn(z, 0.25 + 0.5i)^2"],
                &["-1 + 0i"],
            ],
            PLANE,
        ),
    ),
    (
        "addition theorem of ℘, of invariants",
        identity(
            &addition!(
                "weierstrass_p_invariants",
                "weierstrass_p_prime_invariants",
                "4, 1"
            ),
            PLANE,
        ),
    ),
    (
        "addition theorem of ℘, of a lattice",
        identity(
            &addition!("weierstrass_p", "weierstrass_p_prime", "i"),
            PLANE,
        ),
    ),
    (
        "j(-1/τ) = j(τ)",
        identity(&[&["klein_j(z)"], &["-klein_j(-1/z)"]], UPPER),
    ),
    (
        "E₄(-1/τ) = τ⁴ E₄(τ)",
        identity(
            &[&["eisenstein_e4(-1/z)"], &["-z^4", "eisenstein_e4(z)"]],
            UPPER,
        ),
    ),
    (
        "E₆(-1/τ) = τ⁶ E₆(τ)",
        identity(
            &[&["eisenstein_e6(-1/z)"], &["-z^6", "eisenstein_e6(z)"]],
            UPPER,
        ),
    ),
    (
        "√(-iτ) θ₃(z|τ) = e^(-iz²/(πτ)) θ₃(z/τ|-1/τ)",
        identity(
            &[
                &["sqrt(-i z)", "jacobi_theta3(0.5, exp(pi i z))"],
                &["-exp(-0.25 i/(pi z))", "jacobi_theta3(0.5/z, exp(-pi i/z))"],
            ],
            UPPER,
        ),
    ),
    (
        "θ₃⁴ = θ₂⁴ + θ₄⁴",
        identity(
            &[
                &["jacobi_theta3(0, z)^4"],
                &["-jacobi_theta2(0, z)^4"],
                &["-jacobi_theta4(0, z)^4"],
            ],
            DISC,
        ),
    ),
    (
        "F(a, b; c; z) = (1 - z)^(c - a - b) F(c - a, c - b; c; z)",
        identity(
            &[
                &["hypergeometric(0.5, 0.75, 1.5, z)"],
                &["-exp(0.25 log1p(-z))", "hypergeometric(1, 0.75, 1.5, z)"],
            ],
            DISC,
        ),
    ),
];

/// Values and derivatives of a formula at points.
fn run(machine: &Machine, text: &str, points: &[Complex]) -> Vec<[Complex; 2]> {
    let points: Vec<Point> = points
        .iter()
        .map(|z| Point {
            args: z.to_vec(),
            params: Vec::new(),
        })
        .collect();
    let formula = formula(&format!("f(z: complex) = {text}\n"));
    let values = machine.run(&formula, What::Value, &points).expect(text);
    let slopes = machine
        .run(&formula, What::Derivative, &points)
        .expect(text);
    let pair = |row: &[f64]| [row[0], row[1]];
    let both = values.iter().zip(&slopes);
    both.map(|(value, slope)| [pair(value), pair(&slope[slope.len() - 2..])])
        .collect()
}

fn times(a: Complex, b: Complex) -> Complex {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

fn size(a: Complex) -> f64 {
    a[0].hypot(a[1])
}

/// The same points in every run.
fn points(region: [f64; 4]) -> Vec<Complex> {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut next = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(state >> 40).unwrap_or(0)) / f64::from(1 << 24)
    };
    let within = |low: f64, high: f64, t: f64| f64::from((low + (high - low) * t) as f32);
    let point = |_| {
        let [left, right, low, high] = region;
        [within(left, right, next()), within(low, high, next())]
    };
    (0..60).map(point).collect()
}

/// The largest sum in units of what the factors may make of it.
fn worst(machine: &Machine, identity: &Identity, unit: f64) -> (f64, Complex) {
    let points = points(identity.region);
    let terms: Vec<Vec<_>> = identity
        .terms
        .iter()
        .map(|factors| factors.iter().map(|f| run(machine, f, &points)).collect())
        .collect();
    let mut found = (0.0f64, [0.0, 0.0]);
    for (k, &z) in points.iter().enumerate() {
        let (mut sum, mut scale) = ([0.0, 0.0], 0.0);
        for factors in &terms {
            let product = factors.iter().fold([1.0, 0.0], |p, f| times(p, f[k][0]));
            sum = [sum[0] + product[0], sum[1] + product[1]];
            for (j, factor) in factors.iter().enumerate() {
                let others = factors.iter().enumerate().filter(|(i, _)| *i != j);
                let others: f64 = others.map(|(_, f)| size(f[k][0])).product();
                let own = 16.0 * size(factor[k][0]) + 4.0 * (1.0 + size(z)) * size(factor[k][1]);
                scale += others * own;
            }
        }
        // a pole, or what overflows
        if !scale.is_finite() || scale > 1e30 {
            continue;
        }
        let factor = size(sum) / (unit * scale);
        if factor.is_nan() || factor > found.0 {
            found = (factor, z);
        }
    }
    found
}

fn check(machine: &Machine, unit: f64, most: f64) {
    let mut wrong = Vec::new();
    for (name, identity) in &IDENTITIES {
        let (factor, z) = worst(machine, identity, unit);
        println!("{name}, {machine}: {factor:.2}");
        if factor.is_nan() || factor > most {
            wrong.push(format!("{name}: {factor:.2} at {z:?}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Twice what is counted: that of e^(log Γ) hangs on the rounding of a large exponent.
#[test]
fn identities_hold_in_f64() {
    check(&Machine::Reference, 2f64.powi(-53), 2.0);
}

/// What 16 u of each factor, and changes of its argument by 4 u, may do.
#[test]
fn identities_hold_in_single_precision() {
    let machine = Machine::Processor(Arithmetic::Ieee32, Precision::Accurate);
    check(&machine, 2f64.powi(-24), 1.0);
}

/// An equation that is off by a millionth is no identity.
#[test]
fn a_wrong_identity_is_caught() {
    let wrong = identity(&[&["klein_j(z)"], &["-1.000001 klein_j(-1/z)"]], UPPER);
    assert!(worst(&Machine::Reference, &wrong, 2f64.powi(-53)).0 > 16.0);
}
