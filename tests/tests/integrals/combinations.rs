//! Random combinations out of the closed set: all have a closed form, and it is what an adaptive rule finds.

use std::fmt::Write as _;

use pullback_compiler::formula::Formula;
use pullback_compiler::integrate::{Otherwise, field_integral};
use pullback_compiler::lower::Precision;
use pullback_compiler::{Evaluator, What, compile};
use pullback_runtime::executor::Arithmetic;
use pullback_tests::accuracy::evaluators::Machine;
use pullback_tests::marches::quadrature::{Exact, adaptive};

use super::points;

/// The generator of Knuth's MMIX.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn of(&mut self, count: usize) -> usize {
        (self.unit() * count as f64) as usize
    }

    /// A number with two digits after the point, of either sign.
    fn number(&mut self) -> String {
        let size = 0.25 + 1.5 * self.unit();
        format!("{:.2}", if self.unit() < 0.5 { -size } else { size })
    }

    /// The same, positive.
    fn positive(&mut self) -> String {
        format!("{:.2}", 0.3 + 1.5 * self.unit())
    }

    fn coordinate(&mut self) -> &'static str {
        ["x", "y", "z"][self.of(3)]
    }

    /// A form of degree 1 in the coordinates.
    fn affine(&mut self) -> String {
        let [a, b, c] = std::array::from_fn(|_| self.number());
        match self.of(3) {
            0 => self.coordinate().to_owned(),
            1 => format!("({a}*{} + {b})", self.coordinate()),
            _ => format!("({a}*x + {b}*{} + {c})", ["y", "z"][self.of(2)]),
        }
    }

    /// A sum of squares.
    fn bowl(&mut self) -> String {
        let a = self.number();
        [
            "(x^2 + y^2 + z^2)",
            "((x - A)^2 + z^2)",
            "(x^2 + (y + A)^2 + z^2)",
        ][self.of(3)]
        .replace('A', &format!("({a})"))
    }

    fn polynomial(&mut self) -> String {
        let [u, v] = std::array::from_fn(|_| self.affine());
        [
            u.clone(),
            format!("{u}*{v}"),
            format!("{u}^2"),
            format!("({u}^3 - {v})"),
        ][self.of(4)]
        .clone()
    }

    fn wave(&mut self) -> String {
        let u = self.affine();
        format!("{}({}*{u})", ["sin", "cos"][self.of(2)], self.positive())
    }

    fn exponential(&mut self) -> String {
        let u = self.affine();
        format!("exp({}*{u})", self.number())
    }

    /// A product whose factors may all be multiplied with one another: polynomials, waves and exponentials.
    fn product(&mut self) -> String {
        let count = 1 + self.of(3);
        let mut factors = Vec::new();
        for k in 0..count {
            factors.push(match self.of(if k == 0 { 3 } else { 2 }) {
                0 => self.wave(),
                1 => self.polynomial(),
                _ => self.exponential(),
            });
        }
        factors.join("*")
    }

    /// What is closed by itself.
    fn alone(&mut self) -> String {
        let (q, u, k) = (self.bowl(), self.affine(), self.positive());
        let forms = [
            format!("1/({q} + {k})"),
            format!("1/({q} + {k})^2"),
            format!("1/({q} + {k})^3"),
            format!("sqrt({q} + {k})"),
            format!("sqrt{q}"),
            format!("1/sqrt({q} + {k})"),
            format!("({q} + {k})^1.5"),
            format!("1/({q} + {k})^1.5"),
            format!("{u}/({q} + {k})"),
            format!("{u}*sqrt({q} + {k})"),
            format!("log({q} + {k})"),
            format!("exp(-{k}*{q})"),
            format!("{u}*exp(-{k}*{q})"),
            format!("tanh({k}*{u})"),
            format!("1/cosh({k}*{u})^2"),
            format!("atan({k}*{u})"),
            format!("erf({k}*{u})"),
            format!("1/(1 + exp({k}*{u}))"),
            format!("asinh({k}*{u})"),
        ];
        forms[self.of(forms.len())].clone()
    }

    /// What is cut in pieces.
    fn pieces(&mut self) -> String {
        let [u, v] = std::array::from_fn(|_| self.affine());
        let (k, q, smooth) = (self.positive(), self.bowl(), self.product());
        let forms = [
            format!("abs({u})"),
            format!("max({u}, {v})"),
            format!("min({u}, {k})"),
            format!("clamp({u}, 0, {k})"),
            format!("smoothstep(-{k}, {k}, {u})"),
            format!("max(0, {k} - {q})^2"),
            format!("step({k}, {u})*{smooth}"),
            format!("(if {u} < {v} then {smooth} else {k})"),
            format!("(if {q} < {k} then {smooth} else 0)"),
        ];
        forms[self.of(forms.len())].clone()
    }

    fn term(&mut self) -> String {
        let n = 2 + self.of(3);
        let (c, u, k) = (self.number(), self.affine(), self.positive());
        match self.of(8) {
            0..3 => format!("{c}*{}", self.product()),
            3 | 4 => format!("{c}*{}", self.alone()),
            5 | 6 => self.pieces(),
            _ => {
                let forms = [
                    format!("sum(j in 1..{n}, sin(j*{u})/j)"),
                    format!("sum(j in 1..{n}, {k}*x^j*exp(-j*y/{n}))"),
                    format!("sum(j in 1..{n}, 1/((x - j/{n})^2 + z^2 + {k}))"),
                ];
                forms[self.of(forms.len())].clone()
            }
        }
    }

    fn sum(&mut self) -> String {
        let count = 1 + self.of(3);
        let terms: Vec<String> = (0..count).map(|_| self.term()).collect();
        terms.join(" + ")
    }

    /// A program whose f is made of these, by functions of its own, names for parts, scaling, and a change of coordinates.
    fn program(&mut self) -> String {
        let body = self.sum();
        let f = match self.of(4) {
            0 => format!("f(x, y, z) = {body}"),
            1 => {
                let [u, v, w] = std::array::from_fn(|_| self.affine());
                format!(
                    "g(x, y, z) = {body}\nf(x, y, z) = {}*g({u}, {v}, {w})",
                    self.number()
                )
            }
            2 => format!(
                "f(x, y, z) = m*{} + {} where m = {}",
                self.product(),
                body,
                self.affine()
            ),
            _ => format!("param k = {}\nf(x, y, z) = k*({body})", self.positive()),
        };
        format!("{f}\nshow additive(f)")
    }
}

/// o, d, a, b.
fn rays(random: &mut Random, count: usize) -> Vec<[f64; 8]> {
    let mut between = |lo: f64, hi: f64| f64::from((lo + (hi - lo) * random.unit()) as f32);
    (0..count)
        .map(|k| {
            let mut ray: [f64; 8] = std::array::from_fn(|_| between(-1.0, 1.0));
            match k % 4 {
                0 => ray[3] = 0.0,
                1 => ray[4] = f64::from(1e-4_f32),
                2 => ray[5] = f64::from(1e-30_f32),
                _ => {}
            }
            ray[7] = f64::from((ray[6] + between(0.01, 3.0)) as f32);
            ray
        })
        .collect()
}

fn exact(of: &Formula, params: &[f64], ray: &[f64; 8]) -> Exact {
    let mut evaluator = Evaluator::new(of, What::Value).unwrap();
    let mut out = [0.0];
    let places: Vec<f64> = (0..=16)
        .map(|k| ray[6] + (ray[7] - ray[6]) * f64::from(k) / 16.0)
        .collect();
    adaptive(&places, |t| {
        let p: [f64; 3] = std::array::from_fn(|c| ray[c] + t * ray[3 + c]);
        evaluator.eval(params, 0.0, 0.0, &p, &mut out);
        out[0]
    })
}

/// What was found of so many combinations.
#[derive(Debug, Default)]
struct Tally {
    closed: usize,
    numerical: usize,
    refused: usize,
    rays: usize,
    within: usize,
    complaints: String,
}

fn tally(count: usize, seed: u64) -> Tally {
    let mut random = Random(seed);
    let mut out = Tally::default();
    for _ in 0..count {
        let text = random.program();
        let rays = rays(&mut random, 4);
        let answer = compile(&text);
        let Some(program) = answer.program else {
            panic!("{text}: {:?}", answer.diagnostics)
        };
        let of = &program.pictures()[0].formula;
        let params: Vec<f64> = text
            .strip_prefix("param k = ")
            .and_then(|rest| rest.lines().next())
            .map(|value| value.parse().unwrap())
            .into_iter()
            .collect();
        match field_integral(of, Otherwise::Refuse) {
            Ok(made) => {
                out.closed += 1;
                compare(of, &made.into_formula(of), &params, &rays, &text, &mut out);
            }
            Err(problem) => {
                let made = field_integral(of, Otherwise::Quadrature);
                *(if made.is_ok() {
                    &mut out.numerical
                } else {
                    &mut out.refused
                }) += 1;
                let _ = writeln!(out.complaints, "{text}: {problem:?}");
            }
        }
    }
    out
}

fn compare(
    of: &Formula,
    integral: &Formula,
    params: &[f64],
    rays: &[[f64; 8]],
    text: &str,
    out: &mut Tally,
) {
    let mut at = points(rays.iter().map(|r| r.to_vec()));
    for point in &mut at {
        point.params = params.to_vec();
    }
    let run = |machine: &Machine| machine.run(integral, What::Value, &at).unwrap();
    let double = run(&Machine::Reference);
    let single = run(&Machine::Processor(Arithmetic::Ieee32, Precision::Accurate));
    for (k, ray) in rays.iter().enumerate() {
        let exact = exact(of, params, ray);
        if !exact.value.is_finite() {
            continue;
        }
        let off = |value: f64| {
            let off = (value - exact.value).abs() / exact.size.max(1e-30);
            if off.is_nan() { f64::INFINITY } else { off }
        };
        out.rays += 1;
        out.within += usize::from(off(single[k][0]) <= 1e-6);
        // eight digits of the rule and the roundings of the ray are enough to tell a wrong rule
        if off(double[k][0]) > 1e-8 || off(single[k][0]) > 1e-3 {
            let _ = writeln!(
                out.complaints,
                "{text}\n    on {ray:?}: {:e} and {:e}, not {:e}",
                double[k][0], single[k][0], exact.value
            );
        }
    }
}

fn check(count: usize, seed: u64) {
    let found = tally(count, seed);
    println!(
        "{count} combinations: {} closed, {} numerical, {} refused; {} rays, {} within 1e-6 in binary32",
        found.closed, found.numerical, found.refused, found.rays, found.within
    );
    assert!(found.complaints.is_empty(), "{}", found.complaints);
    assert_eq!(found.closed, count);
}

#[test]
fn combinations() {
    check(60, 1);
}

/// As many as docs/integrals-stability.md tells of:
/// `cargo test -p pullback-tests --test integrals a_thousand_combinations -- --ignored --nocapture`.
#[test]
#[ignore = "minutes"]
fn a_thousand_combinations() {
    check(1000, 2);
}
