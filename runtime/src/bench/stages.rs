//! From a text to what a driver is given, each stage by itself.

use std::hint::black_box;
use std::time::Instant;

use naga::back::spv;
use pullback_compiler::check::is_builtin_function;
use pullback_compiler::lower::Tier;
use pullback_compiler::{SettingValue, compile};
use pullback_grammar::parse;

use crate::Error;

/// The stages in their order. `check` is the whole front end without `parse`: names, types and formulas.
pub const STAGES: [&str; 5] = ["parse", "check", "module", "settings", "spirv"];

/// Seconds that each of [`STAGES`] takes for the first picture of a program.
///
/// # Errors
/// [`Error::Invalid`] if the program has errors, or the compiler makes what naga refuses.
pub fn stages(text: &str, settings: &[SettingValue], tier: Tier) -> Result<[f64; 5], Error> {
    let invalid = |reason: String| Error::Invalid { reason };
    let start = Instant::now();
    black_box(parse(black_box(text), &is_builtin_function));
    let parsed = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let compiled = compile(black_box(text));
    let both = start.elapsed().as_secs_f64();
    let program = compiled
        .program
        .ok_or_else(|| invalid("the program has errors".to_owned()))?;
    let start = Instant::now();
    let scene = program
        .scene_module_with(0, settings, tier)
        .map_err(|found| invalid(found.first().map_or(String::new(), |d| d.message.clone())))?;
    let module = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let made = scene
        .specialised(settings, 1)
        .map_err(|error| invalid(format!("{error:?}")))?;
    let specialised = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let options = spv::Options::default();
    let words = spv::write_vec(&made.module, &made.info, &options, None);
    black_box(words.map_err(|error| invalid(error.to_string()))?);
    let written = start.elapsed().as_secs_f64();
    Ok([
        parsed,
        (both - parsed).max(0.0),
        module,
        specialised,
        written,
    ])
}
