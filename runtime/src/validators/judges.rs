//! Compilers and validators of other people: how each is asked, and what it takes the code for.

/// How a program gets what it judges.
#[derive(Clone, Copy, Debug)]
pub(super) enum Input {
    /// From its standard input.
    Standard,
    /// As a file of this name, the last argument.
    File(&'static str),
    /// From its standard input, with a folder of headers before the other arguments: paths and texts.
    Headers(&'static [(&'static str, &'static str)]),
}

/// A program that reads code.
#[derive(Clone, Copy, Debug)]
pub(super) struct Judge {
    pub(super) program: &'static str,
    pub(super) arguments: &'static [&'static str],
    pub(super) input: Input,
    /// What is set before and behind the code, so that it is a whole program.
    pub(super) around: (&'static str, &'static str),
    pub(super) taken_for: &'static str,
}

const GLSL_MAIN: &str =
    "\nout vec4 color_of_pixel;\nvoid main() {\n    color_of_pixel = vec4(0.0);\n}\n";
pub(super) const GLSL: &[Judge] = &[
    Judge {
        program: "glslangValidator",
        arguments: &["--stdin", "-S", "frag"],
        input: Input::Standard,
        around: ("#version 330 core\n", GLSL_MAIN),
        taken_for: "GLSL 3.30",
    },
    Judge {
        program: "glslangValidator",
        arguments: &["--stdin", "-S", "frag"],
        input: Input::Standard,
        around: (
            "#version 300 es\nprecision highp float;\nprecision highp int;\n",
            GLSL_MAIN,
        ),
        taken_for: "GLSL ES 3.00",
    },
];
pub(super) const SHADERTOY: &[Judge] = &[Judge {
    program: "glslangValidator",
    arguments: &["--stdin", "-S", "frag"],
    input: Input::Standard,
    around: (
        "#version 300 es
precision highp float;
precision highp int;
uniform vec3 iResolution;
uniform float iTime;
uniform vec4 iMouse;
",
        "\nout vec4 color_of_pixel;\nvoid main() {\n    mainImage(color_of_pixel, gl_FragCoord.xy);\n}\n",
    ),
    taken_for: "GLSL ES 3.00, with Shadertoy's uniforms",
}];
/// Godot's language is GLSL but for its declarations, which are rewritten, and its built-in variables, which are declared.
pub(super) const GODOT: &[Judge] = &[Judge {
    program: "glslangValidator",
    arguments: &["--stdin", "-S", "frag"],
    input: Input::Standard,
    around: (
        "#version 330 core
uniform float TIME;
uniform vec2 UV;
uniform vec2 SCREEN_UV;
uniform mat4 MODEL_MATRIX;
uniform mat4 INV_PROJECTION_MATRIX;
uniform vec3 CAMERA_POSITION_WORLD;
uniform vec3 VERTEX;
vec3 ALBEDO;
out vec4 COLOR;
#define varying
#define RENDERER_COMPATIBILITY 0
#define CURRENT_RENDERER 1
",
        "\nvoid main() {\n    fragment();\n    COLOR.rgb += ALBEDO;\n}\n",
    ),
    taken_for: "GLSL with Godot's built-in variables",
}];
const HLSL_MAIN: (&str, &str) = (
    "",
    "\nfloat4 main() : SV_Target {\n    return float4(0, 0, 0, 0);\n}\n",
);
pub(super) const HLSL: &[Judge] = &[
    Judge {
        program: "glslangValidator",
        arguments: &[
            "--stdin",
            "-D",
            "-V",
            "-S",
            "frag",
            "-e",
            "main",
            "-o",
            "/dev/null",
        ],
        input: Input::Standard,
        around: HLSL_MAIN,
        taken_for: "HLSL",
    },
    Judge {
        program: "dxc",
        arguments: &["-T", "ps_6_0", "-E", "main"],
        input: Input::File("code.hlsl"),
        around: HLSL_MAIN,
        taken_for: "HLSL, shader model 6.0",
    },
];
/// A whole scene in HLSL, which has its entry points.
pub(super) const HLSL_SCENE: &[Judge] = &[
    Judge {
        program: "glslangValidator",
        arguments: &[
            "--stdin",
            "-D",
            "-V",
            "-S",
            "frag",
            "-e",
            "fragment_main",
            "-o",
            "/dev/null",
        ],
        input: Input::Standard,
        around: ("", ""),
        taken_for: "HLSL",
    },
    Judge {
        program: "dxc",
        arguments: &["-T", "ps_6_0", "-E", "fragment_main"],
        input: Input::File("code.hlsl"),
        around: ("", ""),
        taken_for: "HLSL, shader model 6.0",
    },
];
pub(super) const GLSL_SCENE: &[Judge] = &[Judge {
    program: "glslangValidator",
    arguments: &["--stdin", "-S", "frag"],
    input: Input::Standard,
    around: ("", ""),
    taken_for: "GLSL 4.50",
}];
/// The compiler of Chromium's WebGPU, by itself.
pub(super) const WGSL: &[Judge] = &[Judge {
    program: "tint",
    arguments: &["--format", "wgsl"],
    input: Input::File("code.wgsl"),
    around: ("", ""),
    taken_for: "WGSL",
}];
const METAL_HEADERS: [(&str, &str); 2] = [
    ("metal_stdlib", include_str!("metal_stdlib.h")),
    ("simd/simd.h", ""),
];
/// Where the library of the DirectX shader compiler is among what packages have.
pub(super) const DXC_LIBRARY: &str = "libdxcompiler_x86_64.so.3.7";
/// A whole scene in MSL: attributes are not C++'s, and code that no person writes has names that nothing uses.
pub(super) const MSL_SCENE: &[Judge] = &[Judge {
    program: "clang++",
    arguments: &[
        "-x",
        "c++",
        "-std=c++14",
        "-Wall",
        "-Werror",
        "-Wno-unknown-attributes",
        "-Wno-unused-variable",
        "-Wno-bitwise-instead-of-logical",
        "-Xclang",
        "-cl-single-precision-constant",
        "-fsyntax-only",
        "-",
    ],
    input: Input::Headers(&METAL_HEADERS),
    around: ("", ""),
    taken_for: "MSL as C++14, with a stand-in for Apple's header",
}];
/// The Metal language is C++14 with types and functions of its own, which a header of ours declares.
pub(super) const MSL: &[Judge] = &[Judge {
    program: "clang++",
    arguments: &[
        "-x",
        "c++",
        "-std=c++14",
        "-Wall",
        "-Werror",
        // a literal with a point is a float there
        "-Xclang",
        "-cl-single-precision-constant",
        "-fsyntax-only",
        "-",
    ],
    input: Input::Headers(&METAL_HEADERS),
    around: ("", ""),
    taken_for: "MSL as C++14, with a stand-in for Apple's header",
}];
pub(super) const C: &[Judge] = &[
    Judge {
        program: "gcc",
        arguments: &C_FLAGS,
        input: Input::Standard,
        around: ("", ""),
        taken_for: "C11, warnings as errors",
    },
    Judge {
        program: "clang",
        arguments: &CLANG_FLAGS,
        input: Input::Standard,
        around: ("", ""),
        taken_for: "C11, warnings as errors",
    },
];
/// Its warnings do not need the optimiser, as some of gcc's do.
const CLANG_FLAGS: [&str; 8] = [
    "-std=c11",
    "-Wall",
    "-Wextra",
    "-Werror",
    "-fsyntax-only",
    "-x",
    "c",
    "-",
];
const C_FLAGS: [&str; 11] = [
    "-std=c11",
    "-Wall",
    "-Wextra",
    "-Werror",
    "-O1",
    "-c",
    "-o",
    "/dev/null",
    "-x",
    "c",
    "-",
];
pub(super) const SPIRV: &[Judge] = &[Judge {
    program: "spirv-val",
    arguments: &["--target-env", "spv1.3", "-"],
    input: Input::Standard,
    around: ("", ""),
    taken_for: "SPIR-V 1.3",
}];
