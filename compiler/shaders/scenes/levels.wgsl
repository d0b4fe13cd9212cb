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
// | palette      | u32   | 0                | 0..10      |        | 0 blue-white-red, 1 indigo to cream, 2 paper, from 3 on named maps |
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
    colours: array<vec4f, 129>,  // of a named palette
}

struct Contours {
    spacing: f32,
    width: f32,
    zero_width: f32,
    opacity: f32,
    major: u32,
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

fn gradient_length(v: vec2f) -> f32 { return 0.0; }
fn offset_from_pixel(pixel: vec2f) -> vec2f { return vec2f(); }
fn contour_colour(value: f32, rate: f32, palette: u32, scale: f32, contours: Contours, ink: vec3f, pixel: vec2f) -> vec3f { return vec3f(); }
fn key_at(pixel: vec2f, side: f32, aspect: f32) -> Key { return Key(); }
fn scale_labels(key: Key, low: f32, middle: f32, high: f32) -> bool { return false; }
fn label_colour(colour: vec3f) -> vec3f { return vec3f(); }
fn with_key_border(colour: vec3f, key: Key) -> vec3f { return vec3f(); }

fn colour_entry(k: u32) -> vec3f {
    return settings.colours[k].rgb;
}

// The scale of the colours, 1 where none is set.
fn color_scale() -> f32 {
    return select(settings.color_scale, 1.0, settings.color_scale <= 1e-37);
}

fn contours() -> Contours {
    let spacing = max(select(0.25 * color_scale(), settings.spacing, settings.spacing > 0.0), 1e-37);
    return Contours(spacing, settings.line_width, settings.zero_width, settings.line_opacity, settings.major);
}

fn colour_of(jet: vec3f, pixel: vec2f) -> vec3f {
    let rate = gradient_length(jet.xy) * view.pixel;
    return contour_colour(jet.z, rate, settings.palette, color_scale(), contours(), settings.ink, pixel);
}

// The key's values, and how they change to the right.
fn key_value(key: Key) -> vec3f {
    let reach = 4.0 * color_scale();
    return vec3f(reach * key.step.x / view.pixel, 0.0, reach * key.place.x);
}

fn labelled(key: Key) -> bool {
    let reach = 4.0 * color_scale();
    return scale_labels(key, -reach, 0.0, reach);
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
