// scatter: f as the density of a cloud in a box, lit by a distant light and from all around. Light is scattered once on
// its way to the eye and weakened before and after, as it is in the integral along each ray.
//
// Settings (see the record for ranges):
// | box, center            | world    | half size and centre of the box |
// | absorption, scattering |          | optical depths of half the shortest side of the box where f = 1, linear rgb |
// | g                      |          | asymmetry of the phase function: 1 forwards, 0 all ways alike, -1 backwards |
// | light                  | linear   | irradiance of the light |
// | ambient                | linear   | radiance from all around |
// | exposure, tone, gamma  |          | of the radiance; 0 Reinhard, 1 none; exponent 1/gamma after that |
// | jitter                 |          | how far stretches begin at another place in each sample |
// | steps, light_steps     |          | stretches along the diagonal of the box, of rays and of the ways of the light |
// | steps_by               |          | of optical depths: 0 as is best, 1 samples, 2 closed forms where there are any |
// | camera                 |          | where it is and how it sees |
// | light_yaw, light_pitch | degrees  | of the light; yaw from the camera or from +x |
// | background, backdrop   | linear   | behind the box; 0 sky, 1 one colour, 2 nothing |
// | edge_width             | pixels   | of the box's edges |
//
// Where f is negative or undefined the box is empty; larger values than the densest, infinite ones too, are as that.

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
    absorption: vec3f,
    scattering: vec3f,
    g: f32,
    light: vec3f,
    ambient: vec3f,
    exposure: f32,
    tone: u32,
    gamma: f32,
    jitter: f32,
    steps: u32,
    light_steps: u32,
    steps_by: u32,
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

struct Layer {
    colour: vec3f,
    opacity: f32,
}

// A way through the box, cut into stretches.
struct Way {
    ray: Ray,
    extent: f32,
    count: f32,
    phase: f32,  // in 0..1, of the first border
}

// What does not change along a ray: coefficients per world unit where f = 1, and radiance that is scattered into the
// ray, per scattered part of the medium.
struct Cloud {
    scattering: vec3f,
    extinction: vec3f,
    direct: vec3f,    // of the light, not weakened yet
    ambient: vec3f,
}

struct Scattered {
    light: vec3f,
    through: vec3f,
}

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> params: array<vec4f, 16>;
@group(0) @binding(2) var<uniform> settings: Settings;

fn field(p: vec3f) -> f32 { return 0.0; }
// ∫ max(f, 0) along o + t d from t = a to t = b, and 1, 1; zeros for none
fn field_column(o: vec3f, d: vec3f, a: f32, b: f32) -> vec3f { return vec3f(); }

fn is_nan(x: f32) -> bool { return false; }
fn column_within(column: vec3f, most: f32) -> f32 { return 0.0; }
fn light_toward(camera: Camera, yaw: f32, pitch: f32, origin: u32) -> vec3f { return vec3f(); }
fn sight_near(pixel: vec2f, camera: Camera, center: vec3f, half_size: vec3f) -> Sight { return Sight(); }
fn sky_at(direction: vec3f, background: vec3f) -> vec3f { return vec3f(); }
fn box_span(origin: vec3f, direction: vec3f, center: vec3f, half_size: vec3f) -> vec2f { return vec2f(); }
fn with_edges(under: vec4f, sight: Sight, t: f32, center: vec3f, half_size: vec3f, width: f32, ink: Layer) -> vec4f { return vec4f(); }
fn unkept_part(x: f32, kept: f32) -> f32 { return 0.0; }
fn stretch_at(k: f32, count: f32, phase: f32, extent: f32) -> vec2f { return vec2f(); }
fn part_at(k: f32, count: f32, phase: f32, extent: f32) -> vec2f { return vec2f(); }
fn sample_phase(pixel: vec2f) -> f32 { return 0.0; }
fn displayed(radiance: vec3f, exposure: f32, tone: u32, gamma: f32) -> vec3f { return vec3f(); }

const EDGE: vec3f = vec3f(0.42, 0.45, 0.50);
// Of displayed radiance and of what is behind, at most this much is left out where a ray ends early.
const LEAST: f32 = 0.0005;
// Denser values count as if half the shortest side of the box had this optical depth: light that goes in as far as points
// are rounded still comes through.
const DENSEST: f32 = 1e4;
// Of optical depths: what comes through is 0 in f32.
const DEEPEST: f32 = 110.0;
// 1/(4 π)
const PER_SPHERE: f32 = 0.07957747154594767;
// 1 over the golden ratio: phases of the ways of the light from one stretch to the next.
const GOLDEN: f32 = 0.6180339887498949;
const BY_SAMPLES: u32 = 1u;

// The phase function of Henyey and Greenstein ("Diffuse radiation in the galaxy", Astrophysical Journal 93, 1941), per
// steradian, of integral 1 over the sphere: (1 - g²)/(4 π (1 + g² - 2 g cos θ)^(3/2)) with the angle θ between the ways
// of the light before and after. Both unit vectors are against those ways. For no |g| < 1 does the denominator cancel:
// it is (1 - |g|)² + |g| |a ∓ b|².
fn phase_function(g: f32, a: vec3f, b: vec3f) -> f32 {
    let size = abs(g);
    let apart = a - select(b, -b, g < 0.0);
    let rest = 1.0 - size;
    let square = rest * rest + size * dot(apart, apart);
    return PER_SPHERE * rest * (1.0 + size) / (square * sqrt(square));
}

fn greatest(v: vec3f) -> f32 {
    return max(v.x, max(v.y, v.z));
}

fn densest() -> f32 {
    return DENSEST / max(greatest(settings.absorption + settings.scattering), 1e-20);
}

fn density_of(value: f32) -> f32 {
    return select(clamp(value, 0.0, densest()), 0.0, is_nan(value));
}

// The integral of the density along a way: in closed form where there is one that is a number, and 1, else by the midpoint rule, and 0.
fn column_of(way: Way) -> vec2f {
    if settings.steps_by != BY_SAMPLES {
        let exact = column_within(field_column(way.ray.origin, way.ray.direction, 0.0, way.extent), densest() * way.extent);
        if exact >= 0.0 {
            return vec2f(exact, 1.0);
        }
    }
    var column = 0.0;
    for (var k = f32(view.zero); k < way.count; k += 1.0) {
        let part = part_at(k, way.count, way.phase, way.extent);
        let middle = way.ray.origin + 0.5 * (part.x + part.y) * way.ray.direction;
        column += (part.y - part.x) * density_of(field(middle));
    }
    return vec2f(column, 0.0);
}

// A way of this extent, in as many stretches as the diagonal's number says.
fn way_of(ray: Ray, extent: f32, steps: u32, phase: f32) -> Way {
    let diagonal = 2.0 * length(settings.box);
    let count = max(ceil(min(extent / diagonal, 1.0) * f32(steps)), 1.0);
    return Way(ray, extent, count, mix(0.5, phase, settings.jitter));
}

// Towards the light. A component of less than the rounding of angles is 0, so that light along a face stays in it.
fn light_direction() -> vec3f {
    let light = light_toward(settings.camera, settings.light_yaw, settings.light_pitch, settings.light_from);
    return select(light, vec3f(0.0), abs(light) < vec3f(1e-5));
}

// From a point of the box towards the light, to where the box ends. On an axis along which the light does not go it is in
// the middle for that: points of a face may be rounded to outside.
fn extent_to_light(p: vec3f, light: vec3f) -> f32 {
    let level = select(p, settings.center, light == vec3f(0.0));
    return max(box_span(level, light, settings.center, settings.box).y, 0.0);
}

// The mean of exp(-s) for s evenly between 0 and x > 0, of which exp(-x) is `kept`.
fn mean_kept(x: vec3f, kept: vec3f) -> vec3f {
    return vec3f(unkept_part(x.x, kept.x), unkept_part(x.y, kept.y), unkept_part(x.z, kept.z)) / x;
}

// The mean of exp(-x) for x evenly between a and b, both >= 0.
fn mean_transmittance(a: vec3f, b: vec3f) -> vec3f {
    let x = max(abs(b - a), vec3f(1e-20));
    return exp(-min(min(a, b), vec3f(DEEPEST))) * mean_kept(x, exp(-x));
}

// What a stretch adds behind what has been seen, with the columns x of itself, y and z from its ends to the light. It is
// uniform, and the light's optical depth changes evenly along it: in a uniform medium that is exact for any length.
fn seen_behind(seen: Scattered, columns: vec3f, cloud: Cloud) -> Scattered {
    let depth = cloud.extinction * columns.x;
    let kept = exp(-min(depth, vec3f(DEEPEST)));
    let direct = cloud.direct * mean_transmittance(cloud.extinction * columns.y, cloud.extinction * columns.z + depth);
    let scattered = cloud.scattering * columns.x * (direct + cloud.ambient * mean_kept(max(depth, vec3f(1e-20)), kept));
    return Scattered(seen.light + seen.through * scattered, seen.through * kept);
}

fn cloud_on(ray: Ray, light: vec3f) -> Cloud {
    let unit = min(settings.box.x, min(settings.box.y, settings.box.z));
    let scattering = settings.scattering / unit;
    let direct = settings.light * phase_function(settings.g, ray.direction, light);
    return Cloud(scattering, settings.absorption / unit + scattering, direct, settings.ambient);
}

// What has to come through for more of a ray to be looked at. Of what is behind, light cannot scatter more than
// the albedo of what comes through.
fn least_through(cloud: Cloud) -> f32 {
    let albedo = cloud.scattering / max(cloud.extinction, vec3f(1e-37));
    return LEAST / max(settings.exposure * greatest(albedo * (cloud.direct + cloud.ambient)), 1.0);
}

// Light that is scattered towards the eye on a ray in the box, and what comes through.
fn scattered_in_box(ray: Ray, span: vec2f, pixel: vec2f) -> Scattered {
    let light = light_direction();
    let cloud = cloud_on(ray, light);
    let least = least_through(cloud);
    let start = max(span.x, 0.0);
    let phase = sample_phase(pixel);
    let way = way_of(ray, span.y - start, settings.steps, phase);
    var seen = Scattered(vec3f(), vec3f(1.0));
    for (var k = f32(view.zero); (k <= way.count) & (greatest(seen.through) > least); k += 1.0) {
        let stretch = stretch_at(k, way.count, way.phase, way.extent);
        let entry = ray.origin + (start + stretch.x) * ray.direction;
        let length = stretch.y - stretch.x;
        let end = entry + length * ray.direction;
        let middle = entry + 0.5 * length * ray.direction;
        let turn = fract(phase + GOLDEN * k);
        // one place that evaluates the field: on the stretch, and from its middle to the light; in closed form from both its ends
        var part = Way(Ray(entry, ray.direction), length, 1.0, 0.5);
        var columns = vec3f();
        var extents = vec3f();
        for (var j = view.zero; j < 3u; j++) {
            let column = column_of(part);
            if j == 0u {
                columns.x = column.x;
                if column.x <= 0.0 {
                    break;
                }
                extents = vec3f(extent_to_light(entry, light), extent_to_light(middle, light), extent_to_light(end, light));
                part = way_of(Ray(middle, light), extents.y, settings.light_steps, turn);
                if column.y > 0.0 {
                    part = way_of(Ray(entry, light), extents.x, settings.light_steps, turn);
                }
            } else if column.y == 0.0 {
                // as in a uniform medium, which is right to the second order in any: the column changes as that way's extent
                columns = vec3f(columns.x, column.x * extents.xz / max(extents.y, 1e-20));
                break;
            } else if j == 1u {
                columns.y = column.x;
                part = way_of(Ray(end, light), extents.z, settings.light_steps, turn);
            } else {
                columns.z = column.x;
            }
        }
        if columns.x > 0.0 {
            seen = seen_behind(seen, columns, cloud);
        }
    }
    return seen;
}

fn edged(under: vec4f, sight: Sight, t: f32, strength: f32) -> vec4f {
    return with_edges(under, sight, t, settings.center, settings.box, settings.edge_width, Layer(EDGE, strength));
}

// What is behind the box: the sky, one colour, or nothing.
fn backdrop_at(direction: vec3f) -> vec4f {
    let colour = select(settings.background, sky_at(direction, settings.background), settings.backdrop == 0u);
    return select(vec4f(colour, 1.0), vec4f(), settings.backdrop == 2u);
}

// The cloud in front of a picture. Of one that comes through in other parts of red, green and blue the alpha is of the mean.
fn cloud_over(seen: Scattered, behind: vec4f) -> vec4f {
    let shown = displayed(seen.light, settings.exposure, settings.tone, settings.gamma);
    let colour = clamp(shown + seen.through * behind.rgb, vec3f(0.0), vec3f(1.0));
    let through = dot(seen.through, vec3f(1.0 / 3.0));
    return vec4f(colour, 1.0 - through * (1.0 - behind.a));
}

fn shade(pixel: vec2f) -> vec4f {
    let sight = sight_near(pixel, settings.camera, settings.center, settings.box);
    let behind = backdrop_at(sight.ray.direction);
    let span = box_span(sight.ray.origin, sight.ray.direction, settings.center, settings.box);
    if span.y <= max(span.x, 0.0) {
        return behind;
    }
    let seen = scattered_in_box(sight.ray, span, pixel);
    var colour = cloud_over(seen, edged(behind, sight, span.y, 0.4));
    if span.x > 0.0 {
        colour = edged(colour, sight, span.x, 0.55);
    }
    // opaque where nothing else is asked for: then no alpha is computed
    return vec4f(colour.rgb, select(1.0, colour.a, settings.backdrop == 2u));
}
