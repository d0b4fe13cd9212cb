//! The JSON schemas in `docs/schema`, and whether a value fits one.

use std::path::Path;

use serde_json::Value;

/// A schema by its name.
pub fn read(name: &str) -> Value {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/schema");
    let text = std::fs::read_to_string(folder.join(format!("{name}.json"))).unwrap();
    serde_json::from_str(&text).unwrap()
}

/// Says where a value does not fit a schema. Knows the words that our schemas use, and refuses others.
pub fn misfit(schema: &Value, root: &Value, value: &Value, path: &str) -> Option<String> {
    let rules = schema.as_object().unwrap();
    for (word, rule) in rules {
        let fits = match word.as_str() {
            "$schema" | "title" | "description" | "$defs" => true,
            "$ref" => {
                let name = rule.as_str().unwrap().strip_prefix("#/$defs/").unwrap();
                if let Some(problem) = misfit(&root["$defs"][name], root, value, path) {
                    return Some(problem);
                }
                true
            }
            "type" => match rule {
                Value::Array(types) => types.iter().any(|ty| has_type(value, ty)),
                ty => has_type(value, ty),
            },
            "const" => value == rule,
            "enum" => rule.as_array().unwrap().contains(value),
            "minimum" => value.as_f64().unwrap() >= rule.as_f64().unwrap(),
            "pattern" => {
                assert_eq!(rule, "^[a-z0-9-]+$");
                let kebab = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
                value
                    .as_str()
                    .is_some_and(|text| !text.is_empty() && text.chars().all(kebab))
            }
            "required" => {
                let mut names = rule.as_array().unwrap().iter();
                !value.is_object() || names.all(|name| value.get(name.as_str().unwrap()).is_some())
            }
            "properties" => {
                let known = rule.as_object().unwrap();
                // Readers accept more fields; here, one that the schema does not describe is a mistake.
                if let Some(name) = value
                    .as_object()
                    .and_then(|found| found.keys().find(|name| !known.contains_key(*name)))
                {
                    return Some(format!("{path}/{name} is not described"));
                }
                for (name, rule) in known {
                    let part = value.get(name);
                    let problem =
                        part.and_then(|part| misfit(rule, root, part, &format!("{path}/{name}")));
                    if problem.is_some() {
                        return problem;
                    }
                }
                true
            }
            "items" => {
                for (index, item) in value.as_array().into_iter().flatten().enumerate() {
                    let problem = misfit(rule, root, item, &format!("{path}/{index}"));
                    if problem.is_some() {
                        return problem;
                    }
                }
                true
            }
            other => panic!("the schema has the word {other}, which this test does not know"),
        };
        if !fits {
            return Some(format!("{path}: {value} does not fit {word}: {rule}"));
        }
    }
    None
}

fn has_type(value: &Value, ty: &Value) -> bool {
    match ty.as_str().unwrap() {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "integer" => value.is_u64() || value.is_i64(),
        "number" => value.is_number(),
        "boolean" => value.is_boolean(),
        "null" => value.is_null(),
        other => panic!("unknown type {other}"),
    }
}
