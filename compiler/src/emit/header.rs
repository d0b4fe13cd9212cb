//! What the head of an emitted file says: formula, functions with their units, error, domain, and how to make it again.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::Target;
use super::build::Built;
use super::parts::Part;
use super::request::Emission;
use crate::ir::{Graph, Id, Op, Prim, SINGLE_CALLS, Ty, expand_powers};
use crate::lower::Precision;
use crate::table;

/// Most lines of the program that are quoted.
const MOST_LINES: usize = 24;
/// Columns of a comment of the program.
const COLUMNS: usize = 92;

/// The head as lines without a comment's mark.
pub(super) fn header(
    emission: &Emission,
    parts: &[Part],
    built: &[Built],
    signatures: &[String],
) -> String {
    let mut out = format!("pullback {}\n", env!("CARGO_PKG_VERSION"));
    if let Some(source) = &emission.source {
        out.push('\n');
        quote(&mut out, source);
    }
    for (function, signature) in built.iter().zip(signatures) {
        out.push('\n');
        let _ = writeln!(out, "{signature}");
        match function.remark.as_str() {
            "" => _ = writeln!(out, "  returns {}", function.returns),
            remark => _ = writeln!(out, "  returns {remark}"),
        }
        // those of one kind together
        for alike in function.arguments.chunk_by(|a, b| a.1 == b.1) {
            let names: Vec<&str> = alike.iter().map(|a| a.0.as_str()).collect();
            let _ = writeln!(out, "  {}: {}", names.join(", "), alike[0].1);
        }
    }
    out.push('\n');
    let _ = writeln!(out, "error: {}", errors(emission.precision, parts));
    for remark in domain(parts) {
        let _ = writeln!(out, "domain: {remark}");
    }
    if emission.target == Target::C {
        out.push_str("compile with: -std=c11 -ffp-contract=off -lm, and without -ffast-math\n");
    }
    if let Some(command) = &emission.command {
        let _ = writeln!(out, "made by: {command}");
    }
    out
}

/// The text of the program, without what a comment could trip over.
fn quote(out: &mut String, source: &str) {
    let lines: Vec<&str> = source
        .lines()
        .map(str::trim_end)
        .filter(|l| !l.trim().is_empty())
        .collect();
    for line in paragraphs(&lines).iter().take(MOST_LINES) {
        // a comment of C goes on behind a backslash, and ends early where its own end stands in it
        let line = line.trim_end_matches('\\').replace("??", "? ?");
        let line = line.replace("*/", "* /").replace('`', "'");
        let _ = writeln!(out, "  {line}");
    }
    if lines.len() > MOST_LINES {
        let _ = writeln!(out, "  and {} more lines", lines.len() - MOST_LINES);
    }
}

/// The lines of a program with its comments broken anew, so that they fit behind another comment's mark.
fn paragraphs(lines: &[&str]) -> Vec<String> {
    let mut out: Vec<String> = Vec::new();
    let mut is_open = false;
    for line in lines {
        let Some(words) = line.strip_prefix("// ") else {
            is_open = false;
            out.push((*line).to_owned());
            continue;
        };
        if !is_open {
            out.push("//".to_owned());
            is_open = true;
        }
        for word in words.split_whitespace() {
            let is_full = |line: &String| line.chars().count() + 1 + word.chars().count() > COLUMNS;
            if out.last().is_none_or(is_full) {
                out.push("//".to_owned());
            }
            if let Some(last) = out.last_mut() {
                last.push(' ');
                last.push_str(word);
            }
        }
    }
    out
}

/// The declared bounds of the functions that are used.
fn errors(precision: Precision, parts: &[Part]) -> String {
    if precision == Precision::Fast {
        return "none declared, as the functions are those of the graphics driver".to_owned();
    }
    let unit = match precision {
        Precision::Extended => "2^-48",
        _ => "ulp",
    };
    let mut bounds: BTreeMap<&str, String> = BTreeMap::new();
    for (prim, complex) in operations(parts) {
        let row = table::row(prim);
        if matches!(row.gpu, table::Gpu::Binary(_) | table::Gpu::Unary(_)) {
            continue;
        }
        let word = row.names.first().copied().unwrap_or(row.mnemonic);
        let bound = row
            .bounds()
            .filter(|b| b.complex == complex)
            .filter_map(|b| b.value(Some(precision)))
            .filter(|b| b.units > 0.5)
            .max_by(|a, b| a.units.total_cmp(&b.units));
        if let Some(bound) = bound {
            let metric = match bound.metric {
                table::Metric::Component => "",
                table::Metric::Norm => " of the norm",
                table::Metric::Unit => " absolute",
            };
            let text = format!("{word} {} {unit}{metric}", bound.units);
            bounds
                .entry(word)
                .and_modify(|known| {
                    if text > *known {
                        known.clone_from(&text);
                    }
                })
                .or_insert(text);
        }
    }
    let rounded = "each operation as the device rounds it";
    if bounds.is_empty() {
        return rounded.to_owned();
    }
    let list: Vec<String> = bounds.into_values().collect();
    format!("at most {}; {rounded}", list.join(", "))
}

/// Operations that the parts use, and whether on complex numbers.
fn operations(parts: &[Part]) -> Vec<(Prim, bool)> {
    let mut out = Vec::new();
    for part in parts {
        let evaluation = &part.evaluation;
        for (prim, complex) in of_graph(&evaluation.graph, &evaluation.roots) {
            if !out.contains(&(prim, complex)) {
                out.push((prim, complex));
            }
        }
    }
    out
}

fn of_graph(graph: &Graph, roots: &[Id]) -> Vec<(Prim, bool)> {
    // small powers are products
    let (graph, roots) = expand_powers(graph, roots, &SINGLE_CALLS);
    let live = graph.reachable(&roots);
    let mut out = Vec::new();
    for (id, node) in graph.ids().zip(graph.nodes()) {
        if let Op::Apply(prim) = node.op
            && live[id.index()]
        {
            // a constant divisor is no 0
            let divisor = node.args.last().and_then(|&a| graph.as_real(a));
            if prim == Prim::Div && divisor.is_some_and(|v| v != 0.0) {
                continue;
            }
            let complex = node.args.iter().any(|&a| graph.ty(a) == Ty::Complex);
            out.push((prim, complex));
        }
    }
    out
}

/// Where the formula has no value, as far as its functions tell.
fn domain(parts: &[Part]) -> Vec<&'static str> {
    let used = operations(parts);
    let has = |prims: &[Prim], complex: bool| prims.iter().any(|&p| used.contains(&(p, complex)));
    let mut out = Vec::new();
    if has(&[Prim::Log, Prim::Sqrt], false) {
        out.push("roots and logarithms of negative reals are NaN");
    }
    if has(&[Prim::Log, Prim::Sqrt, Prim::Pow], true) {
        out.push("the principal branch, with a cut along the negative real axis");
    }
    if has(&[Prim::Div], false) {
        out.push("a quotient by 0 is infinite, 0/0 is NaN");
    }
    if has(&[Prim::Div], true) {
        out.push("a complex quotient by 0 has infinite parts");
    }
    if has(&[Prim::Asin, Prim::Acos], false) {
        out.push("asin and acos outside of [-1, 1] are NaN");
    }
    out
}
