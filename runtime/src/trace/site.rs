//! Places in a shader that tell what they compute, and what they tell.

use pullback_grammar::Span;

/// What sort of number a site tells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// This many single-precision numbers, 1 to 4.
    Single(u8),
    /// The unevaluated sum of two single-precision numbers.
    Pair,
    /// A double-precision number.
    Double,
    /// An unsigned integer.
    Word,
    /// A signed integer.
    Integer,
    /// A truth value.
    Truth,
}

impl Shape {
    /// Words of an event.
    pub(super) fn words(self) -> usize {
        match self {
            Self::Single(count) => count.into(),
            Self::Pair | Self::Double => 2,
            Self::Word | Self::Integer | Self::Truth => 1,
        }
    }

    /// The value of numbers as they are told: of a pair, the sum.
    pub(super) fn value(self, numbers: &[f64]) -> Value {
        match (self, numbers) {
            (Self::Pair, &[high, low]) => Value::new(&[sum(high, low)]),
            _ => Value::new(numbers),
        }
    }

    /// The function that records it.
    pub(super) fn recorder(self) -> &'static str {
        match self {
            Self::Single(1) => "record_real",
            Self::Single(2) | Self::Pair => "record_vec2",
            Self::Single(3) => "record_vec3",
            Self::Single(_) => "record_vec4",
            Self::Double => "record_double",
            Self::Word => "record_word",
            Self::Integer => "record_integer",
            Self::Truth => "record_truth",
        }
    }
}

/// What is told at a site.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum What {
    /// An argument, when its function is entered.
    Argument,
    /// A value that has a name.
    Named,
    /// The result of an operation that has no name.
    Operation,
    /// What is stored in a variable.
    Variable,
    /// What decides where the shader goes on.
    Condition,
    /// What a function returns.
    Result,
}

/// A place in a shader that tells what it computes.
#[derive(Clone, Debug, PartialEq)]
pub struct Site {
    /// The function that it is in.
    pub function: String,
    /// What is told.
    pub what: What,
    /// The name of the value; empty for operations.
    pub name: String,
    /// The operation, in the terms of the shader.
    pub text: String,
    /// The part of the user's text that it computes, or the derivative of which it computes.
    pub span: Option<Span>,
    /// What sort of number.
    pub shape: Shape,
    /// What it is computed from, as far as that is told.
    pub(super) operands: Vec<Operand>,
    /// Where it is one of two values by a condition, which is the first operand.
    pub(super) choice: Option<Choice>,
    /// Whether it is the result of one operation, with all its operands known, which all count.
    pub(super) is_operation: bool,
}

/// Where the operands begin of which a choice takes one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Choice {
    /// Of the value where the condition holds.
    pub(super) accept: usize,
    /// Of the value where it does not; up to the end.
    pub(super) reject: usize,
}

/// Where an operand is known from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Operand {
    /// It is a constant.
    Number(f64),
    /// The latest event of another site, or a component of it.
    Site(usize, Option<u8>),
}

/// Up to four numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Value {
    numbers: [f64; 4],
    count: u8,
}

impl Value {
    /// At most the first four of these.
    #[must_use]
    pub fn new(all: &[f64]) -> Self {
        let mut numbers = [0.0; 4];
        let count = all.len().min(4);
        numbers[..count].copy_from_slice(&all[..count]);
        Self {
            numbers,
            count: count as u8,
        }
    }

    /// The numbers.
    #[must_use]
    pub fn numbers(&self) -> &[f64] {
        &self.numbers[..usize::from(self.count)]
    }

    /// Whether none is NaN or infinite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.numbers().iter().all(|x| x.is_finite())
    }
}

/// One value that was computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Event {
    /// Index of its site.
    pub site: usize,
    /// What it was.
    pub value: Value,
}

/// All that one invocation of a shader computed, in order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trace {
    /// In order.
    pub events: Vec<Event>,
    /// Whether there was no room for what came after them.
    pub is_cut: bool,
}

impl Trace {
    /// Reads the words that [a traced shader](super::Traced) wrote, of which there is room for so many.
    pub(super) fn read(sites: &[Site], words: &[u32], room: usize) -> Self {
        let mut trace = Self {
            events: Vec::new(),
            is_cut: words.get(room).is_some_and(|&word| word != 0),
        };
        let mut rest = words.get(..room).unwrap_or(words);
        while let &[number, ref following @ ..] = rest {
            let Some(index) = (number as usize).checked_sub(1) else {
                break;
            };
            let site = sites.get(index);
            let Some((site, words)) =
                site.and_then(|site| Some((site, following.get(..site.shape.words())?)))
            else {
                break;
            };
            trace.events.push(Event {
                site: index,
                value: decode(site.shape, words),
            });
            rest = &following[words.len()..];
        }
        trace
    }
}

fn decode(shape: Shape, words: &[u32]) -> Value {
    let mut numbers = [0.0; 4];
    let count = match (shape, words) {
        (Shape::Single(_) | Shape::Pair, _) => {
            for (number, &word) in numbers.iter_mut().zip(words) {
                *number = f64::from(f32::from_bits(word));
            }
            words.len().min(4)
        }
        (Shape::Double, &[low, high]) => {
            numbers[0] = f64::from_bits(u64::from(high) << 32 | u64::from(low));
            1
        }
        (Shape::Integer, &[word]) => {
            numbers[0] = f64::from(word.cast_signed());
            1
        }
        _ => {
            numbers[0] = f64::from(words.first().copied().unwrap_or(0));
            1
        }
    };
    shape.value(&numbers[..count])
}

/// Of a pair. One that is not finite has its value in the first part.
fn sum(high: f64, low: f64) -> f64 {
    if high.is_finite() { high + low } else { high }
}
