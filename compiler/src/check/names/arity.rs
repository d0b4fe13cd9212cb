//! Numbers of arguments.

use pullback_grammar::Diagnostic;
use pullback_grammar::ast::Name;

use super::listed;
use crate::check::suggest::quoted;
use crate::check::{builtins, library};
use crate::table;

/// `fbm(p: vec2, octaves: real)` as `fbm(p, octaves)`.
fn without_types(usage: &str) -> String {
    let mut parts = usage.split(": ");
    let mut out = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let rest = part.find([',', ')']).and_then(|at| part.get(at..));
        out.push_str(rest.unwrap_or_default());
    }
    out
}

pub(super) fn wrong_arity(callee: &Name, given: usize, expected: &str, usage: &str) -> Diagnostic {
    let plural = if expected == "1" { "" } else { "s" };
    Diagnostic::error(
        "wrong-arity",
        callee.span,
        format!(
            "{} takes {expected} argument{plural}, not {given}",
            quoted(&callee.text)
        ),
    )
    .with_label(format!("called with {given}"))
    .with_hint(format!("it is written {usage}"))
}

/// For a builtin: what it expects where `given` is wrong, and how it is written.
pub(super) fn builtin_arity(name: &str, given: usize) -> Option<(Option<String>, String)> {
    if let Some(builtin) = builtins::by_name(name) {
        let expected = (!builtin.arity.contains(&given)).then(|| {
            let (lo, hi) = (builtin.arity.start(), builtin.arity.end());
            if lo == hi {
                lo.to_string()
            } else {
                format!("{lo} to {hi}")
            }
        });
        return Some((expected, listed(&[builtin.usage])));
    }
    let row = table::by_name(name);
    let definitions = library::by_name(name).filter(|_| !library::is_private(name));
    let definitions = definitions.unwrap_or_default();
    let mut usages: Vec<&str> = definitions.iter().map(|f| f.usage.as_str()).collect();
    let mut arities: Vec<usize> = definitions.iter().map(|f| f.types.len()).collect();
    if let Some(row) = row {
        let variadic = matches!(row.prim, crate::ir::Prim::Min | crate::ir::Prim::Max);
        let arity = row.typing.arity();
        arities.push(if variadic { given.max(arity) } else { arity });
        usages.push(row.usage);
    }
    if usages.is_empty() {
        return None;
    }
    arities.sort_unstable();
    arities.dedup();
    // where the number is wrong, the types only make the list longer
    let plain: Vec<String> = usages.iter().map(|usage| without_types(usage)).collect();
    let mut plain: Vec<&str> = plain.iter().map(String::as_str).collect();
    if arities.len() > 1 {
        plain.dedup_by_key(|usage| usage.matches(',').count());
        usages = plain;
    }
    let expected = (!arities.contains(&given)).then(|| {
        let counts: Vec<String> = arities.iter().map(usize::to_string).collect();
        listed(&counts).replace('`', "")
    });
    Some((expected, listed(&usages)))
}
