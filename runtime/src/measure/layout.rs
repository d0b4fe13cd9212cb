//! Parts of a picture, put side by side so that they can be compared as one.

use crate::Size;
use crate::executor::Window;

/// Side of a part in pixels.
pub(super) const SIDE: u32 = 32;
/// Black pixels between parts: more than the filters of FLIP reach.
const GAP: u32 = 12;

/// Which parts, and where each is in the picture of them.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    pub(super) windows: Vec<Window>,
    /// Whether they are the whole picture, in its place.
    whole: bool,
    size: Size,
    columns: u32,
}

/// All parts of a picture, in an order in which the first few are spread over it.
pub(super) fn parts(size: Size) -> Vec<Window> {
    let mut all = Vec::new();
    for y in (0..size.height).step_by(SIDE as usize) {
        for x in (0..size.width).step_by(SIDE as usize) {
            all.push(Window {
                x,
                y,
                size: Size {
                    width: SIDE.min(size.width - x),
                    height: SIDE.min(size.height - y),
                },
            });
        }
    }
    all.sort_by_key(|window| mixed(u64::from(window.x) << 32 | u64::from(window.y)));
    all
}

/// A number that has little to do with its neighbours' (the finaliser of SplitMix64; Steele, Lea, Flood, "Fast splittable
/// pseudorandom number generators", OOPSLA 2014).
pub(super) fn mixed(z: u64) -> u64 {
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

impl Layout {
    /// Of these parts of a picture of that size.
    pub(super) fn new(windows: Vec<Window>, picture: Size) -> Self {
        let count = windows.len() as u32;
        let whole = windows.iter().map(pixels).sum::<usize>()
            == picture.width as usize * picture.height as usize;
        let columns = f64::from(count).sqrt().ceil().max(1.0) as u32;
        let length = |many: u32| many * (SIDE + GAP) - GAP;
        let size = if whole {
            picture
        } else {
            Size {
                width: length(columns),
                height: length(count.div_ceil(columns).max(1)),
            }
        };
        Self {
            windows,
            whole,
            size,
            columns,
        }
    }

    pub(super) fn size(&self) -> Size {
        self.size
    }

    pub(super) fn is_whole(&self) -> bool {
        self.whole
    }

    /// The places of a part's pixels in the picture of parts, in the order of its rows.
    pub(super) fn places(&self, k: usize) -> impl Iterator<Item = usize> {
        let window = self.windows[k];
        let (left, top) = if self.whole {
            (window.x, window.y)
        } else {
            let k = k as u32;
            let stride = SIDE + GAP;
            (k % self.columns * stride, k / self.columns * stride)
        };
        let width = self.size.width as usize;
        let columns = window.size.width as usize;
        (0..pixels(&window))
            .map(move |i| (top as usize + i / columns) * width + left as usize + i % columns)
    }

    /// The picture of parts, of the pixels of each.
    pub(super) fn joined(&self, parts: &[Vec<[f32; 4]>]) -> Vec<[f32; 4]> {
        let count = self.size.width as usize * self.size.height as usize;
        let mut out = vec![[0.0, 0.0, 0.0, 1.0]; count];
        for (k, part) in parts.iter().enumerate() {
            for (place, &pixel) in self.places(k).zip(part) {
                out[place] = pixel;
            }
        }
        out
    }

    /// The parts of a whole picture of linear light.
    pub(super) fn cut(&self, rows: &[u8], width: u32) -> Vec<Vec<[f32; 4]>> {
        let pixel = |x: u32, y: u32| {
            let at = 16 * (y as usize * width as usize + x as usize);
            let number = |k: usize| {
                let bytes = rows.get(at + 4 * k..at + 4 * k + 4);
                bytes.map_or(f32::NAN, bytemuck::pod_read_unaligned)
            };
            [number(0), number(1), number(2), number(3)]
        };
        let part = |window: &Window| {
            let Size { width, height } = window.size;
            let places = (0..height).flat_map(move |y| (0..width).map(move |x| (x, y)));
            places
                .map(|(x, y)| pixel(window.x + x, window.y + y))
                .collect()
        };
        self.windows.iter().map(part).collect()
    }
}

fn pixels(window: &Window) -> usize {
    window.size.width as usize * window.size.height as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_cover_the_picture_once_and_come_back() {
        let size = Size {
            width: 70,
            height: 40,
        };
        let all = parts(size);
        let picture: Vec<[f32; 4]> = (0..70 * 40).map(|k| [k as f32, 0.0, 0.0, 1.0]).collect();
        let bytes: &[u8] = bytemuck::cast_slice(&picture);
        let whole = Layout::new(all.clone(), size);
        assert!(whole.is_whole());
        assert_eq!(whole.joined(&whole.cut(bytes, size.width)), picture);
        let some = Layout::new(all[..3].to_vec(), size);
        assert!(!some.is_whole());
        let parts = some.cut(bytes, size.width);
        let joined = some.joined(&parts);
        for (k, part) in parts.iter().enumerate() {
            let back: Vec<_> = some.places(k).map(|place| joined[place]).collect();
            assert_eq!(&back, part);
        }
        let used: usize = parts.iter().map(Vec::len).sum();
        let black = joined
            .iter()
            .filter(|p| **p == [0.0, 0.0, 0.0, 1.0])
            .count();
        assert!(used + black >= joined.len());
    }
}
