//! The command line as a user meets it: exit codes, outputs, messages.

use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

/// Runs `pullback` in `folder` with `input` on its standard input.
fn run(folder: &Path, arguments: &[&str], input: &str) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_pullback"))
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // A command that does not read its input closes it.
    let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
    child.wait_with_output().unwrap()
}

/// Exit code, standard output and standard error.
fn pullback(arguments: &[&str], input: &str) -> (i32, String, String) {
    let folder = tempfile::tempdir().unwrap();
    let output = run(folder.path(), arguments, input);
    (
        output.status.code().unwrap(),
        String::from_utf8(output.stdout).unwrap(),
        String::from_utf8(output.stderr).unwrap(),
    )
}

/// Whether tests that need an adapter can run.
fn has_adapter() -> bool {
    let choice = pullback_runtime::AdapterChoice::Software;
    pullback_runtime::Gpu::open(&choice).is_ok()
}

#[test]
fn exit_codes_and_messages() {
    let check = |arguments: &[&str], code: i32, message: &str| {
        let (found, _, errors) = pullback(arguments, "");
        assert_eq!(found, code, "{arguments:?}: {errors}");
        assert!(errors.contains(message), "{arguments:?}: {errors}");
    };
    check(&["check", "sin(x) + y"], 0, "");
    check(&["check", "sin(x"], 1, "missing");
    check(&["render", "foo(x)"], 1, "foo");
    check(&["render"], 2, "FILE|FORMULA");
    check(&["render", "x", "--sixe", "3x3"], 2, "'--size'");
    check(&["render", "x", "--size", "0x3"], 2, "1 to 16384");
    check(&["render", "x", "--samples", "17"], 2, "1..=16");
    check(&["render", "x", "--height", "-1"], 2, "positive");
    check(
        &["render", "x", "--set", "heigth=2"],
        2,
        "did you mean `height`?",
    );
    check(&["render", "x", "--set", "k"], 2, "NAME=VALUE");
    check(&["render", "x", "--show", "2"], 2, "1 picture");
    check(&["render", "x y z", "--height", "2"], 2, "camera");
    check(&["eval", "x y"], 2, "--points");
    check(&["eval", "3", "--points", "-"], 2, "no arguments");
    check(&["eval", "-", "--points", "-"], 2, "both");
    check(
        &["render", "x", "--adapter", "no such adapter"],
        3,
        "no such adapter",
    );
    check(&["check", "missing.pull"], 4, "missing.pull: no such file");
    check(
        &["eval", "x y", "--on", "reference", "--points", "missing"],
        4,
        "missing: no such",
    );
}

#[test]
fn values_by_the_reference() {
    let check = |arguments: &[&str], input: &str, expected: &str| {
        let arguments = [arguments, &["--on", "reference"]].concat();
        let (code, text, errors) = pullback(&arguments, input);
        assert_eq!(
            (code, text.as_str()),
            (0, expected),
            "{arguments:?}: {errors}"
        );
    };
    check(&["eval", "1/3"], "", "0.3333333333333333\n");
    check(&["eval", "-2^2"], "", "-4\n");
    check(
        &["eval", "x y", "--points", "-"],
        "1 2\n\n# no\n3\t4 # yes\n",
        "2\n12\n",
    );
    check(
        &["eval", "x/y", "--points", "-"],
        "1 0\n-1 0\n0 0\ninf 1\n",
        "inf\n-inf\nnan\ninf\n",
    );
    check(
        &["eval", "x y", "--points", "-", "--what", "gradient"],
        "3 4",
        "12\t4\t3\n",
    );
    check(
        &["eval", "z^2", "--points", "-", "--what", "derivative"],
        "1 2",
        "-3\t4\t2\t4\n",
    );
    check(&["eval", "param k = 2\nk", "--set", "k=5"], "", "5\n");
    check(&["eval", "time", "--time", "-1.5"], "", "-1.5\n");
    check(&["eval", "-"], "7", "7\n");
    check(&["eval", "x y", "--points", "-"], "", "");
}

#[test]
fn bad_rows_are_all_told() {
    let arguments = ["eval", "x y", "--on", "reference", "--points", "-"];
    let (code, text, errors) = pullback(&arguments, "1 2\n3 z\n4\n1 2 3\n5 6\n");
    assert_eq!((code, text.as_str()), (4, ""));
    for problem in [
        "line 2, column 3: `z` is not a number",
        "line 3, column 2: 2 numbers expected, but the row ends after 1",
        "line 4, column 5: more than 2 numbers",
    ] {
        assert!(errors.contains(problem), "{errors}");
    }
    let (_, _, errors) = pullback(&arguments, &"x\n".repeat(1000));
    assert_eq!(
        errors
            .lines()
            .filter(|line| line.contains("column"))
            .count(),
        20
    );
}

#[test]
fn files_and_formulas_are_told_apart() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("seven.pull"), "3 + 4").unwrap();
    std::fs::write(folder.path().join("eight"), "3 + 5").unwrap();
    std::fs::write(folder.path().join("bad.pull"), b"\xff\xfe").unwrap();
    std::fs::create_dir(folder.path().join("e")).unwrap();
    let value = |input: &str| {
        let output = run(folder.path(), &["eval", input, "--on", "reference"], "");
        String::from_utf8(output.stdout).unwrap()
    };
    assert_eq!(value("seven.pull"), "7\n");
    assert_eq!(value("eight"), "8\n");
    assert_eq!(value("e"), "2.718281828459045\n");
    let bad = run(folder.path(), &["check", "bad.pull"], "");
    assert_eq!(bad.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&bad.stderr).contains("UTF-8"));
}

#[test]
fn several_programs_are_checked() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("good.pull"), "x + y").unwrap();
    std::fs::write(folder.path().join("bad.pull"), "x + ").unwrap();
    let check = |arguments: &[&str], input: &str| {
        let output = run(folder.path(), &[&["check"], arguments].concat(), input);
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        let code = output.status.code().unwrap();
        (code, text(&output.stdout), text(&output.stderr))
    };
    let (code, told, errors) = check(&["bad.pull", "good.pull", "-"], "1/2x");
    assert_eq!(code, 1);
    assert_eq!(
        told,
        "good.pull: ok, shows levels\nstandard input: ok, 1 warning, shows levels\n"
    );
    assert!(errors.contains("bad.pull:1:"), "{errors}");
    assert!(errors.contains("standard input:1:"), "{errors}");
    let (code, told, errors) = check(&["missing.pull", "good.pull"], "");
    assert_eq!((code, told.as_str()), (4, "good.pull: ok, shows levels\n"));
    assert!(errors.contains("missing.pull: no such file"), "{errors}");
    assert_eq!(check(&["-x^2", "x y"], "").0, 0);
    let (code, _, errors) = check(&["-", "-"], "x");
    assert_eq!(code, 2);
    assert!(errors.contains("only once"), "{errors}");
    let (code, told, _) = check(&["-x^2", "--format", "json"], "");
    assert!(code == 0 && told.starts_with('{'), "{told}");
}

#[test]
fn files_are_formatted() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let read = |name: &str| std::fs::read_to_string(path(name)).unwrap();
    let fmt = |arguments: &[&str]| {
        let output = run(folder.path(), &[&["fmt"], arguments].concat(), "");
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        let code = output.status.code().unwrap();
        (code, text(&output.stdout), text(&output.stderr))
    };
    let (rough, neat) = ("f( x,y )=x²+ 2y // why\n", "f(x, y) = x² + 2y  // why\n");
    std::fs::write(path("rough.pull"), rough).unwrap();
    std::fs::write(path("neat.pull"), neat).unwrap();
    std::fs::write(path("bad.pull"), "f(x = 2\n").unwrap();

    let (code, told, errors) = fmt(&["--check", "rough.pull", "neat.pull"]);
    assert_eq!((code, told.as_str()), (1, "rough.pull\n"));
    let shown = [
        "--- rough.pull",
        "-f( x,y )=x²+ 2y // why",
        "+f(x, y) = x² + 2y  // why",
    ];
    assert!(shown.iter().all(|line| errors.contains(line)), "{errors}");
    assert_eq!(read("rough.pull"), rough, "checked, not changed");

    let (code, told, errors) = fmt(&["bad.pull", "rough.pull", "neat.pull"]);
    assert_eq!((code, told.as_str()), (1, ""));
    assert!(
        errors.contains("error[") && errors.contains("bad.pull:1:"),
        "{errors}"
    );
    assert!(errors.contains("rough.pull: formatted"), "{errors}");
    assert!(!errors.contains("neat.pull"), "{errors}");
    assert_eq!(read("rough.pull"), neat);
    assert_eq!(read("bad.pull"), "f(x = 2\n", "left alone");

    assert_eq!(
        fmt(&["--check", "rough.pull", "neat.pull"]),
        (0, String::new(), String::new())
    );
    let (code, _, errors) = fmt(&["missing.pull", "bad.pull"]);
    assert_eq!(code, 4);
    assert!(errors.contains("missing.pull: no such file"), "{errors}");
    let entries = std::fs::read_dir(folder.path()).unwrap().count();
    assert_eq!(entries, 3, "nothing else is left behind");
}

#[cfg(unix)]
#[test]
fn formatting_keeps_links_and_permissions() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let (file, link) = (folder.path().join("a.pull"), folder.path().join("b.pull"));
    std::fs::write(&file, "x+y").unwrap();
    std::fs::set_permissions(&file, std::fs::Permissions::from_mode(0o640)).unwrap();
    std::os::unix::fs::symlink(&file, &link).unwrap();
    assert_eq!(
        run(folder.path(), &["fmt", "b.pull"], "").status.code(),
        Some(0)
    );
    assert!(std::fs::symlink_metadata(&link).unwrap().is_symlink());
    let mode = std::fs::metadata(&file).unwrap().permissions().mode();
    assert_eq!(mode & 0o777, 0o640);
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "x + y\n");
}

#[test]
fn the_standard_input_is_formatted() {
    for arguments in [&["fmt"][..], &["fmt", "-"]] {
        let (code, text, errors) = pullback(arguments, "a=1;x+a");
        assert_eq!(
            (code, text.as_str(), errors.as_str()),
            (0, "a = 1\nx + a\n", "")
        );
        let (code, text, errors) = pullback(arguments, "x +");
        assert_eq!((code, text.as_str()), (1, ""));
        assert!(errors.contains("standard input:1:"), "{errors}");
    }
    let (code, text, _) = pullback(&["fmt", "--check"], "a=1;x+a");
    assert_eq!((code, text.as_str()), (1, "standard input\n"));
    // What compiles not, but reads well, has a format; warnings are no matter of it.
    let (code, text, errors) = pullback(&["fmt"], "1/2x+unknown");
    assert_eq!(
        (code, text.as_str(), errors.as_str()),
        (0, "1/2x + unknown\n", "")
    );
}

#[test]
fn shaders_in_every_language() {
    for target in ["wgsl", "glsl", "hlsl", "msl", "spirv"] {
        for what in ["value", "gradient", "scene"] {
            let folder = tempfile::tempdir().unwrap();
            let arguments = [
                "emit", "x^2 - y", "--target", target, "--what", what, "-o", "out",
            ];
            let output = run(folder.path(), &arguments, "");
            assert_eq!(output.status.code(), Some(0), "{target} {what}");
            assert!(std::fs::metadata(folder.path().join("out")).unwrap().len() > 50);
        }
    }
}

#[test]
fn lists() {
    let check = |arguments: &[&str], part: &str| {
        let (code, text, _) = pullback(arguments, "");
        assert_eq!(code, 0);
        assert!(text.contains(part), "{text}");
    };
    check(&["functions"], "sin(a)");
    check(&["functions", "--markdown"], "| `sin(a)` |");
    check(&["functions", "--bounds"], "sin (complex)");
    check(&["functions", "--json"], "\"unit\": \"ulp of float64\"");
    check(&["scenes"], "levels:");
    check(&["scenes", "--markdown"], "## levels");
    check(&["--help"], "Exit codes:");
    check(&["render", "--help"], "Exit codes:");
}

#[test]
fn pictures() {
    if !has_adapter() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let draw = |arguments: &[&str]| {
        let all = [
            &[
                "render",
                "x^2 + y^2",
                "--adapter",
                "software",
                "--size",
                "50x40",
            ],
            arguments,
        ];
        let output = run(folder.path(), &all.concat(), "");
        let errors = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(0), "{errors}");
        (output.stdout, errors)
    };
    let (_, errors) = draw(&["-o", "a.png"]);
    assert!(
        errors.contains("adapter: ") && errors.contains("software"),
        "{errors}"
    );
    let file = std::fs::read(folder.path().join("a.png")).unwrap();
    let (compute, _) = draw(&["-o", "-"]);
    let (fragment, _) = draw(&["-o", "-", "--pipeline", "fragment"]);
    assert_eq!(file, compute);
    assert_eq!(compute, fragment);
    let (moved, errors) = draw(&["-q", "-o", "-", "--center", "-1,2", "--set", "height=3"]);
    assert_ne!(moved, compute);
    assert_eq!(errors, "");
    draw(&[]);
    assert!(folder.path().join("pullback.png").exists());
    let entries = std::fs::read_dir(folder.path()).unwrap().count();
    assert_eq!(entries, 2, "nothing else is left behind");
}

#[test]
fn a_closed_pipe_is_no_error() {
    if !cfg!(unix) {
        return;
    }
    let mut child = Command::new(env!("CARGO_BIN_EXE_pullback"))
        .args(["eval", "x y", "--on", "reference", "--points", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let rows = "1 2\n".repeat(300_000);
    // The command may end before it has read everything.
    let _ = child.stdin.take().unwrap().write_all(rows.as_bytes());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert!(output.stderr.is_empty());
}

/// The reference pages hold what the commands print. `BLESS=1` rewrites them.
#[test]
fn reference_pages_are_current() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs");
    for (page, command, title, introduction) in [
        (
            "functions.md",
            "functions",
            "# Functions and operators",
            "Written by `pullback functions --markdown` from the operator table. Where a function takes reals it also \
             takes\nvectors, by components.",
        ),
        (
            "scenes.md",
            "scenes",
            "# Scenes and their settings",
            "Written by `pullback scenes --markdown`. Settings stand in the braces of a `show`, or after `--set`.",
        ),
    ] {
        let (code, table, _) = pullback(&[command, "--markdown"], "");
        assert_eq!(code, 0);
        let wanted = format!("{title}\n\n{introduction}\n\n{table}");
        let path = docs.join(page);
        if std::env::var_os("BLESS").is_some() {
            std::fs::write(&path, &wanted).unwrap();
        }
        let found = std::fs::read_to_string(&path).unwrap_or_default();
        assert_eq!(
            found, wanted,
            "{page} is out of date: run this test with BLESS=1"
        );
    }
}

#[test]
fn explain_shows_the_rewrites() {
    let check = |arguments: &[&str], has: &[&str], lacks: &[&str]| {
        let (code, output, errors) = pullback(arguments, "");
        assert_eq!(code, 0, "{arguments:?}: {errors}");
        for word in has {
            assert!(output.contains(word), "no {word} in\n{output}");
        }
        for word in lacks {
            assert!(!output.contains(word), "{word} in\n{output}");
        }
    };
    let formula = "sqrt(x + 1) - sqrt(x)";
    let form = "1/(sqrt(x + 1) + sqrt(x))";
    check(
        &["explain", formula],
        &[
            "f(x: ",
            "written",
            formula,
            "compiled",
            form,
            "sqrt-difference",
            "√a - √b",
        ],
        &["but off"],
    );
    check(
        &["explain", formula, "--rewrites", "off"],
        &["no rewrites", "possible, but off", form],
        &[],
    );
    check(
        &[
            "explain",
            "1 - cos(x) + 0 y",
            "--rewrites",
            "-one-minus-cos",
        ],
        &["but off"],
        &[],
    );
    let (code, output, _) = pullback(&["explain", formula, "--format", "json"], "");
    let report: serde_json::Value = serde_json::from_str(&output).unwrap();
    assert_eq!((code, &report["version"]), (0, &serde_json::json!(1)));
    assert_eq!(report["compiled"], form);
    assert_eq!(report["rewrites"][0]["after"], form);
    let rules = report["rewrites"][0]["rules"].as_array().unwrap();
    let names: Vec<_> = rules.iter().map(|rule| &rule["name"]).collect();
    assert!(
        names.iter().any(|name| *name == "sqrt-difference"),
        "{names:?}"
    );
    let (code, _, errors) = pullback(&["explain", formula, "--rewrites", "hypott"], "");
    assert!(
        code == 2 && errors.contains("did you mean `hypot`"),
        "{errors}"
    );
}

#[test]
fn emit_obeys_the_rewrites() {
    let emitted = |rewrites: &str| {
        let arguments = ["emit", "1 - cos(x)", "--rewrites", rewrites];
        pullback(&arguments, "").1
    };
    assert!(emitted("on").contains("real_sin") && !emitted("on").contains("real_cos("));
    assert!(emitted("off").contains("real_cos"));
}
