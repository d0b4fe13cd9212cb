// wave(x, y) = sin(k x) cos(y) | gradient | param k = 2 in 0..5
fn wave_gradient(x: f32, y: f32, k: f32) -> vec3f {
    let sx = sin(k * x);
    let cx = cos(k * x);
    let sy = sin(y);
    let cy = cos(y);
    return vec3f(k * cx * cy, -(sx * sy), sx * cy);
}
