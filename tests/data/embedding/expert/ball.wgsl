// ball(p: vec3) = |p| - 1 | gradient | over: `length` is built to the last digits and over the whole range of numbers, and so are directions
fn ball_gradient(p: vec3f) -> vec4f {
    let r = length(p);
    return vec4f(p / r, r - 1.0);
}
