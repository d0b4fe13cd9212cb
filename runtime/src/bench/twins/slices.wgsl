// Slices through the potential of three charges: the active plane and three walls, contour lines by the gradient
// within the plane, from forward differences.

fn f(p: vec3f) -> f32 {
    return inverseSqrt(dot(p - vec3f(1.25, 0.0, 0.0), p - vec3f(1.25, 0.0, 0.0)))
        + inverseSqrt(dot(p - vec3f(-0.5, 1.0, 0.0), p - vec3f(-0.5, 1.0, 0.0)))
        - 2.0 * inverseSqrt(dot(p - vec3f(-0.5, -1.0, 0.0), p - vec3f(-0.5, -1.0, 0.0)));
}

const R: f32 = 2.0;
const PAPER: vec3f = vec3f(0.86, 0.86, 0.85);
const EDGE: vec3f = vec3f(0.012, 0.014, 0.02);
const INK: vec3f = vec3f(0.010, 0.012, 0.02);

// The unit grid of a wall, and its axes in colour.
fn gridded(colour: vec3f, c: Camera, t: f32, n: vec3f) -> vec3f {
    let p = c.o + t * c.d;
    var grid = 0.0;
    var axes = vec4f();
    for (var k = 0u; k < 3u; k++) {
        if abs(n[k]) > 0.99 {
            continue;
        }
        let u = vec3f(f32(k == 0u), f32(k == 1u), f32(k == 2u));
        let rate = screen_rate(c, t, n, u);
        let away = abs(p[k] - round(p[k])) / rate;
        grid = max(grid, line(away, 1.0) * (1.0 - smoothstep(0.5, 4.0, rate)));
        let along = abs(cross(n, u));
        let covered = line(abs(p[k]) / rate, 1.6);
        if covered > axes.a {
            axes = vec4f(along.x * vec3f(0.55, 0.03, 0.02) + along.y * vec3f(0.02, 0.30, 0.03) + along.z * vec3f(0.02, 0.06, 0.55), covered);
        }
    }
    return mix(mix(colour, EDGE, 0.16 * grid), axes.rgb, 0.85 * axes.a);
}

fn shade(pixel: vec2f) -> vec3f {
    let c = camera(pixel, 14.032709);
    var colour = stage(c, R);
    let span = cube(c.o, c.d, R);
    if span.y <= max(span.x, 0.0) {
        return colour;
    }
    // the wall behind, and the plane z = 0.24 in front of it
    var t = span.y;
    var n = face(c.o + t * c.d);
    var is_active = false;
    let plane = (0.24 - c.o.z) / c.d.z;
    if plane > span.x && plane < span.y {
        t = plane;
        n = vec3f(0.0, 0.0, 1.0);
        is_active = true;
    }
    let p = c.o + t * c.d;
    let h = 1e-3;
    let v = f(p);
    let g = (vec3f(f(p + vec3f(h, 0.0, 0.0)), f(p + vec3f(0.0, h, 0.0)), f(p + vec3f(0.0, 0.0, h))) - v) / h;
    let rate = screen_rate(c, t, n, g);
    colour = diverging(saturate_real(v / 1.5));
    let zero = line(abs(v) / max(rate, 1e-20), select(1.95, 2.6, is_active));
    if is_active {
        let ink = max(0.5 * lines(v, rate, 0.25, 1.2), 0.75 * lines(v, rate, 1.0, 1.8));
        colour = mix(colour, INK, max(ink, zero * (1.0 - smoothstep(1.0, 4.0, rate / 0.25))));
    } else {
        colour = mix(colour, INK, max(0.5 * lines(v, rate, 1.0, 1.2), zero * (1.0 - smoothstep(1.0, 4.0, rate))));
        colour = gridded(mix(PAPER, colour, 0.4), c, t, n);
        colour = mix(colour, EDGE, 0.5 * edges(c, t, n, R, 1.4));
    }
    return mix(colour, EDGE, 0.8 * edges(c, span.x, face(c.o + span.x * c.d), R, 1.4));
}
