// Complex numbers, for the twins that draw functions of them.

fn mul(a: vec2f, b: vec2f) -> vec2f {
    return vec2f(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}

fn div(a: vec2f, b: vec2f) -> vec2f {
    return vec2f(a.x * b.x + a.y * b.y, a.y * b.x - a.x * b.y) / dot(b, b);
}

// Half way to 1 at `fade` octaves.
fn far(octaves: f32, fade: f32) -> f32 {
    return 1.0 / (1.0 + exp2(-clamp(6.0 / fade * (octaves - fade), -60.0, 60.0)));
}

// Zeros towards black, poles towards white.
fn extremes(colour: vec3f, octaves: f32, fade: f32) -> vec3f {
    return mix(colour * (1.0 - 0.88 * far(-octaves, fade)), vec3f(1.0), 0.88 * far(octaves, fade));
}

// Hue by argument, rings that step up at each octave, antialiased: log f changes by `rate` nepers a pixel.
fn domain_colour(w: vec2f, modulus: f32, rate: f32) -> vec3f {
    let octaves = log2(max(length(w), 1e-30) / modulus);
    let u = octaves - round(octaves);
    let window = clamp(rate * 1.44269504, 1e-9, 1.0);
    let ring = u + clamp(0.5 - u / window, 0.0, 1.0);
    return extremes(rainbow(atan2(w.y, w.x) / TAU) * (0.65 + 0.35 * ring), octaves, 6.0);
}
