//! What a traced program shows of its run.

use naga::{Expression, Function, Handle};

use super::code::Form;
use super::lanes::Slot;

/// A place in a module whose value is shown.
#[derive(Clone, Debug)]
pub struct Site {
    /// The function; none for the entry point.
    pub function: Option<Handle<Function>>,
    /// The function's name.
    pub function_name: String,
    /// What is there.
    pub kind: SiteKind,
    /// The name of the value, where it has one.
    pub name: Option<String>,
    pub(super) parts: Vec<Slot>,
    pub(super) forms: Vec<Form>,
}

/// What is at a site.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SiteKind {
    /// An expression is evaluated.
    Expression(Handle<Expression>),
    /// A variable, or a part of it, is written; the expression is the pointer.
    Store(Handle<Expression>),
    /// The function begins; the values are its arguments.
    Enter,
    /// The function ends; the values are its results.
    Leave,
}

/// A number that is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shown {
    /// A floating-point number.
    Real(f64),
    /// An integer.
    Integer(i128),
    /// A truth value.
    Truth(bool),
}

/// Something that was computed.
#[derive(Clone, Debug)]
pub struct Event<'a> {
    /// Where.
    pub site: &'a Site,
    /// The components of the value.
    pub values: &'a [Shown],
}

fn shown(word: u64, form: Form) -> Shown {
    match form {
        Form::Bool => Shown::Truth(word != 0),
        Form::I32 => Shown::Integer((word as u32).cast_signed().into()),
        Form::U32 => Shown::Integer((word as u32).into()),
        Form::I64 => Shown::Integer(word.cast_signed().into()),
        Form::U64 => Shown::Integer(word.into()),
        Form::F32 => Shown::Real(f32::from_bits(word as u32).into()),
        Form::F64 => Shown::Real(f64::from_bits(word)),
    }
}

impl Site {
    /// What the words of its components mean.
    pub(super) fn shown(&self, words: impl Iterator<Item = u64>) -> impl Iterator<Item = Shown> {
        words
            .zip(&self.forms)
            .map(|(word, &form)| shown(word, form))
    }
}

/// Sees what a traced program computes, in order.
pub trait Observer {
    /// A lane computed something.
    fn event(&mut self, lane: usize, event: &Event);
}

/// Sees nothing.
impl Observer for () {
    fn event(&mut self, _: usize, _: &Event) {}
}

impl<F: FnMut(usize, &Event)> Observer for F {
    fn event(&mut self, lane: usize, event: &Event) {
        self(lane, event);
    }
}
