// Numbers as unevaluated sums of two f32, hi + lo with |lo| ≤ ulp(hi)/2: 48 bits and the exponents of f32.
//
// Errors are in units of u² = 2^-48, relative, for operands and results of magnitude 2^-80 and more: the low word of a
// smaller number is subnormal, and flushed by most adapters. Bounds are those of Joldes, Muller, Popescu, "Tight and
// rigorous error bounds for basic building blocks of double-word arithmetic" (ACM TOMS 44 (2), 2017), "JMP" below.
// The high word alone says what a number is: zero, infinite, NaN, and its sign; beside such a word the low one is a zero.

alias real = vec2f;

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

// The exact steps (hidden_zero, opaque, quick_two_sum, two_sum, two_product) stand in exact_*.wgsl, in front of this text.

/// A hidden zero for an operation on two numbers. One of them may be a constant, of which alone the compiler would know
/// it; and both may be the same.
fn hidden_zero_of(a: f32, b: f32) -> u32 {
    return hidden_zero(bitcast<f32>((bitcast<u32>(a) << 1u) ^ bitcast<u32>(b)));
}

/// Whether a word is 0, subnormal, infinite or NaN: then it has no low word beside it.
fn pair_is_bare(hi: f32) -> bool {
    return (bitcast<u32>(hi) << 1u) - 0x01000000u >= 0xfe000000u;
}

/// Whether a word is infinite or NaN.
fn pair_is_unbounded(hi: f32) -> bool {
    return (bitcast<u32>(hi) & 0x7f800000u) == 0x7f800000u;
}

/// A number of one word: a zero low word of its sign, so that the signs of zeros survive sums.
fn real_from_f32(x: f32) -> real {
    return vec2f(x, bitcast<f32>(bitcast<u32>(x) & 0x80000000u));
}

/// The nearest f32.
fn real_to_f32(x: real) -> f32 {
    return x.x;
}

/// n exactly.
fn real_from_i32(n: i32) -> real {
    return quick_two_sum(f32(n - (n & 0xffff)), f32(n & 0xffff), hidden_zero(f32(n)));
}

/// The number of the words (bits of hi, bits of lo).
fn real_from_words(w: vec2u) -> real {
    return select(bitcast<vec2f>(w), real_from_f32(bitcast<f32>(w.x)), pair_is_bare(bitcast<f32>(w.x)));
}

fn real_to_words(x: real) -> vec2u {
    return bitcast<vec2u>(x);
}

/// A short constant.
fn num(a: f32) -> real {
    return real_from_f32(a);
}

/// A constant as the sum of three f32, of which a pair keeps two.
fn lit(a: f32, b: f32, c: f32) -> real {
    return vec2f(a, b);
}

/// x with a high word that no driver may join with what follows.
fn rounded(x: real) -> real {
    return x;
}

fn is_nan(x: real) -> bool {
    return (bitcast<u32>(x.x) & 0x7fffffffu) > 0x7f800000u;
}

fn is_infinite(x: real) -> bool {
    return (bitcast<u32>(x.x) & 0x7fffffffu) == 0x7f800000u;
}

fn is_finite(x: real) -> bool {
    return !pair_is_unbounded(x.x);
}

/// Whether x is a zero; of a subnormal, where they are flushed, too.
fn is_zero(x: real) -> bool {
    return abs(x.x) == 0.0;
}

/// x < 0, -0 included.
fn sign_is_set(x: real) -> bool {
    return (bitcast<u32>(x.x) & 0x80000000u) != 0u;
}

/// A quiet NaN, whatever the seed.
fn make_nan(seed: real) -> real {
    return real_from_f32(bitcast<f32>(bitcast<u32>(seed.x) | 0x7fc00000u));
}

/// The infinity with the sign of the seed.
fn make_infinity(seed: real) -> real {
    return real_from_f32(bitcast<f32>((bitcast<u32>(seed.x) & 0x80000000u) | 0x7f800000u));
}

/// a where c, else b.
fn choose(c: bool, a: real, b: real) -> real {
    return select(b, a, c);
}

/// -a where c, by sign bits.
fn flip_if(a: real, c: bool) -> real {
    return bitcast<vec2f>(bitcast<vec2u>(a) ^ vec2u(select(0u, 0x80000000u, c)));
}

fn real_neg(a: real) -> real {
    return bitcast<vec2f>(bitcast<vec2u>(a) ^ vec2u(0x80000000u));
}

fn real_abs(a: real) -> real {
    return bitcast<vec2f>(bitcast<vec2u>(a) ^ vec2u(bitcast<u32>(a.x) & 0x80000000u));
}

/// |a| with the sign of s.
fn with_sign(a: real, s: real) -> real {
    return bitcast<vec2f>(bitcast<vec2u>(a) ^ vec2u((bitcast<u32>(a.x) ^ bitcast<u32>(s.x)) & 0x80000000u));
}

/// Whether a sum is a zero, with the sign that the sum of the upper words has: errors of 0 lose it.
fn pair_vanishes(sum: f32, upper: f32) -> bool {
    return sum == 0.0 && upper == 0.0;
}

/// a + b. Error: 3 u² (JMP algorithm 6), also where the terms cancel.
fn real_add(a: real, b: real) -> real {
    let zero = hidden_zero_of(a.x, b.x);
    let s = two_sum(a.x, b.x, zero);
    let t = two_sum(a.y, b.y, zero);
    let v = quick_two_sum(s.x, opaque(s.y + t.x, zero), zero);
    let r = quick_two_sum(v.x, opaque(t.y + v.y, zero), zero);
    return select(r, vec2f(s.x, 0.0), pair_is_unbounded(s.x) || pair_vanishes(r.x, s.x));
}

/// a - b. Error: 3 u².
fn real_sub(a: real, b: real) -> real {
    return real_add(a, real_neg(b));
}

/// a + b for a word b. Error: 2 u² (JMP algorithm 4).
fn add32(a: real, b: f32) -> real {
    let zero = hidden_zero_of(a.x, b);
    let s = two_sum(a.x, b, zero);
    let r = quick_two_sum(s.x, opaque(s.y + a.y, zero), zero);
    return select(r, vec2f(s.x, 0.0), pair_is_unbounded(s.x) || pair_vanishes(r.x, s.x));
}

/// a b. Error: 5 u² (JMP algorithm 11).
fn real_mul(a: real, b: real) -> real {
    let zero = hidden_zero_of(a.x, b.x);
    let p = two_product(a.x, b.x, zero);
    let r = quick_two_sum(p.x, opaque(p.y + (a.x * b.y + a.y * b.x), zero), zero);
    return select(r, real_from_f32(p.x), pair_is_bare(p.x));
}

/// a². Error: 5 u².
fn real_square(a: real) -> real {
    let zero = hidden_zero(a.x);
    let p = two_product(a.x, a.x, zero);
    let r = quick_two_sum(p.x, opaque(p.y + 2.0 * a.x * a.y, zero), zero);
    return select(r, real_from_f32(p.x), pair_is_bare(p.x));
}

/// a b for a word b. Error: 3 u² (JMP algorithm 8).
fn mul32(a: real, b: f32) -> real {
    let zero = hidden_zero_of(a.x, b);
    let p = two_product(a.x, b, zero);
    let r = quick_two_sum(p.x, opaque(p.y + a.y * b, zero), zero);
    return select(r, real_from_f32(p.x), pair_is_bare(p.x));
}

/// v, which came of a and b, cut off from how it was made; in decorated modules too, for a compiler that must not contract
/// still makes a of (a / 3) 3.
fn cut(v: f32, a: f32, b: f32) -> f32 {
    let odd = ((bitcast<u32>(a) << 1u) ^ bitcast<u32>(b)) | 1u;
    return bitcast<f32>(bitcast<u32>(v) ^ ((odd * odd) & 4u));
}

/// a / b. Error: 10 u² where the words' quotients are correctly rounded (after JMP algorithm 17).
fn real_div(a: real, b: real) -> real {
    let zero = hidden_zero_of(a.x, b.x);
    // a tiny one is scaled, for the low word of q b would underflow
    let tiny = abs(a.x) < 8.4703295e-22;
    let v = a * select(1.0, 1.8446744e19, tiny);
    let q = cut(v.x / b.x, v.x, b.x);
    let p = two_product(q, b.x, zero);
    let rest = opaque(opaque(v.x - p.x, zero) - p.y, zero) + (v.y - q * b.y);
    let correction = opaque(rest / b.x, zero);
    let bare = pair_is_bare(q) || pair_is_unbounded(correction);
    let r = select(quick_two_sum(q, correction, zero), real_from_f32(q), bare);
    return r * select(1.0, 5.421011e-20, tiny);
}

/// √a; NaN below 0, -0 of -0. Error: 4 u² (Lefèvre, Louvet, Muller, Picot, Rideau 2023).
fn real_sqrt(a: real) -> real {
    let zero = hidden_zero(a.x);
    // a tiny one is scaled, for its square's low word would underflow
    let tiny = abs(a.x) < 3.5527137e-15;
    let v = a * select(1.0, 1.1529215e18, tiny);
    let s = cut(sqrt(abs(v.x)), v.x, v.y);
    let p = two_product(s, s, zero);
    let rest = opaque(opaque(abs(v.x) - p.x, zero) - p.y, zero) + v.y;
    let r = quick_two_sum(s, opaque(rest / (2.0 * s), zero), zero) * select(1.0, 9.313226e-10, tiny);
    if pair_is_bare(s) && !(sign_is_set(a) && is_infinite(a)) {
        return a;
    }
    return select(r, make_nan(a), sign_is_set(a));
}

fn real_less(a: real, b: real) -> bool {
    return a.x < b.x || (a.x == b.x && a.y < b.y);
}

fn real_less_equal(a: real, b: real) -> bool {
    return a.x < b.x || (a.x == b.x && a.y <= b.y);
}

fn real_equal(a: real, b: real) -> bool {
    return a.x == b.x && a.y == b.y;
}

fn real_not_equal(a: real, b: real) -> bool {
    return !real_equal(a, b);
}

/// ⌊a⌋
fn real_floor(a: real) -> real {
    let f = floor(a.x);
    if pair_is_unbounded(a.x) {
        return a;
    }
    let whole = quick_two_sum(f, floor(a.y), hidden_zero(a.x));
    return select(real_from_f32(f), whole, f == a.x && a.y != 0.0);
}

/// 2^n for n in [-126, 127].
fn pair_power_of_two(n: i32) -> f32 {
    return bitcast<f32>(u32(n + 127) << 23u);
}

/// a 2^n for every n: overflow and underflow happen once, at the end.
fn scale(a: real, n: i32) -> real {
    if abs(n) < 120 {
        return a * pair_power_of_two(n);
    }
    let zero = vec2u(hidden_zero_of(a.x, f32(n)));
    let all = clamp(n, -360, 360);
    let first = all / 3;
    let second = (all - first) / 2;
    let v = bitcast<vec2f>(bitcast<vec2u>(a * pair_power_of_two(first)) ^ zero);
    let w = bitcast<vec2f>(bitcast<vec2u>(v * pair_power_of_two(second)) ^ zero);
    let r = w * pair_power_of_two(all - first - second);
    return select(r, real_from_f32(r.x), pair_is_bare(r.x));
}

/// ⌊log2 |hi|⌋ of a finite nonzero number.
fn exponent_of(a: real) -> i32 {
    let bits = bitcast<u32>(a.x) & 0x7fffffffu;
    let subnormal = 31 - i32(countLeadingZeros(bits)) - 149;
    return select(i32(bits >> 23u) - 127, subnormal, bits < 0x00800000u);
}

/// Two numbers whose sum is meant, with about twice the precision of one.
struct Long {
    hi: real,
    lo: real,
}

/// a + b exactly, but for what is below 2^-90 of it.
fn long_sum(a: real, b: real) -> Long {
    let zero = hidden_zero_of(a.x, b.x);
    let s = two_sum(a.x, b.x, zero);
    let t = two_sum(a.y, b.y, zero);
    let u = two_sum(s.y, t.x, zero);
    return pair_long(s.x, u.x, u.y, t.y, zero);
}

/// a + b, word by word, with the carries.
fn long_add(a: Long, b: Long) -> Long {
    let zero = hidden_zero_of(a.hi.x, b.hi.x);
    let s = two_sum(a.hi.x, b.hi.x, zero);
    let t = two_sum(a.hi.y, b.hi.y, zero);
    let u = two_sum(a.lo.x, b.lo.x, zero);
    let next = two_sum(t.x, s.y, zero);
    let v = two_sum(u.x, t.y, zero);
    let third = two_sum(v.x, next.y, zero);
    let rest = opaque((a.lo.y + b.lo.y) + (u.y + (v.y + third.y)), zero);
    return pair_long(s.x, next.x, third.x, rest, zero);
}

/// a + b
fn long_add_real(a: Long, b: real) -> Long {
    let zero = hidden_zero_of(a.hi.x, b.x);
    let s = two_sum(a.hi.x, b.x, zero);
    let t = two_sum(a.hi.y, b.y, zero);
    let next = two_sum(t.x, s.y, zero);
    let v = two_sum(a.lo.x, t.y, zero);
    let third = two_sum(v.x, next.y, zero);
    return pair_long(s.x, next.x, third.x, opaque(a.lo.y + (v.y + third.y), zero), zero);
}

/// a b, but for what is below 2^-90 of it.
fn long_product(a: real, b: real) -> Long {
    let zero = hidden_zero_of(a.x, b.x);
    let p = two_product(a.x, b.x, zero);
    let q = two_product(a.x, b.y, zero);
    let r = two_product(a.y, b.x, zero);
    let s = two_sum(q.x, r.x, zero);
    let t = two_sum(p.y, s.x, zero);
    // all of these are 2^-48 of the product, their errors 2^-72
    let u = two_product(a.y, b.y, zero);
    let c = two_sum(t.y, s.y, zero);
    let d = two_sum(q.y, r.y, zero);
    let e = two_sum(d.x, u.x, zero);
    let product = pair_long(p.x, t.x, c.x, e.x, zero);
    if pair_is_unbounded(p.x) {
        return product;
    }
    let rest = opaque((c.y + d.y) + (e.y + u.y), zero);
    return Long(product.hi, quick_two_sum(product.lo.x, opaque(product.lo.y + rest, zero), zero));
}

/// a + b + c + d of falling magnitudes, |a| ≥ |b| where a is not 0.
fn pair_long(a: f32, b: f32, c: f32, d: f32, zero: u32) -> Long {
    let low = two_sum(c, d, zero);
    let middle = two_sum(b, low.x, zero);
    let top = two_sum(a, middle.x, zero);
    let next = two_sum(top.y, middle.y, zero);
    let hi = quick_two_sum(top.x, next.x, zero);
    let lo = quick_two_sum(hi.y, next.y, zero);
    let plain = pair_is_unbounded(a);
    return Long(
        select(vec2f(hi.x, lo.x), vec2f(a, 0.0), plain),
        select(quick_two_sum(lo.y, opaque(low.y, zero), zero), vec2f(0.0), plain),
    );
}

/// Five words whose sum is meant.
struct Cascade {
    words: vec4f,
    last: f32,
}

/// The cascade with t more: what each sum loses goes into the next (Ogita, Rump, Oishi, "Accurate sum and dot product",
/// SIAM J. Sci. Comput. 26, 2005).
fn pair_cascade(c: Cascade, t: f32, zero: u32) -> Cascade {
    let p = two_sum(c.words.x, t, zero);
    let q = two_sum(c.words.y, p.y, zero);
    let r = two_sum(c.words.z, q.y, zero);
    let s = two_sum(c.words.w, r.y, zero);
    return Cascade(vec4f(p.x, q.x, r.x, s.x), opaque(c.last + s.y, zero));
}

/// a b + c d + e with about one rounding, however much cancels: the sixteen words of the partial products and two.
fn sum_of_products(a: real, b: real, c: real, d: real, e: real) -> real {
    let zero = hidden_zero_of(a.x, b.x);
    var sum = Cascade(vec4f(e, 0.0, 0.0), 0.0);
    for (var k = 0u; k < 16u; k++) {
        let v = select(a, c, (k & 2u) != 0u);
        let w = select(b, d, (k & 2u) != 0u);
        let p = two_product(select(v.x, v.y, (k & 4u) != 0u), select(w.x, w.y, (k & 8u) != 0u), zero);
        sum = pair_cascade(sum, select(p.x, p.y, (k & 1u) != 0u), zero);
    }
    // the first words may cancel once more: summed again, from the last one on
    for (var k = 0u; k < 2u; k++) {
        let words = sum;
        sum = Cascade(vec4f(words.last, 0.0, 0.0, 0.0), 0.0);
        sum = pair_cascade(sum, words.words.w, zero);
        sum = pair_cascade(sum, words.words.z, zero);
        sum = pair_cascade(sum, words.words.y, zero);
        sum = pair_cascade(sum, words.words.x, zero);
    }
    return two_sum(sum.words.x, opaque(sum.words.y + sum.words.z, zero), zero);
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
    let w = bitcast<vec2u>(a);
    let e = (w >> vec2u(23u)) & vec2u(255u);
    let m = (w & vec2u(0x007fffffu)) | select(vec2u(0u), vec2u(0x00800000u), e > vec2u(0u));
    let at = vec2i(max(e, vec2u(1u))) - 150;
    return Pieces(m.x, at.x, m.y, at.y, ((w.x ^ w.y) & 0x80000000u) != 0u);
}

/// (high 2^32 + low) 2^e, rounded to 48 bits, for a high that has its top bit set.
fn real_from_integer(high: u32, low: u32, e: i32) -> real {
    let next = ((high & 0xffu) << 16u) | (low >> 16u);
    let v = quick_two_sum(f32(high >> 8u) * 16777216.0, f32(next + ((low >> 15u) & 1u)), hidden_zero(f32(high)));
    return scale(v, e + 16);
}

/// 1 - 2^-48, the largest number below 1 of 48 bits.
fn below_one() -> real {
    return vec2f(1.0, -3.5527137e-15);
}

/// c + p r for |p r| ≤ |c|, a step of Horner's rule; the words may overlap in a bit or two.
fn pair_step(p: vec2f, r: real, hi: f32, lo: f32, zero: u32) -> vec2f {
    let m = two_product(p.x, r.x, zero);
    let s = quick_two_sum(hi, m.x, zero);
    return vec2f(s.x, s.y + (lo + (m.y + (p.x * r.y + p.y * r.x))));
}

/// (e^r - 1 - r) / r² for |r| ≤ log(2)/2; polynomials.py. The terms that matter beyond f32 are pairs.
/// Error: 2^-50 of e^r - 1.
fn exp_tail(r: real) -> real {
    let zero = hidden_zero(r.x);
    let tail = 2.4801499e-05 + r.x * (2.7557116e-06 + r.x * (2.7628502e-07 + r.x * 2.5161661e-08));
    var p = pair_step(vec2f(tail, 0.0), r, 0.0001984127, -1.2546697e-12, zero);
    p = pair_step(p, r, 0.0013888889, -2.8847617e-11, zero);
    p = pair_step(p, r, 0.008333334, -4.3465787e-10, zero);
    p = pair_step(p, r, 0.041666668, -1.2418693e-09, zero);
    p = pair_step(p, r, 0.16666667, -4.9670534e-09, zero);
    return pair_step(p, r, 0.5, 6.554719e-16, zero);
}

/// (log((1 + s)/(1 - s)) - 2 s - 2 s³/3) / s⁵, z = s² ≤ 0.0295; polynomials.py.
/// Error: 2^-48 of the logarithm.
fn log_rest(z: real) -> real {
    let zero = hidden_zero(z.x);
    let tail = 0.222231 + z.x * (0.18131512 + z.x * 0.16733985);
    let p = pair_step(vec2f(tail, 0.0), z, 0.2857142, 5.897346e-09, zero);
    return pair_step(p, z, 0.4, -5.754414e-09, zero);
}

/// (sin r - r) / r³, z = r² ≤ π²/16; polynomials.py.
/// Error: 2^-52 of sin r.
fn sin_tail(z: real) -> real {
    let zero = hidden_zero(z.x);
    var p = pair_step(vec2f(-2.5050756e-08 + z.x * 1.5896667e-10, 0.0), z, 2.7557314e-06, -6.183883e-14, zero);
    p = pair_step(p, z, -0.0001984127, 2.8405802e-12, zero);
    p = pair_step(p, z, 0.008333334, -4.3462817e-10, zero);
    return pair_step(p, z, -0.16666667, 4.967054e-09, zero);
}

/// (cos r - 1 + r²/2) / r⁴, z = r² ≤ π²/16; polynomials.py.
/// Error: 2^-52 of cos r.
fn cos_tail(z: real) -> real {
    let zero = hidden_zero(z.x);
    var p = pair_step(vec2f(-2.7555564e-07 + z.x * 2.0647513e-09, 0.0), z, 2.480158e-05, 5.8654367e-13, zero);
    p = pair_step(p, z, -0.0013888889, 3.4696752e-11, zero);
    return pair_step(p, z, 0.041666668, -1.2418282e-09, zero);
}

/// (arctan t - t) / t³, z = t² ≤ 1/253; polynomials.py.
/// Error: 2^-50 of arctan t.
fn atan_tail(z: real) -> real {
    let zero = hidden_zero(z.x);
    let p = pair_step(vec2f(-0.14285426 + z.x * 0.110239476, 0.0), z, 0.2, -6.7631363e-09, zero);
    return pair_step(p, z, -0.33333334, 9.935646e-09, zero);
}

/// log((1 + s)/(1 - s)) - 2 s, beside 2 s of 48 bits more.
fn log_correction(s: Long) -> Long {
    let z = real_square(s.hi);
    let t = real_add(lit(0.6666667, -1.9868216e-8, 0.0), real_mul(z, log_rest(z)));
    return Long(real_mul(real_mul(s.hi, z), t), vec2f(0.0));
}

/// sin r for |r| ≤ π/4; r has no low part.
fn sin_near(r: real, low: real) -> real {
    let z = real_square(r);
    return real_add(r, real_mul(real_mul(r, z), sin_tail(z)));
}

/// cos r for |r| ≤ π/4; r has no low part.
fn cos_near(r: real, low: real) -> real {
    let z = real_square(r);
    return add32(real_sub(real_mul(real_square(z), cos_tail(z)), scale(z, -1)), 1.0);
}

/// a + b for a tiny b, and what that loses: nothing that matters here.
fn rest_with_low(a: real, b: real) -> RealPair {
    return RealPair(real_add(a, b), num(0.0));
}

/// h · 2^e radians for the fraction h = high + low/2^32 of a quarter turn, high with its top bit set, and what that
/// loses.
fn radians_of_turns(high: u32, low: u32, e: i32) -> RealPair {
    return RealPair(real_mul(real_from_integer(high, low, e - 32), lit(1.5707964, -4.371139e-08, 0.0)), num(0.0));
}

/// Beyond this magnitude e^x is 0 or infinite.
const EXP_END: f32 = 150.0;
