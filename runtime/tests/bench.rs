//! `pullback bench` as a user meets it.

mod shared;

use std::path::Path;

use serde_json::{Value, json};
use shared::pullback;

const COMPILER: [&str; 4] = ["bench", "--no-pictures", "--budget", "0.2"];

fn bench(folder: &Path, more: &[&str]) -> (i32, String, String) {
    pullback(folder, &[&COMPILER[..], more, &["-q", "a.pull"]].concat())
}

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.pull"), "show levels(sin(x) cos(y))\n").unwrap();
    folder
}

#[test]
fn a_program_that_got_slower_is_found() {
    let folder = folder();
    let (code, table, errors) = bench(folder.path(), &["-o", "base.json"]);
    assert_eq!(code, 0, "{errors}");
    for word in ["parse", "spirv", "compiled", "the compiler alone"] {
        assert!(table.contains(word), "{word}: {table}");
    }
    let path = folder.path().join("base.json");
    let mut base: Value = serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
    let turns = base["calibration"].as_array().unwrap().len();
    assert!(turns >= 8);
    // the earlier run, had its modules been made in a tenth of the time
    let module = base["pictures"][0]["times"].as_array_mut().unwrap();
    let module = module
        .iter_mut()
        .find(|case| case["name"] == "module")
        .unwrap();
    for seconds in module["seconds"].as_array_mut().unwrap() {
        *seconds = json!(0.1 * seconds.as_f64().unwrap());
    }
    std::fs::write(&path, base.to_string()).unwrap();
    let (code, table, errors) = bench(
        folder.path(),
        &["--compare", "base.json", "--fail-above", "100"],
    );
    assert_eq!(code, 1, "{table}");
    assert!(
        table.contains("a module") && table.contains("slower"),
        "{table}"
    );
    assert!(errors.contains("1 times are greater"), "{errors}");
    // without a limit it is told, and no failure
    assert_eq!(bench(folder.path(), &["--compare", "base.json"]).0, 0);
}

#[test]
fn files_that_hold_no_times_are_refused() {
    let folder = folder();
    for (text, expected) in [
        ("", "holds no times"),
        ("{\"version\": 1}", "missing field"),
        (
            "{\"version\": 7, \"adapter\": null, \"width\": 1, \"height\": 1, \"calibration\": [], \"pictures\": []}",
            "version is 7",
        ),
    ] {
        std::fs::write(folder.path().join("base.json"), text).unwrap();
        let (code, _, errors) = bench(folder.path(), &["--compare", "base.json"]);
        assert_eq!(code, 2, "{text}: {errors}");
        assert!(errors.contains(expected), "{text}: {errors}");
    }
    assert_eq!(bench(folder.path(), &["--compare", "none.json"]).0, 4);
    std::fs::write(folder.path().join("a.pull"), "show levels(\n").unwrap();
    assert_eq!(bench(folder.path(), &[]).0, 1);
}

#[test]
fn pictures_are_timed_too() {
    let folder = folder();
    let small = [
        "bench",
        "--budget",
        "0.2",
        "--size",
        "32x24",
        "--adapter",
        "software",
        "-q",
        "a.pull",
    ];
    let (code, table, errors) = pullback(folder.path(), &small);
    assert_eq!(code, 0, "{errors}");
    assert!(
        table.contains("picture") && table.contains("32x24"),
        "{table}"
    );
}
