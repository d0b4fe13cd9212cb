// Real functions of the tier `fast`. Each stands for the function of the same name in `math`.

fn real_hypot3(x: f32, y: f32, z: f32) -> f32 { return 0.0; }

/// Whether a sum of squares is so far from the ends of the range, 1e-30 to 1e37, that nothing in it was lost. Bits, which
/// tell NaN too.
fn is_moderate(squared: f32) -> bool {
    return bitcast<u32>(squared) - 0x0da24260u < 0x6f4e7b62u;
}

/// √(x² + y²), with care where a square leaves the range.
fn real_hypot(x: f32, y: f32) -> f32 {
    let squared = x * x + y * y;
    if is_moderate(squared) {
        return sqrt(squared);
    }
    return real_hypot3(x, y, 0.0);
}

/// -1, 0 or 1.
fn real_sign(x: f32) -> f32 {
    return sign(x);
}

/// sin x / x, 1 at 0; the series below a rounding error that would show.
fn real_sinc(x: f32) -> f32 {
    let a = abs(x);
    if a < 0.78 {
        let z = a * a;
        return 1.0 + z * (-0.16666655 + z * (0.008332158 + z * -0.00019514958));
    }
    return sin(a) / a;
}
