// ring(x, y, z) = (√(x² + y²) - 1)² + z² - 0.0625 | value
fn ring(x: f32, y: f32, z: f32) -> f32 {
    let q = sqrt(x * x + y * y) - 1.0;
    return q * q + z * z - 0.0625;
}
