//! What an instruction computes.

use super::Machine;
use crate::executor::code::{BEYOND, Form, Inst, Op};
use crate::executor::hash::{hash_number, hash_words, lattice_word};
use crate::executor::kernels::{self, Lanes, each_lane, map1, map2, write};

impl Machine<'_> {
    /// Instructions that compute.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn compute(&mut self, inst: &Inst) {
        let mut lanes = Lanes {
            memory: &mut self.memory,
            mask: &self.mask,
        };
        let lanes = &mut lanes;
        match inst.op {
            Op::Copy => map1(lanes, inst, |a| a),
            Op::Store => kernels::store(lanes, inst),
            Op::Select => kernels::select(lanes, inst),
            Op::And => map2(lanes, inst, |a, b| a & b),
            Op::Or => map2(lanes, inst, |a, b| a | b),
            Op::Xor => map2(lanes, inst, |a, b| a ^ b),
            Op::Not => map1(lanes, inst, |a| !a),
            Op::Float1(Form::F32, fun) => kernels::float1::<f32>(lanes, inst, fun),
            Op::Float1(_, fun) => kernels::float1::<f64>(lanes, inst, fun),
            Op::Float2(Form::F32, fun) => kernels::float2::<f32>(lanes, inst, fun),
            Op::Float2(_, fun) => kernels::float2::<f64>(lanes, inst, fun),
            Op::Float3(Form::F32, fun) => kernels::float3::<f32>(lanes, inst, fun),
            Op::Float3(_, fun) => kernels::float3::<f64>(lanes, inst, fun),
            Op::Int1(form, fun) => match form {
                Form::I32 => kernels::int1::<i32>(lanes, inst, fun),
                Form::I64 => kernels::int1::<i64>(lanes, inst, fun),
                Form::U64 => kernels::int1::<u64>(lanes, inst, fun),
                _ => kernels::int1::<u32>(lanes, inst, fun),
            },
            Op::Int2(form, fun) => match form {
                Form::I32 => kernels::int2::<i32>(lanes, inst, fun),
                Form::I64 => kernels::int2::<i64>(lanes, inst, fun),
                Form::U64 => kernels::int2::<u64>(lanes, inst, fun),
                _ => kernels::int2::<u32>(lanes, inst, fun),
            },
            Op::Compare(form, kind) => match form {
                Form::F32 => kernels::compare(lanes, inst, kind, |w| f32::from_bits(w as u32)),
                Form::F64 => kernels::compare(lanes, inst, kind, f64::from_bits),
                Form::I32 => kernels::compare(lanes, inst, kind, |w| w as u32 as i32),
                Form::I64 => kernels::compare(lanes, inst, kind, |w| w as i64),
                _ => kernels::compare(lanes, inst, kind, |w| w),
            },
            Op::Convert(from, to) => kernels::converted(lanes, inst, from, to),
            Op::BitsOfNearest => map1(lanes, inst, |w| {
                u64::from((f64::from_bits(w) as f32).to_bits())
            }),
            Op::NumberOfBits => map1(lanes, inst, |w| {
                f64::from(f32::from_bits(w as u32)).to_bits()
            }),
            Op::LatticeWord => map1(lanes, inst, |w| lattice_word(f64::from_bits(w))),
            Op::HashWords => map2(lanes, inst, hash_words),
            Op::HashNumber => map1(lanes, inst, |w| hash_number(w).to_bits()),
            Op::Index => {
                let array = self.program.indices[inst.x as usize];
                map2(lanes, inst, |index, before| {
                    if index >= array.count || before == BEYOND {
                        BEYOND
                    } else {
                        index * array.stride + before
                    }
                });
            }
            Op::LoadElement => load_element(lanes, inst),
            Op::StoreElement => store_element(lanes, inst),
            Op::Library => self.program.library[inst.x as usize].run(lanes),
            _ => {}
        }
    }

    pub(super) fn buffer_access(&mut self, inst: &Inst) {
        let buffer = &mut self.buffers[inst.x as usize];
        let extra = if inst.op == Op::LoadBuffer {
            inst.b.number()
        } else {
            inst.c.number()
        };
        let place = |word: u64| {
            (word != BEYOND).then(|| {
                usize::try_from(word)
                    .unwrap_or(usize::MAX)
                    .saturating_add(extra as usize)
            })
        };
        if inst.op == Op::LoadBuffer {
            each_lane(&mut self.memory, &self.mask, false, |memory, c, i| {
                let at = place(memory[inst.a.chunk(c)].0[i]);
                let word = at.and_then(|at| buffer.get(at)).copied().unwrap_or(0);
                write(memory, inst.d, c, i, word);
            });
            return;
        }
        each_lane(&mut self.memory, &self.mask, false, |memory, c, i| {
            let at = place(memory[inst.a.chunk(c)].0[i]);
            if let Some(word) = at.and_then(|at| buffer.get_mut(at)) {
                *word = memory[inst.b.chunk(c)].0[i];
            }
        });
    }
}

fn load_element(lanes: &mut Lanes, inst: &Inst) {
    let (a, b, d) = (inst.a, inst.b, inst.d);
    each_lane(lanes.memory, lanes.mask, d.is_uniform(), |memory, c, i| {
        let offset = memory[a.chunk(c)].0[i];
        let word = if offset == BEYOND {
            0
        } else {
            memory[b.further(offset as usize + inst.x as usize).chunk(c)].0[i]
        };
        write(memory, d, c, i, word);
    });
}

fn store_element(lanes: &mut Lanes, inst: &Inst) {
    let (a, b, d) = (inst.a, inst.b, inst.d);
    each_lane(lanes.memory, lanes.mask, false, |memory, c, i| {
        let offset = memory[a.chunk(c)].0[i];
        if offset != BEYOND {
            let word = memory[b.chunk(c)].0[i];
            let place = d.further(offset as usize + inst.x as usize);
            memory[place.chunk(c)].0[i] = word;
        }
    });
}
