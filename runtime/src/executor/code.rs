//! The instructions that a program is translated to.
//!
//! Each works on one word of every lane. `d` is where the result goes; operands are `a`, `b` and `c`; `x` is a place in
//! the code or in one of the program's tables. A result is written for all lanes of an active chunk: nothing reads that of
//! a lane that did not run. What must keep another value there is a `Store`.

use super::lanes::Slot;

/// How a number's word is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Form {
    Bool,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
}

impl Form {
    pub fn is_float(self) -> bool {
        matches!(self, Self::F32 | Self::F64)
    }
}

/// Floating-point functions of one operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Float1 {
    Neg,
    Abs,
    Floor,
    Ceil,
    Round,
    Trunc,
    Fract,
    Sqrt,
    InverseSqrt,
    Sign,
    Saturate,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Asinh,
    Acosh,
    Atanh,
    Exp,
    Exp2,
    Log,
    Log2,
    Radians,
    Degrees,
}

/// Floating-point functions of two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Float2 {
    Add,
    Sub,
    Mul,
    Div,
    Rem,
    Min,
    Max,
    Pow,
    Atan2,
    Step,
}

/// Floating-point functions of three operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Float3 {
    Fma,
    Clamp,
    Mix,
    SmoothStep,
}

/// Integer functions of one operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Int1 {
    Neg,
    Abs,
    Not,
    Sign,
    CountLeadingZeros,
    CountTrailingZeros,
    CountOneBits,
    ReverseBits,
    FirstLeadingBit,
    FirstTrailingBit,
}

/// Integer functions of two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Int2 {
    Add,
    Sub,
    Mul,
    Div,
    Rem,
    Min,
    Max,
    ShiftLeft,
    ShiftRight,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Compare {
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Equal,
    NotEqual,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Op {
    /// d = a
    Copy,
    /// d = a where a lane runs
    Store,
    /// d = b where a, else c
    Select,
    Float1(Form, Float1),
    Float2(Form, Float2),
    Float3(Form, Float3),
    Int1(Form, Int1),
    Int2(Form, Int2),
    Compare(Form, Compare),
    And,
    Or,
    Xor,
    /// d = not a, of truth values
    Not,
    Convert(Form, Form),
    /// The bits of the f32 nearest to the f64 a.
    BitsOfNearest,
    /// The f64 of the f32 with the bits a.
    NumberOfBits,
    /// The word of the coordinate a of a lattice point.
    LatticeWord,
    /// The permuted sum of the words a and b.
    HashWords,
    /// The number of a permuted word.
    HashNumber,
    /// Components from the start of an array to its element a, added to those in b; the array is `indices[x]`.
    Index,
    /// d = the word a components from b on, x further; 0 beyond the array.
    LoadElement,
    /// The word a components from d on, x further, is b; nothing beyond the array.
    StoreElement,
    /// d = the word a components from the start of buffer x, b (an integer) further; 0 beyond its end.
    LoadBuffer,
    /// The word a components from the start of buffer x, c (an integer) further, is b; nothing beyond its end.
    StoreBuffer,
    /// `library[x]`
    Library,
    /// Shows `sites[x]` to the observer.
    Trace,
    /// Lanes with a go on, the others wait in d; to x if there are none.
    If,
    /// Those that waited in d go on, the others wait there; to x if there are none.
    Else,
    /// Those that wait in d go on, too; to x if there are none at all.
    EndIf,
    /// No lane waits in d nor in a.
    Clear,
    /// Loop x begins: no lane waits in d nor in a. What it repeats follows.
    Enter,
    /// All lanes wait in d, and x is next.
    Leave,
    /// Lanes with a wait in d; if no other is left, x is next.
    LeaveIf,
    /// Those that wait in d go on, too, and none waits; to x if there are none.
    Join,
    /// Lanes with a wait in d; the others, if any, begin again at x.
    Repeat,
    /// Those that wait in d go on, and no others; to x if there are none.
    Resume,
    /// Of those that wait in d, those with a go on; to x if there are none.
    Case,
    /// No lane runs any more in this function, and x is next.
    Quit,
    /// Lanes are noted in d, and the function at x is next, up to its `End`.
    Call,
    /// The end of a function, or of all.
    End,
    /// To x.
    Jump,
}

impl Op {
    /// Whether `x` is a place in the code.
    pub fn jumps(self) -> bool {
        matches!(
            self,
            Self::If
                | Self::Else
                | Self::EndIf
                | Self::Leave
                | Self::LeaveIf
                | Self::Join
                | Self::Repeat
                | Self::Resume
                | Self::Case
                | Self::Quit
                | Self::Call
                | Self::Jump
        )
    }
}

/// One instruction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inst {
    pub op: Op,
    pub x: u32,
    pub d: Slot,
    pub a: Slot,
    pub b: Slot,
    pub c: Slot,
}

impl Inst {
    pub fn new(op: Op) -> Self {
        let none = Slot::uniform(0);
        Self {
            op,
            x: 0,
            d: none,
            a: none,
            b: none,
            c: none,
        }
    }

    pub fn to(self, d: Slot) -> Self {
        Self { d, ..self }
    }

    pub fn of(self, a: Slot) -> Self {
        Self { a, ..self }
    }

    pub fn and(self, b: Slot) -> Self {
        Self { b, ..self }
    }

    pub fn with(self, c: Slot) -> Self {
        Self { c, ..self }
    }

    pub fn at(self, x: u32) -> Self {
        Self { x, ..self }
    }

    /// The instruction with its slots in a memory that begins with so many uniforms.
    pub fn placed(self, uniforms: u32) -> Self {
        Self {
            d: self.d.placed(uniforms),
            a: self.a.placed(uniforms),
            b: self.b.placed(uniforms),
            c: self.c.placed(uniforms),
            ..self
        }
    }
}

/// An array that is indexed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Indexed {
    /// Elements; `u64::MAX` where only the buffer knows.
    pub count: u64,
    /// Components of an element.
    pub stride: u64,
}

/// A component offset beyond an array's end.
pub(super) const BEYOND: u64 = u64::MAX;
