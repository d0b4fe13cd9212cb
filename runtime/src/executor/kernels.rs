//! What an instruction does to the lanes of a group: simple loops over eight words, which the compiler vectorises.

use super::code::{Compare, Float1, Float2, Float3, Form, Inst, Int1, Int2};
use super::float::{self, Float, cheap_function};
use super::integer::{Integer, convert};
use super::lanes::{CHUNKS, Chunk, Mask, Slot, TRUE, WIDTH};

use std::cell::Cell;

/// Memory, and the lanes that run.
pub(super) struct Lanes<'a> {
    pub memory: &'a mut [Chunk],
    pub mask: &'a Mask,
}

impl Lanes<'_> {
    /// Memory that several may look at.
    #[inline(always)]
    fn cells(&mut self) -> &[Cell<Chunk>] {
        Cell::from_mut(&mut *self.memory).as_slice_of_cells()
    }
}

/// The one chunk of a uniform.
const SINGLE: &[u32] = &[0];

/// The chunks that an instruction writes.
#[inline(always)]
fn chunks(mask: &Mask, d: Slot) -> &[u32] {
    chunks_of(mask, d.is_uniform())
}

/// The chunks of what is the same for all lanes, or of the lanes that run.
#[inline(always)]
pub(super) fn chunks_of(mask: &Mask, uniform: bool) -> &[u32] {
    if uniform { SINGLE } else { mask.chunks() }
}

#[inline(always)]
pub(super) fn map1(lanes: &mut Lanes, inst: &Inst, f: impl Fn(u64) -> u64) {
    let (mask, memory) = (lanes.mask, lanes.cells());
    let (a, d) = (inst.a.row(memory), inst.d.row(memory));
    for &c in chunks(mask, inst.d) {
        d.set(c, a.get(c).map(&f));
    }
}

#[inline(always)]
pub(super) fn map2(lanes: &mut Lanes, inst: &Inst, f: impl Fn(u64, u64) -> u64) {
    let (mask, memory) = (lanes.mask, lanes.cells());
    let (a, b, d) = (inst.a.row(memory), inst.b.row(memory), inst.d.row(memory));
    for &c in chunks(mask, inst.d) {
        d.set(c, a.get(c).zip(b.get(c), &f));
    }
}

#[inline(always)]
fn map3(lanes: &mut Lanes, inst: &Inst, f: impl Fn(u64, u64, u64) -> u64) {
    let (mask, memory) = (lanes.mask, lanes.cells());
    let (a, b) = (inst.a.row(memory), inst.b.row(memory));
    let (third, d) = (inst.c.row(memory), inst.d.row(memory));
    for &c in chunks(mask, inst.d) {
        let (a, b, third) = (a.get(c).0, b.get(c).0, third.get(c).0);
        d.set(c, Chunk(std::array::from_fn(|i| f(a[i], b[i], third[i]))));
    }
}

/// Calls `f` for each lane that runs, with the chunk and the place in it; once for a uniform, with the first place.
#[inline(always)]
pub(super) fn each_lane(
    memory: &mut [Chunk],
    mask: &Mask,
    uniform: bool,
    mut f: impl FnMut(&mut [Chunk], u32, usize),
) {
    if uniform {
        f(memory, 0, 0);
        return;
    }
    for &c in mask.chunks() {
        let runs = mask.lanes[c as usize].0;
        for (i, &runs) in runs.iter().enumerate() {
            if runs != 0 {
                f(memory, c, i);
            }
        }
    }
}

/// Writes a lane's word, or the word of all lanes.
#[inline(always)]
pub(super) fn write(memory: &mut [Chunk], d: Slot, c: u32, i: usize, word: u64) {
    let chunk = &mut memory[d.chunk(c)];
    if d.is_uniform() {
        *chunk = Chunk([word; WIDTH]);
    } else {
        chunk.0[i] = word;
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn store(lanes: &mut Lanes, inst: &Inst) {
    let (mask, memory) = (lanes.mask, lanes.cells());
    let (a, d) = (inst.a.row(memory), inst.d.row(memory));
    for &c in mask.chunks() {
        d.set(
            c,
            a.get(c).blend(d.get(c), mask.lanes[(c as usize) % CHUNKS]),
        );
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn select(lanes: &mut Lanes, inst: &Inst) {
    map3(lanes, inst, |mask, accept, reject| {
        reject ^ ((reject ^ accept) & mask)
    });
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn float1<F: Float>(lanes: &mut Lanes, inst: &Inst, fun: Float1) {
    if float::is_costly(fun) {
        return costly1::<F>(lanes, inst, fun);
    }
    macro_rules! run {
        ($f:expr) => {{
            let f = $f;
            map1(lanes, inst, |x| f(F::from_word(x)).word())
        }};
    }
    cheap_function!(fun, F, run);
}

/// A function of which each lane is worth skipping.
#[inline(never)]
fn costly1<F: Float>(lanes: &mut Lanes, inst: &Inst, fun: Float1) {
    let double = float::double(fun);
    let (a, d) = (inst.a, inst.d);
    each_lane(lanes.memory, lanes.mask, d.is_uniform(), |memory, c, i| {
        let x = F::from_word(memory[a.chunk(c)].0[i]);
        write(memory, d, c, i, F::nearest(double(x.double())).word());
    });
}

/// A function of two operands of which each lane is worth skipping.
#[inline(never)]
fn costly2<F: Float>(lanes: &mut Lanes, inst: &Inst, double: fn(f64, f64) -> f64) {
    let (a, b, d) = (inst.a, inst.b, inst.d);
    each_lane(lanes.memory, lanes.mask, d.is_uniform(), |memory, c, i| {
        let x = F::from_word(memory[a.chunk(c)].0[i]).double();
        let y = F::from_word(memory[b.chunk(c)].0[i]).double();
        write(memory, d, c, i, F::nearest(double(x, y)).word());
    });
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn float2<F: Float>(lanes: &mut Lanes, inst: &Inst, fun: Float2) {
    if let Some(double) = float::double2(fun) {
        return costly2::<F>(lanes, inst, double);
    }
    macro_rules! run {
        ($f:expr) => {{
            let f = $f;
            map2(lanes, inst, |a, b| {
                let value: F = f(F::from_word(a), F::from_word(b));
                value.word()
            })
        }};
    }
    match fun {
        Float2::Add => run!(|a: F, b: F| a + b),
        Float2::Sub => run!(|a: F, b: F| a - b),
        Float2::Mul => run!(|a: F, b: F| a * b),
        Float2::Div => run!(|a: F, b: F| a / b),
        Float2::Rem => run!(|a: F, b: F| a % b),
        Float2::Min => run!(float::min),
        Float2::Max => run!(float::max),
        Float2::Step => run!(|edge: F, x: F| F::nearest(if edge <= x { 1.0 } else { 0.0 })),
        Float2::Pow | Float2::Atan2 => {}
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn float3<F: Float>(lanes: &mut Lanes, inst: &Inst, fun: Float3) {
    macro_rules! run {
        ($fun:expr) => {
            map3(lanes, inst, |a, b, c| {
                let value = float::ternary($fun, F::from_word(a), F::from_word(b), F::from_word(c));
                value.word()
            })
        };
    }
    match fun {
        Float3::Fma => run!(Float3::Fma),
        Float3::Clamp => run!(Float3::Clamp),
        Float3::Mix => run!(Float3::Mix),
        Float3::SmoothStep => run!(Float3::SmoothStep),
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn int1<I: Integer>(lanes: &mut Lanes, inst: &Inst, fun: Int1) {
    map1(lanes, inst, |x| I::from_word(x).unary(fun).word());
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn int2<I: Integer>(lanes: &mut Lanes, inst: &Inst, fun: Int2) {
    macro_rules! run {
        ($fun:expr) => {
            map2(lanes, inst, |a, b| {
                I::from_word(a).binary($fun, I::from_word(b)).word()
            })
        };
    }
    match fun {
        Int2::Add => run!(Int2::Add),
        Int2::Sub => run!(Int2::Sub),
        Int2::Mul => run!(Int2::Mul),
        Int2::ShiftLeft => run!(Int2::ShiftLeft),
        Int2::ShiftRight => run!(Int2::ShiftRight),
        fun => run!(fun),
    }
}

/// Comparisons; those of floats with a NaN do not hold, but for `NotEqual`.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn compare<T: PartialOrd>(
    lanes: &mut Lanes,
    inst: &Inst,
    kind: Compare,
    read: impl Fn(u64) -> T,
) {
    macro_rules! run {
        ($op:tt) => {
            map2(lanes, inst, |a, b| if read(a) $op read(b) { TRUE } else { 0 })
        };
    }
    match kind {
        Compare::Less => run!(<),
        Compare::LessEqual => run!(<=),
        Compare::Greater => run!(>),
        Compare::GreaterEqual => run!(>=),
        Compare::Equal => run!(==),
        Compare::NotEqual => run!(!=),
    }
}

/// Numbers in another form.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn converted(lanes: &mut Lanes, inst: &Inst, from: Form, to: Form) {
    macro_rules! run {
        ($from:expr, $to:expr) => {
            map1(lanes, inst, |word| convert(word, $from, $to))
        };
    }
    // those that loops do in every step are written out, for the compiler to know both
    match (from, to) {
        (Form::U32, Form::F64) => map1(lanes, inst, |n| f64::from(n as u32).to_bits()),
        (Form::I32, Form::F64) => map1(lanes, inst, |n| f64::from(n as u32 as i32).to_bits()),
        (Form::U32, Form::F32) => map1(lanes, inst, |n| (n as u32 as f32).word()),
        (Form::I32, Form::F32) => map1(lanes, inst, |n| (n as u32 as i32 as f32).word()),
        (Form::F32, Form::F64) => run!(Form::F32, Form::F64),
        (Form::F64, Form::F32) => run!(Form::F64, Form::F32),
        (Form::F64, Form::I32) => run!(Form::F64, Form::I32),
        (Form::F64, Form::U32) => run!(Form::F64, Form::U32),
        (from, to) => run!(from, to),
    }
}
