//! What each operation is worth: declared bounds of the errors of its value and of its derivative.

use std::sync::OnceLock;

use super::{Row, by_name, row, rows};
use crate::ir::Prim;
use crate::lower::Precision;

/// `function domain`, then a bound of the value and one of the derivative for the reference evaluator and for each tier
/// that has any, and the reason of what is high.
const TABLE: &str = include_str!("bounds.tsv");
/// Places of the bounds in a line.
const PLACES: usize = 8;

/// How an error is divided; the sharpest first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Metric {
    /// By the unit of each component of the result.
    #[default]
    Component,
    /// By that of the greatest component.
    Norm,
    /// By that of the greatest component, or of 1 where that is greater: an absolute error where the result is small.
    Unit,
}

impl Metric {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Component, Self::Norm, Self::Unit];

    /// Its word in the table of bounds.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Component => "",
            Self::Norm => "norm",
            Self::Unit => "unit",
        }
    }
}

/// The largest error that an operation may have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bound {
    /// In units of the number format: units in the last place (ulp) of binary32 or binary64, or 2⁻⁴⁸ of the result for
    /// pairs of binary32.
    pub units: f64,
    /// What it is divided by.
    pub metric: Metric,
}

impl Bound {
    /// A bound as tables write it: a number, and the metric where it is not by component.
    #[must_use]
    pub fn parse(cell: &str) -> Option<Self> {
        let (number, word) = cell.split_once(' ').unwrap_or((cell, ""));
        let metric = Metric::ALL.into_iter().find(|m| m.word() == word)?;
        Some(Self {
            units: number.parse().ok()?,
            metric,
        })
    }
}

impl std::fmt::Display for Bound {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let text = format!("{} {}", self.units, self.metric.word());
        f.pad(text.trim_end())
    }
}

/// The bounds of an operation on reals or on complex numbers.
#[derive(Clone, Debug)]
pub struct Bounds {
    /// Its word in tables: its name in the language, its mnemonic, or one of a family (`pow7`, `inverse`).
    pub word: &'static str,
    /// Whether they are of complex operands.
    pub complex: bool,
    /// Why a bound is high, or not by component; may be empty.
    pub reason: &'static str,
    prim: Prim,
    places: [Option<Bound>; PLACES],
}

impl Bounds {
    /// The row of the operation.
    #[must_use]
    pub fn row(&self) -> &'static Row {
        row(self.prim)
    }

    /// The bound of the value: of a tier, or of the `f64` reference where there is none. `None` where nothing is
    /// promised.
    #[must_use]
    pub fn value(&self, precision: Option<Precision>) -> Option<Bound> {
        self.places[place(precision)?]
    }

    /// The bound of each partial derivative, likewise. `None` also where there is no rule.
    #[must_use]
    pub fn derivative(&self, precision: Option<Precision>) -> Option<Bound> {
        self.places[place(precision)? + 1]
    }

    fn parse(line: &'static str) -> Option<Self> {
        let cells: Vec<&'static str> = line.split('\t').collect();
        let (&[word, domain], rest) = cells.split_first_chunk::<2>()?;
        let (&reason, numbers) = rest.split_last()?;
        let mut places = [None; PLACES];
        if numbers.len() != PLACES || !["real", "complex"].contains(&domain) {
            return None;
        }
        for (place, &cell) in places.iter_mut().zip(numbers) {
            *place = Bound::parse(cell);
            if place.is_none() && cell != "-" {
                return None;
            }
        }
        Some(Self {
            word,
            complex: domain == "complex",
            reason: if reason == "-" { "" } else { reason },
            prim: operation(word)?,
            places,
        })
    }
}

fn place(precision: Option<Precision>) -> Option<usize> {
    match precision {
        None => Some(0),
        Some(Precision::Fast) => None,
        Some(Precision::Accurate) => Some(2),
        Some(Precision::Extended) => Some(4),
        Some(Precision::Double) => Some(6),
    }
}

/// The operation that a word of the table stands for.
fn operation(word: &str) -> Option<Prim> {
    let named = || by_name(word).or_else(|| rows().iter().find(|r| r.mnemonic == word));
    match word {
        "square" | "cube" | "pow7" | "inverse_square" => {
            let family = rows().iter().find(|r| matches!(r.prim, Prim::PowInt(_)));
            family.map(|r| r.prim)
        }
        "inverse" => Some(Prim::Div),
        _ => named().map(|r| r.prim),
    }
}

fn lines() -> impl Iterator<Item = &'static str> {
    TABLE.lines().filter(|line| !line.starts_with('#'))
}

/// Every declared bound.
pub fn bounds() -> &'static [Bounds] {
    static BOUNDS: OnceLock<Vec<Bounds>> = OnceLock::new();
    BOUNDS.get_or_init(|| lines().filter_map(Bounds::parse).collect())
}

/// The bounds of a word of the table.
#[must_use]
pub fn bounds_of(word: &str, complex: bool) -> Option<&'static Bounds> {
    bounds()
        .iter()
        .find(|b| b.word == word && b.complex == complex)
}

impl Row {
    /// The declared bounds of the operation; of a family (powers, quotients) those of some members.
    pub fn bounds(&self) -> impl Iterator<Item = &'static Bounds> {
        let own = std::mem::discriminant(&self.prim);
        bounds()
            .iter()
            .filter(move |b| std::mem::discriminant(&b.prim) == own)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::Typing;

    #[test]
    fn every_line_is_read() {
        let read: Vec<&str> = bounds().iter().map(|b| b.word).collect();
        let written: Vec<&str> = lines().filter_map(|l| l.split('\t').next()).collect();
        assert_eq!(read, written);
        let mut keys: Vec<_> = bounds().iter().map(|b| (b.word, b.complex)).collect();
        keys.sort_unstable();
        keys.dedup();
        assert_eq!(keys.len(), written.len());
    }

    /// 4 ulp in single precision and in doubles, 2⁻⁴² of the result in pairs, for what is not of the gamma family; four times
    /// that for derivatives.
    #[test]
    fn tiers_keep_the_limits() {
        let special = ["gamma", "lgamma", "digamma", "trigamma"];
        let tiers = [
            (Precision::Accurate, 4.0),
            (Precision::Extended, 64.0),
            (Precision::Double, 4.0),
        ];
        for bounds in bounds().iter().filter(|b| !special.contains(&b.word)) {
            for (tier, most) in tiers {
                let value = bounds.value(Some(tier)).expect("a bound").units;
                let slope = bounds.derivative(Some(tier)).map_or(0.0, |b| b.units);
                let (word, name) = (bounds.word, tier.name());
                assert!(value <= most, "{word}, {name}: {value}");
                assert!(slope <= 4.0 * most, "{word}′, {name}: {slope}");
            }
        }
    }

    /// What can be written and gives a number has bounds, on each type that it takes.
    #[test]
    fn every_function_has_bounds() {
        let numeric = rows().iter().filter(|r| r.is_written());
        for row in numeric {
            let complex = match row.typing {
                Typing::Arithmetic(_) | Typing::Analytic(_) | Typing::Part => true,
                Typing::Real(_) => false,
                _ => continue,
            };
            // lengths and hashes of more operands are judged by the formulas of the library
            if row.typing.arity() > 2 {
                continue;
            }
            // sums and signs act on components
            let by_component = ["neg", "add", "sub"].contains(&row.mnemonic);
            let has = |of: bool| {
                row.bounds()
                    .any(|b| b.complex == of && b.value(Some(Precision::Accurate)).is_some())
            };
            // what is defined in the language is judged by tables that count what one unit of the argument moves
            let judged = |of: bool| has(of) || row.is_defined(of);
            assert!(judged(false), "{}", row.usage);
            assert!(judged(true) || !complex || by_component, "{}", row.usage);
        }
    }
}
