// checker: a complex function by the board of squares whose corners are the complex integers, pulled back. Squares are
// subdivided once; dark lines stand at whole re f and im f.
//
// Everything is filtered by how fast re f and im f change: with the derivatives a = ∂f/∂z and b = ∂f/∂z̄ their gradients have
// the lengths |a + conj b| and |a - conj b|, both |f′| where f is holomorphic. What is finer than a pixel is its mean.
//
// A value too large for f32 is white with faint stripes, an undefined one (NaN) a quiet grey hatch. A constant is the colour
// of its square.

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
    unit: f32,
    subdivision: u32,
    contrast: f32,
    fine_contrast: f32,
    line_width: f32,
    line_opacity: f32,
    fine_opacity: f32,
    hue: f32,
    palette: u32,
    light: vec3f,
    dark: vec3f,
    ink: vec3f,
    key: f32,
    colours: array<vec4f, 129>,  // of a named palette
}

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> params: array<vec4f, 16>;
@group(0) @binding(2) var<uniform> settings: Settings;

// f with ∂f/∂z and ∂f/∂z̄ at the offset from the view's centre
fn map_jet(offset: vec2f) -> Jet { return Jet(); }

struct Jet {
    value: vec2f,
    dz: vec2f,
    dzbar: vec2f,
    exponent: f32,
}

struct Polar {
    octaves: f32,
    turns: f32,
    octave_rate: f32,
    turn_rate: f32,
}

struct Key {
    place: vec2f,
    step: vec2f,
    inside: bool,
    border: f32,
}

fn is_finite(x: f32) -> bool { return false; }
fn offset_from_pixel(pixel: vec2f) -> vec2f { return vec2f(); }
fn sample_window() -> f32 { return 0.0; }
fn undrawn_colour(value: vec2f, pixel: vec2f) -> vec3f { return vec3f(); }
fn part_rates(jet: Jet) -> vec2f { return vec2f(); }
fn polar_from_jet(jet: Jet) -> Polar { return Polar(); }
fn mean_wheel_colour(turns: f32, window: f32, palette: u32) -> vec3f { return vec3f(); }
fn square_train(u: f32, window: f32) -> f32 { return 0.0; }
fn even_lines(u: f32, rate: f32, width: f32) -> f32 { return 0.0; }
fn key_at(pixel: vec2f, side: f32, aspect: f32) -> Key { return Key(); }
fn key_jet(key: Key, reach: f32) -> Jet { return Jet(); }
fn with_key_border(colour: vec3f, key: Key) -> vec3f { return vec3f(); }

fn colour_entry(k: u32) -> vec3f {
    return settings.colours[k].rgb;
}

// 1 and -1 on the squares of a board of side 1.
fn board(w: vec2f, rates: vec2f) -> f32 {
    let window = rates * sample_window();
    return square_train(w.x, window.x) * square_train(w.y, window.y);
}

fn grid_lines(w: vec2f, rates: vec2f, width: f32) -> f32 {
    return max(even_lines(w.x, rates.x, width), even_lines(w.y, rates.y, width));
}

// Light and dark paper, the darker one in the hue of arg f as far as that is asked for.
fn paper(jet: Jet, lightness: f32) -> vec3f {
    let colour = mix(settings.dark, settings.light, lightness);
    if settings.hue <= 0.0 || all(jet.value == vec2f()) {
        return colour;
    }
    let polar = polar_from_jet(jet);
    let wheel = mean_wheel_colour(polar.turns, polar.turn_rate * sample_window(), settings.palette);
    return mix(colour, wheel * mix(0.45, 1.0, lightness), settings.hue);
}

fn colour_of(jet: Jet, pixel: vec2f) -> vec3f {
    if !(is_finite(jet.value.x) & is_finite(jet.value.y)) {
        return undrawn_colour(jet.value, pixel);
    }
    let w = clamp(jet.value / settings.unit, vec2f(-1e30), vec2f(1e30));
    let rates = part_rates(jet) / settings.unit;
    var lightness = 0.5 + 0.5 * settings.contrast * board(w, rates);
    var line = settings.line_opacity * grid_lines(w, rates, settings.line_width);
    if settings.subdivision > 1u {
        let parts = f32(settings.subdivision);
        lightness += 0.5 * settings.fine_contrast * board(w * parts, rates * parts);
        line = max(line, settings.fine_opacity * grid_lines(w * parts, rates * parts, 0.7 * settings.line_width));
    }
    return mix(paper(jet, clamp(lightness, 0.0, 1.0)), settings.ink, line);
}

fn shade(pixel: vec2f) -> vec4f {
    let key = key_at(pixel, settings.key, 1.0);
    var jet = map_jet(offset_from_pixel(pixel));
    if key.inside {
        jet = key_jet(key, 2.0 * settings.unit);
    }
    return vec4f(with_key_border(colour_of(jet, pixel), key), 1.0);
}
