//! The IR as text, for tests and for `explain`: one node a line, `%3 = mul %1 %2 : real`.

use std::fmt::Write as _;

use rustc_hash::FxHashMap;

use super::{Binder, Graph, Id, Op, Prim, Ty};
use crate::table;

/// Writes what the roots depend on, operands before users, and the roots last.
#[must_use]
pub fn to_text(graph: &Graph, roots: &[Id]) -> String {
    let (graph, roots) = graph.compacted(roots);
    let mut out = String::new();
    for (id, node) in graph.ids().zip(graph.nodes()) {
        let _ = write!(out, "%{} = {}", id.index(), mnemonic(node.op));
        for arg in &node.args {
            let _ = write!(out, " %{}", arg.index());
        }
        let _ = write!(out, " : {}", ty_name(node.ty));
        if let Some(name) = graph.name(id) {
            let _ = write!(out, "  ; {name}");
        }
        out.push('\n');
    }
    let roots: Vec<_> = roots.iter().map(|r| format!("%{}", r.index())).collect();
    let _ = writeln!(out, "-> {}", roots.join(" "));
    out
}

fn ty_name(ty: Ty) -> &'static str {
    match ty {
        Ty::Real => "real",
        Ty::Complex => "complex",
        Ty::Bool => "bool",
        Ty::Loop => "loop",
    }
}

fn mnemonic(op: Op) -> String {
    match op {
        Op::Const(bits) => format!("const {:?}", f64::from_bits(bits)),
        Op::Truth(value) => format!("truth {value}"),
        Op::Input(k) => format!("input {k}"),
        Op::Param(k) => format!("param {k}"),
        Op::Time => "time".into(),
        Op::Pixel => "pixel".into(),
        Op::Variable(k) => format!("variable {k}"),
        Op::State(binder, k) => format!("state {} {k}", binder.0),
        Op::Counter(binder) => format!("counter {}", binder.0),
        Op::Loop {
            binder,
            limit,
            until,
        } => {
            let word = if until { "until" } else { "loop" };
            format!("{word} {} {limit}", binder.0)
        }
        Op::Result(k) => format!("result {k}"),
        Op::Apply(Prim::PowInt(n)) => format!("powint {n}"),
        Op::Apply(prim) => {
            let word = table::row(prim).mnemonic;
            prim.order()
                .map_or_else(|| word.into(), |n| format!("{word} {n}"))
        }
    }
}

/// A line of the text form could not be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ParseError {
    /// Line number, from 1.
    pub line: usize,
    /// What was expected.
    pub expected: &'static str,
}

/// Reads the text form back: the graph and its roots. Names are not read.
///
/// # Errors
/// The first line that is not in the form that [`to_text`] writes.
pub fn parse_text(text: &str) -> Result<(Graph, Vec<Id>), ParseError> {
    let mut graph = Graph::new();
    let mut ids: FxHashMap<&str, Id> = FxHashMap::default();
    let mut roots = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let fail = |expected| ParseError {
            line: number + 1,
            expected,
        };
        let line = line.split(';').next().unwrap_or("").trim();
        if line.is_empty() {
            continue;
        }
        if let Some(rest) = line.strip_prefix("->") {
            for word in rest.split_whitespace() {
                roots.push(*ids.get(word).ok_or(fail("a root defined above"))?);
            }
            continue;
        }
        let (name, rest) = line.split_once('=').ok_or(fail("`%n = …`"))?;
        let (body, ty) = rest.rsplit_once(':').ok_or(fail("a type"))?;
        let ty = match ty.trim() {
            "real" => Ty::Real,
            "complex" => Ty::Complex,
            "bool" => Ty::Bool,
            "loop" => Ty::Loop,
            _ => return Err(fail("real, complex, bool or loop")),
        };
        let mut words = body.split_whitespace();
        let op = parse_op(&mut words).ok_or(fail("an operation"))?;
        let mut args = Vec::new();
        for word in words {
            args.push(*ids.get(word).ok_or(fail("an operand defined above"))?);
        }
        if let Op::State(binder, k) = op {
            graph.state(binder, k, ty);
        }
        ids.insert(name.trim(), graph.intern(op, ty, &args));
    }
    Ok((graph, roots))
}

fn parse_op<'a>(words: &mut impl Iterator<Item = &'a str>) -> Option<Op> {
    let word = words.next()?;
    Some(match word {
        "const" => Op::Const(words.next()?.parse::<f64>().ok()?.to_bits()),
        "truth" => Op::Truth(words.next()?.parse().ok()?),
        "input" => Op::Input(words.next()?.parse().ok()?),
        "param" => Op::Param(words.next()?.parse().ok()?),
        "time" => Op::Time,
        "pixel" => Op::Pixel,
        "variable" => Op::Variable(words.next()?.parse().ok()?),
        "state" => {
            let binder = Binder(words.next()?.parse().ok()?);
            Op::State(binder, words.next()?.parse().ok()?)
        }
        "counter" => Op::Counter(Binder(words.next()?.parse().ok()?)),
        "loop" | "until" => Op::Loop {
            binder: Binder(words.next()?.parse().ok()?),
            limit: words.next()?.parse().ok()?,
            until: word == "until",
        },
        "result" => Op::Result(words.next()?.parse().ok()?),
        "powint" => Op::Apply(Prim::PowInt(words.next()?.parse().ok()?)),
        _ => {
            let prim = table::rows().iter().find(|row| row.mnemonic == word)?.prim;
            Op::Apply(match prim.order() {
                Some(_) => prim.with_order(words.next()?.parse().ok()?),
                None => prim,
            })
        }
    })
}
