//! Registers of a function while it is translated.

use crate::executor::fault::Fault;
use crate::executor::lanes::Slot;

/// Most registers of a program: 512 bytes each.
const MAX_REGISTERS: u32 = 1 << 20;

/// Which registers are in use. Functions that never run together share theirs: a function's begin above those of all that
/// it calls.
#[derive(Debug, Default)]
pub(super) struct Frame {
    /// How often each is needed, from the first of the function on.
    uses: Vec<u32>,
    free: Vec<u32>,
    base: u32,
}

impl Frame {
    pub fn new(base: u32) -> Self {
        Self {
            base,
            ..Self::default()
        }
    }

    /// The first register above this function's.
    pub fn top(&self) -> u32 {
        self.base + self.uses.len() as u32
    }

    /// A register that nothing uses, for one user.
    pub fn take(&mut self) -> Result<Slot, Fault> {
        if let Some(k) = self.free.pop() {
            self.uses[k as usize] = 1;
            return Ok(Slot::register(self.base + k));
        }
        self.row(1)
    }

    /// Registers one after another, for one user each; gives the first.
    pub fn row(&mut self, count: u32) -> Result<Slot, Fault> {
        let first = self.top();
        if first.saturating_add(count) > MAX_REGISTERS {
            let construct = format!("a function of more than {MAX_REGISTERS} values at a time");
            return Err(Fault::unsupported(construct));
        }
        self.uses.extend(std::iter::repeat_n(1, count as usize));
        Ok(Slot::register(first))
    }

    fn place(&self, slot: Slot) -> Option<usize> {
        if slot.is_uniform() {
            return None;
        }
        let place = slot.number().checked_sub(self.base)? as usize;
        (place < self.uses.len()).then_some(place)
    }

    /// One more user.
    pub fn retain(&mut self, slot: Slot) {
        if let Some(place) = self.place(slot) {
            self.uses[place] += 1;
        }
    }

    /// One user less.
    pub fn release(&mut self, slot: Slot) {
        if let Some(place) = self.place(slot) {
            self.uses[place] = self.uses[place].saturating_sub(1);
            if self.uses[place] == 0 {
                self.free.push(place as u32);
            }
        }
    }
}
