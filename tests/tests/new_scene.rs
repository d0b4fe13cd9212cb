//! docs/new-scene.md: its template takes a formula, and its record has the template's settings.

use std::collections::BTreeSet;

use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{Module, TypeInner};
use pullback_compiler::lower::Tier;
use pullback_compiler::module::SceneModule;
use pullback_compiler::scene::scene;
use pullback_tests::corpus::{read, root};
use pullback_tests::units::finite_differences;

/// The block of code in a language.
fn block(language: &str) -> String {
    let page = read(&root().join("docs/new-scene.md"));
    let (_, rest) = page
        .split_once(&format!("```{language}\n"))
        .expect("a block");
    rest.split_once("```").expect("its end").0.to_owned()
}

fn template() -> Module {
    let text = block("wgsl");
    naga::front::wgsl::parse_str(&text)
        .unwrap_or_else(|error| panic!("{}", error.emit_to_string(&text)))
}

#[test]
fn the_template_takes_any_formula() {
    let template = template();
    assert!(finite_differences(&template).is_empty());
    for source in [
        "f(x, y, z) = x y + z",
        "f(p: vec3) = 0.3 + fbm(p)",
        "param a = 2\nf(x, y, z) = 1/(x^2 + a y^2 + |z|)",
    ] {
        let compiled = pullback_compiler::compile(&format!("{source}\nshow surface(f)"));
        let program = compiled.program.expect("a program");
        let formula = &program.pictures()[0].formula;
        let linked = SceneModule::splice(&template, formula, Tier::default()).expect("a module");
        Validator::new(ValidationFlags::all(), Capabilities::default())
            .validate(&linked)
            .unwrap_or_else(|error| panic!("{source}: {error:?}"));
        let entries: BTreeSet<&str> = linked
            .entry_points
            .iter()
            .map(|e| e.name.as_str())
            .collect();
        assert!(entries.contains("compute_main") && entries.contains("fragment_main"));
        // the shared camera in place of its stub: it takes the axes of `camera_axes`
        let has = |name: &str| {
            let named = |f: &naga::Function| f.name.as_deref() == Some(name);
            linked.functions.iter().any(|(_, f)| named(f))
        };
        assert!(has("camera_axes") && has("box_span") && !has("walk_on"));
    }
}

/// Each shared setting is one that other scenes of space have under the name of its constant in lower case.
#[test]
fn the_record_has_the_members_of_the_template() {
    let record = block("rust");
    let (_, list) = record.split_once("settings: &[").expect("settings");
    let volume = scene("volume").expect("a scene");
    let mut named = BTreeSet::new();
    for line in list.lines().map(str::trim) {
        let shared = line
            .strip_prefix("space::")
            .or(line.strip_prefix("camera::"));
        if let Some(shared) = shared {
            let name = shared.trim_end_matches(',').to_lowercase();
            let spec = volume.setting(&name).expect("a shared setting");
            named.insert(spec.name.to_owned());
        } else if let Some(name) = line.strip_prefix('"').and_then(|l| l.strip_suffix("\","))
            && !name.contains(' ')
        {
            named.insert(name.to_owned());
        }
    }
    let template = template();
    let (_, settings) = template
        .types
        .iter()
        .find(|(_, t)| t.name.as_deref() == Some("Settings"))
        .expect("settings");
    let TypeInner::Struct { members, .. } = &settings.inner else {
        panic!("`Settings` is no structure");
    };
    let mut found = BTreeSet::new();
    for member in members {
        match &template.types[member.ty].inner {
            TypeInner::Struct { members, .. } => {
                found.extend(members.iter().filter_map(|m| m.name.clone()));
            }
            _ => found.extend(member.name.clone()),
        }
    }
    assert_eq!(named, found);
}
