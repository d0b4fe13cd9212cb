
fn f(p: vec3f) -> f32 {
    var w = p;
    var d = 1.0;
    for (var k = 0; k < 5; k++) {
        let r = length(w);
        if r > 4.0 {
            break;
        }
        let a = 8.0 * atan2(length(w.xy), w.z);
        let b = 8.0 * atan2(w.y, w.x);
        d = 8.0 * pow(r, 7.0) * d + 1.0;
        w = pow(r, 8.0) * vec3f(sin(a) * cos(b), sin(a) * sin(b), cos(a)) + p;
    }
    let r = length(w);
    return 0.5 * log(r) * r / d - 0.002;
}
