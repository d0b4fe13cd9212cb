//! The accuracy traps of existing plotters, each through the whole compiler, from the text of a formula to a dispatch.
//!
//! Every argument is a float32 number and every value is for exactly that argument, from arithmetic of 60 digits. The
//! tolerance of a row is in units in the last place of the machine: the declared bound of the function, or what the
//! roundings of a longer formula add up to; 0 demands the number itself.
//!
//! Not here, for they are no matter of a function: the distance |f|/|∇f| at multiple zeros and the 1/ln 2 between log2
//! and ln in contour lines (both the scenes'), and the few float32 abscissae of a view of width 1e-4 (`tiers`).

use std::fmt::Write as _;

use pullback_compiler::What;
use pullback_compiler::lower::Precision;
use pullback_tests::accuracy::error::Judge;
use pullback_tests::accuracy::evaluators::{Machine, Point, suite_gpu};
use pullback_tests::accuracy::subjects::formula;

/// Every machine that the traps are laid for. Further tiers are further entries.
fn machines() -> Vec<Machine> {
    let mut machines = vec![Machine::Reference];
    if let Some(gpu) = suite_gpu() {
        for tier in [Precision::Accurate, Precision::Extended, Precision::Double] {
            machines.push(Machine::Gpu(Box::new(gpu.clone()), tier));
        }
    }
    machines
}

/// A formula, its argument, what the columns are, and the tolerance in units in the last place of each.
struct Trap {
    source: &'static str,
    args: Vec<f64>,
    what: What,
    expected: Vec<f64>,
    ulps: f64,
}

fn trap(source: &'static str, args: &[f32], expected: &[f64], ulps: f64) -> Trap {
    Trap {
        source,
        args: args.iter().map(|&x| f64::from(x)).collect(),
        what: What::Value,
        expected: expected.to_vec(),
        ulps,
    }
}

/// What is wrong with a result, in words; empty where nothing is.
fn judge(trap: &Trap, machine: &Machine) -> String {
    let point = Point {
        args: trap.args.clone(),
        params: Vec::new(),
    };
    let rows = machine
        .run(&formula(trap.source), trap.what, &[point])
        .expect(trap.source);
    let mut wrong = String::new();
    for (k, (&got, &expected)) in rows[0].iter().zip(&trap.expected).enumerate() {
        if expected.is_nan() {
            continue; // not stated
        }
        let within = if expected.is_finite() && expected != 0.0 {
            (got - expected).abs() <= trap.ulps * machine.format().unit(expected)
        } else {
            got == expected
        };
        if !within {
            let _ = writeln!(
                wrong,
                "{}: {} at {:?}: column {k} is {got:e}, not {expected:e}",
                machine, trap.source, trap.args
            );
        }
    }
    wrong
}

fn check(traps: &[Trap]) {
    let mut wrong = String::new();
    for machine in &machines() {
        for trap in traps {
            wrong += &judge(trap, machine);
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

const NOT_STATED: f64 = f64::NAN;

#[test]
fn logarithms_keep_their_real_part_near_the_unit_circle() {
    // |0.6 + 0.8i| is not 1 for the float32 numbers next to 0.6 and 0.8
    check(&[trap(
        "f(z: complex) = log(z)",
        &[0.6, 0.8],
        &[2.384_185_769_699_343e-8, 0.927_295_206_080_683_6],
        2.1,
    )]);
}

#[test]
fn roots_beside_their_cut_keep_both_parts() {
    check(&[
        trap(
            "f(z: complex) = sqrt(z)",
            &[-1.0, 1e-4],
            &[4.999_999_867_439_376e-5, 1.000_000_001_249_999_9],
            2.1,
        ),
        trap(
            "f(z: complex) = sqrt(z)",
            &[-1.0, -1e-4],
            &[4.999_999_867_439_376e-5, -1.000_000_001_249_999_9],
            2.1,
        ),
    ]);
}

#[test]
fn quotients_do_not_overflow_on_the_way() {
    check(&[
        trap("f(z: complex) = z/z", &[1e30, 1e30], &[1.0, 0.0], 0.0),
        trap("f(z: complex) = z/z", &[1e-30, 1e-30], &[1.0, 0.0], 0.0),
        trap("f(z: complex) = z/z", &[3e38, 2e38], &[1.0, 0.0], 0.0),
    ]);
}

#[test]
fn tangents_far_from_the_axis_are_the_unit() {
    check(&[
        trap(
            "f(z: complex) = tan(z)",
            &[1.0, 100.0],
            &[NOT_STATED, 1.0],
            0.0,
        ),
        trap(
            "f(z: complex) = tan(z)",
            &[1.0, -100.0],
            &[NOT_STATED, -1.0],
            0.0,
        ),
        trap(
            "f(z: complex) = tanh(z)",
            &[50.0, 1.0],
            &[1.0, NOT_STATED],
            0.0,
        ),
        trap(
            "f(z: complex) = tanh(z)",
            &[-50.0, 1.0],
            &[-1.0, NOT_STATED],
            0.0,
        ),
        // the other part, where float32 can hold it: 4 sin y cos y e^-2x
        trap(
            "f(z: complex) = tanh(z)",
            &[30.0, 1.0],
            &[1.0, 1.592_454_540_898_266_7e-26],
            4.3,
        ),
    ]);
}

#[test]
fn exponentials_do_not_lose_their_phase() {
    check(&[
        trap(
            "f(z: complex) = exp(z)",
            &[88.0, 2.0],
            &[-6.873_232_026_423_233e37, 1.501_828_596_718_051_4e38],
            2.1,
        ),
        // e^89 overflows, e^89 cos y does not
        trap(
            "f(z: complex) = exp(z)",
            &[89.0, 1.570_312_5],
            &[2.172_194_895_880_303e35, NOT_STATED],
            2.1,
        ),
    ]);
}

/// What cancels as it is written; the f64 reference computes just that, a shader the rewritten form.
#[test]
fn cancelling_formulas_are_rewritten() {
    let traps = [
        // 2 sin²(x/2)/x²: the sine's error twice, and three roundings
        trap(
            "f(x: real) = (1 - cos(x))/x^2",
            &[1e-3],
            &[0.499_999_958_333_330_8],
            6.0,
        ),
        trap(
            "f(z: complex) = (1 - cos(z))/z^2",
            &[1e-3, 0.0],
            &[0.499_999_958_333_330_8, 0.0],
            8.0,
        ),
        // (|x| - 10⁴)(|x| + 10⁴): the difference is exact
        trap(
            "f(x: real) = x^2 - 1e8",
            &[10_000.001],
            &[19.531_250_953_674_316],
            1.0,
        ),
    ];
    let shaders = machines().into_iter().skip(1);
    let wrong: String = shaders
        .flat_map(|machine| {
            traps
                .iter()
                .map(move |t| judge(t, &machine))
                .collect::<Vec<_>>()
        })
        .collect();
    assert!(wrong.is_empty(), "{wrong}");
}

/// What leaves the range of float32 as it is written: a logarithmic derivative, modulus and phase of an exponential.
#[test]
fn powers_and_exponentials_need_no_range() {
    let log_derivative = trap(
        "f(z: complex) = diff(z^-8, z)/z^-8",
        &[1e-5, 0.0],
        &[-800_000.020_209_700_5, 0.0],
        2.1,
    );
    // z⁻⁸ is 1e40 and more, and its derivative 1e46
    let wrong: String = machines()
        .iter()
        .skip(1)
        .map(|machine| judge(&log_derivative, machine))
        .collect();
    assert!(wrong.is_empty(), "{wrong}");
    let rewritten = [
        trap(
            "f(z: complex) = diff(exp(z^2), z)/exp(z^2)",
            &[30.0, 2.0],
            &[60.0, 4.0],
            0.0,
        ),
        trap(
            "f(z: complex) = log(abs(exp(z)))",
            &[100.0, 2.0],
            &[100.0],
            0.0,
        ),
        trap("f(z: complex) = arg(exp(z))", &[100.0, 2.0], &[2.0], 2.1),
        // 100 rad are 100 - 32 π
        trap(
            "f(z: complex) = arg(exp(z))",
            &[1000.0, 100.0],
            &[-0.530_964_914_873_383_6],
            2.1,
        ),
        trap(
            "f(z: complex) = log(exp(z))",
            &[100.0, 2.0],
            &[100.0, 2.0],
            2.1,
        ),
        trap(
            "f(z: complex) = log(exp(z))",
            &[-200.0, -2.0],
            &[-200.0, -2.0],
            2.1,
        ),
    ];
    let wrong: String = machines()
        .iter()
        .skip(1)
        .flat_map(|machine| {
            rewritten
                .iter()
                .map(|t| judge(t, machine))
                .collect::<Vec<_>>()
        })
        .collect();
    assert!(wrong.is_empty(), "{wrong}");
}

/// As it is written, too, in the tiers that have the range of float64.
#[test]
fn wide_exponents_need_no_rewrite() {
    let traps = [
        trap(
            "f(z: complex) = diff(z^-8, z)/z^-8",
            &[1e-5, 0.0],
            &[-800_000.020_209_700_5, NOT_STATED],
            12.0,
        ),
        trap(
            "f(x: real) = x^2 - 1e8",
            &[10_000.001],
            &[19.531_250_953_674_316],
            0.0,
        ),
        trap(
            "f(z: complex) = exp(z)",
            &[100.0, 2.0],
            &[-1.118_651_444_834_931e43, 2.444_298_000_059_418e43],
            4.0,
        ),
    ];
    let has_range =
        |m: &Machine| matches!(m, Machine::Reference | Machine::Gpu(_, Precision::Double));
    let wrong: String = machines()
        .iter()
        .filter(|machine| has_range(machine))
        .flat_map(|machine| traps.iter().map(|t| judge(t, machine)).collect::<Vec<_>>())
        .collect();
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn parts_of_numbers_jump_where_they_should() {
    let below_one = |x: f32| {
        for machine in &machines() {
            let point = Point {
                args: vec![f64::from(x)],
                params: Vec::new(),
            };
            let rows = machine
                .run(&formula("f(x: real) = fract(x)"), What::Value, &[point])
                .expect("fract");
            assert!(
                (0.0..1.0).contains(&rows[0][0]),
                "{}: fract({x}) = {}",
                machine,
                rows[0][0]
            );
        }
    };
    for x in [-1e-9, -1e-30, -1e-20, -5.960_464_5e-8, -0.5, 8_388_607.5] {
        below_one(x);
    }
}

/// log10 of the number that is next to a power of ten is the whole number next to it; in f64 it is so for the exact
/// powers alone.
#[test]
fn decimal_logarithms_are_whole_at_powers_of_ten() {
    for machine in &machines() {
        let single = !matches!(
            machine,
            Machine::Reference | Machine::Gpu(_, Precision::Extended | Precision::Double)
        );
        let powers: Vec<i32> = if single {
            (-37..=38).collect()
        } else {
            (0..=10).collect()
        };
        let number = |k: &i32| format!("1e{k}").parse::<f32>().expect("a power of ten");
        let points: Vec<Point> = powers
            .iter()
            .map(|k| Point {
                args: vec![f64::from(number(k))],
                params: Vec::new(),
            })
            .collect();
        let rows = machine
            .run(&formula("f(x: real) = log10(x)"), What::Value, &points)
            .expect("log10");
        for (k, row) in powers.iter().zip(&rows) {
            // the correctly rounded logarithm of the float32 number: 10^k (1 + d) has k + d/ln 10
            let exact = f64::from(number(k)).log10();
            let nearest = if single {
                f64::from(exact as f32)
            } else {
                exact
            };
            assert!(
                row[0] == nearest,
                "{}: log10(1e{k}) = {:e}, not {nearest:e}",
                machine,
                row[0]
            );
        }
    }
}

/// The point of the Riemann sphere above z, as people write it; the reference computes just that, where it overflows later.
#[test]
fn the_sphere_is_closed_at_infinity() {
    let height = "f(z: complex) = (|z|^2 - 1)/(|z|^2 + 1)";
    let plain = "f(x, y) = (x^2 + y^2 - 1)/(x^2 + y^2 + 1)";
    let east = "f(z: complex) = 2 re(z)/(1 + |z|^2)";
    let north = "f(z: complex) = 2 im(z)/(1 + re(z)^2 + im(z)^2)";
    let around = "f(z: complex) = 2 z/(1 + |z|^2)";
    let exact = |x: f32, y: f32| {
        let (x, y) = (f64::from(x), f64::from(y));
        let below = 1.0 + x * x + y * y;
        [2.0 * x / below, 2.0 * y / below, 1.0 - 2.0 / below]
    };
    let mut traps = vec![
        trap(height, &[1e20, 0.0], &[1.0], 0.0),
        trap(height, &[2e38, 1e38], &[1.0], 1.0),
        trap(height, &[0.0, 0.0], &[-1.0], 0.0),
        trap(plain, &[3e37, -1e38], &[1.0], 1.0),
        // by the tangent of half an angle: (1 - cos) / (1 + cos) = tan², for any modulus
        trap(
            "f(z: complex) = -cos(2 atan(|z|))",
            &[1e20, 1e20],
            &[1.0],
            0.0,
        ),
    ];
    for (x, y) in [
        (1e30, 1e30),
        (-1e25, 3e24),
        (0.5, -0.25),
        (1e10, 2e19),
        (1e-10, 0.5),
        (1.1e18, -2e17),
        (1.2e18, 1e18),
    ] {
        let [e, n, h] = exact(x, y);
        traps.push(trap(height, &[x, y], &[h], 8.0));
        traps.push(trap(plain, &[x, y], &[h], 8.0));
        traps.push(trap(east, &[x, y], &[e], 8.0));
        traps.push(trap(north, &[x, y], &[n], 8.0));
        traps.push(trap(around, &[x, y], &[e, n], 8.0));
    }
    check(&traps);
    // and the slopes that a scene asks for
    let mut slope = trap(plain, &[1e25, 0.0], &[1.0, 0.0, 0.0], 0.0);
    slope.what = What::Gradient;
    let mut flat = trap(plain, &[1e25, -1e30], &[1.0, 0.0, 0.0], 0.0);
    flat.what = What::Gradient;
    let shaders = machines().into_iter().skip(1);
    let wrong: String = shaders
        .map(|m| judge(&slope, &m) + &judge(&flat, &m))
        .collect();
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn inverse_hyperbolic_cosines_stay_on_their_branch() {
    // the real part is not negative, and the imaginary part has the sign of that of z
    check(&[
        trap(
            "f(z: complex) = acosh(z)",
            &[-2.0, 0.5],
            &[1.361_800_900_857_845_8, 2.863_838_397_032_079],
            2.4,
        ),
        trap(
            "f(z: complex) = acosh(z)",
            &[-2.0, -0.5],
            &[1.361_800_900_857_845_8, -2.863_838_397_032_079],
            2.4,
        ),
        trap(
            "f(z: complex) = acosh(z)",
            &[-2.0, 0.0],
            &[1.316_957_896_924_816_8, std::f64::consts::PI],
            2.4,
        ),
        trap(
            "f(z: complex) = acosh(z)",
            &[0.0, -2.0],
            &[1.443_635_475_178_810_3, -std::f64::consts::FRAC_PI_2],
            2.4,
        ),
    ]);
}

/// Slopes of quotients whose divisor is an infinity, or whose slope is one: a zero times an infinity as the rule is written
/// down. The exact ones are below the least float32 number, or 0 in float64, too.
#[test]
fn slopes_of_quotients_are_numbers_where_divisors_overflow() {
    const LEAST: f64 = 1.2e-38;
    let cases: [(&str, What, &[f32]); 11] = [
        (
            "f(x, y) = (y + sin(x))/cosh(x)",
            What::Gradient,
            &[95.0, 2.0],
        ),
        (
            "f(x, y) = (y + sin(x))/cosh(x)",
            What::Gradient,
            &[-300.0, 2.0],
        ),
        (
            "f(x, y) = (y + sin(x))/cosh(x)",
            What::Gradient,
            &[1000.0, 2.0],
        ),
        (
            "f(x, y) = (y + sin(x))/cosh(x)",
            What::Hessian,
            &[95.0, 2.0],
        ),
        (
            "f(x, y) = y/(1 + exp(2 x) + y^2)",
            What::Gradient,
            &[60.0, 2.0],
        ),
        ("f(x, y) = x y/(1 + x^8)", What::Gradient, &[1e7, 2.0]),
        ("f(x: real) = x/(exp(x) - 1)", What::Derivative, &[110.0]),
        ("f(x: real) = 1/(exp(x) + 1)", What::Derivative, &[110.0]),
        ("f(z) = z/cosh(z)", What::Derivative, &[95.0, 1.0]),
        ("f(z) = (z + 1)/sin(z)", What::Derivative, &[1.0, -110.0]),
        ("f(z) = re(z)/(1 + exp(z))", What::Derivative, &[110.0, 3.0]),
    ];
    let mut wrong = String::new();
    for machine in &machines() {
        for (source, what, args) in cases {
            let point = Point {
                args: args.iter().map(|&x| f64::from(x)).collect(),
                params: Vec::new(),
            };
            let row = machine.run(&formula(source), what, &[point]).expect(source);
            if !row[0].iter().all(|x| x.abs() < LEAST) {
                let _ = writeln!(wrong, "{}: {source} at {args:?}: {:?}", machine, row[0]);
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

/// A power whose product with its exponent is in range, and the power not, within a loop: the slope of Σ (k x)^-0.1.
#[test]
fn powers_in_loops_are_computed_with_their_factors() {
    let slope = Trap {
        what: What::Derivative,
        ..trap(
            "f(x: real) = sum(k in 1..2, (k x)^-0.1)",
            &[3e-36],
            &[NOT_STATED, -2.298_295_587_302_129e38],
            // of -0.1 as a float32 number the last digit counts 80 times in the logarithm, and not in float64
            8.0,
        )
    };
    // pairs compute a power by itself, in and outside of loops
    let is_pairs = |machine: &Machine| matches!(machine, Machine::Gpu(_, Precision::Extended));
    let wrong: String = machines()
        .iter()
        .filter(|machine| !is_pairs(machine))
        .map(|machine| judge(&slope, machine))
        .collect();
    assert!(wrong.is_empty(), "{wrong}");
}

/// Directions of points whose distance from the origin overflows, and the slopes of that distance.
#[test]
fn directions_need_no_range() {
    let gradient = |source, args: &[f32], expected: &[f64]| Trap {
        what: What::Gradient,
        ..trap(source, args, expected, 6.0)
    };
    check(&[
        trap(
            "f(x, y, z) = normalize((x, y, z)).y",
            &[3e38, 2e38, 1e38],
            &[0.534_522_472_209_058_6],
            6.0,
        ),
        trap(
            "f(x, y) = normalize((x, y)).x",
            &[3e38, -3e38],
            &[std::f64::consts::FRAC_1_SQRT_2],
            6.0,
        ),
        gradient(
            "f(x, y) = hypot(x, y)",
            &[3e38, -3e38],
            &[
                NOT_STATED,
                std::f64::consts::FRAC_1_SQRT_2,
                -std::f64::consts::FRAC_1_SQRT_2,
            ],
        ),
    ]);
}

/// 1/x² where x² is a subnormal number.
#[test]
fn inverse_squares_need_no_range() {
    check(&[trap(
        "f(x: real) = x^-2",
        &[6e-20],
        &[2.777_777_954_080_438_7e38],
        2.6,
    )]);
}
