//! What an instruction does to the lanes of a group: simple loops over eight words, which the compiler vectorises.

use super::code::{Compare, Float1, Float2, Float3, Form, Inst, Int1, Int2};
use super::float::{self, Float, cheap_function};
use super::integer::{Integer, convert};
use super::lanes::{Chunk, Mask, Slot, TRUE, WIDTH};

/// Memory, and the lanes that run.
pub(super) struct Lanes<'a> {
    pub memory: &'a mut [Chunk],
    pub mask: &'a Mask,
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
    for &c in chunks(lanes.mask, inst.d) {
        let a = lanes.memory[inst.a.chunk(c)];
        lanes.memory[inst.d.chunk(c)] = a.map(&f);
    }
}

#[inline(always)]
pub(super) fn map2(lanes: &mut Lanes, inst: &Inst, f: impl Fn(u64, u64) -> u64) {
    for &c in chunks(lanes.mask, inst.d) {
        let a = lanes.memory[inst.a.chunk(c)];
        let b = lanes.memory[inst.b.chunk(c)];
        lanes.memory[inst.d.chunk(c)] = a.zip(b, &f);
    }
}

#[inline(always)]
fn map3(lanes: &mut Lanes, inst: &Inst, f: impl Fn(u64, u64, u64) -> u64) {
    for &c in chunks(lanes.mask, inst.d) {
        let a = lanes.memory[inst.a.chunk(c)].0;
        let b = lanes.memory[inst.b.chunk(c)].0;
        let third = lanes.memory[inst.c.chunk(c)].0;
        let value = Chunk(std::array::from_fn(|i| f(a[i], b[i], third[i])));
        lanes.memory[inst.d.chunk(c)] = value;
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

pub(super) fn store(lanes: &mut Lanes, inst: &Inst) {
    for &c in lanes.mask.chunks() {
        let a = lanes.memory[inst.a.chunk(c)];
        let d = &mut lanes.memory[inst.d.chunk(c)];
        *d = a.blend(*d, lanes.mask.lanes[c as usize]);
    }
}

pub(super) fn select(lanes: &mut Lanes, inst: &Inst) {
    map3(lanes, inst, |mask, accept, reject| {
        reject ^ ((reject ^ accept) & mask)
    });
}

pub(super) fn float1<F: Float>(lanes: &mut Lanes, inst: &Inst, fun: Float1) {
    if float::is_costly(fun) {
        let double = float::double(fun);
        let (a, d) = (inst.a, inst.d);
        each_lane(lanes.memory, lanes.mask, d.is_uniform(), |memory, c, i| {
            let x = F::from_word(memory[a.chunk(c)].0[i]);
            write(memory, d, c, i, F::nearest(double(x.double())).word());
        });
        return;
    }
    macro_rules! run {
        ($f:expr) => {{
            let f = $f;
            map1(lanes, inst, |x| f(F::from_word(x)).word())
        }};
    }
    cheap_function!(fun, F, run);
}

pub(super) fn float2<F: Float>(lanes: &mut Lanes, inst: &Inst, fun: Float2) {
    if let Some(double) = float::double2(fun) {
        let (a, b, d) = (inst.a, inst.b, inst.d);
        each_lane(lanes.memory, lanes.mask, d.is_uniform(), |memory, c, i| {
            let x = F::from_word(memory[a.chunk(c)].0[i]);
            let y = F::from_word(memory[b.chunk(c)].0[i]);
            write(
                memory,
                d,
                c,
                i,
                F::nearest(double(x.double(), y.double())).word(),
            );
        });
        return;
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

pub(super) fn int1<I: Integer>(lanes: &mut Lanes, inst: &Inst, fun: Int1) {
    map1(lanes, inst, |x| I::from_word(x).unary(fun).word());
}

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
