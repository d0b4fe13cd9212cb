//! Which names are functions and which are values: what decides between a call and a product.

use std::collections::HashMap;

use crate::ast::{Method, SeriesKind};

/// Names that are values wherever they are not defined anew.
const VALUES: [&str; 15] = [
    "pi", "π", "tau", "τ", "phi", "φ", "e", "i", "∞", "inf", "nan", "time", "pixel", "true",
    "false",
];

/// Names of the operators of calculus; their first argument may be the bare name of a function.
const OPERATORS: [&str; 9] = [
    "diff",
    "grad",
    "div",
    "curl",
    "laplacian",
    "jacobian",
    "hessian",
    "mean_curvature",
    "gaussian_curvature",
];

/// A call whose brackets have a syntax of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    /// `sum(k in 1..n, term)`, `product(k in 1..n, term)`
    Series(SeriesKind),
    /// `iterate(n, z = z0, step until cond)`
    Iterate,
    /// `integral(expr, t, a, b)`, `integral(t in a..b, expr)`, and `quadrature` alike
    Integral(Method),
}

impl Form {
    fn of(name: &str) -> Option<Self> {
        Some(match name {
            "sum" => Self::Series(SeriesKind::Sum),
            "product" => Self::Series(SeriesKind::Product),
            "iterate" => Self::Iterate,
            "integral" => Self::Integral(Method::Closed),
            "quadrature" => Self::Integral(Method::Quadrature),
            _ => return None,
        })
    }

    /// The form that another name is often written for, where a range is among the arguments.
    pub(crate) fn meant_by(name: &str) -> Option<Self> {
        Some(match name {
            "Σ" | "Sum" => Self::Series(SeriesKind::Sum),
            "Π" | "Product" | "prod" => Self::Series(SeriesKind::Product),
            _ => return None,
        })
    }

    /// What stands in its brackets.
    pub(crate) fn example(self) -> &'static str {
        match self {
            Self::Series(_) => "k in 1..n, term",
            Self::Iterate => "n, z = start, step until condition",
            Self::Integral(_) => "expr, t, a, b",
        }
    }
}

/// Variables that a bare formula may use without defining them.
pub(crate) const FREE_VARIABLES: [&str; 4] = ["x", "y", "z", "p"];

/// What a name stands for at a place of the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Role {
    /// A parameter, a local, or a constant: `name(` is a product.
    Value,
    /// A builtin or a function of the file: `name(` is a call.
    Function,
    /// Not known here; `name(` is a call, so that the complaint can be about a function.
    Unknown,
}

/// What is known of a name at the place that is being read.
#[derive(Clone, Copy, Debug)]
struct Entry {
    /// What it is where the file says nothing of it.
    own: Role,
    is_function: bool,
    is_constant: bool,
    /// Parameters, locals and running variables of this name that hold.
    bound: u32,
}

impl Entry {
    fn role(&self) -> Role {
        if self.bound > 0 {
            Role::Value
        } else if self.is_function {
            Role::Function
        } else if self.is_constant {
            Role::Value
        } else {
            self.own
        }
    }
}

/// The names of the file and those bound at the place that is being read.
pub(crate) struct Scope<'a> {
    is_builtin: &'a dyn Fn(&str) -> bool,
    names: HashMap<&'a str, Entry>,
    /// The names of one letter, which most are in formulas, by their code.
    letters: [Option<Entry>; LETTERS],
}

/// Number of the codes of one byte.
const LETTERS: usize = 128;

/// The code of a name of one letter.
fn letter(name: &str) -> Option<usize> {
    match name.as_bytes() {
        &[letter] => Some(usize::from(letter)),
        _ => None,
    }
}

impl<'a> Scope<'a> {
    /// The names of a file, nothing bound.
    pub(crate) fn new(is_builtin: &'a dyn Fn(&str) -> bool) -> Self {
        Self {
            is_builtin,
            names: HashMap::new(),
            letters: [None; LETTERS],
        }
    }

    fn entry(&mut self, name: &'a str) -> &mut Entry {
        let name = in_letters(name);
        let is_builtin = self.is_builtin;
        let new = || Entry {
            own: own_role(is_builtin, name),
            is_function: false,
            is_constant: false,
            bound: 0,
        };
        match letter(name).and_then(|code| self.letters.get_mut(code)) {
            Some(entry) => entry.get_or_insert_with(new),
            None => self.names.entry(name).or_insert_with(new),
        }
    }

    /// What is known of a name, if it has been met.
    fn get(&self, name: &str) -> Option<&Entry> {
        let name = in_letters(name);
        match letter(name) {
            Some(code) => self.letters.get(code)?.as_ref(),
            None => self.names.get(name),
        }
    }

    /// Adds a function of the file.
    pub(crate) fn define_function(&mut self, name: &'a str) {
        self.entry(name).is_function = true;
    }

    /// Adds a constant or a `param` of the file.
    pub(crate) fn define_constant(&mut self, name: &'a str) {
        self.entry(name).is_constant = true;
    }

    /// A parameter or local begins to hold.
    pub(crate) fn bind(&mut self, name: &'a str) {
        self.entry(name).bound += 1;
    }

    /// A parameter or local ends to hold.
    pub(crate) fn unbind(&mut self, name: &str) {
        let name = in_letters(name);
        let entry = match letter(name) {
            Some(code) => self.letters.get_mut(code).and_then(Option::as_mut),
            None => self.names.get_mut(name),
        };
        if let Some(entry) = entry {
            entry.bound = entry.bound.saturating_sub(1);
        }
    }

    /// Whether the file defines a function of this name.
    pub(crate) fn defines_function(&self, name: &str) -> bool {
        let entry = self.get(name);
        entry.is_some_and(|entry| entry.is_function)
    }

    /// Whether the name is a builtin function, shadowed or not.
    pub(crate) fn is_builtin(&self, name: &str) -> bool {
        (self.is_builtin)(name)
    }

    /// Whether nothing of the file is called so here, so that the name means what it does in the language.
    pub(crate) fn is_free(&self, name: &str) -> bool {
        let entry = self.get(name);
        entry.is_none_or(|entry| entry.bound == 0 && !entry.is_function && !entry.is_constant)
    }

    /// What the name stands for here.
    pub(crate) fn role(&self, name: &str) -> Role {
        match self.get(name) {
            Some(entry) => entry.role(),
            None => own_role(self.is_builtin, in_letters(name)),
        }
    }

    /// What the name of the text stands for here, which is kept in mind.
    pub(crate) fn role_of_text(&mut self, name: &'a str) -> Role {
        self.entry(name).role()
    }

    /// The form that a call of this function is, if it is one.
    pub(crate) fn form(&self, callee: &str) -> Option<Form> {
        Form::of(in_letters(callee)).filter(|_| !self.defines_function(callee))
    }

    /// Whether the first argument of the call may be the bare name of a function.
    pub(crate) fn takes_function(&self, callee: &str) -> bool {
        OPERATORS.contains(&callee) && !self.defines_function(callee)
    }

    /// Whether `callee(f)(x, y)` is `callee(f, x, y)`.
    pub(crate) fn takes_point(&self, callee: &str) -> bool {
        self.takes_function(callee)
    }
}

/// The word for which a sign stands, so that whoever defines one of them hides both.
fn in_letters(name: &str) -> &str {
    match name {
        "∑" => "sum",
        "∏" => "product",
        _ => name,
    }
}

/// What a name stands for where nothing in the file is called so.
fn own_role(is_builtin: &dyn Fn(&str) -> bool, name: &str) -> Role {
    if is_builtin(name) || OPERATORS.contains(&name) || Form::of(name).is_some() {
        Role::Function
    } else if VALUES.contains(&name) {
        Role::Value
    } else {
        Role::Unknown
    }
}
