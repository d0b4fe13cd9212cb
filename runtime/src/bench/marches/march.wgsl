// The midpoints of ORDER steps. Sums of 32 steps are added, so that a sum of thousands is rounded by no more than one of hundreds.
fn along_ray(o: vec3f, d: vec3f, a: f32, b: f32) -> f32 {
    let step = (b - a) / f32(ORDER);
    let block = min(ORDER, 32u);
    var sum = 0.0;
    for (var k = 0u; k < ORDER; k += block) {
        var part = 0.0;
        for (var j = k; j < k + block; j++) {
            part += field(o + (a + (f32(j) + 0.5) * step) * d);
        }
        sum += part;
    }
    return sum * step;
}
