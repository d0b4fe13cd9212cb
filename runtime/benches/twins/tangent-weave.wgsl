fn f(p: vec2f) -> f32 {
    return tan(p.x * p.y);
}
