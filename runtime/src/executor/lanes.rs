//! Lanes: one word of every lane of a group, side by side, eight to a chunk.

use std::cell::Cell;

/// Lanes of a chunk: what is skipped as a whole where none of them is active.
pub(super) const WIDTH: usize = 8;
/// Chunks of a group.
pub(super) const CHUNKS: usize = 8;
/// Lanes of a group, which run the same instruction together.
pub(super) const LANES: usize = WIDTH * CHUNKS;

/// A truth value as a word: all bits are the same, so that it serves as a mask.
pub(super) const TRUE: u64 = u64::MAX;

/// A word of each of eight lanes. Numbers are held by their bits, those of 32 bits in the lower half.
#[repr(align(64))]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Chunk(pub [u64; WIDTH]);

impl Chunk {
    pub const ZERO: Self = Self([0; WIDTH]);

    pub fn splat(word: u64) -> Self {
        Self([word; WIDTH])
    }

    #[inline(always)]
    pub fn map(self, f: impl Fn(u64) -> u64) -> Self {
        Self(std::array::from_fn(|i| f(self.0[i])))
    }

    #[inline(always)]
    pub fn zip(self, other: Self, f: impl Fn(u64, u64) -> u64) -> Self {
        Self(std::array::from_fn(|i| f(self.0[i], other.0[i])))
    }

    #[inline(always)]
    pub fn and(self, other: Self) -> Self {
        self.zip(other, |a, b| a & b)
    }

    #[inline(always)]
    pub fn or(self, other: Self) -> Self {
        self.zip(other, |a, b| a | b)
    }

    #[inline(always)]
    pub fn and_not(self, other: Self) -> Self {
        self.zip(other, |a, b| a & !b)
    }

    /// `self` where the mask is set, else `other`.
    #[inline(always)]
    pub fn blend(self, other: Self, mask: Self) -> Self {
        Self(std::array::from_fn(|i| {
            other.0[i] ^ ((other.0[i] ^ self.0[i]) & mask.0[i])
        }))
    }

    #[inline(always)]
    pub fn any(self) -> bool {
        self.0.iter().fold(0, |all, &word| all | word) != 0
    }
}

/// Where the words of a value are in memory: of all lanes one after another, or one chunk for all of them where every
/// lane has the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Slot {
    at: u32,
    /// The bits of a chunk's number that count: all, or none.
    bits: u32,
}

/// The bits of a chunk's number.
const BITS: u32 = CHUNKS as u32 - 1;
const _: () = assert!(CHUNKS.is_power_of_two());

/// The chunks of a slot.
pub(super) struct Row<'m> {
    chunks: &'m [Cell<Chunk>; CHUNKS],
    bits: u32,
}

impl Row<'_> {
    /// One of the group's chunks.
    #[inline(always)]
    pub fn get(&self, c: u32) -> Chunk {
        self.chunks[(c & self.bits & BITS) as usize].get()
    }

    #[inline(always)]
    pub fn set(&self, c: u32, chunk: Chunk) {
        self.chunks[(c & self.bits & BITS) as usize].set(chunk);
    }
}

impl Slot {
    /// The k-th uniform.
    pub fn uniform(k: u32) -> Self {
        Self { at: k, bits: 0 }
    }

    /// The k-th register.
    pub fn register(k: u32) -> Self {
        Self { at: k, bits: BITS }
    }

    pub fn is_uniform(self) -> bool {
        self.bits == 0
    }

    /// Which uniform or register it is, until it is placed.
    pub fn number(self) -> u32 {
        self.at
    }

    /// The place in a memory that begins with so many uniforms.
    pub fn placed(self, uniforms: u32) -> Self {
        if self.is_uniform() {
            return self;
        }
        let at = uniforms + self.at * CHUNKS as u32;
        Self { at, ..self }
    }

    /// The next of a row of slots that are of one kind, `k` further; for those that are placed.
    pub fn further(self, k: usize) -> Self {
        let distance = if self.is_uniform() { 1 } else { CHUNKS };
        let at = self.at + (k * distance) as u32;
        Self { at, ..self }
    }

    /// The chunk's place in memory.
    #[inline(always)]
    pub fn chunk(self, c: u32) -> usize {
        (self.at + (self.bits & c)) as usize
    }

    /// Its chunks in a memory, which goes on for a group behind the last slot.
    #[allow(clippy::expect_used, reason = "the slice has the length of the array")]
    #[inline(always)]
    pub fn row(self, memory: &[Cell<Chunk>]) -> Row<'_> {
        let start = self.at as usize;
        let chunks = <&[_; CHUNKS]>::try_from(&memory[start..start + CHUNKS]);
        Row {
            chunks: chunks.expect("as many chunks as a group has"),
            bits: self.bits,
        }
    }
}

/// Which lanes run.
#[derive(Clone, Debug)]
pub(super) struct Mask {
    /// All bits of a lane's word are set where it runs.
    pub lanes: [Chunk; CHUNKS],
    /// The chunks with a lane that runs.
    list: [u32; CHUNKS],
    count: usize,
}

impl Mask {
    pub fn none() -> Self {
        Self {
            lanes: [Chunk::ZERO; CHUNKS],
            list: [0; CHUNKS],
            count: 0,
        }
    }

    /// The first `count` lanes.
    pub fn first(count: usize) -> Self {
        let mut mask = Self::none();
        mask.change(|c, _| {
            Chunk(std::array::from_fn(|i| {
                if c * WIDTH + i < count { TRUE } else { 0 }
            }))
        });
        mask
    }

    /// Gives each chunk another mask; tells whether any lane runs.
    #[inline(always)]
    pub fn change(&mut self, mut chunk: impl FnMut(usize, Chunk) -> Chunk) -> bool {
        self.count = 0;
        for c in 0..CHUNKS {
            self.lanes[c] = chunk(c, self.lanes[c]);
            self.list[self.count] = c as u32;
            self.count += usize::from(self.lanes[c].any());
        }
        self.count > 0
    }

    /// No lane runs.
    pub fn clear(&mut self) {
        self.lanes = [Chunk::ZERO; CHUNKS];
        self.count = 0;
    }

    /// Whether all lanes run.
    pub fn is_full(&self) -> bool {
        self.lanes.iter().all(|chunk| *chunk == Chunk::splat(TRUE))
    }

    /// Parts of the group, of so many chunks each, with a lane that runs.
    pub fn parts(&self, chunks: u32) -> u64 {
        let mut parts = 0;
        let mut last = None;
        for &c in self.chunks() {
            let part = Some(c / chunks);
            parts += u64::from(part != last);
            last = part;
        }
        parts
    }

    /// The chunks with a lane that runs.
    #[inline(always)]
    pub fn chunks(&self) -> &[u32] {
        &self.list[..self.count]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn masks_list_their_chunks() {
        let mut mask = Mask::first(11);
        assert_eq!(mask.chunks(), [0, 1]);
        assert!(mask.change(|c, lanes| if c == 0 { Chunk::ZERO } else { lanes }));
        assert_eq!(mask.chunks(), [1]);
        mask.clear();
        assert!(mask.chunks().is_empty());
        assert_eq!(Mask::first(LANES).chunks().len(), CHUNKS);
    }

    #[test]
    fn slots_find_their_chunks() {
        let uniform = Slot::uniform(3).placed(10);
        assert_eq!((uniform.chunk(5), uniform.further(2).chunk(1)), (3, 5));
        let register = Slot::register(2).placed(10);
        assert_eq!(register.chunk(1), 10 + 2 * CHUNKS + 1);
        assert_eq!(register.further(1).chunk(0), 10 + 3 * CHUNKS);
    }

    #[test]
    fn blends() {
        let mask = Chunk(std::array::from_fn(|i| if i < 3 { TRUE } else { 0 }));
        let blended = Chunk::splat(7).blend(Chunk::splat(9), mask);
        assert_eq!(blended.0, [7, 7, 7, 9, 9, 9, 9, 9]);
    }
}
