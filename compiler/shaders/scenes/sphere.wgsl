// sphere: a complex function on the Riemann sphere, lit. Its north pole is 0, its south pole ∞, its equator |z| = 1;
// z is the projection from the south pole onto the plane of the equator, z = (X + iY)/(1 + Z).
//
// South of the equator the formula is compiled as a function of w = 1/z = (X - iY)/(1 - Z), so that neither a coordinate nor the
// value of a rational function is large, and ∞ is as good as 0. Filters know how the picture's points move on the sphere:
// the derivatives by the chart are carried over to the screen by the chain rule for both Wirtinger derivatives. The
// projection to the screen is parallel.
//
// An exact zero is black, a value too large for f32 white with faint stripes, an undefined one (NaN) a quiet grey hatch.

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
    yaw: f32,
    pitch: f32,
    rotation: vec3f,
    spin: f32,
    modulus: f32,
    palette: u32,
    rings: u32,
    ring_depth: f32,
    ring_octaves: f32,
    fade_octaves: f32,
    phase_lines: u32,
    phase_steps: u32,
    graticule: u32,
    graticule_opacity: f32,
    line_width: f32,
    ink: vec3f,
    light: f32,
    light_yaw: f32,
    light_pitch: f32,
    shine: f32,
    background: vec3f,
    backdrop: u32,
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

// f with its derivatives by z at z, and by w at w = 1/z.
fn chart_jet(z: vec2f) -> Jet { return Jet(); }
fn chart_jet_inverse(w: vec2f) -> Jet { return Jet(); }

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

struct Layer {
    colour: vec3f,
    opacity: f32,
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
fn polar_from_jet(jet: Jet) -> Polar { return Polar(); }
fn domain_colour(polar: Polar, style: PhaseStyle) -> vec3f { return vec3f(); }
fn phase_line_coverage(turns: f32, rate: f32, count: u32, width: f32) -> f32 { return 0.0; }
fn even_lines(u: f32, rate: f32, width: f32) -> f32 { return 0.0; }
fn direction_from_angles(yaw: f32, pitch: f32) -> vec3f { return vec3f(); }
fn wrap_diffuse(n: vec3f, l: vec3f, wrap: f32) -> f32 { return 0.0; }
fn blinn_specular(n: vec3f, l: vec3f, v: vec3f, exponent: f32) -> f32 { return 0.0; }
fn key_at(pixel: vec2f, side: f32, aspect: f32) -> Key { return Key(); }
fn key_jet(key: Key, reach: f32) -> Jet { return Jet(); }
fn layer_on(under: vec4f, layer: Layer) -> vec4f { return vec4f(); }

const DEGREE: f32 = 0.017453292519943295;
const KEY_BORDER: vec3f = vec3f(0.01);

// A point of the sphere, and how it moves with the picture's point: per world unit to the right and up.
struct Place {
    point: vec3f,
    right: vec3f,
    up: vec3f,
}

// Three unit vectors at right angles to one another.
struct Axes {
    x: vec3f,
    y: vec3f,
    z: vec3f,
}

fn colour_entry(k: u32) -> vec3f {
    return settings.colours[k].rgb;
}

// Axes of the view: right, up, towards the viewer.
fn view_axes() -> Axes {
    let yaw = settings.yaw * DEGREE;
    let back = direction_from_angles(yaw, settings.pitch * DEGREE);
    let right = vec3f(-sin(yaw), cos(yaw), 0.0);
    return Axes(right, cross(back, right), back);
}

// The sphere's own axes: turned about x, then y, then z.
fn object_axes() -> Axes {
    var a = settings.rotation * DEGREE;
    // none by itself, so that the axes of a sphere at rest are seen to be constants
    if settings.spin != 0.0 {
        a.z += settings.spin * view.time * DEGREE;
    }
    let c = cos(a);
    let s = sin(a);
    return Axes(
        vec3f(c.y * c.z, c.y * s.z, -s.y),
        vec3f(s.x * s.y * c.z - c.x * s.z, s.x * s.y * s.z + c.x * c.z, s.x * c.y),
        vec3f(c.x * s.y * c.z + s.x * s.z, c.x * s.y * s.z - s.x * c.z, c.x * c.y),
    );
}

// A direction of the world in the sphere's coordinates.
fn object_from_world(world: vec3f, object: Axes) -> vec3f {
    return vec3f(dot(object.x, world), dot(object.y, world), dot(object.z, world));
}

// A multiplication by i.
fn turned(z: vec2f) -> vec2f {
    return vec2f(-z.y, z.x);
}

fn product(a: vec2f, b: vec2f) -> vec2f {
    return vec2f(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}

// The point that is seen at a point of the picture, at most 1 from the centre, in the sphere's coordinates.
fn place_at(at: vec2f) -> Place {
    let seen = view_axes();
    let object = object_axes();
    let depth = sqrt(max(1.0 - dot(at, at), 1e-6));
    let right = object_from_world(seen.x, object);
    let up = object_from_world(seen.y, object);
    let back = object_from_world(seen.z, object);
    let slope = at / depth;
    return Place(at.x * right + at.y * up + depth * back, right - slope.x * back, up - slope.y * back);
}

// A coordinate of the chart around the nearer pole, with its derivatives by the picture's two directions.
struct Chart {
    coordinate: vec2f,
    right: vec2f,
    up: vec2f,
}

// (X ± iY)/(1 ± Z), whose derivatives are (dX ± i dY ∓ z dZ)/(1 ± Z).
fn chart_at(place: Place, side: f32) -> Chart {
    let p = place.point;
    let below = 1.0 / (1.0 + side * p.z);
    let z = vec2f(p.x, side * p.y) * below;
    return Chart(
        z,
        (vec2f(place.right.x, side * place.right.y) - side * place.right.z * z) * below,
        (vec2f(place.up.x, side * place.up.y) - side * place.up.z * z) * below,
    );
}

// The same value with its derivatives by the picture's point as a complex number instead of the chart's coordinate.
fn on_screen(jet: Jet, chart: Chart) -> Jet {
    let dz = 0.5 * (chart.right - turned(chart.up));
    let dzbar = 0.5 * (chart.right + turned(chart.up));
    if all(jet.dzbar == vec2f()) {
        return Jet(jet.value, product(jet.dz, dz), product(jet.dz, dzbar), jet.exponent);
    }
    let flip = vec2f(1.0, -1.0);
    return Jet(
        jet.value,
        product(jet.dz, dz) + product(jet.dzbar, flip * dzbar),
        product(jet.dz, dzbar) + product(jet.dzbar, flip * dz),
        jet.exponent,
    );
}

fn seen_jet(place: Place) -> Jet {
    let side = select(-1.0, 1.0, place.point.z >= 0.0);
    let chart = chart_at(place, side);
    var jet: Jet;
    if side > 0.0 {
        jet = chart_jet(chart.coordinate);
    } else {
        jet = chart_jet_inverse(chart.coordinate);
    }
    return on_screen(jet, chart);
}

// Meridians and parallels, `graticule` to a whole circle.
fn graticule_coverage(place: Place) -> f32 {
    if settings.graticule == 0u {
        return 0.0;
    }
    let count = f32(settings.graticule);
    let p = place.point;
    let around = max(length(p.xy), 1e-6);
    let to_north = length(vec2f(place.right.z, place.up.z)) / around;
    let parallel = atan2(p.z, around) * count / 6.283185307179586;
    let to_east = vec2f(
        p.x * place.right.y - p.y * place.right.x,
        p.x * place.up.y - p.y * place.up.x,
    ) / (around * around);
    let meridian = atan2(p.y, p.x) * count / 6.283185307179586;
    let per_pixel = vec2f(to_north, length(to_east)) * view.pixel * count / 6.283185307179586;
    return max(
        even_lines(parallel, per_pixel.x, settings.line_width),
        even_lines(meridian, per_pixel.y, settings.line_width),
    );
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

// The colour under the light, which keeps its direction as seen by the viewer.
fn lit(colour: vec3f, normal: vec3f) -> vec3f {
    let to_viewer = vec3f(0.0, 0.0, 1.0);
    let towards = direction_from_angles(settings.light_yaw * DEGREE, settings.light_pitch * DEGREE);
    // from the angles' axes (towards the viewer, right, up) to the view's (right, up, towards the viewer)
    let to_light = vec3f(towards.y, towards.z, towards.x);
    let diffuse = colour * (0.22 + 0.92 * wrap_diffuse(normal, to_light, 0.35));
    let shine = settings.shine * blinn_specular(normal, to_light, to_viewer, 48.0);
    let rim = 1.0 - 0.35 * pow(1.0 - normal.z, 3.0);
    return mix(colour, diffuse * rim + vec3f(shine), settings.light);
}

// Behind the sphere: one colour, darker in the corners, or nothing.
fn backdrop(pixel: vec2f) -> vec4f {
    let from_center = (pixel - 0.5 * view.size) / max(view.size.x, view.size.y);
    let colour = settings.background * (1.0 - 0.55 * dot(from_center, from_center));
    return select(vec4f(colour, 1.0), vec4f(), settings.backdrop == 1u);
}

fn shade(pixel: vec2f) -> vec4f {
    let key = key_at(pixel, settings.key, 1.0);
    let at = offset_from_pixel(pixel) + view.center;
    let radius = length(at);
    let covered = clamp(0.5 + (1.0 - radius) / (view.pixel * sample_window()), 0.0, 1.0);
    if (covered <= 0.0) & !key.inside {
        return layer_on(backdrop(pixel), Layer(KEY_BORDER, key.border));
    }
    let inside = at * min(1.0, 0.9999995 / max(radius, 1e-6));
    let place = place_at(inside);
    var jet = seen_jet(place);
    if key.inside {
        jet = key_jet(key, 2.0);
    }
    let colour = colour_of(jet, pixel);
    var picture = vec4f(colour, 1.0);
    if !key.inside {
        let lined = mix(colour, settings.ink, settings.graticule_opacity * graticule_coverage(place));
        let normal = vec3f(inside, sqrt(max(1.0 - dot(inside, inside), 0.0)));
        picture = layer_on(backdrop(pixel), Layer(lit(lined, normal), covered));
    }
    return layer_on(picture, Layer(KEY_BORDER, key.border));
}
