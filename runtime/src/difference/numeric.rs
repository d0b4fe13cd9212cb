//! Differences of colours as numbers.

use super::Bitmap;

/// Differences, of 1, of a colour component in linear light: how large a share of the pixels differs by more than the
/// step of 8 bits, and by more than half of it.
pub const SHARES: [f64; 2] = [1.0 / 255.0, 1.0 / 512.0];

/// How a component of the colour differs, in linear light, of 1. All are of the absolute differences.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Channel {
    /// The greatest.
    pub max: f64,
    /// The mean.
    pub mean: f64,
    /// The root of the mean of squares.
    pub rms: f64,
    /// The least that 99.9 % of the pixels do not exceed.
    pub p999: f64,
}

/// How the colours of two pictures differ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Numeric {
    /// Red, green and blue.
    pub channels: [Channel; 3],
    /// Share of the pixels, of 1, of which a component differs at all.
    pub differing: f64,
    /// Share of the pixels, of 1, of which a component differs by more than each of [`SHARES`].
    pub shares: [f64; 2],
    /// Peak signal-to-noise ratio of the sRGB values in decibels, 20 log₁₀(255/√MSE) over all components; infinite for
    /// equal pictures.
    pub psnr: f64,
}

impl Numeric {
    /// Of pictures of one size.
    pub(super) fn new(truth: &Bitmap, test: &Bitmap) -> Self {
        let light = linear_light();
        let mut pairs = [Pairs::new(), Pairs::new(), Pairs::new()];
        let mut beyond = [0u64; 3];
        for (a, b) in truth.pixels().iter().zip(test.pixels()) {
            let mut worst = 0.0f64;
            for k in 0..3 {
                pairs[k].add(a[k], b[k]);
                worst = worst.max((light[usize::from(a[k])] - light[usize::from(b[k])]).abs());
            }
            for (count, limit) in beyond.iter_mut().zip([0.0, SHARES[0], SHARES[1]]) {
                *count += u64::from(worst > limit);
            }
        }
        let total = truth.pixels().len().max(1) as f64;
        let [differing, shares @ ..] = beyond.map(|count| count as f64 / total);
        let error = pairs.iter().map(Pairs::mean_square_of_bytes).sum::<f64>() / 3.0;
        Self {
            channels: pairs.map(|pairs| pairs.channel(&light)),
            differing,
            shares,
            psnr: 20.0 * (255.0 / error.sqrt()).log10(),
        }
    }

    /// The worst of the components, each judgement by itself.
    #[must_use]
    pub fn worst(&self) -> Channel {
        let most = |of: fn(&Channel) -> f64| self.channels.iter().map(of).fold(0.0, f64::max);
        Channel {
            max: most(|c| c.max),
            mean: most(|c| c.mean),
            rms: most(|c| c.rms),
            p999: most(|c| c.p999),
        }
    }
}

/// How often each byte of one picture stands where each byte of the other does. Everything follows from that exactly,
/// in whatever order pixels are counted.
struct Pairs(Vec<u64>);

impl Pairs {
    fn new() -> Self {
        Self(vec![0; 1 << 16])
    }

    fn add(&mut self, a: u8, b: u8) {
        self.0[usize::from(a) << 8 | usize::from(b)] += 1;
    }

    /// Both bytes, and how often they met.
    fn seen(&self) -> impl Iterator<Item = (usize, usize, u64)> {
        let all = self.0.iter().enumerate();
        let seen = all.filter(|&(_, &count)| count > 0);
        seen.map(|(at, &count)| (at >> 8, at & 255, count))
    }

    fn total(&self) -> u64 {
        self.0.iter().sum::<u64>()
    }

    fn mean_square_of_bytes(&self) -> f64 {
        let square = |a: usize, b: usize| (a.abs_diff(b) * a.abs_diff(b)) as u64;
        let sum: u64 = self.seen().map(|(a, b, count)| square(a, b) * count).sum();
        sum as f64 / self.total().max(1) as f64
    }

    fn channel(&self, light: &[f64; 256]) -> Channel {
        let seen = self.seen();
        let mut sizes: Vec<(f64, u64)> = seen
            .map(|(a, b, count)| ((light[a] - light[b]).abs(), count))
            .collect();
        sizes.sort_by(|a, b| a.0.total_cmp(&b.0));
        let total = self.total();
        let mean = |of: fn(f64) -> f64| {
            let sum: f64 = sizes.iter().map(|&(d, count)| of(d) * count as f64).sum();
            sum / total.max(1) as f64
        };
        // nearest rank, in whole numbers: ⌈0.999 n⌉ = n - ⌊n / 1000⌋
        let rank = total - total / 1000;
        let mut below = 0;
        let p999 = sizes.iter().find(|&&(_, count)| {
            below += count;
            below >= rank
        });
        Channel {
            max: sizes.last().map_or(0.0, |size| size.0),
            mean: mean(|d| d),
            rms: mean(|d| d * d).sqrt(),
            p999: p999.map_or(0.0, |size| size.0),
        }
    }
}

/// Linear light of each sRGB byte (IEC 61966-2-1).
fn linear_light() -> [f64; 256] {
    std::array::from_fn(|byte| {
        let encoded = byte as f64 / 255.0;
        if encoded <= 0.04045 {
            encoded / 12.92
        } else {
            ((encoded + 0.055) / 1.055).powf(2.4)
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Size;

    fn grey(bytes: &[u8]) -> Bitmap {
        let size = Size {
            width: bytes.len() as u32,
            height: 1,
        };
        let rgba: Vec<u8> = bytes.iter().flat_map(|&b| [b, b, b, 255]).collect();
        Bitmap::from_rgba(size, &rgba).unwrap()
    }

    fn near(found: f64, expected: f64) {
        let tolerance = 1e-14 * expected.abs();
        assert!(
            (found - expected).abs() <= tolerance,
            "{found}, not {expected}"
        );
    }

    #[test]
    fn equal_pictures() {
        let found = Numeric::new(&grey(&[0, 7, 255]), &grey(&[0, 7, 255]));
        assert_eq!(found.channels, [Channel::default(); 3]);
        assert_eq!((found.differing, found.shares), (0.0, [0.0; 2]));
        assert_eq!(found.psnr, f64::INFINITY);
    }

    /// Linear light of 188 is ((188/255 + 0.055)/1.055)^2.4 = 0.502886458032569, by arithmetic of 50 digits.
    #[test]
    fn values_by_hand() {
        let found = Numeric::new(&grey(&[0, 10, 0, 188]), &grey(&[255, 0, 0, 188]));
        let small = 10.0 / 255.0 / 12.92;
        let worst = found.worst();
        assert_eq!(found.channels, [worst; 3]);
        near(worst.max, 1.0);
        near(worst.p999, 1.0);
        near(worst.mean, (1.0 + small) / 4.0);
        near(worst.rms, ((1.0 + small * small) / 4.0).sqrt());
        assert_eq!((found.differing, found.shares), (0.5, [0.25, 0.5]));
        near(
            found.psnr,
            10.0 * (255.0f64.powi(2) * 4.0 / (255.0f64.powi(2) + 100.0)).log10(),
        );
        let half = Numeric::new(&grey(&[188]), &grey(&[0]));
        near(half.worst().max, 0.502_886_458_032_569);
    }

    #[test]
    fn one_pixel_of_a_thousand_is_beyond_the_percentile() {
        let mut bytes = vec![0; 2000];
        bytes[0] = 255;
        bytes[1] = 200;
        let check = |bytes: &[u8], expected: f64| {
            let found = Numeric::new(&grey(&vec![0; bytes.len()]), &grey(bytes));
            assert_eq!(found.worst().p999, expected);
            assert_eq!(found.worst().max, 1.0);
        };
        check(&bytes, 0.0);
        check(&bytes[..1000], linear_light()[200]);
        check(&bytes[..999], 1.0);
    }
}
