// Complex powers. z^w = e^(w log z) loses |w log z| units of the last place when log z is rounded: so the logarithm is
// taken in long numbers, with a dozen bits more than the format has.

/// a / b, a dozen bits better than the format.
fn long_quotient(a: Long, b: Long) -> Long {
    let q = real_div(a.hi, b.hi);
    let rest = long_add(a, long_neg(long_mul(b, q)));
    return long_sum(q, real_div(long_to_real(rest), b.hi));
}

/// arctan(k/4), k = 0 … 4.
fn arctan_of_quarters(k: i32) -> Long {
    switch k {
        case 1: { return long_lit(0.24497867, -3.1786778e-09, -7.256797e-17, 1.5759736e-24, -4.521441e-33); }
        case 2: { return long_lit(0.4636476, 5.0121587e-09, -3.2812372e-17, -1.5413917e-24, 5.6382403e-33); }
        case 3: { return long_lit(0.6435011, 5.8689373e-09, 1.268571e-16, -6.206552e-24, -1.2370743e-31); }
        case 4: { return long_lit(0.7853982, -2.1855694e-08, -8.5756226e-16, 5.2814995e-24, 4.2392138e-32); }
        default: { return Long(num(0.0), num(0.0)); }
    }
}

/// arctan(k/32), k = 0 … 4.
fn arctan_of_fine(k: i32) -> Long {
    switch k {
        case 1: { return long_lit(0.031239834, -2.525072e-10, -1.15967835e-17, -6.548892e-26, -2.2365878e-33); }
        case 2: { return long_lit(0.06241881, -1.0272779e-09, -4.3182438e-17, -1.2628117e-24, 4.3695162e-32); }
        case 3: { return long_lit(0.09347678, 1.3996593e-09, -2.0162261e-17, 6.7146627e-25, -1.8676398e-32); }
        case 4: { return long_lit(0.124354996, -1.2403822e-09, -3.08809e-17, -8.689346e-25, -9.038426e-33); }
        default: { return Long(num(0.0), num(0.0)); }
    }
}

/// artanh(k/32), k = 0 … 4.
fn artanh_of_fine(k: i32) -> Long {
    switch k {
        case 1: { return long_lit(0.031260177, 9.975716e-10, 1.5918487e-17, 5.1676296e-25, -1.4739901e-32); }
        case 2: { return long_lit(0.06258157, 2.520628e-09, -4.3547406e-17, 9.639784e-25, 2.0091614e-32); }
        case 3: { return long_lit(0.09402612, -2.765452e-09, -8.126074e-17, -3.1570977e-24, -2.8187264e-32); }
        case 4: { return long_lit(0.12565722, -1.5740016e-09, -1.63086e-17, -6.141573e-25, 8.7724396e-33); }
        default: { return Long(num(0.0), num(0.0)); }
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
    let z = real_square(u.hi);
    let w = flip_if(z, circular);
    // 1/3 + w/5 + w²/7 + …, 1/13 w^5 being 2^-64 of the sum
    var sum = lit(0.09090909, -2.7093021e-09, 8.0743495e-17);
    sum = real_add(lit(0.11111111, -8.278423e-10, 6.1679057e-18), real_mul(w, sum));
    sum = real_add(lit(0.14285715, -6.386212e-09, 6.344132e-17), real_mul(w, sum));
    sum = real_add(lit(0.2, -2.9802323e-09, 4.440892e-17), real_mul(w, sum));
    sum = real_add(lit(0.33333334, -9.934108e-09, 2.9605948e-16), real_mul(w, sum));
    return long_add_real(u, real_mul(u.hi, real_mul(w, sum)));
}

/// arctan t for 0 ≤ t ≤ 1: table points, then a short series (after Gal and Bachelis, ACM TOMS 17, 1991).
fn long_arctan(t: Slope) -> Long {
    let k = i32(floor(4.0 * (real_to_f32(t.n.hi) / real_to_f32(t.d.hi)) + 0.5));
    let near = subtract_slope(t, 0.25 * f32(k), true);
    let j = i32(floor(32.0 * (real_to_f32(near.n.hi) / real_to_f32(near.d.hi)) + 0.5));
    let table = arctan_of_fine(abs(j));
    let rest = short_arc(subtract_slope(near, 0.03125 * f32(j), true), true);
    return long_add(arctan_of_quarters(k), long_add(Long(flip_if(table.hi, j < 0), flip_if(table.lo, j < 0)), rest));
}

/// artanh t for |t| ≤ 0.1716, by two table points.
fn long_artanh(t: Slope) -> Long {
    let v = real_to_f32(t.n.hi) / real_to_f32(t.d.hi);
    let k = clamp(i32(floor(32.0 * v + 0.5)), -4, 4);
    let near = subtract_slope(t, 0.03125 * f32(k), false);
    let j = i32(floor(32.0 * (real_to_f32(near.n.hi) / real_to_f32(near.d.hi)) + 0.5));
    let rest = short_arc(subtract_slope(near, 0.03125 * f32(j), false), false);
    let a = artanh_of_fine(abs(k));
    let b = artanh_of_fine(abs(j));
    let points = long_add(
        Long(flip_if(a.hi, k < 0), flip_if(a.lo, k < 0)),
        Long(flip_if(b.hi, j < 0), flip_if(b.lo, j < 0)),
    );
    return long_add(points, rest);
}

/// log |z| of a finite nonzero z: of m = |z|² 2^-k in [√½, √2], log m = 2 artanh((m - 1)/(m + 1)).
fn long_log_modulus(z: Complex) -> Long {
    let top = complex_exponent(z);
    let e = select(top, 0, top == -1);
    let v = complex_scale(z, -e);
    var m = long_add(long_product(v.re, v.re), long_product(v.im, v.im));
    let size = real_to_f32(m.hi);
    var k = 0;
    for (var half = 1.4142135; half < size; half = 2.0 * half) {
        k += 1;
    }
    for (var half = 0.70710677; half > size; half = 0.5 * half) {
        k -= 1;
    }
    m = Long(scale(m.hi, -k), scale(m.lo, -k));
    let arc = long_artanh(Slope(long_add_real(m, num(-1.0)), long_add_real(m, num(1.0))));
    return long_add(long_mul(long_log2(), num(0.5 * f32(2 * e + k))), arc);
}

/// An angle turns · π/2 + rest, |rest| ≤ π/4.
struct Phase {
    turns: f32,
    rest: Long,
}

/// arg z of a finite nonzero z, counted from the nearest axis: arcs of numbers near the axes keep their small digits.
fn long_phase(z: Complex) -> Phase {
    let e = complex_exponent(z);
    let a = scale(real_abs(z.re), -e);
    let c = scale(real_abs(z.im), -e);
    let zero = num(0.0);
    let angle = long_arctan(Slope(Long(real_min(a, c), zero), Long(real_max(a, c), zero)));
    let steep = real_less(a, c);
    let left = sign_is_set(z.re);
    let down = sign_is_set(z.im);
    let turns = select(select(0.0, 2.0, left), 1.0, steep);
    let flip = down != (steep != left);
    return Phase(select(turns, -turns, down), Long(flip_if(angle.hi, flip), flip_if(angle.lo, flip)));
}

/// π/2 to 120 bits.
fn long_half_pi() -> Long {
    return long_lit(1.5707964, -4.371139e-08, -1.7151245e-15, 1.0562999e-23, 8.4784276e-32);
}

/// e^(size + i spin) i^quarters, its exponent apart from the start.
fn complex_exp_of_long(size: Long, spin: Long, quarters: u32) -> Complex {
    let s = exp_apart(size);
    let wave = real_sincos(spin.hi);
    var turned = RealPair(real_add(wave.first, real_mul(wave.second, spin.lo)), real_sub(wave.second, real_mul(wave.first,
        spin.lo)));
    if is_above(real_abs(spin.lo), 1e-9) { // sin and cos of the low part are not it and 1
        let low = real_sincos(spin.lo);
        turned = RealPair(
            real_add(real_mul(wave.first, low.second), real_mul(wave.second, low.first)),
            real_sub(real_mul(wave.second, low.second), real_mul(wave.first, low.first)),
        );
    }
    let v = Complex(
        scale(real_mul(s.value, turned.second), s.exponent),
        scale(real_mul(s.value, turned.first), s.exponent),
    );
    let u = complex_choose((quarters & 1u) == 1u, complex_mul_i(v), v);
    return complex_choose((quarters & 2u) == 2u, complex_neg(u), u);
}

/// z^(w + low) e^shift for finite z ≠ 0, quarter turns apart.
fn power_and_exp(z: Complex, w: Complex, low: real, shift: Complex) -> Complex {
    let modulus = long_log_modulus(z);
    let phase = long_phase(z);
    let arg = long_add(long_mul(long_half_pi(), num(phase.turns)), phase.rest);
    // log |result| = w.re log|z| - w.im arg z + shift.re
    var size = long_add(long_mul(modulus, w.re), long_neg(long_mul(arg, w.im)));
    size = long_add_real(long_add_real(size, shift.re), real_mul(low, modulus.hi));
    // its phase = w.re arg z + w.im log|z| + shift.im
    let turns = mul32(w.re, phase.turns);
    let count = real_floor(add32(turns, 0.5));
    var spin = long_add(long_mul(long_half_pi(), real_sub(turns, count)), long_mul(phase.rest, w.re));
    spin = long_add(spin, long_mul(modulus, w.im));
    spin = long_add_real(long_add_real(spin, shift.im), real_mul(low, arg.hi));
    let quarters = real_sub(count, mul32(real_floor(mul32(count, 0.25)), 4.0));
    return complex_exp_of_long(size, spin, u32(real_to_f32(quarters)));
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

/// z^count for finite z ≠ 0 by repeated squaring in long numbers.
fn long_powi(z: Complex, count: u32) -> LongPower {
    let zero = num(0.0);
    var base = long_normal(LongComplex(Long(z.re, zero), Long(z.im, zero)), 0);
    var power = base;
    var left = count;
    var started = false;
    while true {
        if (left & 1u) == 1u {
            if started {
                power = long_normal(long_complex_mul(power.z, base.z), power.exponent + base.exponent);
            } else {
                power = base;
            }
            started = true;
        }
        left = left >> 1u;
        if left == 0u {
            break;
        }
        base = long_normal(long_complex_mul(base.z, base.z), 2 * base.exponent);
    }
    return power;
}

/// z^n for 1 ≤ n ≤ 8, |z| about 1.
fn short_powi(z: Complex, n: u32) -> Complex {
    var base = z;
    var power = z;
    var left = n;
    var started = false;
    while true {
        if (left & 1u) == 1u {
            if started {
                power = complex_mul(power, base);
            } else {
                power = base;
            }
            started = true;
        }
        left = left >> 1u;
        if left == 0u {
            break;
        }
        base = complex_square(base);
    }
    return power;
}

/// z^n: by repeated squaring, for |n| > 8 in long numbers; real on the real axis; z^0 = 1.
/// Error: 6 |n| u of the norm for |n| ≤ 8, else 6 u of the norm.
fn complex_powi(z: Complex, n: i32) -> Complex {
    if n == 0 {
        return complex_of_real(num(1.0));
    }
    if is_zero(z.im) {
        let odd = sign_is_set(z.re) && (n & 1) == 0;
        return Complex(real_powi(z.re, n), flip_if(num(0.0), (odd != sign_is_set(z.im)) != (n < 0)));
    }
    let count = u32(abs(n));
    if count <= 8u {
        let e = complex_exponent(z);
        var power = short_powi(complex_scale(z, -e), count);
        if n < 0 {
            power = complex_inverse(power);
        }
        return complex_scale(power, e * n);
    }
    if !complex_is_finite(z) {
        return complex_exp(complex_mul_real(complex_log(z), real_from_i32(n)));
    }
    let long = long_powi(z, count);
    let power = Complex(long_to_real(long.z.re), long_to_real(long.z.im));
    if n < 0 {
        return complex_scale(complex_inverse(power), -long.exponent);
    }
    return complex_scale(power, long.exponent);
}

/// z^w on the principal branch: w = 0 gives 1, an integer w gives `complex_powi`, 0^w is 0 for Re w > 0 and infinite
/// for Re w < 0 (NaN for the other w). Error: 8 u of the norm; for integers |n| ≤ 8 that of `complex_powi`.
fn complex_pow(z: Complex, w: Complex) -> Complex {
    let size = real_abs(w.re);
    if is_zero(w.im) && real_less_equal(size, num(1000000.0)) && real_equal(real_floor(w.re), w.re) {
        return complex_powi(z, i32(real_to_f32(w.re)));
    }
    if complex_is_zero(z) {
        if is_zero(w.re) || is_nan(w.re) {
            return complex_nan(z.re);
        }
        if !sign_is_set(w.re) {
            return complex_of_real(num(0.0));
        }
        return Complex(make_infinity(num(1.0)), choose(is_zero(w.im), num(0.0), make_nan(z.re)));
    }
    if !complex_is_finite(z) || !complex_is_finite(w) || is_above(real_max(size, real_abs(w.im)), 1e30) {
        return complex_exp(complex_mul(w, complex_log(z)));
    }
    if is_zero(w.im) && is_zero(z.im) && !sign_is_set(z.re) {
        return Complex(real_pow(z.re, w.re), flip_if(num(0.0), signs_differ(z.im, w.re)));
    }
    return power_and_exp(z, w, num(0.0), complex_of_real(num(0.0)));
}
