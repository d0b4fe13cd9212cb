// Values in logarithmic form, with how fast they change from pixel to pixel. Nothing here squares a value that may be
// huge or tiny.

// A complex value and its derivatives, all by 2^exponent. That is 0 but where they were computed in f64 and are beyond the range of
// f32: then the value is one whose squares are, too.
struct Jet {
    value: vec2f,
    dz: vec2f,      // ∂f/∂z
    dzbar: vec2f,   // ∂f/∂z̄
    exponent: f32,
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

// Lengths of (a ± conj b) / w times |w|. With dw = a dz + b dz̄ the gradient of log|w| has the length |a/w + conj(b/w)| and
// that of arg w has |a/w - conj(b/w)|, in nepers and radians per unit of z; both are |a/w| where b is 0. `direction` is w/|w|.
// What is not known (NaN, overflow) counts as none.
fn rates_of_log(a: vec2f, b: vec2f, direction: vec2f) -> vec2f {
    if all(b == vec2f()) {
        return vec2f(known_length(a));
    }
    let turned_a = vec2f(dot(a, direction), a.y * direction.x - a.x * direction.y);
    let turned_b = vec2f(dot(b, direction), b.x * direction.y - b.y * direction.x);
    return vec2f(known_length(turned_a + turned_b), known_length(turned_a - turned_b));
}

// The angle of a unit vector in turns, in [-1/2, 1/2], exact to 1e-8 turns. Shading languages promise 4096 ulp of their
// arctangent, which moves lines by pixels. Reduced to [0, π/8] by symmetry and by atan t = π/4 + atan((t - 1)/(t + 1)), then a
// minimax polynomial for turns, of degree 9 and exact to 6e-10. For a vector of any modest length.
fn turns_of(direction: vec2f) -> f32 {
    let a = abs(direction);
    let small = min(a.x, a.y);
    let large = max(a.x, a.y);
    let is_wide = small > 0.41421356 * large;
    let t = select(small, small - large, is_wide) / select(large, small + large, is_wide);
    let q = t * t;
    let high = 0.03177045563 - q * (0.02189146516 - q * 0.01230993336);
    let series = t * (0.1591549281 - q * (0.05304985049 - q * high));
    var turns = series + select(0.0, 0.125, is_wide);
    turns = select(turns, 0.25 - turns, a.y > a.x);
    turns = select(turns, 0.5 - turns, direction.x < 0.0);
    return select(turns, -turns, direction.y < 0.0);
}

// For finite values other than 0.
fn polar_from_jet(jet: Jet) -> Polar {
    var w = jet.value;
    var squared = dot(w, w);
    var exponent = 0.0;
    var half_scale = 1.0; // 2^(-exponent/2)
    if !is_moderate(squared) {
        let scaled = scale_value(jet.value);
        w = scaled.mantissa;
        squared = dot(w, w);
        exponent = scaled.exponent + jet.exponent;
        half_scale = exp2(-0.5 * scaled.exponent);
    }
    let over_size = inverseSqrt(squared);
    let lengths = rates_of_log(jet.dz, jet.dzbar, w * over_size);
    let rates = min(lengths * half_scale * over_size * half_scale * view.pixel, vec2f(FASTEST));
    return Polar(
        0.5 * log2(squared) + exponent,
        turns_of(w),
        rates.x * 1.4426950408889634,
        rates.y * 0.15915494309189535,
    );
}

// How fast log2 |value| changes, octaves per pixel: |∇f| / (|f| ln 2) times the pixel. For a finite value other than 0.
fn octave_rate(value: f32, gradient: vec2f) -> f32 {
    let length = known_length(gradient);
    let size = abs(value);
    if (size > 1e-18) & (size < 1e18) {
        return min(length / size * (view.pixel * 1.4426950408889634), FASTEST);
    }
    let scaled = scale_value(vec2f(value, 0.0));
    let half_scale = exp2(-0.5 * scaled.exponent);
    return min(length * half_scale / abs(scaled.mantissa.x) * half_scale * (view.pixel * 1.4426950408889634), FASTEST);
}

// log2 |x| of a finite x other than 0 as a whole number and a part in [-1/2, 1/2], so that places between powers of
// two keep all digits. The mantissa's logarithm is the series of 2 atanh((m - 1)/(m + 1)) / ln 2, truncated after the
// ninth power, which is exact to 2e-9 for m in [√½, √2].
fn log2_parts(x: f32) -> vec2f {
    var bits = bitcast<u32>(x) & 0x7fffffffu;
    var below = 0;
    if bits < 0x00800000u {
        bits = bitcast<u32>(magnify_tiny(x)) & 0x7fffffffu;
        below = 64;
    }
    // of the power of two next to |x| by ratio: √½ has the bits 3f3504f3
    let exponent = i32(bits - 0x3f3504f3u) >> 23u;
    let mantissa = bitcast<f32>(bits - (u32(exponent) << 23u));
    let s = (mantissa - 1.0) / (mantissa + 1.0);
    let q = s * s;
    let series = 1.0 + q * (0.3333333333333333 + q * (0.2 + q * (0.14285714285714285 + q * 0.1111111111111111)));
    return vec2f(f32(exponent - below), 2.8853900817779268 * s * series);
}

// How fast re f and im f change, per pixel: with df = a dz + b dz̄ their gradients have the lengths |a + conj b| and
// |a - conj b|. Those that are not known (NaN, overflow) count as none.
fn part_rates(jet: Jet) -> vec2f {
    let pixel = view.pixel * min(exp2(jet.exponent), 1e30);
    if all(jet.dzbar == vec2f()) {
        return vec2f(min(known_length(jet.dz) * pixel, 1e37));
    }
    let reflected = vec2f(jet.dzbar.x, -jet.dzbar.y);
    let lengths = vec2f(known_length(jet.dz + reflected), known_length(jet.dz - reflected));
    return min(lengths * pixel, vec2f(1e37));
}

// Length of a vector, 0 where it is not known (NaN) or too large for f32.
fn known_length(v: vec2f) -> f32 {
    let squared = dot(v, v);
    if is_moderate(squared) {
        return sqrt(squared);
    }
    if is_nan(v.x) || is_nan(v.y) {
        return 0.0;
    }
    let length = length2_safe(v);
    return select(length, 0.0, is_inf(length));
}
