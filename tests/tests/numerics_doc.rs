//! The summary of the accuracy tables in docs/numerics.md: made of docs/accuracy-{lavapipe,h200}.md, which `pullback accuracy`
//! writes. `BLESS=1` writes it.

use std::collections::BTreeMap;
use std::fmt::Write as _;

const BEGIN: &str = "<!-- summary of the accuracy tables: `BLESS=1 cargo test --workspace --test numerics_doc` -->\n";
const END: &str = "<!-- end of the summary -->\n";
const TIERS: [&str; 4] = ["fast", "accurate", "extended", "double"];

/// The functions of each group, real and complex.
const GROUPS: [(&str, &[&str]); 9] = [
    (
        "sums, products, quotients",
        &["neg", "add", "sub", "mul", "div", "inverse"],
    ),
    (
        "powers and roots",
        &[
            "square",
            "cube",
            "pow7",
            "inverse_square",
            "pow",
            "sqrt",
            "cbrt",
            "hypot",
        ],
    ),
    (
        "exponentials and logarithms",
        &[
            "exp", "exp2", "expm1", "exprel", "log", "log2", "log10", "log1p",
        ],
    ),
    ("waves", &["sin", "cos", "tan", "sec", "csc", "sinc"]),
    (
        "hyperbolic waves",
        &["sinh", "cosh", "tanh", "sech", "csch", "sinhc"],
    ),
    (
        "inverse functions",
        &[
            "asin", "acos", "atan", "atan2", "arg", "asinh", "acosh", "atanh",
        ],
    ),
    (
        "parts and whole numbers",
        &[
            "abs", "sign", "re", "im", "conj", "min", "max", "mod", "floor", "ceil", "round",
            "trunc", "fract",
        ],
    ),
    ("gamma family", &["gamma", "lgamma", "digamma", "trigamma"]),
    (
        "ray integrals",
        &[
            "atanq",
            "atan2q",
            "log1prel",
            "log1pexp",
            "erf",
            "erfc",
            "erfcx",
            "gaussmass",
            "gaussmassx",
        ],
    ),
];

/// What is said of one function in one tier.
#[derive(Clone, Copy, Default)]
struct Errors {
    value: f64,
    derivative: f64,
    /// Declared bounds; none in `fast`.
    bounds: Option<[f64; 2]>,
}

/// The rows of an accuracy table by function (with ` (complex)` behind it) and tier.
fn table(name: &str) -> BTreeMap<(String, String), Errors> {
    let path = format!("{}/../docs/{name}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).expect("an accuracy table");
    let number = |cell: &str| -> f64 {
        let word = cell.split([' ', ',']).next().unwrap_or("");
        match word {
            "-" => 0.0,
            // a NaN or an infinity that should be none, or a zero of the wrong sign
            _ if cell.ends_with("wrong") => f64::INFINITY,
            _ => word.parse().unwrap_or_else(|_| panic!("{path}: {cell}")),
        }
    };
    let mut out = BTreeMap::new();
    for line in text.lines().filter(|line| line.starts_with("| ")) {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        if !TIERS.contains(&cells[1]) {
            continue;
        }
        let bounds = (cells[4] != "-").then(|| [number(cells[4]), number(cells[8])]);
        let errors = Errors {
            value: number(cells[2]),
            derivative: number(cells[6]),
            bounds,
        };
        out.insert((cells[0].to_owned(), cells[1].to_owned()), errors);
    }
    assert!(!out.is_empty(), "{path} has no rows");
    out
}

/// Two digits, or the power of ten of what has none.
fn shown(x: f64) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    if x.is_infinite() {
        return "∞".to_owned();
    }
    if x >= 1e4 {
        return format!("1e{}", x.log10().floor());
    }
    let digits = if x < 10.0 { 1 } else { 0 };
    format!("{x:.digits$}")
}

/// The greatest errors of a group, on either adapter, and its greatest bounds.
struct Worst {
    found: [[f64; 2]; 2],
    bounds: Option<[f64; 2]>,
}

type Table = BTreeMap<(String, String), Errors>;

fn worst(tables: &[Table; 2], functions: &[String], tier: &str) -> Option<Worst> {
    let mut out = Worst {
        found: [[0.0; 2]; 2],
        bounds: None,
    };
    let mut any = false;
    for function in functions {
        let key = (function.clone(), tier.to_owned());
        for (found, table) in out.found.iter_mut().zip(tables) {
            let Some(errors) = table.get(&key) else {
                continue;
            };
            any = true;
            found[0] = found[0].max(errors.value);
            found[1] = found[1].max(errors.derivative);
        }
        // the other adapter has allowances beside them
        if let Some(bounds) = tables[0].get(&key).and_then(|errors| errors.bounds) {
            let so_far = out.bounds.unwrap_or_default();
            out.bounds = Some([so_far[0].max(bounds[0]), so_far[1].max(bounds[1])]);
        }
    }
    any.then_some(out)
}

fn cell(worst: Option<&Worst>, k: usize) -> String {
    let Some(worst) = worst else {
        return "-".to_owned();
    };
    let mut text = format!(
        "{} / {}",
        shown(worst.found[0][k]),
        shown(worst.found[1][k])
    );
    if let Some(bounds) = worst.bounds {
        let _ = write!(text, " ≤ {}", shown(bounds[k]));
    }
    text
}

fn summary(tables: &[Table; 2]) -> String {
    let mut out = String::from(
        "| functions | fast | accurate | accurate, slope | extended | extended, slope | double | double, slope |\n\
         | --- | --- | --- | --- | --- | --- | --- | --- |\n",
    );
    for complex in [false, true] {
        for (group, functions) in GROUPS {
            let names: Vec<String> = functions
                .iter()
                .map(|f| {
                    if complex {
                        format!("{f} (complex)")
                    } else {
                        (*f).to_owned()
                    }
                })
                .collect();
            let of = |tier| worst(tables, &names, tier);
            let Some(fast) = of("fast") else { continue };
            let kind = if complex { ", complex" } else { "" };
            let _ = write!(out, "| {group}{kind} | {} ", cell(Some(&fast), 0));
            for tier in &TIERS[1..] {
                let found = of(tier);
                for k in 0..2 {
                    let _ = write!(out, "| {} ", cell(found.as_ref(), k));
                }
            }
            out += "|\n";
        }
    }
    out
}

/// Every function of the tables is in one group, and only functions are.
#[test]
fn groups_cover_the_tables() {
    let tables = [table("accuracy-lavapipe.md"), table("accuracy-h200.md")];
    let grouped: Vec<&str> = GROUPS.iter().flat_map(|g| g.1).copied().collect();
    for (k, name) in grouped.iter().enumerate() {
        assert!(!grouped[..k].contains(name), "{name} is in two groups");
        let key = ((*name).to_owned(), "accurate".to_owned());
        assert!(tables[0].contains_key(&key), "{name} is no function");
    }
    for (function, _) in tables.iter().flat_map(BTreeMap::keys) {
        let name = function.trim_end_matches(" (complex)");
        assert!(grouped.contains(&name), "{name} is in no group");
    }
}

#[test]
fn the_document_has_the_summary() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/numerics.md");
    let text = std::fs::read_to_string(path).expect("the document");
    let (head, rest) = text.split_once(BEGIN).expect("a place for the summary");
    let (_, tail) = rest.split_once(END).expect("its end");
    let tables = [table("accuracy-lavapipe.md"), table("accuracy-h200.md")];
    let made = format!("{head}{BEGIN}{}{END}{tail}", summary(&tables));
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(path, &made).expect("the document is written");
        return;
    }
    assert!(
        made == text,
        "docs/numerics.md is not up to date: run with BLESS=1 and read the difference"
    );
}
