
fn f(p: vec2f) -> f32 {
    var z = vec2f();
    var d = vec2f();
    for (var k = 0; k < 200 && dot(z, z) <= 1e6; k++) {
        d = 2.0 * vec2f(z.x * d.x - z.y * d.y, z.x * d.y + z.y * d.x) + vec2f(1.0, 0.0);
        z = vec2f(z.x * z.x - z.y * z.y, 2.0 * z.x * z.y) + p;
    }
    let r = length(z);
    return select(0.0, log(r) * r / length(d), r > 2.0);
}
