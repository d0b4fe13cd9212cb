//! Which lanes run.

use std::sync::atomic::Ordering;

use super::{Limits, Machine};
use crate::executor::code::{Inst, Op};
use crate::executor::fault::{Fault, LoopKind, LoopSite};
use crate::executor::lanes::{CHUNKS, Chunk, Mask};

impl Machine<'_> {
    /// Instructions that change which lanes run.
    #[cfg_attr(not(debug_assertions), inline(always))]
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
            Op::Clear | Op::Enter => {
                if let (Op::Enter, Some(turns)) = (inst.op, self.turns.get_mut(inst.x as usize)) {
                    turns.since_entered = 0;
                }
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
    #[cfg_attr(not(debug_assertions), inline(always))]
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
        self.count(*pc, limits)
    }

    /// Counts a step of the loop whose first instruction is at `pc`.
    fn count(&mut self, pc: usize, limits: Limits) -> Result<(), Fault> {
        // the instruction before is the one that enters it
        let this = self.program.code[pc - 1].x as usize;
        let turns = &mut self.turns[this];
        turns.since_entered += 1;
        turns.in_all += 1;
        let place = &self.program.loops[this];
        let limit = match place.kind {
            LoopKind::Formula => limits.formula_turns,
            LoopKind::Scene | LoopKind::Samples => limits.turns,
        };
        if turns.since_entered > limit {
            let place = Some(place.clone());
            return Err(Fault::Turns { limit, place });
        }
        if place.kind == LoopKind::Samples {
            self.begin_sample();
        }
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
                let place = self.longest().cloned();
                return Err(Fault::Steps { limit, place });
            }
        }
        Ok(())
    }

    /// The loop that took the most steps.
    fn longest(&self) -> Option<&LoopSite> {
        let all = self.program.loops.iter().zip(&self.turns);
        Some(all.max_by_key(|(_, turns)| turns.in_all)?.0)
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
