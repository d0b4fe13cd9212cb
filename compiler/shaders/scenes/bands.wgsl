// bands: a real function of the plane as stripes of flat colours, like a map of heights.
//
// Stripe k is where k ≤ (f - start) / period < k + 1; its colour is the one with the number k mod count. Each sample is
// the exact mean of the stripes under a Gaussian footprint, which is given in pixels, in linear light, for f that is linear
// across it: a sum of one step for each edge. Where all colours lie under the footprint it is their mean.
//
// An undefined value (NaN) is a quiet grey hatch, an infinity the mean colour with a hatch of the other slope. A constant is
// the colour of its stripe.

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
    period: f32,
    start: f32,
    count: u32,
    palette: u32,
    footprint: f32,
    color_1: vec3f,
    color_2: vec3f,
    color_3: vec3f,
    color_4: vec3f,
    key: f32,
    colours: array<vec4f, 129>,  // of a named palette
}

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> params: array<vec4f, 16>;
@group(0) @binding(2) var<uniform> settings: Settings;

// (∂f/∂x, ∂f/∂y, f) at the offset from the view's centre
fn field_grad(offset: vec2f) -> vec3f { return vec3f(); }

struct Key {
    place: vec2f,
    step: vec2f,
    inside: bool,
    border: f32,
}

fn is_nan(x: f32) -> bool { return false; }
fn is_inf(x: f32) -> bool { return false; }
fn length2_safe(v: vec2f) -> f32 { return 0.0; }
fn offset_from_pixel(pixel: vec2f) -> vec2f { return vec2f(); }
fn undefined_colour(pixel: vec2f) -> vec3f { return vec3f(); }
fn infinite_colour(pixel: vec2f, colour: vec3f) -> vec3f { return vec3f(); }
fn oklch_wheel(t: f32) -> vec3f { return vec3f(); }
fn mapped_colour(u: f32) -> vec3f { return vec3f(); }
fn sequential_ramp(t: f32) -> vec3f { return vec3f(); }
fn diverging_ramp(t: f32) -> vec3f { return vec3f(); }
fn normal_cdf(x: f32) -> f32 { return 0.0; }
fn key_at(pixel: vec2f, side: f32, aspect: f32) -> Key { return Key(); }
fn key_label(key: Key, place: f32, value: f32, anchor: f32) -> bool { return false; }
fn label_colour(colour: vec3f) -> vec3f { return vec3f(); }
fn with_key_border(colour: vec3f, key: Key) -> vec3f { return vec3f(); }

// Steps further than this many standard deviations away are complete to 1e-7.
const REACH: f32 = 5.2;
// Share of the whole cycle that a standard deviation must be for the mean of all colours: the first harmonic of the stripes
// is then below exp(-2π² 0.8²) = 3.3e-6.
const UNRESOLVED: f32 = 0.8;

fn colour_entry(k: u32) -> vec3f {
    return settings.colours[k].rgb;
}

fn period() -> f32 {
    return select(settings.period, 1.0, settings.period <= 1e-37);
}

// The colour of stripe k, of any sign. Whole numbers, so that no rounding puts a multiple of `count` into the stripe below.
fn stripe_colour(k: i32) -> vec3f {
    let count = i32(max(settings.count, 1u));
    let index = ((k % count) + count) % count;
    let place = f32(index) / f32(max(count - 1, 1));
    switch settings.palette {
        case 1u: { return sequential_ramp(0.12 + 0.88 * place); }
        case 2u: { return diverging_ramp(2.0 * place - 1.0); }
        case 3u: { return oklch_wheel(f32(index) / f32(count)); }
        case 0u: {}
        default: { return mapped_colour(place); }
    }
    switch index % 4 {
        case 0: { return settings.color_1; }
        case 1: { return settings.color_2; }
        case 2: { return settings.color_3; }
        default: { return settings.color_4; }
    }
}

fn mean_colour() -> vec3f {
    let count = i32(max(settings.count, 1u));
    var sum = vec3f();
    for (var k = 0; k < count; k++) {
        sum += stripe_colour(k);
    }
    return sum / f32(count);
}

// Mean over a normal distribution around u, in stripes, of standard deviation `spread`.
fn filtered_colour(u: f32, spread: f32) -> vec3f {
    if spread > UNRESOLVED * f32(settings.count) || abs(u) > 4194304.0 {
        return mean_colour();
    }
    // below the last digit of u there is no telling where in the sample an edge is
    if spread <= 6e-8 * max(abs(u), 1.0) {
        return stripe_colour(i32(floor(u)));
    }
    let first = i32(ceil(u - REACH * spread));
    let last = i32(floor(u + REACH * spread));
    var below = stripe_colour(first - 1);
    var colour = below;
    for (var k = first; k <= last; k++) {
        let above = stripe_colour(k);
        colour += (above - below) * normal_cdf((u - f32(k)) / spread);
        below = above;
    }
    return colour;
}

fn colour_of(jet: vec3f, pixel: vec2f) -> vec3f {
    if is_nan(jet.z) {
        return undefined_colour(pixel);
    }
    if is_inf(jet.z) {
        return infinite_colour(pixel, mean_colour());
    }
    var spread = 0.0;
    if !(is_nan(jet.x) || is_nan(jet.y)) {
        let rate = min(length2_safe(jet.xy), 1e37) * view.pixel;
        spread = rate / period() * settings.footprint;
    }
    return filtered_colour((jet.z - settings.start) / period(), spread);
}

// The key: one stripe of each colour, the first one from `start`.
fn key_value(key: Key) -> vec3f {
    let reach = 0.5 * f32(settings.count) * period();
    return vec3f(reach * key.step.x / view.pixel, 0.0, settings.start + reach * (key.place.x + 1.0));
}

// Each stripe begins with the value of its lower edge.
fn labelled(key: Key) -> bool {
    let count = f32(max(settings.count, 1u));
    let stripe = floor(0.5 * (key.place.x + 1.0) * count);
    let value = settings.start + stripe * period();
    return key_label(key, 2.0 * stripe / count - 1.0, value, 0.0);
}

fn shade(pixel: vec2f) -> vec4f {
    let key = key_at(pixel, settings.key, 2.0 * f32(settings.count));
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
