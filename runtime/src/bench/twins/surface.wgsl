// Cayley's cubic in a box on the ground: equal steps along the ray until the sign changes, a few secant steps,
// forward differences for the gradient.

fn f(p: vec3f) -> f32 {
    return dot(p, p) + 2.0 * p.x * p.y * p.z - 1.0;
}

fn gradient(p: vec3f, v: f32) -> vec3f {
    let h = 1e-3;
    return (vec3f(f(p + vec3f(h, 0.0, 0.0)), f(p + vec3f(0.0, h, 0.0)), f(p + vec3f(0.0, 0.0, h))) - v) / h;
}

const R: f32 = 1.5;
const STEP: f32 = 5.1961524 / 160.0;
const INK: vec3f = vec3f(0.012, 0.014, 0.02);
const OUTSIDE: vec3f = vec3f(0.66, 0.23, 0.085);
const INSIDE: vec3f = vec3f(0.06, 0.22, 0.45);

// Where f changes its sign first between a and b, or -1.
fn march(o: vec3f, d: vec3f, a: f32, b: f32, step: f32) -> f32 {
    var t = a;
    var v = f(o + t * d);
    while t < b {
        let s = min(t + step, b);
        let w = f(o + s * d);
        if (v < 0.0) != (w < 0.0) {
            // bisection with regula falsi in turns
            var lo = t;
            var hi = s;
            var vlo = v;
            var vhi = w;
            for (var k = 0; k < 8; k++) {
                let m = select(0.5 * (lo + hi), lo + (hi - lo) * vlo / (vlo - vhi), (k & 1) == 0);
                let u = f(o + m * d);
                if (u < 0.0) == (vlo < 0.0) {
                    lo = m;
                    vlo = u;
                } else {
                    hi = m;
                    vhi = u;
                }
            }
            return 0.5 * (lo + hi);
        }
        t = s;
        v = w;
    }
    return -1.0;
}

// What is drawn on a wall at distance t.
fn wall(under: vec3f, c: Camera, t: f32, behind: bool) -> vec3f {
    let p = c.o + t * c.d;
    let n = face(p);
    let v = f(p);
    let rate = max(screen_rate(c, t, n, gradient(p, v)), 1e-20);
    var colour = under;
    if behind {
        let side = select(OUTSIDE, INSIDE, v < 0.0);
        colour = mix(colour, mix(side, vec3f(1.0), 0.5), 0.22);
        var iso = 0.0;
        for (var k = 0u; k < 3u; k++) {
            let spacing = select(select(0.5, 2.5, k == 1u), 12.5, k == 2u);
            let u = v / spacing;
            iso = max(iso, (1.0 - smoothstep(0.10, 0.28, rate / spacing)) * line(abs(u - round(u)) * spacing / rate, 1.1));
        }
        colour = mix(colour, mix(side, INK, 0.45), 0.5 * iso);
    }
    colour = mix(colour, INK, line(abs(v) / rate, 2.2) * select(0.55, 0.85, behind));
    return mix(colour, INK, edges(c, t, n, R, 1.4) * select(0.8, 0.6, behind));
}

fn surface(c: Camera, t: f32) -> vec3f {
    let p = c.o + t * c.d;
    let g = normalize(gradient(p, f(p)));
    let outer = dot(g, c.d) <= 0.0;
    let n = select(-g, g, outer);
    let side = select(-1.0, 1.0, outer);
    var closed = 0.0;
    for (var k = 1; k < 4; k++) {
        let height = 0.11 * f32(k);
        let q = p + height * n;
        if any(abs(q) > vec3f(R)) {
            continue;
        }
        let v = f(q);
        let free = select(0.0, min(abs(v) / (max(length(gradient(q, v)), 1e-20) * height), 1.0), v * side > 0.0);
        closed += (1.0 - free) * exp2(-f32(k));
    }
    return lit(select(INSIDE, OUTSIDE, outer), n, -c.d, 1.0 - 0.7 * clamp(closed, 0.0, 1.0));
}

fn ground(c: Camera) -> vec3f {
    if c.d.z > -1e-6 {
        return sky(c.d);
    }
    let p = c.o - c.d * ((c.o.z + R) / c.d.z);
    let q = clamp(p, vec3f(-R), vec3f(R));
    let v = f(q);
    let aside = distance(p, q);
    let near = length(vec2f(abs(v) / max(length(gradient(q, v)), 1e-20), 2.0 * aside));
    let reach = 0.42426407 * R;
    var light = 1.0 - 0.7 * (0.55 * exp2(-2.0 * near / reach) + 0.25 * exp2(-2.5 * aside / reach));
    let away = length(p.xy) / 2.5980762;
    if away < 8.0 {
        let span = cube(p, LIGHT, R);
        if span.y > max(span.x, 0.0) && march(p, LIGHT, max(span.x, 0.0), span.y, 2.0 * STEP) > 0.0 {
            light *= 0.67;
        }
    }
    return mix(BACKGROUND * vec3f(0.90, 0.89, 0.87) * light, sky(c.d), 1.0 - exp2(-0.012 * away * away));
}

fn shade(pixel: vec2f) -> vec3f {
    let c = camera(pixel, 10.524532);
    let span = cube(c.o, c.d, R);
    if span.y <= max(span.x, 0.0) {
        return ground(c);
    }
    let t = march(c.o, c.d, span.x, span.y, STEP);
    var colour: vec3f;
    if t > 0.0 {
        colour = surface(c, t);
    } else {
        colour = wall(ground(c), c, span.y, true);
    }
    return wall(colour, c, span.x, false);
}
