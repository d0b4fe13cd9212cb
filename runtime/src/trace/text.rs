//! Operations of a shader, written as people write them.

use naga::valid::FunctionInfo;
use naga::{
    BinaryOperator, Expression, Function, Handle, Literal, Module, Statement, UnaryOperator,
};
use pullback_compiler::table::{self, Gpu};
use rustc_hash::FxHashMap;

/// Levels of operations that are written out; what lies deeper is `…`.
const DEPTH: usize = 3;

/// Writes the expressions of one function.
pub(super) struct Writer<'m> {
    module: &'m Module,
    function: &'m Function,
    info: &'m FunctionInfo,
    /// What the function was generated from; empty where it was not.
    source: &'m str,
    calls: FxHashMap<Handle<Expression>, &'m [Handle<Expression>]>,
}

impl<'m> Writer<'m> {
    pub(super) fn new(
        module: &'m Module,
        function: &'m Function,
        info: &'m FunctionInfo,
        source: &'m str,
    ) -> Self {
        let mut calls = FxHashMap::default();
        collect_calls(&function.body, &mut calls);
        Self {
            module,
            function,
            info,
            source,
            calls,
        }
    }

    /// What a call that gives this result is given.
    pub(super) fn arguments(&self, result: Handle<Expression>) -> &'m [Handle<Expression>] {
        self.calls.get(&result).copied().unwrap_or_default()
    }

    /// An operation with its operands; the name that its result may have is left out.
    pub(super) fn operation(&self, handle: Handle<Expression>) -> String {
        self.written(handle, DEPTH)
    }

    /// The name of an operand of an expression: the shader's, or the user's where the operand alone is computed for a name
    /// in the text.
    fn name(&self, of: Handle<Expression>, operand: Handle<Expression>) -> Option<&str> {
        if let Some(name) = self.function.named_expressions.get(&operand) {
            return Some(name);
        }
        let place = |handle| self.function.expressions.get_span(handle).to_range();
        let written = self.source.get(place(operand)?)?;
        let is_name = written.starts_with(char::is_alphabetic)
            && written
                .chars()
                .all(|c| c.is_alphanumeric() || matches!(c, '_' | '.'));
        (is_name && place(of) != place(operand)).then_some(written)
    }

    fn operand(&self, of: Handle<Expression>, operand: Handle<Expression>, depth: usize) -> String {
        match self.name(of, operand) {
            Some(name) => name.to_owned(),
            None => self.written(operand, depth),
        }
    }

    /// The same, in parentheses where it is an operator.
    fn factor(&self, of: Handle<Expression>, operand: Handle<Expression>, depth: usize) -> String {
        let text = self.operand(of, operand, depth);
        match self.function.expressions[operand] {
            Expression::Binary { .. } | Expression::Unary { .. }
                if depth > 0 && self.name(of, operand).is_none() =>
            {
                format!("({text})")
            }
            _ => text,
        }
    }

    fn list(&self, of: Handle<Expression>, all: &[Handle<Expression>], depth: usize) -> String {
        let all: Vec<String> = all.iter().map(|&h| self.operand(of, h, depth)).collect();
        all.join(", ")
    }

    fn written(&self, handle: Handle<Expression>, depth: usize) -> String {
        let expression = &self.function.expressions[handle];
        match *expression {
            Expression::Literal(literal) => return number(literal),
            Expression::Constant(constant) => {
                let constant = &self.module.constants[constant];
                return constant.name.clone().unwrap_or_else(|| "…".into());
            }
            Expression::ZeroValue(_) => return "0".into(),
            Expression::FunctionArgument(k) => {
                let argument = self.function.arguments.get(k as usize);
                return argument.and_then(|a| a.name.clone()).unwrap_or_default();
            }
            Expression::LocalVariable(variable) => {
                let name = self.function.local_variables[variable].name.clone();
                return name.unwrap_or_else(|| "…".into());
            }
            Expression::GlobalVariable(variable) => {
                let variable = &self.module.global_variables[variable];
                return variable.name.clone().unwrap_or_default();
            }
            Expression::Load { pointer } => return self.operand(handle, pointer, depth),
            _ => {}
        }
        let Some(depth) = depth.checked_sub(1) else {
            return "…".into();
        };
        match *expression {
            Expression::Binary { op, left, right } => format!(
                "{} {} {}",
                self.factor(handle, left, depth),
                sign(op),
                self.factor(handle, right, depth)
            ),
            Expression::Unary { op, expr } => {
                let sign = match op {
                    UnaryOperator::Negate => "-",
                    UnaryOperator::LogicalNot => "not ",
                    UnaryOperator::BitwiseNot => "~",
                };
                format!("{sign}{}", self.factor(handle, expr, depth))
            }
            Expression::Math {
                fun,
                arg,
                arg1,
                arg2,
                arg3,
            } => {
                let rest = [arg1, arg2, arg3].into_iter().flatten();
                let all: Vec<_> = std::iter::once(arg).chain(rest).collect();
                format!(
                    "{}({})",
                    camel(&format!("{fun:?}")),
                    self.list(handle, &all, depth)
                )
            }
            Expression::CallResult(function) => {
                let name = self.module.functions[function].name.as_deref();
                let name = called(name.unwrap_or_default());
                format!(
                    "{name}({})",
                    self.list(handle, self.arguments(handle), depth)
                )
            }
            Expression::Select {
                condition,
                accept,
                reject,
            } => format!(
                "if {} then {} else {}",
                self.operand(handle, condition, depth),
                self.operand(handle, accept, depth),
                self.operand(handle, reject, depth)
            ),
            Expression::AccessIndex { base, index } => {
                if let Some(text) = self.half(base, index, depth) {
                    return text;
                }
                format!(
                    "{}{}",
                    self.factor(handle, base, depth),
                    self.member(base, index)
                )
            }
            Expression::Access { base, index } => format!(
                "{}[{}]",
                self.factor(handle, base, depth),
                self.operand(handle, index, depth)
            ),
            Expression::Compose { ref components, .. } => {
                format!("({})", self.list(handle, components, depth))
            }
            Expression::Splat { value, .. } => self.operand(handle, value, depth),
            Expression::Swizzle {
                size,
                vector,
                pattern,
            } => {
                let letters = pattern.iter().take(size as usize);
                let letters: String = letters.map(|c| ['x', 'y', 'z', 'w'][*c as usize]).collect();
                format!("{}.{letters}", self.factor(handle, vector, depth))
            }
            Expression::As { expr, .. } => format!("number({})", self.operand(handle, expr, depth)),
            Expression::Relational { fun, argument } => {
                let name = camel(&format!("{fun:?}"));
                format!("{name}({})", self.operand(handle, argument, depth))
            }
            _ => "…".into(),
        }
    }

    /// One of two functions of one operand that are computed together.
    fn half(&self, base: Handle<Expression>, index: u32, depth: usize) -> Option<String> {
        let Expression::CallResult(function) = self.function.expressions[base] else {
            return None;
        };
        let name = self.module.functions[function].name.as_deref()?;
        let row = table::rows().iter().find(|row| {
            table::pair(row.prim).is_some_and(|pair| pair.gpu == name && pair.place == index)
        })?;
        let operand = self.list(base, self.arguments(base), depth);
        Some(format!("{}({operand})", row.sign()))
    }

    /// `.x`, `.name` or `[2]`.
    fn member(&self, base: Handle<Expression>, index: u32) -> String {
        let place = index as usize;
        let types = &self.module.types;
        let mut ty = self.info[base].ty.inner_with(types);
        if let naga::TypeInner::Pointer { base, .. } = *ty {
            ty = &types[base].inner;
        }
        if let naga::TypeInner::Struct { members, .. } = ty {
            let name = members.get(place).and_then(|m| m.name.as_deref());
            return format!(".{}", name.unwrap_or_default());
        }
        if let naga::TypeInner::Array { .. } = ty {
            return format!("[{index}]");
        }
        match ["x", "y", "z", "w"].get(place) {
            Some(letter) => format!(".{letter}"),
            None => format!("[{index}]"),
        }
    }
}

fn collect_calls<'m>(
    block: &'m naga::Block,
    calls: &mut FxHashMap<Handle<Expression>, &'m [Handle<Expression>]>,
) {
    let mut stack = vec![block];
    while let Some(block) = stack.pop() {
        for statement in block {
            match statement {
                Statement::Call {
                    arguments,
                    result: Some(result),
                    ..
                } => {
                    calls.insert(*result, arguments);
                }
                Statement::Block(inner) => stack.push(inner),
                Statement::If { accept, reject, .. } => stack.extend([accept, reject]),
                Statement::Switch { cases, .. } => stack.extend(cases.iter().map(|c| &c.body)),
                Statement::Loop {
                    body, continuing, ..
                } => stack.extend([body, continuing]),
                _ => {}
            }
        }
    }
}

/// A function of the shader library by the name of the language's operation that it computes, where there is one.
fn called(function: &str) -> &str {
    let fits = |row: &&table::Row| {
        row.gpu_complex == function
            || matches!(row.gpu, Gpu::Library(name, _) | Gpu::Family(name) if name == function)
    };
    table::rows()
        .iter()
        .filter(|row| !row.names.is_empty())
        .find(fits)
        .map_or(function, |row| row.sign())
}

fn number(literal: Literal) -> String {
    match literal {
        Literal::F32(x) => x.to_string(),
        Literal::F64(x) => x.to_string(),
        Literal::U32(x) => x.to_string(),
        Literal::I32(x) => x.to_string(),
        Literal::Bool(x) => x.to_string(),
        _ => "…".into(),
    }
}

fn sign(op: BinaryOperator) -> &'static str {
    match op {
        BinaryOperator::Add => "+",
        BinaryOperator::Subtract => "-",
        BinaryOperator::Multiply => "*",
        BinaryOperator::Divide => "/",
        BinaryOperator::Modulo => "%",
        BinaryOperator::Equal => "==",
        BinaryOperator::NotEqual => "!=",
        BinaryOperator::Less => "<",
        BinaryOperator::LessEqual => "<=",
        BinaryOperator::Greater => ">",
        BinaryOperator::GreaterEqual => ">=",
        BinaryOperator::And => "&",
        BinaryOperator::ExclusiveOr => "^",
        BinaryOperator::InclusiveOr => "|",
        BinaryOperator::LogicalAnd => "and",
        BinaryOperator::LogicalOr => "or",
        BinaryOperator::ShiftLeft => "<<",
        BinaryOperator::ShiftRight => ">>",
    }
}

/// `InverseSqrt` as WGSL writes it.
fn camel(name: &str) -> String {
    let mut letters = name.chars();
    match letters.next() {
        Some(first) => first.to_lowercase().chain(letters).collect(),
        None => String::new(),
    }
}
