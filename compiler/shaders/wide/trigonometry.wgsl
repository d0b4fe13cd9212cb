// sin, cos, tan over the whole range of both wide formats, and their inverses.

/// An angle a ≥ 0 as count · π/2 + rest + low, |rest| ≤ π/4 about.
struct QuarterTurns {
    rest: real,
    low: real,
    count: u32,
}

/// Reduction of a finite a ≥ 0: none up to π/4, by Cody and Waite ("Software Manual for the Elementary Functions", 1980) up
/// to 1000 quarter turns, by `reduce_large` above.
fn quarter_turns(a: real) -> QuarterTurns {
    let size = real_to_f32(a);
    if size < 0.78539 {
        return QuarterTurns(a, num(0.0), 0u);
    }
    if size > 1570.0 {
        return reduce_large(a);
    }
    // π/2 in words of 24 bits: the first three times a count of 10 bits are exact in both formats, and so are the
    // differences where they cancel; what is left of π/2 then is below 2^-72
    let n = floor(size * 0.63661975 + 0.5);
    let t = rounded(real_sub(a, mul32(num(1.5707964), n)));
    let u = rounded(real_sub(t, mul32(num(-4.371139e-08), n)));
    let v = rounded(real_sub(u, mul32(num(-1.7151245e-15), n)));
    let r = rest_with_low(v, real_neg(mul32(lit(1.0562999e-23, 8.4784276e-32, 9.41521e-40), n)));
    return QuarterTurns(r.first, r.second, u32(n));
}

/// The upper 32 bits of a b.
fn multiply_high(a: u32, b: u32) -> u32 {
    let a0 = a & 0xffffu;
    let a1 = a >> 16u;
    let b0 = b & 0xffffu;
    let b1 = b >> 16u;
    let middle = a1 * b0 + ((a0 * b0) >> 16u);
    let other = a0 * b1 + (middle & 0xffffu);
    return a1 * b1 + (middle >> 16u) + (other >> 16u);
}

/// m 2^e · 2/π modulo 4 in units of 2^-126, truncated, as four words: the bits of 2/π that make multiples of 4 are left
/// out, and those below the last word (Payne and Hanek, "Radian reduction for trigonometric functions", 1983).
fn turns_of(m: u32, e: i32) -> vec4u {
    // 32 bits each, from the binary point on; none before it
    var bits = array<u32, 46>(
        0xa2f9836eu, 0x4e441529u, 0xfc2757d1u, 0xf534ddc0u, 0xdb629599u, 0x3c439041u, 0xfe5163abu, 0xdebbc561u,
        0xb7246e3au, 0x424dd2e0u, 0x06492eeau, 0x09d1921cu, 0xfe1deb1cu, 0xb129a73eu, 0xe88235f5u, 0x2ebb4484u,
        0xe99c7026u, 0xb45f7e41u, 0x3991d639u, 0x835339f4u, 0x9c845f8bu, 0xbdf9283bu, 0x1ff897ffu, 0xde05980fu,
        0xef2f118bu, 0x5a0a6d1fu, 0x6d367ecfu, 0x27cb09b7u, 0x4f463f66u, 0x9e5fea2du, 0x7527bac7u, 0xebe5f17bu,
        0x3d0739f7u, 0x8a5292eau, 0x6bfb5fb1u, 0x1f8d5d08u, 0x56033046u, 0xfc7b6babu, 0xf0cfbc20u, 0x9af4361du,
        0u, 0u, 0u, 0u, 0u, 0u,
    );
    // the bit of weight 2^(1 - e) is the first that matters, in units of 2: bit e - 1 after the point
    let i = (e - 2) >> 5u;
    let shift = u32(e - 2) & 31u;
    var w = array<u32, 5>();
    var here = select(0u, bits[clamp(i, 0, 45)], i >= 0);
    for (var k = 0; k < 5; k++) {
        let at = i + k + 1;
        let next = select(0u, bits[clamp(at, 0, 45)], at >= 0);
        w[k] = (here << shift) | ((next >> 1u) >> (31u - shift));
        here = next;
    }
    let low = vec4u(m * w[0], m * w[1], m * w[2], m * w[3]);
    let high = vec4u(multiply_high(m, w[1]), multiply_high(m, w[2]), multiply_high(m, w[3]), multiply_high(m, w[4]));
    return add_words(low, high);
}

/// a + b modulo 2^128, the highest words first.
fn add_words(a: vec4u, b: vec4u) -> vec4u {
    let s = a + b;
    let c = select(vec4u(0u), vec4u(1u), s < a);
    // a carry may run through words of ones
    let z = s.z + c.w;
    let cz = c.z + select(0u, 1u, z < c.w);
    let y = s.y + cz;
    let cy = c.y + select(0u, 1u, y < cz);
    return vec4u(s.x + cy, y, z, s.w);
}

/// -a modulo 2^128.
fn negate_words(a: vec4u) -> vec4u {
    return add_words(~a, vec4u(0u, 0u, 0u, 1u));
}

/// Reduction of every finite a: the turns of its pieces, modulo 4, in fixed point.
fn reduce_large(a: real) -> QuarterTurns {
    if !is_finite(a) {
        return QuarterTurns(make_nan(a), num(0.0), 0u);
    }
    let p = pieces_of(a);
    let low = turns_of(p.low, p.low_exponent);
    var t = turns_of(p.high, p.high_exponent);
    if p.low_is_negative {
        t = add_words(t, negate_words(low));
    } else {
        t = add_words(t, low);
    }
    let count = (t.x + 0x20000000u) >> 30u;
    t.x -= count << 30u;
    let negative = t.x >= 0x80000000u;
    if negative {
        t = negate_words(t);
    }
    // normalised: the first bit set comes to the top
    var e = -30;
    for (var k = 0; k < 3 && t.x == 0u; k++) {
        t = vec4u(t.y, t.z, t.w, 0u);
        e -= 32;
    }
    let lead = countLeadingZeros(t.x | 1u);
    let down = 31u - lead;
    let high = (t.x << lead) | ((t.y >> 1u) >> down);
    let rest = (t.y << lead) | ((t.z >> 1u) >> down);
    let r = radians_of_turns(high, rest, e - i32(lead));
    return QuarterTurns(flip_if(r.first, negative), flip_if(r.second, negative), count);
}

/// (sin x, cos x) with one reduction; sin(-0) = -0, NaN at ±∞.
fn real_sincos(x: real) -> RealPair {
    if !is_finite(x) {
        return RealPair(make_nan(x), make_nan(x));
    }
    let turns = quarter_turns(real_abs(x));
    let s = sin_near(turns.rest, turns.low);
    let c = cos_near(turns.rest, turns.low);
    let odd = (turns.count & 1u) == 1u;
    let half_turn = (turns.count & 2u) != 0u;
    return RealPair(
        flip_if(choose(odd, c, s), half_turn != sign_is_set(x)),
        flip_if(choose(odd, s, c), ((turns.count + 1u) & 2u) != 0u),
    );
}

/// sin x.
fn real_sin(x: real) -> real {
    return real_sincos(x).first;
}

/// cos x.
fn real_cos(x: real) -> real {
    return real_sincos(x).second;
}

/// tan x, the quotient of sine and cosine of the reduced angle.
fn real_tan(x: real) -> real {
    if !is_finite(x) {
        return make_nan(x);
    }
    let turns = quarter_turns(real_abs(x));
    let s = sin_near(turns.rest, turns.low);
    let c = cos_near(turns.rest, turns.low);
    if (turns.count & 1u) == 1u {
        return flip_if(real_div(c, s), !sign_is_set(x));
    }
    return flip_if(real_div(s, c), sign_is_set(x));
}

/// sin x / x, 1 at 0, 0 at ±∞.
fn real_sinc(x: real) -> real {
    let a = real_abs(x);
    if real_to_f32(a) < 0.78 {
        let z = real_square(a);
        return add32(real_mul(z, sin_tail(z)), 1.0);
    }
    if is_infinite(x) {
        return num(0.0);
    }
    return real_div(real_sin(a), a);
}

/// arctan(k / 8)
fn atan_of_eighths(k: i32) -> real {
    switch k {
        case 1: {
            return lit(0.124354996, -1.2403822e-09, -3.08809e-17);
        }
        case 2: {
            return lit(0.24497867, -3.1786778e-09, -7.256797e-17);
        }
        case 3: {
            return lit(0.35877067, 1.7639499e-09, 3.0887334e-17);
        }
        case 4: {
            return lit(0.4636476, 5.0121587e-09, -3.2812372e-17);
        }
        case 5: {
            return lit(0.5585993, 2.2111598e-08, 4.3863358e-16);
        }
        case 6: {
            return lit(0.6435011, 5.8689373e-09, 1.268571e-16);
        }
        case 7: {
            return lit(0.71883, 1.01883355e-08, 4.226108e-16);
        }
        case 8: {
            return lit(0.7853982, -2.1855694e-08, -8.5756226e-16);
        }
        default: {
            return num(0.0);
        }
    }
}

/// arctan(y / x) for 0 ≤ y ≤ x, x > 0, both of modest size: with c = k/8 next to the quotient it is arctan c plus
/// arctan((y - c x) / (x + c y)), whose argument is below 1/15.
fn atan_of_quotient(y: real, x: real) -> real {
    let c = floor(8.0 * real_to_f32(y) / real_to_f32(x) + 0.5) * 0.125;
    let t = real_div(real_sub(y, rounded(mul32(x, c))), real_add(x, mul32(y, c)));
    let z = real_square(t);
    return real_add(atan_of_eighths(i32(8.0 * c)), real_add(t, real_mul(real_mul(t, z), atan_tail(z))));
}

/// arctan x.
fn real_atan(x: real) -> real {
    let a = real_abs(x);
    if is_nan(x) {
        return x;
    }
    if real_to_f32(a) > 1e18 {
        return with_sign(lit(1.5707964, -4.371139e-08, -1.7151245e-15), x);
    }
    let one = num(1.0);
    if real_less(one, a) {
        return with_sign(real_sub(lit(1.5707964, -4.371139e-08, -1.7151245e-15), atan_of_quotient(one, a)), x);
    }
    return with_sign(atan_of_quotient(a, one), x);
}

/// The angle of (x, y) in [-π, π]; signed zeros and infinities as C99 F.9.1.4.
fn real_atan2(y: real, x: real) -> real {
    if is_nan(x) || is_nan(y) {
        return make_nan(x);
    }
    let a = real_abs(x);
    let b = real_abs(y);
    let steep = real_less(a, b);
    let larger = choose(steep, b, a);
    let smaller = choose(steep, a, b);
    var r = num(0.0);
    if is_infinite(smaller) {
        r = lit(0.7853982, -2.1855694e-08, -8.5756226e-16);
    } else if is_finite(larger) && !is_zero(larger) {
        let e = exponent_of(larger);
        r = atan_of_quotient(scale(smaller, -e), scale(larger, -e));
    }
    r = choose(steep, real_sub(lit(1.5707964, -4.371139e-08, -1.7151245e-15), r), r);
    r = choose(sign_is_set(x), real_sub(lit(3.1415927, -8.742278e-08, -3.430249e-15), r), r);
    return with_sign(r, y);
}

/// (1 - x)(1 + x), each factor exact where it matters; of |x|, for a product of pairs is not the same in both orders.
fn one_minus_square(x: real) -> real {
    let a = real_abs(x);
    return real_mul(rounded(add32(real_neg(a), 1.0)), rounded(add32(a, 1.0)));
}

/// arcsin x, the angle of (√(1 - x²), x); NaN outside of [-1, 1].
fn real_asin(x: real) -> real {
    if is_nan(x) || real_less(num(1.0), real_abs(x)) {
        return make_nan(x);
    }
    return real_atan2(x, real_sqrt(one_minus_square(x)));
}

/// arccos x, the angle of (x, √(1 - x²)); NaN outside of [-1, 1]. Relative accuracy near its zero at 1.
fn real_acos(x: real) -> real {
    if is_nan(x) || real_less(num(1.0), real_abs(x)) {
        return make_nan(x);
    }
    return real_atan2(real_sqrt(one_minus_square(x)), x);
}
