//! Which lanes run.

use std::sync::atomic::Ordering;

use super::{Limits, Machine};
use crate::executor::code::{Inst, Op};
use crate::executor::fault::Fault;
use crate::executor::lanes::{CHUNKS, Chunk, Mask};

impl Machine<'_> {
    /// Instructions that change which lanes run.
    pub(super) fn flow(&mut self, inst: &Inst, pc: &mut usize) {
        let (memory, mask) = (&mut self.memory, &mut self.mask);
        let go_on = match inst.op {
            Op::If => turn(memory, mask, inst, |active, _, a| {
                (active.and(a), active.and_not(a))
            }),
            Op::Else => turn(memory, mask, inst, |active, waiting, _| (waiting, active)),
            Op::EndIf => turn(memory, mask, inst, |active, waiting, _| {
                (active.or(waiting), waiting)
            }),
            Op::LeaveIf => turn(memory, mask, inst, |active, waiting, a| {
                (active.and_not(a), waiting.or(active.and(a)))
            }),
            Op::Join => turn(memory, mask, inst, |active, waiting, _| {
                (active.or(waiting), Chunk::ZERO)
            }),
            Op::Resume => turn(memory, mask, inst, |_, waiting, _| (waiting, waiting)),
            Op::Case => turn(memory, mask, inst, |_, waiting, a| {
                (waiting.and(a), waiting.and_not(a))
            }),
            Op::Leave => turn(memory, mask, inst, |active, waiting, _| {
                (Chunk::ZERO, waiting.or(active))
            }),
            Op::Clear => {
                for c in 0..CHUNKS {
                    memory[inst.d.chunk(c as u32)] = Chunk::ZERO;
                    memory[inst.a.chunk(c as u32)] = Chunk::ZERO;
                }
                true
            }
            _ => {
                self.mask.clear();
                false
            }
        };
        if !go_on {
            *pc = inst.x as usize;
        }
    }

    /// The end of a step of a loop.
    pub(super) fn repeat(
        &mut self,
        inst: &Inst,
        pc: &mut usize,
        limits: Limits,
    ) -> Result<(), Fault> {
        let (memory, steps) = (&mut self.memory, &mut self.steps);
        let any = self.mask.change(|c, active| {
            let k = c as u32;
            let ends = memory[inst.a.chunk(k)];
            let waiting = &mut memory[inst.d.chunk(k)];
            *waiting = waiting.or(active.and(ends));
            let now = active.and_not(ends);
            steps[c] = steps[c].zip(now, |n, runs| n + (runs & 1));
            now
        });
        if !any {
            return Ok(());
        }
        *pc = inst.x as usize;
        self.group_steps += 1;
        if self.group_steps.is_multiple_of(1024)
            && limits
                .cancel
                .is_some_and(|flag| flag.load(Ordering::Relaxed))
        {
            return Err(Fault::Cancelled);
        }
        if self.group_steps > limits.steps {
            let most = self.steps.iter().flat_map(|chunk| chunk.0).max();
            if most.unwrap_or(0) > limits.steps {
                let limit = limits.steps;
                return Err(Fault::Steps { limit });
            }
        }
        Ok(())
    }
}

/// Gives each chunk of the mask and of `d` another value, from the old ones and the operand; tells whether any lane runs.
#[inline(always)]
fn turn(
    memory: &mut [Chunk],
    mask: &mut Mask,
    inst: &Inst,
    f: impl Fn(Chunk, Chunk, Chunk) -> (Chunk, Chunk),
) -> bool {
    mask.change(|c, active| {
        let (d, a) = (inst.d.chunk(c as u32), inst.a.chunk(c as u32));
        let (now, waiting) = f(active, memory[d], memory[a]);
        memory[d] = waiting;
        now
    })
}
