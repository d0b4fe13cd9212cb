//! Functions of the shader library by what they mean: in `f64`, as the operator table defines them.

use naga::{Function, TypeInner, UniqueArena};
use pullback_compiler::lower::Format;
use pullback_compiler::reference::complex::{Complex, complex};
use pullback_compiler::table::{Direct, Meaning, Number, meaning};

use super::kernels::{self, Lanes, each_lane, write};
use super::lanes::{Chunk, Slot, TRUE, WIDTH};

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

/// How a call's values are found.
#[derive(Clone, Debug)]
enum Way {
    /// Functions of reals.
    Reals(Vec<fn(&[f64]) -> f64>),
    /// Functions of complex numbers.
    Complexes(Vec<fn(&[Complex]) -> Complex>),
    /// A test of a real.
    Test(fn(f64) -> bool),
    FromWords,
    ToWords,
    /// The table finds out.
    General(Meaning),
}

/// A call of a library function.
#[derive(Clone, Debug)]
pub(super) struct LibraryCall {
    way: Way,
    operands: Vec<Operand>,
    results: Vec<Slot>,
    /// How the module holds a number.
    format: Format,
    /// The operands, where each is a real of one word, and each result, too.
    flat: Vec<Slot>,
}

/// Most operands of a library function.
const MOST: usize = 4;

/// The number that is held in one or two words.
#[inline(always)]
fn real(memory: &[Chunk], parts: &[Slot], c: u32, i: usize) -> f64 {
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

/// How the values of a function of these operands are found.
fn way(stand: Stand, operands: &[Operand]) -> Way {
    let meaning = match stand {
        Stand::IsNan => return Way::Test(f64::is_nan),
        Stand::IsInfinite => return Way::Test(f64::is_infinite),
        Stand::IsFinite => return Way::Test(f64::is_finite),
        Stand::MagnifyTiny => return Way::Reals(vec![|x| x[0] * 18_446_744_073_709_551_616.0]),
        Stand::Number(Meaning::FromWords) => return Way::FromWords,
        Stand::Number(Meaning::ToWords) => return Way::ToWords,
        Stand::Number(meaning) => meaning,
    };
    let all = |is: fn(&Operand) -> bool| operands.iter().all(is);
    let complex = all(|operand| matches!(operand, Operand::Complex(..)));
    let alike = complex || all(|operand| matches!(operand, Operand::Real(_)));
    let direct = meaning
        .direct(complex)
        .filter(|_| alike && operands.len() <= MOST);
    let (mut reals, mut complexes) = (Vec::new(), Vec::new());
    for direct in direct.unwrap_or_default() {
        match direct {
            Direct::Real(f) => reals.push(f),
            Direct::Complex(f) => complexes.push(f),
        }
    }
    match (reals.is_empty(), complexes.is_empty()) {
        (false, true) => Way::Reals(reals),
        (true, false) => Way::Complexes(complexes),
        _ => Way::General(meaning),
    }
}

/// The operands, if each is a real of one word.
fn flat(operands: &[Operand]) -> Option<Vec<Slot>> {
    let one = |operand: &Operand| match operand {
        Operand::Real(parts) => <[Slot; 1]>::try_from(parts.as_slice()).ok(),
        _ => None,
    };
    let all: Option<Vec<[Slot; 1]>> = operands.iter().map(one).collect();
    all.map(|all| all.concat())
}

impl LibraryCall {
    pub fn new(stand: Stand, operands: Vec<Operand>, results: Vec<Slot>, format: Format) -> Self {
        let way = way(stand, &operands);
        let functions = match &way {
            Way::Reals(functions) => functions.len(),
            _ => 0,
        };
        Self {
            flat: flat(&operands)
                .filter(|_| results.len() == functions)
                .unwrap_or_default(),
            way,
            operands,
            results,
            format,
        }
    }

    /// The call with its slots in a memory that begins with so many uniforms.
    pub fn placed(mut self, uniforms: u32) -> Self {
        let place = |parts: &mut [Slot]| {
            for slot in parts {
                *slot = slot.placed(uniforms);
            }
        };
        for operand in &mut self.operands {
            match operand {
                Operand::Real(parts) | Operand::Words(parts) => place(parts),
                Operand::Complex(re, im) => {
                    place(re);
                    place(im);
                }
                Operand::Integer(slot) => *slot = slot.placed(uniforms),
            }
        }
        place(&mut self.results);
        place(&mut self.flat);
        self
    }

    pub fn run(&self, lanes: &mut Lanes) {
        let uniform = self.results.iter().all(|slot| slot.is_uniform());
        let count = self.operands.len();
        match &self.way {
            Way::Reals(functions) if !self.flat.is_empty() => {
                self.flat_reals(functions, lanes, uniform);
            }
            Way::Reals(functions) => {
                each_lane(lanes.memory, lanes.mask, uniform, |memory, c, i| {
                    let mut x = [0.0; MOST];
                    self.reals(memory, c, i, &mut x);
                    let mut to = self.results.as_slice();
                    for f in functions {
                        to = self.give(memory, c, i, to, f(&x[..count]), functions.len());
                    }
                });
            }
            Way::Complexes(functions) => {
                each_lane(lanes.memory, lanes.mask, uniform, |memory, c, i| {
                    let mut z = [Complex::ZERO; MOST];
                    for (z, operand) in z.iter_mut().zip(&self.operands) {
                        if let Operand::Complex(re, im) = operand {
                            *z = complex(real(memory, re, c, i), real(memory, im, c, i));
                        }
                    }
                    let mut to = self.results.as_slice();
                    for f in functions {
                        let value = f(&z[..count]);
                        to = self.give(memory, c, i, to, value.re, 2 * functions.len());
                        to = self.give(memory, c, i, to, value.im, 2 * functions.len());
                    }
                });
            }
            Way::General(meaning) => {
                each_lane(lanes.memory, lanes.mask, uniform, |memory, c, i| {
                    self.general(*meaning, memory, c, i);
                });
            }
            Way::Test(test) => each_lane(lanes.memory, lanes.mask, uniform, |memory, c, i| {
                let mut x = [f64::NAN; MOST];
                self.reals(memory, c, i, &mut x);
                let word = if test(x[0]) { TRUE } else { 0 };
                write(memory, self.results[0], c, i, word);
            }),
            Way::FromWords => each_lane(lanes.memory, lanes.mask, uniform, |memory, c, i| {
                if let Some(Operand::Words(words)) = self.operands.first() {
                    let word =
                        |k: usize| words.get(k).map_or(0, |s| memory[s.chunk(c)].0[i] as u32);
                    let value = self.format.from_words([word(0), word(1)]);
                    self.give(memory, c, i, &self.results, value, 1);
                }
            }),
            Way::ToWords => each_lane(lanes.memory, lanes.mask, uniform, |memory, c, i| {
                let mut x = [f64::NAN; MOST];
                self.reals(memory, c, i, &mut x);
                for (&slot, word) in self.results.iter().zip(self.format.words(x[0])) {
                    write(memory, slot, c, i, word.into());
                }
            }),
        }
    }

    /// Functions of reals of one word each, chunk by chunk.
    fn flat_reals(&self, functions: &[fn(&[f64]) -> f64], lanes: &mut Lanes, uniform: bool) {
        let count = self.flat.len();
        for &c in kernels::chunks_of(lanes.mask, uniform) {
            let mut rows = [[0.0; MOST]; WIDTH];
            for (k, slot) in self.flat.iter().enumerate() {
                let column = &lanes.memory[slot.chunk(c)].0;
                for (row, &word) in rows.iter_mut().zip(column) {
                    row[k] = f64::from_bits(word);
                }
            }
            let runs = lanes.mask.lanes[c as usize].0;
            for (f, d) in functions.iter().zip(&self.results) {
                let out = &mut lanes.memory[d.chunk(c)];
                if uniform {
                    *out = Chunk::splat(f(&rows[0][..count]).to_bits());
                    continue;
                }
                for ((word, row), runs) in out.0.iter_mut().zip(&rows).zip(runs) {
                    if runs != 0 {
                        *word = f(&row[..count]).to_bits();
                    }
                }
            }
        }
    }

    fn reals(&self, memory: &[Chunk], c: u32, i: usize, x: &mut [f64; MOST]) {
        for (x, operand) in x.iter_mut().zip(&self.operands) {
            if let Operand::Real(parts) = operand {
                *x = real(memory, parts, c, i);
            }
        }
    }

    /// Any function of operands of any kind.
    fn general(&self, meaning: Meaning, memory: &mut [Chunk], c: u32, i: usize) {
        let mut numbers = [Number::Real(0.0); MOST];
        let (mut count, mut integer) = (0, 0);
        for operand in &self.operands {
            let number = match operand {
                Operand::Real(parts) => Number::Real(real(memory, parts, c, i)),
                Operand::Complex(re, im) => {
                    Number::Complex(complex(real(memory, re, c, i), real(memory, im, c, i)))
                }
                Operand::Integer(slot) => {
                    integer = (memory[slot.chunk(c)].0[i] as u32).cast_signed();
                    continue;
                }
                Operand::Words(_) => continue,
            };
            if let Some(slot) = numbers.get_mut(count) {
                *slot = number;
                count += 1;
            }
        }
        let values = meaning.evaluate(&numbers[..count], integer);
        let values = values.unwrap_or([Some(Number::Real(f64::NAN)), None]);
        let parts = |value: &Number| {
            if matches!(value, Number::Complex(_)) {
                2
            } else {
                1
            }
        };
        let all = values.iter().flatten().map(parts).sum();
        let mut to = self.results.as_slice();
        for value in values.into_iter().flatten() {
            match value {
                Number::Real(x) => to = self.give(memory, c, i, to, x, all),
                Number::Complex(z) => {
                    to = self.give(memory, c, i, to, z.re, all);
                    to = self.give(memory, c, i, to, z.im, all);
                }
                Number::Truth(truth) => {
                    if let Some((&first, rest)) = to.split_first() {
                        write(memory, first, c, i, if truth { TRUE } else { 0 });
                        to = rest;
                    }
                }
            }
        }
    }

    /// Writes one of `all` numbers, in as many words as each has, and gives the slots behind it.
    #[inline(always)]
    fn give<'s>(
        &self,
        memory: &mut [Chunk],
        c: u32,
        i: usize,
        to: &'s [Slot],
        x: f64,
        all: usize,
    ) -> &'s [Slot] {
        let width = if self.results.len() == 2 * all { 2 } else { 1 };
        // what a pair's second word adds is in the first
        let words = [x.to_bits(), 0.0_f64.copysign(x).to_bits()];
        for (&slot, word) in to.iter().zip(words).take(width) {
            write(memory, slot, c, i, word);
        }
        to.get(width..).unwrap_or_default()
    }
}
