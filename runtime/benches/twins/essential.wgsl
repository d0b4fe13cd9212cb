fn f(z: vec2f) -> vec2f {
    return cexp(cdiv(vec2f(1.0, 0.0), z));
}
