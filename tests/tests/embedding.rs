//! The pages of docs/embedding: their code is emitted, judged and, where a person wrote it, compared.
//!
//! `BLESS=1 cargo test --workspace --test embedding` writes them anew from the templates in `tests/data/embedding`.

use std::fmt::Write as _;
use std::fs;

use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{Function, Handle, Module};
use pullback_compiler::lower::{Format, Precision};
use pullback_compiler::{Emission, EmitWhat, Emitted, ParamsAs, Target, compile};
use pullback_runtime::executor::{
    Arithmetic, Contraction, Limits, Machine, Options, Program, Start, Watched,
};
use pullback_runtime::validators::{Verdict, judge};
use pullback_tests::corpus::{files, root};
use pullback_tests::operations::{lines, operations, own_operations};
use pullback_tests::stability::rays::{Ray, rays};

const TEMPLATES: &str = "tests/data/embedding";
const PAGES: &str = "docs/embedding";
const EXPERT: &str = "tests/data/embedding/expert";

fn what(word: &str) -> EmitWhat {
    let found = EmitWhat::ALL.into_iter().find(|w| w.name() == word);
    found.unwrap_or_else(|| panic!("`{word}` is nothing to emit"))
}

fn target(word: &str) -> Target {
    let found = Target::ALL.into_iter().find(|t| t.name() == word);
    found.unwrap_or_else(|| panic!("`{word}` is no target"))
}

/// What the command `pullback emit PROGRAM OPTIONS` emits.
fn emission(options: &str, program: &str) -> Emission {
    let words: Vec<&str> = options.split_whitespace().collect();
    let mut parts = Vec::new();
    let mut language = Target::Wgsl;
    let mut out = Emission::new(EmitWhat::Value, Target::Wgsl);
    for pair in words.chunks(2) {
        let &[option, value] = pair else {
            panic!("`{options}` has an option without a value");
        };
        match option {
            "--target" => language = target(value),
            "--what" => parts = value.split(',').map(what).collect(),
            "--name" => out.name = Some(value.to_owned()),
            "--params" if value == "uniform" => out.params = ParamsAs::Uniform,
            "--params" if value == "constants" => out.params = ParamsAs::Constants,
            "--precision" if value == "fast" => out.precision = Precision::Fast,
            _ => panic!("`{option} {value}` in a template"),
        }
    }
    out.target = language;
    if !parts.is_empty() {
        out.parts = parts;
    }
    out.quoting(program, &format!("pullback emit PROGRAM {options}"))
}

fn emitted(emission: &Emission, program: &str) -> Emitted {
    let answer = compile(program);
    let program = answer
        .program
        .unwrap_or_else(|| panic!("{program}: {:?}", answer.diagnostics));
    program
        .emit_all(emission)
        .unwrap_or_else(|e| panic!("{:?}: {e:?}", emission.parts))
}

#[allow(clippy::print_stderr, reason = "a judge that is not there is named")]
fn judged(emission: &Emission, code: &Emitted) {
    for judgement in judge(&code.bytes, emission.target, &emission.parts) {
        match judgement.verdict {
            Verdict::Accepted => {}
            Verdict::Absent => eprintln!("not installed: {}", judgement.judge),
            Verdict::Rejected(why) => panic!(
                "{}: {why}\n{}",
                judgement.judge,
                String::from_utf8_lossy(&code.bytes)
            ),
        }
    }
}

/// A page from its template: ```` ```emit OPTIONS ```` blocks hold a program, and become the emitted code.
fn page(template: &str) -> String {
    let mut out = String::new();
    let mut lines = template.lines();
    while let Some(line) = lines.next() {
        let Some(options) = line.strip_prefix("```emit ") else {
            out.push_str(line);
            out.push('\n');
            continue;
        };
        let program: Vec<&str> = lines.by_ref().take_while(|l| *l != "```").collect();
        let program = program.join("\n");
        let emission = emission(options, &program);
        let code = emitted(&emission, &program);
        judged(&emission, &code);
        let text = String::from_utf8(code.bytes).expect("a text");
        let word = match emission.target {
            Target::Three | Target::Tsl => "js",
            Target::Msl => "cpp",
            Target::C => "c",
            Target::Hlsl => "hlsl",
            Target::Wgsl | Target::Bevy => "wgsl",
            _ => "glsl",
        };
        let _ = write!(out, "```{word}\n{text}```\n");
    }
    out
}

/// Compares a page, or writes it.
fn check(name: &str, text: &str) {
    let path = root().join(PAGES).join(name);
    if std::env::var_os("BLESS").is_some() {
        fs::create_dir_all(root().join(PAGES)).expect("a folder");
        fs::write(&path, text).expect("a page");
    }
    let known = fs::read_to_string(&path).unwrap_or_default();
    assert!(known == text, "{PAGES}/{name} is not up to date: BLESS=1");
}

#[test]
fn pages_are_made_from_templates() {
    for template in files(TEMPLATES, "md") {
        if template.name != "beside" {
            check(&format!("{}.md", template.name), &page(&template.text));
        }
    }
}

fn parsed(text: &str) -> (Module, naga::valid::ModuleInfo) {
    let mut module = naga::front::wgsl::parse_str(text)
        .unwrap_or_else(|e| panic!("{}\n{text}", e.emit_to_string(text)));
    pullback_compiler::emit::restore_operators(&mut module);
    let info = Validator::new(ValidationFlags::all(), Capabilities::default())
        .validate(&module)
        .unwrap_or_else(|e| panic!("{}", e.emit_to_string(text)));
    (module, info)
}

fn last(module: &Module) -> Handle<Function> {
    module.functions.iter().last().expect("a function").0
}

/// Most arithmetic that an emitted function may have, of that in what an expert wrote.
const MOST: f64 = 1.1;

/// Those that keep a bound in the tier `accurate` which the text by hand does not: they are compared with one that does.
const CAREFUL: [&str; 1] = ["fog"];

/// The text of the last function.
fn last_function(text: &str) -> &str {
    text.rfind("\nfn ").map_or(text, |at| text[at..].trim())
}

/// What integrals along rays are declared to be off at most, as a part of ∫ |f| (docs/integrals.md).
const PART: f64 = 1e-6;
const RAYS: usize = 10_000;
/// Rays that are computed side by side.
const LANES: usize = 16;

/// The integral of 0.5 + 0.1 z along a ray, and that of its absolute value.
fn fog([_, _, o, _, _, d, a, b]: [f64; 8]) -> (f64, f64) {
    // o + 5 is exact in binary64
    let height = |t: f64| 0.1 * t.mul_add(d, o + 5.0);
    let (first, last) = (height(a), height(b));
    let whole = (b - a) * 0.5 * (first + last);
    let size = if first * last >= 0.0 {
        whole.abs()
    } else {
        (b - a).abs() * 0.5 * (first * first + last * last) / (first.abs() + last.abs())
    };
    (whole, size)
}

/// How many of the rays a text computes within the bound, in exact binary32. They are aimed at the plane where the density is 0.
fn share_within(text: &str) -> usize {
    let arguments = "(ox: f32, oy: f32, oz: f32, dx: f32, dy: f32, dz: f32, a: f32, b: f32)";
    let text = format!(
        "{text}\nfn judged{arguments} -> f32 {{ return fog_integral(vec3f(ox, oy, oz), vec3f(dx, dy, dz), a, b); }}\n"
    );
    let (module, info) = parsed(&text);
    let options = Options {
        arithmetic: Arithmetic::Ieee32,
        format: Format::Single,
        watched: Watched::Nothing,
        contraction: Contraction::None,
    };
    let program =
        Program::new(&module, &info, Start::Function("judged"), options).expect("a program");
    let mut machine = Machine::new(&program);
    let mut within = |rays: &[Ray]| {
        for (lane, ray) in rays.iter().enumerate() {
            for (k, (argument, &x)) in program.arguments.iter().zip(&ray.numbers).enumerate() {
                machine.set_argument(k, lane, argument.encode(x));
            }
        }
        machine.run(rays.len(), Limits::default()).expect("it runs");
        let is_within = |(lane, ray): &(usize, &Ray)| {
            let (whole, size) = fog(ray.numbers);
            // of numbers below the normal ones digits are lost
            let least = size.min(size / (ray.numbers[7] - ray.numbers[6]).abs());
            let computed = program.results[0].decode(machine.result(0, *lane));
            least < f64::from(f32::MIN_POSITIVE) || (computed - whole).abs() <= PART * size
        };
        rays.iter().enumerate().filter(is_within).count()
    };
    let around_plane = |mut ray: Ray| {
        let [_, _, o, _, _, d, a, b] = ray.numbers;
        let there = -(o + 5.0) / d;
        if there.abs() < 1e4 {
            #[allow(clippy::cast_possible_truncation, reason = "as the function takes it")]
            let ends = [a, b].map(|t| f64::from((t + there) as f32));
            ray.numbers[6..].copy_from_slice(&ends);
        }
        ray
    };
    let rays: Vec<Ray> = rays(RAYS, 1).into_iter().map(around_plane).collect();
    rays.chunks(LANES).map(&mut within).sum()
}

/// Which of the texts of `fog` keep the bound, as a table.
fn shares() -> String {
    let read = |name: &str| fs::read_to_string(root().join(EXPERT).join(name)).expect("a text");
    let program = "fog(x, y, z) = 0.5 + 0.1 z";
    let emission = Emission::new(EmitWhat::Integral, Target::Wgsl);
    let ours = |precision| {
        let code = emitted(&emission.clone().precision(precision), program);
        share_within(&String::from_utf8_lossy(&code.bytes))
    };
    let (plain, careful) = (
        share_within(&read("fog.wgsl")),
        share_within(&read("careful/fog.wgsl")),
    );
    let (fast, accurate) = (ours(Precision::Fast), ours(Precision::Accurate));
    assert_eq!([careful, accurate], [RAYS; 2], "rays within the bound");
    assert!(
        plain < RAYS && fast < RAYS,
        "the bound is met without care: {plain}, {fast}"
    );
    format!(
        "| Text of `fog` | Rays of {RAYS} within 1e-6 of ∫ \\|f\\| |\n| --- | --- |\n| by hand, plain | {plain} |\n\
         | emitted, `fast` | {fast} |\n| by hand, within the bound | {careful} |\n| emitted, `accurate` | {accurate} |\n"
    )
}

#[test]
fn emitted_functions_are_as_short_as_written_ones() {
    let template =
        fs::read_to_string(root().join(TEMPLATES).join("beside.md")).expect("a template");
    let mut table = String::from(
        "| Formula | Function | Operations, `fast` | by hand | `accurate` | with what it calls | Lines, `fast` | by hand |\n| --- | --- | --- | --- | --- | --- | --- | --- |\n",
    );
    let (mut texts, mut careful_texts) = (String::new(), String::new());
    let (mut longer, mut careful_ones) = (Vec::new(), Vec::new());
    for expert in files(EXPERT, "wgsl") {
        let (head, own) = expert.text.split_once('\n').expect("a head");
        let mut head = head.trim_start_matches("// ").split(" | ");
        let (formula, asked) = (
            head.next().expect("a formula"),
            head.next().expect("a part"),
        );
        let program = head.fold(formula.to_owned(), |all, more| format!("{more}\n{all}"));
        let emission = Emission::new(what(asked), Target::Wgsl).precision(Precision::Fast);
        let code = emitted(&emission, &program);
        let text = String::from_utf8(code.bytes.clone()).expect("a text");
        judged(&emission, &code);
        let (ours, our_info) = parsed(&text);
        let (theirs, their_info) = parsed(own);
        let careful = emitted(&emission.precision(Precision::Accurate), &program);
        let careful_text = String::from_utf8_lossy(&careful.bytes).into_owned();
        let (careful, careful_info) = parsed(&careful_text);
        let count = [
            operations(&ours, &our_info, last(&ours)),
            operations(&theirs, &their_info, last(&theirs)),
            own_operations(&careful, &careful_info, last(&careful)),
            operations(&careful, &careful_info, last(&careful)),
        ];
        let body: Vec<&str> = text.lines().skip_while(|l| l.starts_with("//")).collect();
        let body = body.join("\n");
        let length = [lines(&body), lines(own)];
        let _ = writeln!(
            table,
            "| `{}` | {asked} | {} | {} | {} | {} | {} | {} |",
            formula.replace('|', "\\|"),
            count[0],
            count[1],
            count[2],
            count[3],
            length[0],
            length[1]
        );
        let _ = write!(
            texts,
            "\n## `{formula}`, {asked}\n\nEmitted:\n\n```wgsl\n{}\n```\n\nBy hand:\n\n```wgsl\n{}\n```\n",
            body.trim(),
            own.trim()
        );
        #[allow(clippy::cast_precision_loss, reason = "small counts")]
        let is_longer = |count: usize, by_hand: usize| count as f64 > MOST * by_hand as f64;
        if is_longer(count[0], count[1]) {
            longer.push(format!("{formula}: {} and {}\n{body}", count[0], count[1]));
        }
        if is_longer(count[2], count[1]) {
            careful_ones.push(expert.name.clone());
        }
        if CAREFUL.contains(&expert.name.as_str()) {
            let text = fs::read_to_string(
                root()
                    .join(EXPERT)
                    .join("careful")
                    .join(format!("{}.wgsl", expert.name)),
            );
            let text = text.expect("a careful text");
            let (module, info) = parsed(&text);
            let (own, whole) = (
                own_operations(&module, &info, last(&module)),
                operations(&module, &info, last(&module)),
            );
            if is_longer(count[2], own) {
                longer.push(format!("{formula}: {} and {own}", count[2]));
            }
            let _ = write!(
                careful_texts,
                "\n## `{formula}`, {asked}, within the bound\n\nEmitted in `accurate`, {} operations, {} with the function that it calls:\n\n```wgsl\n{}\n```\n\nBy hand, {own} and {whole}:\n\n```wgsl\n{}\n```\n",
                count[2],
                count[3],
                last_function(&careful_text),
                text.trim()
            );
        }
    }
    assert!(longer.is_empty(), "{}", longer.join("\n"));
    assert_eq!(careful_ones, CAREFUL, "longer in `accurate` by themselves");
    let page = template
        .replace("TABLE\n", &table)
        .replace("SHARES\n", &shares())
        .replace("TEXTS\n", (texts + &careful_texts).trim_start());
    check("beside.md", &page);
}
