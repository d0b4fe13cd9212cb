//! Whether two naga modules compute the same by the same operations in the same order of effects, up to names.
//!
//! Each function becomes a list of what it does, in which values are numbers of a table that both modules share: equal operations
//! on equal operands are one value, wherever they are written. What a parser leaves no trace of is left out of account: blocks
//! within blocks, `if !a` for `if a` with its branches exchanged, a constant first value that is set by a statement, and a number
//! beside a vector.

use std::collections::HashMap;

use naga::valid::{FunctionInfo, ModuleInfo};
use naga::{
    BinaryOperator, Block, Expression, Function, Handle, Literal, LocalVariable, Module, Statement,
    SwitchValue, Type, TypeInner, UnaryOperator,
};

/// A module with what validation found out about it, and the names of its functions.
pub struct Side<'m> {
    /// The module.
    pub module: &'m Module,
    /// What is known of it.
    pub info: &'m ModuleInfo,
    /// What each function is called.
    pub name: &'m dyn Fn(Handle<Function>) -> String,
}

/// Values that both sides share.
#[derive(Debug, Default)]
pub struct Values {
    table: HashMap<String, usize>,
}

impl Values {
    fn of(&mut self, key: String) -> usize {
        let next = self.table.len();
        *self.table.entry(key).or_insert(next)
    }
}

/// What a function does, one line for each effect.
#[must_use]
pub fn trace(side: &Side<'_>, handle: Handle<Function>, values: &mut Values) -> Vec<String> {
    let function = &side.module.functions[handle];
    let mut out = Tracer {
        side,
        function,
        info: &side.info[handle],
        values,
        known: HashMap::new(),
        variables: HashMap::new(),
        epochs: HashMap::new(),
        loaded: HashMap::new(),
        starts: starts(function),
        lines: Vec::new(),
    };
    let arguments = function.arguments.iter();
    let types: Vec<String> = arguments.map(|a| ty(side.module, a.ty)).collect();
    let result = function.result.as_ref().map(|r| ty(side.module, r.ty));
    out.lines.push(format!("({}) {result:?}", types.join(", ")));
    out.declare();
    out.block(&function.body);
    out.lines
}

/// A type without names.
fn ty(module: &Module, handle: Handle<Type>) -> String {
    inner(module, &module.types[handle].inner)
}

fn inner(module: &Module, of: &TypeInner) -> String {
    match of {
        TypeInner::Scalar(scalar) => format!("{:?}{}", scalar.kind, scalar.width),
        TypeInner::Vector { size, scalar } => {
            format!("{:?}{}x{}", scalar.kind, scalar.width, *size as u8)
        }
        TypeInner::Struct { members, .. } => {
            let members: Vec<String> = members.iter().map(|m| ty(module, m.ty)).collect();
            format!("{{{}}}", members.join(" "))
        }
        TypeInner::Array { base, size, .. } => format!("[{} {size:?}]", ty(module, *base)),
        TypeInner::Pointer { base, .. } => format!("*{}", ty(module, *base)),
        other => format!("{other:?}"),
    }
}

struct Tracer<'a, 'm> {
    side: &'a Side<'m>,
    function: &'a Function,
    info: &'a FunctionInfo,
    values: &'a mut Values,
    known: HashMap<Handle<Expression>, usize>,
    variables: HashMap<Handle<LocalVariable>, usize>,
    epochs: HashMap<Handle<LocalVariable>, usize>,
    /// The epoch in which each load was done.
    loaded: HashMap<Handle<Expression>, Option<usize>>,
    /// Statements that give a variable its constant first value, by their addresses.
    starts: Vec<usize>,
    lines: Vec<String>,
}

impl Tracer<'_, '_> {
    fn value(&mut self, handle: Handle<Expression>) -> usize {
        if let Some(&known) = self.known.get(&handle) {
            return known;
        }
        let value = match self.constant(handle) {
            Some(value) => value,
            None => {
                let key = self.key(handle);
                self.values.of(key)
            }
        };
        self.known.insert(handle, value);
        value
    }

    /// The value of what is written as a constant, in whatever form.
    fn constant(&mut self, handle: Handle<Expression>) -> Option<usize> {
        Some(match self.function.expressions[handle] {
            Expression::Literal(literal) => self.literal(literal),
            Expression::Constant(constant) => {
                let init = self.side.module.constants[constant].init;
                self.global(init)
            }
            Expression::ZeroValue(of) => self.zero(of),
            Expression::Unary {
                op: UnaryOperator::Negate,
                expr,
            } => match self.function.expressions[expr] {
                Expression::Literal(Literal::F32(x)) => self.literal(Literal::F32(-x)),
                _ => return None,
            },
            _ => return None,
        })
    }

    fn list(&mut self, handles: &[Handle<Expression>]) -> String {
        let all: Vec<String> = handles.iter().map(|&h| self.value(h).to_string()).collect();
        all.join(" ")
    }

    fn size(&self, handle: Handle<Expression>) -> usize {
        match self.info[handle].ty.inner_with(&self.side.module.types) {
            TypeInner::Vector { size, .. } => *size as usize,
            _ => 1,
        }
    }

    fn literal(&mut self, literal: Literal) -> usize {
        let key = match literal {
            Literal::F32(x) => format!("f32 {:#x}", x.to_bits()),
            other => format!("{other:?}"),
        };
        self.values.of(key)
    }

    fn zero(&mut self, handle: Handle<Type>) -> usize {
        let module = self.side.module;
        match &module.types[handle].inner {
            TypeInner::Scalar(scalar) => match Literal::zero(*scalar) {
                Some(literal) => self.literal(literal),
                None => self.values.of("zero".to_owned()),
            },
            TypeInner::Vector { size, scalar } => {
                let zero = Literal::zero(*scalar).map_or(0, |l| self.literal(l));
                let parts = vec![zero.to_string(); *size as usize];
                let key = format!("compose {} {}", ty(module, handle), parts.join(" "));
                self.values.of(key)
            }
            _ => self.values.of(format!("zero {}", ty(module, handle))),
        }
    }

    fn global(&mut self, handle: Handle<Expression>) -> usize {
        let module = self.side.module;
        match &module.global_expressions[handle] {
            Expression::Literal(literal) => self.literal(*literal),
            Expression::ZeroValue(ty) => self.zero(*ty),
            Expression::Constant(constant) => self.global(module.constants[*constant].init),
            Expression::Compose { ty: of, components } => {
                let parts: Vec<String> = components
                    .iter()
                    .map(|&c| self.global(c).to_string())
                    .collect();
                self.values
                    .of(format!("compose {} {}", ty(module, *of), parts.join(" ")))
            }
            other => self.values.of(format!("{other:?}")),
        }
    }

    fn splat(&mut self, of: &str, size: usize, value: usize) -> String {
        let parts = vec![value.to_string(); size];
        format!("compose {of} {}", parts.join(" "))
    }

    fn key(&mut self, handle: Handle<Expression>) -> String {
        let module = self.side.module;
        match self.function.expressions[handle].clone() {
            Expression::Compose { ty: of, components } => {
                format!("compose {} {}", ty(module, of), self.list(&components))
            }
            Expression::Splat { size, value } => {
                let value = self.value(value);
                let of = inner(module, self.info[handle].ty.inner_with(&module.types));
                self.splat(&of, size as usize, value)
            }
            Expression::Access { base, index } => format!("access {}", self.list(&[base, index])),
            Expression::AccessIndex { base, index } => match self.function.expressions[base] {
                // a part of what was read is what is read of a part
                Expression::Load { pointer } => {
                    let read = self.value(base);
                    let part = format!("part {index} {}", self.value(pointer));
                    let part = self.values.of(part);
                    let epoch = self.loaded.get(&base).copied().flatten();
                    match self.loaded.contains_key(&base) {
                        true => format!("load {epoch:?} {part}"),
                        false => format!("part {index} {read}"),
                    }
                }
                _ => format!("part {index} {}", self.value(base)),
            },
            Expression::Swizzle {
                size,
                vector,
                pattern,
            } => {
                let pattern = &pattern[..size as usize];
                format!("swizzle {pattern:?} {}", self.value(vector))
            }
            Expression::FunctionArgument(k) => format!("argument {k}"),
            Expression::GlobalVariable(global) => {
                let global = &module.global_variables[global];
                format!("global {:?} {}", global.binding, ty(module, global.ty))
            }
            Expression::LocalVariable(variable) => format!("variable {}", self.variable(variable)),
            Expression::Load { pointer } => {
                let epoch = variable_of(self.function, pointer)
                    .and_then(|v| self.epochs.get(&v))
                    .copied();
                self.loaded.insert(handle, epoch);
                format!("load {epoch:?} {}", self.value(pointer))
            }
            Expression::Unary { op, expr } => format!("{op:?} {}", self.value(expr)),
            Expression::Binary { op, left, right } => self.binary(op, left, right),
            Expression::Select {
                condition,
                accept,
                reject,
            } => format!("select {}", self.list(&[condition, accept, reject])),
            Expression::Relational { fun, argument } => {
                format!("{fun:?} {}", self.value(argument))
            }
            Expression::Math {
                fun,
                arg,
                arg1,
                arg2,
                arg3,
            } => {
                let all: Vec<_> = [Some(arg), arg1, arg2, arg3]
                    .into_iter()
                    .flatten()
                    .collect();
                format!("{fun:?} {}", self.list(&all))
            }
            Expression::As {
                expr,
                kind,
                convert,
            } => format!("as {kind:?} {convert:?} {}", self.value(expr)),
            Expression::CallResult(_) => "a result before its call".to_owned(),
            other => format!("{other:?}"),
        }
    }

    fn binary(
        &mut self,
        op: BinaryOperator,
        left: Handle<Expression>,
        right: Handle<Expression>,
    ) -> String {
        let module = self.side.module;
        let sizes = [self.size(left), self.size(right)];
        let mut values = [self.value(left), self.value(right)];
        for k in 0..2 {
            if sizes[k] == 1 && sizes[1 - k] > 1 {
                let vector = [left, right][1 - k];
                let of = inner(module, self.info[vector].ty.inner_with(&module.types));
                let key = self.splat(&of, sizes[1 - k], values[k]);
                values[k] = self.values.of(key);
            }
        }
        format!("{op:?} {} {}", values[0], values[1])
    }

    /// Numbers the variables in the order in which they are changed, and tells their first values. The order in which they are
    /// read depends on where values are written out.
    fn declare(&mut self) {
        let function = self.function;
        let mut order: Vec<Handle<LocalVariable>> = Vec::new();
        let mut first: HashMap<Handle<LocalVariable>, Handle<Expression>> = HashMap::new();
        walk(&function.body, &mut Vec::new(), &mut |statement, _| {
            let Statement::Store { pointer, value } = statement else {
                return;
            };
            let Some(variable) = variable_of(function, *pointer) else {
                return;
            };
            if self.starts.contains(&std::ptr::from_ref(statement).addr()) {
                first.insert(variable, *value);
            } else if !order.contains(&variable) {
                order.push(variable);
            }
        });
        for variable in order {
            let number = self.variables.len();
            self.variables.insert(variable, number);
            self.epochs.insert(variable, 0);
            let local = &function.local_variables[variable];
            let start = local.init.or(first.get(&variable).copied());
            let start = start.map(|init| self.value(init));
            let of = ty(self.side.module, local.ty);
            self.lines.push(format!("var {number}: {of} = {start:?}"));
        }
    }

    /// The number of a variable; one that nothing changes is its first value.
    fn variable(&mut self, variable: Handle<LocalVariable>) -> String {
        if let Some(&known) = self.variables.get(&variable) {
            return known.to_string();
        }
        let local = &self.function.local_variables[variable];
        let start = local.init.map(|init| self.value(init));
        format!("constant {start:?}")
    }

    fn changed(&mut self, variable: Handle<LocalVariable>) {
        *self.epochs.entry(variable).or_insert(0) += 1;
    }

    fn block(&mut self, block: &Block) {
        for statement in block {
            self.statement(statement);
        }
    }

    fn statement(&mut self, statement: &Statement) {
        match statement {
            Statement::Emit(range) => {
                for handle in range.clone() {
                    // what nothing uses is not printed
                    if self.info[handle].ref_count > 0 {
                        self.value(handle);
                    }
                }
            }
            Statement::Call {
                function,
                arguments,
                result,
            } => {
                let key = format!(
                    "call {} {}",
                    (self.side.name)(*function),
                    self.list(arguments)
                );
                let value = self.values.of(key);
                match result {
                    Some(result) => {
                        self.known.insert(*result, value);
                    }
                    None => self.lines.push(format!("do {value}")),
                }
            }
            Statement::Block(inner) => self.block(inner),
            Statement::If {
                condition,
                accept,
                reject,
            } => self.branch(*condition, accept, reject),
            Statement::Switch { selector, cases } => {
                let selector = self.value(*selector);
                self.lines.push(format!("switch {selector}"));
                for case in cases {
                    let value = match case.value {
                        SwitchValue::I32(x) => format!("{x}i"),
                        SwitchValue::U32(x) => format!("{x}u"),
                        SwitchValue::Default => "default".to_owned(),
                    };
                    self.lines
                        .push(format!("case {value} {}", case.fall_through));
                    self.block(&case.body);
                }
                self.lines.push("end".to_owned());
            }
            Statement::Loop {
                body,
                continuing,
                break_if,
            } => {
                let stored = stored_in(self.function, body, continuing);
                self.lines.push("loop".to_owned());
                stored.iter().for_each(|&v| self.changed(v));
                self.block(body);
                self.lines.push("continuing".to_owned());
                self.block(continuing);
                if let Some(condition) = break_if {
                    let condition = self.value(*condition);
                    self.lines.push(format!("break if {condition}"));
                }
                self.lines.push("end".to_owned());
                stored.iter().for_each(|&v| self.changed(v));
            }
            Statement::Store { pointer, value } => self.store(statement, *pointer, *value),
            Statement::Return { value } => {
                let value = value.map(|v| self.value(v));
                self.lines.push(format!("return {value:?}"));
            }
            other => self.lines.push(format!("{other:?}")),
        }
    }

    fn branch(&mut self, condition: Handle<Expression>, accept: &Block, reject: &Block) {
        let mut branches = [accept, reject];
        let mut condition = condition;
        while let Expression::Unary {
            op: UnaryOperator::LogicalNot,
            expr,
        } = self.function.expressions[condition]
        {
            condition = expr;
            branches.reverse();
        }
        let condition = self.value(condition);
        self.lines.push(format!("if {condition}"));
        let before = self.lines.len();
        self.block(branches[0]);
        self.lines.push("else".to_owned());
        self.block(branches[1]);
        self.lines.push("end".to_owned());
        if self.lines.len() == before + 2 {
            // no branch does anything
            self.lines.truncate(before - 1);
        }
    }

    fn store(
        &mut self,
        statement: &Statement,
        pointer: Handle<Expression>,
        value: Handle<Expression>,
    ) {
        let variable = variable_of(self.function, pointer);
        if let (Some(variable), true) = (
            variable,
            self.starts.contains(&std::ptr::from_ref(statement).addr()),
        ) {
            // told with the variable; what nothing else changes is known by it
            if !self.variables.contains_key(&variable) {
                let start = Some(self.value(value));
                let key = format!("variable constant {start:?}");
                let number = self.values.of(key);
                self.known.insert(pointer, number);
            }
            return;
        }
        let value = self.value(value);
        let place = self.value(pointer);
        self.lines.push(format!("{place} = {value}"));
        if let Some(variable) = variable {
            self.changed(variable);
        }
    }
}

fn variable_of(
    function: &Function,
    mut pointer: Handle<Expression>,
) -> Option<Handle<LocalVariable>> {
    loop {
        match function.expressions[pointer] {
            Expression::LocalVariable(variable) => return Some(variable),
            Expression::Access { base, .. } | Expression::AccessIndex { base, .. } => {
                pointer = base
            }
            _ => return None,
        }
    }
}

fn walk<'b>(block: &'b Block, path: &mut Vec<usize>, see: &mut dyn FnMut(&'b Statement, &[usize])) {
    for statement in block {
        see(statement, path);
        let inner: Vec<(&Block, bool)> = match statement {
            Statement::Block(inner) => {
                walk(inner, path, see);
                continue;
            }
            Statement::If { accept, reject, .. } => vec![(accept, false), (reject, false)],
            Statement::Switch { cases, .. } => cases.iter().map(|c| (&c.body, false)).collect(),
            Statement::Loop {
                body, continuing, ..
            } => vec![(body, true), (continuing, true)],
            _ => continue,
        };
        for (block, is_loop) in inner {
            // odd numbers are loops
            path.push(2 * std::ptr::from_ref(block).addr() + usize::from(is_loop));
            walk(block, path, see);
            path.pop();
        }
    }
}

/// Where a variable is used: the blocks around it, and the statement's address if it starts the variable.
type Use = (Vec<usize>, Option<usize>);

/// Statements that give a variable a constant first value, outside of loops and for all that uses it.
fn starts(function: &Function) -> Vec<usize> {
    let mut seen: HashMap<Handle<LocalVariable>, Vec<Use>> = HashMap::new();
    walk(&function.body, &mut Vec::new(), &mut |statement, path| {
        let mut note = |pointer, start| {
            if let Some(variable) = variable_of(function, pointer) {
                seen.entry(variable)
                    .or_default()
                    .push((path.to_vec(), start));
            }
        };
        match statement {
            Statement::Emit(range) => {
                for handle in range.clone() {
                    if let Expression::Load { pointer } = function.expressions[handle] {
                        note(pointer, None);
                    }
                }
            }
            Statement::Store { pointer, value } => {
                let whole = matches!(function.expressions[*pointer], Expression::LocalVariable(_));
                let is_start = whole && is_constant(function, *value);
                note(
                    *pointer,
                    is_start.then(|| std::ptr::from_ref(statement).addr()),
                );
            }
            _ => {}
        }
    });
    let mut out = Vec::new();
    for (variable, uses) in seen {
        let (path, Some(start)) = &uses[0] else {
            continue;
        };
        let in_loop = path.iter().any(|p| p % 2 == 1);
        let for_all = uses.iter().all(|(other, _)| other.starts_with(path));
        if !in_loop && for_all && function.local_variables[variable].init.is_none() {
            out.push(*start);
        }
    }
    out
}

fn is_constant(function: &Function, value: Handle<Expression>) -> bool {
    match &function.expressions[value] {
        Expression::Literal(_) | Expression::Constant(_) | Expression::ZeroValue(_) => true,
        Expression::Compose { components, .. } => {
            components.iter().all(|&c| is_constant(function, c))
        }
        Expression::Splat { value, .. } => is_constant(function, *value),
        Expression::Unary { expr, .. } => is_constant(function, *expr),
        _ => false,
    }
}

fn stored_in(function: &Function, body: &Block, continuing: &Block) -> Vec<Handle<LocalVariable>> {
    let mut out = Vec::new();
    for block in [body, continuing] {
        walk(block, &mut Vec::new(), &mut |statement, _| {
            if let Statement::Store { pointer, .. } = statement
                && let Some(variable) = variable_of(function, *pointer)
                && !out.contains(&variable)
            {
                out.push(variable);
            }
        });
    }
    out
}
