// grid: a complex function by a grid in the plane of its values, rectangular or polar, as fine as fits on the screen
// everywhere. Six layers, each with a strength; a layer of strength 0 is not there.
//
// Rectangular lines stand at re f, im f = k · divisions^n, polar ones at log2 |f| = k · divisions^n and at whole parts
// divisions^-n of a turn, so that none stands out where arg f jumps from π to -π. Which n are drawn follows from |f′| (from both
// Wirtinger derivatives where f is not holomorphic); the finest lines fade in as they move apart.
//
// An exact zero is black as far as `light` goes; a value too large for f32 is white with faint stripes; an undefined value (NaN)
// is a quiet grey hatch. A constant has no lines.

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
    shape: u32,
    spacing: f32,
    divisions: u32,
    octaves: u32,
    phase: f32,
    light: f32,
    checker: f32,
    first_lines: f32,
    second_lines: f32,
    axes: f32,
    line_width: f32,
    fade_octaves: f32,
    palette: u32,
    paper: vec3f,
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

fn is_finite(x: f32) -> bool { return false; }
fn is_moderate(squared: f32) -> bool { return false; }
fn offset_from_pixel(pixel: vec2f) -> vec2f { return vec2f(); }
fn sample_window() -> f32 { return 0.0; }
fn undrawn_colour(value: vec2f, pixel: vec2f) -> vec3f { return vec3f(); }
fn part_rates(jet: Jet) -> vec2f { return vec2f(); }
fn polar_from_jet(jet: Jet) -> Polar { return Polar(); }
fn mean_wheel_colour(turns: f32, window: f32, palette: u32) -> vec3f { return vec3f(); }
fn blend_extremes(colour: vec3f, octaves: f32, rate: f32, fade: f32) -> vec3f { return vec3f(); }
fn coverage_of_line(away: f32, width: f32) -> f32 { return 0.0; }
fn octave_of_rate(rate: f32, apart: f32, base: f32) -> Octave { return Octave(); }
fn octave_lines(whole: f32, part: f32, rate: f32, octave: Octave, base: f32, count: u32, width: f32) -> f32 { return 0.0; }
fn octave_squares(u: f32, rate: f32, octave: Octave, base: f32) -> f32 { return 0.0; }
fn key_at(pixel: vec2f, side: f32, aspect: f32) -> Key { return Key(); }
fn key_jet(key: Key, reach: f32) -> Jet { return Jet(); }
fn with_key_border(colour: vec3f, key: Key) -> vec3f { return vec3f(); }

// The coordinates that the grid's lines are constant in, and how fast they change per pixel.
struct Coordinates {
    place: vec2f,
    rates: vec2f,
    first: Octave,
    second: Octave,
}

fn colour_entry(k: u32) -> vec3f {
    return settings.colours[k].rgb;
}

fn coordinates(jet: Jet, polar: Polar) -> Coordinates {
    let base = f32(settings.divisions);
    if settings.shape == 1u {
        var second = octave_of_rate(polar.turn_rate, settings.spacing, base);
        // no coarser than a turn: what is divided is the circle, not the line
        if second.finest > 0 {
            second = Octave(0, 0.0, 1.0);
        }
        let first = octave_of_rate(polar.octave_rate, settings.spacing, base);
        return Coordinates(
            vec2f(polar.octaves, polar.turns),
            vec2f(polar.octave_rate, polar.turn_rate),
            first,
            second,
        );
    }
    let rates = part_rates(jet);
    return Coordinates(
        clamp(jet.value, vec2f(-1e27), vec2f(1e27)),
        rates,
        octave_of_rate(rates.x, settings.spacing, base),
        octave_of_rate(rates.y, settings.spacing, base),
    );
}

// 1 and -1 on the cells. Around the circle there are twice as many as lines, an even number.
fn cells(at: Coordinates) -> f32 {
    let base = f32(settings.divisions);
    let around = select(1.0, 2.0, settings.shape == 1u);
    return octave_squares(at.place.x, at.rates.x, at.first, base)
        * octave_squares(around * at.place.y, around * at.rates.y, at.second, base);
}

// Lines re f = 0 and im f = 0, or |f| = 1 and arg f = 0. They go where they crowd.
fn axis_coverage(at: Coordinates, crowd: f32) -> f32 {
    let width = 2.0 * settings.line_width;
    let away = min(abs(at.place) / max(at.rates, vec2f(1e-30)), vec2f(1e9));
    let covered = max(
        select(0.0, coverage_of_line(away.x, width), at.rates.x > 0.0),
        select(0.0, coverage_of_line(away.y, width), at.rates.y > 0.0),
    );
    return covered * (1.0 - smoothstep(0.02, 0.1, crowd));
}

fn lines_of(at: f32, rate: f32, octave: Octave) -> f32 {
    return octave_lines(0.0, at, rate, octave, f32(settings.divisions), settings.octaves, settings.line_width);
}

// Within a pixel of a zero or pole polar coordinates are not straight across a line's width, and lines without end crowd.
fn polar_lines(polar: Polar) -> f32 {
    let nearness = max(0.6931471805599453 * polar.octave_rate, 6.283185307179586 * polar.turn_rate);
    return select(1.0, 1.0 - smoothstep(0.6, 1.5, nearness), settings.shape == 1u);
}

fn colour_of(jet: Jet, pixel: vec2f) -> vec3f {
    if !is_moderate(dot(jet.value, jet.value)) {
        if !(is_finite(jet.value.x) & is_finite(jet.value.y)) {
            return undrawn_colour(jet.value, pixel);
        }
        let bits = (bitcast<u32>(jet.value.x) | bitcast<u32>(jet.value.y)) & 0x7fffffffu;
        if bits == 0u {
            return settings.paper * (1.0 - settings.light);
        }
    }
    let polar = polar_from_jet(jet);
    let at = coordinates(jet, polar);
    let wheel = mean_wheel_colour(polar.turns, polar.turn_rate * sample_window(), settings.palette);
    var colour = mix(settings.paper, wheel, settings.phase);
    colour = mix(colour, blend_extremes(colour, polar.octaves, polar.octave_rate, settings.fade_octaves), settings.light);
    colour *= 1.0 - settings.checker * (0.3 - 0.3 * cells(at));
    let lines = polar_lines(polar);
    colour = mix(colour, settings.ink, lines * settings.first_lines * lines_of(at.place.x, at.rates.x, at.first));
    colour = mix(colour, settings.ink, lines * settings.second_lines * lines_of(at.place.y, at.rates.y, at.second));
    return mix(colour, settings.ink, settings.axes * axis_coverage(at, polar.turn_rate));
}

fn shade(pixel: vec2f) -> vec4f {
    let key = key_at(pixel, settings.key, 1.0);
    var jet = map_jet(offset_from_pixel(pixel));
    if key.inside {
        jet = key_jet(key, 2.0);
    }
    return vec4f(with_key_border(colour_of(jet, pixel), key), 1.0);
}
