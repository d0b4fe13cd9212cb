//! The constructs of naga that a module holds, as words: what an executor of modules must know.

use std::collections::BTreeSet;

use naga::valid::ModuleInfo;
use naga::{
    AddressSpace, Block, Expression, Function, Handle, Literal, Module, Scalar, ScalarKind,
    Statement, TypeInner,
};

/// Every construct of a module, such as `Binary Add f32`.
#[must_use]
pub fn constructs(module: &Module, info: &ModuleInfo) -> BTreeSet<String> {
    let mut scan = Scan {
        module,
        found: BTreeSet::new(),
    };
    for (handle, function) in module.functions.iter() {
        scan.function(function, &info[handle]);
    }
    for (place, entry) in module.entry_points.iter().enumerate() {
        scan.function(&entry.function, info.get_entry_point(place));
    }
    scan.found
}

struct Scan<'m> {
    module: &'m Module,
    found: BTreeSet<String>,
}

impl Scan<'_> {
    fn add(&mut self, words: impl Into<String>) {
        self.found.insert(words.into());
    }

    fn function(&mut self, function: &Function, info: &naga::valid::FunctionInfo) {
        let inner = |handle: Handle<Expression>| info[handle].ty.inner_with(&self.module.types);
        let kind = |handle: Handle<Expression>| {
            let inner = inner(handle);
            inner
                .scalar()
                .map_or_else(|| shape(inner).to_owned(), |s| word(s).to_owned())
        };
        let pointed = |handle: Handle<Expression>| match inner(handle) {
            TypeInner::Pointer { .. } | TypeInner::ValuePointer { .. } => "of a variable",
            _ => "of a value",
        };
        let mut words = Vec::new();
        for (handle, expression) in function.expressions.iter() {
            words.push(match expression {
                Expression::Literal(literal) => format!("Literal {}", literal_word(*literal)),
                Expression::Compose { .. } => format!("Compose {}", shape(inner(handle))),
                Expression::Access { base, .. } => format!("Access {}", pointed(*base)),
                Expression::AccessIndex { base, .. } => format!("AccessIndex {}", pointed(*base)),
                Expression::GlobalVariable(variable) => {
                    let space = self.module.global_variables[*variable].space;
                    format!("GlobalVariable {}", space_word(space))
                }
                Expression::Unary { op, expr } => format!("Unary {op:?} {}", kind(*expr)),
                Expression::Binary { op, left, right } => {
                    let mixed = shape(inner(*left)) != shape(inner(*right));
                    let mixed = if mixed { " mixed" } else { "" };
                    format!("Binary {op:?} {}{mixed}", kind(*left))
                }
                Expression::Select { condition, .. } => {
                    format!("Select by a {}", shape(inner(*condition)))
                }
                Expression::Relational { fun, .. } => format!("Relational {fun:?}"),
                Expression::Math { fun, arg, .. } => format!("Math {fun:?} {}", kind(*arg)),
                Expression::As {
                    expr,
                    kind: to,
                    convert,
                } => {
                    let from = inner(*expr).scalar().unwrap_or(Scalar::F32);
                    let how = if convert.is_some() {
                        "converts"
                    } else {
                        "bits"
                    };
                    let width = convert.unwrap_or(from.width);
                    let to = word(Scalar { kind: *to, width });
                    format!("As {} to {to}, {how}", word(from))
                }
                other => {
                    let text = format!("{other:?}");
                    let end = text
                        .find(|c: char| !c.is_alphanumeric())
                        .unwrap_or(text.len());
                    text[..end].to_owned()
                }
            });
        }
        for words in words {
            self.add(words);
        }
        self.block(&function.body, function, true, "");
    }

    fn block(&mut self, block: &Block, function: &Function, outermost: bool, within: &'static str) {
        for (k, statement) in block.iter().enumerate() {
            let last = outermost && k + 1 == block.len();
            match statement {
                Statement::Emit(_) => {}
                Statement::Block(inner) => {
                    self.add("Block");
                    self.block(inner, function, false, within);
                }
                Statement::If { accept, reject, .. } => {
                    self.add(if reject.is_empty() {
                        "If"
                    } else {
                        "If with else"
                    });
                    self.block(accept, function, false, within);
                    self.block(reject, function, false, within);
                }
                Statement::Switch { cases, .. } => {
                    self.add("Switch");
                    for case in cases {
                        if case.fall_through {
                            self.add("Switch with shared cases");
                        }
                        self.block(&case.body, function, false, "a switch");
                    }
                }
                Statement::Loop {
                    body,
                    continuing,
                    break_if,
                } => {
                    self.add("Loop");
                    if !continuing.is_empty() {
                        self.add("Loop with continuing");
                    }
                    if break_if.is_some() {
                        self.add("Loop with break if");
                    }
                    self.block(body, function, false, "a loop");
                    self.block(continuing, function, false, "a loop");
                }
                Statement::Break => self.add(format!("Break of {within}")),
                Statement::Return { value } => {
                    let what = if value.is_some() {
                        "a value"
                    } else {
                        "nothing"
                    };
                    let place = if last { "at the end" } else { "early" };
                    self.add(format!("Return {what} {place}"));
                }
                Statement::Call { result, .. } => self.add(if result.is_some() {
                    "Call"
                } else {
                    "Call without result"
                }),
                Statement::Store { pointer, .. } => {
                    let whole = matches!(
                        function.expressions[*pointer],
                        Expression::LocalVariable(_) | Expression::GlobalVariable(_)
                    );
                    self.add(if whole { "Store" } else { "Store to a part" });
                }
                other => {
                    let text = format!("{other:?}");
                    let end = text
                        .find(|c: char| !c.is_alphanumeric())
                        .unwrap_or(text.len());
                    self.add(&text[..end]);
                }
            }
        }
    }
}

fn word(scalar: Scalar) -> &'static str {
    match (scalar.kind, scalar.width) {
        (ScalarKind::Bool, _) => "bool",
        (ScalarKind::Sint, 4) => "i32",
        (ScalarKind::Uint, 4) => "u32",
        (ScalarKind::Float, 4) => "f32",
        (ScalarKind::Sint, _) => "i64",
        (ScalarKind::Uint, _) => "u64",
        (ScalarKind::Float, _) => "f64",
        _ => "an abstract number",
    }
}

fn shape(inner: &TypeInner) -> &'static str {
    match inner {
        TypeInner::Scalar(_) => "scalar",
        TypeInner::Vector { .. } => "vector",
        TypeInner::Matrix { .. } => "matrix",
        TypeInner::Array { .. } => "array",
        TypeInner::Struct { .. } => "structure",
        _ => "pointer",
    }
}

fn literal_word(literal: Literal) -> &'static str {
    match literal {
        Literal::F64(_) => "f64",
        Literal::F32(_) => "f32",
        Literal::U32(_) => "u32",
        Literal::I32(_) => "i32",
        Literal::U64(_) => "u64",
        Literal::I64(_) => "i64",
        Literal::Bool(_) => "bool",
        _ => "an abstract number",
    }
}

fn space_word(space: AddressSpace) -> &'static str {
    match space {
        AddressSpace::Uniform => "uniform",
        AddressSpace::Storage { .. } => "storage",
        _ => "of another space",
    }
}
