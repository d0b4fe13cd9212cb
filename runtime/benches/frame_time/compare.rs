//! How far two pictures differ.

/// Differences of two pictures in 8-bit sRGB.
pub struct Difference {
    /// Largest difference of a channel.
    pub max: u8,
    /// Mean over pixels of the largest difference of a channel.
    pub mean: f64,
    /// Part of the pixels that differ by more than 2 in a channel.
    pub share: f64,
    /// Peak signal-to-noise ratio in dB; infinite for equal pictures.
    pub psnr: f64,
}

impl Difference {
    pub fn of(a: &[u8], b: &[u8]) -> Self {
        let (mut max, mut sum, mut over, mut squares) = (0, 0.0, 0.0, 0.0);
        for (p, q) in a.chunks_exact(4).zip(b.chunks_exact(4)) {
            let apart = distance(p, q);
            max = max.max(apart);
            sum += f64::from(apart);
            over += f64::from(apart > 2);
            squares += p[..3]
                .iter()
                .zip(q)
                .map(|(x, y)| f64::from(x.abs_diff(*y)).powi(2))
                .sum::<f64>();
        }
        let pixels = (a.len() / 4) as f64;
        let mean_square = squares / (3.0 * pixels);
        Self {
            max,
            mean: sum / pixels,
            share: over / pixels,
            psnr: 10.0 * (255.0 * 255.0 / mean_square).log10(),
        }
    }
}

fn distance(p: &[u8], q: &[u8]) -> u8 {
    p[..3]
        .iter()
        .zip(q)
        .map(|(x, y)| x.abs_diff(*y))
        .max()
        .unwrap_or(0)
}

/// The difference of two pictures as a picture: white where they agree, black from 64 on.
pub fn picture(a: &[u8], b: &[u8]) -> Vec<u8> {
    let pixel = |(p, q)| {
        let grey = 255 - distance(p, q).min(63) * 4;
        [grey, grey, grey, 255]
    };
    a.chunks_exact(4)
        .zip(b.chunks_exact(4))
        .flat_map(pixel)
        .collect()
}
