//! Differences as the eye sees them.
//!
//! FLIP (P. Andersson, J. Nilsson, T. Akenine-Möller, M. Oskarsson, K. Åström, M. Fairchild, "FLIP: a difference
//! evaluator for alternating images", Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020), by its authors' code:
//! what is noticed in a pixel, from 0 to 1, where one flips between both pictures.

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::mpsc;
use std::thread;

use super::Bitmap;
use crate::{Error, Metadata, Size, image_file};

/// Pixels per degree of the field of view: a monitor 0.7 m wide with 3840 pixels, 0.7 m away.
pub const PIXELS_PER_DEGREE: f32 = 3840.0 * std::f32::consts::PI / 180.0;

/// Rows of a stripe, which bounds the memory.
const STRIPE: u32 = 128;
/// Rows that each stripe sees beyond its own. At [`PIXELS_PER_DEGREE`] the filter of contrast sensitivity reaches 10
/// pixels and that of edges and points 9.
const MARGIN: u32 = 24;

/// What is seen of the difference of two pictures.
#[derive(Clone, Debug)]
pub struct Perceptual {
    size: Size,
    /// FLIP of each pixel.
    map: Vec<f32>,
    /// Its mean, which its authors propose as the one number.
    pub mean: f64,
    /// Its least value that 99.9 % of the pixels do not exceed.
    pub p999: f64,
    /// Its greatest value.
    pub max: f64,
    /// Where that is: column and row from the top left, the first of several.
    pub worst: [u32; 2],
}

impl Perceptual {
    /// Of pictures of one size.
    pub fn new(
        truth: &Bitmap,
        test: &Bitmap,
        progress: &mut dyn FnMut(u64, u64),
    ) -> Result<Self, Error> {
        let size = truth.size();
        let map = by_stripes(truth, test, STRIPE, progress)?;
        let total = map.len().max(1);
        let mean = map.iter().map(|&x| f64::from(x)).sum::<f64>() / total as f64;
        let mut sorted = map.clone();
        let rank = (total - total / 1000).saturating_sub(1);
        let p999 = if sorted.is_empty() {
            0.0
        } else {
            *sorted.select_nth_unstable_by(rank, f32::total_cmp).1
        };
        let (mut at, mut max) = (0, 0.0);
        for (place, &value) in map.iter().enumerate() {
            if value > max {
                (at, max) = (place, value);
            }
        }
        let width = size.width.max(1) as usize;
        Ok(Self {
            size,
            mean,
            p999: p999.into(),
            max: max.into(),
            worst: [(at % width) as u32, (at / width) as u32],
            map,
        })
    }

    /// The value of each pixel, rows from top to bottom.
    #[must_use]
    pub fn map(&self) -> &[f32] {
        &self.map
    }

    /// Writes the picture of the differences: magma, the palette of FLIP's authors, from black (not to be seen) over
    /// violet and orange to pale yellow (as different as can be).
    ///
    /// # Errors
    /// [`Error::Io`]; there is no file then.
    pub fn write_heat_map(&self, path: &std::path::Path, metadata: &Metadata) -> Result<(), Error> {
        let heat = heat(&self.map);
        image_file::write_png(path, self.size, metadata, |sink| {
            let row = 4 * self.size.width.max(1) as usize;
            heat.chunks(row).try_for_each(|row| sink.rows(row))?;
            Ok(())
        })
    }
}

/// Values from 0 to 1 in magma, four bytes each.
fn heat(values: &[f32]) -> Vec<u8> {
    let palette = nv_flip::magma_lut().to_vec();
    let palette = palette.as_chunks::<3>().0;
    let colour = |value: &f32| {
        let place = (value.clamp(0.0, 1.0) * 255.0).round() as usize;
        let [r, g, b] = palette.get(place).copied().unwrap_or_default();
        [r, g, b, u8::MAX]
    };
    values.iter().flat_map(colour).collect()
}

/// The picture of FLIP values as [`Perceptual::write_heat_map`] draws it.
///
/// # Errors
/// [`Error::Invalid`] if there are not as many as the size says.
pub fn heat_map(size: Size, values: &[f32]) -> Result<Bitmap, Error> {
    Bitmap::from_rgba(size, &heat(values))
}

/// FLIP of every pixel, computed in stripes by all cores.
fn by_stripes(
    truth: &Bitmap,
    test: &Bitmap,
    height: u32,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<Vec<f32>, Error> {
    let size = truth.size();
    let count = size.height.div_ceil(height);
    let next = AtomicU32::new(0);
    let (sender, receiver) = mpsc::channel();
    let cores = thread::available_parallelism().map_or(1, NonZeroUsize::get);
    let width = size.width as usize;
    let mut map = vec![0.0; width * size.height as usize];
    thread::scope(|scope| {
        for _ in 0..cores.min(count as usize) {
            let (sender, next) = (sender.clone(), &next);
            scope.spawn(move || {
                loop {
                    let k = next.fetch_add(1, Ordering::Relaxed);
                    if k >= count
                        || sender
                            .send((k, stripe(truth, test, k * height, height)))
                            .is_err()
                    {
                        break;
                    }
                }
            });
        }
        drop(sender);
        for (done, (k, rows)) in (1..).zip(receiver) {
            let start = k as usize * height as usize * width;
            map[start..start + rows.len()].copy_from_slice(&rows);
            progress(done, u64::from(count));
        }
    });
    Ok(map)
}

/// FLIP of the rows from `top` on.
fn stripe(truth: &Bitmap, test: &Bitmap, top: u32, height: u32) -> Vec<f32> {
    let size = truth.size();
    let first = top.saturating_sub(MARGIN);
    let rows = (top + height + MARGIN).min(size.height) - first;
    let part = |picture: &Bitmap| {
        nv_flip::FlipImageRgb8::with_data(size.width, rows, picture.rows(first, rows))
    };
    let map = nv_flip::flip(part(truth), part(test), PIXELS_PER_DEGREE).to_vec();
    let width = size.width as usize;
    let skipped = (top - first) as usize * width;
    let wanted = height.min(size.height - top) as usize * width;
    map[skipped..skipped + wanted].to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(width: u32, height: u32, colour: impl Fn(u32, u32) -> [u8; 3]) -> Bitmap {
        let size = Size { width, height };
        let rows = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        let rgba: Vec<u8> = rows
            .flat_map(|(x, y)| {
                let [r, g, b] = colour(x, y);
                [r, g, b, 255]
            })
            .collect();
        Bitmap::from_rgba(size, &rgba).unwrap()
    }

    /// A pattern of all frequencies, in colour.
    fn waves(x: u32, y: u32) -> [u8; 3] {
        [
            (x * x + 3 * y) as u8,
            (x * y / 7) as u8,
            (5 * y * y + x) as u8,
        ]
    }

    fn compared(a: &Bitmap, b: &Bitmap) -> Perceptual {
        Perceptual::new(a, b, &mut |_, _| ()).unwrap()
    }

    #[test]
    fn stripes_join_without_a_seam() {
        let a = picture(61, 151, waves);
        let b = picture(61, 151, |x, y| waves(x + u32::from(y % 5 == 0), y));
        let whole = by_stripes(&a, &b, 1000, &mut |_, _| ()).unwrap();
        for height in [37, 64] {
            assert_eq!(by_stripes(&a, &b, height, &mut |_, _| ()).unwrap(), whole);
        }
        assert!(whole.iter().any(|&x| x > 0.1));
    }

    /// Values by `flip_evaluator` of PyPI, a later version of the authors' program, which filters in another order.
    #[test]
    fn values_of_the_authors_program() {
        let wrapped = |x: u32| (x % 256) as u8;
        let a = picture(64, 48, |x, y| [4 * x, 5 * y, 3 * x + 2 * y].map(wrapped));
        let b = picture(64, 48, |x, y| {
            [4 * x + 9, 5 * y, 3 * x + 2 * y + x / 8 * 5].map(wrapped)
        });
        let found = compared(&a, &b);
        let near = |found: f64, expected: f64| {
            assert!((found - expected).abs() < 1e-4, "{found}, not {expected}");
        };
        near(found.mean, 0.291_520);
        near(found.max, 0.976_532);
        assert_eq!(found.worst, [63, 31]);
        let at = |x: usize, y: usize| f64::from(found.map()[y * 64 + x]);
        near(at(20, 10), 0.159_716);
        near(at(60, 40), 0.682_747);
    }

    #[test]
    fn equal_pictures_and_opposite_ones() {
        let a = picture(40, 30, waves);
        let same = compared(&a, &a);
        assert_eq!((same.mean, same.p999, same.max), (0.0, 0.0, 0.0));
        let black = picture(9, 9, |_, _| [0; 3]);
        let white = picture(9, 9, |_, _| [255; 3]);
        assert!(compared(&black, &white).mean > 0.9);
    }

    #[test]
    fn the_worst_pixel_is_named() {
        let a = picture(64, 48, |_, _| [100; 3]);
        let b = picture(64, 48, |x, y| {
            if (x, y) == (50, 7) {
                [200; 3]
            } else {
                [100; 3]
            }
        });
        let found = compared(&a, &b);
        assert_eq!(found.worst, [50, 7]);
        assert!(found.max > found.p999 && found.p999 >= found.mean);
    }
}
