//! The functions that a traced shader calls with its values, and how they come into it.

use naga::{Function, Handle, Module};
use pullback_compiler::link::{Linker, Provider, number_module};
use pullback_compiler::lower::{Format, LowerError, Tier};
use rustc_hash::FxHashMap;

use super::inputs::ROOM;
use super::site::Shape;
use crate::Error;

/// Recorders that write to the buffer at binding 6.
const WRITING: &str = include_str!("record.wgsl");
const WRITING_DOUBLES: &str = include_str!("record_double.wgsl");
/// Recorders that do nothing.
const SILENT: &str = include_str!("silent.wgsl");
const SILENT_DOUBLES: &str = "alias real = f64; fn record_double(site: u32, value: real) {}\n";

/// What the functions do that a traced shader calls with its values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Recorders {
    /// They write to the buffer at binding 6.
    Writing,
    /// Nothing: the machine sees the calls by itself.
    Silent,
}

impl Recorders {
    /// Their text, in WGSL.
    pub(super) fn text(self, tier: Tier) -> String {
        let mut text = match self {
            Self::Writing => format!("const TRACE_WORDS: u32 = {ROOM}u;\n{WRITING}"),
            Self::Silent => SILENT.to_owned(),
        };
        if tier.precision.format() == Format::Double {
            text += match self {
                Self::Writing => WRITING_DOUBLES,
                Self::Silent => SILENT_DOUBLES,
            };
        }
        text
    }

    /// Whether a function has the name of a recorder.
    pub(super) fn is_name(name: &str) -> bool {
        RECORDED.iter().any(|shape| shape.recorder() == name)
    }
}

/// What there are recorders for.
const RECORDED: [Shape; 8] = [
    Shape::Single(1),
    Shape::Single(2),
    Shape::Single(3),
    Shape::Single(4),
    Shape::Word,
    Shape::Integer,
    Shape::Truth,
    Shape::Double,
];

/// Whose entry points a traced shader has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Entry {
    /// Those of the module.
    Module,
    /// Those that stand beside the recorders, which call functions of the module.
    Recorders,
}

/// Recorders in a module, by their names.
pub(super) type Handles = FxHashMap<&'static str, Handle<Function>>;

/// Nothing is generated where finished modules are joined.
struct Finished;

impl Provider for Finished {
    fn provide(
        &mut self,
        _: &str,
        _: &Function,
        _: &mut Linker,
    ) -> Result<Option<Function>, LowerError> {
        Ok(None)
    }
}

/// The module with the recorders in front of its functions.
pub(super) fn joined(
    module: &Module,
    text: &str,
    entry: Entry,
    tier: Tier,
) -> Result<(Module, Handles), Error> {
    let texts = naga::front::wgsl::parse_str(text);
    let texts = texts.map_err(|error| broken(&error.emit_to_string(text)))?;
    // in the order of `Entry`; the library has what the recorders need
    let mut linker = Linker::new(vec![module, &texts, number_module(tier)]);
    let mut found = Handles::default();
    for name in RECORDED.map(Shape::recorder) {
        let is_there = |(_, f): (_, &Function)| f.name.as_deref() == Some(name);
        if texts.functions.iter().any(is_there) {
            let handle = linker.function(name, &mut Finished);
            let handle = handle.map_err(|error| broken(&format!("{error:?}")))?;
            found.insert(name, handle);
        }
    }
    linker
        .link_entry_points(entry as usize, &mut Finished)
        .map_err(|error| broken(&format!("{error:?}")))?;
    Ok((linker.out, found))
}

pub(super) fn broken(reason: &str) -> Error {
    Error::Invalid {
        reason: format!("the shader cannot be traced: {reason}"),
    }
}
