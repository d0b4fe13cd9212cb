// Complex functions of the tier `fast`: as one would write them, in built-in functions, without care for parts that overflow
// on the way or cancel. Squares of huge and tiny numbers alone are kept in range, where quotients and moduli would be
// infinite or 0 far within the plane. Each stands for the function of the same name in `math`.

fn is_infinite(x: f32) -> bool { return false; }
fn make_infinity(seed: f32) -> f32 { return 0.0; }
fn power_of_two(n: i32) -> f32 { return 0.0; }
fn complex_exponent(z: vec2f) -> i32 { return 0; }

/// z w. An overflow leaves one part infinite, whatever the other is.
fn complex_mul(z: vec2f, w: vec2f) -> vec2f {
    return vec2f(z.x * w.x - z.y * w.y, z.x * w.y + z.y * w.x);
}

/// z².
fn complex_square(z: vec2f) -> vec2f {
    return vec2f(z.x * z.x - z.y * z.y, 2.0 * z.x * z.y);
}

/// 1 / z = z̄ / |z|².
fn complex_inverse(z: vec2f) -> vec2f {
    let squared = dot(z, z);
    if is_moderate(squared) {
        let over = 1.0 / squared;
        return vec2f(z.x * over, -z.y * over);
    }
    return inverse_of_extreme(z);
}

/// 1 / z of a z whose square is out of range: 0 for infinite ones, infinite for 0.
fn inverse_of_extreme(z: vec2f) -> vec2f {
    if is_infinite(z.x) || is_infinite(z.y) {
        return vec2f(0.0, 0.0);
    }
    if z.x == 0.0 && z.y == 0.0 {
        return vec2f(make_infinity(z.x), 0.0);
    }
    let scale = power_of_two(-complex_exponent(z));
    let a = z * scale;
    return vec2f(a.x, -a.y) / dot(a, a) * scale;
}

/// z / w.
fn complex_div(z: vec2f, w: vec2f) -> vec2f {
    let squared = dot(w, w);
    if is_moderate(squared) {
        let over = 1.0 / squared;
        return vec2f(z.x * w.x + z.y * w.y, z.y * w.x - z.x * w.y) * over;
    }
    return complex_mul(z, inverse_of_extreme(w));
}

/// 1 / z².
fn complex_inverse_square(z: vec2f) -> vec2f {
    let w = complex_inverse(z);
    return complex_square(w);
}

/// e^z.
fn complex_exp(z: vec2f) -> vec2f {
    let size = exp(z.x);
    return vec2f(size * cos(z.y), size * sin(z.y));
}

/// (sinh z, cosh z).
fn complex_sinhcosh(z: vec2f) -> vec4f {
    let growth = exp(z.x);
    let decay = exp(-z.x);
    let along = 0.5 * (growth + decay);
    let across = 0.5 * (growth - decay);
    let c = cos(z.y);
    let s = sin(z.y);
    return vec4f(across * c, along * s, along * c, across * s);
}

/// sinh z.
fn complex_sinh(z: vec2f) -> vec2f {
    return complex_sinhcosh(z).xy;
}

/// cosh z.
fn complex_cosh(z: vec2f) -> vec2f {
    return complex_sinhcosh(z).zw;
}

/// (sin z, cos z).
fn complex_sincos(z: vec2f) -> vec4f {
    let waves = complex_sinhcosh(vec2f(-z.y, z.x));
    return vec4f(waves.y, -waves.x, waves.z, waves.w);
}

/// sin z.
fn complex_sin(z: vec2f) -> vec2f {
    return complex_sincos(z).xy;
}

/// cos z.
fn complex_cos(z: vec2f) -> vec2f {
    return complex_sincos(z).zw;
}
