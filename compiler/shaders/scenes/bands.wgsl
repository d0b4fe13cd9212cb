// bands: a real function of the plane as stripes of flat colours, like a map of heights.
//
// Stripe k is where k ≤ (f - start) / period < k + 1; its colour is the one with the number k mod count. Each sample is
// the mean of the stripes under a Gaussian footprint, which is given in pixels, in linear light, for f that is linear
// across it: a sum of one step for each edge, or a Fourier series. Where all colours lie under the footprint it is
// their mean.
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
fn is_finite(x: f32) -> bool { return false; }
fn gradient_length(v: vec2f) -> f32 { return 0.0; }
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

// Errors are stated in linear light where 0 and 1 are the components of the colours; together they stay below 2.5e-4, half a
// step of 8 bits of the darkest tones.
// Steps further than this many standard deviations away are taken as complete, which they are to 4.8e-5 on either side.
const REACH: f32 = 3.9;
// From this standard deviation on the Fourier series of a cycle of four stripes is taken, up to its third harmonic: what is
// left is below 2/(5π) exp(-2π² 5² 0.5²/4²) = 5.7e-5.
const SMOOTH: f32 = 0.5;
// Share of the whole cycle that a standard deviation must be for the mean of all colours: the first harmonic of the stripes
// is then below 2/π exp(-2π² 0.7²) = 4.1e-5.
const UNRESOLVED: f32 = 0.7;

fn colour_entry(k: u32) -> vec3f {
    return settings.colours[k].rgb;
}

fn period() -> f32 {
    return select(settings.period, 1.0, settings.period <= 1e-37);
}

fn stripe_count() -> i32 {
    return i32(max(settings.count, 1u));
}

// Whether four stripes are a whole number of cycles, so that all pictures of such counts are of four colours.
fn repeats_in_four() -> bool {
    return settings.count == 4u || settings.count <= 2u;
}

// Which of the colours stripe k has, of any sign. Whole numbers, so that no rounding puts a multiple of `count` into the
// stripe below.
fn colour_index(k: i32) -> i32 {
    if repeats_in_four() {
        return k & (stripe_count() - 1);
    }
    let rest = k % stripe_count();
    return select(rest, rest + stripe_count(), rest < 0);
}

fn indexed_colour(index: i32) -> vec3f {
    let count = stripe_count();
    let place = f32(index) / f32(max(count - 1, 1));
    switch settings.palette {
        case 1u: { return sequential_ramp(0.12 + 0.88 * place); }
        case 2u: { return diverging_ramp(2.0 * place - 1.0); }
        case 3u: { return oklch_wheel(f32(index) / f32(count)); }
        case 0u: {}
        default: { return mapped_colour(place); }
    }
    let is_odd = (index & 1) == 1;
    let first = select(settings.color_1, settings.color_2, is_odd);
    return select(first, select(settings.color_3, settings.color_4, is_odd), (index & 2) == 2);
}

fn mean_colour() -> vec3f {
    var sum = vec3f();
    for (var k = 0; k < stripe_count(); k++) {
        sum += indexed_colour(k);
    }
    return sum / f32(stripe_count());
}

// Mean over a normal distribution around u of stripes whose colours repeat after four, by the Fourier series. Stripe j adds
// its colour c_j times 1/4 + Σ_h 2/(πh) sin(πh/4) exp(-2π² h² spread²/16) cos(2πh (u - j - 1/2)/4).
fn smooth_colour(u: f32, spread: f32) -> vec3f {
    let c0 = indexed_colour(0);
    let c1 = indexed_colour(colour_index(1));
    let c2 = indexed_colour(colour_index(2));
    let c3 = indexed_colour(colour_index(3));
    let turns = 0.25 * u - 0.125;
    let angle = 6.283185307179586 * (turns - floor(turns));
    let c = cos(angle);
    let s = sin(angle);
    // 2π²/16 / log 2
    let g = exp2(-1.7798536 * spread * spread);
    let g4 = (g * g) * (g * g);
    let first = 0.45015815807855303 * g;
    let second = 0.3183098861837907 * g4 * (c * c - s * s);
    let third = 0.15005271935951768 * g * (g4 * g4);
    return 0.25 * ((c0 + c2) + (c1 + c3))
        + (c0 - c2) * (c * (first + third * (4.0 * c * c - 3.0)))
        + (c1 - c3) * (s * (first - third * (3.0 - 4.0 * s * s)))
        + ((c0 + c2) - (c1 + c3)) * second;
}

// Mean over a normal distribution around u, in stripes, of standard deviation `spread`.
fn filtered_colour(u: f32, spread: f32) -> vec3f {
    let is_far = abs(u) > 4194304.0;
    if repeats_in_four() {
        if (spread > SMOOTH) | is_far {
            return smooth_colour(u, select(spread, 1e9, is_far));
        }
    } else if spread > UNRESOLVED * f32(settings.count) || is_far {
        return mean_colour();
    }
    // below the last digit of u there is no telling where in the sample an edge is
    let reach = select(REACH * spread, 0.0, spread <= 6e-8 * max(abs(u), 1.0));
    let lowest = floor(u - reach);
    let edges = floor(u + reach) - lowest;
    var index = colour_index(i32(lowest));
    var below = indexed_colour(index);
    var colour = below;
    // from the middle to the edge, in standard deviations
    let step = 1.0 / spread;
    var away = (u - lowest) * step;
    for (var k = 0.0; k < edges; k += 1.0) {
        away -= step;
        index = select(index + 1, 0, index + 1 == stripe_count());
        let above = indexed_colour(index);
        colour += (above - below) * normal_cdf(away);
        below = above;
    }
    return colour;
}

fn colour_of(jet: vec3f, pixel: vec2f) -> vec3f {
    if !is_finite(jet.z) {
        if is_nan(jet.z) {
            return undefined_colour(pixel);
        }
        return infinite_colour(pixel, mean_colour());
    }
    let spread = max(gradient_length(jet.xy), 0.0) * view.pixel / period() * settings.footprint;
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
