//! What a run costs on a graphics device: instructions that its groups issue, by what they are and by the function that
//! they come from. No device is asked; it tells two programs of one picture apart.
//!
//! Compilers of devices compute nothing twice, and fuse a product with a sum. So values are numbered as they are computed: what has
//! the number of an earlier one is not counted, and a sum takes the place of the product that it adds.

use std::collections::{HashMap, HashSet};

use super::code::{Float1, Float2, Float3, Inst, Int2, Op};
use super::lanes::Slot;
use super::program::Program;

/// Lanes that a device issues an instruction for at once; a group has several of them.
pub const WARP: usize = 32;

/// What an instruction is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Kind {
    /// Sums, products, comparisons, choices, integers.
    Arithmetic,
    /// Quotients and roots.
    Quotient,
    /// Elementary functions.
    Elementary,
    /// Elements of arrays, and buffers.
    Memory,
    /// Branches and loops.
    Flow,
    /// Anything that has the same result in all lanes. A device may compute it once, or when the pipeline is made.
    Uniform,
}

impl Kind {
    /// Every kind.
    pub const ALL: [Self; 6] = [
        Self::Arithmetic,
        Self::Quotient,
        Self::Elementary,
        Self::Memory,
        Self::Flow,
        Self::Uniform,
    ];
}

/// What the instructions of a function cost that are of one kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Charge {
    /// The function whose text they come from; empty for an entry point.
    pub function: String,
    /// What they are.
    pub kind: Kind,
    /// Issue slots of a warp, of all warps together. An addition takes one.
    pub slots: u64,
}

/// How often each instruction of a program was issued, once for each warp in which a lane ran.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Issued {
    /// Of each instruction.
    times: Vec<u64>,
    numbers: Numbers,
}

impl Issued {
    /// A group of lanes begins.
    pub(super) fn begin(&mut self) {
        self.numbers = Numbers::default();
    }

    /// An instruction is issued for so many warps; `all`: whether all lanes run.
    pub(super) fn issue(&mut self, place: usize, inst: &Inst, warps: u64, all: bool) {
        if self.numbers.is_new(inst, all) {
            self.times[place] += warps;
        }
    }
}

/// A value as a number: the same for what is computed in the same way.
type Number = u64;

/// What an instruction computes: itself without its place, and the numbers of its operands.
type Formula = (Op, u32, [Number; 3]);

/// Numbers of the values that slots hold.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Numbers {
    next: Number,
    held: HashMap<Slot, Number>,
    known: HashMap<Formula, Number>,
    /// Products that no sum has taken.
    products: HashSet<Number>,
}

impl Numbers {
    /// Notes what an instruction does to its slot; tells whether it has to be issued.
    fn is_new(&mut self, inst: &Inst, all: bool) -> bool {
        match inst.op {
            Op::Copy => {
                let number = self.of(inst.a);
                self.held.insert(inst.d, number);
                return true;
            }
            Op::Store if all => {
                let number = self.of(inst.a);
                self.held.insert(inst.d, number);
                return true;
            }
            Op::Float1(..) | Op::Float2(..) | Op::Float3(..) | Op::Int1(..) | Op::Int2(..) => {}
            Op::Compare(..) | Op::And | Op::Or | Op::Xor | Op::Not | Op::Select => {}
            Op::Convert(..) | Op::BitsOfNearest | Op::NumberOfBits | Op::Index => {}
            _ => {
                // where an instruction has no result, its slot is that of a constant
                if inst.op == Op::Store || !inst.d.is_uniform() {
                    self.fresh(inst.d);
                }
                return true;
            }
        }
        let operands = [inst.a, inst.b, inst.c].map(|slot| self.of(slot));
        let formula = (inst.op, inst.x, operands);
        if let Some(&number) = self.known.get(&formula) {
            self.held.insert(inst.d, number);
            return false;
        }
        let number = self.fresh(inst.d);
        self.known.insert(formula, number);
        match inst.op {
            Op::Float2(_, Float2::Mul) => {
                self.products.insert(number);
            }
            Op::Float2(_, Float2::Add | Float2::Sub) => {
                let mut taken = operands[..2].iter().filter(|&n| self.products.contains(n));
                if let Some(&product) = taken.next() {
                    self.products.remove(&product);
                    return false;
                }
            }
            _ => {}
        }
        true
    }

    fn of(&mut self, slot: Slot) -> Number {
        match self.held.get(&slot) {
            Some(&number) => number,
            None => self.fresh(slot),
        }
    }

    fn fresh(&mut self, slot: Slot) -> Number {
        self.next += 1;
        self.held.insert(slot, self.next);
        self.next
    }
}

impl Program {
    /// A count of nothing.
    #[must_use]
    pub fn nothing_issued(&self) -> Issued {
        Issued {
            times: vec![0; self.code.len()],
            numbers: Numbers::default(),
        }
    }

    /// What was issued, by function and kind. Weights are those of a device with a unit for reciprocals, roots, sines,
    /// logarithms and exponentials to the base 2, that everything else is made of.
    #[must_use]
    pub fn charges(&self, issued: &Issued) -> Vec<Charge> {
        let mut all: Vec<Charge> = Vec::new();
        for (place, (inst, &times)) in self.code.iter().zip(&issued.times).enumerate() {
            let (mut kind, mut weight) = weight(inst.op);
            if inst.b.is_uniform() {
                // a product with a reciprocal that is known
                match inst.op {
                    Op::Float2(_, Float2::Div) => weight = 1,
                    Op::Int2(_, Int2::Div | Int2::Rem) => weight = 4,
                    _ => {}
                }
            }
            let decides = inst.a.is_uniform() && kind == Kind::Flow;
            let same = inst.d.is_uniform() && kind != Kind::Flow && kind != Kind::Memory;
            if decides || same {
                kind = Kind::Uniform;
            }
            let slots = times * weight;
            if slots == 0 {
                continue;
            }
            let owner = self.owners.get(place).copied().unwrap_or_default();
            let function = self.names.get(owner as usize).cloned().unwrap_or_default();
            match all
                .iter_mut()
                .find(|c| c.kind == kind && c.function == function)
            {
                Some(charge) => charge.slots += slots,
                None => all.push(Charge {
                    function,
                    kind,
                    slots,
                }),
            }
        }
        all
    }
}

/// Kind and issue slots of an instruction.
fn weight(op: Op) -> (Kind, u64) {
    match op {
        Op::Float1(_, fun) => float1(fun),
        Op::Float2(_, fun) => float2(fun),
        Op::Float3(_, fun) => float3(fun),
        // there is no unit for quotients of integers
        Op::Int2(_, Int2::Div | Int2::Rem) => (Kind::Quotient, 20),
        Op::Int1(..) | Op::Int2(..) | Op::Compare(..) | Op::And | Op::Or | Op::Xor | Op::Not => {
            (Kind::Arithmetic, 1)
        }
        Op::Select | Op::Index => (Kind::Arithmetic, 1),
        Op::Convert(..) | Op::BitsOfNearest | Op::NumberOfBits => (Kind::Arithmetic, 2),
        Op::LoadElement | Op::StoreElement | Op::LoadBuffer | Op::StoreBuffer => (Kind::Memory, 4),
        Op::Library => (Kind::Elementary, 20),
        Op::If | Op::Case | Op::Repeat => (Kind::Flow, 2),
        Op::Else | Op::LeaveIf => (Kind::Flow, 1),
        _ => (Kind::Flow, 0),
    }
}

fn float1(fun: Float1) -> (Kind, u64) {
    match fun {
        // signs are part of an operand
        Float1::Neg | Float1::Abs => (Kind::Arithmetic, 0),
        Float1::Saturate | Float1::Radians | Float1::Degrees => (Kind::Arithmetic, 1),
        Float1::Floor | Float1::Ceil | Float1::Round | Float1::Trunc => (Kind::Arithmetic, 2),
        Float1::Fract | Float1::Sign => (Kind::Arithmetic, 3),
        Float1::InverseSqrt => (Kind::Quotient, 2),
        Float1::Sqrt => (Kind::Quotient, 4),
        Float1::Sin | Float1::Cos => (Kind::Elementary, 3),
        Float1::Exp2 => (Kind::Elementary, 4),
        Float1::Exp | Float1::Log2 => (Kind::Elementary, 5),
        Float1::Log => (Kind::Elementary, 6),
        Float1::Tan => (Kind::Elementary, 8),
        Float1::Tanh | Float1::Sinh | Float1::Cosh => (Kind::Elementary, 12),
        Float1::Asin | Float1::Acos | Float1::Asinh | Float1::Acosh | Float1::Atanh => {
            (Kind::Elementary, 14)
        }
        Float1::Atan => (Kind::Elementary, 16),
    }
}

fn float2(fun: Float2) -> (Kind, u64) {
    match fun {
        Float2::Add | Float2::Sub | Float2::Mul | Float2::Min | Float2::Max => {
            (Kind::Arithmetic, 1)
        }
        Float2::Step => (Kind::Arithmetic, 2),
        Float2::Div => (Kind::Quotient, 3),
        Float2::Rem => (Kind::Quotient, 8),
        Float2::Pow => (Kind::Elementary, 10),
        Float2::Atan2 => (Kind::Elementary, 24),
    }
}

fn float3(fun: Float3) -> (Kind, u64) {
    match fun {
        Float3::Fma => (Kind::Arithmetic, 1),
        Float3::Clamp | Float3::Mix => (Kind::Arithmetic, 2),
        Float3::SmoothStep => (Kind::Arithmetic, 9),
    }
}
