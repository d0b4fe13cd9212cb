// fog(x, y, z) = 0.5 + 0.1 z | integral
fn fog_integral(o: vec3f, d: vec3f, a: f32, b: f32) -> f32 {
    let middle = o.z + d.z * 0.5 * (a + b);
    return (b - a) * (0.5 + 0.1 * middle);
}
