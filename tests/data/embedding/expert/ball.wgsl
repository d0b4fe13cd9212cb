// ball(p: vec3) = |p| - 1 | gradient
fn ball_gradient(p: vec3f) -> vec4f {
    let r = length(p);
    return vec4f(p / r, r - 1.0);
}
