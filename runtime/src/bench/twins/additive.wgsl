// Rings of light in a cylinder, as the source draws them: the antiderivative of the density along the ray, taken where the
// ray leaves the cylinder and away where it enters, each no farther than what hides it.

const BOX: vec3f = vec3f(0.8, 0.8, 1.4);
const COLOR: vec3f = vec3f(0.04, 0.4, 1.0);
const DARK: vec3f = vec3f(0.004, 0.005, 0.008);
const STONE: vec3f = vec3f(0.016, 0.017, 0.020);
const BALL: vec3f = vec3f(0.5, -0.9, -0.95);
const FAR: f32 = 1e30;
// yaw 32°, pitch 14°
const FROM: vec3f = vec3f(0.82285744, 0.51417840, 0.24192190);
const TOP: vec3f = vec3f(-0.20516140, -0.12819907, 0.97029573);

// Of 1/2 + sin(9 z - 8 time)/2.
fn antiderivative(o: vec3f, d: vec3f, t: f32) -> f32 {
    let a = 9.0 * o.z - 8.0 * view.time;
    let b = 9.0 * d.z;
    return 0.5 * (t - cos(a + b * t) / b);
}

fn ray_integral(o: vec3f, d: vec3f, t: f32) -> f32 {
    return antiderivative(o, d, t) - antiderivative(o, d, 0.0);
}

// Where a ray enters and leaves the cylinder; nowhere if it misses.
fn faces(o: vec3f, d: vec3f) -> vec2f {
    let a = dot(d.xy, d.xy);
    let b = dot(o.xy, d.xy);
    let square = b * b - a * (dot(o.xy, o.xy) - BOX.x * BOX.x);
    if square < 0.0 {
        return vec2f();
    }
    let root = sqrt(square);
    let ends = (vec2f(-BOX.z, BOX.z) - o.z) / d.z;
    return vec2f(max((-b - root) / a, min(ends.x, ends.y)), min((-b + root) / a, max(ends.x, ends.y)));
}

fn stone(n: vec3f) -> vec3f {
    return STONE * (0.25 + 0.75 * max(dot(n, LIGHT) + 0.3, 0.0) / 1.3);
}

fn shade(pixel: vec2f) -> vec3f {
    let slope = 2.0 * 0.24932800 / min(view.size.x, view.size.y);
    let at = (pixel - 0.5 * view.size) * slope;
    let o = 6.5 * FROM;
    let d = normalize(at.x * RIGHT - at.y * TOP - FROM);
    var depth = FAR;
    var colour = DARK;
    if d.z < -1e-6 {
        depth = (-BOX.z - o.z) / d.z;
        let away = length((o + depth * d).xy) / 1.8;
        colour = mix(DARK, stone(vec3f(0.0, 0.0, 1.0)), exp2(-0.35 * away));
    }
    let q = o - BALL;
    let b = dot(q, d);
    let h = b * b - dot(q, q) + 0.45 * 0.45;
    if h > 0.0 && -b - sqrt(h) < depth {
        depth = -b - sqrt(h);
        colour = stone((q + depth * d) / 0.45);
    }
    let span = faces(o, d);
    var light = vec3f();
    if span.y > span.x {
        let sum = ray_integral(o, d, min(span.y, depth)) - ray_integral(o, d, min(span.x, depth));
        light = 1.1 * 1.6 * sum * COLOR;
    }
    return light / (1.0 + light) + colour;
}
