//! How a picture is cut up so that no submission runs long and memory stays bounded.
//!
//! The picture is a stack of bands as wide as itself, which leave as rows. A band is worked off as a stack of tiles:
//! one that would take too long is halved, or its samples are spread over several submissions. What is too long is
//! known from the tiles before.

use std::time::Duration;

use crate::render::Size;

/// What a submission should take. Costs differ across a picture, so the aim lies below the bound of 200 ms.
const AIM: Duration = Duration::from_millis(80);
/// Workgroups are 8×8: tiles are cut at multiples of this.
const CELL: u32 = 8;
/// Side of the first tile, that is measured at the centre of the picture.
const PROBE: u32 = 64;
/// Most pixels in one tile.
const MAX_TILE: u64 = 1 << 20;
/// Most pixels in one band, however wide: 64 MiB in 8 bits, 256 MiB in linear light.
const MAX_BAND: u64 = 1 << 24;
/// Pixels that keep every core of a large GPU busy.
const FILLING: u64 = 1 << 17;
/// Largest growth of the budget from one tile to the next.
const GROWTH: f64 = 4.0;

/// A rectangle of pixels of the whole image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Tile {
    pub x: u32,
    pub y: u32,
    pub width: u32,
    pub height: u32,
}

impl Tile {
    pub(crate) fn pixels(self) -> u64 {
        u64::from(self.width) * u64::from(self.height)
    }

    /// Two halves across the longer side, cut at a multiple of [`CELL`]; none if it is one cell.
    fn halves(self) -> Option<(Self, Self)> {
        let cut = |length: u32| (length.div_ceil(CELL) / 2) * CELL;
        if self.width >= self.height {
            let left = cut(self.width);
            (left > 0).then(|| {
                let first = Self {
                    width: left,
                    ..self
                };
                let second = Self {
                    x: self.x + left,
                    width: self.width - left,
                    ..self
                };
                (first, second)
            })
        } else {
            let top = cut(self.height);
            (top > 0).then(|| {
                let first = Self {
                    height: top,
                    ..self
                };
                let second = Self {
                    y: self.y + top,
                    height: self.height - top,
                    ..self
                };
                (first, second)
            })
        }
    }
}

/// How much the next submission may have, in shader calls: one for each sample of each of its pixels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Budget {
    calls: f64,
    /// Samples of a pixel.
    samples: u32,
    /// Most samples of a pixel in a submission.
    most: u32,
    /// Pixels that the adapter should have to be busy: a tile of fewer gets fewer samples at a time instead.
    filling: u64,
    max_tile: u64,
    max_side: u32,
}

impl Budget {
    /// A small budget to start with: `PROBE²` calls, with all samples of a pixel in one submission while single cells
    /// allow it. No tile will have more than `max_pixels` pixels, nor a side above `max_side`. Samples are counted
    /// per axis.
    pub(crate) fn new(samples: u32, max_pixels: u64, max_side: u32) -> Self {
        let samples = samples.max(1).pow(2);
        Self {
            calls: f64::from(PROBE * PROBE),
            samples,
            most: samples,
            filling: u64::from(CELL * CELL),
            max_tile: MAX_TILE.min(max_pixels),
            max_side,
        }
    }

    /// The budget for an adapter that computes many pixels at once, and a picture of this size.
    pub(crate) fn filling(self, size: Size) -> Self {
        let picture = u64::from(size.width) * u64::from(size.height);
        Self {
            filling: FILLING.min(picture).min(self.max_tile),
            ..self
        }
    }

    /// With at most so many samples of a pixel in a submission, at least one.
    pub(crate) fn with_most(self, most: u32) -> Self {
        Self {
            most: most.clamp(1, self.samples),
            ..self
        }
    }

    /// Learns from a submission with `samples` samples of each pixel of a tile that took `elapsed`.
    pub(crate) fn learn(&mut self, tile: Tile, samples: u32, elapsed: Duration) {
        let calls = tile.pixels().max(1) as f64 * f64::from(samples.max(1));
        let per_call = elapsed.as_secs_f64().max(1e-9) / calls;
        let fair = AIM.as_secs_f64() / per_call;
        // A small last tile says little about what large ones may be.
        let ceiling = self.calls.max(calls * GROWTH);
        let largest = self.max_tile as f64 * f64::from(self.samples);
        self.calls = fair.min(ceiling).clamp(1.0, largest);
    }

    /// How many samples of each pixel of a tile the next submission may have; at least one.
    pub(crate) fn share(&self, tile: Tile) -> u32 {
        let share = self.calls / tile.pixels().max(1) as f64;
        (share as u32).clamp(1, self.most)
    }

    /// Pixels of the next tile.
    fn pixels(&self) -> f64 {
        let samples = (self.calls / self.filling.max(1) as f64).floor();
        let samples = samples.clamp(1.0, f64::from(self.most));
        (self.calls / samples).clamp(1.0, self.max_tile as f64)
    }

    fn allows(&self, tile: Tile) -> bool {
        tile.pixels() as f64 <= self.pixels() && tile.width.max(tile.height) <= self.max_side
    }
}

/// The tile to be measured first and thrown away, at the centre where pictures are costly.
pub(crate) fn probe(width: u32, height: u32, samples: u32) -> Tile {
    let side = (PROBE / samples.max(1)).max(CELL);
    let (w, h) = (side.min(width), side.min(height));
    Tile {
        x: (width - w) / 2,
        y: (height - h) / 2,
        width: w,
        height: h,
    }
}

/// Height of the next band of an image of this width with `left` rows to go.
pub(crate) fn band_height(width: u32, left: u32, budget: &Budget) -> u32 {
    let width = u64::from(width.max(1));
    let fitting = (budget.pixels() as u64 / width).max(u64::from(PROBE));
    let rows = fitting.min(MAX_BAND / width).max(u64::from(CELL));
    let rows = u32::try_from(rows - rows % u64::from(CELL)).unwrap_or(CELL);
    rows.min(left)
}

/// The tiles of a band that are still to be done.
#[derive(Debug)]
pub(crate) struct Pending(Vec<Tile>);

impl Pending {
    pub(crate) fn new(band: Tile) -> Self {
        Self(vec![band])
    }

    /// The next tile within the budget, or a single cell if even that is above it.
    pub(crate) fn next(&mut self, budget: &Budget) -> Option<Tile> {
        let mut tile = self.0.pop()?;
        while !budget.allows(tile) {
            let Some((first, second)) = tile.halves() else {
                break;
            };
            self.0.push(second);
            tile = first;
        }
        Some(tile)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What became of a plan.
    struct Run {
        /// How many samples of each pixel were computed.
        drawn: Vec<u32>,
        /// The longest submission in seconds.
        longest: f64,
        submissions: u32,
    }

    /// Runs the plan with a cost per shader call.
    fn run(size: Size, samples: u32, budget: Budget, cost: impl Fn(Tile) -> f64) -> Run {
        let Size { width, height } = size;
        let mut run = Run {
            drawn: vec![0; (width * height) as usize],
            longest: 0.0,
            submissions: 0,
        };
        let mut budget = budget;
        let first = probe(width, height, samples);
        let share = budget.share(first);
        assert!(first.pixels() * u64::from(share) <= u64::from(PROBE * PROBE));
        let elapsed = cost(first) * first.pixels() as f64 * f64::from(share);
        budget.learn(first, share, Duration::from_secs_f64(elapsed));
        let mut submit = |budget: &mut Budget, tile: Tile, count: u32| {
            let elapsed = cost(tile) * tile.pixels() as f64 * f64::from(count);
            run.longest = run.longest.max(elapsed);
            run.submissions += 1;
            budget.learn(tile, count, Duration::from_secs_f64(elapsed));
        };
        let mut top = 0;
        while top < height {
            let rows = band_height(width, height - top, &budget);
            let mut pending = Pending::new(Tile {
                x: 0,
                y: top,
                width,
                height: rows,
            });
            while let Some(tile) = pending.next(&budget) {
                assert!(tile.width <= 8192 && tile.height <= 8192);
                assert!(tile.x % CELL == 0 && (tile.y - top) % CELL == 0);
                let mut done = 0;
                while done < samples * samples {
                    let count = budget.share(tile).min(samples * samples - done);
                    submit(&mut budget, tile, count);
                    done += count;
                }
                for y in tile.y..tile.y + tile.height {
                    for x in tile.x..tile.x + tile.width {
                        run.drawn[(y * width + x) as usize] += done;
                    }
                }
            }
            top += rows;
        }
        run
    }

    #[test]
    fn every_sample_is_drawn_once_and_nothing_runs_long() {
        let check = |(width, height): (u32, u32), samples: u32, cost: f64| {
            let size = Size { width, height };
            let whole = Budget::new(samples, u64::MAX, 8192);
            for budget in [whole, whole.filling(size), whole.with_most(3)] {
                let run = run(size, samples, budget, |_| cost);
                let expected = samples * samples;
                assert!(
                    run.drawn.iter().all(|&n| n == expected),
                    "{size:?} at {cost}"
                );
                // one sample of a cell is the least
                let bound = 0.2f64.max(cost * 64.0);
                assert!(run.longest <= bound, "{size:?}, {cost}: {}", run.longest);
            }
        };
        for size in [
            (1, 1),
            (7, 3),
            (640, 480),
            (1, 2000),
            (9000, 3),
            (1001, 777),
        ] {
            for cost in [1e-9, 1e-7, 1e-5, 1e-3] {
                check(size, 1, cost);
                check(size, 4, cost);
            }
        }
    }

    #[test]
    fn costly_samples_are_spread_before_tiles_get_small() {
        let size = Size {
            width: 1280,
            height: 1024,
        };
        let whole = Budget::new(4, u64::MAX, 8192);
        // 80 ms are 160,000 calls: all pixels that fill the adapter, with one sample each
        let filled = run(size, 4, whole.filling(size), |_| 5e-7);
        let cells = run(size, 4, whole, |_| 5e-7);
        let fewest = (1280.0 * 1024.0 * 16.0 * 5e-7 / 0.08) as u32;
        assert!(filled.submissions <= 3 * fewest, "{}", filled.submissions);
        assert!(cells.submissions <= 3 * fewest, "{}", cells.submissions);
        let mut budget = whole.filling(size);
        let tile = Tile {
            x: 0,
            y: 0,
            width: 512,
            height: 256,
        };
        budget.learn(tile, 1, Duration::from_millis(60));
        assert!(budget.allows(tile) && budget.share(tile) == 1);
        budget.learn(tile, 1, Duration::from_millis(1));
        assert!(budget.share(tile) > 1);
    }

    #[test]
    fn cheap_sky_above_a_costly_centre() {
        let size = Size {
            width: 800,
            height: 600,
        };
        let budget = Budget::new(1, u64::MAX, 8192);
        let run = run(size, 1, budget, |tile| {
            if tile.y + tile.height < 200 {
                1e-9
            } else {
                2e-6
            }
        });
        assert!(run.drawn.iter().all(|&n| n == 1));
        assert!(run.longest < 1.0, "{}", run.longest);
    }
}
