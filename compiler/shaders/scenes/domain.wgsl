// domain: a complex function as colour. Hue is the argument, rings are the modulus in octaves, zeros are black
// and poles white.
//
// Settings:
// | name         | type  | default          | range      | unit   | meaning |
// | modulus      | f32   | 1                | >0         | value  | |f| that is neither darkened nor lightened, on a ring |
// | palette      | u32   | 0                | 0..2       |        | 0 cubehelix rainbow, 1 OKLCH wheel, 2 HSV wheel |
// | rings        | u32   | 2                | 0..2       |        | 0 none, 1 waves, 2 steps (darker to lighter as |f| grows) |
// | ring_depth   | f32   | 0.35             | 0..1       |        | contrast of the rings |
// | ring_octaves | f32   | 1                | >0         | octave | from ring to ring |
// | fade_octaves | f32   | 6                | >0         | octave | from `modulus` to where the colour is half black or white |
// | phase_lines  | u32   | 0                | 0..360     |        | contour lines of the argument in a turn; 0: none |
// | phase_steps  | u32   | 0                | 0..360     |        | steps of brightness in a turn, like the rings; 0: none |
// | line_width   | f32   | 1.2              | 0..20      | pixels | of the phase lines |
// | ink          | vec3f | 0.010 0.012 0.02 | 0..1       | linear | colour of the phase lines |
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
}

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> params: array<vec4f, 16>;
@group(0) @binding(2) var<uniform> settings: Settings;

struct Jet {
    value: vec2f,
    dz: vec2f,
    dzbar: vec2f,
}

// f with ∂f/∂z and ∂f/∂z̄ at the offset from the view's centre
fn map_jet(offset: vec2f) -> Jet { return Jet(); }

fn is_nan(x: f32) -> bool { return false; }
fn is_inf(x: f32) -> bool { return false; }
fn length2_safe(v: vec2f) -> f32 { return 0.0; }
fn magnify_tiny(x: f32) -> f32 { return 0.0; }
fn cubehelix_rainbow(t: f32) -> vec3f { return vec3f(); }
fn oklch_wheel(t: f32) -> vec3f { return vec3f(); }
fn hsv_wheel(t: f32) -> vec3f { return vec3f(); }
fn line_train(u: f32, duty: f32, window: f32) -> f32 { return 0.0; }
fn saw_train(u: f32, window: f32) -> f32 { return 0.0; }
fn wave_train(u: f32, window: f32) -> f32 { return 0.0; }
fn hatch(pixel: vec2f, slope: f32, period: f32, duty: f32, window: f32) -> f32 { return 0.0; }

// A value in logarithmic polar form, with the lengths of the gradients of both coordinates per pixel.
struct Polar {
    octaves: f32,       // log2 |f|
    turns: f32,         // arg f / 2π, in [-1/2, 1/2]
    octave_rate: f32,
    turn_rate: f32,
}

// Rates beyond this many periods a pixel are the same to every filter.
const FASTEST: f32 = 1e6;

// World units from the centre of the view. The formula's function adds the centre, in all digits of its tier.
fn offset_from_pixel(pixel: vec2f) -> vec2f {
    return (pixel - 0.5 * view.size) * vec2f(view.pixel, -view.pixel);
}

// Side of one sample's share of a pixel, in pixels: the window of every filter here.
fn sample_window() -> f32 {
    return 1.0 / f32(max(view.samples, 1u));
}

// A number w = mantissa · 2^exponent, whose mantissa has squares and quotients that neither overflow nor underflow.
struct Scaled {
    mantissa: vec2f,
    exponent: f32,
}

// For finite w other than 0, subnormals included.
fn scale_value(w: vec2f) -> Scaled {
    let size = max(abs(w.x), abs(w.y));
    if size > 1e18 {
        return Scaled(w * 1.262177448353619e-29, 96.0);
    }
    if size < 1e-18 {
        let up = vec2f(magnify_tiny(w.x), magnify_tiny(w.y));
        if max(abs(up.x), abs(up.y)) < 1e-18 {
            return Scaled(up * 1.8446744073709552e19, -128.0);
        }
        return Scaled(up, -64.0);
    }
    return Scaled(w, 0.0);
}

// Length of (a ± conj b) / w, in radians or nepers per unit of z. With dw = a dz + b dz̄ the gradient of log|w| has
// the length |a/w + conj(b/w)| and that of arg w has |a/w - conj(b/w)|. `direction` is w/|w|.
fn rate_of_log(a: vec2f, b: vec2f, direction: vec2f, side: f32) -> f32 {
    let turned_a = vec2f(dot(a, direction), a.y * direction.x - a.x * direction.y);
    let turned_b = vec2f(dot(b, direction), b.x * direction.y - b.y * direction.x);
    return length2_safe(turned_a + side * turned_b);
}

// `length · 2^-exponent / size`, per pixel and in units of `period`; a rate that is not known (NaN, overflow) counts
// as none.
fn pixel_rate(length: f32, scaled: Scaled, size: f32, period: f32) -> f32 {
    if is_nan(length) || is_inf(length) {
        return 0.0;
    }
    let rate = length * exp2(-0.5 * scaled.exponent) / size * exp2(-0.5 * scaled.exponent);
    return min(rate * view.pixel / period, FASTEST);
}

// For finite values other than 0.
fn polar_from_jet(jet: Jet) -> Polar {
    let scaled = scale_value(jet.value);
    let size = length(scaled.mantissa);
    let direction = scaled.mantissa / size;
    let along = rate_of_log(jet.dz, jet.dzbar, direction, 1.0);
    let around = rate_of_log(jet.dz, jet.dzbar, direction, -1.0);
    return Polar(
        log2(size) + scaled.exponent,
        atan2(direction.y, direction.x) / 6.283185307179586,
        pixel_rate(along, scaled, size, 0.6931471805599453),
        pixel_rate(around, scaled, size, 6.283185307179586),
    );
}

fn wheel_colour(turns: f32) -> vec3f {
    switch settings.palette {
        case 1u: { return oklch_wheel(turns); }
        case 2u: { return hsv_wheel(turns); }
        default: { return cubehelix_rainbow(turns); }
    }
}

// Mean colour of the wheel over a window in turns, at most a whole one. Over a whole turn the evenly spaced rule
// is exact, so that unresolved hue is one calm grey.
fn mean_wheel_colour(turns: f32, window: f32) -> vec3f {
    if window < 0.04 {
        return wheel_colour(turns);
    }
    let w = min(window, 1.0);
    var sum = vec3f();
    for (var k = 0; k < 8; k++) {
        sum += wheel_colour(turns + w * ((f32(k) + 0.5) / 8.0 - 0.5));
    }
    return sum / 8.0;
}

// Brightness of the rings, 1 at their lightest.
fn ring_light(octaves: f32, rate: f32) -> f32 {
    let period = max(settings.ring_octaves, 1e-6);
    let u = octaves / period;
    let window = rate * sample_window() / period;
    switch settings.rings {
        case 0u: { return 1.0; }
        case 1u: { return 1.0 - settings.ring_depth * (1.0 - wave_train(u, window)); }
        default: { return 1.0 - settings.ring_depth * (1.0 - saw_train(u, window)); }
    }
}

fn phase_light(turns: f32, rate: f32) -> f32 {
    if settings.phase_steps == 0u {
        return 1.0;
    }
    let steps = f32(settings.phase_steps);
    return 1.0 - settings.ring_depth * (1.0 - saw_train(turns * steps, rate * steps * sample_window()));
}

// How far towards 1 an exponential rise has come: 1/2 at `fade_octaves`, smoothed over the octaves of one sample.
// The mean of a logistic over a window is nearly a wider logistic of the summed variance.
fn far_fade(octaves: f32, rate: f32) -> f32 {
    let steepness = 6.0 / max(settings.fade_octaves, 1e-3);
    let spread = steepness * min(rate, 1e4) * sample_window() / 6.283185307179586;
    let x = steepness * (octaves - settings.fade_octaves) * inverseSqrt(1.0 + spread * spread);
    return 1.0 / (1.0 + exp2(-clamp(x, -60.0, 60.0)));
}

// Zeros towards black and poles towards white, up to 88 %, so that rings and hue still show.
fn blend_extremes(colour: vec3f, octaves: f32, rate: f32) -> vec3f {
    let darkened = colour * (1.0 - 0.88 * far_fade(-octaves, rate));
    return mix(darkened, vec3f(1.0), 0.88 * far_fade(octaves, rate));
}

fn phase_line_coverage(turns: f32, rate: f32) -> f32 {
    if settings.phase_lines == 0u {
        return 0.0;
    }
    let lines = f32(settings.phase_lines);
    let per_pixel = rate * lines;
    let duty = min(per_pixel * settings.line_width, 1.0);
    let dimming = 1.0 - smoothstep(0.15, 0.6, duty);
    return line_train(turns * lines, duty, per_pixel * sample_window()) * dimming;
}

fn colour_of(polar: Polar) -> vec3f {
    let octaves = polar.octaves - log2(max(settings.modulus, 1e-37));
    let light = ring_light(octaves, polar.octave_rate) * phase_light(polar.turns, polar.turn_rate);
    let hue = mean_wheel_colour(polar.turns, polar.turn_rate * sample_window());
    let colour = blend_extremes(hue * light, octaves, polar.octave_rate);
    return mix(colour, settings.ink, 0.75 * phase_line_coverage(polar.turns, polar.turn_rate));
}

fn undefined_colour(pixel: vec2f) -> vec3f {
    return mix(vec3f(0.60), vec3f(0.47), hatch(pixel, 1.0, 7.0, 0.3, sample_window()));
}

fn overflow_colour(pixel: vec2f) -> vec3f {
    return mix(vec3f(1.0), vec3f(0.84), hatch(pixel, -1.0, 7.0, 0.25, sample_window()));
}

fn shade(pixel: vec2f) -> vec4f {
    let jet = map_jet(offset_from_pixel(pixel));
    // One infinite part makes a complex number infinite, whatever the other part is (C99, Annex G).
    if is_inf(jet.value.x) || is_inf(jet.value.y) {
        return vec4f(overflow_colour(pixel), 1.0);
    }
    if is_nan(jet.value.x) || is_nan(jet.value.y) {
        return vec4f(undefined_colour(pixel), 1.0);
    }
    let bits = (bitcast<u32>(jet.value.x) | bitcast<u32>(jet.value.y)) & 0x7fffffffu;
    if bits == 0u {
        return vec4f(0.0, 0.0, 0.0, 1.0);
    }
    return vec4f(colour_of(polar_from_jet(jet)), 1.0);
}
