// glow: light that is emitted around the surface f = 0, added up along each ray in a box: nothing is hidden. f is to be
// like a distance, as fractals of folds give it; any other formula is made one by its gradient.
//
// Settings (see the record for ranges):
// | box, center            | world   | half size and centre of the box |
// | estimate               |         | d is 0: f divided by its gradient's length, 1: f |
// | epsilon                |         | width of the surface, in parts of the box's shortest half side |
// | falloff                |         | emission 0: ε/(|d| + ε)², 1: 1/(|d| + ε) |
// | gain                   |         | factor of the emission |
// | hot, body, halo        | linear  | colours at the surface, near it, and far from it |
// | color                  |         | a function that colours the light instead, such as an orbit trap |
// | understep              |         | step, as a part of |d| |
// | steps                  |         | shortest steps along the diagonal of the box |
// | fade                   |         | part of the box within which the light fades towards the walls |
// | jitter                 |         | how far samples begin at another place in each pixel |
// | vignette, grain        |         | darkening of the corners; noise that is added |
// | camera                 |         | where it is and how it sees |
// | backdrop, background   | linear  | behind the light: 0 one colour, 1 nothing |
//
// Undefined and infinite values emit nothing, and a constant nothing or, where it is a distance, an even haze. By its
// gradient a pole cannot be told from a zero, and glows too.

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
    estimate: u32,
    epsilon: f32,
    falloff: u32,
    gain: f32,
    hot: vec3f,
    body: vec3f,
    halo: vec3f,
    understep: f32,
    steps: u32,
    fade: f32,
    jitter: f32,
    vignette: f32,
    grain: f32,
    camera: Camera,
    background: vec3f,
    backdrop: u32,
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

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> params: array<vec4f, 16>;
@group(0) @binding(2) var<uniform> settings: Settings;

// (∂f/∂x, ∂f/∂y, ∂f/∂z, f)
fn field_grad(p: vec3f) -> vec4f { return vec4f(); }
// The function that colours the light: a number three times and 1, linear rgb and 2, or zeros where there is none.
fn field_colour(p: vec3f) -> vec4f { return vec4f(); }

fn is_nan(x: f32) -> bool { return false; }
fn is_finite(x: f32) -> bool { return false; }
fn distance_of(jet: vec4f, by_slope: bool, farthest: f32) -> f32 { return 0.0; }
fn sight_near(pixel: vec2f, camera: Camera, center: vec3f, half_size: vec3f) -> Sight { return Sight(); }
fn box_span(origin: vec3f, direction: vec3f, center: vec3f, half_size: vec3f) -> vec2f { return vec2f(); }
fn mean_glow(a: f32, b: f32, epsilon: f32, square: bool) -> f32 { return 0.0; }
fn filmic(radiance: vec3f) -> vec3f { return vec3f(); }
fn sample_phase(pixel: vec2f) -> f32 { return 0.0; }
fn pixel_noise(pixel: vec2f, seed: u32) -> f32 { return 0.0; }

// Distances are kept within this.
const FARTHEST: f32 = 1e15;

fn shortest_side() -> f32 {
    return min(settings.box.x, min(settings.box.y, settings.box.z));
}

// The field as a distance, by its slope, which is 1 where it is one; FARTHEST where that is not known.
fn distance_at(p: vec3f) -> f32 {
    return distance_of(field_grad(p), settings.estimate == 0u, FARTHEST);
}

// Colour of the light at a distance from the surface.
fn glow_colour(away: f32, epsilon: f32) -> vec3f {
    let near = epsilon / (away + epsilon);
    return mix(mix(settings.halo, settings.body, smoothstep(0.0, 0.5, near)), settings.hot, smoothstep(0.4, 1.0, near));
}

// The colour that the user's function gives, where there is one and it is defined.
fn own_colour(own: vec4f, otherwise: vec3f) -> vec3f {
    if own.w == 0.0 || is_nan(own.x) || is_nan(own.y) || is_nan(own.z) {
        return otherwise;
    }
    let part = clamp(own.rgb, vec3f(0.0), vec3f(1.0));
    if own.w == 2.0 {
        return part;
    }
    return mix(mix(settings.hot, settings.body, smoothstep(0.0, 0.5, part.x)), settings.halo, smoothstep(0.5, 1.0, part.x));
}

// How much light is left near the walls.
fn faded(p: vec3f) -> f32 {
    if settings.fade <= 0.0 {
        return 1.0;
    }
    let inside = 1.0 - abs(p - settings.center) / settings.box;
    let depth = smoothstep(vec3f(0.0), vec3f(settings.fade), inside);
    return depth.x * depth.y * depth.z;
}

// Light of a ray, over its lengths in the box.
fn glow_along(ray: Ray, span: vec2f, pixel: vec2f) -> vec3f {
    let start = max(span.x, 0.0);
    let extent = span.y - start;
    let diagonal = 2.0 * length(settings.box);
    let shortest = diagonal / f32(settings.steps);
    let epsilon = settings.epsilon * shortest_side();
    var light = vec3f();
    var t = 0.0;
    // length of the step before, and the field where it began
    var before = vec2f();
    // each step is at least the shortest one, but for the first
    for (var k = view.zero; k < settings.steps + 3u; k++) {
        let p = ray.origin + (start + t) * ray.direction;
        let here = distance_at(p);
        let reach = select(settings.understep * abs(here), 0.0, abs(here) >= FARTHEST);
        var step = clamp(reach, shortest, max(0.04 * diagonal, shortest));
        if k == 0u {
            step *= mix(1.0, sample_phase(pixel), settings.jitter);
        } else {
            let middle = ray.origin + (start + t - 0.5 * before.x) * ray.direction;
            let near = min(abs(before.y), abs(here));
            let crossing = (before.y < 0.0) != (here < 0.0);
            let colour = own_colour(field_colour(p), glow_colour(select(near, 0.0, crossing), epsilon));
            light += colour * (mean_glow(before.y, here, epsilon, settings.falloff == 0u) * before.x * faded(middle));
        }
        let left = extent - t;
        if left <= 0.0 {
            break;
        }
        step = min(step, left);
        before = vec2f(step, here);
        t = select(t + step, extent, step >= left);
    }
    return light * settings.gain;
}

fn shade(pixel: vec2f) -> vec4f {
    let sight = sight_near(pixel, settings.camera, settings.center, settings.box);
    let span = box_span(sight.ray.origin, sight.ray.direction, settings.center, settings.box);
    var light = vec3f();
    if span.y > max(span.x, 0.0) {
        light = glow_along(sight.ray, span, pixel);
    }
    let place = (pixel - 0.5 * view.size) / max(min(view.size.x, view.size.y), 1.0);
    let corner = max(1.0 - settings.vignette * dot(place, place), 0.0);
    let noise = settings.grain * (pixel_noise(pixel, u32(abs(view.time) * 24.0) & 0xffffu) - 0.5);
    let shown = filmic(light * corner) + vec3f(noise);
    if settings.backdrop == 1u {
        // light hides nothing, but what is brighter than its alpha cannot be told in most files
        let colour = clamp(shown, vec3f(0.0), vec3f(1.0));
        return vec4f(colour, max(colour.r, max(colour.g, colour.b)));
    }
    return vec4f(clamp(shown + settings.background * corner, vec3f(0.0), vec3f(1.0)), 1.0);
}
