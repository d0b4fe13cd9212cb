// bump(x, y) = exp(-(x² + y²)/2) | gradient
fn bump_gradient(x: f32, y: f32) -> vec3f {
    let f = exp(-0.5 * (x * x + y * y));
    return vec3f(-x * f, -y * f, f);
}
