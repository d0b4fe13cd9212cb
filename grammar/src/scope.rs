//! Which names are functions and which are values: what decides between a call and a product.

use std::collections::{HashMap, HashSet};

use crate::ast::SeriesKind;

/// Names that are values wherever they are not defined anew.
const VALUES: [&str; 15] = [
    "pi", "π", "tau", "τ", "phi", "φ", "e", "i", "∞", "inf", "nan", "time", "pixel", "true",
    "false",
];

/// Names of the operators of calculus; their first argument may be the bare name of a function.
const OPERATORS: [&str; 10] = [
    "diff",
    "grad",
    "div",
    "curl",
    "laplacian",
    "jacobian",
    "hessian",
    "mean_curvature",
    "gaussian_curvature",
    "quadrature",
];

/// A call whose brackets have a syntax of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    /// `sum(k in 1..n, term)`, `product(k in 1..n, term)`
    Series(SeriesKind),
    /// `iterate(n, z = z0, step until cond)`
    Iterate,
    /// `integral(expr, t, a, b)`, `integral(t in a..b, expr)`
    Integral,
}

impl Form {
    fn of(name: &str) -> Option<Self> {
        Some(match name {
            "sum" | "∑" => Self::Series(SeriesKind::Sum),
            "product" | "∏" => Self::Series(SeriesKind::Product),
            "iterate" => Self::Iterate,
            "integral" => Self::Integral,
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
            Self::Integral => "expr, t, a, b",
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

/// The names of the file and those bound at the place that is being read.
pub(crate) struct Scope<'a> {
    is_builtin: &'a dyn Fn(&str) -> bool,
    functions: HashSet<&'a str>,
    constants: HashSet<&'a str>,
    bound: HashMap<&'a str, u32>,
}

impl<'a> Scope<'a> {
    /// The names of a file, nothing bound.
    pub(crate) fn new(is_builtin: &'a dyn Fn(&str) -> bool) -> Self {
        Self {
            is_builtin,
            functions: HashSet::new(),
            constants: HashSet::new(),
            bound: HashMap::new(),
        }
    }

    /// Adds a function of the file.
    pub(crate) fn define_function(&mut self, name: &'a str) {
        self.functions.insert(name);
    }

    /// Adds a constant or a `param` of the file.
    pub(crate) fn define_constant(&mut self, name: &'a str) {
        self.constants.insert(name);
    }

    /// A parameter or local begins to hold.
    pub(crate) fn bind(&mut self, name: &'a str) {
        *self.bound.entry(name).or_default() += 1;
    }

    /// A parameter or local ends to hold.
    pub(crate) fn unbind(&mut self, name: &str) {
        if let Some(count) = self.bound.get_mut(name) {
            *count = count.saturating_sub(1);
        }
    }

    /// Whether the file defines a function of this name.
    pub(crate) fn defines_function(&self, name: &str) -> bool {
        self.functions.contains(name)
    }

    /// Whether the name is a builtin function, shadowed or not.
    pub(crate) fn is_builtin(&self, name: &str) -> bool {
        (self.is_builtin)(name)
    }

    /// What the name stands for here.
    pub(crate) fn role(&self, name: &str) -> Role {
        if self.bound.get(name).is_some_and(|&count| count > 0) {
            Role::Value
        } else if self.functions.contains(name) {
            Role::Function
        } else if self.constants.contains(name) {
            Role::Value
        } else if (self.is_builtin)(name) || OPERATORS.contains(&name) || Form::of(name).is_some() {
            Role::Function
        } else if VALUES.contains(&name) {
            Role::Value
        } else {
            Role::Unknown
        }
    }

    /// The form that a call of this function is, if it is one.
    pub(crate) fn form(&self, callee: &str) -> Option<Form> {
        Form::of(callee).filter(|_| !self.functions.contains(callee))
    }

    /// Whether the first argument of the call may be the bare name of a function.
    pub(crate) fn takes_function(&self, callee: &str) -> bool {
        OPERATORS.contains(&callee) && !self.functions.contains(callee)
    }

    /// Whether `callee(f)(x, y)` is `callee(f, x, y)`.
    pub(crate) fn takes_point(&self, callee: &str) -> bool {
        callee != "quadrature" && self.takes_function(callee)
    }
}
