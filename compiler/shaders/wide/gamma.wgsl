// The gamma function and its logarithmic derivatives of a real argument: Stirling's series from 10 on (DLMF 5.11.1-2),
// the recurrence to get there (DLMF 5.5.1-2), reflection left of 0 (DLMF 5.5.3-4). Constants are those of special.py.

/// x ≥ 0 less the nearest integer, exactly, and whether that is odd.
struct Fraction {
    part: real,
    odd: bool,
}

/// x + 1/2 may round, so the integer below comes first.
fn nearest_fraction(x: real) -> Fraction {
    let below = real_floor(x);
    let rest = real_sub(x, below);
    let up = real_less(num(0.5), rest);
    let half = mul32(below, 0.5);
    return Fraction(choose(up, add32(rest, -1.0), rest), real_not_equal(half, real_floor(half)) != up);
}

/// (sin πx, cos πx) of a finite x, reduced exactly.
fn sincos_pi(x: real) -> RealPair {
    let n = nearest_fraction(real_abs(x));
    let g = real_abs(n.part);
    let outer = is_above(g, 0.25);
    let angle = real_mul(choose(outer, real_sub(num(0.5), g), g), real_pi()); // up to π/4: nothing to reduce
    let wave = RealPair(sin_near(angle, num(0.0)), cos_near(angle, num(0.0)));
    return RealPair(
        flip_if(choose(outer, wave.second, wave.first), (n.odd != sign_is_set(x)) != sign_is_set(n.part)),
        flip_if(choose(outer, wave.first, wave.second), n.odd),
    );
}

fn real_pi() -> real {
    return lit(3.1415927, -8.742278e-08, -3.430249e-15);
}

/// Whether Γ has a pole at x.
fn is_gamma_pole(x: real) -> bool {
    return (sign_is_set(x) || is_zero(x)) && is_finite(x) && real_equal(real_floor(x), x);
}

/// B(2k + 2) / ((2k + 1)(2k + 2)), k = 0 … 9 (DLMF 5.11.1).
fn stirling_coefficient(k: i32) -> real {
    switch k {
        case 0: { return lit(0.083333336, -2.483527e-09, 7.401487e-17); }
        case 1: { return lit(-0.0027777778, 6.726219e-11, -2.9297552e-18); }
        case 2: { return lit(0.0007936508, -1.09023875e-11, 2.1752883e-19); }
        case 3: { return lit(-0.0005952381, 2.2728706e-11, -3.7998705e-19); }
        case 4: { return lit(0.0008417508, 2.0186495e-11, 3.6213083e-19); }
        case 5: { return lit(-0.0019175269, 2.3288232e-11, 7.572783e-19); }
        case 6: { return lit(0.0064102565, -8.358023e-11, 1.957124e-18); }
        case 7: { return lit(-0.029550653, -6.437691e-10, -2.72694e-17); }
        case 8: { return lit(0.17964438, -3.6706744e-09, -6.4016004e-19); }
        case 9: { return lit(-1.3924322, -4.0763113e-09, 1.5837058e-17); }
        default: { return num(0.0); }
    }
}

/// B(2k + 2) / (2k + 2), k = 0 … 9 (DLMF 5.11.2).
fn digamma_coefficient(k: i32) -> real {
    switch k {
        case 0: { return lit(0.083333336, -2.483527e-09, 7.401487e-17); }
        case 1: { return lit(-0.008333334, 4.346172e-10, -1.8503718e-18); }
        case 2: { return lit(0.003968254, -2.2913492e-10, 2.2028236e-19); }
        case 3: { return lit(-0.004166667, 2.173086e-10, -9.251859e-19); }
        case 4: { return lit(0.007575758, -2.2577518e-10, 6.7286246e-18); }
        case 5: { return lit(-0.021092797, 6.0541655e-10, -1.9425514e-17); }
        case 6: { return lit(0.083333336, -2.483527e-09, 7.401487e-17); }
        case 7: { return lit(-0.4432598, 1.5193341e-09, -2.0462935e-17); }
        case 8: { return lit(3.0539544, -3.2599143e-08, -1.0882721e-17); }
        case 9: { return lit(-26.456213, 8.762244e-07, -1.7018576e-14); }
        default: { return num(0.0); }
    }
}

/// B(2k + 2), k = 0 … 9 (DLMF 24.2).
fn bernoulli_number(k: i32) -> real {
    switch k {
        case 0: { return lit(0.16666667, -4.967054e-09, 1.4802974e-16); }
        case 1: { return lit(-0.033333335, 1.7384688e-09, -7.401487e-18); }
        case 2: { return lit(0.023809524, -4.4348694e-10, 1.3216941e-18); }
        case 3: { return lit(-0.033333335, 1.7384688e-09, -7.401487e-18); }
        case 4: { return lit(0.07575758, -2.2577518e-09, 6.7286246e-17); }
        case 5: { return lit(-0.25311357, 1.4715579e-08, -1.1061563e-17); }
        case 6: { return lit(1.1666666, 3.973643e-08, -1.1842379e-15); }
        case 7: { return lit(-7.092157, 2.4309346e-08, -3.2740695e-16); }
        case 8: { return lit(54.971176, 1.7974012e-06, 3.533125e-14); }
        case 9: { return lit(-529.12427, 2.5153882e-05, 3.4174952e-13); }
        default: { return num(0.0); }
    }
}

/// log Γ(x) - (x - 1/2) log x + x - log(2π)/2 for x ≥ 10.
fn stirling_series(x: real) -> real {
    let r = real_div(num(1.0), x);
    let w = real_square(r);
    var sum = stirling_coefficient(9);
    for (var k = 8; k >= 0; k--) {
        sum = real_add(stirling_coefficient(k), real_mul(w, sum));
    }
    return real_mul(r, sum);
}

/// log(2π)/2 to 120 bits.
fn long_half_log_tau() -> Long {
    return long_lit(0.9189385, 1.5634177e-08, 5.163286e-16, -2.8434174e-24, 4.839004e-33);
}

/// x (x + 1) … (x + count - 1) for a short x ≥ 0, and so for x > 0 with all its digits.
fn rising_product(x: real, count: i32) -> Long {
    var product = Long(num(1.0), num(0.0));
    for (var k = 0; k < count; k++) {
        product = long_times(product, long_sum(x, num(f32(k))));
    }
    return product;
}

/// The steps from x ≥ 0 up to 10.
fn steps_to_ten(x: real) -> i32 {
    return select(i32(ceil(10.0 - real_to_f32(x))), 0, is_above(x, 10.0));
}

/// Γ(x) for x > 0: Stirling's series in long numbers.
fn gamma_of_positive(x: real) -> Scaled {
    if is_above(x, 1000.0) {
        return Scaled(num(1.0), 3000);
    }
    let steps = steps_to_ten(x);
    let top = long_sum(x, num(f32(steps)));
    // (t - 1/2) log t - t + log(2π)/2 + series, t = top
    let logarithm = long_log(top.hi);
    let power = long_add_real(top, num(-0.5));
    var size = long_add(long_times(logarithm, power), long_neg(top));
    size = long_add(size, long_half_log_tau());
    // log t is log hi + lo / hi, and (t - 1/2) lo / hi is lo to working precision but for -lo / (2 hi)
    let low = real_sub(top.lo, mul32(real_div(top.lo, top.hi), 0.5));
    size = long_add_real(size, real_add(stirling_series(top.hi), low));
    let s = exp_apart(size);
    if steps == 0 {
        return s;
    }
    return Scaled(real_div(s.value, long_to_real(rising_product(x, steps))), s.exponent);
}

/// A value that needs no series, where it is known.
struct Known {
    value: real,
    is_known: bool,
}

/// Γ at its poles, beside 0, at infinity and at integers below 20.
fn known_gamma(x: real) -> Known {
    let y = real_abs(x);
    if is_below(y, 1e-17) {
        return Known(choose(is_zero(x), make_infinity(x), real_div(num(1.0), x)), true);
    }
    if is_gamma_pole(x) || !is_finite(x) {
        return Known(choose(sign_is_set(x) || is_nan(x), make_nan(x), x), true);
    }
    if is_below(y, 20.0) && real_equal(real_floor(y), y) {
        var product = num(1.0);
        for (var k = 2; k < i32(real_to_f32(y)); k++) {
            product = mul32(product, f32(k));
        }
        return Known(product, true);
    }
    return Known(x, false);
}

/// Γ(x); NaN at the negative integers, ±∞ at ±0. Left of 0 by Γ(-y) = -π / (y sin πy Γ(y)). Exact where it is an
/// integer of at most 48 bits.
/// Error: 12 u.
fn real_gamma(x: real) -> real {
    let known = known_gamma(x);
    if known.is_known {
        return known.value;
    }
    let y = real_abs(x);
    let s = gamma_of_positive(y);
    if !sign_is_set(x) {
        return scale(s.value, s.exponent);
    }
    let wave = sincos_pi(y).first;
    if is_above(y, 1000.0) {
        return flip_if(num(0.0), !sign_is_set(wave));
    }
    return scale(real_neg(real_div(real_pi(), real_mul(y, real_mul(wave, s.value)))), -s.exponent);
}

/// 1 - γ, then (-1)^k (ζ(k) - 1)/k, k = 2 … 29 (DLMF 5.7.3).
fn lgamma_coefficient(k: i32) -> real {
    switch k {
        case 0: { return lit(0.42278433, 6.637774e-09, -1.0607939e-16); }
        case 1: { return lit(0.32246703, 4.3294173e-09, -9.581894e-17); }
        case 2: { return lit(-0.0673523, 1.3192575e-09, 2.0754464e-17); }
        case 3: { return lit(0.020580808, 7.270313e-10, 1.187128e-17); }
        case 4: { return lit(-0.007385551, -3.052268e-11, -1.3242098e-18); }
        case 5: { return lit(0.0028905103, 7.899594e-11, -7.35795e-20); }
        case 6: { return lit(-0.0011927539, -9.998115e-12, 4.174785e-20); }
        case 7: { return lit(0.00050966954, -1.3844289e-11, 8.0616674e-20); }
        case 8: { return lit(-0.00022315476, -3.377186e-12, 6.032078e-21); }
        case 9: { return lit(9.945751e-05, 3.431777e-12, -7.8580904e-20); }
        case 10: { return lit(-4.4926237e-05, 2.8576805e-13, 7.122042e-21); }
        case 11: { return lit(2.0507212e-05, 8.1866024e-13, 7.262681e-21); }
        case 12: { return lit(-9.439488e-06, -1.0815058e-13, 2.5052645e-21); }
        case 13: { return lit(4.374867e-06, -8.5970585e-14, 3.0179133e-21); }
        case 14: { return lit(-2.0392158e-06, 6.107384e-14, -4.706056e-22); }
        case 15: { return lit(9.551412e-07, -4.63263e-15, -1.6377312e-22); }
        case 16: { return lit(-4.4924693e-07, 6.005651e-15, 6.71589e-23); }
        case 17: { return lit(2.1207185e-07, -5.3559973e-15, -6.716615e-23); }
        case 18: { return lit(-1.00432246e-07, -2.6086262e-15, -9.7890955e-23); }
        case 19: { return lit(4.76981e-08, 2.250991e-16, -4.9427098e-24); }
        case 20: { return lit(-2.2711095e-08, 6.177253e-16, 1.1828824e-23); }
        case 21: { return lit(1.0838659e-08, 3.555835e-16, -5.464908e-24); }
        case 22: { return lit(-5.183475e-09, -5.939706e-17, 2.4706506e-24); }
        case 23: { return lit(2.4836746e-09, -5.551594e-17, 1.0827205e-24); }
        case 24: { return lit(-1.1921402e-09, 2.3777217e-17, 3.6089169e-25); }
        case 25: { return lit(5.731367e-10, 1.9405553e-17, -4.374012e-25); }
        case 26: { return lit(-2.759523e-10, 2.8497533e-19, -4.7768155e-27); }
        case 27: { return lit(1.3304764e-10, 1.3946616e-18, 6.614615e-27); }
        case 28: { return lit(-6.422964e-11, -3.2003626e-18, 4.746661e-26); }
        default: { return num(0.0); }
    }
}

/// log Γ(2 + t) for |t| ≤ 1/2.
fn lgamma_beside_two(t: real) -> real {
    var sum = lgamma_coefficient(28);
    for (var k = 27; k >= 0; k--) {
        sum = real_add(lgamma_coefficient(k), real_mul(t, sum));
    }
    return real_mul(t, sum);
}

/// For 1/2 < x < 5/2 by the series beside 2, below from Γ(x) = Γ(x + 2) / (x (x + 1)).
fn lgamma_of_positive(x: real) -> real {
    if is_above(x, 10.0) {
        let sum = real_add(long_half_log_tau().hi, add32(stirling_series(x), -0.5));
        return real_add(real_mul(add32(x, -0.5), add32(real_log(x), -1.0)), sum);
    }
    if is_above(x, 2.5) {
        let s = gamma_of_positive(x);
        return real_log(scale(s.value, s.exponent));
    }
    let steps = select(select(2.0, 1.0, is_above(x, 0.5)), 0.0, is_above(x, 1.5));
    let near = lgamma_beside_two(add32(x, steps - 2.0));
    let t = add32(x, steps - 2.0);
    let down = choose(steps > 0.0, real_log1p(t), num(0.0));
    let r = choose(is_zero(t), num(0.0), real_sub(near, down));
    return choose(steps > 1.0, real_sub(r, real_log(x)), r);
}

/// log |Γ(x)|: ∞ at the poles. Relative accuracy near its zeros at 1 and 2; at those left of 0 absolute.
/// Error: 20 u for x > 0; left of 0 of max(|result|, 1, log Γ(-x)).
fn real_lgamma(x: real) -> real {
    if is_nan(x) {
        return x;
    }
    if is_gamma_pole(x) || is_infinite(x) {
        return make_infinity(num(1.0));
    }
    let y = real_abs(x);
    if is_below(y, 1e-9) { // -log |x| - γ x + O(x²), DLMF 5.7.3
        return real_neg(real_add(real_log(y), real_mul(x, lit(0.5772157, -6.637774e-09, 1.0607939e-16))));
    }
    let r = lgamma_of_positive(y);
    if !sign_is_set(x) {
        return r;
    }
    let wave = real_abs(sincos_pi(y).first);
    return real_neg(real_add(real_log(real_mul(real_div(wave, real_pi()), y)), r));
}

/// Taylor coefficients of ψ about its positive zero, from the linear one.
fn digamma_taylor(k: i32) -> real {
    switch k {
        case 0: { return lit(0.9676722, 1.663445e-08, -4.7796793e-16); }
        case 1: { return lit(-0.44276318, 1.0557042e-08, -3.0224174e-16); }
        case 2: { return lit(0.25849977, -1.0400932e-08, 4.050654e-17); }
        case 3: { return lit(-0.16394271, 4.122756e-09, 2.1674971e-16); }
        case 4: { return lit(0.10782405, 8.0122103e-10, -1.9524804e-17); }
        case 5: { return lit(-0.07219956, -5.5460764e-10, 3.082746e-18); }
        case 6: { return lit(0.048804287, 1.2967629e-09, 4.5745897e-17); }
        case 7: { return lit(-0.033161126, -3.9767223e-10, 9.569018e-18); }
        case 8: { return lit(0.022597648, 2.8845148e-11, 8.453632e-19); }
        case 9: { return lit(-0.015424766, -2.5849128e-10, -3.0864776e-18); }
        case 10: { return lit(0.010538791, 3.1029532e-10, 5.600054e-18); }
        case 11: { return lit(-0.0072045345, 9.9579296e-11, 4.1723727e-19); }
        case 12: { return lit(0.004926781, 2.2565969e-10, -3.292087e-18); }
        case 13: { return lit(-0.0033698017, 2.2324134e-11, 1.2291719e-19); }
        case 14: { return lit(0.0023051263, 4.3417124e-11, -5.6224857e-19); }
        case 15: { return lit(-0.0015769368, 3.2327946e-11, 1.2435704e-18); }
        case 16: { return lit(0.0010788252, -9.236138e-12, 1.2779436e-19); }
        case 17: { return lit(-0.0007380709, -1.05043535e-11, 3.4575276e-19); }
        case 18: { return lit(0.00050495326, 2.972784e-12, 4.8599352e-20); }
        case 19: { return lit(-0.00034546803, 1.2467386e-12, -7.9787225e-21); }
        case 20: { return lit(0.00023635602, -4.100654e-12, 1.3302845e-19); }
        case 21: { return lit(-0.00016170622, 1.6507532e-12, 2.3076226e-20); }
        case 22: { return lit(0.00011063373, -1.8039087e-12, -3.4826992e-20); }
        case 23: { return lit(-7.5691794e-05, -1.4856429e-12, 1.5081315e-20); }
        case 24: { return lit(5.178576e-05, -8.8979486e-13, 2.646153e-20); }
        default: { return num(0.0); }
    }
}

/// x less the positive zero of ψ.
fn beyond_digamma_zero(x: real) -> real {
    return long_to_real(long_add_real(long_neg(long_lit(1.4616321, 1.243815e-08, -1.2654464e-16, -6.1832807e-24, 1.1382749e-31)), x));
}

fn digamma_of_positive(x: real) -> real {
    let d = beyond_digamma_zero(x);
    if is_below(real_abs(d), 0.25) {
        var near = digamma_taylor(24);
        for (var k = 23; k >= 0; k--) {
            near = real_add(digamma_taylor(k), real_mul(d, near));
        }
        return real_mul(d, near);
    }
    let steps = steps_to_ten(x);
    var below = num(0.0);
    for (var k = steps - 1; k >= 0; k--) {
        below = real_add(below, real_div(num(1.0), add32(x, f32(k))));
    }
    let top = add32(x, f32(steps));
    let r = real_div(num(1.0), top);
    let w = real_square(r);
    var sum = digamma_coefficient(9);
    for (var k = 8; k >= 0; k--) {
        sum = real_add(digamma_coefficient(k), real_mul(w, sum));
    }
    return real_sub(real_sub(real_log(top), real_add(mul32(r, 0.5), real_mul(w, sum))), below);
}

/// ψ(x) = Γ′(x)/Γ(x): NaN at the negative poles, ∓∞ at ±0 and where it overflows beside. Relative accuracy near the
/// positive zero; at those left of 0 absolute.
/// Error: 30 u for x > 0; left of 0 of the larger term.
fn real_digamma(x: real) -> real {
    let y = real_abs(x);
    if is_below(y, 1e-25) {
        return choose(is_zero(x), make_infinity(real_neg(x)), real_neg(real_div(num(1.0), x)));
    }
    if is_gamma_pole(x) || is_nan(x) || is_infinite(x) && sign_is_set(x) {
        return make_nan(x);
    }
    if is_infinite(x) {
        return x;
    }
    let r = digamma_of_positive(y);
    if !sign_is_set(x) {
        return r;
    }
    let wave = sincos_pi(y); // ψ(-y) = ψ(y) + 1/y + π cot πy
    let cot = real_mul(real_pi(), real_div(wave.second, wave.first));
    return real_add(r, real_add(real_div(num(1.0), y), cot));
}

/// ψ′(x + first) for x ≥ 0, first 0 or 1, x + first > 0.
fn trigamma_of_positive(x: real, first: i32) -> real {
    let steps = max(steps_to_ten(x), first);
    let top = add32(x, f32(steps));
    let r = real_div(num(1.0), top);
    let w = real_square(r);
    var sum = bernoulli_number(9);
    for (var k = 8; k >= 0; k--) {
        sum = real_add(bernoulli_number(k), real_mul(w, sum));
    }
    var far = real_add(r, real_mul(w, real_add(num(0.5), real_mul(r, sum))));
    for (var k = steps - 1; k >= first; k--) {
        far = real_add(far, real_square(real_div(num(1.0), add32(x, f32(k)))));
    }
    return far;
}

/// ψ′(x): ∞ at the poles. Left of 0 by ψ′(-y) = π² / sin² πy - ψ′(1 + y).
/// Error: 20 u; left of 0 of the larger term.
fn real_trigamma(x: real) -> real {
    if is_nan(x) || is_infinite(x) && sign_is_set(x) {
        return make_nan(x);
    }
    if is_infinite(x) {
        return num(0.0);
    }
    if is_gamma_pole(x) {
        return make_infinity(num(1.0));
    }
    let y = real_abs(x);
    if is_below(y, 1e-10) {
        return add32(real_square(real_div(num(1.0), x)), 1.644934);
    }
    if !sign_is_set(x) {
        return trigamma_of_positive(x, 0);
    }
    let ratio = real_div(real_pi(), sincos_pi(y).first);
    return real_sub(real_square(ratio), trigamma_of_positive(y, 1));
}
