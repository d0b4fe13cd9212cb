// hill(x, y) = 1/(1 + x² + y²) | gradient
fn hill_gradient(x: f32, y: f32) -> vec3f {
    let f = 1.0 / (1.0 + x * x + y * y);
    let s = -2.0 * f * f;
    return vec3f(s * x, s * y, f);
}
