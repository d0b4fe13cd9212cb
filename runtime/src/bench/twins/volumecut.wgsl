// Sound in a cubical room as a luminous gas, cut open by the plane x = const, with contour lines on the cut.

fn f(p: vec3f) -> f32 {
    let a = cos(p);
    let b = cos(2.0 * p);
    let c = cos(3.0 * p);
    return b.x * c.y * a.z + c.x * a.y * b.z - a.x * b.y * c.z;
}

fn gradient(p: vec3f, v: f32) -> vec3f {
    let h = 2e-3;
    return (vec3f(f(p + vec3f(h, 0.0, 0.0)), f(p + vec3f(0.0, h, 0.0)), f(p + vec3f(0.0, 0.0, h))) - v) / h;
}

const R: f32 = PI;
const STEPS: f32 = 200.0;
const SCALE: f32 = 0.4;
const OFFSET: f32 = 0.1 * PI;

fn shade(pixel: vec2f) -> vec3f {
    let c = camera(pixel, 22.042527);
    let span = cube(c.o, c.d, R);
    if span.y <= max(span.x, 0.0) {
        return DARK;
    }
    var colour = edged(DARK, c, span.y, R, 0.4);
    let plane = (OFFSET - c.o.x) / c.d.x;
    let start = max(span.x, plane);
    if start < span.y {
        let count = ceil((span.y - start) / (3.4641016 * R) * STEPS);
        let ds = (span.y - start) / count;
        var seen = Seen(vec3f(), 1.0);
        var t = start + ds * phase(pixel);
        while t < span.y && seen.through > 0.0005 {
            let p = c.o + t * c.d;
            let v = f(p);
            seen = through(seen, v, gradient(p, v), abs(v) / SCALE, 0.8 / R, ds);
            t += ds;
        }
        colour = displayed(seen.light) + seen.through * colour;
        if plane > span.x {
            let p = c.o + start * c.d;
            let n = vec3f(1.0, 0.0, 0.0);
            let v = f(p);
            let rate = screen_rate(c, start, n, gradient(p, v));
            let ink = max(0.5 * lines(v, rate, 0.1, 1.2), line(abs(v) / max(rate, 1e-20), 2.6) * (1.0 - smoothstep(1.0, 4.0, rate / 0.1)));
            let size = saturate_real(v / SCALE);
            colour = mix(colour, abs(size) * select(WARM, COOL, size < 0.0), 0.35);
            colour = mix(colour, vec3f(0.85, 0.87, 0.9), ink);
            colour = mix(colour, EDGE, 0.8 * edges(c, start, n, R, 1.4));
        }
    }
    return edged(colour, c, span.x, R, 0.55);
}
