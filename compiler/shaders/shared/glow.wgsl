// Light that is emitted around the zeros of a field that is like a distance, added up along a ray, and what films make of it.

// Mean of 1/v where `square` is false, else of 1/v², for v that runs linearly between two positive numbers.
fn mean_inverse(a: f32, b: f32, square: bool) -> f32 {
    if square {
        return 1.0 / (a * b);
    }
    let x = (b - a) / a;
    // log(1 + x)/x, by its series where the quotient would cancel
    let quotient = log(max(b / a, 1e-37)) / select(x, 1.0, x == 0.0);
    let series = 1.0 - x * (0.5 - x * (1.0 / 3.0 - 0.25 * x));
    return select(quotient, series, abs(x) < 0.03) / a;
}

// A value as a distance, which it is, or by the length of its gradient; `farthest` where that is not known, and at most that.
fn distance_of(jet: vec4f, by_slope: bool, farthest: f32) -> f32 {
    if !by_slope {
        return select(farthest, clamp(jet.w, -farthest, farthest), is_finite(jet.w));
    }
    let square = dot(jet.xyz, jet.xyz);
    var distance = jet.w * inverseSqrt(square);
    if !is_moderate(square) {
        distance = jet.w / max(scaled_length(jet.xyz), 1e-37);
        if is_nan(jet.x) || is_nan(jet.y) || is_nan(jet.z) || is_inf(scaled_length(jet.xyz)) {
            return farthest;
        }
    }
    return select(farthest, clamp(distance, -farthest, farthest), is_finite(jet.w));
}

// Mean over a step of the emission 1/(|d| + ε), or ε/(|d| + ε)², of a field d that runs linearly from a to b: exact, also
// where d changes its sign within the step.
fn mean_glow(a: f32, b: f32, epsilon: f32, square: bool) -> f32 {
    let va = abs(a) + epsilon;
    let vb = abs(b) + epsilon;
    let gain = select(1.0, epsilon, square);
    if (a < 0.0) == (b < 0.0) {
        return gain * mean_inverse(va, vb, square);
    }
    let part = abs(a) / max(abs(a) + abs(b), 1e-37);
    return gain * (part * mean_inverse(va, epsilon, square) + (1.0 - part) * mean_inverse(epsilon, vb, square));
}

// The response of film to light, c(2.51 c + 0.03)/(c(2.43 c + 0.59) + 0.14), at most 1 (K. Narkowicz, "ACES filmic tone
// mapping curve", 2015).
fn filmic(radiance: vec3f) -> vec3f {
    let c = clamp(radiance, vec3f(0.0), vec3f(1e6));
    return clamp(c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14), vec3f(0.0), vec3f(1.0));
}

// A number in (0, 1) without any pattern over the pixels, by a permuted congruential generator (M. O'Neill, 2014; M.
// Jarzynski and M. Olano, "Hash functions for GPU rendering", JCGT 9, 2020).
fn pixel_noise(pixel: vec2f, seed: u32) -> f32 {
    let place = vec2u(max(floor(pixel), vec2f(0.0)));
    let state = (place.x * 1973u + place.y * 9277u + seed * 26699u) * 747796405u + 2891336453u;
    let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (f32(((word >> 22u) ^ word) >> 8u) + 0.5) / 16777216.0;
}
