//! Independent judges of emitted code: naga's parser, and what compilers and validators of other people are installed.

use std::io::Write as _;
use std::process::{Command, Stdio};

use pullback_compiler::{EmitWhat, Target};

/// What a judge said.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It accepts the code.
    Accepted,
    /// It does not, and says why.
    Rejected(String),
    /// It is not installed here.
    Absent,
}

/// A judge with its verdict.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Judgement {
    /// Which program it is, and what it took the code for.
    pub judge: String,
    /// What it said.
    pub verdict: Verdict,
}

/// How a program reads code from its standard input.
struct Judge {
    program: &'static str,
    arguments: &'static [&'static str],
    /// What is set before and behind the code, so that it is a whole program.
    around: (&'static str, &'static str),
    taken_for: &'static str,
}

const GLSL_MAIN: &str =
    "\nout vec4 color_of_pixel;\nvoid main() {\n    color_of_pixel = vec4(0.0);\n}\n";
const GLSL: &[Judge] = &[
    Judge {
        program: "glslangValidator",
        arguments: &["--stdin", "-S", "frag"],
        around: ("#version 330 core\n", GLSL_MAIN),
        taken_for: "GLSL 3.30",
    },
    Judge {
        program: "glslangValidator",
        arguments: &["--stdin", "-S", "frag"],
        around: (
            "#version 300 es\nprecision highp float;\nprecision highp int;\n",
            GLSL_MAIN,
        ),
        taken_for: "GLSL ES 3.00",
    },
];
const SHADERTOY: &[Judge] = &[Judge {
    program: "glslangValidator",
    arguments: &["--stdin", "-S", "frag"],
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
const GODOT: &[Judge] = &[Judge {
    program: "glslangValidator",
    arguments: &["--stdin", "-S", "frag"],
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
",
        "\nvoid main() {\n    fragment();\n    COLOR.rgb += ALBEDO;\n}\n",
    ),
    taken_for: "GLSL with Godot's built-in variables",
}];
const HLSL: &[Judge] = &[Judge {
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
    around: (
        "",
        "\nfloat4 main() : SV_Target {\n    return float4(0, 0, 0, 0);\n}\n",
    ),
    taken_for: "HLSL",
}];
const C: &[Judge] = &[
    Judge {
        program: "gcc",
        arguments: &C_FLAGS,
        around: ("", ""),
        taken_for: "C11, warnings as errors",
    },
    Judge {
        program: "clang",
        arguments: &C_FLAGS,
        around: ("", ""),
        taken_for: "C11, warnings as errors",
    },
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
const SPIRV: &[Judge] = &[Judge {
    program: "spirv-val",
    arguments: &["--target-env", "spv1.3", "-"],
    around: ("", ""),
    taken_for: "SPIR-V 1.3",
}];

/// Asks everyone who can judge code for a target. Of a language that nobody here can read, the answer is empty.
#[must_use]
pub fn judge(code: &[u8], target: Target, what: &[EmitWhat]) -> Vec<Judgement> {
    let text = String::from_utf8_lossy(code).into_owned();
    let is_scene = what.contains(&EmitWhat::Scene);
    match target {
        Target::Wgsl => vec![by_naga(&text)],
        Target::Bevy => {
            let path = text.lines().next().unwrap_or("");
            vec![by_naga(&text.replacen(path, "", 1))]
        }
        Target::Tsl => vec![by_naga(&strings(&text))],
        Target::Three => all(GLSL, strings(&text).as_bytes()),
        Target::Glsl if is_scene => vec![ask(
            &Judge {
                program: "glslangValidator",
                arguments: &["--stdin", "-S", "frag"],
                around: ("", ""),
                taken_for: "GLSL 4.50",
            },
            code,
        )],
        Target::Glsl => all(GLSL, code),
        Target::Shadertoy => all(SHADERTOY, code),
        Target::Godot => all(GODOT, plain_glsl(&text).as_bytes()),
        Target::Hlsl if is_scene => vec![ask(
            &Judge {
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
                around: ("", ""),
                taken_for: "HLSL",
            },
            code,
        )],
        Target::Hlsl => all(HLSL, code),
        Target::C => all(C, code),
        Target::Spirv => all(SPIRV, code),
        _ => Vec::new(),
    }
}

fn all(judges: &[Judge], code: &[u8]) -> Vec<Judgement> {
    judges.iter().map(|judge| ask(judge, code)).collect()
}

/// What stands between backquotes.
fn strings(script: &str) -> String {
    let parts: Vec<&str> = script.split('`').skip(1).step_by(2).collect();
    parts.join("\n")
}

/// A shader of Godot as GLSL: without its kind and modes, and without hints at uniforms.
fn plain_glsl(shader: &str) -> String {
    let line = |line: &str| {
        if line.starts_with("shader_type") || line.starts_with("render_mode") {
            return String::new();
        }
        match (line.starts_with("uniform"), line.split_once(" : ")) {
            (true, Some((declared, hint))) => {
                let end = hint
                    .split_once(" = ")
                    .map_or(";".to_owned(), |(_, v)| format!(" = {v}"));
                format!("{declared}{end}")
            }
            _ => line.to_owned(),
        }
    };
    let lines: Vec<String> = shader.lines().map(line).collect();
    // what a vertex shader sets is only read in GLSL's fragment stage
    lines
        .join("\n")
        .replace("back = VERTEX;", "back = VERTEX.xyz;")
}

fn by_naga(text: &str) -> Judgement {
    let verdict = match naga::front::wgsl::parse_str(text) {
        Err(error) => Verdict::Rejected(error.emit_to_string(text)),
        Ok(module) => {
            let flags = naga::valid::ValidationFlags::all();
            let capabilities = naga::valid::Capabilities::all();
            match naga::valid::Validator::new(flags, capabilities).validate(&module) {
                Ok(_) => Verdict::Accepted,
                Err(error) => Verdict::Rejected(error.emit_to_string(text)),
            }
        }
    };
    Judgement {
        judge: "naga (WGSL)".to_owned(),
        verdict,
    }
}

fn ask(judge: &Judge, code: &[u8]) -> Judgement {
    let (before, behind) = judge.around;
    let input = [before.as_bytes(), code, behind.as_bytes()].concat();
    Judgement {
        judge: format!("{} ({})", judge.program, judge.taken_for),
        verdict: run(judge, &input),
    }
}

fn run(judge: &Judge, input: &[u8]) -> Verdict {
    let started = Command::new(judge.program)
        .args(judge.arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn();
    let Ok(mut child) = started else {
        return Verdict::Absent;
    };
    if let Some(mut stdin) = child.stdin.take() {
        // a program that stops early says why on its output
        let _ = stdin.write_all(input);
    }
    match child.wait_with_output() {
        Ok(output) if output.status.success() => Verdict::Accepted,
        Ok(output) => {
            let text = [output.stdout, output.stderr].concat();
            Verdict::Rejected(String::from_utf8_lossy(&text).into_owned())
        }
        Err(error) => Verdict::Rejected(error.to_string()),
    }
}
