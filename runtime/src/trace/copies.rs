//! How often, and how deep, each function stands in a shader whose calls have all been replaced by what they call.

use naga::{Block, Function, Handle, Module, Statement};
use rustc_hash::FxHashMap;

/// Where a function stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Standing {
    /// Number of copies of it.
    pub(super) copies: u64,
    /// Calls from the entry point to it, at the least.
    pub(super) depth: u32,
}

/// Where each function stands, by name; copies of those of one name are added up.
pub(super) fn standings(module: &Module) -> FxHashMap<&str, Standing> {
    let mut found: FxHashMap<Handle<Function>, Standing> = FxHashMap::default();
    let add = |found: &mut FxHashMap<_, Standing>, callee, copies: u64, depth: u32| {
        let slot = found.entry(callee).or_insert(Standing { copies: 0, depth });
        slot.copies = slot.copies.saturating_add(copies);
        slot.depth = slot.depth.min(depth);
    };
    // entry points reach the same functions
    let mut entries = module.entry_points.iter();
    if let Some(entry) = entries.find(|entry| entry.stage == naga::ShaderStage::Compute) {
        for callee in calls(&entry.function.body) {
            add(&mut found, callee, 1, 1);
        }
    }
    // callees precede their callers
    let all: Vec<_> = module.functions.iter().collect();
    for &(caller, function) in all.iter().rev() {
        let Some(&Standing { copies, depth }) = found.get(&caller) else {
            continue;
        };
        for callee in calls(&function.body) {
            add(&mut found, callee, copies, depth + 1);
        }
    }
    let mut by_name: FxHashMap<&str, Standing> = FxHashMap::default();
    for (handle, function) in all {
        let Some(&standing) = found.get(&handle) else {
            continue;
        };
        let name = function.name.as_deref().unwrap_or_default();
        let slot = by_name.entry(name).or_insert(Standing {
            copies: 0,
            ..standing
        });
        slot.copies = slot.copies.saturating_add(standing.copies);
        slot.depth = slot.depth.min(standing.depth);
    }
    by_name
}

/// The callee of each call in a block.
fn calls(block: &Block) -> Vec<Handle<Function>> {
    let mut found = Vec::new();
    let mut stack = vec![block];
    while let Some(block) = stack.pop() {
        for statement in block {
            match statement {
                Statement::Call { function, .. } => found.push(*function),
                Statement::Block(inner) => stack.push(inner),
                Statement::If { accept, reject, .. } => stack.extend([accept, reject]),
                Statement::Switch { cases, .. } => stack.extend(cases.iter().map(|c| &c.body)),
                Statement::Loop {
                    body, continuing, ..
                } => stack.extend([body, continuing]),
                _ => {}
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn copies_multiply_along_calls() {
        let text = "fn a() {} fn b() { a(); a(); } fn c() { b(); a(); }
                    @compute @workgroup_size(1) fn main() { c(); c(); b(); } fn unused() { c(); }";
        let module = naga::front::wgsl::parse_str(text).unwrap();
        let found = standings(&module);
        let standing = |copies, depth| Some(Standing { copies, depth });
        assert_eq!(found.get("c").copied(), standing(2, 1));
        assert_eq!(found.get("b").copied(), standing(3, 1));
        assert_eq!(found.get("a").copied(), standing(8, 2));
        assert_eq!(found.get("unused"), None);
    }
}
