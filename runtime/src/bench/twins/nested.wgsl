// Five levels of Schwarz' surface P: at each step along the ray all levels between both values, interpolated; normals
// from forward differences.

fn f(p: vec3f) -> f32 {
    let c = cos(PI * p);
    return c.x + c.y + c.z;
}

fn gradient(p: vec3f, v: f32) -> vec3f {
    let h = 1e-3;
    return (vec3f(f(p + vec3f(h, 0.0, 0.0)), f(p + vec3f(0.0, h, 0.0)), f(p + vec3f(0.0, 0.0, h))) - v) / h;
}

const R: f32 = 1.5;
const SPACING: f32 = 0.7;
const LOWEST: f32 = -1.4;
const COUNT: f32 = 5.0;
const STEP: f32 = 5.1961524 / 160.0;

fn wall(seen: Seen, c: Camera, t: f32, is_behind: bool) -> Seen {
    let p = c.o + t * c.d;
    let n = face(p);
    let v = f(p);
    let rate = screen_rate(c, t, n, gradient(p, v)) / SPACING;
    let edged = behind(seen, EDGE, select(0.8, 0.6, is_behind) * edges(c, t, n, R, 1.4));
    return levels_wall(edged, (v - LOWEST) / SPACING, rate, COUNT, is_behind);
}

fn shade(pixel: vec2f) -> vec3f {
    let c = camera(pixel, 10.524532);
    let backdrop = stage(c, R);
    let span = cube(c.o, c.d, R);
    if span.y <= max(span.x, 0.0) {
        return backdrop;
    }
    var seen = wall(Seen(vec3f(), 1.0), c, span.x, false);
    var t = span.x;
    var u = (f(c.o + t * c.d) - LOWEST) / SPACING;
    while t < span.y && seen.through > 0.002 {
        let s = min(t + STEP, span.y);
        let w = (f(c.o + s * c.d) - LOWEST) / SPACING;
        let rising = w > u;
        // the levels between both samples, in the order in which they are met
        var k = select(floor(u), ceil(u), rising);
        while select(k >= w && k != u, k <= w && k != u, rising) && seen.through > 0.002 {
            if k >= 0.0 && k < COUNT {
                // two steps of regula falsi
                var lo = t;
                var hi = s;
                var a = u - k;
                var b = w - k;
                var m = lo + (hi - lo) * a / (a - b);
                for (var j = 0; j < 2; j++) {
                    let e = (f(c.o + m * c.d) - LOWEST) / SPACING - k;
                    if (e < 0.0) == (a < 0.0) {
                        lo = m;
                        a = e;
                    } else {
                        hi = m;
                        b = e;
                    }
                    m = lo + (hi - lo) * a / (a - b);
                }
                let p = c.o + m * c.d;
                seen = shell(seen, k, COUNT, gradient(p, f(p)), c.d, 0.25);
            }
            k += select(-1.0, 1.0, rising);
        }
        t = s;
        u = w;
    }
    if seen.through > 0.002 {
        seen = wall(seen, c, span.y, true);
    }
    return seen.light + seen.through * backdrop;
}
