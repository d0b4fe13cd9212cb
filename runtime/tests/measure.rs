//! `pullback measure` as a user meets it.

mod shared;

use std::time::Duration;

use pullback_compiler::SettingValue;
use pullback_compiler::lower::{Precision, Tier};
use pullback_runtime::measure::{self, Choice, Job};
use pullback_runtime::{AdapterChoice, Frame, Gpu, Pipeline, Size, View};
use serde_json::Value;
use shared::pullback;

/// What a run finds; the picture and the budget are small.
fn found(formula: &str, more: &[&str]) -> Value {
    found_within(formula, ["64x48", "240"], more)
}

fn found_within(formula: &str, [size, budget]: [&str; 2], more: &[&str]) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let small = ["--size", size, "--budget", budget, "--adapter", "software"];
    let arguments = [
        &["measure", formula, "--format", "json", "-q"],
        &small[..],
        more,
    ]
    .concat();
    let (code, out, errors) = pullback(folder.path(), &arguments);
    assert_eq!(code, 0, "{formula}: {errors}");
    serde_json::from_str(&out).unwrap()
}

fn choice<'a>(found: &'a Value, name: &str) -> &'a Value {
    let all = found["choices"].as_array().unwrap();
    let names = || all.iter().map(|c| &c["name"]).collect::<Vec<_>>();
    let one = all.iter().find(|c| c["name"] == name);
    one.unwrap_or_else(|| panic!("{name} is not among {:?}", names()))
}

fn flip(found: &Value, name: &str) -> f64 {
    choice(found, name)["error"]["flip"]["mean"]
        .as_f64()
        .unwrap()
}

#[test]
fn more_samples_are_nearer_to_the_truth() {
    let found = found("sin(9x y)", &[]);
    let names = ["samples = 1", "default", "samples = 3", "samples = 4"];
    let errors = names.map(|name| flip(&found, name));
    assert!(errors.is_sorted_by(|a, b| a > b), "{errors:?}");
    assert!(errors[3] > 0.0);
    // the truth has eight samples along each axis; half of those are four
    let own = found["truth"]["own_error"]["flip"]["mean"]
        .as_f64()
        .unwrap();
    assert!(
        own > 0.2 * errors[3] && own < 5.0 * errors[3],
        "{own}, {errors:?}"
    );
    let front = &choice(&found, "samples = 4")["on_front"];
    assert_eq!(*front, true);
}

#[test]
fn a_tier_that_cannot_hold_the_numbers_is_found_out() {
    // bands of a number that binary32 rounds to steps of 1/8
    let found = found(
        "sin(3(x + 2000000) - 6000000)",
        &["--rewrites", "off", "--try", "precision=double samples=4"],
    );
    let [single, double] = ["default", "double"].map(|name| flip(&found, name));
    assert!(single > 3.0 * double, "{single} {double}");
    let best = flip(&found, "precision = double, samples = 4");
    assert!(best < double, "{best} {double}");
}

/// An error of a choice's numbers by themselves.
fn number<'a>(found: &'a Value, name: &str, quantity: &str) -> &'a Value {
    let all = choice(found, name)["numbers"].as_array().unwrap();
    let one = all.iter().find(|n| n["quantity"] == quantity);
    one.unwrap_or_else(|| panic!("{name} has no {quantity}: {all:?}"))
}

#[test]
fn numbers_are_judged_by_themselves() {
    // binary32 has steps of 1/8 there: the argument of the sine is off by up to a quarter
    let more = ["--rewrites", "off", "--samples", "1"];
    let found = found("sin(3(x + 2000000) - 6000000)", &more);
    let error = |name: &str, quantity: &str| {
        let error = &number(&found, name, quantity)["error"];
        ["p999", "max"].map(|which| error[which].as_f64().unwrap())
    };
    for quantity in ["value", "gradient", "position"] {
        let ([single, _], [double, _]) = (error("default", quantity), error("double", quantity));
        assert!(single > 1e3 * double, "{quantity}: {single} {double}");
    }
    let [p999, max] = error("default", "value");
    assert!((0.05..=max).contains(&p999), "{p999} {max}");
    // a pixel is 0.17 wide, or 0.5 of the argument; beside extrema lines move without bound
    let mean = number(&found, "default", "position")["error"]["mean"]
        .as_f64()
        .unwrap();
    assert!((0.05..0.9).contains(&mean), "{mean}");
}

#[test]
fn depth_is_judged_where_there_is_a_surface() {
    let formula = "f(x, y, z) = x^2 + y^2 + z^2 - 1\nshow surface(f) { backdrop = plain, steps = 32, box = 1 }";
    let found = found_within(formula, ["48x36", "60"], &["--samples", "1"]);
    let depth = number(&found, "default", "depth");
    let max = depth["error"]["max"].as_f64().unwrap();
    assert!(max > 0.0 && max < 1e-3, "{max}");
    // seen from 7 radii away at 14 degrees to half a side, the sphere is a disc of 10.3 pixels, and all of it is known
    let pixels = depth["pixels"].as_u64().unwrap();
    assert!((310..=350).contains(&pixels), "{pixels}");
    assert_eq!(depth["unit"], "world units");
}

#[test]
fn a_second_run_finds_what_the_first_one_told() {
    let found = found("sin(3x) cos(4y)", &[]);
    let second = &found["second_run"];
    assert_eq!(second["note"], Value::Null, "{second}");
    let checks = second["checks"].as_array().unwrap();
    assert!(!checks.is_empty() && checks[0]["choice"] == 0, "{second}");
    for check in checks {
        let told = &found["choices"][check["choice"].as_u64().unwrap() as usize];
        let [told, now] =
            [&told["error"], &check["error"]].map(|error| error["flip"]["mean"].as_f64().unwrap());
        // what was found is what the two runs are judged by
        let allowed = check["allowed_flip"].as_f64().unwrap();
        let holds = (told - now).abs() <= allowed;
        assert_eq!(check["error_holds"], holds, "{second}");
        // the whole of so small a picture is known: the same picture comes again
        if second["elsewhere"] == false {
            assert_eq!(told, now, "{second}");
        }
    }
}

#[test]
fn steps_of_a_volume_are_traded() {
    let formula =
        "f(x, y, z) = exp(-3(x^2 + y^2 + z^2)) cos(4x)\nshow volume(f) { steps = 16, jitter = 0 }";
    let found = found(formula, &["--samples", "1"]);
    let names = [
        "steps = 4",
        "steps = 8",
        "default",
        "steps = 32",
        "steps = 64",
    ];
    let errors = names.map(|name| flip(&found, name));
    assert!(errors[0] > errors[2] && errors[2] > errors[4], "{errors:?}");
    // light before tone mapping
    let radiance = |name: &str| {
        let error = &number(&found, name, "radiance")["error"];
        error["p999"].as_f64().unwrap()
    };
    let errors = names.map(radiance);
    assert!(errors[0] > errors[2] && errors[2] > errors[4], "{errors:?}");
    // a way that the formula does not have says why
    let integral = choice(&found, "steps_by = integral");
    assert!(
        integral["error"].is_object() || integral["note"].as_str().unwrap().contains("integral")
    );
}

#[test]
fn what_is_nowhere_a_number_is_measured_all_the_same() {
    let found = found("log(-1 - x^2)", &[]);
    assert!(
        flip(&found, "default") < 0.05,
        "the pattern of what is undefined"
    );
    assert!(found["advice"]["unseen"].is_number());
}

#[test]
fn a_budget_that_is_too_small_keeps_what_there_is() {
    let found = found_within("sin(x y)", ["640x480", "0.01"], &[]);
    let known = found["truth"]["pixels"].as_u64().unwrap();
    assert!((64..640 * 480).contains(&known), "{known}");
    let notes: Vec<&str> = found["choices"]
        .as_array()
        .unwrap()
        .iter()
        .filter_map(|c| c["note"].as_str())
        .collect();
    assert!(
        notes.iter().any(|note| note.contains("budget")),
        "{notes:?}"
    );
}

#[test]
fn the_report_is_one_file() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = [
        "measure",
        "x^2 - y < 1 & \"",
        "--size",
        "40x30",
        "--budget",
        "1",
        "-o",
        "report.html",
    ];
    let (code, _, errors) = pullback(folder.path(), &arguments);
    assert_eq!(code, 1, "a formula with errors: {errors}");
    assert!(!folder.path().join("report.html").exists());
    let arguments = [
        "measure",
        "sin(x) + cos(y)",
        "--size",
        "40x30",
        "--budget",
        "60",
        "-q",
        "-o",
        "report.html",
        "--adapter",
        "software",
    ];
    let (code, table, errors) = pullback(folder.path(), &arguments);
    assert_eq!(code, 0, "{errors}");
    assert!(
        table.contains("default") && table.contains("half the time"),
        "{table}"
    );
    let page = std::fs::read_to_string(folder.path().join("report.html")).unwrap();
    assert!(page.contains("<svg") && page.matches("data:image/png;base64,").count() == 3);
    assert!(
        !page.contains("src=\"http") && !page.contains("<script"),
        "nothing from elsewhere"
    );
    assert!(page.contains("<title>pullback measure: "));
}

#[test]
fn several_pictures_are_a_table() {
    let folder = tempfile::tempdir().unwrap();
    let two = [
        "measure", "x + y", "sin(x y)", "--size", "32x24", "--budget", "20", "-q",
    ];
    let arguments = [&two[..], &["--adapter", "software"]].concat();
    let (code, table, errors) = pullback(folder.path(), &arguments);
    assert_eq!(code, 0, "{errors}");
    let lines: Vec<&str> = table
        .lines()
        .filter(|line| line.starts_with("| "))
        .collect();
    assert_eq!(lines.len(), 4, "{table}");
    let cells = |line: &str| line.split('|').count();
    assert!(
        lines.iter().all(|line| cells(line) == cells(lines[0])),
        "{table}"
    );
    // a run that was stopped goes on where the file ends
    let kept = [&arguments[..], &["-o", "table.md"]].concat();
    let path = folder.path().join("table.md");
    let begun = table.lines().take(7).collect::<Vec<_>>().join("\n") + "\n";
    std::fs::write(&path, &begun).unwrap();
    assert_eq!(pullback(folder.path(), &kept).0, 0);
    let whole = std::fs::read_to_string(&path).unwrap();
    let count = |text: &str| text.lines().count();
    assert!(
        whole.starts_with(&begun) && count(&whole) == count(&begun) + 1,
        "{whole}"
    );
    std::fs::write(&path, "another\n").unwrap();
    assert_eq!(pullback(folder.path(), &kept).0, 2);
    let json = [&arguments[..], &["--format", "json"]].concat();
    assert_eq!(pullback(folder.path(), &json).0, 2);
}

#[test]
fn wrong_tries_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    for (words, expected) in [
        ("samples=0", "samples=0"),
        ("precision=exact", "there are fast"),
        ("stepz=3", "stepz"),
        ("k=2", "a parameter changes what is shown"),
    ] {
        let formula = "param k = 1 in 0..3; f(x, y) = k x y; show levels(f)";
        let (code, _, errors) = pullback(
            folder.path(),
            &["measure", formula, "--try", words, "--budget", "1"],
        );
        assert_eq!(code, 2, "{words}: {errors}");
        assert!(errors.contains(expected), "{words}: {errors}");
    }
}

#[test]
fn the_reference_is_no_adapter_to_measure() {
    let folder = tempfile::tempdir().unwrap();
    let words = ["measure", "x y", "--adapter", "reference"];
    let (code, _, errors) = pullback(folder.path(), &words);
    assert_eq!(code, 2, "{errors}");
    assert!(
        errors.contains("what every choice is measured against"),
        "{errors}"
    );
}

#[test]
fn an_adapter_that_is_lost_in_the_middle_leaves_what_was_found() {
    let source = "f(x, y) = sin(3x y)\nshow levels(f)";
    let program = pullback_compiler::compile(source).program.unwrap();
    let picture = &program.pictures()[0];
    let gpu = Gpu::open(&AdapterChoice::Software).unwrap();
    let default = Choice {
        changes: Vec::new(),
        precision: Precision::Accurate,
        settings: picture.settings.clone(),
        samples: 1,
    };
    let choices = measure::choices(picture, &default, &[Precision::Accurate]);
    let scene = |settings: &[SettingValue], tier: Tier| {
        let made = program.scene_module_with(0, settings, tier);
        made.map_err(|problems| format!("{problems:?}"))
    };
    let job = Job {
        gpu: &gpu,
        picture,
        frame: Frame {
            view: View {
                center: [0.0, 0.0],
                height: 4.0,
            },
            params: &[],
            settings: &[],
            size: Size {
                width: 32,
                height: 24,
            },
            samples: 1,
            time: 0.0,
            pipeline: Pipeline::Linear,
        },
        choices: &choices,
        scene: &scene,
        budget: Duration::from_secs(20),
    };
    // the fault: the device goes away while the third choice is being drawn
    let report = measure::run(&job, &mut |what, done, _| {
        if what == "drawing" && done == 2 {
            gpu.device().destroy();
        }
    })
    .unwrap();
    let drawn: Vec<bool> = report.rows.iter().map(|row| row.error.is_some()).collect();
    assert_eq!(drawn, [true, true, false, false], "{:?}", report.rows);
    for row in &report.rows[2..] {
        let note = row.note.as_deref().unwrap_or_default();
        assert!(note.contains("lost") || note.contains("device"), "{note}");
    }
    let again = &report.again;
    assert!(again.checks.iter().all(|check| check.error.is_none()) && again.note.is_some());
}

#[test]
fn a_scene_that_takes_minutes_is_stopped_by_the_budget() {
    let formula = "f(x, y) = iterate(2000, s = 0, sin(s + x)) + y\nshow levels(f)";
    let found = found_within(formula, ["640x480", "1"], &[]);
    let note = choice(&found, "default")["note"].as_str().unwrap();
    assert!(note.contains("a picture would take about"), "{note}");
    assert_eq!(found["advice"]["unseen"], Value::Null);
    assert!(found["truth"]["pixels"].as_u64().unwrap() >= 64);
}
