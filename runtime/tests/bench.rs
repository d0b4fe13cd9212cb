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
    // the earlier run, had its modules been made in so little time that no other work on the machine hides it
    let module = base["pictures"][0]["times"].as_array_mut().unwrap();
    let module = module
        .iter_mut()
        .find(|case| case["name"] == "module")
        .unwrap();
    for seconds in module["seconds"].as_array_mut().unwrap() {
        *seconds = json!(1e-6 * seconds.as_f64().unwrap());
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
    assert!(errors.contains("times are greater"), "{errors}");
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

/// Writes tables of an adapter into the folder `out`.
fn tables(folder: &Path, more: &[&str]) -> (i32, String) {
    let all = ["bench", "--tables", "out", "--adapter", "software", "-q"];
    let size = ["--size", "32x24"];
    let (code, _, errors) = pullback(folder, &[&all[..], &size, more].concat());
    (code, errors)
}

/// What each line of a table has as many cells of as its head.
fn cells(line: &str) -> usize {
    line.replace("\\|", "").split('|').count()
}

/// The lines of a table that begin with a word, which have as many cells as its head.
fn lines<'a>(table: &'a str, first: &str) -> Vec<&'a str> {
    let head = table.lines().find(|line| line.starts_with("| ")).unwrap();
    let begin = format!("| {first} ");
    let found: Vec<&str> = table.lines().filter(|l| l.starts_with(&begin)).collect();
    for line in &found {
        assert_eq!(cells(line), cells(head), "{table}");
    }
    found
}

#[test]
fn tables_go_on_where_they_ended() {
    let folder = folder();
    let path = |name: &str| folder.path().join("out").join(name);
    let text = |name: &str| std::fs::read_to_string(path(name)).unwrap();
    let of_programs = [
        "programs",
        "derivatives",
        "tiers",
        "choices",
        "accurate",
        "double",
    ];
    let mut only = vec!["--budget", "8", "a.pull"];
    for name in of_programs {
        only.extend(["--only", name]);
    }
    let (code, errors) = tables(folder.path(), &only);
    assert_eq!(code, 0, "{errors}");
    for name in of_programs {
        let table = text(&format!("{name}.md"));
        assert_eq!(lines(&table, "a").len(), 1, "{name}: {table}");
    }
    // of what a busy machine finds no time for there is no chart
    for name in ["programs", "derivatives"] {
        let svg = text(&format!("{name}.svg"));
        assert!(svg.starts_with("<svg") && svg.contains("<circle"), "{svg}");
    }
    let page = text("report.html");
    assert_eq!(page.matches("<table>").count(), of_programs.len(), "{page}");
    // what is there is kept, and what is missing is added
    let kept = text("tiers.md");
    std::fs::write(folder.path().join("b.pull"), "show levels(x y)\n").unwrap();
    let more = ["--budget", "8", "a.pull", "b.pull", "--only", "tiers"];
    let (code, errors) = tables(folder.path(), &more);
    assert_eq!(code, 0, "{errors}");
    let grown = text("tiers.md");
    assert!(
        grown.starts_with(&kept) && grown.contains("\n| b |"),
        "{grown}"
    );
    // a table of something else is not written over
    std::fs::write(path("tiers.md"), "another\n").unwrap();
    assert_eq!(tables(folder.path(), &more).0, 2);
}

/// Each run makes one line at least, of what the program carries itself.
#[test]
fn tables_beside_other_ways_have_a_line_a_run() {
    let folder = folder();
    for (name, first) in [
        ("growth", "10"),
        ("gradients", "gyroid"),
        ("twins", "levels"),
        ("marches", "constant"),
        ("large", "chladni"),
    ] {
        let (code, errors) = tables(folder.path(), &["--budget", "0.1", "--only", name]);
        assert_eq!(code, 0, "{errors}");
        let path = folder.path().join("out").join(format!("{name}.md"));
        let table = std::fs::read_to_string(path).unwrap();
        assert!(!lines(&table, first).is_empty(), "{name}: {table}");
    }
}

/// A counter of instructions that is found before the machine's: it counts a million for each byte of the program that is compiled,
/// so that the counts of two programs are known.
#[cfg(unix)]
const COUNTER: &str = r#"#!/bin/sh
while [ "$1" != "--" ]; do shift; done
shift
"$@" || exit 1
echo "$(($(wc -c < "$3") * 1000000)),,instructions:u,1,100.00,," >&2
"#;

#[cfg(unix)]
#[test]
fn a_program_that_takes_more_instructions_is_found() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder();
    let perf = folder.path().join("perf");
    std::fs::write(&perf, COUNTER).unwrap();
    std::fs::set_permissions(&perf, std::fs::Permissions::from_mode(0o755)).unwrap();
    let path = std::env::var("PATH").unwrap_or_default();
    let path = format!("{}:{path}", folder.path().display());
    let bench = |more: &[&str]| {
        let all = [&COMPILER[..], &["--instructions"], more, &["-q", "a.pull"]].concat();
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_pullback"))
            .args(all)
            .env("PATH", &path)
            .current_dir(folder.path())
            .output()
            .unwrap();
        let text = String::from_utf8(output.stdout).unwrap();
        (output.status.code().unwrap(), text)
    };
    let (code, table) = bench(&["-o", "base.json"]);
    assert_eq!(code, 0, "{table}");
    // what the process takes by itself is that of `show levels(x)`
    let count = |text: &str| (text.len() - "show levels(x)\n".len()) as f64;
    let before = "show levels(sin(x) cos(y))\n";
    let told = format!("a      {:>9.3}", count(before));
    assert!(table.contains(&told), "{told}: {table}");
    let changed = |table: &str| {
        let line = table.lines().find(|line| line.contains("a instructions"));
        line.map(str::to_owned)
    };
    let (_, table) = bench(&["--compare", "base.json"]);
    assert_eq!(changed(&table), None, "{table}");
    let against = |text: &str, word: &str, expected: i32| {
        std::fs::write(folder.path().join("a.pull"), text).unwrap();
        let (code, table) = bench(&["--compare", "base.json", "--fail-above", "400"]);
        let line = changed(&table).unwrap_or_else(|| panic!("{table}"));
        let ratio = format!("{:.3}", count(text) / count(before));
        assert!(line.contains(&ratio) && line.ends_with(word), "{line}");
        assert_eq!(code, expected, "{table}");
    };
    // six times as many: more than the limit, which no other work on the machine makes of the times
    let terms = " + x y".repeat(11);
    against(&format!("show levels(sin(x) cos(y){terms})\n"), "slower", 1);
    against("show levels(sin(x))\n", "faster", 0);
}
