//! Independent judges of emitted code: naga's parser, and what compilers and validators of other people are installed.

use std::io::Write as _;
use std::process::{Command, Stdio};

use pullback_compiler::{EmitWhat, Target};

use judges::{Input, Judge};

pub mod browser;
pub mod godot;
mod hosted;
mod judges;
mod metal;

pub use hosted::{judge_in_browser, three};

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

/// Asks everyone who can judge code for a target. Of a language that nobody here can read, the answer is empty.
#[must_use]
pub fn judge(code: &[u8], target: Target, what: &[EmitWhat]) -> Vec<Judgement> {
    let text = String::from_utf8_lossy(code).into_owned();
    let is_scene = what.contains(&EmitWhat::Scene);
    match target {
        Target::Wgsl | Target::Bevy | Target::Tsl => {
            let text = judged_text(&text, target);
            let mut out = vec![by_naga(&text)];
            // numbers of 64 bits are an extension of naga's
            if !text.contains("f64") {
                out.extend(all(judges::WGSL, text.as_bytes()));
            }
            out
        }
        Target::Three => all(judges::GLSL, strings(&text).as_bytes()),
        Target::Glsl if is_scene => all(judges::GLSL_SCENE, code),
        Target::Glsl => all(judges::GLSL, code),
        Target::Shadertoy => all(judges::SHADERTOY, code),
        Target::Godot => all(judges::GODOT, plain_glsl(&text).as_bytes()),
        Target::Hlsl if is_scene => all(judges::HLSL_SCENE, code),
        Target::Hlsl => all(judges::HLSL, code),
        Target::Msl if is_scene => {
            let mut out = all(judges::MSL_SCENE, code);
            out.push(Judgement {
                judge: "attributes (by the tables of Metal's specification)".to_owned(),
                verdict: metal::wrong_attributes(&text)
                    .map_or(Verdict::Accepted, Verdict::Rejected),
            });
            out
        }
        Target::Msl => all(judges::MSL, code),
        Target::C => all(judges::C, code),
        Target::Spirv => all(judges::SPIRV, code),
        _ => Vec::new(),
    }
}

/// The WGSL of a text for a host.
fn judged_text(text: &str, target: Target) -> String {
    match target {
        // the line that says how to import it is naga_oil's
        Target::Bevy => text
            .split_once('\n')
            .map_or("", |(_, rest)| rest)
            .to_owned(),
        Target::Tsl => strings(text),
        _ => text.to_owned(),
    }
}

fn all(judges: &[Judge], code: &[u8]) -> Vec<Judgement> {
    // each is a process of its own, so that they may work side by side
    std::thread::scope(|scope| {
        let asked: Vec<_> = judges
            .iter()
            .map(|judge| scope.spawn(move || ask(judge, code)))
            .collect();
        let answers = asked.into_iter();
        answers.filter_map(|answer| answer.join().ok()).collect()
    })
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

/// A program that is installed, or that the script `pullback` has got.
fn command(program: &str) -> Command {
    let Some(kept) = browser::judges() else {
        return Command::new(program);
    };
    let path = kept.join("bin").join(program);
    if !path.exists() {
        return Command::new(program);
    }
    let mut command = Command::new(path);
    // the one that is a script over a library
    if std::env::var_os("DXC_LIBRARY").is_none() {
        command.env("DXC_LIBRARY", kept.join("dxc").join(judges::DXC_LIBRARY));
    }
    command
}

/// Starts a program and gives it the code.
fn run(judge: &Judge, code: &[u8]) -> Verdict {
    let Ok(folder) = tempfile::tempdir() else {
        return Verdict::Absent;
    };
    let mut command = command(judge.program);
    let written = match judge.input {
        Input::Standard => Ok(()),
        Input::File(name) => {
            let path = folder.path().join(name);
            let written = std::fs::write(&path, code);
            command.args(judge.arguments).arg(path);
            written
        }
        Input::Headers(headers) => {
            command.arg("-I").arg(folder.path());
            headers.iter().try_for_each(|(name, text)| {
                let path = folder.path().join(name);
                path.parent().map_or(Ok(()), std::fs::create_dir_all)?;
                std::fs::write(path, text)
            })
        }
    };
    if let Err(error) = written {
        return Verdict::Rejected(error.to_string());
    }
    let is_file = matches!(judge.input, Input::File(_));
    if !is_file {
        command.args(judge.arguments);
    }
    let started = command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn();
    let Ok(mut child) = started else {
        return Verdict::Absent;
    };
    if let Some(mut stdin) = child.stdin.take()
        && !is_file
    {
        // a program that stops early says why on its output
        let _ = stdin.write_all(code);
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
