// The board of integers pulled back by 2 sin z.

fn f(z: vec2f) -> vec2f {
    return 2.0 * vec2f(sin(z.x) * cosh(z.y), cos(z.x) * sinh(z.y));
}

// 1 and -1 on unit squares, antialiased over `rate`, the mean where they are finer than a pixel.
fn board(w: vec2f, rate: f32) -> f32 {
    let u = 0.25 - abs(fract(0.5 * w + 0.25) - 0.5);
    let s = clamp(4.0 * u / rate, vec2f(-1.0), vec2f(1.0)) * (1.0 - smoothstep(0.5, 1.5, rate));
    return s.x * s.y;
}

fn grid(w: vec2f, rate: f32, width: f32) -> f32 {
    let d = abs(w - round(w)) / max(rate, 1e-20);
    let dim = min(1.0, 0.34 / max(rate * width, 1e-20)) * (1.0 - smoothstep(0.5, 4.0, rate));
    return max(line(d.x, width), line(d.y, width)) * dim;
}

fn shade(pixel: vec2f) -> vec3f {
    let z = world(pixel);
    let w = f(z);
    let rate = length(f(z + vec2f(view.pixel, 0.0)) - w);
    let light = clamp(0.5 + 0.36 * board(w, rate) + 0.11 * board(5.0 * w, 5.0 * rate), 0.0, 1.0);
    let ink = max(0.95 * grid(w, rate, 1.6), 0.16 * grid(5.0 * w, 5.0 * rate, 1.12));
    return mix(mix(vec3f(0.105, 0.155, 0.225), vec3f(0.88, 0.85, 0.78), light), vec3f(0.010, 0.012, 0.02), ink);
}
