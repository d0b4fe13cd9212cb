//! The expressions and points, from their tables.

use super::bits::Exact;
use crate::corpus::{read, root};

/// The collections.
pub const COLLECTIONS: [&str; 2] = ["fpbench", "herbie"];

/// From how many bits on, lost by the formula as it is written when every operation is correctly rounded to 24 bits and
/// exponents have no bounds, cancellation is said to dominate. Neither our rewrites nor an adapter have a part in it.
pub const DOMINATES: f64 = 4.0;

/// An expression with its points.
#[derive(Clone, Debug)]
pub struct Benchmark {
    /// Collection, file, and place in the file.
    pub id: String,
    /// What its authors call it.
    pub name: String,
    /// Its domain, as an FPCore precondition; `-` for all numbers.
    pub precondition: String,
    /// It as a program of our language.
    pub program: String,
    /// Points that were drawn to find those below.
    pub drawn: usize,
    /// Bits that it loses as it is written, by rounding to 24 bits alone.
    pub plain: f64,
    /// Points of its domain.
    pub points: Vec<Sample>,
}

impl Benchmark {
    /// Whether cancellation, or other amplification of rounding errors, dominates what is lost.
    #[must_use]
    pub fn cancels(&self) -> bool {
        self.plain >= DOMINATES
    }
}

/// A point and the exact value there.
#[derive(Clone, Debug)]
pub struct Sample {
    /// The arguments.
    pub args: Vec<f32>,
    /// The value.
    pub exact: Exact,
}

/// An expression that the language or the suite has no place for.
#[derive(Clone, Debug)]
pub struct Unfit {
    /// Collection, file, and place in the file.
    pub id: String,
    /// What its authors call it.
    pub name: String,
    /// Why.
    pub reason: String,
}

/// A collection: what fits, and what does not.
///
/// # Errors
/// A table is malformed; the line.
pub fn collection(name: &str) -> Result<(Vec<Benchmark>, Vec<Unfit>), String> {
    let folder = root().join("tests/data/benchmarks");
    let table = read(&folder.join(format!("{name}.tsv")));
    let points = read(&folder.join(format!("{name}_points.tsv")));
    let (mut fits, mut unfit) = (Vec::new(), Vec::new());
    for line in rows(&table) {
        let [id, name, precondition, verdict, text] = fields(line, '\t')?;
        if verdict == "-" {
            unfit.push(Unfit {
                id: id.to_owned(),
                name: name.to_owned(),
                reason: text.to_owned(),
            });
            continue;
        }
        fits.push(Benchmark {
            id: id.to_owned(),
            name: name.to_owned(),
            precondition: precondition.to_owned(),
            program: text.to_owned(),
            drawn: 0,
            plain: f64::NAN,
            points: Vec::new(),
        });
    }
    let mut lines = rows(&points);
    for benchmark in &mut fits {
        let head = lines.next().unwrap_or_default();
        let [id, count, drawn, plain] = fields(head, '\t')?;
        if id != benchmark.id {
            return Err(format!("points of {id} for {}", benchmark.id));
        }
        let wrong = |_| head.to_owned();
        let count: usize = count.parse().map_err(wrong)?;
        benchmark.drawn = drawn.parse().map_err(wrong)?;
        benchmark.plain = plain.parse().map_err(|_| head.to_owned())?;
        benchmark.points = lines
            .by_ref()
            .take(count)
            .map(sample)
            .collect::<Result<_, _>>()?;
    }
    match lines.next() {
        Some(line) => Err(line.to_owned()),
        None => Ok((fits, unfit)),
    }
}

/// All lines but comments.
fn rows(table: &str) -> impl Iterator<Item = &str> {
    table.lines().filter(|line| !line.starts_with('#'))
}

fn fields<const N: usize>(line: &str, separator: char) -> Result<[&str; N], String> {
    let all: Vec<&str> = line.split(separator).collect();
    all.try_into().map_err(|_| line.to_owned())
}

/// `ARGUMENT … VALUE REST`: bits of `f32`, bits of an `f64`, a decimal.
fn sample(line: &str) -> Result<Sample, String> {
    let wrong = || line.to_owned();
    let mut words: Vec<&str> = line.split(' ').collect();
    let lo = words.pop().and_then(|w| w.parse().ok()).ok_or_else(wrong)?;
    let hi = words
        .pop()
        .and_then(|w| u64::from_str_radix(w, 16).ok())
        .map(f64::from_bits)
        .ok_or_else(wrong)?;
    let args = words
        .iter()
        .map(|w| u32::from_str_radix(w, 16).map(f32::from_bits))
        .collect::<Result<_, _>>()
        .map_err(|_| wrong())?;
    Ok(Sample {
        args,
        exact: Exact { hi, lo },
    })
}
