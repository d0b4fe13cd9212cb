//! Stability rewrites: what each gains, and that none loses, against exact values.
//!
//! tests/oracle/rewrites.py has made the tables. Both forms are evaluated in binary64, operation by operation, so the
//! numbers are those of the forms and hang on no adapter.

use std::collections::{BTreeMap, BTreeSet};

use pullback_compiler::compile;
use pullback_compiler::eval::{Leaves, Tape};
use pullback_compiler::formula::Formula;
use pullback_compiler::ir::{Graph, Id, LeafNames, Ty, to_infix, verify};
use pullback_compiler::reference::complex::complex;
use pullback_compiler::stable::{Phase, RULES, Rewrites, Rule, Stable, stabilise};
use pullback_compiler::table::Number;

const REAL: &str = include_str!("../data/rewrites/real.tsv");
const RANGE: &str = include_str!("../data/rewrites/range.tsv");
const COMPLEX: &str = include_str!("../data/rewrites/complex.tsv");

/// Bits that a result of binary64 has.
const ALL_BITS: f64 = 53.0;

fn formula(text: &str) -> Formula {
    let compiled = compile(text);
    let program = compiled
        .program
        .unwrap_or_else(|| panic!("{text}: {:?}", compiled.diagnostics));
    program.pictures()[0].formula.clone()
}

fn rewritten(text: &str, rewrites: Rewrites, phase: Phase) -> Stable {
    let formula = formula(text);
    let stable = stabilise(&formula.graph, &formula.value, rewrites, phase);
    verify(&stable.graph).unwrap_or_else(|e| panic!("{text}: {e:?}"));
    stable
}

fn infix(text: &str, stable: &Stable) -> String {
    let inputs: Vec<String> = formula(text)
        .inputs
        .iter()
        .map(|i| i.name.clone())
        .collect();
    let names = LeafNames {
        inputs: &inputs,
        params: &[],
    };
    to_infix(&stable.graph, &stable.roots, names)
}

/// The value as a complex number.
struct Machine(Tape, Vec<Ty>);

impl Machine {
    fn new(text: &str, graph: &Graph, roots: &[Id]) -> Self {
        Self(Tape::new(graph, roots), formula(text).scalars())
    }

    fn at(&mut self, columns: &[f64]) -> (f64, f64) {
        let mut columns = columns.iter().copied();
        let mut next = || columns.next().expect("a column");
        let scalars = self.1.iter();
        let inputs: Vec<Number> = scalars
            .map(|ty| match ty {
                Ty::Complex => {
                    let re = next();
                    Number::Complex(complex(re, next()))
                }
                _ => Number::Real(next()),
            })
            .collect();
        let leaves = Leaves {
            inputs: &inputs,
            params: &[],
            time: 0.0,
            pixel: 0.0,
        };
        let mut out = (f64::NAN, f64::NAN);
        self.0.run(&leaves, |value| {
            out = match value {
                Number::Real(x) => (x, 0.0),
                Number::Complex(z) => (z.re, z.im),
                Number::Truth(_) => out,
            };
        });
        out
    }
}

/// Bits lost, by norm: log₂(1 + error in units of 2⁻⁵³ of the value).
fn bits_lost(got: (f64, f64), exact: (f64, f64)) -> f64 {
    let error = f64::hypot(got.0 - exact.0, got.1 - exact.1);
    let relative = error / f64::hypot(exact.0, exact.1) / f64::EPSILON * 2.0;
    if relative.is_nan() {
        ALL_BITS
    } else {
        (1.0 + relative).log2().min(ALL_BITS)
    }
}

/// One formula of a table.
struct Case<'a> {
    rules: Vec<&'a str>,
    text: &'a str,
    rows: Vec<Vec<f64>>,
}

fn cases(table: &str) -> Vec<Case<'_>> {
    let mut out: Vec<Case> = Vec::new();
    for line in table.lines() {
        if let Some(head) = line.strip_prefix("# ") {
            let (rules, text) = head.split_once('\t').expect("rules and formula");
            out.push(Case {
                rules: rules.split(',').collect(),
                text,
                rows: Vec::new(),
            });
        } else {
            let row = line.split('\t').map(|x| x.parse().expect("a number"));
            out.last_mut().expect("a formula").rows.push(row.collect());
        }
    }
    out
}

/// What a case has measured: mean bits lost as written and as rewritten, the worst as rewritten, and the greatest loss.
struct Measured {
    before: f64,
    after: f64,
    worst: f64,
    loss: f64,
    at: Vec<f64>,
}

fn measure(case: &Case, results: usize) -> Measured {
    let written = formula(case.text);
    let stable = rewritten(case.text, Rewrites::ON, Phase::Late);
    let mut machines = [
        Machine::new(case.text, &written.graph, &written.value),
        Machine::new(case.text, &stable.graph, &stable.roots),
    ];
    let mut out = Measured {
        before: 0.0,
        after: 0.0,
        worst: 0.0,
        loss: 0.0,
        at: Vec::new(),
    };
    let count = case.rows.len() as f64;
    for row in &case.rows {
        let (args, exact) = row.split_at(row.len() - results);
        let exact = (exact[0], exact.get(1).copied().unwrap_or(0.0));
        let [before, after] = [0, 1].map(|k| bits_lost(machines[k].at(args), exact));
        out.before += before / count;
        out.after += after / count;
        out.worst = out.worst.max(after);
        if after - before > out.loss {
            out.loss = after - before;
            out.at = args.to_vec();
        }
    }
    out
}

/// Each rule acts on its formulas, gains at least half of the bits that were lost, and loses none: a form that was
/// right to a rounding or two may become right to a few.
#[test]
fn rules_gain_and_do_not_lose() {
    let mut seen: BTreeSet<&str> = BTreeSet::new();
    let mut problems = Vec::new();
    for (table, results) in [(REAL, 1), (RANGE, 1), (COMPLEX, 2)] {
        for case in cases(table) {
            let stable = rewritten(case.text, Rewrites::ON, Phase::Late);
            let used: Vec<&str> = stable
                .applied
                .iter()
                .flat_map(|a| &a.rules)
                .map(|r| r.record().name)
                .collect();
            let m = measure(&case, results);
            println!(
                "{:<60} {:5.1} -> {:4.1} bits, worst {:4.1}, loss {:4.1} at {:?}",
                case.text, m.before, m.after, m.worst, m.loss, m.at
            );
            seen.extend(&used);
            let missing: Vec<_> = case.rules.iter().filter(|r| !used.contains(r)).collect();
            if !missing.is_empty() {
                problems.push(format!("{}: {missing:?} not used, but {used:?}", case.text));
            }
            if m.after > 0.5 * m.before && m.before > 1.0 {
                problems.push(format!("{}: {:.1} -> {:.1}", case.text, m.before, m.after));
            }
            // four roundings more than before, at most
            if m.loss > 2.4 {
                problems.push(format!(
                    "{}: loses {:.1} bits at {:?}",
                    case.text, m.loss, m.at
                ));
            }
        }
    }
    for record in RULES {
        let of_derivatives = [Rule::Slope, Rule::Reciprocal].contains(&record.rule);
        if !seen.contains(record.name) && !of_derivatives {
            problems.push(format!("no formula for {}", record.name));
        }
    }
    assert!(problems.is_empty(), "{}", problems.join("\n"));
}

/// The document lists every rule with what it gains; `BLESS=1` writes it.
#[test]
fn the_document_lists_the_rules() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/rewrites.md");
    let head = include_str!("../data/rewrites/head.md");
    let mut gains: BTreeMap<&str, (f64, f64, &str)> = BTreeMap::new();
    for (table, results) in [(REAL, 1), (RANGE, 1), (COMPLEX, 2)] {
        for case in cases(table) {
            let m = measure(&case, results);
            for rule in &case.rules {
                let entry = gains.entry(rule).or_insert((0.0, 0.0, ""));
                if m.before - m.after > entry.0 - entry.1 {
                    *entry = (m.before, m.after, case.text);
                }
            }
        }
    }
    let mut text = head.to_owned();
    for record in RULES {
        text += &format!(
            "\n### {}\n\n    {}\n\nFor {} numbers: {}. Source: {}.\n",
            record.name, record.equation, record.kinds, record.domain, record.source
        );
        if !record.early {
            text += "\nAfter differentiation only.\n";
        }
        if let Some((before, after, formula)) = gains.get(record.name) {
            text += &format!(
                "\nGain: `{formula}` loses {before:.0} of 53 bits as written, {after:.0} as rewritten (means over its table).\n"
            );
        }
    }
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(path, &text).expect("the document is written");
    }
    let found = std::fs::read_to_string(path).unwrap_or_default();
    assert!(
        found == text,
        "docs/rewrites.md is not up to date: run with BLESS=1 and read the difference"
    );
}

/// What no rule may touch: an identity that fails on a branch or overflows, or a form that is no better.
const UNTOUCHED: [&str; 21] = [
    "f(x, y) = x^2 - 2 x y + y^2",
    "f(x, y, z) = x y - x z",
    "f(x, y) = x + 1 - 0.3",
    "f(z) = z - (z^3 - 1)/(3 z^2)",
    "f(x, y) = exp(x) exp(y)",
    "f(x, y) = log(x y)",
    "f(x, y) = sin(x) + 1",
    "f(x, y) = sqrt(x) + sqrt(y)",
    "f(x: real) = exp(-x)/(1 + exp(-x))",
    "f(z) = sqrt(z) - sqrt(1 - z)",
    "f(z) = log(z) - log(-z)",
    "f(z) = log(z^2)",
    "f(x: real) = log(x^3)",
    "f(z) = atan(z + 1) - atan(z)",
    "f(z) = sqrt(z^2)",
    "f(x, y) = sqrt(x^2 - y)",
    "f(x, y) = x - y",
    "f(x, y) = x^2 + y^2 - 1",
    "f(x: real) = log(2 + x)",
    "f(z) = iterate(50, w = 0, w^2 + z)",
    // real and complex squares: |z| is no factor of z²
    "f(z) = product(k in 1..9, 1 - z^2/(k pi)^2)",
];

#[test]
fn no_rule_acts_where_it_must_not() {
    for text in UNTOUCHED {
        let stable = rewritten(text, Rewrites::ON, Phase::Late);
        assert!(
            stable.applied.is_empty(),
            "{text}: {}",
            infix(text, &stable)
        );
    }
    for case in [REAL, RANGE, COMPLEX].iter().flat_map(|t| cases(t)) {
        let stable = rewritten(case.text, Rewrites::OFF, Phase::Late);
        assert!(stable.applied.is_empty(), "{}", case.text);
    }
}

/// At zeros, infinities, NaN and the ends of the range: what was no NaN is none; what was one stays one where an
/// argument is NaN; an infinity of finite arguments of ordinary size, a pole, stays the same.
#[test]
fn special_values_stay() {
    const SPECIAL: [f64; 13] = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        0.5,
        -2.5,
        5e-324,
        -1e-300,
        1e308,
        -1e308,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::NAN,
    ];
    let mut problems = Vec::new();
    for case in cases(REAL).into_iter().chain(cases(RANGE)) {
        let written = formula(case.text);
        let stable = rewritten(case.text, Rewrites::ON, Phase::Late);
        let mut machines = [
            Machine::new(case.text, &written.graph, &written.value),
            Machine::new(case.text, &stable.graph, &stable.roots),
        ];
        let count = written.inputs.len();
        for index in 0..SPECIAL.len().pow(count as u32) {
            let args: Vec<f64> = (0..count)
                .map(|k| SPECIAL[index / SPECIAL.len().pow(k as u32) % SPECIAL.len()])
                .collect();
            let [before, after] = [0, 1].map(|k| machines[k].at(&args).0);
            let tame = args
                .iter()
                .all(|x| x.abs() <= 4.0 && (*x == 0.0 || x.abs() > 0.1));
            let has = |f: fn(f64) -> bool| args.iter().any(|x| f(*x));
            let excused = match case.rules[0] {
                // 2x is 0: no quotient at all
                "conjugate" if count == 3 => args[0] == 0.0,
                // C99 F.9.4.3: infinite beside a NaN
                "hypot" => has(f64::is_nan) && after == f64::INFINITY,
                // what is written overflows
                "asinh" => args[0] < -1.0,
                "cubes" if args.iter().all(|x| x.is_infinite()) => true,
                "cubes" if count == 2 => has(|x| x.abs() > 1e60) && case.text.contains("^5"),
                // the infinity on this side of 0
                "exp-ratio" => args[0] == 0.0 && after.is_infinite(),
                // what is written is 0, because both squares are
                "root-of-squares" => args.iter().all(|x| x.abs() < 1e-150),
                // π/4 is lost beside the argument
                "log-tan" => args[0].abs() > 1e300,
                _ => false,
            };
            if excused {
                continue;
            }
            let wrong = (after.is_nan() && !before.is_nan())
                || (!after.is_nan() && before.is_nan() && args.iter().any(|x| x.is_nan()))
                || (before.is_infinite() && tame && before != after);
            if wrong {
                problems.push(format!(
                    "{} at {args:?}: {before} became {after}",
                    case.text
                ));
            }
        }
    }
    assert!(
        problems.is_empty(),
        "{}\n{}",
        problems.len(),
        problems.join("\n")
    );
}

/// Signs of zeros: that of an exact difference is as written; a function that is odd gives a zero its sign.
#[test]
fn zeros_keep_their_signs() {
    let check = |text: &str, args: &[f64], expected: f64| {
        let stable = rewritten(text, Rewrites::ON, Phase::Late);
        assert!(!stable.applied.is_empty(), "{text}");
        let found = Machine::new(text, &stable.graph, &stable.roots).at(args).0;
        assert_eq!(
            found.to_bits(),
            expected.to_bits(),
            "{text} at {args:?}: {found:?}"
        );
    };
    for (x, y) in [
        (3.0, 3.0),
        (-3.0, 3.0),
        (-3.0, -3.0),
        (-0.0, 0.0),
        (-0.0, -0.0),
    ] {
        check("f(x, y) = x^2 - y^2", &[x, y], 0.0);
    }
    check("f(x, y) = x^3 - y^3", &[-3.0, -3.0], 0.0);
    check("f(x, y) = sqrt(x) - sqrt(y)", &[0.0, 0.0], 0.0);
    check("f(x, y) = sqrt(x) - sqrt(y)", &[2.0, 2.0], 0.0);
    check("f(x, y) = log(x) - log(y)", &[2.0, 2.0], 0.0);
    check("f(x: real) = exp(x) - 1", &[-0.0], -0.0);
    check("f(x: real) = log(1 + x)", &[-0.0], -0.0);
    check("f(x: real) = 1 - cos(x)", &[-0.0], 0.0);
    check("f(x: real) = exp(x) - exp(-x)", &[-0.0], -0.0);
    check("f(x, y) = sqrt(x^2 + y^2)", &[-0.0, 0.0], 0.0);
}

/// Derivatives of a rewritten formula, too, are at least as good, here against closed forms.
#[test]
fn derivatives_do_not_get_worse() {
    use pullback_compiler::module::{What, evaluation, stable_evaluation};
    type Slope = fn(f64) -> f64;
    let cases: [(&str, Slope, [f64; 3]); 12] = [
        (
            "f(x: real) = sqrt(x + 1) - sqrt(x)",
            |x| -0.5 / (x.sqrt() * (x + 1.0).sqrt() * (x.sqrt() + (x + 1.0).sqrt())),
            [1e10, 1e14, 0.25],
        ),
        (
            "f(x: real) = log(x + 1) - log(x)",
            |x| -1.0 / (x * (x + 1.0)),
            [1e10, 1e14, 0.25],
        ),
        ("f(x: real) = 1 - cos(x)", f64::sin, [1e-10, 1.0, 100.0]),
        (
            "f(x: real) = atan(x + 1) - atan(x)",
            |x| -(2.0 * x + 1.0) / (1.0 + x * x) / (1.0 + (x + 1.0) * (x + 1.0)),
            [1e6, 1e8, 0.25],
        ),
        ("f(x: real) = x^2 - 1", |x| 2.0 * x, [1e-10, 1.0, 1e10]),
        (
            "f(x: real) = exp(x) - 2 + exp(-x)",
            |x| 2.0 * x.sinh(),
            [1e-10, 1e-3, 3.0],
        ),
        (
            "f(x: real) = sqrt(x^2 + 1) - x",
            |x| -1.0 / ((1.0 + x * x).sqrt() * (x + (1.0 + x * x).sqrt())),
            [1e3, 1e7, 0.5],
        ),
        ("f(x: real) = sin(x)/x", sinc_slope, [1e-10, 1e-3, 100.0]),
        (
            "f(x: real) = (exp(x) - 1)/x",
            |x| match x.abs() < 0.01 {
                true => 0.5 + x * (1.0 / 3.0 + x * (0.125 + x * (1.0 / 30.0 + x / 144.0))),
                false => (x.exp() - x.exp_m1() / x) / x,
            },
            [1e-10, 1e-3, -50.0],
        ),
        (
            "f(x: real) = (1 - cos(x))/x^2",
            |x| match x.abs() < 0.01 {
                true => x * (-1.0 / 12.0 + x * x * (1.0 / 180.0 - x * x / 6720.0)),
                false => (x * x.sin() - 4.0 * (0.5 * x).sin().powi(2)) / x.powi(3),
            },
            [1e-10, 1e-3, 3.0],
        ),
        (
            "f(x: real) = log(1 + exp(x))",
            |x| 1.0 / (1.0 + (-x).exp()),
            [-5.0, 3.0, 800.0],
        ),
        (
            "f(x: real) = log(tan(pi/4 + x))",
            |x| 2.0 / (2.0 * x).cos(),
            [1e-10, 0.3, -0.5],
        ),
    ];
    for (text, slope, points) in cases {
        let formula = formula(text);
        let made = [
            evaluation(&formula, What::Derivative).expect("a derivative"),
            stable_evaluation(&formula, What::Derivative).expect("a derivative"),
        ];
        for x in points {
            let exact = (slope(x), 0.0);
            let [before, after] = [0, 1].map(|k: usize| {
                let e = &made[k];
                bits_lost(Machine::new(text, &e.graph, &e.roots[1..]).at(&[x]), exact)
            });
            println!("{text} at {x:e}: {before:.1} -> {after:.1}");
            assert!(
                after < 4.0 && after <= before + 2.4,
                "{text} at {x}: {before} -> {after}"
            );
        }
    }
}

/// The derivative of sin(x)/x.
fn sinc_slope(x: f64) -> f64 {
    if x.abs() < 0.01 {
        return -x / 3.0 * (1.0 - x * x / 10.0 * (1.0 - x * x / 28.0));
    }
    (x.cos() - x.sin() / x) / x
}

/// A derivative that stands in a formula is taken of the rewritten expression where that is compiled with rewrites.
#[test]
fn derivatives_in_formulas_do_not_cancel() {
    let value = |text: &str, args: &[f64]| {
        let made = compiled(text, Rewrites::ON);
        Machine::new(text, &made.0, &made.1).at(args)
    };
    for text in SINC_SLOPES {
        for x in [1e-12, -1e-5, 0.003, 40.0] {
            let lost = bits_lost(value(text, &[x]), (sinc_slope(x), 0.0));
            assert!(lost < 4.0, "{text} at {x}: {lost:.1} bits");
        }
    }
    // -z/3, exprel' = 1/2 + z/3 and of (cosh z - 1)/z² z/12, up to z² of the value
    for (text, slope) in [
        ("f(z) = diff(sin(z)/z, z)", -1.0 / 3.0),
        ("f(z) = diff((exp(z) - 1)/z, z) - 0.5", 1.0 / 3.0),
        ("f(z) = diff((cosh(z) - 1)/z^2, z)", 1.0 / 12.0),
    ] {
        let (re, im) = (1e-6, -2e-6);
        let got = value(text, &[re, im]);
        let exact = (slope * re, slope * im);
        let error = f64::hypot(got.0 - exact.0, got.1 - exact.1);
        assert!(
            error < 1e-5 * f64::hypot(exact.0, exact.1),
            "{text}: {got:?}"
        );
    }
}

/// The derivative of sin(x)/x, as each operator of the calculus writes it.
const SINC_SLOPES: [&str; 3] = [
    "f(x: real) = diff(sin(x)/x, x)",
    "g(x: real) = sin(x)/x\nf(x: real) = g'(x)",
    "g(x, y) = sin(x)/x + y^2\nf(x: real) = grad(g)(x, 1).x",
];

/// What is compiled of a text with some rewrites.
fn compiled(text: &str, rewrites: Rewrites) -> (Graph, Vec<Id>) {
    use pullback_compiler::module::{What, stable_evaluation};
    let program = compile(text).program.expect(text).with_rewrites(rewrites);
    let made = stable_evaluation(&program.pictures()[0].formula, What::Value);
    let made = made.expect("a value");
    (made.graph, made.roots)
}

/// Without rewrites, and in the `f64` reference always, a derivative is that of the expression as it is written: the quotient
/// rule, which cancels beside 0. A subset of the rewrites is just that subset, in derivatives, too.
#[test]
fn derivatives_in_formulas_are_as_written_without_rewrites() {
    for text in SINC_SLOPES {
        let reference = formula(text);
        let off = compiled(text, Rewrites::OFF);
        let others = compiled(text, Rewrites::parse("-cardinal").expect("a rule"));
        let only = compiled(text, Rewrites::of(&[Rule::Cardinal]));
        for x in [0.003_f64, -0.1, 40.0] {
            let at = |g: &Graph, roots: &[Id]| Machine::new(text, g, roots).at(&[x]).0;
            let exact = sinc_slope(x);
            let got = at(&only.0, &only.1);
            assert!((got - exact).abs() <= 1e-13 * exact.abs(), "{text} at {x}");
            // the rounding of the terms of the quotient rule
            let rounding = 4.0 * f64::EPSILON * (1.0 + x.abs().recip());
            for (graph, roots) in [
                (&reference.graph, reference.value.as_slice()),
                (&off.0, &off.1),
                (&others.0, &others.1),
            ] {
                let error = (at(graph, roots) - exact).abs();
                assert!(error <= rounding, "{text} at {x}: {error:e}");
            }
        }
        let lost = |made: &(Graph, Vec<Id>)| {
            let x = 1e-7;
            let got = Machine::new(text, &made.0, &made.1).at(&[x]);
            bits_lost(got, (sinc_slope(x), 0.0))
        };
        assert!(
            lost(&only) < 4.0 && lost(&off) > 20.0 && lost(&others) > 20.0,
            "{text}"
        );
        // back and forth
        let program = compile(text).program.expect(text);
        let again = program
            .with_rewrites(Rewrites::OFF)
            .with_rewrites(Rewrites::ON);
        let derived = &again.pictures()[0].formula.derived;
        assert!(derived.is_some(), "{text}");
    }
}
