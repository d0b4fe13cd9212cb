// basins(x, y) = (x² + y - 11)² + (x + y² - 7)² | gradient
fn basins_gradient(x: f32, y: f32) -> vec3f {
    let a = x * x + y - 11.0;
    let b = x + y * y - 7.0;
    return vec3f(4.0 * x * a + 2.0 * b, 2.0 * a + 4.0 * y * b, a * a + b * b);
}
