// An emitting and absorbing medium, for the twins that march through one.

struct Seen {
    light: vec3f,
    through: f32,
}

const EDGE: vec3f = vec3f(0.42, 0.45, 0.50);
const DARK: vec3f = vec3f(0.004, 0.005, 0.008);
const WARM: vec3f = vec3f(1.0, 0.22, 0.02);
const COOL: vec3f = vec3f(0.02, 0.18, 1.0);

// One step of length ds through a medium of value v and gradient g; `density` per world unit where x = |v|/scale is 1.
fn through(seen: Seen, v: f32, g: vec3f, x: f32, density: f32, ds: f32) -> Seen {
    let level = x / (1.0 + x);
    let n = -sign(v) * g / max(length(g), 1e-20);
    let shade = mix(1.0, 0.25 + 1.15 * max(dot(n, LIGHT) + 0.5, 0.0) / 1.5, 0.6);
    let colour = 2.0 * level * shade * mix(select(WARM, COOL, v < 0.0), vec3f(1.0), 0.12 * level);
    let alpha = 1.0 - exp(-density * x * x * ds);
    return Seen(seen.light + seen.through * alpha * colour, seen.through * (1.0 - alpha));
}

// Reinhard's curve.
fn displayed(light: vec3f) -> vec3f {
    let c = 1.1 * light;
    return c / (1.0 + c);
}

fn edged(colour: vec3f, c: Camera, t: f32, r: f32, strength: f32) -> vec3f {
    return mix(colour, EDGE, strength * edges(c, t, face(c.o + t * c.d), r, 1.4));
}
