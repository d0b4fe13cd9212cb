//! Time from a text of 1 MiB to its last diagnostic: `cargo bench -p pullback-grammar`.
//!
//! The best of several runs, in milliseconds; more than [`BOUND`] is a failure. An argument is a part of the names
//! of the texts to be read.

use std::hint::black_box;
use std::time::{Duration, Instant};

use pullback_grammar::parse;

const SIZE: usize = 1 << 20;
const RUNS: usize = 12;
const BOUND: Duration = Duration::from_millis(100);

/// Statements as people write them.
const WELL_FORMED: &str = "\
// Schwarz P, and the family around it
param level = 0 in -2..2
schwarz(x, y, z) = cos(k π x) + cos(k π y) + cos(k π z) - level
smooth(x) = { x < 0: 0, x < 1: x²(3 - 2x), else: 1 }
julia(z) = iterate(200, w = z, d = 1, (w^2 + c, 2 w d), until |w| > 2).count where c = 0.3 + 0.5i
wave(x, t) = sum(n in 1..20, sin(n x) exp(-n^2 t)/n) + |x - 2| √(x^2 + 1)
fold(p: vec3) = length(p) - r where p.xy = abs(p.xy) - 1, r = if p.z < 0 then 1/2 else 0.25
area(a, b) = integral(t^2 sin(t), t, a, b) + integral(s in a..b, s!)
show surface(schwarz) { box = 2, range = 0..1.5 }
";

/// Statements with a mistake in each line.
const DAMAGED: &str = "\
param level = in -2..2
schwarz(x, y, z) = cos(k π x + cos(k π y) + cos(k π z) - level
smooth(x) = { x < 0 0, x < 1: x²(3 - 2x), else: 1 }
julia(z) = iterate(200, w = z, d = 1, w^2 + c until |w| > 2).count where c = 0.3 + 0.5i
wave(x, t) = sum(n = 1..20, sin(n x) exp(-n^2 t)/n) + |x - 2| √(x^2 + 1)
fold(p: vec3) = length(p) - * r where p.xy = abs(p.xy) - 1, r = 1
area(a, b) = integral(t^2 sin t, t, a, b) + integral(s in a..b, s!)
show surface schwarz { box = 2, range = 0..1.5 }
x @ y = 3
";

const EXPRESSION: &str = "(x + 2y) sin(3 π x^2) - √(|x - y|^3 + 1) / max(x, 2, z) * k ";

/// As many times a text as make 1 MiB.
fn fill(text: &str) -> String {
    text.repeat(SIZE / text.len())
}

fn texts() -> Vec<(&'static str, String)> {
    let chain = format!("f(x) = {}x", fill(&format!("{EXPRESSION}+ ")));
    let deep = format!("{}x{} + ", "(".repeat(190), ")".repeat(190));
    let loops = format!(
        "{}x{} + ",
        "sum(k in 1..9, iterate(9, z = x, ".repeat(90),
        "))".repeat(90)
    );
    vec![
        ("well formed", fill(WELL_FORMED)),
        ("an error in each line", fill(DAMAGED)),
        ("one expression", chain),
        ("factors without a sign", fill("x (y) ")),
        ("nested brackets", format!("{}x", fill(&deep))),
        ("nested loops", format!("{}x", fill(&loops))),
        ("opening brackets", fill("(")),
        ("closing brackets", fill(")")),
        ("opening and closing brackets", fill("(}{)")),
        ("opened sums", fill("sum(k in 1..2, ")),
        ("one list", format!("max({}x)", fill("x, "))),
        ("locals", format!("x where {}b = 1", fill("a = x, "))),
        ("strays", fill("@ ")),
        ("one name", fill("a")),
    ]
}

/// Builtin functions, as a host knows them.
fn is_function(name: &str) -> bool {
    matches!(
        name,
        "sin" | "cos" | "exp" | "max" | "min" | "abs" | "length" | "sqrt" | "log" | "tan"
    )
}

fn main() {
    let wanted = std::env::args().skip(1).find(|arg| !arg.starts_with('-'));
    let is_wanted = |name: &str| wanted.as_deref().is_none_or(|part| name.contains(part));
    let mut slow = Vec::new();
    for (name, text) in texts().into_iter().filter(|(name, _)| is_wanted(name)) {
        let mut best = Duration::MAX;
        let mut problems = 0;
        for _ in 0..RUNS {
            let start = Instant::now();
            let parsed = black_box(parse(black_box(&text), &is_function));
            best = best.min(start.elapsed());
            problems = parsed.diagnostics.len();
        }
        println!(
            "{name:<30} {:>7.1} ms {:>9} bytes {problems:>4} problems",
            best.as_secs_f64() * 1e3,
            text.len(),
        );
        if best > BOUND {
            slow.push(name);
        }
    }
    if !slow.is_empty() {
        println!("over {} ms: {}", BOUND.as_millis(), slow.join(", "));
        std::process::exit(1);
    }
}
