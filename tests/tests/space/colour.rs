//! Colours in f64, from their definitions.

pub type Rgb = [f64; 3];

/// Linear light from sRGB (IEC 61966-2-1).
pub fn decoded(encoded: f64) -> f64 {
    if encoded <= 0.04045 {
        encoded / 12.92
    } else {
        ((encoded + 0.055) / 1.055).powf(2.4)
    }
}

/// sRGB from linear light.
pub fn encoded(linear: f64) -> f64 {
    if linear <= 0.003_130_8 {
        12.92 * linear
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    }
}

/// Linear rgb of OKLCH, hue in turns (B. Ottosson, "A perceptual color space for image processing", 2020).
fn oklch(lightness: f64, chroma: f64, hue: f64) -> Rgb {
    let angle = hue * std::f64::consts::TAU;
    let (a, b) = (chroma * angle.cos(), chroma * angle.sin());
    let cube = |x: f64| x * x * x;
    let l = cube(lightness + 0.396_337_777_4 * a + 0.215_803_757_3 * b);
    let m = cube(lightness - 0.105_561_345_8 * a - 0.063_854_172_8 * b);
    let s = cube(lightness - 0.089_484_177_5 * a - 1.291_485_548 * b);
    [
        4.076_741_662_1 * l - 3.307_711_591_3 * m + 0.230_969_929_2 * s,
        -1.268_438_004_6 * l + 2.609_757_401_1 * m - 0.341_319_396_5 * s,
        -0.004_196_086_3 * l - 0.703_418_614_7 * m + 1.707_614_701 * s,
    ]
}

/// The blue-white-red of values in -1..1: lightness falls from 0.972 to 0.45 to both sides.
pub fn diverging(t: f64) -> Rgb {
    let size = t.abs().min(1.0);
    let hue = if t < 0.0 { 0.711 } else { 0.075 };
    oklch(0.972 - 0.522 * size, size * (0.46 - 0.31 * size), hue)
}
