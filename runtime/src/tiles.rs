//! How a picture is cut up so that no submission runs long and memory stays bounded.
//!
//! The picture is a stack of bands as wide as itself, which leave as rows. A band is worked off as a stack of
//! tiles: one that would take too long is halved. What is too long is known from the tiles before.

use std::time::Duration;

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

/// How many pixels the next submission may have.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Budget {
    pixels: f64,
    max_tile: u64,
    max_side: u32,
}

impl Budget {
    /// A small budget to start with: the first tile's shader calls are about `PROBE²`.
    /// No tile will have more than `max_pixels` pixels, nor a side above `max_side`.
    pub(crate) fn new(samples: u32, max_pixels: u64, max_side: u32) -> Self {
        let calls = f64::from(samples.max(1)).powi(2);
        Self {
            pixels: f64::from(PROBE * PROBE) / calls,
            max_tile: MAX_TILE.min(max_pixels),
            max_side,
        }
    }

    /// Learns from a tile that took `elapsed`.
    pub(crate) fn learn(&mut self, tile: Tile, elapsed: Duration) {
        let per_pixel = elapsed.as_secs_f64().max(1e-9) / tile.pixels().max(1) as f64;
        let fair = AIM.as_secs_f64() / per_pixel;
        // A small last tile says little about what large ones may be.
        let ceiling = self.pixels.max(tile.pixels() as f64 * GROWTH);
        self.pixels = fair.min(ceiling).clamp(1.0, self.max_tile as f64);
    }

    fn allows(&self, tile: Tile) -> bool {
        tile.pixels() as f64 <= self.pixels.min(self.max_tile as f64)
            && tile.width.max(tile.height) <= self.max_side
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
    let fitting = (budget.pixels as u64 / width).max(u64::from(PROBE));
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

    /// Runs the plan with a cost per pixel; returns how often each pixel was drawn and the longest submission.
    fn run(width: u32, height: u32, samples: u32, cost: impl Fn(Tile) -> f64) -> (Vec<u8>, f64) {
        let mut drawn = vec![0u8; (width * height) as usize];
        let mut longest = 0.0f64;
        let mut budget = Budget::new(samples, u64::MAX, 8192);
        let first = probe(width, height, samples);
        budget.learn(
            first,
            Duration::from_secs_f64(cost(first) * first.pixels() as f64),
        );
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
                for y in tile.y..tile.y + tile.height {
                    for x in tile.x..tile.x + tile.width {
                        drawn[(y * width + x) as usize] += 1;
                    }
                }
                let elapsed = cost(tile) * tile.pixels() as f64;
                longest = longest.max(elapsed);
                budget.learn(tile, Duration::from_secs_f64(elapsed));
            }
            top += rows;
        }
        (drawn, longest)
    }

    #[test]
    fn every_pixel_is_drawn_once_and_nothing_runs_long() {
        let check = |width: u32, height: u32, samples: u32, cost: f64| {
            let (drawn, longest) = run(width, height, samples, |_| cost);
            assert!(drawn.iter().all(|&n| n == 1), "{width}x{height} at {cost}");
            assert!(
                longest <= 0.2f64.max(cost * 64.0),
                "{width}x{height} at {cost}: {longest} s"
            );
        };
        for (width, height) in [
            (1, 1),
            (7, 3),
            (640, 480),
            (1, 2000),
            (9000, 3),
            (1001, 777),
        ] {
            for cost in [1e-9, 1e-7, 1e-5, 1e-2] {
                check(width, height, 1, cost);
                check(width, height, 4, cost);
            }
        }
    }

    #[test]
    fn cheap_sky_above_a_costly_centre() {
        let (drawn, longest) = run(800, 600, 1, |tile| {
            if tile.y + tile.height < 200 {
                1e-9
            } else {
                2e-6
            }
        });
        assert!(drawn.iter().all(|&n| n == 1));
        assert!(longest < 1.0, "{longest}");
    }
}
