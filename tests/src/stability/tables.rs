//! The tables of what was found.

use std::fmt::Write as _;

use super::rays::{Distance, Slant};
use super::{BOUND, Found, Outcome};

/// A share in percent, with as many digits as tell it from all.
#[must_use]
pub fn share(part: usize, all: usize) -> String {
    if part == all {
        return "100".to_owned();
    }
    let percent = 100.0 * part as f64 / all as f64;
    format!("{:.2}", percent.min(99.99))
}

/// An error with one digit.
#[must_use]
pub fn digit(x: f64) -> String {
    if x == 0.0 {
        "0".to_owned()
    } else if x.is_finite() {
        format!("{x:.0e}")
    } else {
        "∞".to_owned()
    }
}

/// Median, the error that 99 % are within, and the greatest.
fn ranks(errors: impl Iterator<Item = f64>) -> Option<[f64; 3]> {
    let mut errors: Vec<f64> = errors.collect();
    errors.sort_by(f64::total_cmp);
    let last = errors.len().checked_sub(1)?;
    Some([errors[last / 2], errors[last * 99 / 100], errors[last]])
}

fn within<'a>(outcomes: impl Iterator<Item = &'a Outcome>, roundings: f64) -> usize {
    outcomes.filter(|o| o.is_within(roundings)).count()
}

/// Each class: origins within 10 units, then those 100 units away as they are and shifted in f64.
#[must_use]
pub fn by_class(all: &[Found]) -> String {
    let mut out = "| class | density | rays | median | 99 % | worst | within 1e-6 | with the roundings of the ray | no number | \
                   100 units: worst | within 1e-4 | shifted: worst | within 1e-6 | without rests: worst | within 1e-6 |\n\
                   | --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n"
        .to_owned();
    for found in all {
        let near = || found.at(Distance::Near);
        let count = near().count();
        let Some([median, most, worst]) = ranks(near().map(|o| o.error)) else {
            continue;
        };
        let none = found.outcomes.iter().filter(|o| !o.found.is_finite());
        let _ = write!(
            out,
            "| {} | `{}` | {count} | {} | {} | {} | {} | {} | {} |",
            found.class.name.replace('|', "\\|"),
            found.class.formula,
            digit(median),
            digit(most),
            digit(worst),
            share(within(near(), 0.0), count),
            share(within(near(), 8.0), count),
            none.count()
        );
        out += &hundred(found);
    }
    out
}

fn hundred(found: &Found) -> String {
    let hundred = || found.at(Distance::Hundred);
    let count = hundred().count();
    if count == 0 {
        return " – | – | – | – | – | – |\n".to_owned();
    }
    let told = |errors: &dyn Fn(&Outcome) -> f64, bound: f64| {
        let worst = hundred().map(errors).fold(0.0, f64::max);
        let good = hundred().filter(|o| errors(o) <= bound).count();
        format!(" {} | {} |", digit(worst), share(good, count))
    };
    let own = told(&|o| o.error, 1e-4);
    let (shifted, rounded) = (told(&|o| o.shifted, BOUND), told(&|o| o.rounded, BOUND));
    format!("{own}{shifted}{rounded}\n")
}

/// Directions by their least component, over all classes, origins within 10 units.
#[must_use]
pub fn by_slant(all: &[Found]) -> String {
    let mut out = "| least component of d | rays | median | 99 % | worst | within 1e-6 | with the roundings of the ray | no number |\n\
                   | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n"
        .to_owned();
    for slant in Slant::all() {
        let of = || all.iter().flat_map(move |found| found.slanted(slant));
        let count = of().count();
        let Some([median, most, worst]) = ranks(of().map(|o| o.error)) else {
            continue;
        };
        let _ = writeln!(
            out,
            "| {} | {count} | {} | {} | {} | {} | {} | {} |",
            slant.name(),
            digit(median),
            digit(most),
            digit(worst),
            share(within(of(), 0.0), count),
            share(within(of(), 8.0), count),
            of().filter(|o| !o.found.is_finite()).count()
        );
    }
    out
}

/// The classes that a textbook has an antiderivative of, beside it, origins within 10 units.
#[must_use]
pub fn by_textbook(all: &[Found]) -> String {
    let mut out = "| density | textbook, median | worst | no number | closed form, median | worst | no number |\n\
                   | --- | ---: | ---: | ---: | ---: | ---: | ---: |\n"
        .to_owned();
    for found in all.iter().filter(|f| f.class.textbook.is_some()) {
        let near = || found.at(Distance::Near);
        let finite = |errors: &[f64]| {
            errors
                .iter()
                .copied()
                .filter(|e| e.is_finite())
                .fold(0.0, f64::max)
        };
        let naive: Vec<f64> = near().map(|o| o.textbook).collect();
        let own: Vec<f64> = near().map(|o| o.error).collect();
        let none = |errors: &[f64]| errors.iter().filter(|e| e.is_infinite()).count();
        let median = |errors: &[f64]| ranks(errors.iter().copied()).map_or(0.0, |r| r[0]);
        let _ = writeln!(
            out,
            "| `{}` | {} | {} | {} | {} | {} | {} |",
            found.class.formula,
            digit(median(&naive)),
            digit(finite(&naive)),
            none(&naive),
            digit(median(&own)),
            digit(finite(&own)),
            none(&own)
        );
    }
    out
}

/// The rays whose error is beyond the bound and as many roundings of their numbers, worst first, and those from anywhere without a number.
#[must_use]
pub fn unexplained(found: &Found, roundings: f64, count: usize) -> String {
    let none = found.outcomes.iter().filter(|o| !o.found.is_finite());
    let mut bad: Vec<&Outcome> = found
        .at(Distance::Near)
        .filter(|o| o.found.is_finite() && !o.is_within(roundings))
        .chain(none)
        .collect();
    bad.sort_by(|a, b| b.error.total_cmp(&a.error));
    let mut out = format!("{}: {} rays\n", found.class.formula, bad.len());
    for o in bad.iter().take(count) {
        let _ = writeln!(
            out,
            "    {:?} {:?}: {:e}, not {:e}: {:.1e}, roundings {:.1e}",
            o.ray.slant, o.ray.numbers, o.found, o.exact, o.error, o.moved
        );
    }
    out
}
