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

    fn c_helper(&self, name: String, result: &str, parameters: &str, value: &str) -> String {
        let text =
            format!("static inline {result} {name}({parameters}) {{\n    return {value};\n}}\n");
        self.helpers.borrow_mut().insert(name.clone(), text);
        name
    }

    fn c_each(&self, size: usize, part: impl Fn(&str) -> String) -> String {
        let parts: Vec<String> = LETTERS[..size.min(4)].iter().map(|c| part(c)).collect();
        self.vectors
            .borrow_mut()
            .insert(u8::try_from(size).unwrap_or(4));
        format!("(vec{size}){{{}}}", parts.join(", "))
    }

    /// A vector of equal components.
    pub(super) fn c_splat(&self, size: usize) -> String {
        let value = self.c_each(size, |_| "s".to_owned());
        let ty = format!("vec{size}");
        self.c_helper(format!("vec{size}_all"), &ty, "float s", &value)
    }

    /// `a op b` by components.
    pub(super) fn c_binary(&self, size: usize, op: &str) -> Option<String> {
        let word = match op {
            "+" => "add",
            "-" => "sub",
            "*" => "mul",
            "/" => "div",
            _ => return None,
        };
        let value = self.c_each(size, |c| format!("a.{c} {op} b.{c}"));
        let ty = format!("vec{size}");
        Some(self.c_helper(
            format!("vec{size}_{word}"),
            &ty,
            &format!("{ty} a, {ty} b"),
            &value,
        ))
    }

    /// Each component by a number: `*` or `/`.
    pub(super) fn c_scaled(&self, size: usize, op: &str) -> Option<String> {
        let word = match op {
            "*" => "scale",
            "/" => "over",
            "+" => "plus",
            "-" => "minus",
            _ => return None,
        };
        let value = self.c_each(size, |c| format!("v.{c} {op} s"));
        let ty = format!("vec{size}");
        Some(self.c_helper(
            format!("vec{size}_{word}"),
            &ty,
            &format!("{ty} v, float s"),
            &value,
        ))
    }

    pub(super) fn c_negated(&self, size: usize) -> String {
        let value = self.c_each(size, |c| format!("-v.{c}"));
        let ty = format!("vec{size}");
        self.c_helper(format!("vec{size}_neg"), &ty, &format!("{ty} v"), &value)
    }

    /// Some components of a vector as a vector, such as `vec4_xy`.
    pub(super) fn c_swizzle(&self, from: usize, letters: &str) -> String {
        let size = letters.len();
        let parts: Vec<String> = letters.chars().map(|c| format!("v.{c}")).collect();
        let sizes = [size, from].map(|n| u8::try_from(n).unwrap_or(4));
        self.vectors.borrow_mut().extend(sizes);
        self.c_helper(
            format!("vec{from}_{letters}"),
            &format!("vec{size}"),
            &format!("vec{from} v"),
            &format!("(vec{size}){{{}}}", parts.join(", ")),
        )
    }

    /// A vector of parts some of which are vectors.
    pub(super) fn c_joined(&self, sizes: &[usize]) -> String {
        let (mut parameters, mut parts) = (Vec::new(), Vec::new());
        let mut name = "vec".to_owned() + &sizes.iter().sum::<usize>().to_string() + "_of";
        for (k, &size) in sizes.iter().enumerate() {
            name.push_str(&format!("_{size}"));
            let word = ["a", "b", "c", "d"][k.min(3)];
            if size == 1 {
                parameters.push(format!("float {word}"));
                parts.push(word.to_owned());
            } else {
                parameters.push(format!("vec{size} {word}"));
                parts.extend(LETTERS[..size].iter().map(|c| format!("{word}.{c}")));
            }
        }
        let ty = format!("vec{}", parts.len());
        self.c_helper(
            name,
            &ty,
            &parameters.join(", "),
            &format!("({ty}){{{}}}", parts.join(", ")),
        )
    }

    /// A function of vectors that gives a number or a vector.
    pub(super) fn c_vector_function(&self, size: usize, word: &str) -> Option<String> {
        let sum = |part: &dyn Fn(&str) -> String| {
            let parts: Vec<String> = LETTERS[..size].iter().map(|c| part(c)).collect();
            parts.join(" + ")
        };
        let ty = format!("vec{size}");
        let (result, parameters, value) = match word {
            "dot" => (
                "float",
                format!("{ty} a, {ty} b"),
                sum(&|c| format!("a.{c} * b.{c}")),
            ),
            "length" => (
                "float",
                format!("{ty} v"),
                format!("sqrtf({})", sum(&|c| format!("v.{c} * v.{c}"))),
            ),
            "abs" => (
                ty.as_str(),
                format!("{ty} v"),
                self.c_each(size, |c| format!("fabsf(v.{c})")),
            ),
            "floor" => (
                ty.as_str(),
                format!("{ty} v"),
                self.c_each(size, |c| format!("floorf(v.{c})")),
            ),
            "min" | "max" => (
                ty.as_str(),
                format!("{ty} a, {ty} b"),
                self.c_each(size, |c| format!("f{word}f(a.{c}, b.{c})")),
            ),
            _ => return None,
        };
        Some(self.c_helper(format!("vec{size}_{word}"), result, &parameters, &value))
    }
}

const LETTERS: [&str; 4] = ["x", "y", "z", "w"];

/// The type of vectors of C.
pub(super) fn c_vector(size: u8) -> String {
    let members = LETTERS[..usize::from(size.min(4))].join(", ");
    format!("typedef struct {{\n    float {members};\n}} vec{size};\n")
}
