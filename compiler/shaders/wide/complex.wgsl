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

/// z w, or what is left of it where terms cancel.
fn plain_product(z: Complex, w: Complex) -> Complex {
    return Complex(
        real_sub(real_mul(z.re, w.re), real_mul(z.im, w.im)),
        real_add(real_mul(z.re, w.im), real_mul(z.im, w.re)),
    );
}

/// Whether less than half of the terms of a component of z w = p is left.
fn product_cancels(z: Complex, w: Complex, p: Complex) -> bool {
    return real_less(twice(real_abs(p.re)), real_abs(real_mul(z.re, w.re)))
        || real_less(twice(real_abs(p.im)), real_abs(real_mul(z.re, w.im)));
}

/// z w with about one rounding each component, however much cancels. One component after the other: shader compilers
/// inline the sum, which is long, wherever it is written.
fn exact_product(z: Complex, w: Complex) -> Complex {
    var p = z;
    for (var k = 0u; k < 2u; k++) {
        let across = k == 1u;
        let v = choose(across, z.im, real_neg(z.im));
        let part = sum_of_products(z.re, choose(across, w.im, w.re), v, choose(across, w.re, w.im), num(0.0));
        p = Complex(choose(across, p.re, part), part);
    }
    return p;
}

/// z w; an infinite factor gives an infinite product (C99 G.5.1). Error: 4 u each component, however much cancels.
fn complex_mul(z: Complex, w: Complex) -> Complex {
    let p = plain_product(z, w);
    let lost = complex_has_nan(p);
    if !lost && !product_cancels(z, w, p) {
        return p;
    }
    var a = z;
    var b = w;
    var e = 0;
    let infinite = complex_is_infinite(z) || complex_is_infinite(w);
    if lost {
        if infinite && !(is_nan(p.re) && is_nan(p.im)) || !infinite && (complex_has_nan(z) || complex_has_nan(w)) {
            return p;
        }
        if infinite {
            a = complex_boxed(z);
            b = complex_boxed(w);
        }
        // in smaller numbers, whose products do not overflow
        let f = complex_exponent(a);
        let g = complex_exponent(b);
        a = complex_scale(a, -f);
        b = complex_scale(b, -g);
        e = f + g;
    }
    let q = exact_product(a, b);
    if infinite {
        return complex_mul_real(q, make_infinity(num(1.0)));
    }
    return complex_scale(q, e);
}

/// Infinite components become ±1, others ±0 (C99 G.5.1).
fn complex_box(z: Complex) -> Complex {
    return Complex(
        with_sign(choose(is_infinite(z.re), num(1.0), num(0.0)), z.re),
        with_sign(choose(is_infinite(z.im), num(1.0), num(0.0)), z.im),
    );
}

/// z as a factor of a product with an infinite one: without NaN, and boxed if it is infinite itself.
fn complex_boxed(z: Complex) -> Complex {
    let v = complex_choose(complex_is_infinite(z), complex_box(z), z);
    return Complex(choose(is_nan(v.re), num(0.0), v.re), choose(is_nan(v.im), num(0.0), v.im));
}

/// z² = (x - y)(x + y) + 2 i x y, of halves, whose sums do not overflow. Error: 3 u each component.
fn complex_square(z: Complex) -> Complex {
    let x = scale(z.re, -1);
    let y = scale(z.im, -1);
    let re = scale(real_mul(real_sub(x, y), real_add(x, y)), 2);
    let im = twice(real_mul(z.re, z.im));
    if is_nan(re) && is_nan(im) && complex_is_infinite(z) { // ∞ + i NaN
        return Complex(make_infinity(num(select(-1.0, 1.0, is_infinite(z.re)))), im);
    }
    return Complex(re, im);
}

/// z / w for |w| ≠ 0: both scaled by powers of two, special values after C99 G.5.1.
/// Error: 6 u each component.
fn complex_div(z: Complex, w: Complex) -> Complex {
    let ez = complex_exponent(z);
    let ew = complex_exponent(w);
    let a = complex_scale(z, 30 - ez);
    let b = complex_conj(complex_scale(w, 30 - ew));
    // of |w| about 1, so that a small component of the quotient keeps its digits
    let norm = scale(real_add(real_square(b.re), real_square(b.im)), -60);
    var p = plain_product(a, b);
    if complex_has_nan(p) || is_zero(norm) {
        return complex_div_special(z, w);
    }
    if product_cancels(a, b, p) {
        p = exact_product(a, b);
    }
    return complex_scale(Complex(real_div(p.re, norm), real_div(p.im, norm)), ez - ew - 60);
}

fn complex_div_special(z: Complex, w: Complex) -> Complex {
    if complex_is_zero(w) {
        return complex_mul_real(z, make_infinity(w.re));
    }
    let far = complex_is_infinite(w);
    if complex_is_finite(z) == complex_is_finite(w) || !(far || complex_is_infinite(z)) {
        return complex_nan(z.re);
    }
    // the quotient of an infinity is infinite, that by an infinity 0
    let a = complex_choose(far, z, complex_box(z));
    let b = complex_choose(far, complex_box(w), complex_scale(w, -complex_exponent(w)));
    let p = plain_product(a, complex_conj(b));
    return Complex(
        choose(far, signed_zero(p.re), real_mul(make_infinity(num(1.0)), p.re)),
        choose(far, signed_zero(p.im), real_mul(make_infinity(num(1.0)), p.im)),
    );
}

/// 1 / z of z scaled by a power of two: with r = y/x, |r| ≤ 1, it is (1 - i r) / (x + y r), in which nothing cancels (R. L.
/// Smith, CACM 5, 1962). Below the real axis for +0, which the quotient 1 / z loses.
/// Error: 3 u each component.
fn complex_inverse(z: Complex) -> Complex {
    if complex_is_infinite(z) {
        return Complex(signed_zero(z.re), signed_zero(real_neg(z.im)));
    }
    if complex_is_zero(z) {
        return Complex(make_infinity(z.re), make_nan(z.im));
    }
    let e = complex_exponent(z);
    let steep = real_less(real_abs(z.re), real_abs(z.im));
    let large = scale(choose(steep, z.im, z.re), -e);
    let small = choose(steep, z.re, z.im);
    // 2^40 times too large, so that a small component keeps its digits
    let r = real_div(scale(small, 40 - e), large);
    let d = real_add(large, real_mul(scale(small, -e), scale(r, -40)));
    let along = scale(real_div(num(1.0), d), -e);
    let across = scale(real_div(r, d), -40 - e);
    return Complex(choose(steep, across, along), real_neg(choose(steep, along, across)));
}

/// 1 / z² = 1 / (z²) of z scaled by a power of two: the square has accurate components, and nothing cancels in its inverse.
/// Error: 8 u each component.
fn complex_inverse_square(z: Complex) -> Complex {
    if complex_is_infinite(z) {
        return complex_of_real(num(0.0));
    }
    let e = complex_exponent(z);
    return complex_scale(complex_inverse(complex_square(complex_scale(z, -e))), -2 * e);
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

/// log 2 to 120 bits.
fn long_log2() -> Long {
    return long_lit(0.6931472, -1.9046542e-09, -8.783184e-17, 3.0618407e-24, -2.510717e-33);
}

/// A constant as the sum of five f32, each the nearest to what is left, so that the first two are one f64, too. Nothing is
/// summed exactly here: what is made of constants alone cannot be hidden, and shader compilers simplify it.
fn long_lit(a: f32, b: f32, c: f32, d: f32, e: f32) -> Long {
    return Long(lit(a, b, 0.0), lit(c, d, e));
}

fn long_neg(a: Long) -> Long {
    return Long(real_neg(a.hi), real_neg(a.lo));
}

/// e^z; e^x may overflow where e^x cos y does not.
/// Error: 6 u each component.
fn complex_exp(z: Complex) -> Complex {
    let wave = real_sincos(z.im);
    let bounded = is_finite(z.im);
    if is_nan(z.re) || !bounded && is_finite(z.re) {
        return Complex(make_nan(z.re), choose(is_zero(z.im), z.im, make_nan(z.im)));
    }
    if !bounded { // e^-∞ is 0, e^∞ infinite
        let fades = sign_is_set(z.re);
        return Complex(choose(fades, num(0.0), z.re), choose(fades, num(0.0), make_nan(z.im)));
    }
    let s = exp_of_parts(z.re);
    let size = scale(s.value, 60); // so that a small part keeps its digits
    let im = scale(real_mul(size, wave.first), s.exponent - 60);
    return Complex(scale(real_mul(size, wave.second), s.exponent - 60), choose(is_zero(z.im), z.im, im));
}

/// log z, cut along the negative axis. The real part keeps its relative accuracy near |z| = 1.
/// Error: 6 u each component.
fn complex_log(z: Complex) -> Complex {
    return Complex(log_hypot(z.re, z.im), real_atan2(z.im, z.re));
}

/// log √(x² + y²). Near the unit circle x² + y² - 1 = 2 d + d² + y² with the exact d = x - 1, summed without loss
/// (Kahan 1987; Hull, Fairgrieve, Tang 1994).
fn log_hypot(x: real, y: real) -> real {
    let a = real_max(real_abs(x), real_abs(y));
    let b = real_min(real_abs(x), real_abs(y));
    if is_nan(x) || is_nan(y) {
        return choose(is_infinite(a), a, make_nan(x));
    }
    return log_of_sides(a, b, add32(a, -1.0), is_near_circle(a, b));
}

/// Whether log √(a² + b²) cancels.
fn is_near_circle(a: real, b: real) -> bool {
    let norm = real_add(real_square(a), real_square(b));
    return is_above(a, 0.5) && is_below(a, 1.5) && is_above(norm, 0.5) && is_below(norm, 2.0);
}

/// log √(a² + b²) for a ≥ b ≥ 0; where it is near, a = 1 + d without error.
fn log_of_sides(a: real, b: real, d: real, near: bool) -> real {
    if is_infinite(a) {
        return a;
    }
    if is_zero(a) {
        return make_infinity(num(-1.0));
    }
    var e = 0; // a² + b² = 4^e size
    var t = num(0.0);
    var size = num(1.0);
    if near {
        t = sum_of_products(d, d, b, b, twice(d));
        size = add32(t, 1.0);
    } else {
        e = exponent_of(a);
        size = real_add(real_square(scale(a, -e)), real_square(scale(b, -e)));
    }
    let split = split_logarithm(size);
    let f = choose(near, split_beside_one(t, split.exponent), split.fraction);
    return scale(log_of_split(split.exponent + 2 * e, f), -1);
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
    let root = real_sqrt(mul32(real_add(a, r), 0.5));
    let t = scale(root, half);
    // the numerator 2^79 times too large, so that a small component keeps its digits
    let u = scale(real_div(scale(real_abs(z.im), 79 - 2 * half), root), half - 80);
    let left = sign_is_set(z.re);
    return Complex(choose(left, u, t), with_sign(choose(left, t, u), z.im));
}

/// e^z - 1 = expm1 x cos y - (1 - cos y) + i e^x sin y: the real part has its own digits but where both of its terms have
/// lost them.
fn complex_expm1(z: Complex) -> Complex {
    let flat = is_zero(z.im);
    if is_nan(z.re) || !is_finite(z.im) {
        let known = is_infinite(z.re); // as of e^z: -1 or infinite
        let re = choose(sign_is_set(z.re), num(-1.0), z.re);
        let im = choose(known && sign_is_set(z.re), num(0.0), make_nan(z.im));
        return Complex(choose(known, re, make_nan(z.re)), choose(flat, z.im, im));
    }
    let wave = real_sincos(z.im);
    let s = split_exponent(clamped(z.re, EXP_END));
    let v = expm1_polynomial(s.rest);
    if s.count > 60 {
        let e = add32(v, 1.0);
        return Complex(
            scale(real_mul(e, wave.second), s.count),
            choose(flat, z.im, scale(real_mul(e, wave.first), s.count)),
        );
    }
    let growth = choose(is_below(real_abs(z.re), 1e-17), z.re, expm1_of_parts(v, s.count));
    // 1 - cos y = sin² y / (1 + cos y)
    let right = is_above(wave.second, 0.0);
    let down = choose(
        right,
        real_div(real_square(wave.first), add32(choose(right, wave.second, num(0.0)), 1.0)),
        add32(real_neg(wave.second), 1.0),
    );
    let re = sum_of_products(growth, wave.second, real_neg(down), num(1.0), num(0.0));
    let im = scale(real_mul(add32(v, 1.0), wave.first), s.count);
    return Complex(choose(flat, growth, choose(is_zero(z.re), real_neg(down), re)), choose(flat, z.im, im));
}

/// log(1 + z), cut along the negative axis left of -1. Right of -1/2, where 1 + z is rounded, the modulus is that of the
/// exact sum.
fn complex_log1p(z: Complex) -> Complex {
    let x = add32(z.re, 1.0);
    let size = real_abs(x);
    let y = real_abs(z.im);
    let right = is_above(z.re, -0.5) && is_below(z.re, 2.0) && is_below(y, 2.0);
    let a = real_max(size, y);
    let b = real_min(size, y);
    if is_nan(z.re) || is_nan(z.im) {
        return Complex(choose(is_infinite(a), a, make_nan(x)), make_nan(x));
    }
    let modulus = log_of_sides(
        choose(right, num(1.0), a),
        choose(right, y, b),
        choose(right, z.re, add32(a, -1.0)),
        right || is_near_circle(a, b),
    );
    return Complex(choose(complex_is_zero(z), z.re, modulus), real_atan2(z.im, x));
}
