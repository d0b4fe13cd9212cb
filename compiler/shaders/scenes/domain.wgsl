// domain: a complex function as colour. Hue is the argument, rings are the modulus in octaves, zeros are black
// and poles white.
//
// Settings:
// | name         | type  | default          | range      | unit   | meaning |
// | modulus      | f32   | 1                | >0         | value  | |f| that is neither darkened nor lightened, on a ring |
// | palette      | u32   | 0                | 0..3       |        | 0 cubehelix rainbow, 1 OKLCH wheel, 2 HSV wheel, 3 twilight |
// | rings        | u32   | 2                | 0..2       |        | 0 none, 1 waves, 2 steps (darker to lighter as |f| grows) |
// | ring_depth   | f32   | 0.35             | 0..1       |        | contrast of the rings |
// | ring_octaves | f32   | 1                | >0         | octave | from ring to ring |
// | fade_octaves | f32   | 6                | >0         | octave | from `modulus` to where the colour is half black or white |
// | phase_lines  | u32   | 0                | 0..360     |        | contour lines of the argument in a turn; 0: none |
// | phase_steps  | u32   | 0                | 0..360     |        | steps of brightness in a turn, like the rings; 0: none |
// | line_width   | f32   | 1.2              | 0..20      | pixels | of the phase lines |
// | ink          | vec3f | 0.010 0.012 0.02 | 0..1       | linear | colour of the phase lines |
// | key          | f32   | 0                | 0..0.5     | side   | of the colour key: f(z) = z on |re z|, |im z| ≤ 2; 0: none |
//
// Red is the positive real axis, cyan the negative. An exact zero is black; a value too large for f32 is white with
// faint stripes; an undefined value (NaN) is a quiet grey hatch. Each pattern is replaced by its mean where the
// derivative says that it is finer than the pixel.

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
    modulus: f32,
    palette: u32,
    rings: u32,
    ring_depth: f32,
    ring_octaves: f32,
    fade_octaves: f32,
    phase_lines: u32,
    phase_steps: u32,
    line_width: f32,
    ink: vec3f,
    key: f32,
    colours: array<vec4f, 129>,  // of a named palette
}

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> params: array<vec4f, 16>;
@group(0) @binding(2) var<uniform> settings: Settings;

struct Jet {
    value: vec2f,
    dz: vec2f,
    dzbar: vec2f,
    exponent: f32,
}

// f with ∂f/∂z and ∂f/∂z̄ at the offset from the view's centre
fn map_jet(offset: vec2f) -> Jet { return Jet(); }

struct Polar {
    octaves: f32,
    turns: f32,
    octave_rate: f32,
    turn_rate: f32,
}

struct PhaseStyle {
    palette: u32,
    modulus: f32,
    rings: u32,
    ring_depth: f32,
    ring_octaves: f32,
    fade_octaves: f32,
    phase_steps: u32,
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
fn undrawn_colour(value: vec2f, pixel: vec2f) -> vec3f { return vec3f(); }
fn polar_from_jet(jet: Jet) -> Polar { return Polar(); }
fn domain_colour(polar: Polar, style: PhaseStyle) -> vec3f { return vec3f(); }
fn phase_line_coverage(turns: f32, rate: f32, count: u32, width: f32) -> f32 { return 0.0; }
fn key_at(pixel: vec2f, side: f32, aspect: f32) -> Key { return Key(); }
fn key_jet(key: Key, reach: f32) -> Jet { return Jet(); }
fn with_key_border(colour: vec3f, key: Key) -> vec3f { return vec3f(); }

fn colour_entry(k: u32) -> vec3f {
    return settings.colours[k].rgb;
}

fn style() -> PhaseStyle {
    return PhaseStyle(
        settings.palette,
        settings.modulus,
        settings.rings,
        settings.ring_depth,
        settings.ring_octaves,
        settings.fade_octaves,
        settings.phase_steps,
    );
}

fn colour_of(jet: Jet, pixel: vec2f) -> vec3f {
    if !is_moderate(dot(jet.value, jet.value)) {
        if !(is_finite(jet.value.x) & is_finite(jet.value.y)) {
            return undrawn_colour(jet.value, pixel);
        }
        let bits = (bitcast<u32>(jet.value.x) | bitcast<u32>(jet.value.y)) & 0x7fffffffu;
        if bits == 0u {
            return vec3f();
        }
    }
    let polar = polar_from_jet(jet);
    let colour = domain_colour(polar, style());
    if settings.phase_lines == 0u {
        return colour;
    }
    let line = phase_line_coverage(polar.turns, polar.turn_rate, settings.phase_lines, settings.line_width);
    return mix(colour, settings.ink, 0.75 * line);
}

fn shade(pixel: vec2f) -> vec4f {
    let key = key_at(pixel, settings.key, 1.0);
    var jet = map_jet(offset_from_pixel(pixel));
    if key.inside {
        jet = key_jet(key, 2.0);
    }
    return vec4f(with_key_border(colour_of(jet, pixel), key), 1.0);
}
