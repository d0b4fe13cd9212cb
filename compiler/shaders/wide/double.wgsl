// Numbers as native f64. Sums, products, quotients and square roots are the adapter's, correctly rounded where it does
// so; nothing else of its f64 is relied on.

alias real = f64;

struct Complex {
    re: real,
    im: real,
}

/// What sincos and sinhcosh give.
struct RealPair {
    first: real,
    second: real,
}

struct ComplexPair {
    first: Complex,
    second: Complex,
}

/// Two numbers whose sum is meant, with about twice the precision of one.
struct Long {
    hi: real,
    lo: real,
}

// exact steps

/// A zero that no compiler can see: an odd square is 1 modulo 8, so bit 2 of it is never set. Xor with it hides where
/// a value comes from, so that no algebra reaches across.
fn hidden_zero(seed: f64) -> u64 {
    let odd = u32(bitcast<u64>(seed) >> 32u) | 1u;
    return u64((odd * odd) & 4u);
}

/// A hidden zero for an operation on two numbers. One of them may be a constant, of which alone the compiler would know
/// it; and both may be the same.
fn hidden_zero_of(a: f64, b: f64) -> u64 {
    return hidden_zero(bitcast<f64>((bitcast<u64>(a) << 1u) ^ bitcast<u64>(b)));
}

/// v itself, cut off from the expression that gave it.
fn opaque(v: f64, zero: u64) -> f64 {
    return bitcast<f64>(bitcast<u64>(v) ^ zero);
}

/// a + b exactly for |a| ≥ |b| or a = 0, as rounded sum and its error (Dekker 1971).
fn quick_two_sum(a: f64, b: f64, zero: u64) -> Long {
    let s = opaque(a + b, zero);
    return Long(s, b - opaque(s - a, zero));
}

/// a + b exactly, as rounded sum and its error: sorted, for that is three steps less than Knuth's.
fn two_sum(a: f64, b: f64, zero: u64) -> Long {
    let ordered = abs(a) >= abs(b);
    return quick_two_sum(select(b, a, ordered), select(a, b, ordered), zero);
}

/// a b as rounded product and its error to 2^-106, where nothing underflows (Dekker 1971; split by masking).
fn two_product(a: f64, b: f64, zero: u64) -> Long {
    let p = opaque(a * b, zero);
    let ah = bitcast<f64>(bitcast<u64>(a) & 0xfffffffff8000000lu);
    let bh = bitcast<f64>(bitcast<u64>(b) & 0xfffffffff8000000lu);
    let al = opaque(a - ah, zero);
    let bl = opaque(b - bh, zero);
    let e = opaque(opaque(ah * bh, zero) - p, zero);
    let f = opaque(e + opaque(ah * bl, zero), zero);
    let g = opaque(f + opaque(al * bh, zero), zero);
    return Long(p, g + al * bl);
}

// end of exact steps

/// The upper word: sign, exponent and 20 bits of the significand.
fn double_top(x: f64) -> u32 {
    return u32(bitcast<u64>(x) >> 32u);
}

/// The number of two words.
fn double_from_words(high: u32, low: u32) -> f64 {
    return bitcast<f64>((u64(high) << 32u) | u64(low));
}

/// The number of an f32, by bits where that is not finite.
fn real_from_f32(x: f32) -> real {
    let bits = bitcast<u32>(x);
    let unbounded = double_from_words((bits & 0x80000000u) | 0x7ff00000u | ((bits & 0x007fffffu) >> 3u), 0u);
    return select(f64(x), unbounded, (bits & 0x7f800000u) == 0x7f800000u);
}

/// The nearest f32.
fn real_to_f32(x: real) -> f32 {
    let top = double_top(x);
    let unbounded = bitcast<f32>((top & 0x80000000u) | 0x7f800000u | ((top & 0x000fffffu) << 3u));
    return select(f32(x), unbounded, (top & 0x7ff00000u) == 0x7ff00000u);
}

/// ⌊log2⌋ of the greater part of z; -4000 where that is 0, subnormal, infinite or NaN.
fn complex_octave(z: Complex) -> i32 {
    let top = max(double_top(z.re) & 0x7fffffffu, double_top(z.im) & 0x7fffffffu) >> 20u;
    return select(i32(top) - 1023, -4000, (top == 0u) | (top == 2047u));
}

/// The e for which a value and its derivatives divided by 2^e are in the range of f32; 0 where they are as they are, and of a value
/// that is 0, infinite or NaN. A value that is divided has its greater part at 2^60 at least, or at 2^-100 if it is tiny; a
/// derivative that is 2^50 times as large is beyond the range in any case.
fn complex_beyond(value: Complex, dz: Complex, dzbar: Complex) -> f32 {
    let own = complex_octave(value);
    if own == -4000 {
        return 0.0;
    }
    if own < -126 {
        return f32(own + 100);
    }
    let slopes = max(complex_octave(dz), complex_octave(dzbar));
    return f32(max(max(own - 125, min(slopes - 110, own - 60)), 0));
}

/// x / 2^e in f32; finite ones that are beyond 2^126 are that large.
fn real_to_f32_beyond(x: real, e: f32) -> f32 {
    let y = scale(x, -i32(e));
    let nearest = real_to_f32(y);
    let limit = 8.507059173023462e37;
    let is_beyond = is_finite(x) & (f64(limit) < real_abs(y));
    return select(nearest, select(limit, -limit, sign_is_set(y)), is_beyond);
}

/// n exactly.
fn real_from_i32(n: i32) -> real {
    return f64(n);
}

/// The number of the words (low, high).
fn real_from_words(w: vec2u) -> real {
    return double_from_words(w.y, w.x);
}

fn real_to_words(x: real) -> vec2u {
    return vec2u(u32(bitcast<u64>(x) & 0xfffffffflu), double_top(x));
}

/// A short constant.
fn num(a: f32) -> real {
    return f64(a);
}

/// A constant as the sum of three f32.
fn lit(a: f32, b: f32, c: f32) -> real {
    return f64(a) + (f64(b) + f64(c));
}

/// x, which no driver may join with what follows: (a / b) / c computed as a / (b c) overflows early.
fn rounded(x: real) -> real {
    return opaque(x, hidden_zero(x));
}

fn is_nan(x: real) -> bool {
    return (bitcast<u64>(x) & 0x7ffffffffffffffflu) > 0x7ff0000000000000lu;
}

fn is_infinite(x: real) -> bool {
    return (bitcast<u64>(x) & 0x7ffffffffffffffflu) == 0x7ff0000000000000lu;
}

fn is_finite(x: real) -> bool {
    return (double_top(x) & 0x7ff00000u) != 0x7ff00000u;
}

/// Whether x is a zero.
fn is_zero(x: real) -> bool {
    return (bitcast<u64>(x) << 1u) == 0lu;
}

/// x < 0, -0 included.
fn sign_is_set(x: real) -> bool {
    return (double_top(x) & 0x80000000u) != 0u;
}

/// A quiet NaN, whatever the seed.
fn make_nan(seed: real) -> real {
    return bitcast<f64>(bitcast<u64>(seed) | 0x7ff8000000000000lu);
}

/// The infinity with the sign of the seed.
fn make_infinity(seed: real) -> real {
    return double_from_words((double_top(seed) & 0x80000000u) | 0x7ff00000u, 0u);
}

/// a where c, else b.
fn choose(c: bool, a: real, b: real) -> real {
    return select(b, a, c);
}

/// -a where c, by sign bits.
fn flip_if(a: real, c: bool) -> real {
    return bitcast<f64>(bitcast<u64>(a) ^ select(0lu, 0x8000000000000000lu, c));
}

fn real_neg(a: real) -> real {
    return bitcast<f64>(bitcast<u64>(a) ^ 0x8000000000000000lu);
}

fn real_abs(a: real) -> real {
    return bitcast<f64>(bitcast<u64>(a) & 0x7ffffffffffffffflu);
}

/// |a| with the sign of s.
fn with_sign(a: real, s: real) -> real {
    return bitcast<f64>((bitcast<u64>(a) & 0x7ffffffffffffffflu) | (bitcast<u64>(s) & 0x8000000000000000lu));
}

fn real_add(a: real, b: real) -> real {
    return a + b;
}

fn real_sub(a: real, b: real) -> real {
    return a - b;
}

fn add32(a: real, b: f32) -> real {
    return a + f64(b);
}

fn real_mul(a: real, b: real) -> real {
    return a * b;
}

fn real_square(a: real) -> real {
    return a * a;
}

fn mul32(a: real, b: f32) -> real {
    return a * f64(b);
}

fn real_div(a: real, b: real) -> real {
    return a / b;
}

/// √a; NaN below 0, -0 of -0.
fn real_sqrt(a: real) -> real {
    if is_zero(a) || is_nan(a) {
        return a;
    }
    return select(sqrt(real_abs(a)), make_nan(a), sign_is_set(a));
}

fn real_less(a: real, b: real) -> bool {
    return a < b;
}

fn real_less_equal(a: real, b: real) -> bool {
    return a <= b;
}

fn real_equal(a: real, b: real) -> bool {
    return a == b;
}

fn real_not_equal(a: real, b: real) -> bool {
    return !(a == b);
}

/// ⌊a⌋
fn real_floor(a: real) -> real {
    return floor(a);
}

/// 2^n for n in [-1022, 1023].
fn double_power_of_two(n: i32) -> f64 {
    return double_from_words(u32(n + 1023) << 20u, 0u);
}

/// a 2^n for every n: overflow and underflow happen once, at the end.
fn scale(a: real, n: i32) -> real {
    if abs(n) < 1000 {
        return a * double_power_of_two(n);
    }
    let zero = hidden_zero_of(a, f64(n));
    let all = clamp(n, -2900, 2900);
    let first = all / 3;
    let second = (all - first) / 2;
    let v = opaque(a * double_power_of_two(first), zero);
    let w = opaque(v * double_power_of_two(second), zero);
    return w * double_power_of_two(all - first - second);
}

/// ⌊log2 |a|⌋ of a finite nonzero number.
fn exponent_of(a: real) -> i32 {
    let p = pieces_of(a);
    if p.high == 0u {
        return 31 - i32(countLeadingZeros(p.low)) + p.low_exponent;
    }
    return 31 - i32(countLeadingZeros(p.high)) + p.high_exponent;
}

/// a + b exactly.
fn long_sum(a: real, b: real) -> Long {
    return two_sum(a, b, hidden_zero_of(a, b));
}

/// a b exactly, but for 2^-106 of it.
fn long_product(a: real, b: real) -> Long {
    return two_product(a, b, hidden_zero_of(a, b));
}

/// a + b (after Joldes, Muller, Popescu 2017, algorithm 6).
fn long_add(a: Long, b: Long) -> Long {
    let s = long_sum(a.hi, b.hi);
    let t = long_sum(a.lo, b.lo);
    let v = long_sum(s.hi, real_add(s.lo, t.hi));
    return long_sum(v.hi, real_add(t.lo, v.lo));
}

/// a + b
fn long_add_real(a: Long, b: real) -> Long {
    let s = long_sum(a.hi, b);
    return long_sum(s.hi, real_add(s.lo, a.lo));
}

/// a b + c d + e with about one rounding, however much cancels.
fn sum_of_products(a: real, b: real, c: real, d: real, e: real) -> real {
    let ab = long_product(a, b);
    let s = long_sum(ab.hi, e);
    let cd = long_product(c, d);
    let t = long_sum(s.hi, cd.hi);
    return long_to_real(long_add(long_sum(t.hi, ab.lo), long_add(long_sum(s.lo, t.lo), long_sum(cd.lo, num(0.0)))));
}

/// |a| as high · 2^high_exponent ± low · 2^low_exponent with integers.
struct Pieces {
    high: u32,
    high_exponent: i32,
    low: u32,
    low_exponent: i32,
    low_is_negative: bool,
}

/// The integers of a finite number.
fn pieces_of(a: real) -> Pieces {
    let w = real_to_words(a);
    let e = (w.y >> 20u) & 2047u;
    let m = (w.y & 0x000fffffu) | select(0u, 0x00100000u, e > 0u);
    let at = i32(max(e, 1u)) - 1075;
    return Pieces(m, at + 32, w.x, at, false);
}

/// (high 2^32 + low) 2^e, rounded, for a high that has its top bit set.
fn real_from_integer(high: u32, low: u32, e: i32) -> real {
    return scale(f64(high) * 4294967296.0lf + f64(low), e);
}

/// The largest number below 1.
fn below_one() -> real {
    return 0.9999999999999999lf;
}

/// (e^r - 1 - r) / r² for |r| ≤ log(2)/2; polynomials.py.
/// Error: 2^-56 of e^r - 1.
fn exp_tail(r: real) -> real {
    return 0.5000000000000001lf + r * (0.1666666666666667lf + r * (0.041666666666652065lf + r * (
        0.008333333333326044lf + r * (0.001388888889567415lf + r * (0.00019841269875149243lf + r * (
        2.4801574440710326e-05lf + r * (2.7557254975619854e-06lf + r * (2.75679675027895e-07lf + r * (
        2.510539626313525e-08lf + r * 1.7687825063192754e-09lf)))))))));
}

/// (log((1 + s)/(1 - s)) - 2 s - 2 s³/3) / s⁵, z = s² ≤ 0.0295; polynomials.py.
/// Error: 2^-59 of the logarithm.
fn log_rest(z: real) -> real {
    return 0.3999999999977946lf + z * (0.2857142867248649lf + z * (0.22222204963535996lf + z * (
        0.18183262071241504lf + z * (0.15321193027461033lf + z * 0.1472922684306634lf))));
}

/// (sin r - r) / r³, z = r² ≤ π²/16; polynomials.py.
/// Error: 2^-57 of sin r.
fn sin_tail(z: real) -> real {
    return -0.16666666666666632lf + z * (0.00833333333332237lf + z * (-0.00019841269829771514lf + z * (
        2.755731367876691e-06lf + z * (-2.505075597414067e-08lf + z * 1.5896667081298702e-10lf))));
}

/// (cos r - 1 + r²/2) / r⁴, z = r² ≤ π²/16; polynomials.py.
/// Error: 2^-59 of cos r.
fn cos_tail(z: real) -> real {
    return 0.0416666666666666lf + z * (-0.0013888888888874066lf + z * (2.4801587289444146e-05lf + z * (
        -2.755731434083461e-07lf + z * (2.0875721645778737e-09lf + z * -1.1359560402639843e-11lf))));
}

/// (arctan t - t) / t³, z = t² ≤ 1/253; polynomials.py.
/// Error: 2^-61 of arctan t.
fn atan_tail(z: real) -> real {
    return -0.33333333333333154lf + z * (0.19999999999348494lf + z * (-0.14285713527008606lf + z * (
        0.11110725366124007lf + z * -0.0900178831570892lf)));
}

/// log((1 + s)/(1 - s)) - 2 s, beside 2 s of 53 bits more.
fn log_correction(s: Long) -> Long {
    let z = long_times(s, s);
    let t = long_sum(0.6666666666666666lf, z.hi * log_rest(z.hi));
    // 2/3 in f64 falls short by 2^-54.6
    return long_times(long_times(s, z), Long(t.hi, t.lo + 3.700743415417188e-17lf));
}

/// sin (r + low) for |r| ≤ π/4, low below its last place.
fn sin_near(r: real, low: real) -> real {
    let z = r * r;
    return r + (r * z * sin_tail(z) + low * (1.0lf - 0.5lf * z));
}

/// cos (r + low) for |r| ≤ π/4, low below its last place.
fn cos_near(r: real, low: real) -> real {
    let z = r * r;
    let w = quick_two_sum(1.0lf, -0.5lf * z, hidden_zero(z));
    return w.hi + (w.lo + (z * z * cos_tail(z) - r * low));
}

/// a + b for a tiny b, and what that loses.
fn rest_with_low(a: real, b: real) -> RealPair {
    let r = quick_two_sum(a, b, hidden_zero(a));
    return RealPair(r.hi, r.lo);
}

/// h · 2^e radians for the fraction h = high + low/2^32 of a quarter turn, high with its top bit set, and what that
/// loses: the first 21 bits of π/2 times 32 are exact.
fn radians_of_turns(high: u32, low: u32, e: i32) -> RealPair {
    let h = f64(high);
    let l = f64(low) * 2.3283064365386963e-10lf;
    let zero = hidden_zero(h);
    let r = quick_two_sum(opaque(h * 1.570796012878418lf, zero), l * 1.5707963267948966lf + h * 3.139164786504813e-07lf, zero);
    return RealPair(scale(r.hi, e), scale(r.lo, e));
}

/// Beyond this magnitude e^x is 0 or infinite.
const EXP_END: f32 = 800.0;
