// The midpoints of ORDER steps.
fn along_ray(o: vec3f, d: vec3f, a: f32, b: f32) -> f32 {
    let step = (b - a) / f32(ORDER);
    var sum = 0.0;
    for (var k = 0u; k < ORDER; k++) {
        sum += field(o + (a + (f32(k) + 0.5) * step) * d);
    }
    return sum * step;
}
