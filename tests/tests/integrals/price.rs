//! What integrals cost: the table of docs/integrals-stability.md. `BLESS=1` writes it.

use std::fmt::Write as _;

use pullback_compiler::integrate::{Otherwise, explain, shifted_field_integral};
use pullback_compiler::ir::cost;

use super::formula;

const PAGE: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../docs/integrals-stability.md"
);
const BEGIN: &str = "<!-- price: `BLESS=1 cargo test --workspace --test integrals price` -->\n";
const END: &str = "<!-- end of the price -->";

/// Densities, and how many operations their integrals were before rests were kept; 0 of those that were not counted then.
const BEFORE: [(&str, u32); 19] = [
    ("0.5 + 0.5 sin(9 z - 2.5)", 24),
    ("sin(3 y)^2", 81),
    ("exp(-2 y)", 19),
    ("exp(-y) (1 + 0.5 cos(5 x))", 151),
    ("y exp(-y)", 112),
    ("exp(-(x^2 + y^2 + z^2))", 151),
    ("(x^2 + y^2 + z^2 - 1)^2", 59),
    (
        "(sin(3 x) cos(3 y) + sin(3 y) cos(3 z) + sin(3 z) cos(3 x))^2",
        414,
    ),
    ("x^2 length((x, y, z))", 343),
    ("1/(x^2 + y^2 + z^2 + 0.01)", 50),
    ("1/(x^2 + y^2 - 4)", 51),
    ("1/(1 + exp(-6 y))", 35),
    ("if x^2 + y^2 + z^2 < 1 then 1 + y else 0", 199),
    ("max(0, 1 - x^2 - y^2 - z^2)^3", 369),
    ("clamp(y, 0, 1)^2", 33),
    ("log(x^2 + y^2 + z^2 + 0.01)", 0),
    ("x^2 log(x^2 + y^2 + z^2 + 0.1)", 0),
    ("1/length((x, y, z))", 0),
    ("x^20 - 20 x^18 y^2 + 0.75", 0),
];

#[test]
fn price_of_rests() {
    let mut table =
        "| density | before rests were kept | now | shifted ray |\n| --- | ---: | ---: | ---: |\n"
            .to_owned();
    for (text, before) in BEFORE {
        let of = formula(text);
        let now = explain(&of, &[]).unwrap().operations;
        let shifted = shifted_field_integral(&of, Otherwise::Refuse).unwrap();
        let (graph, roots) = shifted.graph.compacted(&[shifted.integral.value]);
        let shifted = cost(&graph, &roots).operations;
        let before = if before == 0 {
            "–".to_owned()
        } else {
            before.to_string()
        };
        let _ = writeln!(table, "| `{text}` | {before} | {now} | {shifted} |");
    }
    let page = std::fs::read_to_string(PAGE).unwrap();
    let begin = page.find(BEGIN).expect("the mark of the table") + BEGIN.len();
    let end = page.find(END).expect("the mark of the table's end");
    let new = format!("{}\n{table}\n{}", &page[..begin], &page[end..]);
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(PAGE, new).unwrap();
        return;
    }
    assert!(
        page == new,
        "docs/integrals-stability.md is not up to date: BLESS=1"
    );
}
