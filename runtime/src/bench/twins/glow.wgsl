// Three folded glowing rods: light added up along the ray where the field, made a distance by its slope, is small;
// the slope from forward differences; equal sums of the emission times the step.

fn smin(a: f32, b: f32, k: f32) -> f32 {
    let h = clamp(0.5 + 0.5 * (b - a) / k, 0.0, 1.0);
    return mix(b, a, h) - k * h * (1.0 - h);
}

fn fold(p: vec3f) -> vec3f {
    let q = abs(p) - vec3f(0.55, 0.35, 0.4);
    // turned by 0.6 about z and by 0.4 about x
    let x = 0.82533561 * q.x - 0.56464247 * q.y;
    let y = 0.56464247 * q.x + 0.82533561 * q.y;
    return 1.6 * vec3f(x, 0.92106099 * y - 0.38941834 * q.z, 0.38941834 * y + 0.92106099 * q.z);
}

fn f(p: vec3f) -> f32 {
    let q = fold(fold(p + 0.06 * sin(7.0 * p.zxy)));
    let rods = smin(smin(length(q.yz), length(q.xz), 0.2), length(q.xy), 0.2);
    return smin((rods - 0.09) / 2.56, length(p) - 0.35, 0.3);
}

const R: f32 = 2.0;
const EPSILON: f32 = 0.012;
const SHORTEST: f32 = 6.9282032 / 400.0;
const LONGEST: f32 = 0.27712813;

fn distance_at(p: vec3f) -> f32 {
    let h = 1e-3;
    let v = f(p);
    let g = vec3f(f(p + vec3f(h, 0.0, 0.0)), f(p + vec3f(0.0, h, 0.0)), f(p + vec3f(0.0, 0.0, h))) - v;
    return v * h / max(length(g), 1e-20);
}

fn colour_of(away: f32) -> vec3f {
    let near = EPSILON / (away + EPSILON);
    let body = mix(vec3f(0.45, 0.05, 0.015), vec3f(0.92, 0.3, 0.03), smoothstep(0.0, 0.5, near));
    return mix(body, vec3f(1.0, 0.62, 0.25), smoothstep(0.4, 1.0, near));
}

fn shade(pixel: vec2f) -> vec3f {
    let c = camera(pixel, 9.0);
    let span = cube(c.o, c.d, R);
    let place = (pixel - 0.5 * view.size) / min(view.size.x, view.size.y);
    let corner = max(1.0 - 0.55 * dot(place, place), 0.0);
    var light = vec3f();
    var t = span.x;
    var first = phase(pixel);
    while t < span.y {
        let p = c.o + t * c.d;
        let d = abs(distance_at(p));
        let ds = min(clamp(0.45 * d, SHORTEST, LONGEST), span.y - t) * first;
        let v = d + EPSILON;
        let depth = smoothstep(vec3f(0.0), vec3f(0.3), 1.0 - abs(p) / R);
        light += colour_of(d) * (EPSILON / (v * v) * ds * depth.x * depth.y * depth.z);
        t += max(ds, 1e-5);
        first = 1.0;
    }
    let x = light * 0.07 * corner;
    let filmic = clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), vec3f(0.0), vec3f(1.0));
    return filmic + vec3f(0.004, 0.005, 0.008) * corner;
}
