// bowl(x, y, z) = x² + 2y² + 3z² | directional
fn bowl_along(x: f32, y: f32, z: f32, dx: f32, dy: f32, dz: f32) -> vec2f {
    let value = x * x + 2.0 * y * y + 3.0 * z * z;
    let slope = 2.0 * x * dx + 4.0 * y * dy + 6.0 * z * dz;
    return vec2f(value, slope);
}
