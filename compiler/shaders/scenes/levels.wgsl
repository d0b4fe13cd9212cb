// levels: a real function of the plane as a colour map with level lines of constant width on the screen.
//
// Settings:
// | name         | type  | default          | range      | unit   | meaning |
// | spacing      | f32   | 0                | 0..        | value  | between level lines; 0: a quarter of color_scale |
// | color_scale  | f32   | 0                | 0..        | value  | where the colour has gone 71 % of the way to its end; 0: the runtime takes it from the view, a host that does not gets 1 |
// | line_width   | f32   | 1.2              | 0..20      | pixels | of level lines |
// | zero_width   | f32   | 2.6              | 0..20      | pixels | of the line f = 0; 0: like the others |
// | line_opacity | f32   | 0.5              | 0..1       |        | of level lines |
// | major        | u32   | 5                | 0..100     | lines  | every how many lines one is stronger; 0: none |
// | palette      | u32   | 0                | 0..2       |        | 0 blue-white-red, 1 indigo to cream, 2 paper |
// | ink          | vec3f | 0.010 0.012 0.02 | 0..1       | linear | colour of all lines |
// | key          | f32   | 0                | 0..0.5     | height | of the colour key: values from -4 to 4 color_scale; 0: none |
//
// Colours are linear rgb. Undefined values (NaN) are a quiet grey hatch; +∞ and -∞ are the ends of the palette
// with a hatch of the other slope. Where level lines come closer than they are wide they fade to an even tone, and
// the colour to its mean over the pixel; the zero line fades where several level lines share a pixel, because
// there a zero cannot be told from a pole.

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
    color_scale: f32,
    line_width: f32,
    zero_width: f32,
    line_opacity: f32,
    major: u32,
    palette: u32,
    ink: vec3f,
    key: f32,
}

struct Key {
    place: vec2f,
    step: vec2f,
    inside: bool,
    border: f32,
}

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> params: array<vec4f, 16>;
@group(0) @binding(2) var<uniform> settings: Settings;

// (∂f/∂x, ∂f/∂y, f) at the offset from the view's centre
fn field_grad(offset: vec2f) -> vec3f { return vec3f(); }

fn is_nan(x: f32) -> bool { return false; }
fn is_inf(x: f32) -> bool { return false; }
fn length2_safe(v: vec2f) -> f32 { return 0.0; }
fn diverging_ramp(t: f32) -> vec3f { return vec3f(); }
fn sequential_ramp(t: f32) -> vec3f { return vec3f(); }
fn line_coverage(offset: f32, width: f32, window: f32) -> f32 { return 0.0; }
fn line_train(u: f32, duty: f32, window: f32) -> f32 { return 0.0; }
fn offset_from_pixel(pixel: vec2f) -> vec2f { return vec2f(); }
fn sample_window() -> f32 { return 0.0; }
fn undefined_colour(pixel: vec2f) -> vec3f { return vec3f(); }
fn infinite_colour(pixel: vec2f, colour: vec3f) -> vec3f { return vec3f(); }
fn key_at(pixel: vec2f, side: f32, aspect: f32) -> Key { return Key(); }
fn with_key_border(colour: vec3f, key: Key) -> vec3f { return vec3f(); }

// Level lines may darken an area by no more than this on average, however dense they are.
const DENSEST: f32 = 0.34;

// The scale of the colours, 1 where none is set.
fn color_scale() -> f32 {
    return select(settings.color_scale, 1.0, settings.color_scale <= 1e-37);
}

// The real line onto (-1, 1): f/√(1 + f²) in units of color_scale.
fn saturate_value(value: f32) -> f32 {
    let x = clamp(value / color_scale(), -1e18, 1e18);
    return x * inverseSqrt(1.0 + x * x);
}

// Colour of a saturated value in [-1, 1].
fn palette_colour(t: f32) -> vec3f {
    switch settings.palette {
        case 1u: { return sequential_ramp(0.5 + 0.5 * t); }
        case 2u: { return vec3f(0.93, 0.92, 0.89) - 0.10 * max(-t, 0.0) * vec3f(1.0, 0.7, 0.45); }
        default: { return diverging_ramp(t); }
    }
}

// Mean colour where the value runs linearly over value ± reach. The part beyond ±8 color_scale has the end colours;
// the rest is integrated by the four-point Gauss rule.
fn mean_colour(value: f32, reach: f32) -> vec3f {
    let scale = color_scale();
    if reach < 0.05 * scale {
        return palette_colour(saturate_value(value));
    }
    let x = clamp(value / scale, -1e18, 1e18);
    let r = clamp(reach / scale, 0.01, 1e18);
    let low = clamp(x - r, -8.0, 8.0);
    let high = clamp(x + r, -8.0, 8.0);
    let below = clamp((-8.0 - (x - r)) / (2.0 * r), 0.0, 1.0);
    let above = clamp(((x + r) - 8.0) / (2.0 * r), 0.0, 1.0);
    let middle = 0.5 * (low + high) * scale;
    let arm = 0.5 * (high - low) * scale;
    let inner = 0.1739274225687269 * (ramp_at(middle - 0.8611363115940526 * arm) + ramp_at(middle + 0.8611363115940526 * arm))
        + 0.3260725774312731 * (ramp_at(middle - 0.3399810435848563 * arm) + ramp_at(middle + 0.3399810435848563 * arm));
    return below * palette_colour(-1.0) + above * palette_colour(1.0) + max(1.0 - below - above, 0.0) * inner;
}

fn ramp_at(value: f32) -> vec3f {
    return palette_colour(saturate_value(value));
}

fn level_spacing() -> f32 {
    return max(select(0.25 * color_scale(), settings.spacing, settings.spacing > 0.0), 1e-37);
}

// Coverage by lines at the multiples of `spacing`. `rate` is the change of value per pixel.
fn level_lines(value: f32, rate: f32, spacing: f32, width: f32) -> f32 {
    let u = value / spacing;
    let lines_per_pixel = min(rate / spacing, 1e9);
    let duty = min(lines_per_pixel * width, 1.0);
    let dimming = min(1.0, DENSEST / max(lines_per_pixel * width, 1e-20));
    // Past 2²² spacings f32 no longer resolves the place between two lines.
    if abs(u) > 4194304.0 || is_inf(u) {
        return duty * dimming;
    }
    return line_train(u, duty, lines_per_pixel * sample_window()) * dimming;
}

// Coverage by the line f = 0.
fn zero_line(value: f32, rate: f32) -> f32 {
    let lines_per_pixel = rate / level_spacing();
    if rate <= 0.0 || lines_per_pixel > 4.0 {
        return 0.0;
    }
    let offset = min(abs(value) / rate, 1e9);
    return line_coverage(offset, settings.zero_width, sample_window()) * (1.0 - smoothstep(1.0, 4.0, lines_per_pixel));
}

// All lines together, as opacity of the ink.
fn line_opacity(value: f32, rate: f32) -> f32 {
    let spacing = level_spacing();
    var opacity = settings.line_opacity * level_lines(value, rate, spacing, settings.line_width);
    if settings.major > 0u {
        let strong = level_lines(value, rate, spacing * f32(settings.major), 1.5 * settings.line_width);
        opacity = max(opacity, min(1.5 * settings.line_opacity, 1.0) * strong);
    }
    return max(opacity, zero_line(value, rate));
}

fn colour_of(jet: vec3f, pixel: vec2f) -> vec3f {
    let value = jet.z;
    if is_nan(value) {
        return undefined_colour(pixel);
    }
    if is_inf(value) {
        return infinite_colour(pixel, palette_colour(sign(value)));
    }
    if is_nan(jet.x) || is_nan(jet.y) {
        return palette_colour(saturate_value(value));
    }
    let rate = min(length2_safe(jet.xy), 1e37) * view.pixel;
    let colour = mean_colour(value, 0.5 * rate * sample_window());
    return mix(colour, settings.ink, line_opacity(value, rate));
}

// The key's values, and how they change to the right.
fn key_value(key: Key) -> vec3f {
    let reach = 4.0 * color_scale();
    return vec3f(reach * key.step.x / view.pixel, 0.0, reach * key.place.x);
}

fn shade(pixel: vec2f) -> vec4f {
    let key = key_at(pixel, settings.key, 8.0);
    var jet = field_grad(offset_from_pixel(pixel));
    if key.inside {
        jet = key_value(key);
    }
    return vec4f(with_key_border(colour_of(jet, pixel), key), 1.0);
}
