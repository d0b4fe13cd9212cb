//! Programs and shader texts that several suites read.

use std::fs;
use std::path::{Path, PathBuf};

/// A file with its text.
#[derive(Clone, Debug)]
pub struct Source {
    /// Name without folder and extension.
    pub name: String,
    /// The text.
    pub text: String,
}

/// The root of the workspace: where it was compiled, or for a binary that was carried elsewhere the current folder.
#[must_use]
pub fn root() -> PathBuf {
    let compiled = Path::new(env!("CARGO_MANIFEST_DIR")).parent();
    match compiled {
        Some(root) if root.join("tests/data").is_dir() => root.to_owned(),
        _ => PathBuf::from("."),
    }
}

/// The files of a folder with an extension, by name.
///
/// # Panics
/// The folder or a file cannot be read, or there is none.
#[must_use]
pub fn files(folder: &str, extension: &str) -> Vec<Source> {
    let folder = root().join(folder);
    let entries = fs::read_dir(&folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let mut out: Vec<Source> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.extension().is_some_and(|e| e == extension))
        .map(|path| Source {
            name: path
                .file_stem()
                .unwrap_or_default()
                .to_string_lossy()
                .into_owned(),
            text: read(&path),
        })
        .collect();
    assert!(!out.is_empty(), "no .{extension} in {}", folder.display());
    out.sort_by(|a, b| a.name.cmp(&b.name));
    out
}

/// The text of a file.
///
/// # Panics
/// It cannot be read.
#[must_use]
pub fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// Formulas that compile and draw.
#[must_use]
pub fn gallery() -> Vec<Source> {
    files("docs/gallery", "pull")
}

/// Algebraic surfaces.
#[must_use]
pub fn surfaces() -> Vec<Source> {
    files("docs/surfaces", "pull")
}

/// Pictures of special functions.
#[must_use]
pub fn special() -> Vec<Source> {
    files("docs/special", "pull")
}

/// A diagnostic that a wrong program must give.
#[derive(Clone, Debug)]
pub struct Expected {
    /// Its code.
    pub code: String,
    /// The text under its span; empty where that is not prescribed.
    pub spanned: String,
    /// A part of its hint.
    pub hint: String,
}

/// A wrong program.
#[derive(Clone, Debug)]
pub struct WrongProgram {
    /// Its folder: the mistake that it is about.
    pub group: String,
    /// Name of its file.
    pub name: String,
    /// The program, without the expectations.
    pub text: String,
    /// What it must give, and nothing else.
    pub expected: Vec<Expected>,
}

/// Where the wrong programs are; the format is described there.
const WRONG: &str = "tests/data/errors";

/// The groups of wrong programs, by name: the folders in `tests/data/errors`.
///
/// # Panics
/// The folder cannot be read.
#[must_use]
pub fn wrong_groups() -> Vec<String> {
    let folder = root().join(WRONG);
    let entries = fs::read_dir(&folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let mut out: Vec<String> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.is_dir())
        .filter_map(|path| Some(path.file_name()?.to_string_lossy().into_owned()))
        .collect();
    out.sort();
    out
}

/// The wrong programs, group by group.
#[must_use]
pub fn wrong_programs() -> Vec<WrongProgram> {
    let of_group = |group: String| {
        let sources = files(&format!("{WRONG}/{group}"), "pull");
        let programs = sources.into_iter().map(move |s| wrong_program(&group, s));
        programs.collect::<Vec<_>>()
    };
    wrong_groups().into_iter().flat_map(of_group).collect()
}

fn wrong_program(group: &str, source: Source) -> WrongProgram {
    let at = match source.text.find("\n//!") {
        Some(at) => at + 1,
        None => 0,
    };
    let (text, expectations) = source.text.split_at(at);
    let expected = expectations.lines().map(|line| {
        parse_expected(line).unwrap_or_else(|| panic!("{}: cannot read {line:?}", source.name))
    });
    let expected: Vec<Expected> = expected.collect();
    assert!(!expected.is_empty(), "{}: nothing is expected", source.name);
    WrongProgram {
        group: group.into(),
        text: text.to_owned(),
        expected,
        name: source.name,
    }
}

/// `//! CODE "spanned text" : part of the hint`
fn parse_expected(line: &str) -> Option<Expected> {
    let (code, rest) = line.strip_prefix("//! ")?.split_once(" \"")?;
    let (spanned, hint) = rest.rsplit_once("\" :")?;
    Some(Expected {
        code: code.into(),
        spanned: spanned.into(),
        hint: hint.trim().into(),
    })
}

/// A fenced block of a document.
#[derive(Clone, Debug)]
pub struct Block {
    /// Line of the document on which it begins, from 1.
    pub line: usize,
    /// What stands behind the fence.
    pub info: String,
    /// The text.
    pub text: String,
}

/// The fenced blocks of a document of the workspace.
#[must_use]
pub fn blocks(document: &str) -> Vec<Block> {
    let text = read(&root().join(document));
    let mut out = Vec::new();
    let mut open: Option<Block> = None;
    for (number, line) in text.lines().enumerate() {
        match (line.strip_prefix("```"), open.take()) {
            (Some(info), None) => {
                open = Some(Block {
                    line: number + 1,
                    info: info.trim().into(),
                    text: String::new(),
                });
            }
            (Some(_), Some(block)) => out.push(block),
            (None, Some(mut block)) => {
                block.text.push_str(line);
                block.text.push('\n');
                open = Some(block);
            }
            (None, None) => {}
        }
    }
    assert!(open.is_none(), "{document}: a block is not closed");
    out
}

/// The texts of the parser's own fixtures, which stand between `===` and `---`.
fn fixtures(name: &str) -> Vec<String> {
    let text = read(&root().join("grammar/tests/data").join(name));
    let cases = text.split("===\n").skip(1);
    let texts = cases.filter_map(|case| Some(case.split_once("\n---\n")?.0.to_owned()));
    texts.collect()
}

/// Every program that we have: the gallery, the surfaces, the special functions, the wrong programs, those of the language reference, and the
/// texts of the parser's suites.
#[must_use]
pub fn all_programs() -> Vec<String> {
    let drawn = gallery().into_iter().chain(surfaces()).chain(special());
    let drawn = drawn.map(|s| s.text);
    let wrong = wrong_programs().into_iter().map(|p| p.text);
    let document = blocks("docs/language.md").into_iter().map(|b| b.text);
    let fixtures = ["parse.txt", "pasted.txt", "malformed.txt", "format.txt"].map(fixtures);
    let all = drawn.chain(wrong).chain(document);
    all.chain(fixtures.into_iter().flatten()).collect()
}
