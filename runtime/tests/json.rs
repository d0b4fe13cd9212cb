//! `pullback check --format json`: what is written fits the schema in `docs/schema`, and says what is there.

#[path = "shared/schema.rs"]
mod schema;

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use schema::misfit;
use serde_json::{Value, json};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn schema() -> Value {
    schema::read("diagnostics-1")
}

/// Checks these inputs in a folder; the exit code, the object, and the standard error.
fn check(folder: &Path, inputs: &[&str], input: &str) -> (i32, Value, String) {
    let mut child = Command::new(env!("CARGO_BIN_EXE_pullback"))
        .args(["check", "--format", "json"])
        .args(inputs)
        .current_dir(folder)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let _ = std::io::Write::write_all(&mut child.stdin.take().unwrap(), input.as_bytes());
    let Output {
        status,
        stdout,
        stderr,
    } = child.wait_with_output().unwrap();
    let value: Value = serde_json::from_slice(&stdout).unwrap();
    let schema = schema();
    assert_eq!(misfit(&schema, &schema, &value, ""), None);
    (
        status.code().unwrap(),
        value,
        String::from_utf8(stderr).unwrap(),
    )
}

/// The names of the `.pull` files of a folder.
fn programs(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<String> = names.filter(|name| name.ends_with(".pull")).collect();
    names.sort();
    names
}

/// The `.pull` files of the folders of a folder, as paths from there.
fn programs_of_folders(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let groups = entries.map(|entry| entry.unwrap().path());
    let mut names: Vec<String> = Vec::new();
    for group in groups.filter(|path| path.is_dir()) {
        let name = group.file_name().unwrap().to_str().unwrap();
        names.extend(programs(&group).iter().map(|p| format!("{name}/{p}")));
    }
    names.sort();
    names
}

#[test]
fn every_wrong_program_fits_the_schema() {
    let folder = root().join("tests/data/errors");
    let names = programs_of_folders(&folder);
    assert!(names.len() >= 60);
    let inputs: Vec<&str> = names.iter().map(String::as_str).collect();
    // Without the expectations, one of which would end a comment.
    let stripped = tempfile::tempdir().unwrap();
    for name in &names {
        let text = std::fs::read_to_string(folder.join(name)).unwrap();
        let end = text.find("\n//!").map_or(0, |at| at + 1);
        let group = Path::new(name).parent().unwrap();
        std::fs::create_dir_all(stripped.path().join(group)).unwrap();
        std::fs::write(stripped.path().join(name), &text[..end]).unwrap();
    }
    let (code, value, errors) = check(stripped.path(), &inputs, "");
    assert_eq!((code, errors.as_str()), (1, ""));
    let files = value["files"].as_array().unwrap();
    assert_eq!(files.len(), names.len());
    let mut count = 0;
    for (file, name) in files.iter().zip(&names) {
        assert_eq!(file["file"], name.as_str());
        let text = std::fs::read_to_string(folder.join(name)).unwrap();
        // The codes and places that the file says it gives, where it names the text.
        let found = file["diagnostics"].as_array().unwrap();
        for line in text.lines().filter_map(|line| line.strip_prefix("//! ")) {
            let (code, rest) = line.split_once(" \"").unwrap();
            let spanned = rest.rsplit_once("\" :").unwrap().0;
            let fits = |diagnostic: &Value| {
                let span = &diagnostic["span"];
                let at = |end: &str| span[end].as_u64().unwrap() as usize;
                diagnostic["code"] == code
                    && (spanned.is_empty() || text.get(at("start")..at("end")) == Some(spanned))
            };
            assert!(found.iter().any(fits), "{name}: no {code}");
            count += 1;
        }
        let is_error = |diagnostic: &Value| diagnostic["severity"] == "error";
        assert_eq!(file["ok"], !found.iter().any(is_error), "{name}");
    }
    let summary = &value["summary"];
    let told = summary["errors"].as_u64().unwrap() + summary["warnings"].as_u64().unwrap();
    assert_eq!(told, count);
}

#[test]
fn the_gallery_fits_the_schema() {
    let folder = root().join("docs/gallery");
    let names = programs(&folder);
    let inputs: Vec<&str> = names.iter().map(String::as_str).collect();
    let (code, value, errors) = check(&folder, &inputs, "");
    assert_eq!((code, errors.as_str()), (0, ""));
    assert_eq!(
        value["summary"],
        json!({ "files": names.len(), "errors": 0, "warnings": 0 })
    );
    for file in value["files"].as_array().unwrap() {
        assert_eq!(file["shows"].as_array().unwrap().len(), 1, "{file}");
    }
}

#[test]
fn symbols_have_types_and_ranges() {
    let text = "param k = 2 in 1..3\r\na = 2i\r\n// 𝟙\r\nq(t) = t⁴\r\nf(z) = k a q(z) + q(k)\r\nunused(p: vec2) = |p|\r\n";
    let (code, value, _) = check(Path::new("."), &["-"], text);
    assert_eq!(code, 0, "{value}");
    let file = &value["files"][0];
    assert_eq!(file["file"], "standard input");
    let symbols = &file["symbols"];
    let param = &symbols["params"][0];
    assert_eq!(
        (&param["name"], &param["default"]),
        (&json!("k"), &json!(2.0))
    );
    assert_eq!((&param["min"], &param["max"]), (&json!(1.0), &json!(3.0)));
    let constant = &symbols["constants"][0];
    assert_eq!(
        (&constant["name"], &constant["type"]),
        (&json!("a"), &json!("complex"))
    );
    let functions = symbols["functions"].as_array().unwrap();
    let signatures = |k: usize| functions[k]["signatures"].clone();
    assert_eq!(
        signatures(0),
        json!([
            { "parameters": ["complex"], "result": "complex" },
            { "parameters": ["real"], "result": "real" },
        ])
    );
    assert_eq!(
        signatures(1),
        json!([{ "parameters": ["complex"], "result": "complex" }])
    );
    assert_eq!(
        signatures(2),
        json!([{ "parameters": ["vec2"], "result": "real" }])
    );
    assert_eq!(
        functions[2]["parameters"],
        json!([{ "name": "p", "type": "vec2" }])
    );
    let start = text.find("f(z)").unwrap();
    assert_eq!(
        functions[1]["span"],
        json!({
            "start": start,
            "end": start + 1,
            "range": { "start": { "line": 4, "character": 0 }, "end": { "line": 4, "character": 1 } },
        })
    );
    let shown = &file["shows"][0];
    assert_eq!(
        (&shown["scene"], &shown["function"]),
        (&json!("domain"), &json!("f"))
    );
}

#[test]
fn symbols_of_a_program_with_errors() {
    let text = "param k = 2\nf(x, y) = k x + nothing\ng(x) = 2x";
    let (code, value, errors) = check(Path::new("."), &["-"], text);
    assert_eq!((code, errors.as_str()), (1, ""));
    let file = &value["files"][0];
    assert_eq!(file["ok"], false);
    assert_eq!(file["diagnostics"][0]["code"], "unknown-name");
    assert_eq!(file["shows"], json!([]));
    let functions = file["symbols"]["functions"].as_array().unwrap();
    let names: Vec<&Value> = functions.iter().map(|f| &f["name"]).collect();
    assert_eq!(names, ["f", "g"]);
    assert_eq!(functions[0]["signatures"], json!([]));
    assert_ne!(functions[1]["signatures"], json!([]));
}

#[test]
fn what_cannot_be_read() {
    let (code, value, errors) = check(Path::new("."), &["missing.pull", "x + y"], "");
    assert_eq!(code, 4);
    assert!(errors.contains("missing.pull: no such file"), "{errors}");
    assert_eq!(value["files"].as_array().unwrap().len(), 1);
    assert_eq!(value["files"][0]["file"], "formula");
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.pull"), b"f(x) = \xff").unwrap();
    let (code, value, _) = check(folder.path(), &["a.pull"], "");
    let found = &value["files"][0]["diagnostics"][0];
    assert_eq!((code, &found["code"]), (1, &json!("not-utf8")));
    assert_eq!(found["span"]["start"], 7);
}

#[test]
fn the_schema_refuses_what_does_not_fit() {
    let schema = schema();
    let good = check(Path::new("."), &["param k = 1\n1/2k + q"], "").1;
    let refused = |change: &dyn Fn(&mut Value)| {
        let mut bad = good.clone();
        change(&mut bad);
        assert_ne!(bad, good);
        assert!(misfit(&schema, &schema, &bad, "").is_some(), "{bad}");
    };
    refused(&|v| v["version"] = json!(2));
    refused(&|v| v["files"][0]["diagnostics"][0]["severity"] = json!("fatal"));
    refused(&|v| v["files"][0]["diagnostics"][0]["code"] = json!("Not Kebab"));
    refused(&|v| v["files"][0]["diagnostics"][0]["span"]["start"] = json!(-1));
    refused(&|v| v["files"][0]["symbols"]["params"][0]["more"] = json!(1));
    refused(&|v| {
        v["files"][0].as_object_mut().unwrap().remove("shows");
    });
}
