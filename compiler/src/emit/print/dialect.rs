//! How the languages differ, word by word.

use naga::{MathFunction, Scalar, ScalarKind, VectorSize};

/// A family of languages with one grammar.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Dialect {
    /// WGSL.
    Wgsl,
    /// The common part of GLSL 3.30, GLSL ES 3.00 and later ones.
    Glsl,
    /// The shading language of Godot 4, which is GLSL ES 3.00 but for its entry points.
    Godot,
    /// HLSL.
    Hlsl,
    /// The Metal shading language.
    Msl,
    /// C11.
    C,
}

impl Dialect {
    pub(super) fn is_glsl(self) -> bool {
        matches!(self, Self::Glsl | Self::Godot)
    }

    /// The name of a scalar type.
    pub(super) fn scalar(self, scalar: Scalar) -> Result<&'static str, String> {
        if scalar.kind != ScalarKind::Bool && scalar.width != 4 {
            return Err("numbers of 64 bits".to_owned());
        }
        Ok(match (self, scalar.kind) {
            (_, ScalarKind::Bool) => "bool",
            (Self::Wgsl, ScalarKind::Float) => "f32",
            (Self::Wgsl, ScalarKind::Sint) => "i32",
            (Self::Wgsl, ScalarKind::Uint) => "u32",
            (_, ScalarKind::Float) => "float",
            (Self::C, ScalarKind::Sint) => "int32_t",
            (Self::C, ScalarKind::Uint) => "uint32_t",
            (_, ScalarKind::Sint) => "int",
            (_, ScalarKind::Uint) => "uint",
            _ => return Err("an abstract number".to_owned()),
        })
    }

    /// The name of a vector type.
    pub(super) fn vector(self, size: VectorSize, scalar: Scalar) -> Result<String, String> {
        let n = size as u8;
        let word = self.scalar(scalar)?;
        let letter = match scalar.kind {
            ScalarKind::Float => "f",
            ScalarKind::Sint => "i",
            ScalarKind::Uint => "u",
            _ => "b",
        };
        Ok(match self {
            Self::Wgsl if letter == "b" => format!("vec{n}<bool>"),
            Self::Wgsl => format!("vec{n}{letter}"),
            Self::Glsl | Self::Godot | Self::C if letter == "f" => format!("vec{n}"),
            Self::Glsl | Self::Godot | Self::C => format!("{letter}vec{n}"),
            Self::Hlsl | Self::Msl => format!("{word}{n}"),
        })
    }

    /// A number of single precision.
    pub(super) fn float(self, value: f32) -> String {
        let digits = format!("{value:?}");
        let digits = match digits.split_once('e') {
            // all of these languages read 1e9, and people know it
            Some((head, tail)) => format!("{}e{tail}", head.strip_suffix(".0").unwrap_or(head)),
            None => digits,
        };
        match self {
            Self::C | Self::Msl => {
                let point = if digits.contains(['.', 'e']) {
                    ""
                } else {
                    ".0"
                };
                format!("{digits}{point}f")
            }
            _ => digits,
        }
    }

    /// A whole number without sign; patterns of bits in base 16.
    pub(super) fn unsigned(self, value: u32) -> String {
        let is_pattern =
            value > 0xffff && (value & 0xffff == 0 || value & 0xfff == 0xfff || value & 0xfff == 0);
        if is_pattern {
            format!("{value:#x}u")
        } else {
            format!("{value}u")
        }
    }

    /// A whole number.
    pub(super) fn signed(self, value: i32) -> String {
        match (self, value) {
            (Self::Wgsl, i32::MIN) => "i32(-2147483648)".to_owned(),
            (Self::C, i32::MIN) => "(-2147483647 - 1)".to_owned(),
            (_, i32::MIN) => "int(0x80000000u)".to_owned(),
            _ => value.to_string(),
        }
    }

    /// What a built-in function is called. `None` where the language has none of this name: then there is a helper.
    pub(super) fn math(self, fun: MathFunction, kind: ScalarKind) -> Option<&'static str> {
        use MathFunction as F;
        if self == Self::C {
            return c_math(fun, kind);
        }
        Some(match (fun, self) {
            (F::Abs, _) => "abs",
            (F::Min, _) => "min",
            (F::Max, _) => "max",
            (F::Clamp, _) => "clamp",
            (F::Saturate, Self::Wgsl | Self::Hlsl | Self::Msl) => "saturate",
            (F::Cos, _) => "cos",
            (F::Cosh, _) => "cosh",
            (F::Sin, _) => "sin",
            (F::Sinh, _) => "sinh",
            (F::Tan, _) => "tan",
            (F::Tanh, _) => "tanh",
            (F::Acos, _) => "acos",
            (F::Asin, _) => "asin",
            (F::Atan, _) => "atan",
            (F::Atan2, Self::Glsl | Self::Godot) => "atan",
            (F::Atan2, _) => "atan2",
            (F::Asinh | F::Acosh | F::Atanh, Self::Hlsl) => return None,
            (F::Asinh, _) => "asinh",
            (F::Acosh, _) => "acosh",
            (F::Atanh, _) => "atanh",
            (F::Ceil, _) => "ceil",
            (F::Floor, _) => "floor",
            (F::Trunc, _) => "trunc",
            (F::Round, Self::Glsl | Self::Godot) => "roundEven",
            (F::Round, Self::Msl) => "rint",
            (F::Round, _) => "round",
            (F::Fract, Self::Hlsl) => "frac",
            (F::Fract, _) => "fract",
            (F::Exp, _) => "exp",
            (F::Exp2, _) => "exp2",
            (F::Log, _) => "log",
            (F::Log2, _) => "log2",
            (F::Pow, _) => "pow",
            (F::Dot, _) => "dot",
            (F::Cross, _) => "cross",
            (F::Distance, _) => "distance",
            (F::Length, _) => "length",
            (F::Normalize, _) => "normalize",
            (F::Reflect, _) => "reflect",
            (F::Sign, _) => "sign",
            (F::Fma, Self::Hlsl) => "mad",
            (F::Fma, Self::Glsl | Self::Godot) => return None,
            (F::Fma, _) => "fma",
            (F::Mix, Self::Hlsl) => "lerp",
            (F::Mix, _) => "mix",
            (F::Step, _) => "step",
            (F::SmoothStep, _) => "smoothstep",
            (F::Sqrt, _) => "sqrt",
            (F::InverseSqrt, Self::Wgsl) => "inverseSqrt",
            (F::InverseSqrt, Self::Glsl | Self::Godot) => "inversesqrt",
            (F::InverseSqrt, _) => "rsqrt",
            (F::Radians, Self::Wgsl | Self::Glsl | Self::Godot | Self::Hlsl) => "radians",
            (F::Degrees, Self::Wgsl | Self::Glsl | Self::Godot | Self::Hlsl) => "degrees",
            (F::CountLeadingZeros, Self::Wgsl) => "countLeadingZeros",
            (F::CountLeadingZeros, Self::Msl) => "clz",
            (F::CountTrailingZeros, Self::Wgsl) => "countTrailingZeros",
            (F::CountOneBits, Self::Wgsl) => "countOneBits",
            (F::ReverseBits, Self::Wgsl) => "reverseBits",
            (F::FirstLeadingBit, Self::Wgsl) => "firstLeadingBit",
            (F::FirstTrailingBit, Self::Wgsl) => "firstTrailingBit",
            _ => return None,
        })
    }
}

fn c_math(fun: MathFunction, kind: ScalarKind) -> Option<&'static str> {
    use MathFunction as F;
    if kind == ScalarKind::Sint && fun == F::Abs {
        return Some("abs");
    }
    if kind != ScalarKind::Float {
        return None;
    }
    Some(match fun {
        F::Abs => "fabsf",
        F::Min => "fminf",
        F::Max => "fmaxf",
        F::Cos => "cosf",
        F::Cosh => "coshf",
        F::Sin => "sinf",
        F::Sinh => "sinhf",
        F::Tan => "tanf",
        F::Tanh => "tanhf",
        F::Acos => "acosf",
        F::Asin => "asinf",
        F::Atan => "atanf",
        F::Atan2 => "atan2f",
        F::Asinh => "asinhf",
        F::Acosh => "acoshf",
        F::Atanh => "atanhf",
        F::Ceil => "ceilf",
        F::Floor => "floorf",
        F::Trunc => "truncf",
        F::Round => "rintf",
        F::Exp => "expf",
        F::Exp2 => "exp2f",
        F::Log => "logf",
        F::Log2 => "log2f",
        F::Pow => "powf",
        F::Fma => "fmaf",
        F::Sqrt => "sqrtf",
        _ => return None,
    })
}
