//! What `diff` and `probe` write for programs fits the schemas in `docs/schema`.

#[path = "shared/schema.rs"]
mod schema;
mod shared;

use std::path::Path;

use schema::{misfit, read};
use serde_json::{Value, json};
use shared::pullback;

/// What a command writes, which must fit a schema.
fn fitting(name: &str, arguments: &[&str]) -> Value {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/gallery");
    let arguments = [arguments, &["--format", "json", "-q"]].concat();
    let (code, out, errors) = pullback(&folder, &arguments);
    assert_eq!(code, 0, "{arguments:?}: {errors}");
    let value: Value = serde_json::from_str(&out).unwrap();
    let schema = read(name);
    assert_eq!(misfit(&schema, &schema, &value, ""), None, "{arguments:?}");
    value
}

/// A value that is changed so does not fit any more.
fn refused(name: &str, good: &Value, change: impl Fn(&mut Value)) {
    let schema = read(name);
    let mut bad = good.clone();
    change(&mut bad);
    assert_ne!(bad, *good);
    assert!(misfit(&schema, &schema, &bad, "").is_some(), "{bad}");
}

#[test]
fn differences_of_pictures() {
    let sides = ["--a", "ieee32", "--b", "reference", "--size", "24x18"];
    let small = [&["diff", "sin-rings.pull"], &sides[..]].concat();
    let limits = ["--threshold", "flip=1", "--threshold", "psnr=1"];
    let found = fitting("diff-1", &[&small[..], &limits].concat());
    assert_eq!(found["thresholds"].as_array().unwrap().len(), 2);
    let equal = ["--a", "ieee32", "--b", "ieee32", "--size", "9x9"];
    let same = fitting("diff-1", &[&["diff", "x + y"], &equal[..]].concat());
    assert_eq!(same["psnr"], Value::Null);
    refused("diff-1", &found, |v| v["version"] = json!(2));
    refused("diff-1", &found, |v| v["flip"]["max"] = json!("1"));
    refused("diff-1", &found, |v| v["linear"]["red"]["more"] = json!(1));
    refused("diff-1", &found, |v| {
        v.as_object_mut().unwrap().remove("psnr");
    });
}

#[test]
fn measurements() {
    let small = ["--size", "32x24", "--budget", "2", "--adapter", "software"];
    let found = fitting(
        "measure-1",
        &[&["measure", "sin-rings.pull"], &small[..]].concat(),
    );
    assert_eq!(found["choices"][0]["name"], "default");
    assert_eq!(found["truth"]["pixels"], 32 * 24);
    assert_eq!(found["choices"][0]["numbers"][0]["quantity"], "value");
    refused("measure-1", &found, |v| {
        v["choices"][0]["numbers"][0]["quantity"] = json!("colour");
    });
    refused("measure-1", &found, |v| {
        v["second_run"].as_object_mut().unwrap().remove("holds");
    });
    refused("measure-1", &found, |v| v["version"] = json!(2));
    refused("measure-1", &found, |v| {
        v["choices"][0]["on_front"] = json!("yes")
    });
    refused("measure-1", &found, |v| {
        v["choices"][0]["error"]["more"] = json!(1)
    });
    refused("measure-1", &found, |v| {
        v["advice"]["unseen"] = json!("none")
    });
}

#[test]
fn probes() {
    let on = ["--on", "ieee32,reference"];
    let point = [
        "probe",
        "sqrt(x^2 + 1) - x",
        "--at",
        "300",
        "--all",
        "--rewrites",
        "off",
    ];
    let parted = fitting("probe-1", &[&point[..], &on].concat());
    assert_eq!(parted["partings"][0]["kind"], "value");
    let pixel = [
        "probe",
        "mandelbrot.pull",
        "--pixel",
        "40,30",
        "--size",
        "80x60",
    ];
    let orbit = fitting("probe-1", &[&pixel[..], &on, &["--steps", "3"]].concat());
    assert!(orbit["values"].as_array().unwrap().len() > 10);
    let nan = ["probe", "log(x) + 0 y", "--at", "-1,0"];
    let odd = fitting("probe-1", &[&nan[..], &on].concat());
    let told = odd["values"].to_string();
    assert!(told.contains("\"NaN\""), "{told}");
    for value in [&parted, &orbit] {
        refused("probe-1", value, |v| v["version"] = json!(2));
        refused("probe-1", value, |v| {
            v["values"][0]["what"] = json!("thing")
        });
        refused("probe-1", value, |v| {
            v["machines"][0]["name"] = json!("tpu")
        });
    }
    refused("probe-1", &parted, |v| {
        let site = v["partings"][0]["site"].as_object_mut().unwrap();
        site.remove("span");
    });
}

#[test]
fn odd_pixels() {
    let places = ["--nan", "--on", "ieee32,reference", "--size", "65x48"];
    let found = fitting(
        "probe-nan-2",
        &[&["probe", "y + log(x)"], &places[..]].concat(),
    );
    assert_eq!(found["machines"].as_array().unwrap().len(), 2);
    let calm = fitting("probe-nan-2", &[&["probe", "x + y"], &places[..]].concat());
    assert_eq!(calm["machines"][0]["nan"]["first"], Value::Null);
    refused("probe-nan-2", &found, |v| v["version"] = json!(1));
    refused("probe-nan-2", &found, |v| {
        v["machines"][0]["nan"]["operations"][0]["pixels"] = json!(-1);
    });
    refused("probe-nan-2", &found, |v| {
        v["machines"][1].as_object_mut().unwrap().remove("infinite");
    });
}

/// Both tables of a comparison of many pictures.
#[test]
fn differences_of_the_gallery() {
    let folder = tempfile::tempdir().unwrap();
    for (name, formula) in [
        ("a.pull", "sin(x^2 + y^2)"),
        ("b.pull", "w² where w = z + 1"),
    ] {
        std::fs::write(folder.path().join(name), formula).unwrap();
    }
    let computers = [
        "--adapter",
        "ieee32",
        "--compare",
        "ieee32:fast",
        "--tile",
        "24x18",
    ];
    let files = ["--json", "a.json", "--markdown", "a.md"];
    let arguments = [&["gallery", "."], &computers[..], &files].concat();
    let (code, out, errors) = pullback(folder.path(), &arguments);
    assert_eq!((code, out.as_str()), (0, ""), "{errors}");
    let text = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    let value: Value = serde_json::from_str(&text("a.json")).unwrap();
    let schema = read("gallery-1");
    assert_eq!(misfit(&schema, &schema, &value, ""), None);
    let names: Vec<&Value> = value["pictures"]
        .as_array()
        .unwrap()
        .iter()
        .map(|p| &p["name"])
        .collect();
    assert_eq!(names, ["a", "b"]);
    let table = text("a.md");
    assert!(
        table.contains("| a | levels | ") && table.contains("| b | domain | "),
        "{table}"
    );
    refused("gallery-1", &value, |v| {
        v["pictures"][0]["max"] = Value::Null
    });
    let alone = [&["gallery", "."], &computers[..]].concat();
    let (_, out, _) = pullback(folder.path(), &alone);
    assert_eq!(out, table);
}

/// FLIP of a pixel from which on a difference has a reason in the documents.
const SEEN: f64 = 0.04;

/// The table in the documents has every picture, and a reason for each that can be told from the truth.
#[test]
fn every_difference_of_the_gallery_has_a_reason() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs");
    let text = std::fs::read_to_string(docs.join("gallery-differences.md")).unwrap();
    let (table, reasons) = text.split_once("## Reasons").unwrap();
    let reasons = reasons.split("\n## ").next().unwrap();
    let rows: Vec<Vec<&str>> = table
        .lines()
        .filter(|line| line.starts_with("| ") && line.contains(" % |"))
        .map(|line| line.split('|').map(str::trim).collect())
        .collect();
    let mut drawn: Vec<String> = std::fs::read_dir(docs.join("gallery"))
        .unwrap()
        .filter_map(|entry| entry.unwrap().file_name().into_string().ok())
        .filter_map(|name| Some(name.strip_suffix(".pull")?.to_owned()))
        .collect();
    drawn.sort();
    let mut told: Vec<&str> = rows.iter().map(|row| row[1]).collect();
    told.sort_unstable();
    assert_eq!(told, drawn);
    for row in &rows {
        let seen: f64 = row[7].parse().unwrap();
        let named = format!("`{}`", row[1]);
        assert_eq!(
            seen >= SEEN,
            reasons.contains(&named),
            "{named}: FLIP {seen}"
        );
    }
}
