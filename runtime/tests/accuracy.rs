//! `pullback accuracy` as a user meets it: text, JSON, a chart, and exit codes.

use std::process::Command;

use serde_json::Value;

/// Exit code, standard output and standard error.
fn accuracy(arguments: &[&str]) -> (i32, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_pullback"))
        .arg("accuracy")
        .args(arguments)
        .output()
        .unwrap();
    (
        output.status.code().unwrap(),
        String::from_utf8(output.stdout).unwrap(),
        String::from_utf8(output.stderr).unwrap(),
    )
}

fn has_adapter() -> bool {
    let choice = pullback_runtime::AdapterChoice::Software;
    pullback_runtime::Gpu::open(&choice).is_ok()
}

#[test]
fn the_reference_needs_no_adapter() {
    let (code, text, errors) = accuracy(&["sin", "sqrt", "--precision", "reference"]);
    assert_eq!(code, 0, "{text}{errors}");
    for line in ["sin ", "sin (complex)", "sqrt ", "sqrt (complex)"] {
        let found = text.lines().find(|l| l.starts_with(line)).expect(line);
        assert!(found.contains("reference"), "{found}");
    }
    assert!(text.contains("Every declared bound holds."), "{text}");
}

#[test]
fn tables_charts_and_json_say_the_same() {
    if !has_adapter() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let chart = folder.path().join("chart.svg");
    let arguments = [
        "log",
        "floor",
        "--quick",
        "--adapter",
        "software",
        "--precision",
        "fast,accurate",
    ];
    let file = [&arguments[..], &["--format", "json", "--svg"]].concat();
    let (code, text, errors) = accuracy(&[&file[..], &[chart.to_str().unwrap()]].concat());
    assert_eq!(code, 0, "{errors}");
    let found: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(found["version"], 1);
    assert_eq!(found["clock"], "program");
    let functions = found["functions"].as_array().unwrap();
    let names: Vec<_> = functions
        .iter()
        .map(|f| {
            (
                f["function"].as_str().unwrap(),
                f["domain"].as_str().unwrap(),
            )
        })
        .collect();
    assert_eq!(
        names,
        [("log", "real"), ("log", "complex"), ("floor", "real")]
    );
    // the logarithm of the driver is far off near 1, ours is not; rounding down is exact
    let tier = |f: usize, t: usize| &functions[f]["tiers"][t];
    assert_eq!(tier(0, 0)["tier"], "fast");
    assert!(tier(0, 0)["value"]["max"].as_f64().unwrap() > 1e5, "{text}");
    assert!(tier(0, 0)["value"]["bound"].is_null());
    let ours = tier(0, 1);
    let most = ours["value"]["max"].as_f64().unwrap();
    assert!(most > 0.4 && most <= ours["value"]["bound"].as_f64().unwrap());
    assert!(ours["value"]["max_99.9%"].as_f64().unwrap() <= most);
    assert!(ours["value"]["cases"].as_u64().unwrap() > 1800);
    assert!(ours["nanoseconds"].as_f64().unwrap() > 0.0, "{ours}");
    assert!(!ours["value"]["worst"]["at"].as_array().unwrap().is_empty());
    assert_eq!(tier(2, 1)["value"]["max"], 0.0);
    assert_eq!(found["exceptions"].as_array().unwrap().len(), 0);

    let picture = std::fs::read_to_string(&chart).unwrap();
    assert!(picture.starts_with("<svg ") && picture.trim_end().ends_with("</svg>"));
    // a title for each function and tier
    assert_eq!(picture.matches("<title>").count(), 6, "{picture}");
    assert!(picture.contains("<title>log, accurate: "));

    let (code, table, _) = accuracy(&[&arguments[..], &["--format", "markdown"]].concat());
    assert_eq!(code, 0);
    let rows = table.lines().filter(|l| l.starts_with("| ")).count();
    assert_eq!(rows, 2 + 6, "{table}");
}

#[test]
fn wrong_command_lines() {
    let check = |arguments: &[&str], code: i32, message: &str| {
        let (found, _, errors) = accuracy(arguments);
        assert_eq!(found, code, "{arguments:?}: {errors}");
        assert!(errors.contains(message), "{arguments:?}: {errors}");
    };
    check(&["sine"], 2, "no function `sine`");
    check(
        &["atann", "--precision", "reference"],
        2,
        "did you mean `atan`?",
    );
    check(&["hash"], 2, "no references of its own");
    check(&["sin", "--precision", "exact"], 2, "exact");
    check(
        &["sin", "--adapter", "no such adapter"],
        3,
        "no such adapter",
    );
    let reference = ["sin", "--precision", "reference"];
    check(
        &[&reference[..], &["--svg", "no/such/folder/a.svg"]].concat(),
        4,
        "no such file",
    );
}
