//! Periods. No format holds 2π, so x + 2πq is no argument. But a whole number p from the continued fraction of π is
//! 2πq + δ with a small δ, known to many digits, and x + p is exact for x with few bits: f(x + p) is f at x turned by δ.
//! That holds an argument's reduction to exact arithmetic, with no table of values. And doubling is exact at any size:
//! sin 2x = 2 sin x cos x where x has 30 digits before the point.

use pullback_compiler::What;
use pullback_tests::accuracy::error::Judge;
use pullback_tests::accuracy::evaluators::Machine;
use pullback_tests::accuracy::tables::Domain;

use super::{machines, numbers, run, run_twice, units};

/// p = 2πq + δ, and the step of the x for which x + p is exact in float32.
struct Turn {
    whole: f64,
    rest: f64,
    step: f64,
}

/// Convergents of π, doubled where their denominator is odd; `p - 2*pi*q` by mpmath at 300 bits.
const TURNS: [Turn; 5] = [
    // q = 7
    Turn {
        whole: 44.0,
        rest: 0.017_702_849_742_894_662,
        step: 1.0 / 65_536.0,
    },
    // q = 113
    Turn {
        whole: 710.0,
        rest: 6.028_870_672_810_744e-5,
        step: 1.0 / 8192.0,
    },
    // q = 16551
    Turn {
        whole: 103_993.0,
        rest: -1.912_933_577_959_042e-5,
        step: 1.0 / 128.0,
    },
    // q = 49766
    Turn {
        whole: 312_689.0,
        rest: 2.900_699_389_336_178_7e-6,
        step: 1.0 / 32.0,
    },
    // q = 680060
    Turn {
        whole: 4_272_943.0,
        rest: -5.495_794_978_105_185e-7,
        step: 0.5,
    },
];

/// What the arithmetic of the test itself may add, of numbers up to 1.
const OWN: f64 = 8.0 * f64::EPSILON;

/// x, some hundred of them with few bits: within 6 of zero where the step is small.
fn places(turn: &Turn) -> Vec<f64> {
    (-150..=150)
        .map(|k| f64::from(k * 37 % 151) * turn.step * (0.04 / turn.step).ceil())
        .collect()
}

fn columns(points: &[f64]) -> Vec<Vec<f64>> {
    points.iter().map(|&x| vec![x]).collect()
}

/// sin(x + p) = sin x cos δ + cos x sin δ, and the same of the cosine and of the derivatives of both.
#[test]
fn waves_and_their_slopes_repeat() {
    for machine in &machines() {
        let (sin, slope_of_sin) = units("sin", Domain::Real, machine);
        let (cos, slope_of_cos) = units("cos", Domain::Real, machine);
        let unit = |v: f64| machine.format().unit(v);
        for turn in &TURNS {
            let xs = places(turn);
            let (sin_d, cos_d) = turn.rest.sin_cos();
            let shifted: Vec<f64> = xs.iter().map(|x| x + turn.whole).collect();
            assert!(shifted.iter().all(|x| f64::from(*x as f32) == *x));
            let rows = |name: &str| {
                let source = format!("f(x: real) = {name}(x)\n");
                let (here, there) = (columns(&xs), columns(&shifted));
                run_twice(machine, &source, What::Gradient, &here, &there)
            };
            let ((s, s_there), (c, c_there)) = (rows("sin"), rows("cos"));
            for k in 0..xs.len() {
                let (sine, cosine) = (s[k][0], c[k][0]);
                let known = sin * unit(sine) * cos_d.abs() + cos * unit(cosine) * sin_d.abs();
                let across = cos * unit(cosine) * cos_d.abs() + sin * unit(sine) * sin_d.abs();
                let up = sine * cos_d + cosine * sin_d;
                let along = cosine * cos_d - sine * sin_d;
                let cases = [
                    ("sin", s_there[k][0], up, known + sin * unit(up)),
                    ("cos", c_there[k][0], along, across + cos * unit(along)),
                    (
                        "sin′",
                        s_there[k][1],
                        along,
                        across + slope_of_sin * unit(along),
                    ),
                    ("cos′", c_there[k][1], -up, known + slope_of_cos * unit(up)),
                ];
                for (name, got, expected, allowed) in cases {
                    assert!(
                        (got - expected).abs() <= allowed * (1.0 + 1e-6) + OWN,
                        "{}: {name}({} + {}) = {got:e}, not {expected:e}",
                        machine,
                        xs[k],
                        turn.whole
                    );
                }
            }
        }
    }
}

/// The tangent has the period π: tan(x + p) = (t + τ)/(1 - tτ), τ = tan δ, p = πq + δ.
#[test]
fn tangents_repeat() {
    let turns = [
        (22.0, 0.008_851_424_871_447_331, 1.0 / 65_536.0),
        (355.0, 3.014_435_336_405_372e-5, 1.0 / 16_384.0),
        (104_348.0, 1.101_501_758_446_33e-5, 1.0 / 128.0),
        (1_146_408.0, 5.877_799_728_814_151e-7, 1.0 / 8.0),
    ];
    for machine in &machines() {
        let (tan, _) = units("tan", Domain::Real, machine);
        let unit = |v: f64| machine.format().unit(v);
        for (whole, rest, step) in turns {
            let turn = Turn { whole, rest, step };
            let xs = places(&turn);
            let shifted: Vec<f64> = xs.iter().map(|x| x + whole).collect();
            assert!(shifted.iter().all(|x| f64::from(*x as f32) == *x));
            let tan_of = "f(x: real) = tan(x)\n";
            let (here, there) = (columns(&xs), columns(&shifted));
            let (here, there) = run_twice(machine, tan_of, What::Value, &here, &there);
            let tau = f64::tan(rest);
            for ((x, here), there) in xs.iter().zip(&here).zip(&there) {
                let (t, got) = (here[0], there[0]);
                let below = 1.0 - t * tau;
                if below.abs() < 0.1 {
                    // at a pole of one of both, the quotient has no digits
                    continue;
                }
                let expected = (t + tau) / below;
                let magnified = (1.0 + tau * tau) / (below * below);
                let allowed = tan * (unit(expected) + magnified * unit(t));
                let own = OWN * (expected.abs() + magnified * t.abs() + 1.0);
                assert!(
                    (got - expected).abs() <= allowed * (1.0 + 1e-6) + own,
                    "{}: tan({x} + {whole}) = {got:e}, not {expected:e}",
                    machine
                );
            }
        }
    }
}

/// Values of the complex exponential and the waves at z, and turned by each of [`COMPLEX_TURNS`].
struct Turned {
    here: Vec<[f64; 2]>,
    there: Vec<Vec<[f64; 2]>>,
}

const COMPLEX_TURNS: [usize; 2] = [1, 2];

/// By one shader: compiling it is what takes time.
fn turned(machine: &Machine, name: &str, zs: &[[f64; 2]], imaginary: bool) -> Turned {
    let mut points: Vec<Vec<f64>> = zs.iter().map(|z| z.to_vec()).collect();
    for turn in COMPLEX_TURNS.map(|k| &TURNS[k]) {
        let (x, y) = if imaginary {
            (0.0, turn.whole)
        } else {
            (turn.whole, 0.0)
        };
        points.extend(zs.iter().map(|z| vec![z[0] + x, z[1] + y]));
    }
    let source = format!("f(z: complex) = {name}(z)\n");
    let rows = run(machine, &source, What::Value, &points);
    let values: Vec<[f64; 2]> = rows.iter().map(|r| [r[0], r[1]]).collect();
    let mut parts = values.chunks(zs.len()).map(<[[f64; 2]]>::to_vec);
    Turned {
        here: parts.next().expect("values"),
        there: parts.collect(),
    }
}

fn product(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

/// exp(z + i p) = exp(z) (cos δ + i sin δ); sin and cos along the real axis, sinh and cosh along the imaginary one.
#[test]
fn complex_exponentials_and_waves_repeat() {
    // the function, its partner in the sum, and the factor of the partner: i or ±1
    let cases: [(&str, &str, [f64; 2]); 5] = [
        ("exp", "exp", [0.0, 1.0]),
        ("sinh", "cosh", [0.0, 1.0]),
        ("cosh", "sinh", [0.0, 1.0]),
        ("sin", "cos", [1.0, 0.0]),
        ("cos", "sin", [-1.0, 0.0]),
    ];
    let places = places(&TURNS[2]);
    let zs: Vec<[f64; 2]> = places
        .iter()
        .zip(places.iter().rev())
        .map(|(x, y)| [*x, y + 0.03125])
        .collect();
    for machine in &machines() {
        let unit = |v: [f64; 2]| machine.format().unit(v[0].hypot(v[1]));
        let values = cases.map(|(name, _, factor)| {
            let imaginary = factor[1] != 0.0;
            (name, turned(machine, name, &zs, imaginary))
        });
        let of = |name: &str| &values.iter().find(|(n, _)| *n == name).expect(name).1;
        for (name, partner, factor) in cases {
            let (bound, _) = units(name, Domain::Complex, machine);
            let (f, g) = (of(name), of(partner));
            for (turn, far) in COMPLEX_TURNS.map(|k| &TURNS[k]).iter().zip(&f.there) {
                let (sin_d, cos_d) = turn.rest.sin_cos();
                for (k, z) in zs.iter().enumerate() {
                    let along = product(f.here[k], [cos_d, 0.0]);
                    let across = product(product(g.here[k], factor), [sin_d, 0.0]);
                    let expected = [along[0] + across[0], along[1] + across[1]];
                    // √2 for two components that are off by as much
                    let near = unit(f.here[k]) * cos_d.abs() + unit(g.here[k]) * sin_d.abs();
                    let allowed = 1.42 * bound * (unit(expected) + near);
                    let size = expected[0].hypot(expected[1]) + g.here[k][0].hypot(g.here[k][1]);
                    let error = (far[k][0] - expected[0]).hypot(far[k][1] - expected[1]);
                    assert!(
                        error <= allowed * (1.0 + 1e-6) + OWN * size,
                        "{}: {name} of {z:?} and {}: {:?}, not {expected:?}",
                        machine,
                        turn.whole,
                        far[k]
                    );
                }
            }
        }
    }
}

/// sin 2x = 2 sin x cos x and cos 2x = (cos x - sin x)(cos x + sin x) for float32 numbers of every size.
#[test]
fn waves_of_twice_the_angle_follow() {
    let xs = numbers(1500, 120.0);
    let doubled: Vec<f64> = xs.iter().map(|x| 2.0 * x).collect();
    for machine in &machines() {
        let (sin, _) = units("sin", Domain::Real, machine);
        let (cos, _) = units("cos", Domain::Real, machine);
        let unit = |v: f64| machine.format().unit(v);
        let both = "f(x: real) = complex(sin(x), cos(x))\n";
        let (here, there) = (columns(&xs), columns(&doubled));
        let (here, there) = run_twice(machine, both, What::Value, &here, &there);
        for ((x, here), there) in xs.iter().zip(&here).zip(&there) {
            let (s, c) = (here[0], here[1]);
            let (off_s, off_c) = (sin * unit(s), cos * unit(c));
            let (sine, cosine) = (2.0 * s * c, (c - s) * (c + s));
            let allowed = 2.0 * (off_s * c.abs() + off_c * s.abs()) + sin * unit(sine);
            let across = 2.0 * (off_s * s.abs() + off_c * c.abs()) + cos * unit(cosine);
            for (name, got, expected, allowed) in [
                ("sin", there[0], sine, allowed),
                ("cos", there[1], cosine, across),
            ] {
                assert!(
                    (got - expected).abs()
                        <= allowed * (1.0 + 1e-6) + OWN * expected.abs().max(1e-30),
                    "{}: {name}(2 · {x:e}) = {got:e}, not {expected:e}",
                    machine
                );
            }
        }
    }
}

/// The angle of (cos x, sin x) is x itself in [-π, π].
#[test]
fn angles_are_found_again() {
    let xs: Vec<f64> = (-1000..=1000)
        .map(|k| f64::from((f64::from(k) * 0.00314) as f32))
        .collect();
    for machine in &machines() {
        let (sin, _) = units("sin", Domain::Real, machine);
        let (cos, _) = units("cos", Domain::Real, machine);
        let (atan2, _) = units("atan2", Domain::Real, machine);
        let unit = |v: f64| machine.format().unit(v);
        let rows = run(
            machine,
            "f(x: real) = atan2(sin(x), cos(x))\n",
            What::Value,
            &columns(&xs),
        );
        for (x, row) in xs.iter().zip(&rows) {
            let (s, c) = x.sin_cos();
            let turned = sin * unit(s) * c.abs() + cos * unit(c) * s.abs();
            let allowed = turned + atan2 * unit(*x);
            assert!(
                (row[0] - x).abs() <= allowed * (1.0 + 1e-6),
                "{}: {x} became {}",
                machine,
                row[0]
            );
        }
    }
}
