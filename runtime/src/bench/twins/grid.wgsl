// The adaptive rectangular grid of z exp z, over hue and cells.

fn f(z: vec2f) -> vec2f {
    return mul(z, exp(z.x) * vec2f(cos(z.y), sin(z.y)));
}

// Lines at multiples of 4ⁿ, of which the finest are at least 16 pixels apart and fade in.
fn octave_lines(u: f32, rate: f32, finest: f32, blend: f32) -> f32 {
    var covered = 0.0;
    for (var j = 0; j < 2; j++) {
        let spacing = exp2(2.0 * (finest + f32(j)));
        let k = u / spacing;
        covered = max(covered, min(f32(j) + blend, 1.0) * line(abs(k - round(k)) * spacing / rate, 1.1));
    }
    return covered;
}

// 1 and -1 on cells of side 4ⁿ.
fn cells(u: f32, rate: f32, n: f32) -> f32 {
    let side = exp2(2.0 * n);
    let k = 0.25 - abs(fract(0.5 * u / side + 0.25) - 0.5);
    return clamp(4.0 * k * side / rate, -1.0, 1.0);
}

fn blended(u: f32, rate: f32, finest: f32, blend: f32) -> f32 {
    return mix(cells(u, rate, finest + 1.0), cells(u, rate, finest), blend);
}

fn shade(pixel: vec2f) -> vec3f {
    let z = world(pixel);
    let w = f(z);
    let rate = max(length(f(z + vec2f(view.pixel, 0.0)) - w), 1e-20);
    let place = 0.5 * log2(max(rate * 16.0, 1e-9));
    let finest = ceil(place);
    let blend = finest - place;
    let octaves = log2(max(length(w), 1e-30));
    var colour = mix(vec3f(0.8), rainbow(atan2(w.y, w.x) / TAU), 0.85);
    colour = mix(colour, extremes(colour, octaves, 4.0), 0.75);
    colour *= 0.88 + 0.12 * blended(w.x, rate, finest, blend) * blended(w.y, rate, finest, blend);
    let ink = vec3f(0.010, 0.012, 0.02);
    colour = mix(colour, ink, 0.7 * octave_lines(w.x, rate, finest, blend));
    colour = mix(colour, ink, 0.7 * octave_lines(w.y, rate, finest, blend));
    let turns = rate / (TAU * max(length(w), 1e-30));
    let axes = max(line(abs(w.x) / rate, 2.2), line(abs(w.y) / rate, 2.2)) * (1.0 - smoothstep(0.02, 0.1, turns));
    return mix(colour, ink, 0.9 * axes);
}
