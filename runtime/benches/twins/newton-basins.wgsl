
fn f(z: vec2f) -> vec2f {
    var w = z;
    for (var k = 0; k < 16; k++) {
        let square = cmul(w, w);
        w -= cdiv(cmul(square, w) - vec2f(1.0, 0.0), 3.0 * square);
    }
    return w;
}
