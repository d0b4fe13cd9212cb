//! Names that a language accepts, each once.

use std::sync::{Arc, OnceLock};

use naga::{BinaryOperator, Expression, Function, Handle, Literal, Module};
use rustc_hash::{FxHashMap, FxHashSet};

use super::dialect::Dialect;
use super::plan::Plan;

/// Words that cannot be names in any of the languages that look like C: keywords, types and functions of GLSL, Godot's shading
/// language, HLSL, MSL and C, beside those of naga's list for WGSL.
const FOREIGN: &str = include_str!("reserved.txt");

/// Names that are taken in a scope.
#[derive(Debug)]
pub(super) struct Names {
    /// Words of the language, and names of helpers.
    reserved: &'static FxHashSet<String>,
    /// Of the scopes around this one.
    around: Vec<Arc<FxHashSet<String>>>,
    own: Arc<FxHashSet<String>>,
    /// The number that was last put behind a name.
    numbers: FxHashMap<String, u32>,
}

/// What no name may be.
fn reserved(dialect: Dialect) -> &'static FxHashSet<String> {
    static WGSL: OnceLock<FxHashSet<String>> = OnceLock::new();
    static OTHERS: OnceLock<FxHashSet<String>> = OnceLock::new();
    let helpers = || super::helpers::NAMES.iter().map(|w| (*w).to_owned());
    if dialect == Dialect::Wgsl {
        return WGSL.get_or_init(|| {
            let words = naga::keywords::wgsl::RESERVED.iter();
            let built_in = naga::keywords::wgsl::BUILTIN_IDENTIFIERS.iter();
            // short names of types, which a module may define anew, and which we write
            let types = (2..=4)
                .flat_map(|size| ["f", "i", "u", "h"].map(|kind| format!("vec{size}{kind}")));
            let words = words.chain(built_in).map(|w| (*w).to_owned());
            words.chain(types).chain(helpers()).collect()
        });
    }
    OTHERS.get_or_init(|| {
        let lines = FOREIGN.lines().filter(|l| !l.starts_with('#'));
        let words = lines.flat_map(str::split_whitespace).map(str::to_owned);
        words.chain(helpers()).collect()
    })
}

impl Names {
    pub(super) fn new(dialect: Dialect) -> Self {
        Self {
            reserved: reserved(dialect),
            around: Vec::new(),
            own: Arc::default(),
            numbers: FxHashMap::default(),
        }
    }

    /// A scope within this one.
    pub(super) fn inside(&self) -> Self {
        let mut around = self.around.clone();
        around.push(Arc::clone(&self.own));
        Self {
            reserved: self.reserved,
            around,
            own: Arc::default(),
            numbers: FxHashMap::default(),
        }
    }

    fn is_taken(&self, name: &str) -> bool {
        let around = || self.around.iter().any(|scope| scope.contains(name));
        self.reserved.contains(name) || self.own.contains(name) || around()
    }

    /// A free name that is or begins with the one that is wanted.
    pub(super) fn fresh(&mut self, wanted: &str) -> String {
        let base = clean(wanted);
        let mut name = base.clone();
        if self.is_taken(&name) {
            let gap = if base.ends_with(|c: char| c.is_ascii_digit()) {
                "_"
            } else {
                ""
            };
            let mut number = self.numbers.get(&base).map_or(2, |last| last + 1);
            name = format!("{base}{gap}{number}");
            while self.is_taken(&name) {
                number += 1;
                name = format!("{base}{gap}{number}");
            }
            self.numbers.insert(base, number);
        }
        Arc::make_mut(&mut self.own).insert(name.clone());
        name
    }
}

/// The name in letters that every language has, not beginning or ending with what is kept for compilers.
fn clean(wanted: &str) -> String {
    let latin = crate::lower::identifier(wanted);
    let mut out = String::new();
    for c in latin.chars() {
        // two underscores in a row belong to the implementation
        match c {
            '_' if out.ends_with('_') => {}
            c if c.is_ascii_alphanumeric() || c == '_' => out.push(c),
            _ => out.push('u'),
        }
    }
    let trimmed = out.trim_matches('_');
    let begins_well = trimmed.starts_with(|c: char| c.is_ascii_alphabetic());
    let kept = ["gl_", "GL_"].iter().all(|p| !trimmed.starts_with(p));
    match (begins_well, kept) {
        (true, true) => trimmed.to_owned(),
        _ => format!(
            "v_{}",
            trimmed.trim_start_matches(['g', 'l', 'G', 'L', '_'])
        ),
    }
}

/// The name of a square.
fn squared(of: &str) -> String {
    let gap = if of.ends_with(|c: char| c.is_ascii_digit()) {
        "_"
    } else {
        ""
    };
    format!("{of}{gap}2")
}

/// What a function gives, where its own name would be one of the language with a number behind it, as in `sqrt2`.
fn noun(function: &str) -> &str {
    match function {
        "sqrt" => "root",
        "exp" => "exponential",
        "log" => "logarithm",
        "sin" => "sine",
        "cos" => "cosine",
        "floor" => "whole",
        "max" => "larger",
        "min" => "smaller",
        "clamp" => "clamped",
        "abs" => "size",
        "fma" => "sum",
        "mul" => "product",
        "div" => "quotient",
        "hypot" | "hypot3" => "norm",
        other => other,
    }
}

/// A name for a value that the user gave none: after what it is, where that is short.
pub(super) fn described(
    module: &Module,
    function: &Function,
    plan: &Plan,
    names: &[Option<String>],
    is_vector: &dyn Fn(Handle<Expression>) -> bool,
    handle: Handle<Expression>,
) -> Option<String> {
    const LONGEST: usize = 16;
    let short = |of: Handle<Expression>| -> Option<String> {
        let name = match function.expressions[of] {
            Expression::FunctionArgument(k) => names
                .get(of.index())
                .cloned()
                .flatten()
                .or_else(|| function.arguments.get(k as usize)?.name.clone()),
            Expression::AccessIndex { base, index } if index < 4 && is_vector(base) => {
                let base = names.get(base.index())?.clone()?;
                Some(format!("{base}_{}", ["x", "y", "z", "w"][index as usize]))
            }
            _ if plan.named[of.index()] => names.get(of.index())?.clone(),
            Expression::Load { pointer } => names.get(pointer.index())?.clone(),
            _ => None,
        }?;
        (name.len() <= LONGEST / 2).then_some(name)
    };
    let name = match function.expressions[handle] {
        Expression::Binary {
            op: BinaryOperator::Multiply,
            left,
            right,
        } if left == right => squared(&short(left)?),
        Expression::Binary {
            op: BinaryOperator::Multiply,
            left,
            right,
        } => match (&function.expressions[left], short(left), short(right)) {
            (Expression::Literal(Literal::F32(2.0)), _, Some(of)) => format!("two_{of}"),
            (_, Some(a), Some(b)) => format!("{a}_{b}"),
            _ => return None,
        },
        Expression::Binary {
            op: BinaryOperator::Divide,
            left,
            right,
        } => match (&function.expressions[left], short(left), short(right)) {
            (Expression::Literal(Literal::F32(1.0)), _, Some(of)) => format!("inv_{of}"),
            (_, Some(a), Some(b)) => format!("{a}_per_{b}"),
            _ => return None,
        },
        Expression::Math { fun, arg, arg1, .. } => {
            let word = format!("{fun:?}").to_lowercase();
            match (arg1, short(arg)) {
                (None, Some(of)) => format!("{word}_{of}"),
                _ => noun(&word).to_owned(),
            }
        }
        Expression::CallResult(callee) => {
            let called = module.functions[callee].name.as_deref()?;
            let word = called
                .strip_prefix("real_")
                .or_else(|| called.strip_prefix("complex_"))
                .unwrap_or(called);
            let arguments = plan.survey.arguments.get(&handle)?;
            let of = |k: usize| arguments.get(k).and_then(|&a| short(a));
            match (word, of(0), of(1)) {
                ("mul", Some(a), Some(b)) => format!("{a}_{b}"),
                ("div", Some(a), Some(b)) => format!("{a}_per_{b}"),
                ("square", Some(a), _) => squared(&a),
                ("mul" | "div", ..) => noun(word).to_owned(),
                (_, Some(of), _) => format!("{word}_{of}"),
                _ => noun(word).to_owned(),
            }
        }
        _ => return None,
    };
    (name.len() <= LONGEST).then_some(name)
}
