//! What is emitted: valid in every shading language, with the user's names, and only what is asked for.

mod bytes;
mod chromium;
mod demand;
mod generated;
mod godot;
mod jobs;
mod languages;
mod names;
mod plane;
mod readable;
mod same;
mod three;
mod validators;
mod values;

use naga::Module;
use naga::valid::{Capabilities, ValidationFlags, Validator};
use pullback_compiler::lower::Precision;
use pullback_compiler::{EmitWhat, Program, Target, compile};
use pullback_grammar::render;

fn program(name: &str, text: &str) -> Program {
    let answer = compile(text);
    answer
        .program
        .unwrap_or_else(|| panic!("{name}\n{}", render(&answer.diagnostics, name, text, false)))
}

fn validate(name: &str, module: &Module, capabilities: Capabilities) {
    if let Err(error) = Validator::new(ValidationFlags::all(), capabilities).validate(module) {
        panic!("{name}: {error:?}");
    }
}

fn emit(
    name: &str,
    program: &Program,
    what: EmitWhat,
    target: Target,
    precision: Precision,
) -> Vec<u8> {
    program
        .emit(0, what, target, precision)
        .unwrap_or_else(|problems| panic!("{name}: {what:?} in {}: {problems:?}", target.name()))
}

/// Names of the functions of a module.
fn function_names(module: &Module) -> Vec<String> {
    module
        .functions
        .iter()
        .filter_map(|(_, f)| f.name.clone())
        .collect()
}

/// Number of expressions of a function.
fn size(module: &Module, name: &str) -> usize {
    let found = module
        .functions
        .iter()
        .find(|(_, f)| f.name.as_deref() == Some(name));
    found
        .unwrap_or_else(|| panic!("no `{name}` in {:?}", function_names(module)))
        .1
        .expressions
        .len()
}
