//! Differences of pictures in linear light, before they are rounded to 8 bits.

use super::SHARES;

/// How far two pictures are apart: of each pixel the greatest difference of red, green and blue in linear light, each between
/// 0 and 1 as it is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Light {
    /// Share of the pixels, of 1, that differ by more than 1/255.
    pub share: f64,
    /// The least that 99.9 % of the pixels do not exceed.
    pub p999: f64,
    /// The greatest.
    pub max: f64,
}

impl Light {
    /// Of pictures of as many pixels, premultiplied by alpha, before black.
    #[must_use]
    pub fn apart(truth: &[[f32; 4]], test: &[[f32; 4]]) -> Self {
        let shown = |x: f32| f64::from(x.clamp(0.0, 1.0));
        let mut all: Vec<f64> = truth
            .iter()
            .zip(test)
            .map(|(a, b)| {
                let channels = [0, 1, 2].map(|k| (shown(a[k]) - shown(b[k])).abs());
                // a NaN differs from everything
                channels.into_iter().fold(
                    0.0,
                    |most: f64, x| {
                        if x.is_nan() { 1.0 } else { most.max(x) }
                    },
                )
            })
            .collect();
        all.sort_by(f64::total_cmp);
        let count = all.len();
        let beyond = count - all.partition_point(|&x| x <= SHARES[0]);
        // nearest rank, in whole numbers: ⌈0.999 n⌉ = n - ⌊n / 1000⌋
        let rank = (count - count / 1000).saturating_sub(1);
        Self {
            share: beyond as f64 / count.max(1) as f64,
            p999: all.get(rank).copied().unwrap_or(0.0),
            max: all.last().copied().unwrap_or(0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_by_hand() {
        let grey = |x: f32| [x, x, x, 1.0];
        let truth = vec![grey(0.5); 2000];
        let mut test = truth.clone();
        assert_eq!(Light::apart(&truth, &test), Light::default());
        test[7] = [0.5, 0.25, 0.5, 1.0];
        test[8][0] = 0.5 + 1.0 / 256.0;
        test[9][2] = f32::INFINITY;
        let found = Light::apart(&truth, &test);
        assert_eq!((found.share, found.max), (2.0 / 2000.0, 0.5));
        assert_eq!(found.p999, 1.0 / 256.0);
        test[7][1] = f32::NAN;
        assert_eq!(Light::apart(&truth, &test).max, 1.0);
        assert_eq!(Light::apart(&[], &[]), Light::default());
    }
}
