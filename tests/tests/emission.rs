//! What is emitted: valid in every shading language, with the user's names, and only what is asked for.

use std::io::Write as _;
use std::process::{Command, Stdio};

use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{Module, ShaderStage};
use pullback_compiler::ir::Ty;
use pullback_compiler::lower::Precision;
use pullback_compiler::module::SceneModule;
use pullback_compiler::table;
use pullback_compiler::types::Type;
use pullback_compiler::{EmitWhat, Program, Target, compile};
use pullback_grammar::render;
use pullback_tests::corpus::gallery;

fn program(name: &str, text: &str) -> Program {
    let answer = compile(text);
    answer
        .program
        .unwrap_or_else(|| panic!("{name}\n{}", render(&answer.diagnostics, name, text, false)))
}

fn validate(name: &str, module: &Module, capabilities: Capabilities) {
    if let Err(error) = Validator::new(ValidationFlags::all(), capabilities).validate(module) {
        panic!("{name}: {error:?}");
    }
}

fn emit(
    name: &str,
    program: &Program,
    what: EmitWhat,
    target: Target,
    precision: Precision,
) -> Vec<u8> {
    program
        .emit(0, what, target, precision)
        .unwrap_or_else(|problems| panic!("{name}: {what:?} in {}: {problems:?}", target.name()))
}

/// Reads an emitted text back where there is a reader, and checks its shape where there is none.
fn check_readable(name: &str, what: EmitWhat, target: Target, bytes: &[u8]) {
    let name = format!("{name}: {what:?} in {}", target.name());
    if target == Target::Spirv {
        let bytes = &without_linkage(bytes);
        let module = naga::front::spv::parse_u8_slice(bytes, &naga::front::spv::Options::default())
            .unwrap_or_else(|error| panic!("{name}: {error:?}"));
        validate(&name, &module, Capabilities::all());
        return;
    }
    let text = std::str::from_utf8(bytes).unwrap_or_else(|error| panic!("{name}: {error}"));
    assert!(text.contains("// pullback "), "{name}: no header");
    match target {
        Target::Wgsl => {
            let module = naga::front::wgsl::parse_str(text)
                .unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(text)));
            validate(&name, &module, Capabilities::default());
        }
        Target::Glsl => {
            assert!(text.starts_with("#version"), "{name}");
            let module = naga::front::glsl::Frontend::default()
                .parse(
                    &naga::front::glsl::Options::from(ShaderStage::Fragment),
                    text,
                )
                .unwrap_or_else(|error| panic!("{name}: {}\n{text}", error.emit_to_string(text)));
            validate(&name, &module, Capabilities::all());
        }
        _ => check_shape(&name, text),
    }
}

/// A function by itself is a library, whose capability `Linkage` (5) naga writes but does not read.
fn without_linkage(bytes: &[u8]) -> Vec<u8> {
    const HEADER: usize = 20;
    let linkage: Vec<u8> = [0x0002_0011_u32, 5]
        .iter()
        .flat_map(|w| w.to_le_bytes())
        .collect();
    let (head, rest) = bytes.split_at(HEADER);
    match rest.chunks_exact(4).position(|w| w == &linkage[..4]) {
        // capabilities come first
        Some(_) => {
            let mut rest = rest.to_vec();
            let mut at = 0;
            while rest[at..].starts_with(&linkage[..4]) {
                if rest[at..].starts_with(&linkage) {
                    rest.drain(at..at + 8);
                } else {
                    at += 8;
                }
            }
            [head, &rest].concat()
        }
        None => bytes.to_vec(),
    }
}

/// Brackets that match, and no number that only naga can write.
fn check_shape(name: &str, text: &str) {
    let code: String = text
        .lines()
        .filter(|l| !l.trim_start().starts_with("//"))
        .collect();
    let mut open = Vec::new();
    for c in code.chars() {
        match c {
            '(' | '{' => open.push(c),
            ')' => assert_eq!(open.pop(), Some('('), "{name}"),
            '}' => assert_eq!(open.pop(), Some('{'), "{name}"),
            _ => {}
        }
    }
    assert!(open.is_empty(), "{name}");
}

/// Which forms a program has besides value and scene.
fn forms(program: &Program) -> Vec<EmitWhat> {
    let formula = &program.pictures()[0].formula;
    let scalars = formula.scalars();
    let mut out = vec![EmitWhat::Value, EmitWhat::Scene];
    if !scalars.contains(&Ty::Complex) && formula.ty == Type::Real && !scalars.is_empty() {
        out.push(EmitWhat::Gradient);
    }
    if scalars.len() == 1 && (scalars[0] == Ty::Complex || formula.ty == Type::Real) {
        out.push(EmitWhat::Derivative);
    }
    out
}

/// Emits all that a program has, in every language.
fn check_all(name: &str, program: &Program, precision: Precision) {
    for what in forms(program) {
        for target in Target::ALL {
            check_readable(
                name,
                what,
                target,
                &emit(name, program, what, target, precision),
            );
        }
    }
}

#[test]
fn the_gallery_in_every_language() {
    for source in gallery() {
        check_all(
            &source.name,
            &program(&source.name, &source.text),
            Precision::Accurate,
        );
    }
}

#[test]
fn the_gallery_with_the_built_ins() {
    for source in gallery().iter().step_by(4) {
        check_all(
            &source.name,
            &program(&source.name, &source.text),
            Precision::Fast,
        );
    }
}

/// A formula for every function of the operator table, on reals and on complex numbers, and for every operator.
fn functions() -> Vec<String> {
    let mut out: Vec<String> = [
        "x + y",
        "x - y",
        "x y",
        "x / y",
        "x^y",
        "x^3",
        "x^-2",
        "-x + y",
        "√x + y",
        "x! + y",
        "|x| + y",
        "if x < y then x else y",
        "if x <= y and not (x == 1) or y != 2 then x else y",
        "{ x < 0: -x, x < y: x^2 }",
        "if true then x else y",
        "x time + pixel y",
        "(x + i y)^(y + i x)",
        "re((x + i y)!)",
        "im(conj(x + i y)) + y",
        "abs((x + i y)^-3)",
        "if x + i y == 1 then x else y",
    ]
    .map(|body| format!("f(x, y) = {body}"))
    .into();
    for row in table::rows() {
        let Some(name) = row.names.first() else {
            continue;
        };
        if matches!(row.derivative, table::Derivative::Missing) {
            // of these only the value can be had, which the accuracy suites emit
            continue;
        }
        let arguments = |names: [&str; 3]| names[..row.typing.arity().min(3)].join(", ");
        if row.real.is_some() || row.is_defined(false) {
            out.push(format!(
                "f(x, y) = {name}({}) + y",
                arguments(["x", "y", "x + y"])
            ));
        }
        if row.complex.is_some() || row.is_defined(true) {
            out.push(format!(
                "f(z) = {name}({})",
                arguments(["z", "z^2", "z + 1"])
            ));
        }
    }
    for function in pullback_compiler::check::library_functions() {
        let argument = |(k, ty): (usize, &Option<Type>)| match ty {
            Some(Type::Vector(n)) => format!(
                "vec{n}({}{})",
                ["x", "y", "x + y"][k % 3],
                ", y, 1, x".get(..3 * (usize::from(*n) - 1)).unwrap_or("")
            ),
            Some(Type::Complex) => format!("({} + i y)", ["x", "y"][k % 2]),
            _ => format!("({} + {k})", ["x", "y", "x + y"][k % 3]),
        };
        let arguments: Vec<String> = function.types.iter().enumerate().map(argument).collect();
        let call = format!("{}({})", function.name, arguments.join(", "));
        out.push(format!("f(x, y) = length({call}) + y"));
    }
    out.extend(
        [
            "length(p)",
            "distance(p, (1, 2, 3))",
            "dot(p, p.zyx)",
            "cross(p, (1, 2, 3)).y",
            "normalize(p).z",
            "rotate(p.xy, p.z).x",
            "|vec4(p, 1)|",
            "length(vec2(p.x) + p.zz)",
            "length(sin(p) p^2 / (1, 2, 3))",
        ]
        .map(|body| format!("f(p: vec3) = {body}")),
    );
    out
}

#[test]
fn every_function_in_every_language() {
    let all = functions();
    assert!(all.len() > 100, "{} formulas", all.len());
    for text in &all {
        check_all(text, &program(text, text), Precision::Accurate);
    }
}

/// `spirv-val` on a module; an error message, or nothing where all is well.
fn spirv_val(bytes: &[u8]) -> std::io::Result<String> {
    let mut child = Command::new("spirv-val")
        .args(["--target-env", "vulkan1.1", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()?;
    child
        .stdin
        .take()
        .map_or(Ok(()), |mut input| input.write_all(bytes))?;
    let output = child.wait_with_output()?;
    let text = String::from_utf8_lossy(&output.stderr).into_owned()
        + &String::from_utf8_lossy(&output.stdout);
    Ok(if output.status.success() {
        String::new()
    } else {
        text + "failed"
    })
}

#[test]
#[allow(clippy::print_stderr, reason = "a test that is skipped says so")]
fn spirv_satisfies_khronos_validator() {
    if Command::new("spirv-val").arg("--version").output().is_err() {
        eprintln!("skipped: spirv-val is not installed (Debian: spirv-tools)");
        return;
    }
    for source in gallery() {
        let program = program(&source.name, &source.text);
        // a function by itself has no entry point, which only kernels and libraries may; so whole scenes
        let bytes = emit(
            &source.name,
            &program,
            EmitWhat::Scene,
            Target::Spirv,
            Precision::Accurate,
        );
        let problem = spirv_val(&bytes).expect("spirv-val runs");
        assert!(problem.is_empty(), "{}: {problem}", source.name);
    }
}

#[test]
fn names_of_the_user_survive() {
    let wgsl = |text: &str| {
        let program = program(text, text);
        let bytes = emit(
            text,
            &program,
            EmitWhat::Value,
            Target::Wgsl,
            Precision::Accurate,
        );
        check_readable(text, EmitWhat::Value, Target::Wgsl, &bytes);
        String::from_utf8(bytes).expect("text")
    };
    let check = |text: &str, words: &[&str]| {
        let out = wgsl(text);
        for word in words {
            let is_word = |c: char| !(c.is_alphanumeric() || c == '_');
            let found = out.split(is_word).any(|w| w.trim_end_matches('_') == *word);
            assert!(found, "no `{word}` in\n{out}");
        }
    };
    check(
        "param speed = 2 in 0..4\nwave(x, y) = a sin(b) b where a = 1 - x² speed, b = x y + 2\nshow levels(wave)",
        &["wave", "x", "y", "speed", "a", "b"],
    );
    check(
        "f(x, y) = (α + θ₁)^2 where α = x + 2y, θ₁ = x - 3y",
        &["alpha", "theta1"],
    );
    // words that mean something in a shading language
    check(
        "f(x, y) = (float + texture) fn where float = 2 x + y, texture = x/y, fn = x y + 1",
        &["float", "texture", "fn"],
    );
    check(
        "f(u, v) = select vec where select = u sin(v), vec = v²",
        &["u", "v", "select", "vec"],
    );
    check("main(x, y) = sin(x) y", &["main"]);
    check("vec2f(x, y) = sin(x) y", &["x", "y"]);
}

#[test]
fn names_of_the_user_break_no_language() {
    let words = [
        "main",
        "float",
        "vec3f",
        "array",
        "struct",
        "fn",
        "let",
        "var",
        "loop",
        "return",
        "half",
        "texture",
        "sampler",
        "kernel",
        "device",
        "constant",
        "metal",
        "int",
        "float4",
        "uniform",
        "in",
        "out",
        "view",
        "params",
        "settings",
        "shade",
        "field",
        "image",
        "discard",
        "gl_FragCoord",
        "_",
        "__x",
        "real_sin",
        "self",
        "matrix",
        "precision",
        "lowp",
        "register",
        "cbuffer",
        "nullptr",
        "template",
        "class",
        "Jet",
    ];
    for word in words.iter().filter(|w| !["in"].contains(w)) {
        for text in [
            format!("{word}(x, y) = sin(x) y"),
            format!("f(x, y) = {word} y + {word}² where {word} = sin(x)"),
            format!("param {word} = 1\nf(x, y) = sin({word} x) y"),
            format!("f({word}, b) = sin({word}) b"),
        ] {
            if compile(&text).program.is_some() {
                check_all(&text, &program(&text, &text), Precision::Accurate);
            } else {
                // `_` alone and words of the language may be refused, but not silently
                assert!(!compile(&text).diagnostics.is_empty(), "{text}");
            }
        }
    }
}

/// A template with these stubs, whose picture calls them.
fn template(space: &str, stubs: &str, picture: &str) -> Module {
    let text = format!(
        "struct View {{ center: vec2f, size: vec2f, tile: vec2f, pixel: f32, time: f32, samples: u32, zero: u32, tile_size: vec2u }}
         @group(0) @binding(0) var<uniform> view: View;
         @group(0) @binding(1) var<uniform> params: array<vec4f, 16>;
         {stubs}
         fn shade(pixel: vec2f) -> vec4f {{ let p = vec{space}f(pixel.x); return vec4f({picture}); }}"
    );
    naga::front::wgsl::parse_str(&text).unwrap_or_else(|e| panic!("{}", e.emit_to_string(&text)))
}

/// Names of the functions of a formula's module in a template, sorted.
fn spliced(template: &Module, text: &str) -> Module {
    let program = program(text, text);
    let mut module = SceneModule::splice(
        template,
        &program.pictures()[0].formula,
        Precision::Accurate.into(),
    )
    .unwrap_or_else(|error| panic!("{text}: {error:?}"));
    naga::compact::compact(&mut module, naga::compact::KeepUnused::No);
    validate(text, &module, Capabilities::default());
    module
}

fn function_names(module: &Module) -> Vec<String> {
    module
        .functions
        .iter()
        .filter_map(|(_, f)| f.name.clone())
        .collect()
}

/// Number of expressions of a function.
fn size(module: &Module, name: &str) -> usize {
    let found = module
        .functions
        .iter()
        .find(|(_, f)| f.name.as_deref() == Some(name));
    found
        .unwrap_or_else(|| panic!("no `{name}` in {:?}", function_names(module)))
        .1
        .expressions
        .len()
}

const VALUE: &str = "fn field(p: vec2f) -> f32 { return 0.0; }";
const GRADIENT: &str = "fn field_grad(p: vec2f) -> vec3f { return vec3f(); }";

#[test]
fn a_template_without_a_gradient_gets_no_tangents() {
    let text = "f(x, y) = gamma(x) exp(y)";
    let value = spliced(&template("2", VALUE, "field(p)"), text);
    let names = function_names(&value);
    assert!(!names.iter().any(|n| n == "field_grad"), "{names:?}");
    // the derivative of the gamma function needs the digamma function, the value does not
    assert!(!names.iter().any(|n| n.contains("digamma")), "{names:?}");
    let both = spliced(&template("2", GRADIENT, "field_grad(p), 1.0"), text);
    let all = function_names(&both);
    assert!(all.iter().any(|n| n.contains("digamma")), "{all:?}");
    assert!(size(&value, "field") < size(&both, "field_grad"));
    // a stub that is declared and not called is not compiled either
    let unused = spliced(
        &template("2", &format!("{VALUE}\n{GRADIENT}"), "field(p)"),
        text,
    );
    assert_eq!(function_names(&unused), names);
}

#[test]
fn one_tangent_along_a_ray_not_three() {
    let ray = "fn field_ray(o: vec3f, d: vec3f, t: f32) -> vec2f { return vec2f(); }";
    let gradient = "fn field_grad(p: vec3f) -> vec4f { return vec4f(); }";
    let text = "f(x, y, z) = sin(x y) + sin(y z) + sin(z x) + x^5 y^3 z";
    let ray = spliced(&template("3", ray, "field_ray(p, p, 1.0), 0.0, 1.0"), text);
    let gradient = spliced(&template("3", gradient, "field_grad(p)"), text);
    assert!(!function_names(&ray).iter().any(|n| n == "field_grad"));
    assert!(!function_names(&gradient).iter().any(|n| n == "field_ray"));
}

#[test]
fn a_formula_carries_only_the_functions_that_it_uses() {
    let scene = |text: &str| {
        let program = program(text, text);
        let scene = program
            .scene_module(0, Precision::Accurate)
            .expect("a scene");
        function_names(&scene.module)
    };
    let has = |text: &str, word: &str| scene(text).iter().any(|n| n.contains(word));
    assert!(!has("f(x, y) = sin(x) y", "gamma"));
    assert!(has("f(x, y) = gamma(x) y", "gamma"));
    assert!(!has("f(x, y) = x² + y²", "sin"));
    assert!(!has("f(z) = z² + 1", "complex_log"));
    assert!(has("f(z) = log(z)", "log"));
    assert!(!has("f(x, y, z) = x² + y² - z", "exp"));
    // nothing of another scene
    assert!(!has("f(x, y) = x y", "refine_crossing"));
    assert!(!has("f(z) = z", "field"));
}

#[test]
fn scenes_of_space_carry_nothing_of_one_another() {
    for (scene, present, absent) in [
        (
            "slices",
            &["field_grad", "contour_colour"][..],
            &["field_ray", "march_on", "matter_of"][..],
        ),
        (
            "nested",
            &["field_ray", "field_grad", "march_on"],
            &["contour_colour", "kept_part", "matter_of"],
        ),
        (
            "cutaway",
            &["field_ray", "contour_colour", "kept_part"],
            &["matter_of"],
        ),
        (
            "volume",
            &["field_grad", "matter_of"],
            &["field_ray", "contour_opacity", "march_on", "kept_part"],
        ),
        (
            "volumecut",
            &["field_grad", "matter_of", "contour_opacity"],
            &["field_ray", "march_on", "mean_value_colour"],
        ),
        (
            "scatter",
            &["field", "stretch_at"],
            &["field_grad", "field_ray", "matter_of", "march_on"],
        ),
        (
            "glow",
            &["field_grad", "mean_glow"],
            &["field_ray", "march_on", "matter_of", "screen_rate"],
        ),
        (
            "additive",
            &["field_integral", "mesh_next"],
            &["field", "field_grad", "field_ray", "march_on", "matter_of"],
        ),
    ] {
        let text = format!("f(x, y, z) = x y + z\nshow {scene}(f)");
        let program = program(&text, &text);
        let module = program
            .scene_module(0, Precision::Accurate)
            .expect("a scene")
            .module;
        let names = function_names(&module);
        for name in present {
            assert!(names.iter().any(|n| n == name), "{scene} lacks {name}");
        }
        let alone = ["field", "search_step"];
        let others = alone.iter().filter(|name| !present.contains(name));
        for name in absent.iter().chain(others) {
            assert!(!names.iter().any(|n| n == name), "{scene} carries {name}");
        }
    }
}

/// The bodies of `map_jet` for a formula of z.
fn jet_size(text: &str) -> usize {
    let program = program(text, text);
    let scene = program
        .scene_module(0, Precision::Accurate)
        .expect("a scene");
    size(&scene.module, "map_jet")
}

/// What each scene of the plane needs of formula and library, and some of what others need.
#[test]
fn a_scene_carries_only_what_it_uses() {
    let check = |text: &str, needed: &[&str], foreign: &[&str]| {
        let program = program(text, text);
        let scene = program
            .scene_module(0, Precision::Accurate)
            .expect("a scene");
        let names = function_names(&scene.module);
        let has = |name: &str| names.iter().any(|n| n == name);
        for name in needed {
            assert!(has(name), "{text}: no `{name}` in {names:?}");
        }
        for name in foreign {
            assert!(!has(name), "{text}: `{name}` in {names:?}");
        }
        let stubs = [
            "field",
            "field_grad",
            "field_jet2",
            "map",
            "map_jet",
            "chart_jet",
            "chart_jet_inverse",
        ];
        for stub in stubs {
            assert_eq!(has(stub), needed.contains(&stub), "{text}: `{stub}`");
        }
    };
    let real = "x³ - y";
    let complex = "z³ + 1";
    let no_waves = [
        "real_sin",
        "real_cos",
        "complex_exp",
        "complex_log",
        "complex_gamma",
    ];
    let foreign = |more: &[&'static str]| [more, &no_waves].concat();
    check(
        &format!("show logcontours({real})"),
        &["field_grad", "octave_lines", "log2_parts"],
        &foreign(&["normal_cdf", "polar_from_jet", "hsv_wheel"]),
    );
    check(
        &format!("show bands({real})"),
        &["field_grad", "normal_cdf"],
        &foreign(&["octave_lines", "log2_parts", "polar_from_jet", "hsv_wheel"]),
    );
    check(
        &format!("show implicit({real})"),
        &["field_jet2", "line_coverage"],
        &foreign(&["octave_lines", "diverging_ramp", "key_at", "normal_cdf"]),
    );
    check(
        &format!("f(z) = {complex}\nshow checker(f)"),
        &["map_jet", "square_train", "part_rates"],
        &foreign(&[
            "octave_lines",
            "blend_extremes",
            "normal_cdf",
            "complex_divide",
        ]),
    );
    check(
        &format!("f(z) = {complex}\nshow grid(f)"),
        &["map_jet", "octave_lines", "blend_extremes"],
        &foreign(&["normal_cdf", "saw_train", "wrap_diffuse", "diverging_ramp"]),
    );
    check(
        &format!("f(z) = {complex}\nshow sphere(f)"),
        &[
            "chart_jet",
            "chart_jet_inverse",
            "domain_colour",
            "wrap_diffuse",
        ],
        &foreign(&["octave_lines", "normal_cdf", "orbit_ray", "diverging_ramp"]),
    );
}

#[test]
fn a_holomorphic_function_has_no_wirtinger_pair() {
    let jet = |text: &str| {
        let program = program(text, text);
        let scene = program
            .scene_module(0, Precision::Accurate)
            .expect("a scene");
        let (_, function) = scene
            .module
            .functions
            .iter()
            .find(|(_, f)| f.name.as_deref() == Some("map_jet"))
            .expect("a jet");
        // the last component of what is returned is a zero that nothing computes
        let naga::Statement::Return { value: Some(value) } = function.body.last().expect("a body")
        else {
            panic!("no value is returned");
        };
        let naga::Expression::Compose { ref components, .. } = function.expressions[*value] else {
            panic!("no structure is returned");
        };
        matches!(
            function.expressions[components[2]],
            naga::Expression::ZeroValue(_)
        )
    };
    for text in [
        "f(z) = z^3 - 1",
        "f(z) = exp(sin(z))/z",
        "f(z) = log(z) + gamma(z)",
        "f(z) = 2",
    ] {
        assert!(jet(text), "{text} carries ∂f/∂z̄");
    }
    for text in ["f(z) = conj(z)", "f(z) = abs(z) z", "f(z) = z + re(z)"] {
        assert!(!jet(text), "{text} lacks ∂f/∂z̄");
    }
    assert!(jet_size("f(z) = z^3") < jet_size("f(z) = conj(z)^3 + z^3"));
}

#[test]
fn parameters_settings_and_ranges_change_no_module() {
    let module = |text: &str| {
        let program = program(text, text);
        emit(
            text,
            &program,
            EmitWhat::Scene,
            Target::Wgsl,
            Precision::Accurate,
        )
    };
    let base = module("param k = 1 in 0..2\nf(x, y) = sin(k x) y\nshow levels(f)");
    let other = module(
        "param k = 1.5 in -3..7\nf(x, y) = sin(k x) y\nshow levels(f) { height = 3, palette = paper }",
    );
    assert!(
        base == other,
        "a parameter's value or a setting is in the module"
    );
    let third = module("param k = 1 in 0..2\nf(x, y) = sin(2 k x) y\nshow levels(f)");
    assert!(base != third);
}

#[test]
fn the_same_text_gives_the_same_bytes() {
    for source in gallery().iter().take(6) {
        for target in Target::ALL {
            let bytes = || {
                let program = program(&source.name, &source.text);
                emit(
                    &source.name,
                    &program,
                    EmitWhat::Scene,
                    target,
                    Precision::Accurate,
                )
            };
            assert!(bytes() == bytes(), "{} in {}", source.name, target.name());
        }
    }
}
