// Levels of chladni: gradient by central differences one pixel apart.

fn f(p: vec2f) -> f32 {
    return cos(3.0 * PI * p.x) * cos(5.0 * PI * p.y) - cos(5.0 * PI * p.x) * cos(3.0 * PI * p.y);
}

fn shade(pixel: vec2f) -> vec3f {
    let p = world(pixel);
    let h = view.pixel;
    let v = f(p);
    let g = 0.5 * vec2f(f(p + vec2f(h, 0.0)) - f(p - vec2f(h, 0.0)), f(p + vec2f(0.0, h)) - f(p - vec2f(0.0, h)));
    let rate = length(g);
    let colour = diverging(saturate_real(v / SCALE));
    var ink = max(0.5 * lines(v, rate, 0.25, 1.2), 0.75 * lines(v, rate, 1.25, 1.8));
    ink = max(ink, line(abs(v) / max(rate, 1e-20), 2.6) * (1.0 - smoothstep(1.0, 4.0, rate / 0.25)));
    return mix(colour, vec3f(0.010, 0.012, 0.02), ink);
}

const SCALE: f32 = 0.4;
