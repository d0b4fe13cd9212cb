fn f(z: vec2f) -> vec2f {
    return cdiv(cmul(z, z) - vec2f(1.0, 0.0), z + vec2f(0.0, 1.0));
}
