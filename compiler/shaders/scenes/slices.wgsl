// slices: a real function of space as a colour map with contour lines on planes in a box: three planes that stand still,
// quiet, and one active slice across any axis, in full colour. The planes are opaque; the nearest is seen.
//
// Settings (see the record for ranges):
// | box, center           | world   | half size and centre of the box |
// | axis                  |         | normal of the active slice |
// | position              |         | of the active slice: -1 and 1 where it leaves the box, 0 in the middle |
// | sweep, period         | seconds | swing of the position |
// | reference             |         | 0 the far walls, 1 three planes, 2 none |
// | planes                |         | where the three planes are, -1..1 |
// | reference_strength    |         | of colours and lines of walls and planes |
// | color_scale, spacing  | value   | of colours; between lines, 0: a quarter of color_scale |
// | line_width            | pixels  | of contour lines |
// | zero_width            | pixels  | of the line f = 0 |
// | line_opacity, major   |         | of contour lines; every how many one is stronger |
// | palette               |         | colours of values |
// | ink                   | linear  | colour of contour lines |
// | grid                  | world   | between lines of the grid, 0: automatic |
// | grid_opacity          |         | of the grid |
// | axis_width            | pixels  | of the lines where a coordinate is 0 |
// | edge_width            | pixels  | of the box's edges |
// | camera                |         | where it is and how it sees |
// | backdrop, background  | linear  | 0 ground and sky, 1 plain, 2 transparent; colour of the horizon |
//
// Undefined values (NaN) are a grey hatch, infinite ones the end colours with a hatch of the other slope. A constant
// has one colour and no lines.

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

struct Camera {
    eye: vec3f,
    yaw: f32,
    aim: vec3f,
    pitch: f32,
    up: vec3f,
    distance: f32,
    fov: f32,
    extent: f32,
    camera: u32,
    projection: u32,
}

struct Settings {
    box: vec3f,
    center: vec3f,
    axis: vec3f,
    position: f32,
    planes: vec3f,
    sweep: f32,
    period: f32,
    reference: u32,
    reference_strength: f32,
    color_scale: f32,
    spacing: f32,
    line_width: f32,
    zero_width: f32,
    line_opacity: f32,
    major: u32,
    ink: vec3f,
    grid: f32,
    grid_opacity: f32,
    axis_width: f32,
    edge_width: f32,
    camera: Camera,
    background: vec3f,
    backdrop: u32,
    palette: u32,
    colours: array<vec4f, 129>,  // of a named palette
}

struct Ray {
    origin: vec3f,
    direction: vec3f,  // of length 1
}

struct Sight {
    ray: Ray,
    forward: vec3f,
    slope: f32,
    parallel: bool,
    before: f32,
}

struct Layer {
    colour: vec3f,
    opacity: f32,
}

struct Contours {
    spacing: f32,
    width: f32,
    zero_width: f32,
    opacity: f32,
    major: u32,
}

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> params: array<vec4f, 16>;
@group(0) @binding(2) var<uniform> settings: Settings;

// (∂f/∂x, ∂f/∂y, ∂f/∂z, f)
fn field_grad(p: vec3f) -> vec4f { return vec4f(); }

fn direction_or(v: vec3f, fallback: vec3f) -> vec3f { return vec3f(); }
fn sight_at(pixel: vec2f, camera: Camera, center: vec3f, half_size: vec3f) -> Sight { return Sight(); }
fn screen_rate(sight: Sight, t: f32, n: vec3f, gradient: vec3f) -> f32 { return 0.0; }
fn plane_distance(ray: Ray, n: vec3f, offset: f32) -> f32 { return 0.0; }
fn plane_offset(n: vec3f, center: vec3f, half_size: vec3f, position: f32) -> f32 { return 0.0; }
fn swept_position(position: f32, sweep: f32, period: f32) -> f32 { return 0.0; }
fn box_span(origin: vec3f, direction: vec3f, center: vec3f, half_size: vec3f) -> vec2f { return vec2f(); }
fn box_normal(p: vec3f, center: vec3f, half_size: vec3f) -> vec3f { return vec3f(); }
fn with_edges(under: vec4f, sight: Sight, t: f32, center: vec3f, half_size: vec3f, width: f32, ink: Layer) -> vec4f { return vec4f(); }
fn coordinate_lines(sight: Sight, t: f32, n: vec3f, spacing: f32, width: f32) -> f32 { return 0.0; }
fn axis_lines(sight: Sight, t: f32, n: vec3f, width: f32) -> vec4f { return vec4f(); }
fn unit_axis(k: u32) -> vec3f { return vec3f(); }
fn round_spacing(x: f32) -> f32 { return 0.0; }
fn stage_at(backdrop: u32, ray: Ray, center: vec3f, half_size: vec3f, background: vec3f) -> vec4f { return vec4f(); }
fn contour_colour(value: f32, rate: f32, palette: u32, scale: f32, contours: Contours, ink: vec3f, pixel: vec2f) -> vec3f { return vec3f(); }

const PAPER: vec3f = vec3f(0.86, 0.86, 0.85);
const EDGE: vec3f = vec3f(0.012, 0.014, 0.02);

// A plane that a ray meets.
struct Slice {
    t: f32,
    normal: vec3f,
    chosen: bool,
    met: bool,
}

fn colour_entry(k: u32) -> vec3f {
    return settings.colours[k].rgb;
}

fn color_scale() -> f32 {
    return select(settings.color_scale, 1.0, settings.color_scale <= 1e-37);
}

// Of the active slice, or of what stands still.
fn contours(chosen: bool) -> Contours {
    let spacing = max(select(0.25 * color_scale(), settings.spacing, settings.spacing > 0.0), 1e-37);
    if chosen {
        return Contours(spacing, settings.line_width, settings.zero_width, settings.line_opacity, settings.major);
    }
    return Contours(4.0 * spacing, settings.line_width, 0.75 * settings.zero_width, settings.line_opacity, 0u);
}

// The k-th plane: 0 the active one, then those across x, y and z.
fn slice_at(k: u32, sight: Sight, span: vec2f) -> Slice {
    if k == 0u {
        let n = direction_or(settings.axis, vec3f(0.0, 0.0, 1.0));
        let position = swept_position(settings.position, settings.sweep, settings.period);
        return met_slice(sight, n, position, span, true);
    }
    return met_slice(sight, unit_axis(k - 1u), settings.planes[k - 1u], span, false);
}

fn met_slice(sight: Sight, n: vec3f, position: f32, span: vec2f, chosen: bool) -> Slice {
    let t = plane_distance(sight.ray, n, plane_offset(n, settings.center, settings.box, position));
    let slack = 1e-5 * abs(span.y);
    return Slice(t, n, chosen, t > 0.0 && t >= span.x - slack && t <= span.y + slack && span.x <= span.y);
}

// The wall at which the ray leaves the box: one of those three that are not on the side where it begins.
fn far_wall(sight: Sight, span: vec2f) -> Slice {
    let n = box_normal(sight.ray.origin + span.y * sight.ray.direction, settings.center, settings.box);
    let from_center = dot(sight.ray.origin - settings.center, n);
    return Slice(span.y, abs(n), false, from_center < 0.0 || (from_center == 0.0 && n.x + n.y + n.z > 0.0));
}

// The nearer of two; the first where they are at the same distance.
fn nearer_slice(a: Slice, b: Slice) -> Slice {
    if b.met && (!a.met || b.t < a.t - 1e-6 * abs(a.t)) {
        return b;
    }
    return a;
}

// The nearest plane; of two at the same distance the active one.
fn nearest_slice(sight: Sight, span: vec2f) -> Slice {
    var nearest = slice_at(0u, sight, span);
    if settings.reference == 0u {
        return nearer_slice(nearest, far_wall(sight, span));
    }
    if settings.reference == 1u {
        for (var k = 1u; k < 4u; k++) {
            nearest = nearer_slice(nearest, slice_at(k, sight, span));
        }
    }
    return nearest;
}

// What a plane shows: the picture of f, and the grid where it stands still.
fn slice_colour(slice: Slice, sight: Sight, pixel: vec2f) -> vec3f {
    let jet = field_grad(sight.ray.origin + slice.t * sight.ray.direction);
    let rate = screen_rate(sight, slice.t, slice.normal, jet.xyz);
    let colour = contour_colour(jet.w, rate, settings.palette, color_scale(), contours(slice.chosen), settings.ink, pixel);
    if slice.chosen {
        return colour;
    }
    return gridded(mix(PAPER, colour, settings.reference_strength), slice.t, slice.normal, sight);
}

// Coordinate lines on a colour.
fn gridded(colour: vec3f, t: f32, n: vec3f, sight: Sight) -> vec3f {
    let extent = max(settings.box.x, max(settings.box.y, settings.box.z));
    let spacing = select(round_spacing(0.51 * extent), settings.grid, settings.grid > 0.0);
    let lines = mix(colour, EDGE, settings.grid_opacity * coordinate_lines(sight, t, n, spacing, 1.0));
    let axes = axis_lines(sight, t, n, settings.axis_width);
    return mix(lines, axes.rgb, 0.85 * axes.a);
}

fn edged(under: vec4f, t: f32, strength: f32, sight: Sight) -> vec4f {
    return with_edges(under, sight, t, settings.center, settings.box, settings.edge_width, Layer(EDGE, strength));
}

fn shade(pixel: vec2f) -> vec4f {
    let sight = sight_at(pixel, settings.camera, settings.center, settings.box);
    let span = box_span(sight.ray.origin, sight.ray.direction, settings.center, settings.box);
    var colour = stage_at(settings.backdrop, sight.ray, settings.center, settings.box, settings.background);
    if span.y <= max(span.x, 0.0) {
        return colour;
    }
    let slice = nearest_slice(sight, span);
    if slice.met {
        colour = vec4f(slice_colour(slice, sight, pixel), 1.0);
    }
    if !slice.met || slice.t >= span.y * (1.0 - 1e-5) {
        colour = edged(colour, span.y, 0.5, sight);
    }
    if span.x > 0.0 {
        colour = edged(colour, span.x, 0.8, sight);
    }
    // opaque where nothing else is asked for: then no alpha is computed
    return vec4f(colour.rgb, select(1.0, colour.a, settings.backdrop == 2u));
}
