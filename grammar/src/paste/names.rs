//! Names of functions, constants and types elsewhere, and ours.
//!
//! A name is only read as another where it means nothing else in the program.

/// Our name of a function that has another name elsewhere and means the same.
pub(crate) fn function_of(name: &str) -> Option<&'static str> {
    Some(match name {
        // mathematics books
        "tg" => "tan",
        "ctg" | "cotg" | "cotan" | "ctan" => "cot",
        "cosec" => "csc",
        "arctg" => "atan",
        "sh" => "sinh",
        "ch" => "cosh",
        "th" => "tanh",
        "cth" => "coth",
        "arsh" | "arcsinh" | "argsinh" => "asinh",
        "arch" | "arccosh" | "argcosh" => "acosh",
        "arth" | "arctanh" | "argtanh" => "atanh",
        "Re" => "re",
        "Im" => "im",
        "Arg" | "phase" | "angle" => "arg",
        "conjugate" | "Conjugate" => "conj",
        "Ln" | "Log" => "log",
        "signum" => "sign",
        "Heaviside" | "HeavisideTheta" => "heaviside",
        // C, and the f that it adds for single precision
        "fabs" | "fabsf" | "cabs" => "abs",
        "sinf" => "sin",
        "cosf" => "cos",
        "tanf" => "tan",
        "asinf" => "asin",
        "acosf" => "acos",
        "atanf" => "atan",
        "atan2f" | "arctan2" => "atan2",
        "sinhf" => "sinh",
        "coshf" => "cosh",
        "tanhf" => "tanh",
        "expf" => "exp",
        "exp2f" => "exp2",
        "logf" => "log",
        "log2f" => "log2",
        "log10f" => "log10",
        "sqrtf" => "sqrt",
        "cbrtf" => "cbrt",
        "powf" | "power" | "Power" => "pow",
        "floorf" => "floor",
        "ceilf" | "ceiling" | "Ceiling" => "ceil",
        "truncf" => "trunc",
        "fmodf" => "fmod",
        "hypotf" => "hypot",
        "fmin" | "fminf" | "minimum" | "Min" => "min",
        "fmax" | "fmaxf" | "maximum" | "Max" => "max",
        "tgamma" | "Gamma" => "gamma",
        // shading languages
        "rsqrt" | "inverseSqrt" => "inversesqrt",
        "vec2f" | "vec2h" | "float2" | "half2" | "double2" | "dvec2" => "vec2",
        "vec3f" | "vec3h" | "float3" | "half3" | "double3" | "dvec3" => "vec3",
        "vec4f" | "vec4h" | "float4" | "half4" | "double4" | "dvec4" => "vec4",
        // NumPy
        "absolute" | "Abs" => "abs",
        "clip" => "clamp",
        "norm" | "Norm" => "length",
        // Mathematica
        "Sin" => "sin",
        "Cos" => "cos",
        "Tan" => "tan",
        "Cot" => "cot",
        "Sec" => "sec",
        "Csc" => "csc",
        "ArcSin" => "asin",
        "ArcCos" => "acos",
        "ArcTan" => "atan",
        "Sinh" => "sinh",
        "Cosh" => "cosh",
        "Tanh" => "tanh",
        "Coth" => "coth",
        "Sech" => "sech",
        "Csch" => "csch",
        "ArcSinh" => "asinh",
        "ArcCosh" => "acosh",
        "ArcTanh" => "atanh",
        "Exp" => "exp",
        "Log2" => "log2",
        "Log10" => "log10",
        "Sqrt" => "sqrt",
        "CubeRoot" => "cbrt",
        "Sign" => "sign",
        "Floor" => "floor",
        "Mod" => "mod",
        "Clip" => "clamp",
        _ => return None,
    })
}

/// Our name of a constant.
pub(crate) fn value_of(name: &str) -> Option<&'static str> {
    Some(match name {
        "PI" | "Pi" | "M_PI" => "pi",
        "TAU" | "M_TAU" => "tau",
        "M_E" => "e",
        "GoldenRatio" => "phi",
        "INFINITY" | "Infinity" | "Inf" => "inf",
        "NAN" | "NaN" => "nan",
        "True" => "true",
        "False" => "false",
        _ => return None,
    })
}

/// Our name of a type.
pub(crate) fn type_of(name: &str) -> Option<&'static str> {
    Some(match name {
        "float" | "double" | "half" | "f16" | "f32" | "f64" => "real",
        "vec2f" | "vec2h" | "float2" | "half2" | "double2" | "dvec2" => "vec2",
        "vec3f" | "vec3h" | "float3" | "half3" | "double3" | "dvec3" => "vec3",
        "vec4f" | "vec4h" | "float4" | "half4" | "double4" | "dvec4" => "vec4",
        _ => return None,
    })
}

/// Whether a call of this name converts a number to a real, which it is here.
pub(crate) fn is_conversion(name: &str) -> bool {
    matches!(
        name,
        "float" | "double" | "half" | "f16" | "f32" | "f64" | "float64"
    )
}

/// Whether the name, directly behind a number, may be the mark of its type: behind any, and behind one without a point.
pub(crate) fn is_type_mark(name: &str, has_point: bool) -> bool {
    match name {
        "f" | "F" | "h" | "H" | "lf" | "LF" | "j" | "J" => true,
        "u" | "U" | "l" | "L" => !has_point,
        _ => false,
    }
}

/// Whether the name stands before the `.` of what NumPy, JavaScript and others collect there.
pub(crate) fn is_namespace(name: &str) -> bool {
    matches!(
        name,
        "np" | "numpy" | "math" | "Math" | "cmath" | "jnp" | "torch" | "sympy" | "mpmath" | "mp"
    )
}

/// Whether definitions begin with this word elsewhere, and the value is what it is here.
pub(super) fn is_defining_word(word: &str) -> bool {
    matches!(
        word,
        "let"
            | "var"
            | "val"
            | "const"
            | "auto"
            | "static"
            | "set"
            | "local"
            | "real"
            | "complex"
            | "vec2"
            | "vec3"
            | "vec4"
    ) || type_of(word).is_some()
}

/// Whether definitions of functions begin with this word elsewhere.
pub(super) fn is_function_word(word: &str) -> bool {
    matches!(word, "def" | "define" | "fn" | "fun" | "func" | "function")
}
