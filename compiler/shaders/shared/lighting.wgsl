// Reflection of light by a surface with unit normal `n`; `l` points to the light and `v` to the viewer.

// Wrapped Lambert: 1 facing the light, falling to 0 only where n·l = -wrap; wrap = 0 is Lambert, 1 is
// half-Lambert without its square.
fn wrap_diffuse(n: vec3f, l: vec3f, wrap: f32) -> f32 {
    return max(dot(n, l) + wrap, 0.0) / (1.0 + wrap);
}

// Blinn's highlight (1977), 1 at its centre.
fn blinn_specular(n: vec3f, l: vec3f, v: vec3f, exponent: f32) -> f32 {
    let sum = l + v;
    let middle = sum / max(length(sum), 1e-6);
    return pow(max(dot(n, middle), 1e-6), exponent);
}

// Schlick's approximation (1994) of the Fresnel reflectance, with `f0` at normal incidence.
fn schlick_fresnel(cosine: f32, f0: f32) -> f32 {
    let c = clamp(1.0 - cosine, 0.0, 1.0);
    let c2 = c * c;
    return f0 + (1.0 - f0) * c2 * c2 * c;
}

// What lights a scene.
struct Lamp {
    toward: vec3f,        // where the sun is, of length 1
    strength: f32,        // of the sun
    surroundings: vec3f,  // colour of the horizon
    ambient: f32,         // strength of the light of sky and ground
}

// Light that reaches the eye from a surface of one colour: light of sky and ground, a wrapped sun, its highlight, and a
// rim in the colour of the surroundings. `open` is the part of the sky that is not hidden.
fn lit_colour(colour: vec3f, n: vec3f, v: vec3f, open: f32, lamp: Lamp) -> vec3f {
    let sky = lamp.ambient * mix(vec3f(0.24, 0.21, 0.19), vec3f(0.36, 0.40, 0.46), 0.5 + 0.5 * n.z);
    let sun = lamp.strength * (vec3f(1.06, 1.00, 0.91) * wrap_diffuse(n, lamp.toward, 0.35) * mix(1.0, open, 0.6));
    let gloss = lamp.strength * (blinn_specular(n, lamp.toward, v, 110.0) * 0.30 * open);
    let rim = lamp.ambient * ((schlick_fresnel(abs(dot(n, v)), 0.03) - 0.03) * 0.30 * open);
    return colour * (sky * open + sun) + vec3f(gloss) + rim * lamp.surroundings;
}
