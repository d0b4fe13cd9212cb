fn f(p: vec2f) -> f32 {
    return sin(dot(p, p));
}
