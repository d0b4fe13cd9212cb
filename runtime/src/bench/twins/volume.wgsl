// The 4f orbital as a luminous gas: equal steps, jittered, gradient by forward differences.

fn f(p: vec3f) -> f32 {
    let r2 = dot(p, p);
    return p.z * (5.0 * p.z * p.z - 3.0 * r2) * exp(-0.25 * sqrt(r2));
}

const R: f32 = 27.0;
const STEPS: f32 = 200.0;

fn shade(pixel: vec2f) -> vec3f {
    let c = camera(pixel, 189.44157);
    let span = cube(c.o, c.d, R);
    if span.y <= max(span.x, 0.0) {
        return DARK;
    }
    let count = ceil((span.y - span.x) / (3.4641016 * R) * STEPS);
    let ds = (span.y - span.x) / count;
    var seen = Seen(vec3f(), 1.0);
    var t = span.x + ds * phase(pixel);
    while t < span.y && seen.through > 0.0005 {
        let p = c.o + t * c.d;
        let v = f(p);
        let h = 0.02;
        let g = vec3f(f(p + vec3f(h, 0.0, 0.0)), f(p + vec3f(0.0, h, 0.0)), f(p + vec3f(0.0, 0.0, h))) - v;
        seen = through(seen, v, g, abs(v) / SCALE, 0.9 / R, ds);
        t += ds;
    }
    let colour = displayed(seen.light) + seen.through * edged(DARK, c, span.y, R, 0.4);
    return edged(colour, c, span.x, R, 0.55);
}

const SCALE: f32 = 8.0;
