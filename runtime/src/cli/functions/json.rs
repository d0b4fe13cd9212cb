//! All functions with their bounds as JSON.

use std::collections::BTreeMap;
use std::io::{self, Write};

use pullback_compiler::lower::Precision;
use pullback_compiler::table::{Bound, Bounds};
use pullback_runtime::accuracy::error::Judge;
use serde::Serialize;

use super::Entry;
use super::bounds::TIERS;

#[derive(Serialize)]
struct Function<'e> {
    usage: &'e str,
    also: &'e [&'static str],
    takes: &'e str,
    meaning: &'e str,
    bounds: Vec<FunctionBounds>,
}

#[derive(Serialize)]
struct FunctionBounds {
    name: &'static str,
    complex: bool,
    tiers: BTreeMap<&'static str, TierBounds>,
    reason: &'static str,
}

#[derive(Serialize)]
struct TierBounds {
    unit: &'static str,
    value: Option<Largest>,
    derivative: Option<Largest>,
}

#[derive(Serialize)]
struct Largest {
    error: f64,
    /// Of which it is: `component`, `norm` or `unit`.
    of: &'static str,
}

pub(super) fn write(output: &mut dyn Write, entries: &[Entry]) -> io::Result<()> {
    let functions: Vec<Function<'_>> = entries.iter().map(of_entry).collect();
    serde_json::to_writer_pretty(&mut *output, &functions)?;
    writeln!(output)
}

fn of_entry(entry: &Entry) -> Function<'_> {
    Function {
        usage: &entry.usage,
        also: &entry.also,
        takes: entry.types,
        meaning: &entry.doc,
        bounds: entry.bounds.iter().map(|bounds| of_tiers(bounds)).collect(),
    }
}

fn of_tiers(bounds: &Bounds) -> FunctionBounds {
    let tier = |tier: Precision| {
        let found = TierBounds {
            unit: tier.format().unit_words(),
            value: bounds.value(Some(tier)).map(largest),
            derivative: bounds.derivative(Some(tier)).map(largest),
        };
        (tier.name(), found)
    };
    FunctionBounds {
        name: bounds.word,
        complex: bounds.complex,
        tiers: TIERS.map(tier).into_iter().collect(),
        reason: bounds.reason,
    }
}

fn largest(bound: Bound) -> Largest {
    let word = bound.metric.word();
    Largest {
        error: bound.units,
        of: if word.is_empty() { "component" } else { word },
    }
}
