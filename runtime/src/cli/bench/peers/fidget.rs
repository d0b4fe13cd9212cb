//! fidget: a program of its own that cargo builds in a folder for caches, as fidget is no dependency of ours.

use std::path::{Path, PathBuf};
use std::process::Command;

use pullback_runtime::atomic_file;

use super::answer;
use crate::cli::Console;

/// Its text, and what cargo reads.
const MAIN: &str = include_str!("fidget/main.rs");
const MANIFEST: &str = include_str!("fidget/Cargo.toml.txt");

/// The program, built where it is not; why there is none.
pub(super) fn program(console: &Console) -> Result<PathBuf, String> {
    let folder = folder().ok_or("fidget: there is no folder for caches")?;
    let failed = |what: &str| format!("fidget: {what}");
    std::fs::create_dir_all(&folder).map_err(|error| failed(&error.to_string()))?;
    let put = |name: &str, text: &str| {
        let path = folder.join(name);
        let same = std::fs::read_to_string(&path).is_ok_and(|found| found == text);
        if same {
            return Ok(());
        }
        atomic_file::write_text(&path, text).map_err(|error| failed(&error.to_string()))
    };
    put("main.rs", MAIN)?;
    put("Cargo.toml", MANIFEST)?;
    console.note(&format!("fidget: built by cargo in {}", folder.display()));
    let mut cargo = Command::new("cargo");
    cargo
        .args(["build", "--release", "--quiet"])
        .current_dir(&folder)
        // not into the folder of a build that this one is part of
        .env("CARGO_TARGET_DIR", folder.join("target"));
    answer(&mut cargo, "").map_err(|reason| failed(&reason))?;
    let name = format!("pullback-peer-fidget{}", std::env::consts::EXE_SUFFIX);
    let path = folder.join("target").join("release").join(name);
    if path.exists() {
        Ok(path)
    } else {
        Err(failed("cargo does not build it here"))
    }
}

/// Lines of what it takes at the formulas.
pub(super) fn formulas(program: &Path) -> Result<String, String> {
    answer(&mut Command::new(program), "")
}

/// Lines of what pictures take, which it draws into a folder: of the model there, and of a gyroid.
pub(super) fn pictures(program: &Path, folder: &Path) -> Result<String, String> {
    answer(Command::new(program).arg(folder), "")
}

fn folder() -> Option<PathBuf> {
    let base = pullback_runtime::capabilities::cache_folder()?;
    Some(base.join("peers").join("fidget"))
}
