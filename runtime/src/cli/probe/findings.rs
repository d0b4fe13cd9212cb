//! What was found at a place, to be told in any form.

use pullback_compiler::lower::Precision;
use pullback_runtime::trace::{self, Parting, Row, Site, Value};

use super::{Column, ProbeArguments};
use crate::cli::subject::Subject;

/// Everything about one invocation.
pub(super) struct Findings<'a> {
    pub(super) subject: &'a Subject,
    pub(super) sites: &'a [Site],
    pub(super) columns: &'a [Column],
    /// `pixel 3,4`
    pub(super) place: String,
    pub(super) precision: Precision,
    /// None where no adapter takes part.
    pub(super) adapter: Option<String>,
    pub(super) arguments: &'a ProbeArguments,
}

/// Two machines that are compared; the second counts as true.
pub(super) struct Pair<'a> {
    pub(super) columns: [usize; 2],
    pub(super) names: [&'a str; 2],
    pub(super) parting: Option<Parting>,
}

impl Findings<'_> {
    /// Each machine with the one after it: a driver's liberties, then the error of single precision.
    pub(super) fn pairs(&self) -> Vec<Pair<'_>> {
        let count = self.columns.len().saturating_sub(1);
        let pairs = (0..count).map(|k| {
            let [a, b] = [&self.columns[k], &self.columns[k + 1]];
            let traces = [&a.trace, &b.trace];
            Pair {
                columns: [k, k + 1],
                names: [a.name, b.name],
                parting: trace::parting(self.sites, traces, self.arguments.ulps),
            }
        });
        pairs.collect()
    }

    /// The sites to be shown, in the order of what they tell: all that have a name, and those at which machines part.
    pub(super) fn rows(&self, pairs: &[Pair]) -> Vec<Row> {
        let traces: Vec<_> = self.columns.iter().map(|column| &column.trace).collect();
        let mut rows = trace::rows(self.sites, &traces);
        let parts_here = |site: usize| {
            let partings = pairs.iter().filter_map(|pair| pair.parting);
            partings.into_iter().any(|parting| parting.site() == site)
        };
        rows.retain(|row| {
            let site = &self.sites[row.site];
            self.arguments.all || site.is_named() || parts_here(row.site)
        });
        rows
    }

    /// Indices of the values of a row that are shown: some first and some last ones.
    pub(super) fn shown(&self, row: &Row) -> Vec<usize> {
        let count = row.values.iter().map(Vec::len).max().unwrap_or(0);
        let steps = self.arguments.steps.max(1);
        (0..count)
            .filter(|&k| k < steps || k + steps >= count)
            .collect()
    }

    /// How far two machines are apart at a value of a row, in units in the last place; none where one has no such value.
    pub(super) fn distance(&self, row: &Row, [a, b]: [usize; 2], k: usize) -> Option<f64> {
        let value = |column: usize| -> Option<Value> { row.values[column].get(k).copied() };
        let shape = self.sites[row.site].shape;
        Some(trace::distance(shape, value(a)?, value(b)?))
    }

    /// The part of the user's text that a site computes, on one line.
    pub(super) fn snippet(&self, site: &Site) -> String {
        let text = site.span.map(|span| span.text(&self.subject.source.text));
        let words: Vec<&str> = text.unwrap_or_default().split_whitespace().collect();
        words.join(" ")
    }
}
