//! Scene templates and shader libraries: each valid by itself, of one convention, without finite differences.

use std::collections::BTreeMap;

use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{Function, Module, ScalarKind, Statement, TypeInner, VectorSize};
use pullback_compiler::link::{Linker, Provider, Sources, is_stub};
use pullback_compiler::lower::{LowerError, Precision, Tier};
use pullback_compiler::scene::{ENTRIES, Scene, SettingKind, Space, TABLE, scene, scenes};
use pullback_tests::corpus::{Source, files, read, root};
use pullback_tests::units::{FIELD_STUBS, copies, evaluations, finite_differences};

fn parse(name: &str, text: &str) -> Module {
    naga::front::wgsl::parse_str(text)
        .unwrap_or_else(|error| panic!("{}", error.emit_to_string_with_path(text, name)))
}

fn validate(name: &str, module: &Module) -> ModuleInfo {
    Validator::new(ValidationFlags::all(), Capabilities::default())
        .validate(module)
        .unwrap_or_else(|error| panic!("{name}: {error:?}"))
}

/// Every scene, the entry points and the evaluation, each with its parsed module.
fn templates() -> Vec<(String, Module)> {
    let mut sources = files("compiler/shaders/scenes", "wgsl");
    for name in ["shared/entry", "eval"] {
        let text = read(&root().join(format!("compiler/shaders/{name}.wgsl")));
        sources.push(Source {
            name: name.into(),
            text,
        });
    }
    sources
        .into_iter()
        .map(|s| (s.name.clone(), parse(&s.name, &s.text)))
        .collect()
}

#[test]
fn every_template_is_valid_by_itself() {
    for (name, module) in templates() {
        validate(&name, &module);
    }
}

#[test]
fn the_libraries_are_valid_and_whole() {
    // with what stands in for `fma`
    let sources = Sources::get(Tier {
        splits_fma: true,
        ..Tier::default()
    });
    let fast = Sources::get(Precision::Fast.into());
    for (name, module, folder) in [
        ("the number library", sources.math, "math"),
        ("the number library of `fast`", fast.math, "fast"),
        ("the drawing library", sources.shared, "shared"),
    ] {
        validate(name, module);
        // every function of every file of the folder is in the text that the compiler carries
        for source in files(&format!("compiler/shaders/{folder}"), "wgsl") {
            if source.name == "entry" {
                continue;
            }
            for line in source.text.lines().filter_map(|l| l.strip_prefix("fn ")) {
                let function = line.split('(').next().unwrap_or_default();
                let has = |f: &Function| f.name.as_deref() == Some(function);
                let found = module.functions.iter().any(|(_, f)| has(f));
                assert!(
                    found,
                    "`{function}` of {folder}/{} is not in {name}",
                    source.name
                );
            }
        }
        for (_, function) in module.functions.iter() {
            let title = function.name.clone().unwrap_or_default();
            let known = folder == "shared" && OPEN.contains(&title.as_str());
            assert!(known || !is_stub(function), "{name} holds a stub {title}");
        }
    }
}

/// What the drawing library leaves to the formula and to the template.
const OPEN: [&str; 5] = [
    "field",
    "field_ray",
    "field_grad",
    "seen_bound",
    "colour_entry",
];

/// The stub for a second formula, which gives colours.
const COLOURS: &str = "field_colour";

/// Fills no stub.
struct Nothing;

impl Provider for Nothing {
    fn provide(
        &mut self,
        _: &str,
        _: &Function,
        _: &mut Linker,
    ) -> Result<Option<Function>, LowerError> {
        Ok(None)
    }
}

/// A scene with what it takes from the libraries, the stubs for the formula left open.
fn whole(scene: &Scene) -> Module {
    let sources = Sources::get(Tier::default());
    let template = scene.module();
    let mut linker = Linker::new(vec![template, sources.entry, sources.shared, sources.math]);
    linker.link_entry_points(1, &mut Nothing).expect("it links");
    linker.out
}

/// Functions of the drawing library that evaluate the formula.
const LOOPS: [&str; 1] = ["seen_shells"];

/// A template with the library's functions that evaluate its formula; of the others it has stubs, as in its text.
fn with_loops(scene: &Scene) -> Module {
    let mut library = Sources::get(Tier::default()).shared.clone();
    let handles: Vec<_> = library.functions.iter().map(|(h, _)| h).collect();
    for handle in handles {
        let function = &mut library.functions[handle];
        let name = function.name.as_deref().unwrap_or_default();
        let Some(result) = function.result.as_ref().filter(|_| !LOOPS.contains(&name)) else {
            continue;
        };
        let zero = naga::Expression::ZeroValue(result.ty);
        let mut stub = Function {
            name: function.name.clone(),
            arguments: function.arguments.clone(),
            result: function.result.clone(),
            ..Function::default()
        };
        let value = stub.expressions.append(zero, naga::Span::UNDEFINED);
        let value = Some(value);
        stub.body
            .push(Statement::Return { value }, naga::Span::UNDEFINED);
        *function = stub;
    }
    let mut linker = Linker::new(vec![scene.module(), &library]);
    linker.function("shade", &mut Nothing).expect("it links");
    linker.out
}

#[test]
fn the_formula_alone_is_open_in_a_linked_scene() {
    for scene in scenes() {
        for (_, function) in whole(scene).functions.iter().filter(|(_, f)| is_stub(f)) {
            let name = function.name.as_deref().unwrap_or_default();
            let open = FIELD_STUBS.contains(&name) || name == COLOURS;
            assert!(open, "{}: {name}", scene.name);
        }
    }
}

#[test]
fn every_template_belongs_to_a_scene() {
    let known: Vec<&str> = scenes().iter().map(|s| s.name).collect();
    for source in files("compiler/shaders/scenes", "wgsl") {
        assert!(
            known.contains(&source.name.as_str()),
            "no scene for {}.wgsl",
            source.name
        );
    }
    for scene in scenes() {
        let text = read(&root().join(format!("compiler/shaders/scenes/{}.wgsl", scene.name)));
        assert_eq!(scene.template, text, "the template of {}", scene.name);
    }
}

/// A function's argument and result types as text.
fn signature(module: &Module, function: &Function) -> String {
    let ty = |ty: naga::Handle<naga::Type>| match &module.types[ty] {
        naga::Type {
            name: Some(name), ..
        } => name.clone(),
        ty => format!("{:?}", ty.inner),
    };
    let arguments: Vec<String> = function.arguments.iter().map(|a| ty(a.ty)).collect();
    let result = function.result.as_ref().map(|r| ty(r.ty));
    format!("({}) -> {result:?}", arguments.join(", "))
}

#[test]
fn stubs_are_of_the_compiler_or_have_their_twin_in_a_library() {
    let sources = Sources::get(Tier::default());
    let mut known: BTreeMap<String, String> = BTreeMap::new();
    for module in [sources.math, sources.shared] {
        for (_, function) in module.functions.iter() {
            known.insert(
                function.name.clone().unwrap_or_default(),
                signature(module, function),
            );
        }
    }
    for (name, module) in templates() {
        for (_, function) in module.functions.iter().filter(|(_, f)| is_stub(f)) {
            let title = function.name.clone().unwrap_or_default();
            if FIELD_STUBS.contains(&title.as_str())
                || ["shade", "evaluate", COLOURS].contains(&title.as_str())
            {
                continue;
            }
            let found = signature(&module, function);
            match known.get(&title) {
                Some(wanted) => assert_eq!(&found, wanted, "the stub `{title}` of {name}"),
                None => panic!("the stub `{title}` of {name} stands for nothing"),
            }
        }
    }
}

#[test]
fn demands_have_the_contract_s_signatures() {
    // docs/architecture.md, "Shaders, and the linker by name"
    let allowed: BTreeMap<&str, Vec<&str>> = BTreeMap::from([
        (
            "field",
            vec![
                "fn field(offset: vec2f) -> f32",
                "fn field(p: vec3f) -> f32",
            ],
        ),
        (
            "field_grad",
            vec![
                "fn field_grad(offset: vec2f) -> vec3f",
                "fn field_grad(p: vec3f) -> vec4f",
            ],
        ),
        ("field_jet2", vec!["fn field_jet2(offset: vec2f) -> Jet2"]),
        (
            "field_ray",
            vec!["fn field_ray(o: vec3f, d: vec3f, t: f32) -> vec2f"],
        ),
        (
            "field_integral",
            vec!["fn field_integral(o: vec3f, d: vec3f, a: f32, b: f32) -> f32"],
        ),
        (
            "field_column",
            vec!["fn field_column(o: vec3f, d: vec3f, a: f32, b: f32) -> vec3f"],
        ),
        ("map", vec!["fn map(offset: vec2f) -> vec2f"]),
        ("map_jet", vec!["fn map_jet(offset: vec2f) -> Jet"]),
        ("chart_jet", vec!["fn chart_jet(z: vec2f) -> Jet"]),
        (
            "chart_jet_inverse",
            vec!["fn chart_jet_inverse(w: vec2f) -> Jet"],
        ),
    ]);
    for scene in scenes() {
        let mut demands = 0;
        for line in scene.template.lines().filter(|l| l.starts_with("fn ")) {
            let name = line[3..].split('(').next().unwrap_or_default();
            let Some(forms) = allowed.get(name) else {
                continue;
            };
            demands += 1;
            let declared = line.split('{').next().unwrap_or_default().trim();
            assert!(forms.contains(&declared), "{}: {declared}", scene.name);
            let space = if name.starts_with("map") || name.starts_with("chart") {
                Space::Complex
            } else if declared.contains("(offset: vec2f)") {
                Space::Plane
            } else {
                Space::Space
            };
            assert_eq!(space, scene.space, "{}: {declared}", scene.name);
        }
        assert!(demands > 0, "{} asks for nothing", scene.name);
    }
}

#[test]
fn no_hardware_derivatives_no_hidden_state() {
    let mut modules = templates();
    modules.push(("math".into(), Sources::get(Tier::default()).math.clone()));
    modules.push((
        "shared".into(),
        Sources::get(Tier::default()).shared.clone(),
    ));
    for (name, module) in modules {
        let entries = module.entry_points.iter().map(|e| &e.function);
        for function in module.functions.iter().map(|(_, f)| f).chain(entries) {
            let derives = |e: &naga::Expression| matches!(e, naga::Expression::Derivative { .. });
            assert!(
                !function.expressions.iter().any(|(_, e)| derives(e)),
                "{name}: a hardware derivative in {:?}",
                function.name
            );
            assert!(
                !function.body.iter().any(|s| matches!(s, Statement::Kill)),
                "{name}: `discard` in {:?}",
                function.name
            );
        }
        assert!(module.overrides.is_empty(), "{name} has an override");
        for (_, global) in module.global_variables.iter() {
            let hidden = matches!(
                global.space,
                naga::AddressSpace::Private | naga::AddressSpace::WorkGroup
            );
            assert!(!hidden, "{name}: `{:?}` is hidden state", global.name);
        }
    }
}

#[test]
fn plane_and_complex_scenes_evaluate_once() {
    for scene in scenes().iter().filter(|s| s.space != Space::Space) {
        let module = parse(scene.name, scene.template);
        let count = evaluations(&module, "shade");
        if scene.name == "implicit" {
            // a second look, in a loop, at functions of branches alone
            let copies = copies(&module, "shade", "field_jet2");
            assert_eq!((count, copies), (None, 1));
            continue;
        }
        assert_eq!(
            count,
            Some(1),
            "evaluations of the formula per sample in {}",
            scene.name
        );
    }
}

/// Drivers copy a formula to each place that calls it: more places take a large formula longer to compile.
#[test]
fn scenes_of_space_hold_one_copy_of_the_formula_for_each_stub() {
    for name in [
        "slices",
        "nested",
        "cutaway",
        "volume",
        "volumecut",
        "scatter",
        "glow",
        "additive",
    ] {
        let module = whole(scene(name).expect("a scene"));
        for stub in FIELD_STUBS {
            let found = copies(&module, "shade", stub);
            assert!(found <= 1, "{name} has {found} copies of {stub}");
        }
    }
}

/// A scene that evaluates once has nothing to take differences of; the others go through the analysis.
#[test]
fn no_template_takes_a_finite_difference() {
    for scene in scenes() {
        let module = parse(scene.name, scene.template);
        if evaluations(&module, "shade") == Some(1) {
            continue;
        }
        let modules = match scene.name {
            "implicit" => vec![parse("implicit", &without_first_look(scene.template))],
            _ => vec![module, with_loops(scene)],
        };
        for module in modules {
            let found = finite_differences(&module);
            assert!(found.is_empty(), "{}:\n{}", scene.name, found.join("\n"));
        }
    }
}

/// The scene `implicit` without the model of its first look, which is of one evaluation: what comes after it takes others.
fn without_first_look(template: &str) -> String {
    let mut text = template.to_owned();
    let mut put = |name: &str, body: Option<&str>| {
        let start = text.find(&format!("fn {name}(")).expect(name);
        let open = start + text[start..].find('{').expect("a body");
        let end = start + text[start..].find("\n}\n").expect("an end") + 3;
        match body {
            Some(body) => text.replace_range(open..end, &format!("{{ {body} }}\n")),
            None => text.replace_range(start..end, ""),
        }
    };
    for name in [
        "scaled_by",
        "per_pixel",
        "bend_of",
        "model_of",
        "is_parallel",
        "is_crowded",
        "distance_along",
        "critical",
        "verdict_of",
    ] {
        put(name, None);
    }
    put(
        "sight_of",
        Some("return Sight(vec4f(), true, jet.value, Verdict(), view.pixel * vec2f(1.0));"),
    );
    text
}

/// A template with a body of `shade` after the usual declarations.
fn with_shade(stub: &str, body: &str) -> Module {
    let view = "struct View { center: vec2f, size: vec2f, tile: vec2f, pixel: f32, time: f32 }
        @group(0) @binding(0) var<uniform> view: View;";
    let text = format!("{view}\n{stub}\nfn shade(pixel: vec2f) -> vec4f {{\n{body}\n}}");
    let module = parse("a bad template", &text);
    validate("a bad template", &module);
    module
}

#[test]
fn finite_differences_are_found() {
    let field = "fn field(p: vec2f) -> f32 { return 0.0; }";
    let check = |why: &str, stub: &str, body: &str| {
        let found = finite_differences(&with_shade(stub, body));
        assert!(!found.is_empty(), "{why} is not seen");
    };
    check(
        "a constant step",
        field,
        "let d = field(pixel + vec2f(0.01, 0.0)) - field(pixel); return vec4f(d / 0.01);",
    );
    check(
        "a factor",
        field,
        "let d = field(pixel + vec2f(0.01, 0.0)) - field(pixel); return vec4f(d * 100.0);",
    );
    check(
        "the pixel",
        field,
        "let h = view.pixel; return vec4f((field(pixel + vec2f(h, 0.0)) - field(pixel - vec2f(h, 0.0))) / (2.0 * h));",
    );
    check(
        "a value per length",
        field,
        "return vec4f(field(pixel) / view.pixel);",
    );
    check(
        "one over the step",
        field,
        "let s = 1.0 / view.pixel; let a = field(pixel); let b = field(pixel + vec2f(view.pixel)); return vec4f(a * s - b * s);",
    );
    check(
        "a loop that keeps the last value",
        field,
        "var last = 0.0; var sum = 0.0;
         for (var k = 0; k < 4; k++) { let f = field(pixel * f32(k)); sum += abs(f - last) * 7.0; last = f; }
         return vec4f(sum);",
    );
    check(
        "a helper function",
        "fn field(p: vec2f) -> f32 { return 0.0; }
         fn at(p: vec2f) -> f32 { return field(p); }
         fn slope(a: f32, b: f32, h: f32) -> f32 { return (b - a) / h; }",
        "return vec4f(slope(at(pixel), at(pixel + 0.1), 0.1));",
    );
    check(
        "a difference of gradients",
        "fn field_grad(p: vec2f) -> vec3f { return vec3f(); }",
        "let a = field_grad(pixel); let b = field_grad(pixel + 0.1); return vec4f((b.xy - a.xy) / 0.1, 0.0, 1.0);",
    );
    check(
        "a difference of jets",
        "struct Jet { value: vec2f, dz: vec2f, dzbar: vec2f, exponent: f32 }
         fn map_jet(offset: vec2f) -> Jet { return Jet(); }",
        "let a = map_jet(pixel); let b = map_jet(pixel + 0.1); return vec4f((b.value - a.value) / 0.1, 0.0, 1.0);",
    );
    check(
        "a structure",
        "struct Sample { t: f32, value: f32 }
         fn field_ray(o: vec3f, d: vec3f, t: f32) -> vec2f { return vec2f(); }
         fn sample(t: f32) -> Sample { return Sample(t, field_ray(vec3f(), vec3f(1.0), t).x); }",
        "let a = sample(pixel.x); let b = sample(pixel.y); return vec4f((b.value - a.value) / (b.t - a.t));",
    );
}

#[test]
fn what_is_no_finite_difference_is_not_found() {
    let check = |why: &str, stub: &str, body: &str| {
        let found = finite_differences(&with_shade(stub, body));
        assert!(found.is_empty(), "{why}: {found:?}");
    };
    let gradient = "fn field_grad(p: vec2f) -> vec3f { return vec3f(); }";
    check(
        "a distance estimate",
        gradient,
        "let jet = field_grad(pixel); return vec4f(abs(jet.z - 0.5) / length(jet.xy) / view.pixel);",
    );
    check(
        "a change per pixel",
        gradient,
        "let jet = field_grad(pixel); return vec4f(jet.z / (length(jet.xy) * view.pixel));",
    );
    check(
        "the secant method",
        "fn field(p: vec2f) -> f32 { return 0.0; }",
        "let a = field(pixel); let b = field(pixel + 0.1); return vec4f(a / (a - b) * view.pixel);",
    );
    check(
        "a projected gradient",
        gradient,
        "let jet = field_grad(pixel); let n = normalize(pixel); return vec4f(jet.xy - n * dot(jet.xy, n), 0.0, 1.0) * 0.5;",
    );
}

/// Members of a structure with their types.
fn members(module: &Module, name: &str) -> Option<Vec<(String, TypeInner, u32)>> {
    let (_, ty) = module
        .types
        .iter()
        .find(|(_, t)| t.name.as_deref() == Some(name))?;
    let TypeInner::Struct { members, .. } = &ty.inner else {
        return None;
    };
    let of = |m: &naga::StructMember| {
        (
            m.name.clone().unwrap_or_default(),
            module.types[m.ty].inner.clone(),
            m.offset,
        )
    };
    Some(members.iter().map(of).collect())
}

#[test]
fn the_view_is_the_same_everywhere() {
    let entry = members(&Sources::get(Tier::default()).entry.clone(), "View")
        .expect("entry.wgsl has a View");
    assert_eq!(entry.len(), 8);
    for scene in scenes() {
        let view = members(&parse(scene.name, scene.template), "View");
        assert_eq!(view.as_ref(), Some(&entry), "the View of {}", scene.name);
    }
}

#[test]
fn bindings_are_the_contract_s() {
    for scene in scenes() {
        let module = parse(scene.name, scene.template);
        for (_, global) in module.global_variables.iter() {
            let binding = global.binding.expect("a binding");
            let name = global.name.as_deref().unwrap_or_default();
            let wanted = match name {
                "view" => (0, 0),
                "params" => (0, 1),
                "settings" => (0, 2),
                other => panic!("{}: the global `{other}`", scene.name),
            };
            assert_eq!(
                (binding.group, binding.binding),
                wanted,
                "{}: `{name}`",
                scene.name
            );
        }
    }
}

/// Whether a member's type can hold a setting of this kind.
fn holds(ty: &TypeInner, kind: SettingKind) -> bool {
    let vector = |size| match ty {
        TypeInner::Vector {
            size: found,
            scalar,
        } => *found == size && scalar.kind == ScalarKind::Float,
        _ => false,
    };
    let scalar =
        |kinds: &[ScalarKind]| matches!(ty, TypeInner::Scalar(s) if kinds.contains(&s.kind));
    match kind {
        SettingKind::Real => scalar(&[ScalarKind::Float]),
        SettingKind::Integer => scalar(&[ScalarKind::Uint, ScalarKind::Sint]),
        SettingKind::Choice(_) => scalar(&[ScalarKind::Uint]),
        SettingKind::Function => false,
        SettingKind::Vec2 => vector(VectorSize::Bi),
        SettingKind::Vec3 => vector(VectorSize::Tri),
    }
}

/// What is wrong with the settings of a scene, if anything.
fn settings_of(scene: &Scene) -> Result<(), String> {
    let module = parse(scene.name, scene.template);
    let mut members = members(&module, "Settings").unwrap_or_default();
    // a structure within holds settings, too
    while let Some(k) = members
        .iter()
        .position(|m| matches!(m.1, TypeInner::Struct { .. }))
    {
        let (_, ty, _) = members.remove(k);
        if let TypeInner::Struct { members: inner, .. } = ty {
            members.extend(inner.iter().map(|m| {
                let ty = module.types[m.ty].inner.clone();
                (m.name.clone().unwrap_or_default(), ty, m.offset)
            }));
        }
    }
    if let Some(k) = members.iter().position(|m| m.0 == TABLE) {
        let (_, table, _) = members.remove(k);
        let size = table.size(module.to_ctx());
        if scene.setting("palette").is_none() || size as usize != 16 * ENTRIES {
            return Err("a table of colours that no palette fills".into());
        }
    }
    for (name, ty, _) in &members {
        let Some(setting) = scene.setting(name) else {
            return Err(format!("the member `{name}` has no setting"));
        };
        if !holds(ty, setting.kind) {
            return Err(format!(
                "`{name}` is {ty:?} in the template, {:?} in the record",
                setting.kind
            ));
        }
    }
    for setting in scene.settings {
        if setting.is_in_template(scene.space)
            && !members.iter().any(|(name, ..)| name == setting.name)
        {
            return Err(format!("the setting `{}` has no member", setting.name));
        }
        let doubled = scene
            .settings
            .iter()
            .filter(|s| s.name == setting.name)
            .count();
        let (lo, hi) = setting.range;
        let inside = setting
            .default
            .as_ref()
            .iter()
            .all(|x| (lo..=hi).contains(x));
        if doubled > 1 || setting.doc.is_empty() || !inside {
            return Err(format!(
                "`{}` is double, without words, or out of range",
                setting.name
            ));
        }
    }
    Ok(())
}

#[test]
fn settings_and_records_agree() {
    for scene in scenes() {
        if let Err(problem) = settings_of(scene) {
            panic!("{}: {problem}", scene.name);
        }
    }
}
