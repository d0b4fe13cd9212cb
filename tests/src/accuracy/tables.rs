//! The tables of references, as cases.

const REAL: &str = include_str!("../../data/oracle/real.tsv");
const COMPLEX: &str = include_str!("../../data/oracle/complex.tsv");
const REAL_EDGES: &str = include_str!("../../data/functions/real_edges.tsv");
const COMPLEX_EDGES: &str = include_str!("../../data/functions/complex_edges.tsv");

use super::error::OVERFLOW;

/// What a number has to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Expected {
    /// The table does not say.
    Unstated,
    /// This number; of a zero or an infinity also its sign, where `signed`.
    Number {
        /// The number, to the precision of `f64`.
        value: f64,
        /// Whether the sign of a zero or an infinity counts.
        signed: bool,
    },
}

/// One row of a table.
#[derive(Clone, Debug)]
pub struct Case {
    /// The arguments, every one a float32.
    pub args: Vec<f64>,
    /// Second complex operand, where there is one: it is passed as two parameters.
    pub params: Vec<f64>,
    /// Components of the value.
    pub value: Vec<Expected>,
    /// Partial derivatives, or components of the complex derivative; may be empty.
    pub derivative: Vec<Expected>,
    /// Remarks of the table.
    pub notes: &'static str,
}

/// Whether a function is asked about reals or about complex numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Domain {
    /// Reals.
    Real,
    /// Complex numbers.
    Complex,
}

impl std::fmt::Display for Domain {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(if *self == Self::Real {
            "real"
        } else {
            "complex"
        })
    }
}

/// Every case of a function, by its word in the tables.
///
/// # Panics
/// A table is malformed.
#[must_use]
pub fn cases(word: &str, domain: Domain) -> Vec<Case> {
    let (oracle, edges) = match domain {
        Domain::Real => (REAL, REAL_EDGES),
        Domain::Complex => (COMPLEX, COMPLEX_EDGES),
    };
    let of_word = |table: &'static str| {
        table
            .lines()
            .filter(|l| !l.starts_with('#'))
            .filter_map(move |line| {
                let (name, rest) = line.split_once('\t')?;
                (name == word).then(|| rest.split('\t').collect::<Vec<_>>())
            })
    };
    let mut cases: Vec<Case> = of_word(oracle)
        .map(|cells| {
            if domain == Domain::Real {
                real_oracle(&cells)
            } else {
                complex_oracle(&cells)
            }
        })
        .collect();
    cases.extend(of_word(edges).map(|cells| {
        if domain == Domain::Real {
            real_edge(&cells)
        } else {
            complex_edge(&cells)
        }
    }));
    cases
}

fn number(cell: &str) -> f64 {
    cell.parse()
        .unwrap_or_else(|_| panic!("`{cell}` is not a number"))
}

fn value(cell: &str) -> Expected {
    match cell.strip_prefix('±') {
        Some(size) => Expected::Number {
            value: number(size),
            signed: false,
        },
        None if cell == "-" => Expected::Unstated,
        None => Expected::Number {
            value: number(cell),
            signed: true,
        },
    }
}

const SECOND: &str = include_str!("../../data/functions/second.tsv");

/// The rows of the table of second derivatives of a function, asked about in some way: arguments and values.
pub(super) fn second(word: &str, domain: &str) -> Vec<(Vec<f64>, Vec<Expected>)> {
    let rows = SECOND.lines().filter_map(|line| {
        let cells: Vec<&str> = line.split('\t').collect();
        let &[name, of, args, values] = cells.as_slice() else {
            return None;
        };
        (name == word && of == domain).then(|| {
            let args = args.split(' ').map(number).collect();
            (args, values.split(' ').map(slope).collect())
        })
    });
    rows.collect()
}

/// A derivative: the sign of one that vanishes is not stated, nor is a NaN of the oracle tables.
fn slope(cell: &str) -> Expected {
    match value(cell) {
        Expected::Number { value, .. } if value.is_nan() => Expected::Unstated,
        Expected::Number { value, .. } => {
            let value = if value.abs() >= OVERFLOW {
                value * f64::INFINITY
            } else {
                value
            };
            Expected::Number {
                value,
                signed: value.abs() > 1.0,
            }
        }
        Expected::Unstated => Expected::Unstated,
    }
}

/// A value of the oracle tables, which do not state the sign of a zero.
fn unsigned(cell: &str) -> Expected {
    Expected::Number {
        value: number(cell),
        signed: false,
    }
}

fn real_oracle(cells: &[&'static str]) -> Case {
    let arity = (cells.len() - 1) / 2;
    Case {
        args: cells[..arity].iter().map(|c| number(c)).collect(),
        params: Vec::new(),
        value: vec![unsigned(cells[arity])],
        derivative: cells[arity + 1..].iter().map(|c| slope(c)).collect(),
        notes: "-",
    }
}

fn complex_oracle(cells: &[&'static str]) -> Case {
    Case {
        args: vec![number(cells[0]), number(cells[1])],
        params: Vec::new(),
        value: cells[2..4].iter().map(|c| unsigned(c)).collect(),
        derivative: cells[4..6].iter().map(|c| slope(c)).collect(),
        notes: "-",
    }
}

/// `x y value dx dy notes`
fn real_edge(cells: &[&'static str]) -> Case {
    let &[x, y, of, dx, dy, notes] = cells else {
        panic!("{cells:?}")
    };
    let binary = y != "-";
    Case {
        args: if binary {
            vec![number(x), number(y)]
        } else {
            vec![number(x)]
        },
        params: Vec::new(),
        value: vec![value(of)],
        derivative: if binary {
            vec![slope(dx), slope(dy)]
        } else {
            vec![slope(dx)]
        },
        notes,
    }
}

/// `z.re z.im w.re w.im f.re f.im d.re d.im notes`
fn complex_edge(cells: &[&'static str]) -> Case {
    let &[x, y, u, v, re, im, d_re, d_im, notes] = cells else {
        panic!("{cells:?}")
    };
    Case {
        args: vec![number(x), number(y)],
        params: if u == "-" {
            Vec::new()
        } else {
            vec![number(u), number(v)]
        },
        value: vec![value(re), value(im)],
        derivative: vec![slope(d_re), slope(d_im)],
        notes,
    }
}
