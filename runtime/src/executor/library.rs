//! Functions of the shader library by what they mean: in `f64`, as the operator table defines them.

use naga::{Function, TypeInner, UniqueArena};
use pullback_compiler::lower::Format;
use pullback_compiler::reference::complex::{Complex, complex};
use pullback_compiler::table::{Direct, Meaning, Number, meaning};

use super::kernels::{Lanes, each_lane, write};
use super::lanes::{Slot, TRUE};

/// What stands in for a function of the shader library.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Stand {
    /// A function that lowering calls.
    Number(Meaning),
    /// Whether a number is NaN.
    IsNan,
    /// Whether a number is infinite.
    IsInfinite,
    /// Whether a number is neither.
    IsFinite,
    /// x · 2⁶⁴
    MagnifyTiny,
}

/// What stands in for a function. Those of the drawing library that take bits apart do so to tell or to magnify numbers,
/// and are given by their meaning, too.
pub(super) fn stand(function: &Function, types: &UniqueArena<naga::Type>) -> Option<Stand> {
    let name = function.name.as_deref()?;
    if let Some(meaning) = meaning(name) {
        return Some(Stand::Number(meaning));
    }
    let takes_scalar = matches!(
        function.arguments.as_slice(),
        [argument] if matches!(types[argument.ty].inner, TypeInner::Scalar(_))
    );
    match name {
        _ if !takes_scalar => None,
        "is_nan" => Some(Stand::IsNan),
        "is_inf" | "is_infinite" => Some(Stand::IsInfinite),
        "is_finite" => Some(Stand::IsFinite),
        "magnify_tiny" => Some(Stand::MagnifyTiny),
        _ => None,
    }
}

/// An operand of a library function.
#[derive(Clone, Debug)]
pub(super) enum Operand {
    Real(Vec<Slot>),
    Complex(Vec<Slot>, Vec<Slot>),
    Integer(Slot),
    /// Words, or anything else that is not a number.
    Words(Vec<Slot>),
}

/// A call of a library function.
#[derive(Clone, Debug)]
pub(super) struct LibraryCall {
    pub stand: Stand,
    pub operands: Vec<Operand>,
    pub results: Vec<Slot>,
    /// How the module holds a number.
    pub format: Format,
}

/// Most operands of a library function.
const MOST: usize = 4;

/// The number that is held in one or two words.
#[inline(always)]
fn real(memory: &[super::lanes::Chunk], parts: &[Slot], c: u32, i: usize) -> f64 {
    let part = |slot: &Slot| f64::from_bits(memory[slot.chunk(c)].0[i]);
    match parts {
        [one] => part(one),
        [high, low] => {
            let (high, low) = (part(high), part(low));
            // beside an infinity the low word says nothing, and of zeros the high one has the sign
            if low == 0.0 || !high.is_finite() {
                high
            } else {
                high + low
            }
        }
        _ => f64::NAN,
    }
}

impl LibraryCall {
    pub fn run(&self, lanes: &mut Lanes) {
        let uniform = self.results.iter().all(|slot| slot.is_uniform());
        let mut operands = Vec::with_capacity(MOST);
        each_lane(lanes.memory, lanes.mask, uniform, |memory, c, i| {
            operands.clear();
            self.lane(memory, c, i, &mut operands);
        });
    }

    fn placed_parts(parts: &mut [Slot], uniforms: u32) {
        for slot in parts {
            *slot = slot.placed(uniforms);
        }
    }

    /// The call with its slots in a memory that begins with so many uniforms.
    pub fn placed(mut self, uniforms: u32) -> Self {
        for operand in &mut self.operands {
            match operand {
                Operand::Real(parts) | Operand::Words(parts) => {
                    Self::placed_parts(parts, uniforms);
                }
                Operand::Complex(re, im) => {
                    Self::placed_parts(re, uniforms);
                    Self::placed_parts(im, uniforms);
                }
                Operand::Integer(slot) => *slot = slot.placed(uniforms),
            }
        }
        Self::placed_parts(&mut self.results, uniforms);
        self
    }

    fn lane(
        &self,
        memory: &mut [super::lanes::Chunk],
        c: u32,
        i: usize,
        numbers: &mut Vec<Number>,
    ) {
        if let Some(value) = self.direct(memory, c, i) {
            self.give(memory, c, i, &[value]);
            return;
        }
        let mut integer = 0;
        for operand in &self.operands {
            numbers.push(match operand {
                Operand::Real(parts) => Number::Real(real(memory, parts, c, i)),
                Operand::Complex(re, im) => {
                    Number::Complex(complex(real(memory, re, c, i), real(memory, im, c, i)))
                }
                Operand::Integer(slot) => {
                    integer = (memory[slot.chunk(c)].0[i] as u32).cast_signed();
                    continue;
                }
                Operand::Words(_) => continue,
            });
        }
        let Stand::Number(meaning) = self.stand else {
            return;
        };
        let values = meaning.evaluate(numbers, integer);
        let values = values.unwrap_or([Some(Number::Real(f64::NAN)), None]);
        let mut given = [Number::Real(0.0); 2];
        let mut count = 0;
        for value in values.into_iter().flatten() {
            given[count] = value;
            count += 1;
        }
        self.give(memory, c, i, &given[..count]);
    }

    /// The value of a function that is quick to find.
    fn direct(&self, memory: &mut [super::lanes::Chunk], c: u32, i: usize) -> Option<Number> {
        let first = |memory: &[super::lanes::Chunk]| match self.operands.first() {
            Some(Operand::Real(parts)) => real(memory, parts, c, i),
            _ => f64::NAN,
        };
        let meaning = match self.stand {
            Stand::IsNan => return Some(Number::Truth(first(memory).is_nan())),
            Stand::IsInfinite => return Some(Number::Truth(first(memory).is_infinite())),
            Stand::IsFinite => return Some(Number::Truth(first(memory).is_finite())),
            Stand::MagnifyTiny => return Some(Number::Real(first(memory) * 2f64.powi(64))),
            Stand::Number(meaning) => meaning,
        };
        match (meaning, self.operands.as_slice()) {
            (Meaning::FromWords, [Operand::Words(words)]) => {
                let word = |k: usize| words.get(k).map_or(0, |s| memory[s.chunk(c)].0[i] as u32);
                return Some(Number::Real(self.format.from_words([word(0), word(1)])));
            }
            (Meaning::ToWords, _) => {
                let words = self.format.words(first(memory));
                for (slot, word) in self.results.iter().zip(words) {
                    write(memory, *slot, c, i, word.into());
                }
                return Some(Number::Truth(false));
            }
            _ => {}
        }
        let complex_valued = matches!(self.operands.first(), Some(Operand::Complex(..)));
        match meaning.direct(complex_valued)? {
            Direct::Real(f) => {
                let mut values = [0.0; MOST];
                for (value, operand) in values.iter_mut().zip(&self.operands) {
                    let Operand::Real(parts) = operand else {
                        return None;
                    };
                    *value = real(memory, parts, c, i);
                }
                Some(Number::Real(f(values.get(..self.operands.len())?)))
            }
            Direct::Complex(f) => {
                let mut values = [Complex::ZERO; MOST];
                for (value, operand) in values.iter_mut().zip(&self.operands) {
                    let Operand::Complex(re, im) = operand else {
                        return None;
                    };
                    *value = complex(real(memory, re, c, i), real(memory, im, c, i));
                }
                Some(Number::Complex(f(values.get(..self.operands.len())?)))
            }
        }
    }

    /// Writes the values, one after another, each in as many words as its format has.
    fn give(&self, memory: &mut [super::lanes::Chunk], c: u32, i: usize, values: &[Number]) {
        if self.stand == Stand::Number(Meaning::ToWords) {
            return;
        }
        let mut slots = self.results.iter();
        let mut put = |memory: &mut [super::lanes::Chunk], word: u64| {
            if let Some(&slot) = slots.next() {
                write(memory, slot, c, i, word);
            }
        };
        // a pair is held in two words, but where the result is one number of single precision
        let numbers: usize = values
            .iter()
            .map(|v| {
                if matches!(v, Number::Complex(_)) {
                    2
                } else {
                    1
                }
            })
            .sum();
        let paired = self.results.len() == 2 * numbers;
        let mut number = |memory: &mut [super::lanes::Chunk], x: f64| {
            put(memory, x.to_bits());
            if paired {
                put(memory, 0.0_f64.copysign(x).to_bits());
            }
        };
        for value in values {
            match *value {
                Number::Real(x) => number(memory, x),
                Number::Complex(z) => {
                    number(memory, z.re);
                    number(memory, z.im);
                }
                Number::Truth(t) => {
                    let word = if t { TRUE } else { 0 };
                    number(memory, f64::from_bits(word));
                }
            }
        }
    }
}
