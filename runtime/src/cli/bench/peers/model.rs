//! Models of fidget in our language: a line for each operation, as fidget's text format has them.

use std::collections::HashMap;
use std::fmt::Write as _;

/// The program of a model of the plane: f, negative inside. `None` where a line is no operation that models of text have.
pub(super) fn program(text: &str) -> Option<String> {
    let mut names: HashMap<&str, String> = HashMap::new();
    let mut definitions = String::new();
    let mut last = None;
    for line in text.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        let &[name, operation, ref operands @ ..] = words.as_slice() else {
            continue;
        };
        if name.starts_with('#') {
            continue;
        }
        let id = name.strip_prefix('_')?;
        if operation == "const" {
            let number: f64 = operands.first()?.parse().ok()?;
            names.insert(name, format!("({number})"));
            continue;
        }
        if let Some(axis) = operation.strip_prefix("var-") {
            names.insert(name, axis.to_owned());
            continue;
        }
        let of = |k: usize| names.get(*operands.get(k)?).map(String::as_str);
        let a = of(0)?;
        let b = of(1).unwrap_or_default();
        let formula = match (operation, operands.len()) {
            ("add", 2) => format!("{a} + {b}"),
            ("sub", 2) => format!("{a} - {b}"),
            ("mul", 2) => format!("{a} * {b}"),
            ("div", 2) => format!("{a} / {b}"),
            ("max" | "min", 2) => format!("{operation}({a}, {b})"),
            ("neg", 1) => format!("-{a}"),
            ("square", 1) => format!("{a}^2"),
            ("sqrt" | "abs" | "sin" | "cos" | "exp", 1) => format!("{operation}({a})"),
            _ => return None,
        };
        let comma = if last.is_some() { ",\n" } else { "" };
        let _ = write!(definitions, "{comma}    v{id} = {formula}");
        names.insert(name, format!("v{id}"));
        last = Some(format!("v{id}"));
    }
    let last = last?;
    Some(format!("f(x, y) = {last}\n  where\n{definitions}\n"))
}

#[cfg(test)]
mod tests {
    use super::program;
    use pullback_compiler::{Evaluator, What, compile};

    #[test]
    fn a_model_is_a_program() {
        let text = "# a disc\n_0 var-x\n_1 var-y\n_2 square _0\n_3 square _1\n_4 add _2 _3\n_5 sqrt _4\n_6 const -1.5\n\
                    _7 add _5 _6\n_8 neg _7\n_a max _7 _8\n";
        let text = program(text).unwrap();
        let program = compile(&text).program.unwrap();
        let mut evaluator = Evaluator::new(&program.pictures()[0].formula, What::Value).unwrap();
        let mut out = [0.0];
        evaluator.eval(&[], 0.0, 0.0, &[3.0, 4.0], &mut out);
        assert_eq!(out, [3.5]);
        for bad in [
            "",
            "_0 var-x\n_1 sqrt _7\n",
            "_0 var-x\n_1 erf _0\n",
            "0 const 1\n",
        ] {
            assert_eq!(super::program(bad), None, "{bad}");
        }
    }
}
