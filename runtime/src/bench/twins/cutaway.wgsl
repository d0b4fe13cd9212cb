// Three levels of Neovius' surface, cut open by a plane: as `nested`, on the part of the ray that is kept, with
// contour lines on the cut.

fn f(p: vec3f) -> f32 {
    let c = cos(p);
    return 3.0 * (c.x + c.y + c.z) + 4.0 * c.x * c.y * c.z;
}

fn gradient(p: vec3f, v: f32) -> vec3f {
    let h = 3e-3;
    return (vec3f(f(p + vec3f(h, 0.0, 0.0)), f(p + vec3f(0.0, h, 0.0)), f(p + vec3f(0.0, 0.0, h))) - v) / h;
}

const R: f32 = 4.5;
const SPACING: f32 = 3.0;
const LOWEST: f32 = -3.0;
const COUNT: f32 = 3.0;
const STEP: f32 = 15.588457 / 160.0;
const N: vec3f = vec3f(0.92747779, 0.32461723, 0.18549556);
const OFFSET: f32 = 0.97037364;

fn wall(seen: Seen, c: Camera, t: f32, is_behind: bool) -> Seen {
    let p = c.o + t * c.d;
    let v = f(p);
    let rate = screen_rate(c, t, face(p), gradient(p, v)) / SPACING;
    return levels_wall(seen, (v - LOWEST) / SPACING, rate, COUNT, is_behind);
}

fn cut(before: Seen, c: Camera, t: f32) -> Seen {
    let p = c.o + t * c.d;
    let v = f(p);
    let rate = screen_rate(c, t, N, gradient(p, v));
    let zero = line(abs(v) / max(rate, 1e-20), 2.6);
    let ink = max(0.5 * lines(v, rate, 1.25, 1.2), zero);
    let seen = behind(before, EDGE, 0.6 * edges(c, t, N, R, 1.4));
    return behind(seen, mix(diverging(saturate_real(v / 5.0)), vec3f(0.010, 0.012, 0.02), ink), select(0.3, 1.0, v < 0.0));
}

fn shade(pixel: vec2f) -> vec3f {
    let c = camera(pixel, 31.573595);
    let backdrop = stage(c, R);
    let span = cube(c.o, c.d, R);
    if span.y <= max(span.x, 0.0) {
        return backdrop;
    }
    var seen = behind(Seen(vec3f(), 1.0), EDGE, 0.8 * edges(c, span.x, face(c.o + span.x * c.d), R, 1.4));
    // the camera is on the side that is cut away: the ray enters what is kept at the plane
    let plane = (OFFSET - dot(N, c.o)) / dot(N, c.d);
    let start = max(span.x, plane);
    if start < span.y {
        if plane > span.x {
            seen = cut(seen, c, start);
        } else {
            seen = wall(seen, c, start, false);
        }
        var t = start;
        var u = (f(c.o + t * c.d) - LOWEST) / SPACING;
        while t < span.y && seen.through > 0.002 {
            let s = min(t + STEP, span.y);
            let w = (f(c.o + s * c.d) - LOWEST) / SPACING;
            let rising = w > u;
            var k = select(floor(u), ceil(u), rising);
            while select(k >= w && k != u, k <= w && k != u, rising) && seen.through > 0.002 {
                if k >= 0.0 && k < COUNT {
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
                    seen = shell(seen, k, COUNT, gradient(p, f(p)), c.d, 0.22);
                }
                k += select(-1.0, 1.0, rising);
            }
            t = s;
            u = w;
        }
        if seen.through > 0.002 {
            seen = wall(seen, c, span.y, true);
        }
    }
    seen = behind(seen, EDGE, 0.6 * edges(c, span.y, face(c.o + span.y * c.d), R, 1.4));
    return seen.light + seen.through * backdrop;
}
