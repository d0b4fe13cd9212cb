// Complex powers. z^w = e^(w log z) loses |w log z| units of the last place when log z is rounded: so the logarithm is
// taken in long numbers, with a dozen bits more than the format has.

/// a / b, a dozen bits better than the format.
fn long_quotient(a: Long, b: Long) -> Long {
    let q = real_div(a.hi, b.hi);
    let rest = long_add(a, long_neg(long_mul(b, q)));
    return long_sum(q, real_div(long_to_real(rest), b.hi));
}

/// arctan(k/4) where coarse, else arctan(k/32) or artanh(k/32), k = 0 … 4.
fn arc_of_fraction(k: i32, coarse: bool, circular: bool) -> Long {
    switch select(8, select(4, 0, coarse), circular) + k - select(0, 100, k == 0) {
        case 1: { return long_lit(0.24497867, -3.1786778e-09, -7.256797e-17, 1.5759736e-24, -4.521441e-33); }
        case 2: { return long_lit(0.4636476, 5.0121587e-09, -3.2812372e-17, -1.5413917e-24, 5.6382403e-33); }
        case 3: { return long_lit(0.6435011, 5.8689373e-09, 1.268571e-16, -6.206552e-24, -1.2370743e-31); }
        case 4: { return long_lit(0.7853982, -2.1855694e-08, -8.5756226e-16, 5.2814995e-24, 4.2392138e-32); }
        case 5: { return long_lit(0.031239834, -2.525072e-10, -1.15967835e-17, -6.548892e-26, -2.2365878e-33); }
        case 6: { return long_lit(0.06241881, -1.0272779e-09, -4.3182438e-17, -1.2628117e-24, 4.3695162e-32); }
        case 7: { return long_lit(0.09347678, 1.3996593e-09, -2.0162261e-17, 6.7146627e-25, -1.8676398e-32); }
        case 8: { return long_lit(0.124354996, -1.2403822e-09, -3.08809e-17, -8.689346e-25, -9.038426e-33); }
        case 9: { return long_lit(0.031260177, 9.975716e-10, 1.5918487e-17, 5.1676296e-25, -1.4739901e-32); }
        case 10: { return long_lit(0.06258157, 2.520628e-09, -4.3547406e-17, 9.639784e-25, 2.0091614e-32); }
        case 11: { return long_lit(0.09402612, -2.765452e-09, -8.126074e-17, -3.1570977e-24, -2.8187264e-32); }
        case 12: { return long_lit(0.12565722, -1.5740016e-09, -1.63086e-17, -6.141573e-25, 8.7724396e-33); }
        default: { return zero_long(); }
    }
}

/// A quotient n/d of long numbers.
struct Slope {
    n: Long,
    d: Long,
}

/// (t - b) / (1 ± t b) of t = n/d: the theorem of addition of arctan for +, of artanh for -; b is short.
fn subtract_slope(t: Slope, b: f32, circular: bool) -> Slope {
    let s = num(select(b, -b, circular));
    return Slope(long_add(t.n, long_mul(t.d, num(-b))), long_add(t.d, long_neg(long_mul(t.n, s))));
}

/// u ∓ u³/3 + u⁵/5 …: arctan u where circular, else artanh u, |u| ≤ 1/64.
fn short_arc(t: Slope, circular: bool) -> Long {
    let u = long_quotient(t.n, t.d);
    let w = flip_if(real_square(u.hi), circular);
    // 1/3 + w/5 + w²/7 + …, 1/13 w^5 being 2^-64 of the sum
    var sum = lit(0.09090909, -2.7093021e-09, 8.0743495e-17);
    sum = real_add(lit(0.11111111, -8.278423e-10, 6.1679057e-18), real_mul(w, sum));
    sum = real_add(lit(0.14285715, -6.386212e-09, 6.344132e-17), real_mul(w, sum));
    sum = real_add(lit(0.2, -2.9802323e-09, 4.440892e-17), real_mul(w, sum));
    sum = real_add(lit(0.33333334, -9.934108e-09, 2.9605948e-16), real_mul(w, sum));
    return long_add_real(u, real_mul(u.hi, real_mul(w, sum)));
}

fn long_flip_if(a: Long, c: bool) -> Long {
    return Long(flip_if(a.hi, c), flip_if(a.lo, c));
}

/// arctan t for 0 ≤ t ≤ 1 where circular, else artanh t for |t| ≤ 0.1716: two table points, the first a multiple of 1/4
/// or 1/32, the second of 1/32, then a short series (after Gal and Bachelis, ACM TOMS 17, 1991).
fn long_arc(t: Slope, circular: bool) -> Long {
    var rest = t;
    var sum = Long(num(0.0), num(0.0));
    for (var turn = 0u; turn < 2u; turn++) {
        let coarse = circular && turn == 0u;
        let count = select(32.0, 4.0, coarse);
        let k = clamp(i32(floor(count * (real_to_f32(rest.n.hi) / real_to_f32(rest.d.hi)) + 0.5)), -4, 4);
        rest = subtract_slope(rest, f32(k) / count, circular);
        sum = long_add(sum, long_flip_if(arc_of_fraction(abs(k), coarse, circular), k < 0));
    }
    return long_add(sum, short_arc(rest, circular));
}

/// An angle turns · π/2 + rest, |rest| ≤ π/4.
struct Phase {
    turns: f32,
    rest: Long,
}

/// log |z| and arg z of a finite nonzero z.
struct LongPolar {
    modulus: Long,
    phase: Phase,
}

/// Of m = |z|² 2^-k in [√½, √2], log m = 2 artanh((m - 1)/(m + 1)). Arcs are counted from the nearest axis: those of
/// numbers near the axes keep their small digits.
fn long_polar(z: Complex) -> LongPolar {
    let top = complex_exponent(z);
    let e = select(top, 0, top == -1);
    let v = complex_scale(z, -e);
    var m = long_add(long_product(v.re, v.re), long_product(v.im, v.im));
    let split = split_logarithm(m.hi);
    m = long_scale(m, -split.exponent);
    let zero = num(0.0);
    let a = real_abs(v.re);
    let c = real_abs(v.im);
    var slope = Slope(long_add_real(m, num(-1.0)), long_add_real(m, num(1.0)));
    var log = zero_long();
    var angle = zero_long();
    for (var turn = 0u; turn < 2u; turn++) { // one after the other: the text of an arc is long
        log = angle;
        angle = long_arc(slope, turn == 1u);
        slope = Slope(Long(real_min(a, c), zero), Long(real_max(a, c), zero));
    }
    let modulus = long_add(long_mul(long_log2(), num(0.5 * f32(2 * e + split.exponent))), log);
    let steep = real_less(a, c);
    let left = sign_is_set(z.re);
    let down = sign_is_set(z.im);
    let turns = select(select(0.0, 2.0, left), 1.0, steep);
    return LongPolar(modulus, Phase(select(turns, -turns, down), long_flip_if(angle, down != (steep != left))));
}

fn zero_long() -> Long {
    return Long(num(0.0), num(0.0));
}

/// π/2 to 120 bits.
fn long_half_pi() -> Long {
    return long_lit(1.5707964, -4.371139e-08, -1.7151245e-15, 1.0562999e-23, 8.4784276e-32);
}

/// e^x of a long x as value 2^exponent with the value in [0.7, 1.42]. Beyond ±3000 as there.
fn exp_apart(x: Long) -> Scaled {
    let s = split_exponent(clamped(x.hi, 3000.0));
    let low = choose(is_above(real_abs(x.hi), 3000.0), num(0.0), x.lo);
    return Scaled(add32(expm1_polynomial(real_add(s.rest, low)), 1.0), s.count);
}

/// e^(size + i spin) i^quarters / 2^down, its exponent apart from the start.
fn complex_exp_of_long(size: Long, spin: Long, quarters: u32, down: i32) -> Complex {
    let s = exp_apart(size);
    var turned = Complex(s.value, num(0.0));
    for (var turn = 0u; turn < 2u; turn++) { // of a large angle the low part is no small one
        let wave = real_sincos(choose(turn == 0u, spin.hi, spin.lo));
        turned = Complex(
            real_sub(real_mul(turned.re, wave.second), real_mul(turned.im, wave.first)),
            real_add(real_mul(turned.re, wave.first), real_mul(turned.im, wave.second)),
        );
    }
    let v = complex_scale(turned, s.exponent - down);
    let u = complex_choose((quarters & 1u) == 1u, complex_mul_i(v), v);
    return complex_choose((quarters & 2u) == 2u, complex_neg(u), u);
}

/// z^(w + low) e^shift / 2^down for finite z ≠ 0, quarter turns apart.
fn power_and_exp(z: Complex, w: Complex, low: real, shift: LongComplex, down: i32) -> Complex {
    let polar = long_polar(z);
    let modulus = polar.modulus;
    let phase = polar.phase;
    let arg = long_add(long_mul(long_half_pi(), num(phase.turns)), phase.rest);
    // log |result| = w.re log|z| - w.im arg z + shift.re
    var size = long_add(long_mul(modulus, w.re), long_neg(long_mul(arg, w.im)));
    size = long_add_real(long_add(size, shift.re), real_mul(low, modulus.hi));
    // its phase = w.re arg z + w.im log|z| + shift.im
    let turns = mul32(w.re, phase.turns);
    let count = real_floor(add32(turns, 0.5));
    var spin = long_add(long_mul(long_half_pi(), real_sub(turns, count)), long_mul(phase.rest, w.re));
    spin = long_add(spin, long_mul(modulus, w.im));
    spin = long_add_real(long_add(spin, shift.im), real_mul(low, arg.hi));
    let quarters = real_sub(count, mul32(real_floor(mul32(count, 0.25)), 4.0));
    return complex_exp_of_long(size, spin, u32(real_to_f32(quarters)), down);
}

/// A complex number of long parts.
struct LongComplex {
    re: Long,
    im: Long,
}

fn long_scale(a: Long, n: i32) -> Long {
    return Long(scale(a.hi, n), scale(a.lo, n));
}

fn long_complex_mul(z: LongComplex, w: LongComplex) -> LongComplex {
    return LongComplex(
        long_add(long_times(z.re, w.re), long_neg(long_times(z.im, w.im))),
        long_add(long_times(z.re, w.im), long_times(z.im, w.re)),
    );
}

/// z 2^exponent, the larger part of z in [1, 2).
struct LongPower {
    z: LongComplex,
    exponent: i32,
}

fn long_normal(z: LongComplex, exponent: i32) -> LongPower {
    let e = complex_exponent(Complex(z.re.hi, z.im.hi));
    // where the exponent is cut off, the power overflows or underflows already
    return LongPower(LongComplex(long_scale(z.re, -e), long_scale(z.im, -e)), clamp(exponent + e, -1000000, 1000000));
}

/// z^count for finite z ≠ 0 in long numbers, by the binary digits of the count from the second on: a square for each, and
/// a product with z where it is 1.
fn long_powi(z: Complex, count: u32) -> LongPower {
    let base = long_normal(LongComplex(Long(z.re, num(0.0)), Long(z.im, num(0.0))), 0);
    var power = base;
    var bit = 31u - countLeadingZeros(count);
    var squared = false;
    // ends: every second turn takes one of 32 bits
    while bit > 0u {
        var factor = power;
        if squared {
            factor = base;
        }
        if !squared || ((count >> (bit - 1u)) & 1u) == 1u {
            power = long_normal(long_complex_mul(power.z, factor.z), power.exponent + factor.exponent);
        }
        if squared {
            bit -= 1u;
        }
        squared = !squared;
    }
    return power;
}

/// z^n of a finite z ≠ 0 for n ≠ 0.
fn finite_powi(z: Complex, n: i32) -> Complex {
    let long = long_powi(z, u32(abs(n)));
    let power = Complex(long_to_real(long.z.re), long_to_real(long.z.im));
    let r = complex_scale(complex_choose(n < 0, complex_inverse(power), power), select(long.exponent, -long.exponent, n < 0));
    return complex_choose(is_zero(z.im), Complex(r.re, signed_zero(zero_of_power(z, n))), r);
}

/// A number with the sign of the imaginary part of z^n for a real z, n ≠ 0.
fn zero_of_power(z: Complex, n: i32) -> real {
    let odd = sign_is_set(z.re) && (n & 1) == 0;
    return num(select(1.0, -1.0, (odd != sign_is_set(z.im)) != (n < 0)));
}

/// Whether z is 0 or a real that is not finite.
fn is_end_of_axis(z: Complex) -> bool {
    return is_zero(z.im) && (is_zero(z.re) || !is_finite(z.re));
}

/// z^n there, for n ≠ 0.
fn powi_at_end(z: Complex, n: i32) -> Complex {
    let r = power_at_ends(z.re, is_zero(z.re) == (n < 0), sign_is_set(z.re) && (n & 1) == 1);
    return Complex(choose(is_nan(z.re), z.re, r), signed_zero(zero_of_power(z, n)));
}

/// z^n: by repeated squaring in long numbers; real on the real axis; z^0 = 1.
/// Error: 6 u each component for |n| ≤ 8, beyond of the norm.
fn complex_powi(z: Complex, n: i32) -> Complex {
    if n == 0 {
        return complex_of_real(num(1.0));
    }
    if is_end_of_axis(z) {
        return powi_at_end(z, n);
    }
    if !complex_is_finite(z) {
        return power_of_infinity(z, complex_of_real(real_from_i32(n)));
    }
    return finite_powi(z, n);
}

/// z^w where z or w is infinite or NaN, or w beyond all measure.
fn power_of_infinity(z: Complex, w: Complex) -> Complex {
    return complex_exp(complex_mul(w, complex_log(z)));
}

/// z^w on the principal branch: w = 0 gives 1, an integer w gives `complex_powi`, 0^w is 0 for Re w > 0 and infinite
/// for Re w < 0 (NaN for the other w). Error: 8 u of the norm; for integers that of `complex_powi`.
fn complex_pow(z: Complex, w: Complex) -> Complex {
    return complex_pow_beside(z, w, num(0.0));
}

/// z^(w + low) for a low below an ulp of w.
fn complex_pow_beside(z: Complex, w: Complex, low: real) -> Complex {
    let size = real_abs(w.re);
    let is_real = is_zero(w.im);
    let whole = is_real && is_zero(low) && real_less_equal(size, num(1000000.0)) && real_equal(real_floor(w.re), w.re);
    let n = select(0, i32(real_to_f32(w.re)), whole);
    if whole && n == 0 {
        return complex_of_real(num(1.0));
    }
    if whole && is_end_of_axis(z) {
        return powi_at_end(z, n);
    }
    if complex_is_zero(z) {
        if is_zero(w.re) || is_nan(w.re) {
            return complex_nan(z.re);
        }
        if !sign_is_set(w.re) {
            return complex_of_real(num(0.0));
        }
        return Complex(make_infinity(num(1.0)), choose(is_real, num(0.0), make_nan(z.re)));
    }
    if !complex_is_finite(z) || !complex_is_finite(w) || is_above(real_max(size, real_abs(w.im)), 1e30) {
        return power_of_infinity(z, w);
    }
    if whole {
        return finite_powi(z, n);
    }
    let power = power_and_exp(z, w, low, LongComplex(zero_long(), zero_long()), 0);
    let on_axis = is_real && is_zero(z.im) && !sign_is_set(z.re);
    return Complex(power.re, choose(on_axis, flip_if(num(0.0), signs_differ(z.im, w.re)), power.im));
}

/// z^(w + c) for a small whole real c: as `real_pow_shift`.
fn complex_pow_shift(z: Complex, w: Complex, c: Complex) -> Complex {
    let s = long_sum(w.re, c.re);
    let plain = !is_finite(w.re) || complex_is_zero(z) || !complex_is_finite(z);
    return complex_pow_beside(z, Complex(s.hi, w.im), choose(plain, num(0.0), s.lo));
}
