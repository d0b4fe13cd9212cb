//! Vectors in C: structures, and a function for each operation on them that a text calls.

use naga::ScalarKind;

use super::Printer;

const LETTERS: [&str; 4] = ["x", "y", "z", "w"];

/// A type of vectors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct CVector {
    kind: &'static str,
    size: usize,
}

impl CVector {
    pub(super) fn new(kind: ScalarKind, size: usize) -> Self {
        let kind = match kind {
            ScalarKind::Bool => "b",
            ScalarKind::Sint => "i",
            ScalarKind::Uint => "u",
            _ => "",
        };
        let size = size.min(LETTERS.len());
        Self { kind, size }
    }

    /// A vector of as many truth values.
    fn truths(self) -> Self {
        Self { kind: "b", ..self }
    }

    pub(super) fn name(self) -> String {
        format!("{}vec{}", self.kind, self.size)
    }

    fn scalar(self) -> &'static str {
        match self.kind {
            "b" => "bool",
            "i" => "int32_t",
            "u" => "uint32_t",
            _ => "float",
        }
    }

    fn letters(self) -> &'static [&'static str] {
        &LETTERS[..self.size]
    }

    /// The declaration of the type.
    pub(super) fn declaration(self) -> String {
        let members = self.letters().join(", ");
        let (scalar, name) = (self.scalar(), self.name());
        format!("typedef struct {{\n    {scalar} {members};\n}} {name};\n")
    }
}

/// What a function for an operator is called, behind the name of the type.
fn word(sign: &str) -> Option<&'static str> {
    Some(match sign {
        "+" => "add",
        "-" => "sub",
        "*" => "mul",
        "/" => "div",
        "&" => "and",
        "|" => "or",
        "^" => "xor",
        "<<" => "left",
        ">>" => "right",
        "<" => "less",
        "<=" => "at_most",
        ">" => "greater",
        ">=" => "at_least",
        "==" => "equal",
        "!=" => "differ",
        _ => return None,
    })
}

fn compares(sign: &str) -> bool {
    matches!(sign, "<" | "<=" | ">" | ">=" | "==" | "!=")
}

impl Printer<'_> {
    fn c_helper(&self, name: String, result: &str, parameters: &str, value: &str) -> String {
        let text =
            format!("static inline {result} {name}({parameters}) {{\n    return {value};\n}}\n");
        self.helpers.borrow_mut().insert(name.clone(), text);
        name
    }

    /// A vector whose components are made of a letter each.
    fn c_each(&self, of: CVector, part: impl Fn(&str) -> String) -> String {
        self.vectors.borrow_mut().insert(of);
        let parts: Vec<String> = of.letters().iter().map(|c| part(c)).collect();
        format!("({}){{{}}}", of.name(), parts.join(", "))
    }

    /// A vector of equal components.
    pub(super) fn c_splat(&self, of: CVector) -> String {
        let value = self.c_each(of, |_| "s".to_owned());
        let name = of.name();
        let parameters = format!("{} s", of.scalar());
        self.c_helper(format!("{name}_all"), &name, &parameters, &value)
    }

    /// `a op b` by components.
    pub(super) fn c_binary(&self, of: CVector, sign: &str) -> Option<String> {
        let word = word(sign)?;
        let result = if compares(sign) { of.truths() } else { of };
        let value = self.c_each(result, |c| format!("a.{c} {sign} b.{c}"));
        let name = of.name();
        Some(self.c_helper(
            format!("{name}_{word}"),
            &result.name(),
            &format!("{name} a, {name} b"),
            &value,
        ))
    }

    /// Each component by a number.
    pub(super) fn c_scaled(&self, of: CVector, sign: &str) -> Option<String> {
        let word = match sign {
            "*" => "scale",
            "/" => "over",
            "+" => "plus",
            "-" => "minus",
            _ => return None,
        };
        let value = self.c_each(of, |c| format!("v.{c} {sign} s"));
        let name = of.name();
        Some(self.c_helper(
            format!("{name}_{word}"),
            &name,
            &format!("{name} v, {} s", of.scalar()),
            &value,
        ))
    }

    /// `-v`, `~v` or `!v`.
    pub(super) fn c_signed(&self, of: CVector, sign: &str) -> String {
        let word = match sign {
            "-" => "neg",
            "~" => "complement",
            _ => "not",
        };
        let value = self.c_each(of, |c| format!("{sign}v.{c}"));
        let name = of.name();
        self.c_helper(
            format!("{name}_{word}"),
            &name,
            &format!("{name} v"),
            &value,
        )
    }

    /// The components of the second vector where the truth values say so, else those of the first.
    pub(super) fn c_select(&self, of: CVector) -> String {
        let truths = of.truths();
        self.vectors.borrow_mut().insert(truths);
        let value = self.c_each(of, |c| format!("t.{c} ? b.{c} : a.{c}"));
        let name = of.name();
        let parameters = format!("{name} a, {name} b, {} t", truths.name());
        self.c_helper(format!("{name}_select"), &name, &parameters, &value)
    }

    /// The same for whole numbers in GLSL, whose `mix` does not take them in the versions that we write for.
    pub(super) fn glsl_select(&self, of: CVector) -> String {
        let (name, truths) = (of.name(), of.truths().name());
        let helper = format!("{name}_select");
        let text = format!(
            "{name} {helper}({name} a, {name} b, {truths} t) {{\n    return a + (b - a) * {name}(t);\n}}\n"
        );
        self.helpers.borrow_mut().insert(helper.clone(), text);
        helper
    }

    /// A conversion of each component, or of its bits, by a function or a cast.
    pub(super) fn c_converted(&self, from: CVector, to: CVector, word: &str, by: &str) -> String {
        self.vectors.borrow_mut().insert(from);
        let value = self.c_each(to, |c| format!("{by}(v.{c})"));
        let name = to.name();
        let parameters = format!("{} v", from.name());
        self.c_helper(
            format!("{name}_{word}_{}", from.name()),
            &name,
            &parameters,
            &value,
        )
    }

    /// Some components of a vector as a vector, such as `vec4_xy`.
    pub(super) fn c_swizzle(&self, from: CVector, letters: &str) -> String {
        let to = CVector {
            size: letters.len(),
            ..from
        };
        let parts: Vec<String> = letters.chars().map(|c| format!("v.{c}")).collect();
        self.vectors.borrow_mut().extend([from, to]);
        let name = to.name();
        self.c_helper(
            format!("{}_{letters}", from.name()),
            &name,
            &format!("{} v", from.name()),
            &format!("({name}){{{}}}", parts.join(", ")),
        )
    }

    /// A vector of parts some of which are vectors.
    pub(super) fn c_joined(&self, of: CVector, sizes: &[usize]) -> String {
        let (mut parameters, mut parts) = (Vec::new(), Vec::new());
        let ty = of.name();
        let mut name = format!("{ty}_of");
        for (k, &size) in sizes.iter().enumerate() {
            name.push_str(&format!("_{size}"));
            let word = ["a", "b", "c", "d"][k.min(3)];
            if size == 1 {
                parameters.push(format!("{} {word}", of.scalar()));
                parts.push(word.to_owned());
            } else {
                let part = CVector { size, ..of };
                parameters.push(format!("{} {word}", part.name()));
                parts.extend(part.letters().iter().map(|c| format!("{word}.{c}")));
            }
        }
        self.c_helper(
            name,
            &ty,
            &parameters.join(", "),
            &format!("({ty}){{{}}}", parts.join(", ")),
        )
    }

    /// A function of vectors that gives a number or a vector.
    pub(super) fn c_vector_function(&self, of: CVector, word: &str) -> Option<String> {
        let sum = |part: &dyn Fn(&str) -> String| {
            let parts: Vec<String> = of.letters().iter().map(|c| part(c)).collect();
            parts.join(" + ")
        };
        let ty = of.name();
        let (result, parameters, value) = match (word, of.kind) {
            ("dot", "") => (
                "float",
                format!("{ty} a, {ty} b"),
                sum(&|c| format!("a.{c} * b.{c}")),
            ),
            ("length", "") => (
                "float",
                format!("{ty} v"),
                format!("sqrtf({})", sum(&|c| format!("v.{c} * v.{c}"))),
            ),
            ("abs", "") => (
                ty.as_str(),
                format!("{ty} v"),
                self.c_each(of, |c| format!("fabsf(v.{c})")),
            ),
            ("floor", "") => (
                ty.as_str(),
                format!("{ty} v"),
                self.c_each(of, |c| format!("floorf(v.{c})")),
            ),
            ("min" | "max", "") => (
                ty.as_str(),
                format!("{ty} a, {ty} b"),
                self.c_each(of, |c| format!("f{word}f(a.{c}, b.{c})")),
            ),
            ("min" | "max", "i" | "u") => {
                let sign = if word == "min" { "<" } else { ">" };
                (
                    ty.as_str(),
                    format!("{ty} a, {ty} b"),
                    self.c_each(of, |c| format!("a.{c} {sign} b.{c} ? a.{c} : b.{c}")),
                )
            }
            _ => return None,
        };
        Some(self.c_helper(format!("{ty}_{word}"), result, &parameters, &value))
    }
}
