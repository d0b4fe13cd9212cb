// Colour spaces and colour maps. Colours are linear rgb with the sRGB primaries unless a name says otherwise.

const TURN: f32 = 6.283185307179586;

// Linear light to sRGB, per component, [0, 1] to [0, 1] (IEC 61966-2-1).
fn srgb_encode(linear: vec3f) -> vec3f {
    let curved = 1.055 * pow(max(linear, vec3f(0.0031308)), vec3f(1.0 / 2.4)) - 0.055;
    return select(curved, 12.92 * linear, linear <= vec3f(0.0031308));
}

// sRGB to linear light, per component, [0, 1] to [0, 1] (IEC 61966-2-1).
fn srgb_decode(encoded: vec3f) -> vec3f {
    let curved = pow((max(encoded, vec3f(0.04045)) + 0.055) / 1.055, vec3f(2.4));
    return select(curved, encoded / 12.92, encoded <= vec3f(0.04045));
}

// OKLab (lightness 0..1, green-red, blue-yellow) to linear rgb, not clipped (B. Ottosson, 2020).
fn oklab_to_linear(lab: vec3f) -> vec3f {
    let l = lab.x + 0.3963377774 * lab.y + 0.2158037573 * lab.z;
    let m = lab.x - 0.1055613458 * lab.y - 0.0638541728 * lab.z;
    let s = lab.x - 0.0894841775 * lab.y - 1.2914855480 * lab.z;
    let cone = vec3f(l * l * l, m * m * m, s * s * s);
    return vec3f(
        dot(cone, vec3f(4.0767416621, -3.3077115913, 0.2309699292)),
        dot(cone, vec3f(-1.2684380046, 2.6097574011, -0.3413193965)),
        dot(cone, vec3f(-0.0041960863, -0.7034186147, 1.7076147010)),
    );
}

// OKLCH to linear rgb: lightness 0..1, chroma (0 is grey), hue in turns (red 0.08, yellow 0.30, blue 0.73).
fn oklch_to_linear(lightness: f32, chroma: f32, hue: f32) -> vec3f {
    let angle = hue * TURN;
    return oklab_to_linear(vec3f(lightness, chroma * cos(angle), chroma * sin(angle)));
}

// Blue, white, red for t in [-1, 1]. Lightness in OKLab falls by the same straight line to both sides, and each
// side keeps one hue; the chroma stays inside the sRGB gamut.
fn diverging_ramp(t: f32) -> vec3f {
    let size = min(abs(t), 1.0);
    // cosine and sine of hues of 0.075 and 0.711 turns
    let hue = select(vec2f(0.8910065242, 0.4539904997), vec2f(-0.2425992293, -0.9701265914), t < 0.0);
    return oklab_to_linear(vec3f(0.972 - 0.522 * size, size * (0.46 - 0.31 * size) * hue));
}

// Indigo through magenta and orange to cream for t in [0, 1], with OKLab lightness linear in t.
fn sequential_ramp(t: f32) -> vec3f {
    let s = clamp(t, 0.0, 1.0);
    let chroma = 0.045 + s * (0.50 - s * 0.50);
    let hue = 0.79 + 0.485 * s;
    return clamp(oklch_to_linear(0.20 + 0.76 * s, chroma, hue), vec3f(0.0), vec3f(1.0));
}

// Cubehelix: a helix around the grey diagonal (D. A. Green, Bull. Astr. Soc. India 39, 2011, equation 2).
// Hue in turns, saturation, and lightness in 0..1 of the encoded colour.
fn cubehelix(hue: f32, saturation: f32, lightness: f32) -> vec3f {
    let angle = (hue + 1.0 / 3.0) * TURN;
    let radius = saturation * lightness * (1.0 - lightness);
    let c = cos(angle);
    let s = sin(angle);
    let encoded = lightness + radius * vec3f(
        -0.14861 * c + 1.78277 * s,
        -0.29227 * c - 0.90649 * s,
        1.97294 * c,
    );
    return srgb_decode(clamp(encoded, vec3f(0.0), vec3f(1.0)));
}

// The cyclic rainbow of d3-scale-chromatic: once around the helix, with lightness and saturation rising and
// falling linearly. t in turns, of period 1; shifted by a quarter so that 0 is red and 0.5 is cyan.
fn cubehelix_rainbow(t: f32) -> vec3f {
    let shifted = t + 0.25;
    let u = shifted - floor(shifted);
    let off = abs(u - 0.5);
    return cubehelix(u - 100.0 / 360.0, 1.5 - 1.5 * off, 0.8 - 0.9 * off);
}

// A circle of constant lightness and chroma in OKLCH: red at 0, period 1 turn.
fn oklch_wheel(t: f32) -> vec3f {
    return clamp(oklch_to_linear(0.745, 0.125, t + 0.08), vec3f(0.0), vec3f(1.0));
}

// The saturated hue circle of HSV, for comparison: its bright spokes are artefacts. Red at 0, period 1 turn.
fn hsv_wheel(t: f32) -> vec3f {
    let u = t - floor(t);
    let offset = abs(6.0 * u - vec3f(3.0, 2.0, 4.0));
    let encoded = clamp(vec3f(offset.x - 1.0, 2.0 - offset.y, 2.0 - offset.z), vec3f(0.0), vec3f(1.0));
    return srgb_decode(encoded);
}

// The template's: entry k of the table of a named colour map, 0 ≤ k ≤ 128.
fn colour_entry(k: u32) -> vec3f { return vec3f(); }

// A named colour map at u in [0, 1], linear light between its entries.
fn mapped_colour(u: f32) -> vec3f {
    let place = clamp(u, 0.0, 1.0) * 128.0;
    let k = min(u32(place), 127u);
    return mix(colour_entry(k), colour_entry(k + 1u), place - f32(k));
}
