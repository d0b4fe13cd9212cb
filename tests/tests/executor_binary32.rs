//! `ieee32` bit for bit: against native `f32`, and against the software adapter where it takes no liberties.

use std::fmt::Write as _;

use naga::valid::{Capabilities, ValidationFlags, Validator};
use pullback_compiler::lower::{Format, Precision};
use pullback_compiler::stable::Rewrites;
use pullback_compiler::{EvalModule, What, compile};
use pullback_runtime::GpuEvaluator;
use pullback_runtime::evaluate::Surroundings;
use pullback_runtime::executor::{
    Arithmetic, Contraction, Limits, Machine, Options, Program, Rows, Start, Watched,
};
use pullback_tests::accuracy::evaluators::suite_gpu;
use pullback_tests::mutate::Random;

/// An expression of x0, x1 and so on, as a text and as native arithmetic. No constants: naga would fold them.
enum Tree {
    Leaf(usize),
    One(&'static str, fn(f32) -> f32, Box<Tree>),
    Two(&'static str, fn(f32, f32) -> f32, Box<[Tree; 2]>),
    Three(&'static str, fn(f32, f32, f32) -> f32, Box<[Tree; 3]>),
}

type One = (&'static str, fn(f32) -> f32);
type Two = (&'static str, fn(f32, f32) -> f32);
type Three = (&'static str, fn(f32, f32, f32) -> f32);

const ONE: [One; 6] = [
    ("(-A)", |a| -a),
    ("abs(A)", f32::abs),
    ("sqrt(A)", f32::sqrt),
    ("floor(A)", f32::floor),
    ("ceil(A)", f32::ceil),
    ("trunc(A)", f32::trunc),
];
const TWO: [Two; 6] = [
    ("(A + B)", |a, b| a + b),
    ("(A - B)", |a, b| a - b),
    ("(A * B)", |a, b| a * b),
    ("(A / B)", |a, b| a / b),
    ("select(A, B, A < B)", |a, b| if a < b { b } else { a }),
    (
        "f32(i32(clamp(A, -1e6, 1e6)) + i32(clamp(B, -1e6, 1e6)))",
        |a, b| {
            #[allow(
                clippy::cast_possible_truncation,
                reason = "the conversion is what is tested"
            )]
            let whole = |x: f32| (if x.is_nan() { -1e6 } else { x.clamp(-1e6, 1e6) }) as i32;
            #[allow(clippy::cast_precision_loss, reason = "below 2^24")]
            let sum = (whole(a) + whole(b)) as f32;
            sum
        },
    ),
];
const THREE: [Three; 2] = [
    ("fma(A, B, C)", f32::mul_add),
    ("mix(A, B, C)", |a, b, t| a * (1.0 - t) + b * t),
];

impl Tree {
    fn random(random: &mut Random, depth: usize) -> Self {
        let inner = |random: &mut Random| Self::random(random, depth.saturating_sub(1));
        let kind = if depth == 0 {
            random.below(4)
        } else {
            4 + random.below(6)
        };
        match kind {
            0..4 => Self::Leaf(kind),
            4 => {
                let (text, f) = *random.pick(&ONE);
                Self::One(text, f, Box::new(inner(random)))
            }
            5..9 => {
                let (text, f) = *random.pick(&TWO);
                Self::Two(text, f, Box::new([inner(random), inner(random)]))
            }
            _ => {
                let (text, f) = *random.pick(&THREE);
                Self::Three(
                    text,
                    f,
                    Box::new([inner(random), inner(random), inner(random)]),
                )
            }
        }
    }

    fn value(&self, x: [f32; 4]) -> f32 {
        match self {
            Self::Leaf(k) => x[*k],
            Self::One(_, f, a) => f(a.value(x)),
            Self::Two(_, f, of) => f(of[0].value(x), of[1].value(x)),
            Self::Three(_, f, of) => f(of[0].value(x), of[1].value(x), of[2].value(x)),
        }
    }

    fn text(&self) -> String {
        let filled = |form: &str, of: &[Self]| {
            let mut text = String::new();
            for c in form.chars() {
                match c {
                    'A'..='C' => text += &of["ABC".find(c).unwrap_or(0)].text(),
                    other => text.push(other),
                }
            }
            text
        };
        match self {
            Self::Leaf(k) => format!("x{k}"),
            Self::One(form, _, a) => filled(form, std::slice::from_ref(a)),
            Self::Two(form, _, of) => filled(form, of.as_slice()),
            Self::Three(form, _, of) => filled(form, of.as_slice()),
        }
    }
}

/// Arguments of every sort: ordinary, huge, tiny, subnormal, zeros, infinities, NaN.
fn number(random: &mut Random) -> f32 {
    #[allow(clippy::cast_possible_truncation, reason = "random bits are meant")]
    let bits = random.next_u64() as u32;
    match random.below(4) {
        0 => *random.pick(&[
            0.0,
            -0.0,
            f32::INFINITY,
            f32::NEG_INFINITY,
            f32::NAN,
            1e-45,
            f32::MAX,
        ]),
        1 => f32::from_bits(bits),
        _ => f32::from_bits((bits & 0x807f_ffff) | 0x3f00_0000 | (bits >> 3 & 0x0180_0000)),
    }
}

fn same(a: f32, b: f32) -> bool {
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}

/// Many functions at a time, so that a module is not made for each.
const FUNCTIONS: usize = 100;
const LANES: usize = 16;

#[test]
fn generated_arithmetic_is_native_arithmetic() {
    let mut random = Random::new(11);
    for _ in 0..100 {
        let trees: Vec<Tree> = (0..FUNCTIONS)
            .map(|k| Tree::random(&mut random, 1 + k % 5))
            .collect();
        let mut wgsl = String::new();
        for (k, tree) in trees.iter().enumerate() {
            let _ = writeln!(
                wgsl,
                "fn test{k}(x0: f32, x1: f32, x2: f32, x3: f32) -> f32 {{ return {}; }}",
                tree.text()
            );
        }
        let module = naga::front::wgsl::parse_str(&wgsl)
            .unwrap_or_else(|e| panic!("{}", e.emit_to_string(&wgsl)));
        let info = Validator::new(ValidationFlags::all(), Capabilities::default())
            .validate(&module)
            .expect("a valid module");
        let options = Options {
            arithmetic: Arithmetic::Ieee32,
            format: Format::Single,
            watched: Watched::Nothing,
            contraction: Contraction::None,
        };
        for (k, tree) in trees.iter().enumerate() {
            let name = format!("test{k}");
            let program = Program::new(&module, &info, Start::Function(&name), options)
                .expect("it is translated");
            let mut machine = Machine::new(&program);
            let points: Vec<[f32; 4]> = (0..LANES)
                .map(|_| [(); 4].map(|()| number(&mut random)))
                .collect();
            for (lane, point) in points.iter().enumerate() {
                for (k, x) in point.iter().enumerate() {
                    machine.set_argument(k, lane, x.to_bits().into());
                }
            }
            machine.run(LANES, Limits::default()).expect("it runs");
            for (lane, point) in points.into_iter().enumerate() {
                #[allow(clippy::cast_possible_truncation, reason = "a word of 32 bits")]
                let found = f32::from_bits(machine.result(0, lane) as u32);
                let expected = tree.value(point);
                assert!(
                    same(found, expected),
                    "{} at {point:?}: {found:e}, not {expected:e}",
                    tree.text()
                );
            }
        }
    }
}

/// Formulas on which Mesa's software adapter takes no liberties: every result has the bits of `ieee32`, of subnormals,
/// infinities and zeros of both signs, too.
const FAITHFUL: [&str; 14] = [
    "x + y",
    "x - y",
    "x*y",
    "x/y",
    "sqrt(|x|)",
    "|x|",
    "-x",
    "floor(x)",
    "ceil(x)",
    "trunc(x)",
    "if x < y then x else y",
    "if x == y then 1 else x",
    "x*y + x",
    "(x*x + y*y)/(1 + x*y)",
];

/// Formulas on which drivers may take liberties: the sums are reassociated, and the built-ins are of no declared error.
const LIBERTIES: [&str; 7] = [
    "(x + y) - x",
    "sin(x)",
    "exp(x)",
    "log(|x|)",
    "atan2(y, x)",
    "min(x, y)",
    "|x|^y",
];

/// Both evaluators of a formula, on rows of two numbers, in the fast tier: operators and built-ins alone.
fn both(formula: &str, rows: &[f32]) -> Option<(Vec<f32>, Vec<f32>)> {
    let gpu = suite_gpu()?;
    let program = compile(&format!("f(x, y) = {formula}"))
        .program
        .expect("a formula");
    let program = program.with_rewrites(Rewrites::OFF);
    let module = EvalModule::new(&program.pictures()[0].formula, What::Value, Precision::Fast)
        .expect("a module");
    let count = rows.len() / 2;
    let mut on_device = Vec::new();
    let mut evaluator = GpuEvaluator::new(&gpu, &module).expect("an evaluator");
    evaluator
        .eval(Surroundings::default(), count, rows, &mut on_device)
        .expect("it runs");
    let wide: Vec<f64> = rows.iter().copied().map(f64::from).collect();
    let mut found = Vec::new();
    let executor = Rows::new(&module, Arithmetic::Ieee32).expect("a program");
    executor
        .eval(Surroundings::default(), count, &wide, &mut found)
        .expect("it runs");
    #[allow(
        clippy::cast_possible_truncation,
        reason = "numbers of single precision"
    )]
    let found = found.into_iter().map(|x| x as f32).collect();
    Some((on_device, found))
}

/// Rows on which the adapter gives other bits.
fn different(formula: &str, rows: &[f32]) -> Option<Vec<String>> {
    let (device, found) = both(formula, rows)?;
    let pairs = device.iter().zip(&found).zip(rows.chunks(2));
    let wrong = pairs.filter(|((a, b), _)| !same(**a, **b));
    Some(
        wrong
            .map(|((a, b), row)| format!("{formula} at {row:?}: {a:e}, not {b:e}"))
            .collect(),
    )
}

#[test]
fn the_software_adapter_takes_no_liberties_with_arithmetic() {
    let mut random = Random::new(5);
    let rows: Vec<f32> = (0..20_000).map(|_| number(&mut random)).collect();
    for formula in FAITHFUL {
        let Some(wrong) = different(formula, &rows) else {
            return;
        };
        assert!(
            wrong.is_empty(),
            "{} rows differ: {}",
            wrong.len(),
            wrong[0]
        );
    }
    for formula in LIBERTIES {
        if let Some(wrong) = different(formula, &rows) {
            let first = wrong.first().map_or("", String::as_str);
            println!(
                "{formula}: {} of {} rows differ; {first}",
                wrong.len(),
                rows.len() / 2
            );
        }
    }
}
