// Values in logarithmic form, with how fast they change from pixel to pixel. Nothing here squares a value that may be
// huge or tiny.

// A complex value and its derivatives.
struct Jet {
    value: vec2f,
    dz: vec2f,     // ∂f/∂z
    dzbar: vec2f,  // ∂f/∂z̄
}

// A value in logarithmic polar form, with the lengths of the gradients of both coordinates per pixel.
struct Polar {
    octaves: f32,       // log2 |f|
    turns: f32,         // arg f / 2π, in [-1/2, 1/2]
    octave_rate: f32,
    turn_rate: f32,
}

// A number w = mantissa · 2^exponent, whose mantissa has squares and quotients that neither overflow nor underflow.
struct Scaled {
    mantissa: vec2f,
    exponent: f32,
}

// Rates beyond this many periods a pixel are the same to every filter.
const FASTEST: f32 = 1e6;

// For finite w other than 0, subnormals included.
fn scale_value(w: vec2f) -> Scaled {
    let size = max(abs(w.x), abs(w.y));
    if size > 1e18 {
        return Scaled(w * 1.262177448353619e-29, 96.0);
    }
    if size < 1e-18 {
        let up = vec2f(magnify_tiny(w.x), magnify_tiny(w.y));
        if max(abs(up.x), abs(up.y)) < 1e-18 {
            return Scaled(up * 1.8446744073709552e19, -128.0);
        }
        return Scaled(up, -64.0);
    }
    return Scaled(w, 0.0);
}

// Length of (a ± conj b) / w, in radians or nepers per unit of z. With dw = a dz + b dz̄ the gradient of log|w| has
// the length |a/w + conj(b/w)| and that of arg w has |a/w - conj(b/w)|. `direction` is w/|w|.
fn rate_of_log(a: vec2f, b: vec2f, direction: vec2f, side: f32) -> f32 {
    let turned_a = vec2f(dot(a, direction), a.y * direction.x - a.x * direction.y);
    let turned_b = vec2f(dot(b, direction), b.x * direction.y - b.y * direction.x);
    return length2_safe(turned_a + side * turned_b);
}

// `length · 2^-exponent / size`, per pixel and in units of `period`; a rate that is not known (NaN, overflow) counts
// as none.
fn pixel_rate(length: f32, scaled: Scaled, size: f32, period: f32) -> f32 {
    if is_nan(length) || is_inf(length) {
        return 0.0;
    }
    let rate = length * exp2(-0.5 * scaled.exponent) / size * exp2(-0.5 * scaled.exponent);
    return min(rate * view.pixel / period, FASTEST);
}

// The angle of a unit vector in turns, in [-1/2, 1/2], exact to 3e-8 turns. Shading languages promise 4096 ulp of their
// arctangent, which moves lines by pixels. Reduced to [0, π/8] by symmetry and by atan t = π/4 + atan((t - 1)/(t + 1)), then the
// Taylor series up to t¹⁵.
fn turns_of(direction: vec2f) -> f32 {
    let a = abs(direction);
    var t = min(a.x, a.y) / max(a.x, a.y);
    let is_wide = t > 0.41421356;
    t = select(t, (t - 1.0) / (t + 1.0), is_wide);
    let q = t * t;
    let tail = 0.1111111111 - q * (0.0909090909 - q * (0.0769230769 - q * 0.0666666667));
    let series = t - t * q * (0.3333333333 - q * (0.2 - q * (0.1428571429 - q * tail)));
    var turns = 0.15915494309189535 * series + select(0.0, 0.125, is_wide);
    turns = select(turns, 0.25 - turns, a.y > a.x);
    turns = select(turns, 0.5 - turns, direction.x < 0.0);
    return select(turns, -turns, direction.y < 0.0);
}

// For finite values other than 0.
fn polar_from_jet(jet: Jet) -> Polar {
    let scaled = scale_value(jet.value);
    let size = length(scaled.mantissa);
    let direction = scaled.mantissa / size;
    let along = rate_of_log(jet.dz, jet.dzbar, direction, 1.0);
    let around = rate_of_log(jet.dz, jet.dzbar, direction, -1.0);
    return Polar(
        log2(size) + scaled.exponent,
        turns_of(direction),
        pixel_rate(along, scaled, size, 0.6931471805599453),
        pixel_rate(around, scaled, size, 6.283185307179586),
    );
}

// How fast log2 |value| changes, octaves per pixel: |∇f| / (|f| ln 2) times the pixel. For a finite value other than 0.
fn octave_rate(value: f32, gradient: vec2f) -> f32 {
    let scaled = scale_value(vec2f(value, 0.0));
    return pixel_rate(length2_safe(gradient), scaled, abs(scaled.mantissa.x), 0.6931471805599453);
}

// log2 |x| of a finite x other than 0 as a whole number and a part in [-1/2, 1/2], so that places between powers of
// two keep all digits. The mantissa's logarithm is the series of 2 atanh((m - 1)/(m + 1)) / ln 2, truncated after the
// ninth power, which is exact to 2e-9 for m in [√½, √2].
fn log2_parts(x: f32) -> vec2f {
    let scaled = scale_value(vec2f(x, 0.0));
    let bits = bitcast<u32>(scaled.mantissa.x) & 0x7fffffffu;
    var exponent = f32(i32(bits >> 23u) - 127) + scaled.exponent;
    var mantissa = bitcast<f32>((bits & 0x007fffffu) | 0x3f800000u);
    if mantissa > 1.4142135 {
        mantissa *= 0.5;
        exponent += 1.0;
    }
    let s = (mantissa - 1.0) / (mantissa + 1.0);
    let q = s * s;
    let series = 1.0 + q * (0.3333333333333333 + q * (0.2 + q * (0.14285714285714285 + q * 0.1111111111111111)));
    return vec2f(exponent, 2.8853900817779268 * s * series);
}

// How fast re f and im f change, per pixel: with df = a dz + b dz̄ their gradients have the lengths |a + conj b| and
// |a - conj b|. Those that are not known (NaN, overflow) count as none.
fn part_rates(jet: Jet) -> vec2f {
    let reflected = vec2f(jet.dzbar.x, -jet.dzbar.y);
    let lengths = vec2f(known_length(jet.dz + reflected), known_length(jet.dz - reflected));
    return min(lengths * view.pixel, vec2f(1e37));
}

fn known_length(v: vec2f) -> f32 {
    if is_nan(v.x) || is_nan(v.y) {
        return 0.0;
    }
    let length = length2_safe(v);
    return select(length, 0.0, is_inf(length));
}
