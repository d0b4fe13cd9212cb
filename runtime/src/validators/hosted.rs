//! Judges that run in a browser: the compilers of WGSL and GLSL that Chromium has, three.js, and Godot.

use std::collections::HashMap;

use pullback_compiler::{EmitWhat, Target};

use super::browser::{Silence, Site, ask, judges, literal};
use super::judges::{GLSL, SHADERTOY};
use super::{Judgement, Verdict, godot, judged_text};

const PAGE: &str = include_str!("check.html");
const THREE: &str = include_str!("three.html");
/// The files of three.js that pages import.
pub const LIBRARY: [&str; 4] = [
    "three.core.js",
    "three.module.js",
    "three.webgpu.js",
    "three.tsl.js",
];

/// Asks the judges that need a browser, which takes seconds. Where there is none for a target, the answer is empty.
#[must_use]
pub fn judge_in_browser(code: &[u8], target: Target, what: &[EmitWhat]) -> Vec<Judgement> {
    let text = String::from_utf8_lossy(code).into_owned();
    let is_scene = what.contains(&EmitWhat::Scene);
    let around = |(before, behind): (&str, &str)| format!("{before}{text}{behind}");
    match target {
        // numbers of 64 bits are an extension of naga's
        Target::Wgsl | Target::Bevy if !text.contains("f64") => {
            vec![compiled("wgsl", &judged_text(&text, target))]
        }
        // a scene is in GLSL 4.50, which browsers do not have
        Target::Glsl if is_scene => Vec::new(),
        Target::Glsl => vec![compiled("glsl", &around(GLSL[1].around))],
        Target::Shadertoy => vec![compiled("glsl", &around(SHADERTOY[0].around))],
        Target::Three => vec![by_three(code, "chunks")],
        Target::Tsl => vec![by_three(code, "nodes")],
        Target::Godot => vec![by_godot(text)],
        _ => Vec::new(),
    }
}

/// What a judge's answer means: nothing said is an acceptance.
fn judgement(judge: String, answer: Result<String, Silence>) -> Judgement {
    let verdict = match answer {
        Ok(said) if said.trim().is_empty() => Verdict::Accepted,
        Ok(said) => match said.strip_prefix("missing ") {
            Some(_) => Verdict::Absent,
            None => Verdict::Rejected(said),
        },
        Err(Silence::Missing(_)) => Verdict::Absent,
        Err(Silence::Failed(why)) => Verdict::Rejected(why),
    };
    Judgement { judge, verdict }
}

fn compiled(language: &str, code: &str) -> Judgement {
    let name = match language {
        "wgsl" => "Chromium (WGSL, by WebGPU)",
        _ => "Chromium (GLSL ES 3.00, by WebGL 2)",
    };
    let job = format!("[{{language: '{language}', code: {}}}]", literal(code));
    let answer = ask(&Site {
        page: PAGE.replace("JOBS", &job),
        ..Site::default()
    });
    judgement(name.to_owned(), answer)
}

/// The builds of three.js.
///
/// # Errors
/// They are not there.
pub fn three() -> Result<HashMap<String, Vec<u8>>, Silence> {
    let missing = |what: &str| Silence::Missing(what.to_owned());
    let folder = judges().ok_or_else(|| missing("there is no home folder"))?;
    let mut files = HashMap::new();
    for name in LIBRARY {
        let content = std::fs::read(folder.join("three/build").join(name))
            .map_err(|_| missing("three.js is not installed (./pullback judges gets it)"))?;
        files.insert(name.to_owned(), content);
    }
    Ok(files)
}

fn by_three(code: &[u8], renderer: &str) -> Judgement {
    let name = match renderer {
        "chunks" => "three.js (ShaderMaterial, on WebGL 2)",
        _ => "three.js (NodeMaterial, on WebGPU)",
    };
    let answer = three().and_then(|mut files| {
        files.insert("code.js".to_owned(), code.to_vec());
        let page = THREE.replace("RENDERER", renderer);
        ask(&Site { page, files })
    });
    judgement(name.to_owned(), answer)
}

fn by_godot(shader: String) -> Judgement {
    let answer = godot::drawn(&[(shader, 2)]);
    let said = answer.map(|all| all.first().map_or_else(String::new, |d| d.said.clone()));
    judgement("Godot 4 (Compatibility renderer)".to_owned(), said)
}
