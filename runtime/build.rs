//! Compresses the tables of references, which the program carries: `pullback accuracy` needs no source tree.

use std::path::Path;
use std::{env, fs};

/// In the order in which `accuracy/tables.rs` reads them.
const TABLES: [&str; 5] = [
    "oracle/real.tsv",
    "oracle/complex.tsv",
    "functions/real_edges.tsv",
    "functions/complex_edges.tsv",
    "functions/wide.tsv",
];
/// Between two tables.
const SEPARATOR: u8 = 0x0c;

fn main() -> Result<(), Box<dyn std::error::Error>> {
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
