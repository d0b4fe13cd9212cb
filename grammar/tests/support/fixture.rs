//! Files of cases: `=== `, the text, `---`, what is expected of it. `BLESS=1` rewrites what is expected.

use std::fmt::Write as _;
use std::path::Path;

/// Holds every case of `tests/data/<name>` to what `actual` makes of its text; returns the number of cases.
pub fn check(name: &str, actual: impl Fn(&str) -> String) -> usize {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/data")
        .join(name);
    let file = std::fs::read_to_string(&path).expect("the file of cases");
    let mut blessed = String::new();
    let mut wrong = String::new();
    let mut count = 0;
    for case in file.split("===\n").skip(1) {
        let (text, expected) = case.split_once("\n---\n").unwrap_or((case.trim_end(), ""));
        let found = actual(text);
        let _ = write!(blessed, "===\n{text}\n---\n{}\n\n", found.trim_end());
        if found.trim_end() != expected.trim_end() {
            let _ = writeln!(wrong, "{text}\n  expected\n{expected}\n  found\n{found}");
        }
        count += 1;
    }
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(&path, blessed).expect("the file of cases");
    } else {
        assert!(wrong.is_empty(), "{name}:\n{wrong}");
    }
    count
}
