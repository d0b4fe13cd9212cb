// sin, cos, tan over the whole range of f32, and their inverses.

/// An angle a ≥ 0 as count · π/2 + rest + low, |rest| ≤ π/4: rest is rounded, low is what that leaves (together 2^-30 of rest).
struct QuarterTurns {
    rest: f32,
    low: f32,
    count: u32,
}

/// Reduction for finite a ≥ 0 below 400 by Cody and Waite ("Software Manual for the Elementary Functions", 1980): π/2
/// in parts of 16, 16 and 24 bits, so that the products with a count below 256 are exact; above by `reduce_large`.
fn quarter_turns(a: f32) -> QuarterTurns {
    if a > 400.0 {
        return reduce_large(a);
    }
    let zero = hidden_zero(a);
    let n = floor(a * 0.63661975 + 0.5);
    let t = opaque(a - n * 1.570770263671875, zero);
    let p = n * 2.6063062250614166e-05;
    let u = opaque(t - p, zero);
    let rest = fast_two_sum(u, ((t - u) - p) - n * 6.07710062827671e-11, zero);
    return QuarterTurns(rest.x, rest.y, u32(n));
}

/// Reduction for a > 400 in integers, which no driver reassociates (Payne and Hanek 1983): the significand times the
/// 96 bits of 2/π that matter, modulo 4; then the fraction times π/2, all in fixed point.
fn reduce_large(a: f32) -> QuarterTurns {
    let bits = bitcast<u32>(a);
    let biased = bits >> 23u;
    if biased == 255u {
        return QuarterTurns(make_nan(a), 0.0, 0u);
    }
    // 0 and the first bits of 2/π, in words; the first bit that matters is the one of weight 2^(147 - biased). Four
    // words from number word = 0 … 4 on are chosen by halving: an indexed array is slow on many adapters.
    let offset = biased - 120u; // biased ≥ 135
    let shift = offset & 31u;
    let four = (offset & 128u) != 0u;
    let two = (offset & 64u) != 0u;
    let one = (offset & 32u) != 0u;
    let v0 = select(0u, 0xf534ddc0u, four);
    let v1 = select(0xa2f9836eu, 0xdb629599u, four);
    let v2 = select(0x4e441529u, 0x3c439041u, four);
    let v3 = select(0xfc2757d1u, 0xfe5163abu, four);
    let u0 = select(v0, v2, two);
    let u1 = select(v1, v3, two);
    let u2 = select(v2, 0xf534ddc0u, two);
    let u3 = select(v3, 0xdb629599u, two);
    let w0 = select(u0, u1, one);
    let w1 = select(u1, u2, one);
    let w2 = select(u2, u3, one);
    let w3 = select(u3, select(0xf534ddc0u, 0x3c439041u, two), one);
    let down = 31u - shift; // >> (32 - shift) in two steps, for shift 0
    let a0 = (w0 << shift) | ((w1 >> 1u) >> down);
    let a1 = (w1 << shift) | ((w2 >> 1u) >> down);
    let a2 = (w2 << shift) | ((w3 >> 1u) >> down);
    let m = (bits & 0x7fffffu) | 0x800000u;
    let low_part = m * a1;
    var low = low_part + multiply_high(m, a2);
    var high = m * a0 + multiply_high(m, a1) + select(0u, 1u, low < low_part);
    let count = (high + 0x20000000u) >> 30u;
    high -= count << 30u;
    let negative = high >= 0x80000000u;
    if negative {
        high = ~high;
        low = ~low;
    }
    // normalise the 64 bits; high counts in 2^-30 quarter turns
    var exponent = -29;
    if high == 0u {
        high = low;
        low = 0u;
        exponent -= 32;
    }
    let lead = countLeadingZeros(high | 1u);
    let fraction = (high << lead) | ((low >> 1u) >> (31u - lead));
    let whole = multiply_high(fraction, 0xc90fdaa2u);
    let nearest = f32(whole);
    let unit = power_of_two(exponent - i32(lead));
    let sign = select(0u, 0x80000000u, negative);
    return QuarterTurns(flip_sign(nearest * unit, sign), flip_sign(f32(i32(whole - u32(nearest))) * unit, sign), count);
}

/// sin r = r + r^3 P(r²) for |r| ≤ π/4; coefficients.py, sin.
fn sin_polynomial(r: f32) -> f32 {
    let z = r * r;
    return r + r * z * (-0.16666655 + z * (0.008332158 + z * -0.00019514958));
}

/// cos r = 1 - r²/2 + r^4 P(r²) for |r| ≤ π/4; coefficients.py, cos.
fn cos_polynomial(r: f32) -> f32 {
    let z = r * r;
    return 1.0 - (0.5 * z - z * z * (0.041666646 + z * (-0.0013887365 + z * 2.4438128e-05)));
}

/// (sin x, cos x) with one reduction.
/// Error: 1.6 ulp each.
fn real_sincos(x: f32) -> vec2f {
    let turns = quarter_turns(magnitude(x));
    let s = sin_polynomial(turns.rest);
    let c = cos_polynomial(turns.rest);
    let odd = (turns.count & 1u) == 1u;
    let half_turn = (turns.count & 2u) << 30u;
    let turn = ((turns.count + 1u) & 2u) << 30u;
    return vec2f(flip_sign(select(s, c, odd), half_turn ^ sign_bit(x)), flip_sign(select(c, s, odd), turn));
}

/// sin x for every f32; sin(-0) = -0, NaN at ±∞.
/// Error: 1.6 ulp over the whole range.
fn real_sin(x: f32) -> f32 {
    return real_sincos(x).x;
}

/// cos x for every f32; NaN at ±∞.
/// Error: 1.6 ulp over the whole range.
fn real_cos(x: f32) -> f32 {
    return real_sincos(x).y;
}

/// sin (r + low) or cos (r + low) minus s, for |r| ≤ π/4: Taylor's series, of which the parts that count are sums of two
/// numbers. 1/6, 1/120 and 1/24 are so, too.
/// Error: 2^-34.
fn wave_rest(turns: QuarterTurns, s: f32, of_cosine: bool) -> f32 {
    let r = turns.rest;
    let zero = hidden_zero(r);
    let z = two_product(r, r, zero);
    let odd = two_product(r, z.x, zero);
    let sine_tail = -0.0001984127 + z.x * (2.7557319e-06 + z.x * -2.5052108e-08);
    let cosine_tail = -0.0013888889 + z.x * (2.4801588e-05 + z.x * (-2.755732e-07 + z.x * 2.0876757e-09));
    // head + factor (outer + z (inner + z tail))
    let head = select(r, 1.0, of_cosine);
    let factor = select(odd.x, z.x, of_cosine);
    let factor_low = select(odd.y + r * z.y, z.y, of_cosine);
    let tail = opaque(z.x * select(sine_tail, cosine_tail, of_cosine), zero);
    let inner = two_sum(select(0.008333334, 0.041666668, of_cosine), tail, zero);
    let inner_low = inner.y + select(-4.346172e-10, -1.2417635e-09, of_cosine);
    let middle = two_product(inner.x, z.x, zero);
    let middle_low = middle.y + (inner_low * z.x + inner.x * z.y);
    let outer = two_sum(select(-0.16666667, -0.5, of_cosine), middle.x, zero);
    let outer_low = outer.y + (middle_low + select(4.967054e-09, 0.0, of_cosine));
    let product = two_product(factor, outer.x, zero);
    let product_low = product.y + (factor * outer_low + factor_low * outer.x);
    let slope = select(1.0 - z.x * (0.5 - 0.041666668 * z.x), r * (z.x * (0.16666667 - 0.008333334 * z.x) - 1.0), of_cosine);
    let sum = two_sum(head, product.x, zero);
    let rest = opaque(sum.x - s, zero) + (sum.y + (product_low + turns.low * slope));
    return select(0.0, rest, is_finite(rest));
}

/// sin x - s, where s is near it; 0 where that is no number.
fn real_sine_rest(x: f32, s: f32) -> f32 {
    let turns = quarter_turns(magnitude(x));
    let sign = ((turns.count & 2u) << 30u) ^ sign_bit(x);
    return flip_sign(wave_rest(turns, flip_sign(s, sign), (turns.count & 1u) == 1u), sign);
}

/// cos x - s, where s is near it; 0 where that is no number.
fn real_cosine_rest(x: f32, s: f32) -> f32 {
    let turns = quarter_turns(magnitude(x));
    let sign = ((turns.count + 1u) & 2u) << 30u;
    return flip_sign(wave_rest(turns, flip_sign(s, sign), (turns.count & 1u) == 0u), sign);
}

/// tan r = r + r^3 P(r²) for |r| ≤ π/4; coefficients.py, tan.
fn tan_polynomial(r: f32) -> f32 {
    let z = r * r;
    return r + r * z * (0.3333335 + z * (0.13332659 + z * (0.054060496 + z * (0.021279095 + z * (0.010844064 + z * (
        7.87863e-05 + z * 0.0043817163))))));
}

/// tan x for every f32.
/// Error: 2.7 ulp over the whole range.
fn real_tan(x: f32) -> f32 {
    let turns = quarter_turns(magnitude(x));
    let t = tan_polynomial(turns.rest);
    return flip_sign(select(t, -1.0 / t, (turns.count & 1u) == 1u), sign_bit(x));
}

/// sin x / x, 1 at 0, 0 at ±∞.
/// Error: 2.6 ulp.
fn real_sinc(x: f32) -> f32 {
    let a = magnitude(x);
    if a < 0.78 {
        let z = a * a;
        return 1.0 + z * (-0.16666655 + z * (0.008332158 + z * -0.00019514958));
    }
    return select(real_sin(a) / a, 0.0, is_infinite(x));
}

/// arctan t = t + t^3 P(t²) for 0 ≤ t ≤ 1; coefficients.py, atan.
fn atan_polynomial(t: f32) -> f32 {
    let z = t * t;
    return t + t * z * (-0.333333 + z * (0.19998549 + z * (-0.14264244 + z * (0.10952194 + z * (-0.08403473 + z * (
        0.05795796 + z * (-0.03117819 + z * (0.010914781 + z * -0.0017936593))))))));
}

/// arctan x.
/// Error: 1.9 ulp.
fn real_atan(x: f32) -> f32 {
    let a = magnitude(x);
    let large = a > 1.0;
    let r = atan_polynomial(select(a, 1.0 / a, large));
    return flip_sign(select(r, 1.5707964 - (r + 4.371139e-8), large), sign_bit(x));
}

/// The angle of (x, y) in [-π, π]; signed zeros and infinities as C99 F.9.1.4.
/// Error: 2.0 ulp.
fn real_atan2(y: f32, x: f32) -> f32 {
    let a = magnitude(x);
    let b = magnitude(y);
    if is_nan(x) || is_nan(y) {
        return make_nan(x);
    }
    let steep = b > a;
    // the quotient of numbers near the ends of the range is taken of scaled ones
    let larger = max(a, b);
    let scale = select(select(1.0, 16777216.0, larger < 1e-30), 5.9604645e-8, larger > 1e30);
    var t = (min(a, b) * scale) / (larger * scale);
    t = select(t, 0.0, larger == 0.0);
    t = select(t, select(0.0, 1.0, is_infinite(min(a, b))), is_infinite(larger));
    var r = atan_polynomial(t);
    r = select(r, 1.5707964 - (r + 4.371139e-8), steep);
    r = select(r, 3.1415927 - (r + 8.742278e-8), sign_bit(x) != 0u);
    return flip_sign(r, sign_bit(y));
}

/// arcsin t = t + t^3 P(t²) for 0 ≤ t ≤ 1/2, z = t²; coefficients.py, asin.
fn asin_polynomial(t: f32, z: f32) -> f32 {
    return t + t * z * (0.16666752 + z * (0.07495297 + z * (0.04547043 + z * (0.024179278 + z * 0.04216667))));
}

/// arcsin x; NaN outside [-1, 1]. Beyond 1/2 by π/2 - 2 arcsin √((1 - x)/2).
/// Error: 2.5 ulp.
fn real_asin(x: f32) -> f32 {
    let a = magnitude(x);
    if bitcast<u32>(a) > 0x3f800000u { // beyond 1, or NaN
        return make_nan(x);
    }
    let steep = a > 0.5;
    let z = select(a * a, 0.5 * (1.0 - a), steep);
    let r = asin_polynomial(select(a, sqrt(z), steep), z);
    return flip_sign(select(r, 1.5707964 - (2.0 * r + 4.371139e-8), steep), sign_bit(x));
}

/// arccos x; NaN outside [-1, 1]. Relative accuracy near its zero at 1.
/// Error: 1.4 ulp.
fn real_acos(x: f32) -> f32 {
    let a = magnitude(x);
    if bitcast<u32>(a) > 0x3f800000u { // beyond 1, or NaN
        return make_nan(x);
    }
    let steep = a > 0.5;
    let z = select(a * a, 0.5 * (1.0 - a), steep);
    let r = asin_polynomial(select(a, sqrt(z), steep), z);
    if !steep {
        return 1.5707964 - (flip_sign(r, sign_bit(x)) + 4.371139e-8);
    }
    return select(2.0 * r, 3.1415927 - (2.0 * r + 8.742278e-8), sign_bit(x) != 0u);
}
