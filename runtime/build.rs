//! What the program carries, so that it needs no source tree: the tables of references for `pullback accuracy`, compressed,
//! and the programs of `pullback gallery`.

use std::path::Path;
use std::{env, fs};

/// In the order in which `accuracy/tables.rs` reads them.
const TABLES: [&str; 8] = [
    "oracle/real.tsv",
    "oracle/complex.tsv",
    "functions/real_edges.tsv",
    "functions/complex_edges.tsv",
    "functions/integral_edges.tsv",
    "functions/integral_complex.tsv",
    "functions/wide.tsv",
    "functions/integral_wide.tsv",
];
/// Between two tables.
const SEPARATOR: u8 = 0x0c;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    references()?;
    gallery()
}

fn references() -> Result<(), Box<dyn std::error::Error>> {
    let folder = Path::new(&env::var("CARGO_MANIFEST_DIR")?).join("../tests/data");
    let mut all = Vec::new();
    for name in TABLES {
        let path = folder.join(name);
        println!("cargo:rerun-if-changed={}", path.display());
        if !all.is_empty() {
            all.push(SEPARATOR);
        }
        all.extend(fs::read(&path).map_err(|error| format!("{}: {error}", path.display()))?);
    }
    let packed = miniz_oxide::deflate::compress_to_vec(&all, 9);
    fs::write(Path::new(&env::var("OUT_DIR")?).join("references"), packed)?;
    Ok(())
}

/// An array of the names and texts of docs/gallery.
fn gallery() -> Result<(), Box<dyn std::error::Error>> {
    let folder = Path::new(&env::var("CARGO_MANIFEST_DIR")?).join("../docs/gallery");
    println!("cargo:rerun-if-changed={}", folder.display());
    let mut programs = Vec::new();
    for entry in fs::read_dir(&folder)? {
        let path = entry?.path();
        if path.extension().is_some_and(|ending| ending == "pull") {
            let name = path.file_stem().unwrap_or_default().to_string_lossy();
            programs.push((name.into_owned(), fs::read_to_string(&path)?));
        }
    }
    programs.sort();
    let list = Path::new(&env::var("OUT_DIR")?).join("gallery.rs");
    fs::write(list, format!("{programs:?}"))?;
    Ok(())
}
