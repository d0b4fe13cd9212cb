// Real functions of the tier `fast`. Each stands for the function of the same name in `math`.

fn real_hypot3(x: f32, y: f32, z: f32) -> f32 { return 0.0; }

/// Whether a sum of squares is so far from the ends of the range, 1e-30 to 1e37, that nothing in it was lost. Bits, which
/// tell NaN too.
fn is_moderate(squared: f32) -> bool {
    return bitcast<u32>(squared) - 0x0da24260u < 0x6f4e7b62u;
}

/// a + b - s where s is the sum: not looked for.
fn real_sum_rest(a: f32, b: f32, s: f32) -> f32 {
    return 0.0;
}

/// The same of a b + c.
fn real_mul_add_rest(a: f32, b: f32, c: f32, s: f32) -> f32 {
    return 0.0;
}

/// The same of sin x.
fn real_sine_rest(x: f32, s: f32) -> f32 {
    return 0.0;
}

/// The same of cos x.
fn real_cosine_rest(x: f32, s: f32) -> f32 {
    return 0.0;
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
