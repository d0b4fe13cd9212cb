// Logarithmic contours of three charges: lines of log2 |f| in three octaves, blended by how fast that changes on the
// screen.

fn f(p: vec2f) -> f32 {
    let y2 = p.y * p.y;
    let a = p.x - 2.0;
    let b = p.x + 2.0;
    return 2.0 * inverseSqrt(p.x * p.x + y2) - inverseSqrt(a * a + y2) - inverseSqrt(b * b + y2);
}

fn paint(side: f32, far: f32) -> vec3f {
    return diverging(side * (0.14 + 0.86 * far));
}

fn shade(pixel: vec2f) -> vec3f {
    let p = world(pixel);
    let h = view.pixel;
    let v = f(p);
    let g = 0.5 * vec2f(f(p + vec2f(h, 0.0)) - f(p - vec2f(h, 0.0)), f(p + vec2f(0.0, h)) - f(p - vec2f(0.0, h)));
    let nepers = length(g) / max(abs(v), 1e-30);
    let rate = max(nepers * 1.44269504, 1e-9);
    let octaves = log2(max(abs(v), 1e-30));
    // colour by sign, mixed where the zero is within the pixel
    let far = 1.0 / (1.0 + exp2(-0.39624063 * (octaves + log2(1.0 + 0.25 * nepers))));
    let share = 0.5 + clamp(1.0 / max(nepers, 1e-20), 0.0, 0.5);
    let side = sign(v);
    var colour = paint(side, far);
    if share < 0.999 {
        colour = mix(paint(-side, far), colour, share);
    }
    // octaves of lines, the finest at least ten pixels apart
    let place = log2(rate * 10.0);
    let finest = ceil(place);
    var ink = 0.0;
    for (var j = 0; j < 3; j++) {
        let spacing = exp2(finest + f32(j));
        let u = octaves / spacing;
        let weight = min(0.5 * (f32(j) + finest - place), 1.0);
        ink = max(ink, weight * line(abs(u - round(u)) * spacing / rate, 1.2));
    }
    ink *= 1.0 - smoothstep(0.6, 1.5, nepers);
    return mix(colour, vec3f(0.010, 0.012, 0.02), 0.75 * ink);
}
