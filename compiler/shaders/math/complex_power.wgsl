// Complex powers. z^w = e^(w log z) loses |w log z| units of the last place when log z is rounded: so its modulus and
// its phase are taken in two floats each.

/// z w of finite numbers, with no care for what overflows.
fn plain_product(z: vec2f, w: vec2f) -> vec2f {
    return vec2f(z.x * w.x - z.y * w.y, z.x * w.y + z.y * w.x);
}

/// z^n for 1 ≤ n ≤ 8. Of z² = h² + (z - h)(z + h), where h is z without its last 12 bits, the square of h is exact, and the
/// rest below 2^-10 of it: the rounding of z² would count three times in z^7.
/// Error: 4 ulp of the norm.
fn small_complex_power(z: vec2f, n: u32) -> vec2f {
    let zero = hidden_zero_of(z.x, z.y);
    let grid = 6144.0 * power_of_two(min(complex_exponent(z), 100));
    let h = vec2f(opaque(opaque(z.x + grid, zero) - grid, zero), opaque(opaque(z.y + grid, zero) - grid, zero));
    let square = vec2f((h.x - h.y) * (h.x + h.y), 2.0 * h.x * h.y);
    let rest = plain_product(z - h, z + h);
    let odd = select(vec2f(1.0, 0.0), z, (n & 1u) == 1u);
    let low = select(odd, plain_product(odd, square) + plain_product(odd, rest), (n & 2u) == 2u);
    if n < 4u {
        return low;
    }
    let fourth = vec2f((square.x - square.y) * (square.x + square.y), 2.0 * square.x * square.y)
        + plain_product(rest, 2.0 * square + rest);
    if n == 4u {
        return fourth;
    }
    return plain_product(fourth, select(low, fourth, n == 8u));
}

/// z^n for 1 ≤ |n| ≤ 8 where the power, or for negative n its inverse, leaves the range, or an infinity comes in: of z
/// scaled by a power of two.
fn scaled_complex_power(z: vec2f, n: i32) -> vec2f {
    let e = complex_exponent(z);
    let infinite = complex_is_infinite(z);
    var power = small_complex_power(select(z * power_of_two(-e), complex_box(z), infinite), u32(abs(n)));
    if infinite {
        power = make_infinity(1.0) * power;
    }
    if n < 0 {
        power = complex_inverse(power);
    }
    let exponent = clamp(e * n, -360, 360);
    return vec2f(times_wide_power_of_two(power.x, exponent), times_wide_power_of_two(power.y, exponent));
}

/// z^n: by products for |n| ≤ 8, else as z^w; real on the real axis; z^0 = 1.
/// Error: 4 ulp of the norm for 0 < n ≤ 8, 6 for -8 ≤ n < 0, else 2.5.
fn complex_powi(z: vec2f, n: i32) -> vec2f {
    if n == 0 {
        return vec2f(1.0, 0.0);
    }
    if magnitude(z.y) == 0.0 {
        let odd = select(0u, sign_bit(z.x), (n & 1) == 0);
        return vec2f(real_powi(z.x, n), flip_sign(0.0, odd ^ sign_bit(z.y) ^ select(0u, 0x80000000u, n < 0)));
    }
    let size = u32(abs(n));
    if size > 8u {
        return complex_pow_polar(z, vec2f(f32(n), 0.0));
    }
    let power = small_complex_power(z, size);
    if n < 0 || !(is_finite(power.x) && is_finite(power.y)) {
        return scaled_complex_power(z, n);
    }
    return power;
}

/// z^w on the principal branch: w = 0 gives 1, an integer w gives `complex_powi`, 0^w is 0 for Re w > 0 and infinite
/// for
/// Re w < 0 (NaN for the other w). Error: 2.5 ulp of the norm; for integers |n| ≤ 8 that of `complex_powi`.
fn complex_pow(z: vec2f, w: vec2f) -> vec2f {
    if w.y == 0.0 && magnitude(w.x) <= 1e6 && floor(w.x) == w.x {
        return complex_powi(z, i32(w.x));
    }
    return complex_pow_polar(z, w);
}

/// z^(w + c) for a small whole real c, the sum exact in two floats.
fn complex_pow_shift(z: vec2f, w: vec2f, c: vec2f) -> vec2f {
    let s = two_sum(w.x, c.x, hidden_zero_of(z.x, w.x));
    if !is_finite(w.x) || s.y == 0.0 {
        return complex_pow(z, vec2f(s.x, w.y));
    }
    let vanishes = magnitude(z.x) == 0.0 && magnitude(z.y) == 0.0;
    if vanishes || !is_finite(z.x) || !is_finite(z.y) || max(magnitude(w.x), magnitude(w.y)) > 1e30 {
        return complex_pow_polar(z, vec2f(s.x, w.y));
    }
    if magnitude(w.y) == 0.0 && magnitude(z.y) == 0.0 && z.x > 0.0 {
        return vec2f(real_pow_shift(z.x, w.x, c.x), flip_sign(0.0, sign_bit(z.y) ^ sign_bit(s.x)));
    }
    return power_and_exp(z, vec2f(s.x, w.y), s.y, vec2f(0.0, 0.0));
}

fn complex_pow_polar(z: vec2f, w: vec2f) -> vec2f {
    if magnitude(z.x) == 0.0 && magnitude(z.y) == 0.0 {
        if w.x > 0.0 {
            return vec2f(0.0, 0.0);
        }
        if w.x < 0.0 {
            return vec2f(make_infinity(1.0), select(make_nan(z.x), 0.0, w.y == 0.0));
        }
        return vec2f(make_nan(z.x), make_nan(z.x));
    }
    if !is_finite(z.x) || !is_finite(z.y) || !is_finite(w.x) || !is_finite(w.y) || max(magnitude(w.x), magnitude(w.y)) > 1e30 {
        return complex_exp(complex_mul(w, complex_log(z)));
    }
    if magnitude(w.y) == 0.0 && magnitude(z.y) == 0.0 && z.x > 0.0 {
        return vec2f(real_pow(z.x, w.x), flip_sign(0.0, sign_bit(z.y) ^ sign_bit(w.x)));
    }
    return power_and_exp(z, w, 0.0, vec2f(0.0, 0.0));
}

/// log2 |z| of a finite nonzero z in two floats, relative error about 2^-30 also near |z| = 1.
fn log2_modulus_pair(z: vec2f, zero: u32) -> vec2f {
    var e = complex_exponent(z);
    e = select(e, 0, e == -1);
    let v = z * power_of_two(-e);
    let p = two_product(v.x, v.x, zero);
    let q = two_product(v.y, v.y, zero);
    let s = two_sum(p.x, q.x, zero);
    let l = 0.5 * log2_pair(s.x, zero);
    let sum = two_sum(f32(e), l.x, zero);
    return vec2f(sum.x, sum.y + (l.y + (s.y + (p.y + q.y)) / s.x * 0.72134752));
}

/// An angle turns · π/2 + rest, the rest in two floats and at most π/4.
struct Phase {
    turns: f32,
    rest: vec2f,
}

/// arg z of a finite nonzero z, counted from the nearest axis: arctan b + arctan((t - b)/(1 + t b)), b the multiple of
/// 1/4 next to t
/// (Gal and Bachelis, ACM TOMS 17 (1991): a table point and a short polynomial).
fn phase_pair(z: vec2f, zero: u32) -> Phase {
    let e = complex_exponent(z);
    let a = magnitude(z.x) * power_of_two(-e);
    let c = magnitude(z.y) * power_of_two(-e);
    let large = max(a, c);
    let small = min(a, c);
    let k = floor(4.0 * (small / large) + 0.5);
    let b = 0.25 * k;
    let bl = two_product(b, large, zero);
    let bs = two_product(b, small, zero);
    let n = two_sum(small, -bl.x, zero);
    let d = two_sum(large, bs.x, zero);
    let u = opaque(n.x / d.x, zero);
    let ud = two_product(u, d.x, zero);
    let rest = opaque(opaque(n.x - ud.x, zero) - ud.y, zero) + ((n.y - bl.y) - u * (d.y + bs.y));
    var points = array<vec2f, 5>(
        vec2f(0.0, 0.0),
        vec2f(0.244978666305542, -3.1786777654474463e-09),
        vec2f(0.46364760398864746, 5.01215868808913e-09),
        vec2f(0.6435011029243469, 5.868937336117597e-09),
        vec2f(0.7853981852531433, -2.1855694143368964e-08),
    );
    let point = points[u32(k)];
    let w = u * u;
    let tail = u * w * (-0.33333334 + w * (0.19999972 + w * (-0.14280698 + w * 0.10750129)));
    let t = two_sum(point.x, u, zero);
    let angle = vec2f(t.x, t.y + (point.y + (rest / d.x + tail)));
    let steep = c > a;
    let left = sign_is_set(z.x);
    let down = sign_bit(z.y);
    let turns = select(select(0.0, 2.0, left), 1.0, steep);
    let flip = down ^ select(0u, 0x80000000u, steep != left);
    return Phase(flip_sign(turns, down), vec2f(flip_sign(angle.x, flip), flip_sign(angle.y, flip)));
}

/// v times the pair p.
fn scale_pair(v: f32, p: vec2f, zero: u32) -> vec2f {
    let q = two_product(v, p.x, zero);
    return vec2f(q.x, q.y + v * p.y);
}

/// The pair p + q.
fn add_pairs(p: vec2f, q: vec2f, zero: u32) -> vec2f {
    let s = two_sum(p.x, q.x, zero);
    let low = s.y + (p.y + q.y);
    let hi = opaque(s.x + low, zero);
    return vec2f(hi, opaque(s.x - hi, zero) + low);
}

/// π/2 in two floats.
const QUARTER_TURN = vec2f(1.5707963705062866, -4.371138828673793e-08);

/// z^(w + low) e^shift for finite z ≠ 0, all exponents carried in two floats, quarter turns apart: integer powers of
/// numbers near the axes stay near them.
fn power_and_exp(z: vec2f, w: vec2f, low: f32, shift: vec2f) -> vec2f {
    let zero = hidden_zero_of(z.x + z.y, w.x + w.y);
    let modulus = log2_modulus_pair(z, zero);
    let phase = phase_pair(z, zero);
    // log2 |result| = w.x log2|z| + (shift.x - w.y arg z) / log 2
    let arg = add_pairs(scale_pair(phase.turns, QUARTER_TURN, zero), phase.rest, zero);
    let decay = add_pairs(vec2f(shift.x, low * modulus.x * 0.6931472), -scale_pair(w.y, arg, zero), zero);
    let decay2 = scale_pair(decay.x, vec2f(1.4426950216293335, 1.925963033500011e-08), zero);
    let size = add_pairs(scale_pair(w.x, modulus, zero), vec2f(decay2.x, decay2.y + decay.y * 1.442695), zero);
    // its phase = w.x arg z + w.y log 2 log2|z| + shift.y
    let twist = scale_pair(w.y, modulus, zero);
    let twist2 = scale_pair(twist.x, vec2f(0.6931471824645996, -1.9046542121259336e-09), zero);
    let turns = w.x * phase.turns;
    let count = floor(turns + 0.5);
    let whole = add_pairs(scale_pair(turns - count, QUARTER_TURN, zero), scale_pair(w.x, phase.rest, zero), zero);
    let spin = add_pairs(whole, vec2f(twist2.x, twist2.y + (twist.y * 0.6931472 + low * arg.x)), zero);
    let angle = add_pairs(spin, vec2f(shift.y, 0.0), zero);
    let high = clamp(size.x, -300.0, 300.0);
    let n = floor(high + 0.5);
    let r = exp2_polynomial(opaque(high - n, zero) + select(size.y, 0.0, high != size.x));
    let wave = real_sincos(angle.x);
    let v = r * vec2f(wave.y - angle.y * wave.x, wave.x + angle.y * wave.y);
    // times i^count
    let quarter = count - 4.0 * floor(0.25 * count);
    let turned = select(v, vec2f(-v.y, v.x), quarter == 1.0 || quarter == 3.0);
    let u = select(turned, -turned, quarter >= 2.0);
    return vec2f(times_wide_power_of_two(u.x, i32(n)), times_wide_power_of_two(u.y, i32(n)));
}
