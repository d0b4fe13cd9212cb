//! Running a program, one group of lanes at a time.

mod compute;
mod control;
#[cfg(test)]
mod tests;

use std::sync::atomic::AtomicBool;

use pulp::{Arch, Simd, WithSimd};

use super::code::{Inst, Op};
use super::cost::{Issued, WARP};
use super::fault::Fault;
use super::kernels::write;
use super::lanes::{CHUNKS, Chunk, LANES, Mask, Slot, TRUE, WIDTH};
use super::program::Program;
use super::trace::{Event, Observer};

/// Steps of all loops together that a sample of a pixel, or a row, may take, unless told otherwise.
pub const MAX_STEPS: u64 = 1 << 22;

/// Steps that one loop of a scene may take from when it is entered until it is left, unless told otherwise: twice as many as
/// any setting asks for.
pub const MAX_TURNS: u64 = 1 << 14;

/// Steps that one loop of a formula may take so, unless told otherwise; the language allows 100,000.
pub const MAX_FORMULA_TURNS: u64 = 1 << 17;

/// Bounds of a run.
#[derive(Clone, Copy, Debug)]
pub struct Limits<'a> {
    /// Steps that the loops of one invocation may take in all; of a pixel, for each of its samples.
    pub steps: u64,
    /// Steps that one loop of a scene may take from when it is entered until it is left.
    pub turns: u64,
    /// Steps that one loop of a formula may take so.
    pub formula_turns: u64,
    /// Ends the run when it is set.
    pub cancel: Option<&'a AtomicBool>,
}

impl Default for Limits<'_> {
    fn default() -> Self {
        Self {
            steps: MAX_STEPS,
            turns: MAX_TURNS,
            formula_turns: MAX_FORMULA_TURNS,
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
    /// Steps of each lane's loops, in the sample at hand.
    steps: Vec<Chunk>,
    /// Steps of the group's loops, at least as many as any lane's.
    group_steps: u64,
    /// Of each loop, the group's steps since it was entered, and all of them.
    turns: Vec<Turns>,
    /// What was issued, if that is counted.
    issued: Option<Issued>,
}

/// How often a group has gone through a loop. No lane joins a loop that runs, so that those in it have all made every step
/// since it was entered.
#[derive(Clone, Copy, Debug, Default)]
struct Turns {
    since_entered: u64,
    in_all: u64,
}

/// What a machine is about to run, in code for the vector instructions of this very processor.
struct Run<'r, 'p> {
    machine: &'r mut Machine<'p>,
    limits: Limits<'r>,
    observer: &'r mut dyn Observer,
}

impl WithSimd for Run<'_, '_> {
    type Output = Result<(), Fault>;

    // What is to be compiled for those instructions has to be written out in here. Not where nothing is optimised: all in one
    // frame would take a large stack.
    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Self::Output {
        self.machine.execute(self.limits, self.observer)
    }
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
            turns: vec![Turns::default(); program.loops.len()],
            issued: None,
        }
    }

    /// Counts from now on what is issued.
    pub fn count_issued(&mut self) {
        self.issued = Some(self.program.nothing_issued());
    }

    /// What was issued since it is counted.
    #[must_use]
    pub fn issued(&self) -> Option<&Issued> {
        self.issued.as_ref()
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
        if let Some(issued) = &mut self.issued {
            issued.begin();
        }
        self.begin_sample();
        let machine = self;
        Arch::new().dispatch(Run {
            machine,
            limits,
            observer,
        })
    }

    /// Counts steps in all from here on.
    fn begin_sample(&mut self) {
        self.steps.fill(Chunk::ZERO);
        self.group_steps = 0;
        for turns in &mut self.turns {
            turns.in_all = 0;
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn execute(&mut self, limits: Limits, observer: &mut dyn Observer) -> Result<(), Fault> {
        let program = self.program;
        let mut pc = 0;
        while let Some(inst) = program.code.get(pc) {
            if let Some(issued) = &mut self.issued {
                let warps = self.mask.parts((WARP / WIDTH) as u32);
                issued.issue(pc, inst, warps, self.mask.is_full());
            }
            pc += 1;
            match inst.op {
                Op::If
                | Op::Else
                | Op::EndIf
                | Op::Clear
                | Op::Enter
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

    fn trace(&self, inst: &Inst, observer: &mut dyn Observer) {
        let site = &self.program.sites[inst.x as usize];
        let mut values = Vec::with_capacity(site.parts.len());
        for lane in 0..LANES {
            let (c, i) = (lane / WIDTH, lane % WIDTH);
            if self.mask.lanes[c].0[i] != TRUE {
                continue;
            }
            let parts = site.parts.iter();
            let words = parts.map(|slot| self.memory[slot.chunk(c as u32)].0[i]);
            values.clear();
            values.extend(site.shown(words));
            let values = &values;
            observer.event(lane, &Event { site, values });
        }
    }
}
