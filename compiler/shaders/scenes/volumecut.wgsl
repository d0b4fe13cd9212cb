// volumecut: f as a luminous gas in a box, as in `volume`, cut open by a plane; on the cut the values by colour and
// contour lines. Kept is what lies on the side of the plane that its normal points away from.
//
// Settings (see the record for ranges):
// | box, center            | world    | half size and centre of the box |
// | normal                 |          | of the plane, towards what is cut away |
// | position               |          | of the plane: -1 and 1 where it leaves the box, 0 in the middle |
// | sweep, period          | seconds  | swing of the position |
// | color_scale            | value    | |f| of extinction `density` |
// | power                  |          | extinction is density (|f|/color_scale)^power |
// | density                |          | optical depth of half the shortest side of the box at |f| = color_scale |
// | signs                  |          | 0 both, 1 positive values alone, 2 negative values alone |
// | positive, negative     | linear   | emitted colours of both signs |
// | core                   |          | how far large values are white |
// | lighting               |          | how far the gradient's direction modulates the emission |
// | exposure, tone, gamma  |          | of the radiance; 0 Reinhard, 1 none; exponent 1/gamma after that |
// | jitter                 |          | how far stretches begin at another place in each sample |
// | steps                  |          | stretches along the diagonal of the box |
// | contour_spacing        | value    | between lines on the cut, 0: a quarter of color_scale |
// | line_width, zero_width | pixels   | of lines on the cut, and of the line f = 0 |
// | line_opacity, ink      | linear   | of lines on the cut |
// | cut_opacity            |          | of the colours on the cut |
// | camera                 |          | where it is and how it sees |
// | light_yaw, light_pitch | degrees  | of the light; yaw from the camera or from +x |
// | backdrop, background   | linear   | behind the box: 0 one colour, 1 nothing |
// | edge_width             | pixels   | of its edges |
//
// Where f is undefined the box is empty; infinite values are as dense as the largest. A constant is an even fog.

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

struct Gas {
    positive: vec3f,
    color_scale: f32,
    negative: vec3f,
    power: f32,
    density: f32,
    signs: u32,
    core: f32,
    lighting: f32,
    exposure: f32,
    tone: u32,
    gamma: f32,
    jitter: f32,
    steps: u32,
}

struct Settings {
    box: vec3f,
    center: vec3f,
    normal: vec3f,
    position: f32,
    ink: vec3f,
    sweep: f32,
    period: f32,
    gas: Gas,
    contour_spacing: f32,
    line_width: f32,
    zero_width: f32,
    line_opacity: f32,
    cut_opacity: f32,
    camera: Camera,
    light_yaw: f32,
    light_pitch: f32,
    light_from: u32,
    background: vec3f,
    backdrop: u32,
    edge_width: f32,
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

struct Medium {
    scale: f32,
    power: f32,
    density: f32,
    signs: u32,
    positive: vec3f,
    negative: vec3f,
    core: f32,
    lighting: f32,
    light: vec3f,
}

struct Matter {
    colour: vec3f,
    extinction: f32,
}

struct Stretches {
    extent: f32,
    count: f32,
    phase: f32,
}

struct Seen {
    light: vec3f,
    through: f32,
}

struct Kept {
    start: f32,
    end: f32,
    cut_first: bool,
    cut_last: bool,
}

struct Contours {
    spacing: f32,
    width: f32,
    zero_width: f32,
    opacity: f32,
    major: u32,
}

struct Layer {
    colour: vec3f,
    opacity: f32,
}

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> params: array<vec4f, 16>;
@group(0) @binding(2) var<uniform> settings: Settings;

// (∂f/∂x, ∂f/∂y, ∂f/∂z, f)
fn field_grad(p: vec3f) -> vec4f { return vec4f(); }

fn light_toward(camera: Camera, yaw: f32, pitch: f32, origin: u32) -> vec3f { return vec3f(); }
fn sight_near(pixel: vec2f, camera: Camera, center: vec3f, half_size: vec3f) -> Sight { return Sight(); }
fn box_span(origin: vec3f, direction: vec3f, center: vec3f, half_size: vec3f) -> vec2f { return vec2f(); }
fn box_edges(sight: Sight, t: f32, n: vec3f, center: vec3f, half_size: vec3f, width: f32) -> f32 { return 0.0; }
fn matter_of(jet: vec4f, medium: Medium) -> Matter { return Matter(); }
fn seen_nothing() -> Seen { return Seen(); }
fn medium_of(gas: Gas, half_size: vec3f, light: vec3f) -> Medium { return Medium(); }
fn stretches_of(extent: f32, half_size: vec3f, steps: u32, jitter: f32, pixel: vec2f) -> Stretches { return Stretches(); }
fn stretch_of(k: f32, stretches: Stretches) -> vec2f { return vec2f(); }
fn gas_over(seen: Seen, behind: vec4f, gas: Gas) -> vec4f { return vec4f(); }
fn with_edges(under: vec4f, sight: Sight, t: f32, center: vec3f, half_size: vec3f, width: f32, ink: Layer) -> vec4f { return vec4f(); }
fn seen_through(seen: Seen, matter: Matter, length: f32) -> Seen { return Seen(); }
fn is_nan(x: f32) -> bool { return false; }
fn direction_or(v: vec3f, fallback: vec3f) -> vec3f { return vec3f(); }
fn screen_rate(sight: Sight, t: f32, n: vec3f, gradient: vec3f) -> f32 { return 0.0; }
fn plane_offset(n: vec3f, center: vec3f, half_size: vec3f, position: f32) -> f32 { return 0.0; }
fn swept_position(position: f32, sweep: f32, period: f32) -> f32 { return 0.0; }
fn kept_part(ray: Ray, span: vec2f, n: vec3f, offset: f32) -> Kept { return Kept(); }
fn saturate_value(value: f32, scale: f32) -> f32 { return 0.0; }
fn contour_opacity(value: f32, rate: f32, contours: Contours) -> f32 { return 0.0; }
fn undefined_colour(pixel: vec2f) -> vec3f { return vec3f(); }
fn layer_on(under: vec4f, layer: Layer) -> vec4f { return vec4f(); }
fn layer_over(front: Layer, back: Layer) -> Layer { return Layer(); }

const EDGE: vec3f = vec3f(0.42, 0.45, 0.50);
// What has to come through for more of a ray to be looked at.
const THINNEST: f32 = 0.0005;

fn medium_scale() -> f32 {
    return select(settings.gas.color_scale, 1.0, settings.gas.color_scale <= 1e-37);
}

fn medium() -> Medium {
    let light = light_toward(settings.camera, settings.light_yaw, settings.light_pitch, settings.light_from);
    return medium_of(settings.gas, settings.box, light);
}

// What is behind the box: one colour, or nothing.
fn backdrop() -> vec4f {
    return select(vec4f(settings.background, 1.0), vec4f(), settings.backdrop == 1u);
}

fn edged(under: vec4f, sight: Sight, t: f32, strength: f32) -> vec4f {
    return with_edges(under, sight, t, settings.center, settings.box, settings.edge_width, Layer(EDGE, strength));
}

// The plane's normal, and its offset.
fn cut_plane() -> vec4f {
    let n = direction_or(settings.normal, vec3f(1.0, 0.0, 0.0));
    let position = swept_position(settings.position, settings.sweep, settings.period);
    return vec4f(n, plane_offset(n, settings.center, settings.box, position));
}

// The cut at distance t: the medium's colours by value, lines, and the edges of the cut.
fn cut_layer(jet: vec4f, t: f32, sight: Sight, n: vec3f, pixel: vec2f) -> Layer {
    let edges = Layer(EDGE, 0.8 * box_edges(sight, t, n, settings.center, settings.box, settings.edge_width));
    if is_nan(jet.w) {
        return layer_over(edges, Layer(0.35 * undefined_colour(pixel), settings.cut_opacity));
    }
    let size = saturate_value(jet.w, medium_scale());
    let fill = abs(size) * select(settings.gas.positive, settings.gas.negative, size < 0.0);
    let rate = screen_rate(sight, t, n, jet.xyz);
    let spacing = max(select(0.25 * medium_scale(), settings.contour_spacing, settings.contour_spacing > 0.0), 1e-37);
    let contours = Contours(spacing, settings.line_width, settings.zero_width, settings.line_opacity, 0u);
    let lines = Layer(settings.ink, select(contour_opacity(jet.w, rate, contours), 0.0, rate < 0.0));
    return layer_over(edges, layer_over(lines, Layer(fill, settings.cut_opacity)));
}

// What a ray meets in the part of the box that is kept.
struct Met {
    seen: Seen,   // the medium
    cut: Layer,   // in front of it or behind it
}

// The cut first, where there is one, then the medium by the midpoint rule in each stretch.
fn met_in_part(sight: Sight, part: Kept, n: vec3f, pixel: vec2f) -> Met {
    let medium = medium();
    let stretches = stretches_of(part.end - part.start, settings.box, settings.gas.steps, settings.gas.jitter, pixel);
    let is_cut = part.cut_first || part.cut_last;
    let cut_t = select(part.end, part.start, part.cut_first);
    var met = Met(seen_nothing(), Layer(vec3f(), 0.0));
    for (var k = f32(view.zero) - select(0.0, 1.0, is_cut); (k <= stretches.count) & (met.seen.through > THINNEST); k += 1.0) {
        let stretch = part.start + stretch_of(k, stretches);
        let t = select(0.5 * (stretch.x + stretch.y), cut_t, k < 0.0);
        let jet = field_grad(sight.ray.origin + t * sight.ray.direction);
        if k < 0.0 {
            met.cut = cut_layer(jet, t, sight, n, pixel);
        } else {
            met.seen = seen_through(met.seen, matter_of(jet, medium), stretch.y - stretch.x);
        }
    }
    return met;
}

fn shade(pixel: vec2f) -> vec4f {
    let sight = sight_near(pixel, settings.camera, settings.center, settings.box);
    let span = box_span(sight.ray.origin, sight.ray.direction, settings.center, settings.box);
    if span.y <= max(span.x, 0.0) {
        return backdrop();
    }
    let plane = cut_plane();
    let part = kept_part(sight.ray, vec2f(max(span.x, 0.0), span.y), plane.xyz, plane.w);
    var colour = edged(backdrop(), sight, span.y, 0.4);
    if part.end > part.start {
        let met = met_in_part(sight, part, plane.xyz, pixel);
        if part.cut_last {
            colour = layer_on(colour, met.cut);
        }
        colour = gas_over(met.seen, colour, settings.gas);
        if part.cut_first {
            colour = layer_on(colour, met.cut);
        }
    }
    if span.x > 0.0 {
        colour = edged(colour, sight, span.x, 0.55);
    }
    return vec4f(clamp(colour.rgb, vec3f(0.0), vec3f(1.0)), colour.a);
}
