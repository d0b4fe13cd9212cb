fn f(p: vec3f) -> f32 {
    let s = p.x + p.y + p.z + 1.0;
    return dot(p * p, p) + 1.0 - s * s * s;
}
