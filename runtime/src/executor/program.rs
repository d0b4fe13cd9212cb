//! A program: what a module's function is translated to.

use naga::valid::ModuleInfo;
use naga::{Function, Handle, Module};
use pullback_compiler::lower::Format;

use super::Arithmetic;
use super::code::{Form, Indexed, Inst};
use super::fault::{Fault, LoopSite};
use super::lanes::{CHUNKS, Slot};
use super::library::LibraryCall;
use super::trace::Site;
use super::translate;

/// One number of a uniform, of the arguments or of the results.
#[derive(Clone, Debug, PartialEq)]
pub struct Component {
    /// The names on the way to it, such as `view.center`; of arguments, the argument's.
    pub path: String,
    /// Which number of those that the path leads to.
    pub index: usize,
    pub(super) slot: Slot,
    pub(super) form: Form,
}

impl Component {
    /// The word of a number; integers are cut off.
    #[must_use]
    pub fn encode(&self, value: f64) -> u64 {
        encode(self.form, value)
    }

    /// The number of a word; truth values are 0 and 1.
    #[must_use]
    pub fn decode(&self, word: u64) -> f64 {
        decode(self.form, word)
    }
}

fn encode(form: Form, value: f64) -> u64 {
    super::integer::convert(value.to_bits(), Form::F64, form)
}

fn decode(form: Form, word: u64) -> f64 {
    f64::from_bits(super::integer::convert(word, form, Form::F64))
}

/// A storage buffer whose length the host decides.
#[derive(Clone, Debug, PartialEq)]
pub struct Buffer {
    /// The variable's name.
    pub name: String,
    /// Components of an element.
    pub stride: usize,
    pub(super) form: Form,
}

impl Buffer {
    /// The word of a number.
    #[must_use]
    pub fn encode(&self, value: f64) -> u64 {
        encode(self.form, value)
    }

    /// The number of a word.
    #[must_use]
    pub fn decode(&self, word: u64) -> f64 {
        decode(self.form, word)
    }
}

/// What is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start<'a> {
    /// An entry point by its name.
    EntryPoint(&'a str),
    /// A function by its name; its arguments and its result are those of each lane.
    Function(&'a str),
}

/// How a module is translated.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// What numbers are computed with.
    pub arithmetic: Arithmetic,
    /// Whether products are fused with sums, as drivers do.
    pub contraction: Contraction,
    /// How the module holds the formula's numbers.
    pub format: Format,
    /// What an observer is to see.
    pub watched: Watched,
}

/// What becomes of a sum with a product, which WGSL lets a driver fuse: a product that nothing else needs and that stands in the
/// sum itself.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Contraction {
    /// Every operation is rounded.
    #[default]
    None,
    /// The product is not rounded; of two, the left one.
    Left,
    /// The product is not rounded; of two, the right one.
    Right,
}

/// What of a run an observer sees.
#[derive(Clone, Copy, Debug)]
pub enum Watched {
    /// Nothing.
    Nothing,
    /// That functions are entered whose names this tells, with their arguments.
    Entries(fn(&str) -> bool),
    /// Everything that is computed.
    Everything,
}

impl Watched {
    pub(super) fn is_everything(self) -> bool {
        matches!(self, Self::Everything)
    }

    /// Whether the beginning of a function is seen.
    pub(super) fn sees_entry(self, name: Option<&str>) -> bool {
        match self {
            Self::Nothing => false,
            Self::Entries(is_seen) => name.is_some_and(is_seen),
            Self::Everything => true,
        }
    }
}

/// A function of a module with all that it calls, translated once and run by any number of machines.
#[derive(Debug)]
pub struct Program {
    pub(super) code: Vec<Inst>,
    pub(super) uniforms: Vec<u64>,
    pub(super) registers: usize,
    pub(super) indices: Vec<Indexed>,
    pub(super) library: Vec<LibraryCall>,
    pub(super) sites: Vec<Site>,
    pub(super) loops: Vec<LoopSite>,
    /// For each instruction, whose text it comes from: a place in `names`.
    pub(super) owners: Vec<u32>,
    /// Functions; the first is the one that is run.
    pub(super) names: Vec<String>,
    /// The numbers of the uniform variables, and of storage of fixed size that is only read.
    pub inputs: Vec<Component>,
    /// The other storage buffers.
    pub buffers: Vec<Buffer>,
    /// What each lane takes.
    pub arguments: Vec<Component>,
    /// What each lane gives.
    pub results: Vec<Component>,
}

impl Program {
    /// Translates a validated module.
    ///
    /// # Errors
    /// [`Fault::Missing`], and [`Fault::Unsupported`] for what none of our modules has.
    pub fn new(
        module: &Module,
        info: &ModuleInfo,
        start: Start,
        options: Options,
    ) -> Result<Self, Fault> {
        translate::program(module, info, start, options)
    }

    /// Chunks of memory that a machine needs.
    pub(super) fn chunks(&self) -> usize {
        // behind the last uniform there is a whole row, too
        self.uniforms.len() + (self.registers + 1) * CHUNKS
    }

    /// Instructions of all functions.
    #[must_use]
    pub fn instructions(&self) -> usize {
        self.code.len()
    }

    /// The place of a buffer among the machine's buffers.
    #[must_use]
    pub fn buffer(&self, name: &str) -> Option<usize> {
        self.buffers.iter().position(|buffer| buffer.name == name)
    }
}

/// A function that can be started.
#[derive(Clone, Copy, Debug)]
pub(super) struct Started<'m> {
    pub function: &'m Function,
    pub handle: Option<Handle<Function>>,
}

/// Finds what is to be run.
pub(super) fn started<'m>(module: &'m Module, start: Start) -> Result<(Started<'m>, usize), Fault> {
    match start {
        Start::EntryPoint(name) => {
            let found = module.entry_points.iter().position(|e| e.name == name);
            let place = found.ok_or_else(|| Fault::Missing(name.to_owned()))?;
            let function = &module.entry_points[place].function;
            let handle = None;
            Ok((Started { function, handle }, place))
        }
        Start::Function(name) => {
            let mut functions = module.functions.iter();
            let found = functions.find(|(_, f)| f.name.as_deref() == Some(name));
            let (handle, function) = found.ok_or_else(|| Fault::Missing(name.to_owned()))?;
            let handle = Some(handle);
            Ok((Started { function, handle }, 0))
        }
    }
}
