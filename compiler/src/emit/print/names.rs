//! Names that a language accepts, each once.

use naga::{BinaryOperator, Expression, Function, Handle, Literal, Module};
use rustc_hash::FxHashSet;

use super::dialect::Dialect;
use super::plan::Plan;

/// Words that cannot be names in any of the languages that look like C: keywords, types and functions of GLSL, Godot's shading
/// language, HLSL, MSL and C, beside those of naga's list for WGSL.
const FOREIGN: &str = include_str!("reserved.txt");

/// Names that are taken.
#[derive(Clone, Debug)]
pub(super) struct Names {
    taken: FxHashSet<String>,
}

impl Names {
    pub(super) fn new(dialect: Dialect) -> Self {
        let mut taken: FxHashSet<String> = FxHashSet::default();
        let wgsl = naga::keywords::wgsl::RESERVED.iter();
        let built_in = naga::keywords::wgsl::BUILTIN_IDENTIFIERS.iter();
        if dialect == Dialect::Wgsl {
            taken.extend(wgsl.chain(built_in).map(|w| (*w).to_owned()));
            // short names of types, which a module may define anew, and which we write
            for size in 2..=4 {
                taken.extend(["f", "i", "u", "h"].map(|kind| format!("vec{size}{kind}")));
            }
        } else {
            let words = FOREIGN.lines().filter(|l| !l.starts_with('#'));
            taken.extend(words.flat_map(str::split_whitespace).map(str::to_owned));
        }
        taken.extend(super::helpers::NAMES.iter().map(|w| (*w).to_owned()));
        Self { taken }
    }

    /// A free name that is or begins with the one that is wanted.
    pub(super) fn fresh(&mut self, wanted: &str) -> String {
        let base = clean(wanted);
        let mut name = base.clone();
        let mut number = 2;
        while self.taken.contains(&name) {
            let gap = if base.ends_with(|c: char| c.is_ascii_digit()) {
                "_"
            } else {
                ""
            };
            name = format!("{base}{gap}{number}");
            number += 1;
        }
        self.taken.insert(name.clone());
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
        } if left == right => {
            let of = short(left)?;
            let gap = if of.ends_with(|c: char| c.is_ascii_digit()) {
                "_"
            } else {
                ""
            };
            format!("{of}{gap}2")
        }
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
                _ => word,
            }
        }
        Expression::CallResult(callee) => {
            let called = module.functions[callee].name.as_deref()?;
            let word = called
                .strip_prefix("real_")
                .or_else(|| called.strip_prefix("complex_"))
                .unwrap_or(called);
            let first = plan.survey.arguments.get(&handle)?.first();
            match first.and_then(|&a| short(a)) {
                Some(of) => format!("{word}_{of}"),
                None => word.to_owned(),
            }
        }
        _ => return None,
    };
    (name.len() <= LONGEST).then_some(name)
}
