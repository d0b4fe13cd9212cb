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
    /// How it is written: `sin(x)`, `z * complex(a, b)`.
    pub body: String,
    /// Number of its operands.
    pub arity: usize,
    /// Its program text.
    pub source: String,
    /// Its cases.
    pub cases: Vec<Case>,
}

impl Subject {
    /// Its word, and that it is about complex numbers.
    #[must_use]
    pub fn name(&self) -> String {
        match self.domain {
            Domain::Real => self.word.to_owned(),
            Domain::Complex => format!("{} (complex)", self.word),
        }
    }
}

/// Every operation of the table that can be asked about by itself; one without cases is listed, too.
///
/// # Errors
/// A table is malformed; in words.
pub fn subjects() -> Result<Vec<Subject>, String> {
    let mut out = Vec::new();
    for row in rows() {
        for domain in [Domain::Real, Domain::Complex] {
            for (word, body, arity) in forms(row, domain) {
                let source = source(domain, &body, arity);
                out.push(Subject {
                    word,
                    domain,
                    row,
                    body,
                    arity,
                    source,
                    cases: cases(word, domain)?,
                });
            }
        }
    }
    Ok(out)
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
    // what is defined in the language is judged by formulas
    if !row.is_written() || row.is_defined(!on_reals) {
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
/// # Errors
/// The text does not compile; in words.
pub fn formula(source: &str) -> Result<Formula, String> {
    let compilation = pullback_compiler::compile(source);
    let picture = compilation
        .program
        .as_ref()
        .and_then(|program| program.pictures().first());
    match picture {
        Some(picture) => Ok(picture.formula.clone()),
        None => Err(format!("{source}: {:?}", compilation.diagnostics)),
    }
}
