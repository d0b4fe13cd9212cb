//! What is printed reads back as the same tree.

mod support;

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use pullback_grammar::ast::{
    BinaryOp, CompareOp, Constant, Expr, ExprId, Exprs, File, Formal, Formula, Function, Item,
    Local, Name, Param, Range, SeriesKind, Setting, Show, UnaryOp,
};
use pullback_grammar::{Span, print, print_expr};
use support::{read, show_file};

/// A plan of an expression; built into an arena afterwards.
#[derive(Clone, Debug)]
enum Plan {
    Number(f64),
    Imaginary(f64),
    Name(&'static str),
    Unary(UnaryOp, Box<Plan>),
    Binary(BinaryOp, Box<Plan>, Box<Plan>),
    Compare(Box<Plan>, Vec<(CompareOp, Plan)>),
    Call(&'static str, u32, Vec<Plan>),
    Member(Box<Plan>, &'static str),
    Vector(Vec<Plan>),
    If(Box<Plan>, Box<Plan>, Box<Plan>),
    Piecewise(Vec<(Plan, Plan)>, Option<Box<Plan>>),
    Where(Box<Plan>, Vec<(&'static str, Option<&'static str>, Plan)>),
    /// An operator of calculus on the bare name of a function, at a point.
    Operator(&'static str, Vec<Plan>),
    Series(SeriesKind, Vec<(&'static str, Plan, Plan)>, Box<Plan>),
    /// The number of steps, each state's name, start and step, and the condition.
    Iterate(
        Box<Plan>,
        Vec<(&'static str, Plan, Plan)>,
        Option<Box<Plan>>,
    ),
    Integral(Box<Plan>, &'static str, Box<(Plan, Plan)>),
}

fn name(text: &str) -> Name {
    Name {
        text: text.to_owned(),
        span: Span::default(),
    }
}

fn range(exprs: &mut Exprs, text: &str, lower: &Plan, upper: &Plan) -> Range {
    Range {
        name: name(text),
        lower: build(exprs, lower),
        upper: build(exprs, upper),
    }
}

fn build(exprs: &mut Exprs, plan: &Plan) -> ExprId {
    let mut all = |plans: &[Plan]| {
        plans
            .iter()
            .map(|plan| build(exprs, plan))
            .collect::<Vec<_>>()
    };
    let expr = match plan {
        Plan::Number(value) => Expr::Number(*value),
        Plan::Imaginary(value) => Expr::Imaginary(*value),
        Plan::Name(text) => Expr::Name(name(text)),
        Plan::Unary(op, arg) => Expr::Unary {
            op: *op,
            arg: build(exprs, arg),
        },
        Plan::Binary(op, lhs, rhs) => {
            let (lhs, rhs) = (build(exprs, lhs), build(exprs, rhs));
            Expr::Binary { op: *op, lhs, rhs }
        }
        Plan::Compare(first, rest) => {
            let first = build(exprs, first);
            let rest = rest
                .iter()
                .map(|(op, plan)| (*op, build(exprs, plan)))
                .collect();
            Expr::Compare { first, rest }
        }
        Plan::Call(callee, primes, args) => Expr::Call {
            callee: name(callee),
            primes: *primes,
            args: all(args),
        },
        Plan::Member(base, field) => Expr::Member {
            base: build(exprs, base),
            field: name(field),
        },
        Plan::Vector(items) => Expr::Vector(all(items)),
        Plan::If(cond, then, otherwise) => {
            let (cond, then) = (build(exprs, cond), build(exprs, then));
            Expr::If {
                cond,
                then,
                otherwise: build(exprs, otherwise),
            }
        }
        Plan::Piecewise(arms, otherwise) => {
            let arms = arms
                .iter()
                .map(|(c, v)| (build(exprs, c), build(exprs, v)))
                .collect();
            let otherwise = otherwise.as_ref().map(|plan| build(exprs, plan));
            Expr::Piecewise { arms, otherwise }
        }
        Plan::Where(body, locals) => {
            let body = build(exprs, body);
            let locals = locals
                .iter()
                .map(|(text, field, plan)| Local {
                    name: name(text),
                    field: field.map(name),
                    value: build(exprs, plan),
                })
                .collect();
            Expr::Where { body, locals }
        }
        Plan::Operator(callee, point) => {
            let function = exprs.push(Expr::Name(name("sin")), Span::default());
            let point = point.iter().map(|plan| build(exprs, plan));
            let args = std::iter::once(function).chain(point).collect();
            Expr::Call {
                callee: name(callee),
                primes: 0,
                args,
            }
        }
        Plan::Series(kind, ranges, term) => {
            let ranges = ranges
                .iter()
                .map(|(text, lower, upper)| range(exprs, text, lower, upper))
                .collect();
            let term = build(exprs, term);
            Expr::Series {
                kind: *kind,
                ranges,
                term,
            }
        }
        Plan::Iterate(count, states, until) => Expr::Iterate {
            count: build(exprs, count),
            states: states
                .iter()
                .map(|(text, start, _)| (name(text), build(exprs, start)))
                .collect(),
            steps: states.iter().map(|(.., step)| build(exprs, step)).collect(),
            until: until.as_ref().map(|plan| build(exprs, plan)),
        },
        Plan::Integral(body, text, ends) => Expr::Integral {
            method: pullback_grammar::ast::Method::Closed,
            body: build(exprs, body),
            range: range(exprs, text, &ends.0, &ends.1),
        },
    };
    exprs.push(expr, Span::default())
}

fn plan() -> impl Strategy<Value = Plan> {
    let size = prop_oneof![
        (0_u32..100).prop_map(f64::from),
        any::<f64>()
            .prop_filter("a finite number", |x| x.is_finite())
            .prop_map(f64::abs),
    ];
    let variables = prop::sample::select(&["a", "b", "x", "π", "i", "e", "α₁", "unknown"][..]);
    let leaf = prop_oneof![
        2 => size.clone().prop_map(Plan::Number),
        1 => size.prop_map(Plan::Imaginary),
        4 => variables.prop_map(Plan::Name),
    ];
    leaf.prop_recursive(6, 60, 4, |inner| {
        use BinaryOp::{Add, And, Div, ImplicitMul, Mul, Or, Pow, Sub};
        use CompareOp::{Equal, Greater, GreaterEqual, Less, LessEqual, NotEqual};
        use UnaryOp::{Abs, Factorial, Neg, Not, Sqrt};
        let boxed = inner.clone().prop_map(Box::new).boxed();
        let unary = prop::sample::select(&[Neg, Not, Sqrt, Factorial, Abs][..]);
        let binary = prop::sample::select(&[Add, Sub, Mul, ImplicitMul, ImplicitMul, Div, Pow, And, Or][..]);
        let compare = prop::sample::select(&[Less, LessEqual, Greater, GreaterEqual, Equal, NotEqual][..]);
        let arms = prop::collection::vec((inner.clone(), inner.clone()), 1..3);
        let fields = prop::sample::select(&[None, None, Some("x"), Some("zy"), Some("rgba")][..]);
        let bound = prop::sample::select(&["a", "b", "unknown"][..]);
        let locals = prop::collection::vec((bound.clone(), fields, inner.clone()), 1..3);
        let ranges = prop::collection::vec((bound.clone(), inner.clone(), inner.clone()), 1..3);
        let states = prop::collection::vec((bound.clone(), inner.clone(), inner.clone()), 1..4);
        let operator = prop::sample::select(&["grad", "laplacian", "diff", "mean_curvature"][..]);
        let series = prop::sample::select(&[SeriesKind::Sum, SeriesKind::Product][..]);
        let ends = (inner.clone(), inner.clone()).prop_map(Box::new);
        prop_oneof![
            4 => (unary, boxed.clone()).prop_map(|(op, arg)| Plan::Unary(op, arg)),
            8 => (binary, boxed.clone(), boxed.clone()).prop_map(|(op, a, b)| Plan::Binary(op, a, b)),
            2 => (boxed.clone(), prop::collection::vec((compare, inner.clone()), 1..3))
                .prop_map(|(first, rest)| Plan::Compare(first, rest)),
            2 => (prop::sample::select(&["sin", "f", "nowhere"][..]), 0_u32..3, prop::collection::vec(inner.clone(), 0..3))
                .prop_map(|(callee, primes, args)| Plan::Call(callee, primes, args)),
            1 => (boxed.clone(), prop::sample::select(&["x", "xy", "rgba"][..])).prop_map(|(b, f)| Plan::Member(b, f)),
            1 => prop::collection::vec(inner.clone(), 2..5).prop_map(Plan::Vector),
            1 => (boxed.clone(), boxed.clone(), boxed.clone()).prop_map(|(c, a, b)| Plan::If(c, a, b)),
            1 => (arms, prop::option::of(boxed.clone())).prop_map(|(arms, other)| Plan::Piecewise(arms, other)),
            1 => (boxed.clone(), locals).prop_map(|(body, locals)| Plan::Where(body, locals)),
            1 => (operator, prop::collection::vec(inner.clone(), 0..3)).prop_map(|(op, point)| Plan::Operator(op, point)),
            1 => (series, ranges, boxed.clone()).prop_map(|(kind, ranges, term)| Plan::Series(kind, ranges, term)),
            1 => (boxed.clone(), states, prop::option::of(boxed.clone()))
                .prop_map(|(count, states, until)| Plan::Iterate(count, states, until)),
            1 => (boxed, bound, ends).prop_map(|(body, name, ends)| Plan::Integral(body, name, ends)),
        ]
    })
}

/// A file with every kind of statement that holds these expressions.
fn file(plans: &[Plan]) -> File {
    let mut file = File::default();
    let span = Span::default();
    let mut next = plans.iter().cycle();
    let zero = Plan::Number(0.0);
    let mut expr = |exprs: &mut Exprs| build(exprs, next.next().unwrap_or(&zero));
    let exprs = &mut file.exprs;
    let params = ["a", "x"].map(|text| Formal {
        name: name(text),
        ty: (text == "x").then(|| name("complex")),
    });
    file.items = vec![
        Item::Function(Function {
            name: name("f"),
            params: params.to_vec(),
            body: expr(exprs),
            span,
        }),
        Item::Formula(Formula {
            body: expr(exprs),
            span,
        }),
        Item::Constant(Constant {
            name: name("b"),
            value: expr(exprs),
            span,
        }),
        Item::Formula(Formula {
            body: expr(exprs),
            span,
        }),
        Item::Param(Param {
            name: name("a"),
            default: expr(exprs),
            range: Some((expr(exprs), expr(exprs))),
            span,
        }),
        Item::Show(Show {
            scene: name("surface"),
            args: vec![expr(exprs), expr(exprs)],
            settings: vec![
                Setting {
                    name: name("box"),
                    value: expr(exprs),
                    upper: None,
                },
                Setting {
                    name: name("range"),
                    value: expr(exprs),
                    upper: Some(expr(exprs)),
                },
            ],
            span,
        }),
    ];
    file
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 600, failure_persistence: None, rng_seed: RngSeed::Fixed(20), ..ProptestConfig::default() })]

    #[test]
    fn trees(plans in prop::collection::vec(plan(), 1..4)) {
        let file = file(&plans);
        let printed = print(&file);
        let parsed = read(&printed);
        prop_assert!(!parsed.has_errors(), "{}\n{:?}", printed, parsed.diagnostics);
        prop_assert_eq!(show_file(&file), show_file(&parsed.file), "{}", printed);
        prop_assert_eq!(print(&parsed.file), printed);
    }

    #[test]
    fn brackets_are_needed(plan in plan()) {
        let mut exprs = Exprs::default();
        let id = build(&mut exprs, &plan);
        let text = format!("{}\na = 1; b = 1\nf(x) = x", print_expr(&exprs, id));
        let whole = read(&text);
        let tree = show_file(&whole.file);
        prop_assert!(whole.diagnostics.iter().all(|d| d.code != "ambiguous-division"), "{}", text);
        // Without a pair of brackets that holds one expression the text must not mean the same, except where they
        // are there for the reader: around a conditional or a local inside of an operand, and a division before a
        // factor without a sign, which brings a warning.
        for (open, close) in pairs(&text) {
            let inside = &text[open + 1..close];
            let is_call = text[..open].ends_with(|c: char| c.is_alphanumeric() || c == '\'');
            if is_call || inside.contains([',', ')']) || inside.contains("if") || inside.contains("where") {
                continue;
            }
            let without = format!("{} {} {}", &text[..open], inside, &text[close + 1..]);
            let again = read(&without);
            let same = again.diagnostics.len() == whole.diagnostics.len() && show_file(&again.file) == tree;
            prop_assert!(!same || text[close + 1..].starts_with('.'), "{}\n{}", text, without);
        }
    }

    #[test]
    fn numbers(bits in any::<u64>()) {
        let value = f64::from_bits(bits).abs();
        prop_assume!(value.is_finite());
        let mut exprs = Exprs::default();
        let id = exprs.push(Expr::Number(value), Span::default());
        let text = print_expr(&exprs, id);
        prop_assert_eq!(text.parse::<f64>().map(f64::to_bits), Ok(value.to_bits()), "{}", text);
    }
}

/// Places of matching round brackets in the first line.
fn pairs(text: &str) -> Vec<(usize, usize)> {
    let (mut open, mut found) = (Vec::new(), Vec::new());
    for (at, c) in text.lines().next().unwrap_or("").char_indices() {
        match c {
            '(' => open.push(at),
            ')' => found.extend(open.pop().map(|open| (open, at))),
            _ => {}
        }
    }
    found
}
