//! A shader for one set of settings.
//!
//! A scene's module reads its settings from a uniform, so that changing one compiles nothing. For a picture whose settings
//! stay what they are, this makes another module of it in which they are constants: conditions on them are decided, what they
//! rule out is left out, and functions that every call gives the same argument, or that always return the same, are seen
//! through. It is partial evaluation (Jones, Gomard and Sestoft, Partial Evaluation and Automatic Program Generation, 1993)
//! of naga's functions, without unrolling loops: constants are propagated along the ways that control can take (Wegman and
//! Zadeck, "Constant propagation with conditional branches", 1991), callers before callees.

mod calls;
mod expressions;
mod fold;
mod function;
mod functions;
mod known;
mod operands;
mod pools;
mod stores;

use naga::{Function, Handle, Module};

use calls::Calls;
use function::{Fixed, Rewriter};
use operands::is_foreseen;
use pools::Pools;

/// Rounds after which results of functions are no longer followed: each looks one call further up.
const MAX_ROUNDS: usize = 24;

/// What a uniform holds: its name, and its words, `None` for those that may change.
pub type Words<'a> = (&'a str, &'a [Option<u32>]);

/// Makes words of uniforms constants of the module. A module with a construct that no shader of ours has stays as it is.
pub fn specialise(module: &mut Module, uniforms: &[Words<'_>]) {
    let fixed: Vec<Fixed> = module
        .global_variables
        .iter()
        .filter_map(|(global, variable)| {
            let name = variable.name.as_deref()?;
            let &(_, words) = uniforms.iter().find(|(known, _)| *known == name)?;
            let ty = variable.ty;
            Some(Fixed { global, ty, words })
        })
        .collect();
    if !is_known_throughout(module) {
        return;
    }
    let mut specialised = module.clone();
    let mut calls = Calls::default();
    for _ in 0..MAX_ROUNDS {
        match round(&mut specialised, &fixed, &mut calls) {
            Some(true) => calls.forget_arguments(),
            Some(false) => break,
            None => return,
        }
    }
    *module = specialised;
}

fn is_known_throughout(module: &Module) -> bool {
    let functions = module.functions.iter().map(|(_, f)| f);
    let entries = module.entry_points.iter().map(|entry| &entry.function);
    functions
        .chain(entries)
        .all(|f| f.expressions.iter().all(|(_, e)| is_foreseen(e)))
}

/// Makes all functions anew, callers before callees; whether there is something new to follow, or `None` for a construct that
/// is not foreseen.
fn round(module: &mut Module, fixed: &[Fixed], calls: &mut Calls) -> Option<bool> {
    let mut functions = std::mem::take(&mut module.functions);
    let mut entries = std::mem::take(&mut module.entry_points);
    let all = functions.clone();
    let mut pools = Pools::new(module);
    let mut news = false;
    for entry in &mut entries {
        let unknown = vec![None; entry.function.arguments.len()];
        let rewriter = Rewriter::new(&entry.function, unknown, fixed, &mut pools, calls, &all);
        entry.function = rewriter.run().ok()?.0;
    }
    // callees come before their callers in a module
    let order: Vec<Handle<Function>> = functions.iter().map(|(handle, _)| handle).rev().collect();
    for handle in order {
        // one that nothing calls any more is left out later
        let Some(arguments) = calls.arguments(handle) else {
            continue;
        };
        let old = functions[handle].clone();
        let rewriter = Rewriter::new(&old, arguments, fixed, &mut pools, calls, &all);
        let (made, value) = rewriter.run().ok()?;
        functions[handle] = made;
        if let Some(value) = value {
            news |= calls.returns(handle, value);
        }
    }
    module.functions = functions;
    module.entry_points = entries;
    Some(news)
}
