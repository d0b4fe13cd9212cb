//! Numbers by themselves, and what a second run has found, as text.

use pullback_runtime::measure::{Check, Number, Quantity, Report, Row};

use super::table::brief;

/// The quantities that some choice has.
pub(super) fn quantities(rows: &[Row]) -> Vec<Quantity> {
    let has = |quantity: &Quantity| {
        let mut all = rows.iter().flat_map(|row| &row.numbers);
        all.any(|n| n.quantity == *quantity)
    };
    Quantity::ALL.into_iter().filter(has).collect()
}

/// A choice's number of a quantity.
pub(super) fn number(row: &Row, quantity: Quantity) -> Option<&Number> {
    row.numbers.iter().find(|n| n.quantity == quantity)
}

/// What the table of numbers holds, a sentence a line; nothing where there are none.
pub(super) fn caption(report: &Report) -> Vec<String> {
    let first = report.rows.iter().find_map(|row| row.numbers.first());
    let mut out = Vec::new();
    if let Some(first) = first {
        out.push(format!(
            "Numbers at the middles of {} pixels with something to compare: what 99.9 % of the errors do not exceed, and the greatest.",
            first.pixels
        ));
    }
    out.extend(
        report
            .numbers_note
            .as_ref()
            .map(|note| format!("Not all numbers are compared: {note}.")),
    );
    out
}

/// The unit of a quantity, where it has one.
pub(super) fn head(quantity: Quantity) -> String {
    match quantity {
        Quantity::Value | Quantity::Gradient => format!("{}, relative", quantity.name()),
        _ => format!("{}, {}", quantity.name(), quantity.unit()),
    }
}

/// The share of pixels at which one has what the other lacks: the greatest of all quantities.
pub(super) fn apart(row: &Row) -> String {
    let most = row.numbers.iter().fold(0.0, |m: f64, n| m.max(n.apart));
    if row.numbers.is_empty() {
        String::new()
    } else if most == 0.0 {
        "0".to_owned()
    } else {
        format!("{} %", brief(100.0 * most))
    }
}

/// The table, a line each.
pub(super) fn lines(rows: &[Row]) -> Vec<String> {
    let quantities = quantities(rows);
    if quantities.is_empty() {
        return Vec::new();
    }
    let width = super::table::width(rows);
    let mut head_line = format!("    {:<width$}", "choice");
    for &quantity in &quantities {
        head_line += &format!("  {:>22}", head(quantity));
    }
    head_line += "    apart";
    let mut out = vec![head_line];
    for (k, row) in (1..).zip(rows).filter(|(_, row)| !row.numbers.is_empty()) {
        let mut line = format!("{k:>2}  {:<width$}", row.name);
        for &quantity in &quantities {
            let shown = number(row, quantity).map_or_else(
                || "-".to_owned(),
                |n| format!("{:>8}  {:>8}", brief(n.error.p999), brief(n.error.max)),
            );
            line += &format!("  {shown:>22}");
        }
        line += &format!("  {:>7}", apart(row));
        out.push(line);
    }
    out
}

/// What the second run has found, a sentence a line.
pub(super) fn second_run(report: &Report) -> Vec<String> {
    let again = &report.again;
    let mut out = Vec::new();
    if !again.checks.is_empty() {
        let place = if again.elsewhere {
            "at other parts of the picture and in other turns"
        } else {
            "of all of the picture, in other turns"
        };
        let holds = again.checks.iter().all(Check::holds);
        let known = again.checks.iter().any(|c| c.error_holds.is_some());
        out.push(match (known, holds) {
            (false, _) => format!("A second run, {place}, has found nothing."),
            (_, true) => format!("A second run, {place}, has found what is told."),
            (_, false) => format!("A second run, {place}, has not found what is told."),
        });
        out.extend(again.checks.iter().map(|check| checked(report, check)));
    }
    out.extend(
        again
            .note
            .as_ref()
            .map(|note| format!("The second run is not complete: {note}.")),
    );
    out
}

fn checked(report: &Report, check: &Check) -> String {
    let row = &report.rows[check.choice];
    let told = row.error.map_or(f64::NAN, |e| e.seen.mean);
    let mut line = format!("  {}: ", row.name);
    line += &match (check.error, check.error_holds) {
        (Some(found), Some(holds)) => format!(
            "error {} instead of {}, {} {} that chance allows",
            brief(found.seen.mean),
            brief(told),
            if holds { "within" } else { "more than" },
            brief(check.allowed)
        ),
        _ => "error not known".to_owned(),
    };
    if let Some([before, now]) = check.times {
        let ranges = |[low, high]: [f64; 2]| format!("{}–{}", brief(low), brief(high));
        line += &match check.time_holds {
            None => "; too few turns for its time".to_owned(),
            Some(holds) => format!(
                "; time {} ({}) instead of {} ({}) of the default's{}",
                brief(now.value),
                ranges(now.range),
                brief(before.value),
                ranges(before.range),
                if holds { "" } else { ", which is no chance" }
            ),
        };
    }
    line
}
