//! The tables of references, as cases. They are part of the program, packed.

use std::collections::HashMap;
use std::sync::OnceLock;

use super::decimal::Double;
use super::error::OVERFLOW;

/// The tables of `build.rs`, one after another.
const PACKED: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/references"));

/// The remark of a case whose arguments have more bits than a float32 holds.
pub const WIDE: &str = "wide";

/// What a number has to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Expected {
    /// The table does not say.
    Unstated,
    /// This number; of a zero or an infinity also its sign, where `signed`.
    Number {
        /// The number, to the precision of `f64`.
        value: f64,
        /// What is missing in `value`.
        rest: f64,
        /// Whether the sign of a zero or an infinity counts.
        signed: bool,
    },
}

/// One row of a table.
#[derive(Clone, Debug)]
pub struct Case {
    /// The arguments, every one a float32 but in wide cases.
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

/// Reads the cells of a line behind its word.
type Reader = fn(&[&'static str]) -> Option<Case>;

type Index = HashMap<(&'static str, Domain), Vec<Case>>;

/// Every case of a function, by its word in the tables.
///
/// # Errors
/// A table is malformed; in words.
pub fn cases(word: &str, domain: Domain) -> Result<Vec<Case>, String> {
    static INDEX: OnceLock<Result<Index, String>> = OnceLock::new();
    let index = INDEX.get_or_init(read).as_ref().map_err(Clone::clone)?;
    let found = index
        .iter()
        .find(|((name, of), _)| *name == word && *of == domain);
    Ok(found.map(|(_, cases)| cases.clone()).unwrap_or_default())
}

fn read() -> Result<Index, String> {
    let mut index = Index::new();
    let kinds: [(Reader, Domain); 6] = [
        (real_oracle, Domain::Real),
        (complex_oracle, Domain::Complex),
        (real_edge, Domain::Real),
        (complex_edge, Domain::Complex),
        (real_edge, Domain::Real),
        (complex_edge, Domain::Complex),
    ];
    let tables: Vec<&'static str> = text()?.split('\x0c').collect();
    let (plain, wide) = tables.split_at_checked(kinds.len()).ok_or("no tables")?;
    for (table, (parse, domain)) in plain.iter().zip(kinds) {
        for line in rows(table) {
            let cells: Vec<&'static str> = line.split('\t').collect();
            let (&word, rest) = cells.split_first().ok_or("an empty line")?;
            let case = parse(rest).ok_or_else(|| format!("a reference is malformed: {line}"))?;
            index.entry((word, domain)).or_default().push(case);
        }
    }
    for line in wide.iter().flat_map(|table| rows(table)) {
        let (word, domain, case) =
            wide_row(line).ok_or_else(|| format!("a reference is malformed: {line}"))?;
        index.entry((word, domain)).or_default().push(case);
    }
    Ok(index)
}

fn rows(table: &'static str) -> impl Iterator<Item = &'static str> {
    table.lines().filter(|line| !line.starts_with('#'))
}

fn text() -> Result<&'static str, String> {
    static TEXT: OnceLock<Result<String, String>> = OnceLock::new();
    let unpack = || {
        let bytes = miniz_oxide::inflate::decompress_to_vec(PACKED)
            .map_err(|error| format!("the tables of references are damaged: {error}"))?;
        String::from_utf8(bytes).map_err(|error| error.to_string())
    };
    let text = TEXT.get_or_init(unpack);
    text.as_deref().map_err(Clone::clone)
}

fn number(cell: &str) -> Option<f64> {
    cell.parse().ok()
}

fn numbers(cells: &[&str]) -> Option<Vec<f64>> {
    cells.iter().map(|cell| number(cell)).collect()
}

/// A reference. One with no more digits than a `f64` needs is that `f64`, and so is one that differs from it by no more
/// than its own rounding: the tables write exact numbers so.
fn reference(cell: &str) -> Option<Double> {
    let Double { high, low } = Double::parse(cell)?;
    let mantissa = cell.split(['e', 'E']).next().unwrap_or(cell);
    let digits = mantissa.chars().filter(char::is_ascii_digit);
    let significant = digits.skip_while(|c| *c == '0').count();
    let exact = significant <= 17 || low.abs() <= 1e-19 * high.abs();
    Some(Double {
        high,
        low: if exact { 0.0 } else { low },
    })
}

/// A value: `-` where nothing is stated, `±` before a zero or an infinity of either sign.
#[must_use]
pub fn value(cell: &str) -> Option<Expected> {
    if cell == "-" {
        return Some(Expected::Unstated);
    }
    let digits = cell.strip_prefix('±');
    let Double { high, low } = reference(digits.unwrap_or(cell))?;
    Some(Expected::Number {
        value: high,
        rest: low,
        signed: digits.is_none(),
    })
}

/// A derivative: the sign of one that vanishes is not stated, nor is a NaN of the oracle tables.
#[must_use]
pub fn slope(cell: &str) -> Option<Expected> {
    Some(match value(cell)? {
        Expected::Number { value, .. } if value.is_nan() => Expected::Unstated,
        Expected::Number { value, rest, .. } => {
            let beyond = value.abs() >= OVERFLOW;
            Expected::Number {
                value: if beyond { value * f64::INFINITY } else { value },
                rest: if beyond { 0.0 } else { rest },
                signed: value.abs() > 1.0,
            }
        }
        Expected::Unstated => Expected::Unstated,
    })
}

fn slopes(cells: &[&str]) -> Option<Vec<Expected>> {
    cells.iter().map(|cell| slope(cell)).collect()
}

/// A value of the oracle tables, which do not state the sign of a zero.
fn unsigned(cell: &str) -> Option<Expected> {
    let Double { high, low } = reference(cell)?;
    Some(Expected::Number {
        value: high,
        rest: low,
        signed: false,
    })
}

fn real_oracle(cells: &[&'static str]) -> Option<Case> {
    let arity = cells.len().checked_sub(1)? / 2;
    Some(Case {
        args: numbers(&cells[..arity])?,
        params: Vec::new(),
        value: vec![unsigned(cells[arity])?],
        derivative: slopes(&cells[arity + 1..])?,
        notes: "-",
    })
}

fn complex_oracle(cells: &[&'static str]) -> Option<Case> {
    let &[x, y, re, im, d_re, d_im] = cells else {
        return None;
    };
    Some(Case {
        args: numbers(&[x, y])?,
        params: Vec::new(),
        value: vec![unsigned(re)?, unsigned(im)?],
        derivative: slopes(&[d_re, d_im])?,
        notes: "-",
    })
}

/// `x y value dx dy notes`
fn real_edge(cells: &[&'static str]) -> Option<Case> {
    let &[x, y, of, dx, dy, notes] = cells else {
        return None;
    };
    let count = if y == "-" { 1 } else { 2 };
    Some(Case {
        args: numbers(&[x, y][..count])?,
        params: Vec::new(),
        value: vec![value(of)?],
        derivative: slopes(&[dx, dy][..count])?,
        notes,
    })
}

/// `z.re z.im w.re w.im f.re f.im d.re d.im notes`
fn complex_edge(cells: &[&'static str]) -> Option<Case> {
    let &[x, y, u, v, re, im, d_re, d_im, notes] = cells else {
        return None;
    };
    Some(Case {
        args: numbers(&[x, y])?,
        params: if u == "-" {
            Vec::new()
        } else {
            numbers(&[u, v])?
        },
        value: vec![value(re)?, value(im)?],
        derivative: slopes(&[d_re, d_im])?,
        notes,
    })
}

/// `function domain arguments value derivative`; a second complex operand is among the arguments.
fn wide_row(line: &'static str) -> Option<(&'static str, Domain, Case)> {
    let cells: Vec<&'static str> = line.split('\t').collect();
    let &[word, domain, args, of, slope] = cells.as_slice() else {
        return None;
    };
    let split = |cell: &'static str| cell.split(' ').collect::<Vec<_>>();
    let args = numbers(&split(args))?;
    let (domain, own) = match domain {
        "real" => (Domain::Real, args.len()),
        "complex" => (Domain::Complex, 2),
        _ => return None,
    };
    let case = Case {
        params: args.get(own..)?.to_vec(),
        args: args.get(..own)?.to_vec(),
        value: split(of).into_iter().map(unsigned).collect::<Option<_>>()?,
        derivative: slopes(&split(slope))?,
        notes: WIDE,
    };
    Some((word, domain, case))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_is_a_case() {
        let index = read().unwrap();
        let cases: usize = index.values().map(Vec::len).sum();
        let lines: usize = text().unwrap().split('\x0c').map(|t| rows(t).count()).sum();
        assert_eq!(cases, lines);
        assert!(lines > 12_000, "{lines}");
    }

    /// The program grows by these tables: less than a mebibyte.
    #[test]
    fn tables_are_small() {
        assert!(PACKED.len() < 700_000, "{}", PACKED.len());
    }
}
