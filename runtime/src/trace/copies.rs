//! How often each function stands in a shader whose calls have all been replaced by what they call.

use naga::{Block, Function, Handle, Module, Statement};
use rustc_hash::FxHashMap;

/// Number of copies of each function, by name; those of one name are added up.
pub(super) fn copies(module: &Module) -> FxHashMap<&str, u64> {
    let mut counts: FxHashMap<Handle<Function>, u64> = FxHashMap::default();
    // of entry points that reach the same functions one is looked at
    if let Some(entry) = module
        .entry_points
        .iter()
        .find(|entry| entry.stage == naga::ShaderStage::Compute)
    {
        for callee in calls(&entry.function.body) {
            *counts.entry(callee).or_default() += 1;
        }
    }
    // callees precede their callers
    let all: Vec<_> = module.functions.iter().collect();
    for &(caller, function) in all.iter().rev() {
        let Some(&count) = counts.get(&caller) else {
            continue;
        };
        for callee in calls(&function.body) {
            let slot = counts.entry(callee).or_default();
            *slot = slot.saturating_add(count);
        }
    }
    let mut by_name = FxHashMap::default();
    for (handle, function) in all {
        let count = counts.get(&handle).copied().unwrap_or(0);
        *by_name
            .entry(function.name.as_deref().unwrap_or_default())
            .or_default() += count;
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
