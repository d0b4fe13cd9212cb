//! Keeping the user's names in emitted text.

use naga::{Function, Handle, Module};
use rustc_hash::{FxHashMap, FxHashSet};

/// Writers make every name unique in the whole module, in the order of the functions, so a library function that
/// comes first would take a user's name away. This gives the library's names a suffix where they collide with those
/// of the generated functions.
pub fn keep_names(module: &mut Module, generated: &[String]) {
    // a library function may have the name that the user gave; the generated function comes later
    let mut ours: FxHashMap<&str, Handle<Function>> = FxHashMap::default();
    let mut taken: FxHashSet<String> = FxHashSet::default();
    for (handle, function) in module.functions.iter() {
        if let Some(name) = generated.iter().find(|g| function.name.as_ref() == Some(g)) {
            ours.insert(name, handle);
        }
    }
    let ours: FxHashSet<Handle<Function>> = ours.into_values().collect();
    for &handle in &ours {
        let function = &module.functions[handle];
        taken.extend(function.name.clone());
        taken.extend(function.arguments.iter().filter_map(|a| a.name.clone()));
        taken.extend(function.named_expressions.values().cloned());
        let locals = function.local_variables.iter();
        taken.extend(locals.filter_map(|(_, local)| local.name.clone()));
    }
    for (handle, function) in module.functions.iter_mut() {
        if !ours.contains(&handle) {
            function.name = function.name.take().map(|n| free(n, &taken));
            rename_locals(function, &taken);
        }
    }
    for entry in &mut module.entry_points {
        rename_locals(&mut entry.function, &taken);
    }
}

fn rename_locals(function: &mut Function, taken: &FxHashSet<String>) {
    let fresh = |name: String| free(name, taken);
    for argument in &mut function.arguments {
        argument.name = argument.name.take().map(fresh);
    }
    for (_, local) in function.local_variables.iter_mut() {
        local.name = local.name.take().map(fresh);
    }
    for name in function.named_expressions.values_mut() {
        *name = fresh(std::mem::take(name));
    }
}

fn free(name: String, taken: &FxHashSet<String>) -> String {
    if taken.contains(&name) {
        format!("{name}_lib")
    } else {
        name
    }
}
