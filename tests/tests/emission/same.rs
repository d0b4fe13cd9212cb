//! What is printed as WGSL is the module that was built: parsed again, it does the same.

use std::collections::HashMap;

use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{Function, Handle, Module};
use pullback_compiler::emit::print::{Dialect, print};
use pullback_compiler::emit::restore_operators;
use pullback_compiler::lower::Precision;
use pullback_compiler::{Emission, EmitWhat, ParamsAs, Program, Target};
use pullback_tests::corpus::gallery;
use pullback_tests::same_module::{Side, Values, trace};

use crate::program;

/// Prints a module, parses the text, and compares function by function.
pub fn check_module(name: &str, module: &Module) -> Result<(), String> {
    let validate = |module: &Module| {
        Validator::new(ValidationFlags::all(), Capabilities::default())
            .validate(module)
            .map_err(|e| format!("{e:?}"))
    };
    let info = validate(module)?;
    let wanted: Vec<Handle<Function>> = module.functions.iter().map(|(h, _)| h).collect();
    let printed = print(module, &info, Dialect::Wgsl, &wanted)?;
    let text = printed.text();
    if let Some(long) = text.lines().find(|l| l.chars().count() > 100) {
        return Err(format!("a long line: {long}"));
    }
    let mut parsed = naga::front::wgsl::parse_str(&text)
        .map_err(|e| format!("{}\n{text}", e.emit_to_string(&text)))?;
    restore_operators(&mut parsed);
    let parsed_info = validate(&parsed).map_err(|e| format!("{e}\n{text}"))?;
    let names: HashMap<Handle<Function>, String> = printed
        .functions
        .iter()
        .map(|f| (f.handle, f.name.clone()))
        .collect();
    let own = Side {
        module,
        info: &info,
        name: &|h| names[&h].clone(),
    };
    let read = Side {
        module: &parsed,
        info: &parsed_info,
        name: &|h| parsed.functions[h].name.clone().unwrap_or_default(),
    };
    let mut values = Values::default();
    for function in &printed.functions {
        let found = parsed
            .functions
            .iter()
            .find(|(_, f)| f.name.as_deref() == Some(&function.name));
        let (handle, _) = found.ok_or_else(|| format!("no `{}`", function.name))?;
        let before = trace(&own, function.handle, &mut values);
        let after = trace(&read, handle, &mut values);
        if before != after {
            let at = before.iter().zip(&after).position(|(a, b)| a != b);
            let at = at.unwrap_or(before.len().min(after.len()));
            return Err(format!(
                "{name}: `{}` differs in line {at}: {:?} and {:?}\n{}\n{before:#?}\n{after:#?}",
                function.name,
                before.get(at),
                after.get(at),
                function.text,
            ));
        }
    }
    Ok(())
}

/// Everything that a program has, in one module.
fn check_program(name: &str, program: &Program, precision: Precision) {
    let mut whole: Option<Emission> = None;
    for what in EmitWhat::ALL {
        let alone = Emission::new(what, Target::Wgsl).precision(precision);
        // what is made of the integral is one function more
        let skipped = [EmitWhat::Scene, EmitWhat::Transmittance, EmitWhat::Opacity];
        if !skipped.contains(&what) && program.emitted_module(&alone).is_ok() {
            whole = Some(whole.map_or(alone, |w| w.and(what)));
        }
    }
    let whole = whole.unwrap_or_else(|| panic!("{name}: nothing can be emitted"));
    let params = if program.params().is_empty() {
        ParamsAs::Arguments
    } else {
        ParamsAs::Uniform
    };
    let module = program
        .emitted_module(&whole.params(params))
        .unwrap_or_else(|e| panic!("{name}: {e:?}"));
    check_module(name, &module).unwrap_or_else(|e| panic!("{name}: {e}"));
}

#[test]
fn the_gallery_reads_back() {
    for source in gallery() {
        let program = program(&source.name, &source.text);
        check_program(&source.name, &program, Precision::Accurate);
    }
}

#[test]
fn the_gallery_in_pairs_and_with_built_ins_reads_back() {
    for source in gallery().iter().step_by(6) {
        let program = program(&source.name, &source.text);
        check_program(&source.name, &program, Precision::Fast);
        let emission = Emission::new(EmitWhat::Value, Target::Wgsl).precision(Precision::Extended);
        let module = program.emitted_module(&emission).expect("a value");
        check_module(&source.name, &module).unwrap_or_else(|e| panic!("{}: {e}", source.name));
    }
}
