// logcontours: a real function of the plane by contour lines of log |f|, as fine as fits on the screen everywhere.
//
// Lines stand at log2 |f| = k · divisions^n for whole k. Which n are drawn follows from the change of log2 |f| per pixel,
// |∇f| / (|f| ln 2) times the pixel; the finest lines fade in as they move apart, so that the picture of a power
// of the radius is the same at every zoom. Colour is the sign of f, deeper as |f| grows.
//
// An undefined value (NaN) is a quiet grey hatch, an infinity the end of the palette with a hatch of the other slope. An
// exact zero is the colour of small values. A constant has no lines.

struct View {
    center: vec2f,     // world coordinates of the centre of the whole image
    size: vec2f,       // whole image, pixels
    tile: vec2f,       // pixel of the whole image at this tile's top-left corner
    pixel: f32,        // world units per pixel
    time: f32,         // seconds
    samples: u32,      // supersamples per axis, >= 1
    zero: u32,         // always 0, but the shader compiler does not know
    tile_size: vec2u,  // this tile, pixels
}

struct Settings {
    spacing: f32,
    divisions: u32,
    octaves: u32,
    line_width: f32,
    line_opacity: f32,
    modulus: f32,
    fade_octaves: f32,
    palette: u32,
    ink: vec3f,
    key: f32,
    colours: array<vec4f, 129>,  // of a named palette
}

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> params: array<vec4f, 16>;
@group(0) @binding(2) var<uniform> settings: Settings;

// (∂f/∂x, ∂f/∂y, f) at the offset from the view's centre
fn field_grad(offset: vec2f) -> vec3f { return vec3f(); }

struct Octave {
    finest: i32,
    blend: f32,
    scale: f32,
}

struct Key {
    place: vec2f,
    step: vec2f,
    inside: bool,
    border: f32,
}

fn is_nan(x: f32) -> bool { return false; }
fn is_finite(x: f32) -> bool { return false; }
fn offset_from_pixel(pixel: vec2f) -> vec2f { return vec2f(); }
fn sample_window() -> f32 { return 0.0; }
fn undefined_colour(pixel: vec2f) -> vec3f { return vec3f(); }
fn infinite_colour(pixel: vec2f, colour: vec3f) -> vec3f { return vec3f(); }
fn diverging_ramp(t: f32) -> vec3f { return vec3f(); }
fn mapped_colour(u: f32) -> vec3f { return vec3f(); }
fn log2_parts(x: f32) -> vec2f { return vec2f(); }
fn octave_rate(value: f32, gradient: vec2f) -> f32 { return 0.0; }
fn octave_of_rate(rate: f32, apart: f32, base: f32) -> Octave { return Octave(); }
fn octave_lines(whole: f32, part: f32, rate: f32, octave: Octave, base: f32, count: u32, width: f32) -> f32 { return 0.0; }
fn key_at(pixel: vec2f, side: f32, aspect: f32) -> Key { return Key(); }
fn scale_labels(key: Key, low: f32, middle: f32, high: f32) -> bool { return false; }
fn label_colour(colour: vec3f) -> vec3f { return vec3f(); }
fn with_key_border(colour: vec3f, key: Key) -> vec3f { return vec3f(); }

// Octaves of |f| from the middle of the key to its ends.
const KEY_OCTAVES: f32 = 12.0;

fn colour_entry(k: u32) -> vec3f {
    return settings.colours[k].rgb;
}

// Colour of a value by its sign and by how far |f| has come, 0..1.
fn palette_colour(side: f32, far: f32) -> vec3f {
    let t = side * (0.14 + 0.86 * far);
    if settings.palette == 1u {
        return vec3f(0.93, 0.92, 0.89) - (0.06 + 0.12 * far) * (0.5 - 0.5 * side) * vec3f(1.0, 0.7, 0.45);
    }
    if settings.palette > 1u {
        return mapped_colour(0.5 + 0.5 * t);
    }
    return diverging_ramp(t);
}

// A logistic in log |f|: 1/2 at `modulus`, 3/4 at `fade_octaves` above it.
fn far(octaves: f32) -> f32 {
    let x = 1.5849625 * (octaves - log2(max(settings.modulus, 1e-37))) / max(settings.fade_octaves, 1e-3);
    return 1.0 / (1.0 + exp2(-x));
}

// Both signs are mixed by their shares of the sample where f changes its sign: at a zero, and at a pole, f is as far from
// it as |f| / |∇f|. The mean of |f| over a sample with a zero in its middle is a quarter of the change across it.
fn sign_colour(value: f32, octaves: f32, rate: f32) -> vec3f {
    let samples = sample_window() * rate * 0.6931471805599453;
    let share = clamp(1.0 / max(samples, 1e-20), 0.0, 0.5) + 0.5;
    let depth = far(octaves + log2(1.0 + 0.25 * samples));
    let own = palette_colour(sign(value), depth);
    if share > 0.999 {
        return own;
    }
    return mix(palette_colour(-sign(value), depth), own, share);
}

fn colour_of(jet: vec3f, pixel: vec2f) -> vec3f {
    let value = jet.z;
    if !is_finite(value) {
        if is_nan(value) {
            return undefined_colour(pixel);
        }
        return infinite_colour(pixel, palette_colour(sign(value), 1.0));
    }
    if (bitcast<u32>(value) & 0x7fffffffu) == 0u {
        return 0.5 * (palette_colour(1.0, 0.0) + palette_colour(-1.0, 0.0));
    }
    let rate = octave_rate(value, jet.xy);
    // what the built-in function is off by, 3 ulp of up to 128, is a fortieth of a pixel at most where lines are near
    var parts = vec2f(0.0, log2(abs(value)));
    if rate < 1e-3 {
        parts = log2_parts(value);
    }
    let base = f32(settings.divisions);
    let octave = octave_of_rate(rate, settings.spacing, base);
    // within a pixel of a zero or pole log |f| is not straight across a line's width, and lines without end crowd
    let known = 1.0 - smoothstep(0.6, 1.5, rate * 0.6931471805599453);
    let line = known * octave_lines(parts.x, parts.y, rate, octave, base, settings.octaves, settings.line_width);
    return mix(sign_colour(value, parts.x + parts.y, rate), settings.ink, settings.line_opacity * line);
}

// The key's values: positive in its upper half, negative in the lower.
fn key_value(key: Key) -> vec3f {
    let size = exp2(KEY_OCTAVES * key.place.x);
    let value = select(-size, size, key.place.y > 0.0);
    return vec3f(value * 0.6931471805599453 * KEY_OCTAVES * key.step.x / view.pixel, 0.0, value);
}

// |f| in powers of two.
fn labelled(key: Key) -> bool {
    return scale_labels(key, exp2(-KEY_OCTAVES), 1.0, exp2(KEY_OCTAVES));
}

fn shade(pixel: vec2f) -> vec4f {
    let key = key_at(pixel, settings.key, 8.0);
    var jet = field_grad(offset_from_pixel(pixel));
    if key.inside {
        jet = key_value(key);
    }
    var colour = colour_of(jet, pixel);
    if key.inside && labelled(key) {
        colour = label_colour(colour);
    }
    return vec4f(with_key_border(colour, key), 1.0);
}
