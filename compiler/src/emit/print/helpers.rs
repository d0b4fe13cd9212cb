//! Functions that a language lacks, written out where a text calls them.

use super::Printer;
use super::dialect::Dialect;

/// Names of all helpers, which nothing else may have.
pub(super) const NAMES: &[&str] = &[
    "bits_of_float",
    "float_of_bits",
    "int_of_float",
    "uint_of_float",
    "clamp_float",
    "clamp_int",
    "clamp_uint",
    "min_int",
    "max_int",
    "min_uint",
    "max_uint",
    "sign_float",
    "sign_int",
    "fract_float",
    "mix_float",
    "step_float",
    "smoothstep_float",
    "saturate_float",
    "leading_zeros",
    "inverse_sinh",
    "inverse_cosh",
    "inverse_tanh",
];

/// Bodies of the helpers of C, behind `static inline`.
const C: &[(&str, &str)] = &[
    (
        "bits_of_float",
        "uint32_t bits_of_float(float value) {
    union { float value; uint32_t bits; } both = {value};
    return both.bits;
}",
    ),
    (
        "float_of_bits",
        "float float_of_bits(uint32_t bits) {
    union { uint32_t bits; float value; } both = {bits};
    return both.value;
}",
    ),
    (
        "int_of_float",
        "int32_t int_of_float(float x) {
    if (x != x) {
        return 0;
    }
    return x >= 2147483648.0f ? INT32_MAX : x <= -2147483648.0f ? INT32_MIN : (int32_t)x;
}",
    ),
    (
        "uint_of_float",
        "uint32_t uint_of_float(float x) {
    if (!(x > 0.0f)) {
        return 0u;
    }
    return x >= 4294967296.0f ? UINT32_MAX : (uint32_t)x;
}",
    ),
    (
        "clamp_float",
        "float clamp_float(float x, float lo, float hi) {
    return fminf(fmaxf(x, lo), hi);
}",
    ),
    (
        "clamp_int",
        "int32_t clamp_int(int32_t x, int32_t lo, int32_t hi) {
    return x < lo ? lo : x > hi ? hi : x;
}",
    ),
    (
        "clamp_uint",
        "uint32_t clamp_uint(uint32_t x, uint32_t lo, uint32_t hi) {
    return x < lo ? lo : x > hi ? hi : x;
}",
    ),
    (
        "min_int",
        "int32_t min_int(int32_t a, int32_t b) {
    return a < b ? a : b;
}",
    ),
    (
        "max_int",
        "int32_t max_int(int32_t a, int32_t b) {
    return a > b ? a : b;
}",
    ),
    (
        "min_uint",
        "uint32_t min_uint(uint32_t a, uint32_t b) {
    return a < b ? a : b;
}",
    ),
    (
        "max_uint",
        "uint32_t max_uint(uint32_t a, uint32_t b) {
    return a > b ? a : b;
}",
    ),
    (
        "sign_float",
        "float sign_float(float x) {
    return (float)(x > 0.0f) - (float)(x < 0.0f);
}",
    ),
    (
        "sign_int",
        "int32_t sign_int(int32_t x) {
    return (x > 0) - (x < 0);
}",
    ),
    (
        "fract_float",
        "float fract_float(float x) {
    return x - floorf(x);
}",
    ),
    (
        "mix_float",
        "float mix_float(float a, float b, float t) {
    return a * (1.0f - t) + b * t;
}",
    ),
    (
        "step_float",
        "float step_float(float edge, float x) {
    return x < edge ? 0.0f : 1.0f;
}",
    ),
    (
        "smoothstep_float",
        "float smoothstep_float(float low, float high, float x) {
    float t = fminf(fmaxf((x - low) / (high - low), 0.0f), 1.0f);
    return t * t * (3.0f - 2.0f * t);
}",
    ),
    (
        "saturate_float",
        "float saturate_float(float x) {
    return fminf(fmaxf(x, 0.0f), 1.0f);
}",
    ),
    (
        "leading_zeros",
        "uint32_t leading_zeros(uint32_t x) {
    uint32_t count = 0u;
    while (count < 32u && (x & 0x80000000u) == 0u) {
        x <<= 1u;
        count += 1u;
    }
    return count;
}",
    ),
];

/// Helpers of GLSL.
const GLSL: &[(&str, &str)] = &[(
    "leading_zeros",
    "uint leading_zeros(uint x) {
    uint count = 0u;
    while (count < 32u && (x & 0x80000000u) == 0u) {
        x <<= 1u;
        count += 1u;
    }
    return count;
}",
)];

/// Helpers of HLSL: Abramowitz and Stegun, 4.6.20 to 4.6.22.
const HLSL: &[(&str, &str)] = &[
    (
        "inverse_sinh",
        "float inverse_sinh(float x) {
    float a = abs(x);
    return sign(x) * log(a + sqrt(a * a + 1.0));
}",
    ),
    (
        "inverse_cosh",
        "float inverse_cosh(float x) {
    return log(x + sqrt(x * x - 1.0));
}",
    ),
    (
        "inverse_tanh",
        "float inverse_tanh(float x) {
    return 0.5 * log((1.0 + x) / (1.0 - x));
}",
    ),
];

impl Printer<'_> {
    /// The name of a helper, whose text is then part of the module.
    pub(super) fn helper(&self, name: &str) -> Result<String, String> {
        let (table, before) = match self.dialect {
            Dialect::C => (C, "static inline "),
            Dialect::Glsl | Dialect::Godot => (GLSL, ""),
            Dialect::Hlsl => (HLSL, ""),
            Dialect::Wgsl | Dialect::Msl => (&[][..], ""),
        };
        let found = table.iter().find(|(known, _)| *known == name);
        let (_, text) = found.ok_or_else(|| format!("`{name}`"))?;
        let text = format!("{before}{text}\n");
        self.helpers.borrow_mut().insert(name.to_owned(), text);
        Ok(name.to_owned())
    }
}
