// The ORDER nodes of Gauss and Legendre, in pairs around the middle.
fn along_ray(o: vec3f, d: vec3f, a: f32, b: f32) -> f32 {
    let half = 0.5 * (b - a);
    let middle = o + 0.5 * (a + b) * d;
    var sum = 0.0;
    for (var k = 0u; k < ORDER / 2u; k++) {
        let two = params[k >> 1u];
        let node = select(two.xy, two.zw, (k & 1u) == 1u);
        let way = half * node.x * d;
        sum += node.y * (field(middle - way) + field(middle + way));
    }
    return sum * half;
}
