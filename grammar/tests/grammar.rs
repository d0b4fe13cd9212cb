//! `grammar.ebnf` and the parser have the same productions.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The productions of the grammar with what each stands for, comments left out, blanks as one.
fn productions() -> BTreeMap<String, String> {
    let grammar = std::fs::read_to_string(root().join("grammar.ebnf")).expect("the grammar");
    let mut text = String::new();
    let mut rest = grammar.as_str();
    while let Some((before, comment)) = rest.split_once("(* ") {
        text.push_str(before);
        rest = comment.split_once("*)").expect("the end of a comment").1;
    }
    text.push_str(rest);
    let mut found = BTreeMap::new();
    for production in text.split(" ;\n").filter(|text| !text.trim().is_empty()) {
        let (name, body) = production.split_once('=').expect("a production");
        let body = body.split_whitespace().collect::<Vec<_>>().join(" ");
        let is_new = found.insert(name.trim().to_owned(), body).is_none();
        assert!(is_new, "{name} is there twice");
    }
    found
}

/// The functions of the parser with the syntax that their documentation shows.
fn functions() -> BTreeMap<String, String> {
    let mut found = BTreeMap::new();
    for entry in std::fs::read_dir(root().join("src/parser")).expect("the parser") {
        let path = entry.expect("a file of the parser").path();
        let text = std::fs::read_to_string(path).expect("a file of the parser");
        let mut doc = String::new();
        for line in text.lines().map(str::trim_start) {
            if let Some(line) = line.strip_prefix("/// ") {
                doc.push_str(line);
            } else if let Some((_, rest)) = line.split_once("fn ") {
                let name: String = rest
                    .chars()
                    .take_while(|c| *c == '_' || c.is_alphanumeric())
                    .collect();
                found.insert(name, std::mem::take(&mut doc));
            }
        }
    }
    found
}

#[test]
fn productions_are_functions() {
    let productions: BTreeSet<String> = productions().into_keys().collect();
    let functions: BTreeSet<String> = functions().into_keys().collect();
    assert_eq!(productions, functions);
    assert!(productions.len() > 30);
}

#[test]
fn functions_show_their_production() {
    let functions = functions();
    for (name, body) in productions() {
        let doc = &functions[&name];
        assert!(
            doc.starts_with(&format!("`{name} = {body}`")),
            "{name}: {doc}, not {body}"
        );
    }
}

#[test]
fn productions_are_defined() {
    let productions = productions();
    for (name, body) in &productions {
        let used = body
            .split(' ')
            .filter(|word| word.chars().all(|c| c.is_ascii_lowercase()));
        for word in used {
            assert!(productions.contains_key(word), "{word} in {name}");
        }
    }
}
