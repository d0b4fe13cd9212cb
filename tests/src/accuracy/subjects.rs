//! The functions of the language that have tables, found from the operator table.

use pullback_compiler::formula::Formula;
use pullback_compiler::ir::Prim;
use pullback_compiler::table::{Row, Typing, rows};

use super::tables::{Case, Domain, cases};

/// A function with its cases.
#[derive(Clone, Debug)]
pub struct Subject {
    /// Its word in the tables: its name, or that of the operation.
    pub word: &'static str,
    /// What it is asked about.
    pub domain: Domain,
    /// The row of the operator table.
    pub row: &'static Row,
    /// Its program text.
    pub source: String,
    /// Its cases.
    pub cases: Vec<Case>,
}

/// Every operation of the table that can be asked about by itself; one without cases is listed, too.
#[must_use]
pub fn subjects() -> Vec<Subject> {
    let mut out = Vec::new();
    for row in rows() {
        for domain in [Domain::Real, Domain::Complex] {
            for (word, body, arity) in forms(row, domain) {
                let source = source(domain, &body, arity);
                out.push(Subject {
                    word,
                    domain,
                    row,
                    source,
                    cases: cases(word, domain),
                });
            }
        }
    }
    out
}

/// Words, formulas and numbers of operands of an operation; none for those that only formulas of the library
/// cover.
fn forms(row: &'static Row, domain: Domain) -> Vec<(&'static str, String, usize)> {
    let arity = match (row.typing, domain) {
        (Typing::Analytic(n) | Typing::Arithmetic(n), _) | (Typing::Real(n), Domain::Real) => n,
        (Typing::Part, _) => 1,
        _ => return Vec::new(),
    };
    let (a, b) = if domain == Domain::Real {
        ("x", "y")
    } else {
        ("z", "complex(a, b)")
    };
    let on_reals = domain == Domain::Real;
    if !row.is_written() {
        return Vec::new();
    }
    match (row.prim, row.names, arity) {
        (_, &[name, ..], 1) => vec![(name, format!("{name}({a})"), 1)],
        (_, &[name, ..], 2) => vec![(name, format!("{name}({a}, {b})"), 2)],
        (Prim::Neg, ..) if on_reals => vec![("neg", format!("-{a}"), 1)],
        (Prim::Add, ..) if on_reals => vec![("add", format!("{a} + {b}"), 2)],
        (Prim::Sub, ..) if on_reals => vec![("sub", format!("{a} - {b}"), 2)],
        (Prim::Mul, ..) => vec![("mul", format!("{a} * {b}"), 2)],
        (Prim::Div, ..) => vec![
            ("div", format!("{a} / {b}"), 2),
            ("inverse", format!("1/{a}"), 1),
        ],
        (Prim::PowInt(_), ..) => {
            let mut powers = vec![("square", 2), ("pow7", 7)];
            if on_reals {
                powers.extend([("cube", 3), ("inverse_square", -2)]);
            }
            powers
                .into_iter()
                .map(|(word, n)| (word, format!("{a}^{n}"), 1))
                .collect()
        }
        _ => Vec::new(),
    }
}

fn source(domain: Domain, body: &str, arity: usize) -> String {
    match (domain, arity) {
        (Domain::Real, 1) => format!("f(x: real) = {body}\n"),
        (Domain::Real, _) => format!("f(x, y) = {body}\n"),
        (Domain::Complex, 1) => format!("f(z: complex) = {body}\n"),
        (Domain::Complex, _) => format!("param a = 0\nparam b = 0\nf(z: complex) = {body}\n"),
    }
}

/// The one formula of a program.
///
/// # Panics
/// The text does not compile.
#[must_use]
pub fn formula(source: &str) -> Formula {
    let compilation = pullback_compiler::compile(source);
    let Some(program) = compilation.program else {
        panic!("{source}: {:?}", compilation.diagnostics);
    };
    program.pictures()[0].formula.clone()
}
