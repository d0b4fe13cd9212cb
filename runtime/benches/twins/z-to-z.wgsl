fn f(z: vec2f) -> vec2f {
    return cpow(z, z);
}
