// volume: f as a luminous gas in a box, denser and brighter where |f| is larger, in two colours by the sign. Emission
// and absorption along each ray converge to their integral; the opacity of a stretch is right for any length.
//
// Settings (see the record for ranges):
// | box, center            | world    | half size and centre of the box |
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
// | steps_by               |          | of their optical depths: 0 as is best, 1 samples, 2 closed forms where there are any |
// | emission               |          | 0 graded by the values, 1 even: of the colour of the sign |
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
    gas: Gas,
    steps_by: u32,
    emission: u32,
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

struct Layer {
    colour: vec3f,
    opacity: f32,
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

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> params: array<vec4f, 16>;
@group(0) @binding(2) var<uniform> settings: Settings;

// (∂f/∂x, ∂f/∂y, ∂f/∂z, f)
fn field_grad(p: vec3f) -> vec4f { return vec4f(); }
// ∫ |f|^power over the values of `signs` along o + t d from t = a to t = b, that power, and those signs as in `Gas`; power 0 for none
fn field_column(o: vec3f, d: vec3f, a: f32, b: f32) -> vec3f { return vec3f(); }

fn light_toward(camera: Camera, yaw: f32, pitch: f32, origin: u32) -> vec3f { return vec3f(); }
fn sight_near(pixel: vec2f, camera: Camera, center: vec3f, half_size: vec3f) -> Sight { return Sight(); }
fn box_span(origin: vec3f, direction: vec3f, center: vec3f, half_size: vec3f) -> vec2f { return vec2f(); }
fn matter_of(jet: vec4f, medium: Medium) -> Matter { return Matter(); }
fn seen_nothing() -> Seen { return Seen(); }
fn medium_of(gas: Gas, half_size: vec3f, light: vec3f) -> Medium { return Medium(); }
fn stretches_of(extent: f32, half_size: vec3f, steps: u32, jitter: f32, pixel: vec2f) -> Stretches { return Stretches(); }
fn stretch_of(k: f32, stretches: Stretches) -> vec2f { return vec2f(); }
fn gas_over(seen: Seen, behind: vec4f, gas: Gas) -> vec4f { return vec4f(); }
fn with_edges(under: vec4f, sight: Sight, t: f32, center: vec3f, half_size: vec3f, width: f32, ink: Layer) -> vec4f { return vec4f(); }
fn seen_through(seen: Seen, matter: Matter, length: f32) -> Seen { return Seen(); }
fn depth_of_column(column: vec3f, medium: Medium) -> f32 { return 0.0; }
fn seen_through_depth(seen: Seen, colour: vec3f, depth: f32) -> Seen { return Seen(); }
fn seen_through_column(seen: Seen, near: Matter, far: Matter, depth: f32) -> Seen { return Seen(); }

const EDGE: vec3f = vec3f(0.42, 0.45, 0.50);
// What has to come through for more of a ray to be looked at.
const THINNEST: f32 = 0.0005;
const BY_SAMPLES: u32 = 1u;
const EVEN: u32 = 1u;

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

// Colour of even emission where the value is of this sign.
fn even_colour(below: bool) -> vec3f {
    return select(settings.gas.positive, settings.gas.negative, below);
}

// Whether what a ray emits is of one colour: then it is as much of it as the ray is opaque.
fn is_of_one_colour() -> bool {
    return settings.emission == EVEN && (settings.gas.signs != 0u || all(settings.gas.positive == settings.gas.negative));
}

// What the medium is made of at a point.
fn matter_at(p: vec3f, medium: Medium) -> Matter {
    let jet = field_grad(p);
    let matter = matter_of(jet, medium);
    return Matter(select(matter.colour, even_colour(jet.w < 0.0), settings.emission == EVEN), matter.extinction);
}

// Radiance of the medium on a ray in the box, and what comes through. A stretch is as its middle; where the density integrates, it has
// its own optical depth and the colours of two points. A ray of one colour is one stretch.
fn seen_in_box(ray: Ray, span: vec2f, pixel: vec2f) -> Seen {
    let medium = medium();
    let start = max(span.x, 0.0);
    let stretches = stretches_of(span.y - start, settings.box, settings.gas.steps, settings.gas.jitter, pixel);
    let by_columns = settings.steps_by != BY_SAMPLES;
    var whole = by_columns && is_of_one_colour();
    var seen = seen_nothing();
    var k = f32(view.zero);
    // ends: each turn but one takes a stretch
    while (k <= stretches.count) & (seen.through > THINNEST) {
        let stretch = start + select(stretch_of(k, stretches), vec2f(0.0, stretches.extent), whole);
        var depth = -1.0;
        if by_columns {
            depth = depth_of_column(field_column(ray.origin, ray.direction, stretch.x, stretch.y), medium);
        }
        if whole && depth >= 0.0 {
            return seen_through_depth(seen, even_colour(settings.gas.signs == 2u), depth);
        }
        if whole {
            whole = false;
            continue;
        }
        // one place that evaluates the field: the middle, or both points; a shader that knows which has no loop
        let count = select(1u, 2u, depth >= 0.0);
        let apart = select(0.0, 0.2886751345948129 * (stretch.y - stretch.x), depth >= 0.0);
        var near = Matter();
        var far = Matter();
        var j = 0u;
        // ends: one turn or two
        loop {
            near = far;
            let t = 0.5 * (stretch.x + stretch.y) + select(apart, -apart, j == 0u);
            far = matter_at(ray.origin + t * ray.direction, medium);
            j++;
            if j >= count {
                break;
            }
        }
        if depth >= 0.0 {
            seen = seen_through_column(seen, near, far, depth);
        } else {
            seen = seen_through(seen, far, stretch.y - stretch.x);
        }
        k += 1.0;
    }
    return seen;
}

fn shade(pixel: vec2f) -> vec4f {
    let sight = sight_near(pixel, settings.camera, settings.center, settings.box);
    let span = box_span(sight.ray.origin, sight.ray.direction, settings.center, settings.box);
    if span.y <= max(span.x, 0.0) {
        return backdrop();
    }
    let seen = seen_in_box(sight.ray, span, pixel);
    var colour = gas_over(seen, edged(backdrop(), sight, span.y, 0.4), settings.gas);
    if span.x > 0.0 {
        colour = edged(colour, sight, span.x, 0.55);
    }
    // opaque where nothing else is asked for: then no alpha is computed
    return vec4f(colour.rgb, select(1.0, colour.a, settings.backdrop == 1u));
}
