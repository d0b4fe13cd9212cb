//! Running a program, one group of lanes at a time.

use std::sync::atomic::{AtomicBool, Ordering};

use super::code::{BEYOND, Form, Inst, Op};
use super::fault::Fault;
use super::kernels::{self, Lanes, each_lane, map1, map2, write};
use super::lanes::{CHUNKS, Chunk, LANES, Mask, Slot, TRUE, WIDTH};
use super::program::Program;
use super::trace::{Event, Observer};

/// Steps of all loops together that an invocation may take, unless told otherwise.
pub const MAX_STEPS: u64 = 1 << 28;

/// Bounds of a run.
#[derive(Clone, Copy, Debug)]
pub struct Limits<'a> {
    /// Steps that the loops of one invocation may take in all.
    pub steps: u64,
    /// Ends the run when it is set.
    pub cancel: Option<&'a AtomicBool>,
}

impl Default for Limits<'_> {
    fn default() -> Self {
        Self {
            steps: MAX_STEPS,
            cancel: None,
        }
    }
}

/// A program with the memory to run it in. Nothing is kept from group to group but uniforms and buffers.
#[derive(Debug)]
pub struct Machine<'p> {
    program: &'p Program,
    memory: Vec<Chunk>,
    mask: Mask,
    returns: Vec<(usize, Slot)>,
    buffers: Vec<Vec<u64>>,
    /// Steps of each lane's loops.
    steps: Vec<Chunk>,
    /// Steps of the group's loops, at least as many as any lane's.
    group_steps: u64,
}

impl<'p> Machine<'p> {
    /// Lanes of a group.
    pub const LANES: usize = LANES;

    /// Memory for a program, with its constants; uniforms are zero and buffers empty.
    #[must_use]
    pub fn new(program: &'p Program) -> Self {
        let mut memory = vec![Chunk::ZERO; program.chunks()];
        for (chunk, &word) in memory.iter_mut().zip(&program.uniforms) {
            *chunk = Chunk::splat(word);
        }
        Self {
            program,
            memory,
            mask: Mask::none(),
            returns: Vec::new(),
            buffers: vec![Vec::new(); program.buffers.len()],
            steps: vec![Chunk::ZERO; CHUNKS],
            group_steps: 0,
        }
    }

    /// Bytes of memory that the machine holds beside its buffers.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.memory.len() * size_of::<Chunk>()
    }

    /// Sets the word of a component of a uniform.
    pub fn set_uniform(&mut self, component: &super::program::Component, word: u64) {
        if let Some(chunk) = self.memory.get_mut(component.slot.chunk(0)) {
            *chunk = Chunk::splat(word);
        }
    }

    /// The words of a buffer, one for each component of its elements.
    pub fn buffer(&mut self, k: usize) -> Option<&mut Vec<u64>> {
        self.buffers.get_mut(k)
    }

    /// Sets the word of a component of the arguments for a lane.
    pub fn set_argument(&mut self, k: usize, lane: usize, word: u64) {
        let Some(component) = self.program.arguments.get(k) else {
            return;
        };
        let c = (lane / WIDTH % CHUNKS) as u32;
        write(&mut self.memory, component.slot, c, lane % WIDTH, word);
    }

    /// The word of a component of the results for a lane; 0 where there is none.
    #[must_use]
    pub fn result(&self, k: usize, lane: usize) -> u64 {
        let Some(component) = self.program.results.get(k) else {
            return 0;
        };
        let c = (lane / WIDTH % CHUNKS) as u32;
        self.memory[component.slot.chunk(c)].0[lane % WIDTH]
    }

    /// Runs the first `count` lanes.
    ///
    /// # Errors
    /// [`Fault::Steps`] and [`Fault::Cancelled`].
    pub fn run(&mut self, count: usize, limits: Limits) -> Result<(), Fault> {
        self.run_observed(count, limits, &mut ())
    }

    /// Runs the first `count` lanes of a program that was made to be traced, and shows what they compute.
    ///
    /// # Errors
    /// As [`Self::run`].
    pub fn run_observed(
        &mut self,
        count: usize,
        limits: Limits,
        observer: &mut dyn Observer,
    ) -> Result<(), Fault> {
        self.mask = Mask::first(count.min(LANES));
        self.returns.clear();
        self.steps.fill(Chunk::ZERO);
        self.group_steps = 0;
        self.execute(limits, observer)
    }

    fn execute(&mut self, limits: Limits, observer: &mut dyn Observer) -> Result<(), Fault> {
        let program = self.program;
        let mut pc = 0;
        while let Some(inst) = program.code.get(pc) {
            pc += 1;
            match inst.op {
                Op::If
                | Op::Else
                | Op::EndIf
                | Op::Clear
                | Op::Leave
                | Op::LeaveIf
                | Op::Join
                | Op::Resume
                | Op::Case
                | Op::Quit => self.flow(inst, &mut pc),
                Op::Repeat => self.repeat(inst, &mut pc, limits)?,
                Op::Jump => pc = inst.x as usize,
                Op::Call => {
                    for c in 0..CHUNKS {
                        self.memory[inst.d.chunk(c as u32)] = self.mask.lanes[c];
                    }
                    self.returns.push((pc, inst.d));
                    pc = inst.x as usize;
                }
                Op::End => match self.returns.pop() {
                    None => return Ok(()),
                    Some((back, saved)) => {
                        let memory = &self.memory;
                        self.mask.change(|c, _| memory[saved.chunk(c as u32)]);
                        pc = back;
                    }
                },
                Op::LoadBuffer | Op::StoreBuffer => self.buffer_access(inst),
                Op::Trace => self.trace(inst, observer),
                _ => self.compute(inst),
            }
        }
        Ok(())
    }

    /// Instructions that change which lanes run.
    fn flow(&mut self, inst: &Inst, pc: &mut usize) {
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
    fn repeat(&mut self, inst: &Inst, pc: &mut usize, limits: Limits) -> Result<(), Fault> {
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

    /// Instructions that compute.
    fn compute(&mut self, inst: &Inst) {
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

    fn buffer_access(&mut self, inst: &Inst) {
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

    fn trace(&self, inst: &Inst, observer: &mut dyn Observer) {
        let site = &self.program.sites[inst.x as usize];
        for lane in 0..LANES {
            let (c, i) = (lane / WIDTH, lane % WIDTH);
            if self.mask.lanes[c].0[i] != TRUE {
                continue;
            }
            let words: Vec<u64> = site
                .parts
                .iter()
                .map(|slot| self.memory[slot.chunk(c as u32)].0[i])
                .collect();
            observer.event(lane, &Event::new(site, &words));
        }
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
