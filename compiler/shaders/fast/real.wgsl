// Real functions of the tier `fast`. Each stands for the function of the same name in `math`.

fn real_hypot3(x: f32, y: f32, z: f32) -> f32 { return 0.0; }

/// √(x² + y²), with care where a square leaves the range.
fn real_hypot(x: f32, y: f32) -> f32 {
    let squared = x * x + y * y;
    if (squared > 1e-30) & (squared < 1e37) {
        return sqrt(squared);
    }
    return real_hypot3(x, y, 0.0);
}

/// x/r for r = hypot(x, y), and 0 at the origin.
fn real_direction(x: f32, y: f32, r: f32) -> f32 {
    return select(x / r, 0.0, r == 0.0);
}
