//! What people paste means what the same formula means in this language: both give the same numbers.

use pullback_compiler::check::is_builtin_function;
use pullback_compiler::compile;
use pullback_compiler::eval::{Leaves, Tape};
use pullback_compiler::table::Number;
use pullback_grammar::{format, parse, print};
use pullback_tests::corpus::root;

/// Points at which formulas are compared.
const POINTS: [[f64; 2]; 5] = [
    [0.37, -1.21],
    [1.9, 0.53],
    [-0.71, -0.29],
    [-2.3, 1.7],
    [0.0, 0.0],
];

/// Pasted text, and the same in this language. Each is a real function of x and y.
const PAIRS: &[(&str, &str)] = &[
    (r"\frac{\sin 2\pi x}{1 + y^{2}}", "sin(2π x)/(1 + y^2)"),
    (
        r"\sqrt[3]{x} + \sqrt{y^2} + \sqrt[4]{x^2}",
        "cbrt(x) + sqrt(y^2) + (x^2)^(1/4)",
    ),
    (
        r"\cos^2 x \ln\left|y\right| - \log_2 3x",
        "cos(x)^2 log(|y|) - log2(3x)",
    ),
    (
        r"\left\lfloor 3x \right\rfloor y + \operatorname{sgn} y",
        "floor(3x) y + sign(y)",
    ),
    (
        r"\begin{cases} x & y < 0 \\ x y & \text{otherwise} \end{cases}",
        "{ y < 0: x, else: x y }",
    ),
    (
        r"\sum_{k=1}^{4} \frac{\sin k x}{k} y^k",
        "sum(k in 1..4, sin(k x)/k y^k)",
    ),
    (
        r"\prod_{k=1}^{3} (x - k) + y",
        "product(k in 1..3, x - k) + y",
    ),
    (
        "f(x, y) = x < 0 || y > 1 ? x*x : y",
        "if x < 0 or y > 1 then x^2 else y",
    ),
    ("f(x, y) = x if y < 0 else y**2", "if y < 0 then x else y^2"),
    (
        "f(x, y) = np.where(np.sin(x) < y, x, np.arctan2(y, x))",
        "if sin(x) < y then x else atan2(y, x)",
    ),
    ("1.5f*x + 2.*y - atan(y, x)", "1.5x + 2y - atan2(y, x)"),
    (
        "float f(float x, float y) { float r = hypotf(x, y); r *= 2.0; return fabs(r - 1.0f); }",
        "|2hypot(x, y) - 1|",
    ),
    (
        "f(x, y) = length(vec3f(x, y, 1.0)) + dot(float2(x, y), vec2<f32>(y, 2.0))",
        "length((x, y, 1)) + x y + 2y",
    ),
    (
        "tg(x) + sh(y) + Heaviside(x)",
        "tan(x) + sinh(y) + if x < 0 then 0 else if x > 0 then 1 else 1/2",
    ),
    (
        "fmod(x, 0.5) + mod(y, 0.5)",
        "x - 0.5 trunc(x/0.5) + y - 0.5 floor(y/0.5)",
    ),
    ("f[x_, y_] := Sin[Pi x] + Exp[y]", "sin(π x) + exp(y)"),
    ("def f(x, y): return math.exp(-x**2) * y", "exp(-x^2) y"),
    (
        r"|\bar{x + i y}| + \Re \left((x + i y)^2\right)",
        "hypot(x, y) + x^2 - y^2",
    ),
];

/// The values of the picture that a text describes.
fn values(text: &str) -> Vec<Number> {
    let answer = compile(text);
    let program = answer
        .program
        .unwrap_or_else(|| panic!("{text}: {:?}", answer.diagnostics));
    let formula = &program.pictures()[0].formula;
    let mut out = Vec::new();
    for point in POINTS {
        let inputs = point.map(Number::Real);
        let leaves = Leaves {
            inputs: &inputs,
            params: &[],
            time: 0.0,
            pixel: 0.01,
        };
        Tape::new(&formula.graph, &formula.value).run(&leaves, |value| out.push(value));
    }
    out
}

/// The text as a function of x and y.
fn of_two(text: &str) -> String {
    let is_definition = ["f(", "f[", "float f", "def f"]
        .iter()
        .any(|start| text.starts_with(start));
    if is_definition {
        text.to_owned()
    } else {
        format!("f(x, y) = {text}")
    }
}

fn assert_equal(one: &str, other: &str) {
    let (left, right) = (values(one), values(other));
    assert_eq!(left.len(), right.len(), "{one}");
    for (a, b) in left.iter().zip(&right) {
        let (Number::Real(a), Number::Real(b)) = (a, b) else {
            panic!("{one} is not real");
        };
        let near = (a - b).abs() <= 1e-14 * a.abs().max(1.0) || (a.is_nan() && b.is_nan());
        assert!(near, "{one}\n{other}\n{a} {b}");
    }
}

#[test]
fn pasted_formulas_have_the_values_of_ours() {
    for (pasted, ours) in PAIRS {
        assert_equal(&of_two(pasted), &of_two(ours));
    }
}

#[test]
fn formatting_keeps_the_values() {
    for (pasted, _) in PAIRS {
        let pasted = of_two(pasted);
        let formatted = format(&pasted, &is_builtin_function).expect("a text without errors");
        assert!(!formatted.contains(['\\', '?', '[', ';']), "{formatted}");
        assert_equal(&pasted, &formatted);
    }
}

/// The code of a cell of a table.
fn codes(cell: &str) -> Vec<String> {
    let parts = cell.split('`').skip(1).step_by(2);
    parts.map(|code| code.replace("\\|", "|")).collect()
}

/// The table of the language reference: each text on the left is the one on the right.
#[test]
fn the_table_of_the_reference_is_true() {
    let path = root().join("docs/language.md");
    let page = std::fs::read_to_string(path).expect("the reference");
    let section = page
        .split("## Pasting from elsewhere")
        .nth(1)
        .expect("the section");
    let section = section
        .split("\n## ")
        .next()
        .unwrap_or_default()
        .replace("\\|", "\u{1}");
    let mut count = 0;
    for row in section.lines().filter(|line| line.starts_with("| `")) {
        let cells: Vec<&str> = row.split('|').collect();
        let cell = |index: usize| codes(&cells[index].replace('\u{1}', "|"));
        let (pasted, mut ours) = (cell(1), cell(2));
        if ours.is_empty() {
            continue;
        }
        if let [one] = ours.as_slice() {
            ours = vec![one.clone(); pasted.len()];
        }
        assert_eq!(pasted.len(), ours.len(), "{row}");
        for (pasted, ours) in pasted.iter().zip(&ours) {
            // signs alone are no formulas
            let is_formula = pasted.contains(|c: char| "xayzf123".contains(c));
            if pasted.contains('…')
                || ours.contains('…')
                || !is_formula
                || ours.len() <= 3 && pasted.starts_with('\\')
            {
                continue;
            }
            let (left, right) = (
                parse(pasted, &is_builtin_function),
                parse(ours, &is_builtin_function),
            );
            assert_eq!(left.diagnostics, [], "{pasted}");
            assert_eq!(print(&left.file), print(&right.file), "{pasted}");
            count += 1;
        }
    }
    assert!(count >= 50, "{count}");
}
