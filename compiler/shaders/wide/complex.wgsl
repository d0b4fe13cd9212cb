// Complex arithmetic, exponential, logarithm and square root of the wide formats. Branch cuts, signed zeros and
// infinities after C99 Annex G. Numbers are scaled so that the larger component is about 2^30, which leaves room below
// for the smaller one: pairs have the exponents of their high words.
//
// "Error" in these files is an estimate: u is 2^-48 for pairs and 2^-53 for f64. What is declared stands in
// compiler/src/table/bounds.tsv, and `pullback accuracy` measures it. In pairs it is meant for results of at least 2^-80,
// below which the low words are subnormal.

/// Whether a component is infinite: then the number is, whatever the other is (C99 G.3).
fn complex_is_infinite(z: Complex) -> bool {
    return is_infinite(z.re) || is_infinite(z.im);
}

/// Whether a component is NaN.
fn complex_has_nan(z: Complex) -> bool {
    return is_nan(z.re) || is_nan(z.im);
}

/// Whether both components are finite.
fn complex_is_finite(z: Complex) -> bool {
    return is_finite(z.re) && is_finite(z.im);
}

/// Whether both components are zeros.
fn complex_is_zero(z: Complex) -> bool {
    return is_zero(z.re) && is_zero(z.im);
}

/// Whether just one of the two signs is set.
fn signs_differ(a: real, b: real) -> bool {
    return sign_is_set(a) != sign_is_set(b);
}

/// Whether a > limit, within the rounding of a to f32; false for NaN.
fn is_above(a: real, limit: f32) -> bool {
    return real_to_f32(a) > limit;
}

/// Whether a < limit, within the rounding of a to f32; false for NaN.
fn is_below(a: real, limit: f32) -> bool {
    return real_to_f32(a) < limit;
}

/// ±0 with the sign of s.
fn signed_zero(s: real) -> real {
    return with_sign(num(0.0), s);
}

/// 2 a, exactly.
fn twice(a: real) -> real {
    return a + a;
}

fn complex_nan(seed: real) -> Complex {
    return Complex(make_nan(seed), make_nan(seed));
}

/// The complex number of a real one.
fn complex_of_real(x: real) -> Complex {
    return Complex(x, num(0.0));
}

fn complex_neg(z: Complex) -> Complex {
    return Complex(real_neg(z.re), real_neg(z.im));
}

fn complex_conj(z: Complex) -> Complex {
    return Complex(z.re, real_neg(z.im));
}

fn complex_add(z: Complex, w: Complex) -> Complex {
    return Complex(real_add(z.re, w.re), real_add(z.im, w.im));
}

fn complex_sub(z: Complex, w: Complex) -> Complex {
    return Complex(real_sub(z.re, w.re), real_sub(z.im, w.im));
}

/// z + x; the imaginary part stays as it is, a signed zero too.
fn complex_add_real(z: Complex, x: real) -> Complex {
    return Complex(real_add(z.re, x), z.im);
}

/// x z.
fn complex_mul_real(z: Complex, x: real) -> Complex {
    return Complex(real_mul(z.re, x), real_mul(z.im, x));
}

/// z / x.
fn complex_div_real(z: Complex, x: real) -> Complex {
    return Complex(real_div(z.re, x), real_div(z.im, x));
}

/// z 2^n.
fn complex_scale(z: Complex, n: i32) -> Complex {
    return Complex(scale(z.re, n), scale(z.im, n));
}

/// z where c, else w.
fn complex_choose(c: bool, z: Complex, w: Complex) -> Complex {
    return Complex(choose(c, z.re, w.re), choose(c, z.im, w.im));
}

/// i z.
fn complex_mul_i(z: Complex) -> Complex {
    return Complex(real_neg(z.im), z.re);
}

/// -i z.
fn complex_div_i(z: Complex) -> Complex {
    return Complex(z.im, real_neg(z.re));
}

/// The exponent of the larger component, 2^e ≤ max(|x|, |y|) < 2^(e+1); 0 of a zero, an infinity or NaN.
fn complex_exponent(z: Complex) -> i32 {
    let a = real_max(real_abs(z.re), real_abs(z.im));
    if is_zero(a) || !is_finite(a) {
        return 0;
    }
    return exponent_of(a);
}

/// a b + c d. Where less than half of a b is left, the products are taken exactly, else plainly.
/// Error: 4 u.
fn cross_sum(a: real, b: real, c: real, d: real) -> real {
    let ab = real_mul(a, b);
    let sum = real_add(ab, real_mul(c, d));
    if real_less(twice(real_abs(sum)), real_abs(ab)) && is_finite(ab) {
        return sum_of_products(a, b, c, d);
    }
    return sum;
}

/// z w; an infinite factor gives an infinite product (C99 G.5.1). Error: 4 u each component, however much cancels.
fn complex_mul(z: Complex, w: Complex) -> Complex {
    let p = Complex(
        cross_sum(z.re, w.re, real_neg(z.im), w.im),
        cross_sum(z.re, w.im, z.im, w.re),
    );
    if complex_has_nan(p) {
        return complex_mul_special(z, w, p);
    }
    return p;
}

/// Infinite components become ±1, others ±0 (C99 G.5.1).
fn complex_box(z: Complex) -> Complex {
    return Complex(
        with_sign(choose(is_infinite(z.re), num(1.0), num(0.0)), z.re),
        with_sign(choose(is_infinite(z.im), num(1.0), num(0.0)), z.im),
    );
}

/// NaN components become 0.
fn complex_without_nan(z: Complex) -> Complex {
    return Complex(choose(is_nan(z.re), num(0.0), z.re), choose(is_nan(z.im), num(0.0), z.im));
}

fn complex_mul_special(z: Complex, w: Complex, plain: Complex) -> Complex {
    let infinite = complex_is_infinite(z) || complex_is_infinite(w);
    if !infinite && (complex_has_nan(z) || complex_has_nan(w)) {
        return plain;
    }
    if !infinite { // the products overflowed: in smaller numbers
        let e = complex_exponent(z);
        let f = complex_exponent(w);
        let c = complex_scale(z, -e);
        let d = complex_scale(w, -f);
        return Complex(
            scale(cross_sum(c.re, d.re, real_neg(c.im), d.im), e + f),
            scale(cross_sum(c.re, d.im, c.im, d.re), e + f),
        );
    }
    if !(is_nan(plain.re) && is_nan(plain.im)) {
        return plain;
    }
    var a = z;
    var b = w;
    if complex_is_infinite(a) {
        a = complex_box(a);
        b = complex_without_nan(b);
    }
    if complex_is_infinite(b) {
        b = complex_box(b);
        a = complex_without_nan(a);
    }
    a = complex_without_nan(a);
    b = complex_without_nan(b);
    a = complex_scale(a, -complex_exponent(a));
    b = complex_scale(b, -complex_exponent(b));
    let infinity = make_infinity(num(1.0));
    return Complex(
        real_mul(infinity, cross_sum(a.re, b.re, real_neg(a.im), b.im)),
        real_mul(infinity, cross_sum(a.re, b.im, a.im, b.re)),
    );
}

/// z² = (x - y)(x + y) + 2 i x y. Error: 3 u each component.
fn complex_square(z: Complex) -> Complex {
    let p = Complex(
        real_mul(real_sub(z.re, z.im), real_add(z.re, z.im)),
        twice(real_mul(z.re, z.im)),
    );
    if complex_has_nan(p) {
        return complex_mul(z, z);
    }
    return p;
}

/// z / w for |w| ≠ 0: both scaled by powers of two, special values after C99 G.5.1.
/// Error: 6 u each component.
fn complex_div(z: Complex, w: Complex) -> Complex {
    let ez = complex_exponent(z);
    let ew = complex_exponent(w);
    let a = complex_scale(z, 30 - ez);
    let b = complex_scale(w, 30 - ew);
    let norm = real_add(real_square(b.re), real_square(b.im));
    let q = Complex(
        real_div(cross_sum(a.re, b.re, a.im, b.im), norm),
        real_div(cross_sum(a.im, b.re, real_neg(a.re), b.im), norm),
    );
    if complex_has_nan(q) || is_zero(norm) {
        return complex_div_special(z, w);
    }
    return complex_scale(q, ez - ew);
}

fn complex_div_special(z: Complex, w: Complex) -> Complex {
    if complex_is_zero(w) {
        let infinity = make_infinity(w.re);
        return Complex(real_mul(infinity, z.re), real_mul(infinity, z.im));
    }
    if complex_is_infinite(z) && complex_is_finite(w) {
        let a = complex_box(z);
        let b = complex_scale(w, -complex_exponent(w));
        let infinity = make_infinity(num(1.0));
        return Complex(
            real_mul(infinity, real_add(real_mul(a.re, b.re), real_mul(a.im, b.im))),
            real_mul(infinity, real_sub(real_mul(a.im, b.re), real_mul(a.re, b.im))),
        );
    }
    if complex_is_infinite(w) && complex_is_finite(z) {
        let b = complex_box(w);
        return Complex(
            signed_zero(real_add(real_mul(z.re, b.re), real_mul(z.im, b.im))),
            signed_zero(real_sub(real_mul(z.im, b.re), real_mul(z.re, b.im))),
        );
    }
    return complex_nan(z.re);
}

/// 1 / z = z̄ / |z|², of z scaled by a power of two: below the real axis for +0, which the quotient 1 / z loses.
/// Error: 4 u each component.
fn complex_inverse(z: Complex) -> Complex {
    if complex_is_infinite(z) {
        return Complex(signed_zero(z.re), signed_zero(real_neg(z.im)));
    }
    if complex_is_zero(z) || complex_has_nan(z) {
        return complex_div_special(complex_of_real(num(1.0)), z);
    }
    let n = 30 - complex_exponent(z);
    let a = complex_scale(z, n);
    let norm = real_add(real_square(a.re), real_square(a.im));
    return complex_scale(Complex(real_div(a.re, norm), real_div(real_neg(a.im), norm)), n);
}

/// |z| without spurious overflow.
/// Error: that of `real_hypot`.
fn complex_abs(z: Complex) -> real {
    return real_hypot(z.re, z.im);
}

/// The phase in [-π, π].
/// Error: that of `real_atan2`.
fn complex_arg(z: Complex) -> real {
    return real_atan2(z.im, z.re);
}

/// A number as value 2^exponent.
struct Scaled {
    value: real,
    exponent: i32,
}

/// log 2 to 120 bits.
fn long_log2() -> Long {
    return long_lit(0.6931472, -1.9046542e-09, -8.783184e-17, 3.0618407e-24, -2.510717e-33);
}

/// A constant as the sum of five f32.
fn long_lit(a: f32, b: f32, c: f32, d: f32, e: f32) -> Long {
    return long_sum(lit(a, b, 0.0), lit(c, d, e));
}

fn long_neg(a: Long) -> Long {
    return Long(real_neg(a.hi), real_neg(a.lo));
}

/// e^x of a long x as value 2^exponent with the value in [0.7, 1.42], so that products with it overflow only where
/// they must. Beyond ±3000 as there.
fn exp_apart(x: Long) -> Scaled {
    let size = real_to_f32(x.hi);
    let n = i32(floor(clamp(size, -3000.0, 3000.0) * 1.442695 + 0.5));
    if abs(size) > 3000.0 {
        return Scaled(num(1.0), n);
    }
    let rest = long_add(x, long_mul(long_neg(long_log2()), real_from_i32(n)));
    return Scaled(real_exp(long_to_real(rest)), n);
}

/// e^z; e^x may overflow where e^x cos y does not.
/// Error: 6 u each component.
fn complex_exp(z: Complex) -> Complex {
    if is_zero(z.im) {
        return Complex(real_exp(z.re), z.im);
    }
    if !complex_is_finite(z) {
        return complex_exp_special(z);
    }
    let wave = real_sincos(z.im);
    let r = real_exp(z.re);
    if is_infinite(r) || is_zero(r) {
        let s = exp_apart(Long(z.re, num(0.0)));
        return Complex(
            scale(real_mul(s.value, wave.second), s.exponent),
            scale(real_mul(s.value, wave.first), s.exponent),
        );
    }
    return Complex(real_mul(r, wave.second), real_mul(r, wave.first));
}

fn complex_exp_special(z: Complex) -> Complex {
    if is_infinite(z.re) && sign_is_set(z.re) {
        if !is_finite(z.im) {
            return complex_of_real(num(0.0));
        }
        let wave = real_sincos(z.im);
        return Complex(signed_zero(wave.second), signed_zero(wave.first));
    }
    if is_infinite(z.re) {
        if !is_finite(z.im) {
            return Complex(z.re, make_nan(z.im));
        }
        let wave = real_sincos(z.im);
        return Complex(make_infinity(wave.second), make_infinity(wave.first));
    }
    return complex_nan(z.re);
}

/// log z, cut along the negative axis. The real part keeps its relative accuracy near |z| = 1.
/// Error: 6 u each component.
fn complex_log(z: Complex) -> Complex {
    return Complex(log_hypot(z.re, z.im), real_atan2(z.im, z.re));
}

/// log √(x² + y²). Near the unit circle x² + y² - 1 = 2 d + d² + y² with the exact d = x - 1, summed without loss
/// (Kahan 1987; Hull, Fairgrieve, Tang 1994).
fn log_hypot(x: real, y: real) -> real {
    if is_infinite(x) || is_infinite(y) {
        return make_infinity(num(1.0));
    }
    if is_nan(x) || is_nan(y) {
        return make_nan(x);
    }
    let a = real_max(real_abs(x), real_abs(y));
    let b = real_min(real_abs(x), real_abs(y));
    if is_zero(a) {
        return make_infinity(num(-1.0));
    }
    if is_above(a, 0.5) && is_below(a, 1.5) {
        let norm = real_add(real_square(a), real_square(b));
        if is_above(norm, 0.5) && is_below(norm, 2.0) {
            let d = real_sub(a, num(1.0));
            let dd = long_product(d, d);
            let bb = long_product(b, b);
            let s = long_sum(twice(d), bb.hi);
            let t = long_sum(s.hi, dd.hi);
            let low = long_add(long_sum(s.lo, t.lo), long_sum(dd.lo, bb.lo));
            return mul32(real_log1p(long_to_real(long_add_real(low, t.hi))), 0.5);
        }
    }
    let e = exponent_of(a);
    let v = scale(a, -e);
    let w = scale(b, -e);
    let l = mul32(real_log(real_add(real_square(v), real_square(w))), 0.5);
    return real_add(mul32(lit(0.6931472, -1.9046542e-09, -8.783184e-17), f32(e)), l);
}

/// The root with positive real part, cut along the negative axis (Kahan 1987; C99 G.6.4.2).
/// Error: 5 u each component.
fn complex_sqrt(z: Complex) -> Complex {
    if is_infinite(z.im) {
        return Complex(make_infinity(num(1.0)), z.im);
    }
    if is_nan(z.re) {
        return complex_nan(z.re);
    }
    if is_infinite(z.re) {
        let other = choose(is_nan(z.im), make_nan(z.im), signed_zero(z.im));
        if sign_is_set(z.re) {
            return Complex(real_abs(other), make_infinity(z.im));
        }
        return Complex(z.re, other);
    }
    if is_nan(z.im) {
        return complex_nan(z.im);
    }
    if complex_is_zero(z) {
        return Complex(num(0.0), z.im);
    }
    let half = complex_exponent(z) >> 1u; // an even power of two comes out of the root exactly
    let a = scale(real_abs(z.re), -2 * half);
    let b = scale(real_abs(z.im), -2 * half);
    let r = real_sqrt(real_add(real_square(a), real_square(b)));
    let t = scale(real_sqrt(mul32(real_add(a, r), 0.5)), half);
    let u = real_div(mul32(real_abs(z.im), 0.5), t); // not of the scaled one, which may have underflowed
    let left = sign_is_set(z.re);
    return Complex(choose(left, u, t), with_sign(choose(left, t, u), z.im));
}

/// e^z - 1 = expm1 x cos y - 2 sin²(y/2) + i e^x sin y: the real part has its own digits but where both of its terms have
/// lost them.
fn complex_expm1(z: Complex) -> Complex {
    if !is_finite(z.re) || !is_finite(z.im) || is_above(z.re, 40.0) {
        let e = complex_exp(z);
        return Complex(add32(e.re, -1.0), e.im);
    }
    if is_zero(z.im) {
        return Complex(real_expm1(z.re), z.im);
    }
    let wave = real_sincos(z.im);
    let half = real_sin(scale(z.im, -1));
    let down = scale(half, 1);
    let re = sum_of_products(real_expm1(z.re), wave.second, real_neg(down), half);
    let im = with_sign(real_mul(real_exp(z.re), wave.first), wave.first);
    return Complex(choose(is_zero(z.re), real_neg(real_mul(down, half)), re), im);
}

/// log(1 + z), cut along the negative axis left of -1; the real part is half of log1p(2x + x² + y²), summed in long
/// numbers.
fn complex_log1p(z: Complex) -> Complex {
    if is_zero(z.im) && is_above(z.re, -0.5) {
        return Complex(real_log1p(z.re), z.im);
    }
    if !(is_below(real_abs(z.re), 0.5) && is_below(real_abs(z.im), 0.5)) {
        return complex_log(Complex(add32(z.re, 1.0), z.im));
    }
    let squares = long_add(long_product(z.re, z.re), long_product(z.im, z.im));
    let size = long_to_real(long_add_real(squares, scale(z.re, 1)));
    return Complex(scale(real_log1p(size), -1), real_atan2(z.im, add32(z.re, 1.0)));
}
