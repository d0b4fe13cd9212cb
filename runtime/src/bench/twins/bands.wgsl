// Bands of the zone plate: stripes of four colours, the nearest edge blended by erfc, the mean where they are too fine.

fn f(p: vec2f) -> f32 {
    return dot(p, p);
}

const COLOURS = array<vec3f, 4>(
    vec3f(0.012, 0.036, 0.095),
    vec3f(0.055, 0.235, 0.33),
    vec3f(0.885, 0.78, 0.545),
    vec3f(0.745, 0.17, 0.08),
);
const MEAN: vec3f = vec3f(0.42425, 0.30525, 0.2625);

fn stripe(k: i32) -> vec3f {
    let index = u32(k) & 3u;
    return select(select(COLOURS[0], COLOURS[1], index == 1u), select(COLOURS[2], COLOURS[3], index == 3u), index >= 2u);
}

// Abramowitz and Stegun 7.1.27, 5e-4
fn erfc(x: f32) -> f32 {
    let d = 1.0 + x * (0.278393 + x * (0.230389 + x * (0.000972 + x * 0.078108)));
    let e = d * d;
    return 1.0 / (e * e);
}

fn shade(pixel: vec2f) -> vec3f {
    let p = world(pixel);
    let h = view.pixel;
    let u = f(p) / 0.2;
    let g = 0.5 / 0.2 * vec2f(f(p + vec2f(h, 0.0)) - f(p - vec2f(h, 0.0)), f(p + vec2f(0.0, h)) - f(p - vec2f(0.0, h)));
    // standard deviation of the footprint: half a pixel
    let spread = max(0.5 * length(g), 1e-9);
    let nearest = round(u);
    let away = u - nearest;
    let other = 0.5 * erfc(abs(away) / (spread * 1.41421356));
    let edge = i32(nearest);
    let own = select(stripe(edge - 1), stripe(edge), away >= 0.0);
    let next = select(stripe(edge), stripe(edge - 1), away >= 0.0);
    return mix(mix(own, next, other), MEAN, smoothstep(0.4, 1.4, spread));
}
