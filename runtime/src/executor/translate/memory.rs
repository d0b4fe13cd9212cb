//! Results that are kept in their registers, to be used again where the same is computed of the same.
//!
//! What is computed in a block is known up to the block's end, for the lanes that ran through it, and in the blocks within.

use naga::{Function, Handle};

use super::{Parts, Translator};
use crate::executor::code::{Inst, Op};
use crate::executor::fault::Fault;
use crate::executor::lanes::Slot;

/// Most results that are kept at a time: what hashes of the 16 corners about a point in four dimensions share fits in.
const MOST: usize = 64;

/// What computes a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Maker {
    Op(Op),
    /// A function of nothing but its arguments.
    Function(Handle<Function>),
}

/// A result that is kept, with what it was computed of.
#[derive(Clone, Debug)]
struct Kept {
    maker: Maker,
    of: Parts,
    result: Slot,
    /// Of how many blocks that are open it is in the innermost.
    depth: usize,
}

/// What is kept, the latest use last.
#[derive(Debug, Default)]
pub(super) struct Memory {
    kept: Vec<Kept>,
    depth: usize,
}

impl Translator<'_> {
    /// The result of an instruction, computed once for all that use it in this block.
    pub(super) fn remembered(&mut self, op: Op, a: Slot, b: Slot) -> Result<Slot, Fault> {
        if let Some(known) = self.recall(Maker::Op(op), &[a, b]) {
            return Ok(known);
        }
        let d = self.result_of(&[a, b])?;
        self.emit(Inst::new(op).to(d).of(a).and(b));
        self.remember(Maker::Op(op), vec![a, b], d);
        Ok(d)
    }

    /// A result that is known, for as long as the expression at hand.
    pub(super) fn recall(&mut self, maker: Maker, of: &[Slot]) -> Option<Slot> {
        let kept = &mut self.memory.kept;
        let place = kept.iter().position(|k| k.maker == maker && k.of == of)?;
        kept[place..].rotate_left(1);
        let result = kept[kept.len() - 1].result;
        self.frame.retain(result);
        self.temporaries.push(result);
        Some(result)
    }

    /// Keeps a result.
    pub(super) fn remember(&mut self, maker: Maker, of: Parts, result: Slot) {
        for &slot in of.iter().chain([&result]) {
            self.frame.retain(slot);
        }
        let depth = self.memory.depth;
        self.memory.kept.push(Kept {
            maker,
            of,
            result,
            depth,
        });
        if self.memory.kept.len() > MOST {
            let oldest = self.memory.kept.remove(0);
            self.forget_kept(&oldest);
        }
    }

    /// A block begins: all lanes in it have come through those about it.
    pub(super) fn open_block(&mut self) {
        self.memory.depth += 1;
    }

    /// The block that was opened last ends: other lanes may join.
    pub(super) fn close_block(&mut self) {
        let depth = self.memory.depth;
        let all = std::mem::take(&mut self.memory.kept);
        let (ended, kept): (Vec<_>, Vec<_>) = all.into_iter().partition(|k| k.depth >= depth);
        self.memory.kept = kept;
        self.memory.depth = depth.saturating_sub(1);
        for kept in &ended {
            self.forget_kept(kept);
        }
    }

    fn forget_kept(&mut self, kept: &Kept) {
        for &slot in kept.of.iter().chain([&kept.result]) {
            self.frame.release(slot);
        }
    }
}
