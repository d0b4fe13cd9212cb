//! Functions and their statements as text.

use naga::valid::FunctionInfo;
use naga::{
    BinaryOperator, Block, Expression, Function, Handle, LocalVariable, Statement, SwitchCase,
    SwitchValue, TypeInner,
};
use rustc_hash::FxHashMap;

use super::Printer;
use super::dialect::Dialect;
use super::expression::rank;
use super::layout::wrap;
use super::names::{Names, described};
use super::plan::{Plan, names_of_readings};
use super::survey::{Birth, address};

/// Turns one function into text.
pub(super) struct FunctionPrinter<'p, 'm> {
    pub(super) printer: &'p Printer<'m>,
    handle: Handle<Function>,
    pub(super) function: &'m Function,
    pub(super) info: &'m FunctionInfo,
    pub(super) plan: Plan,
    /// Names of the expressions that have one.
    pub(super) names: Vec<Option<String>>,
    pub(super) variables: FxHashMap<Handle<LocalVariable>, String>,
    pub(super) births: FxHashMap<usize, Vec<(Handle<LocalVariable>, Birth)>>,
    /// Names of the arguments, used or not.
    arguments: Vec<String>,
    scope: Names,
    out: String,
    pub(super) level: usize,
}

impl<'p, 'm> FunctionPrinter<'p, 'm> {
    pub(super) fn new(printer: &'p Printer<'m>, handle: Handle<Function>) -> Result<Self, String> {
        let module = printer.module;
        let (function, info) = (&module.functions[handle], &printer.info[handle]);
        let dialect = printer.dialect;
        let is_array = |e: Handle<Expression>| {
            let inner = info[e].ty.inner_with(&module.types);
            matches!(function.expressions[e], Expression::Compose { .. })
                && matches!(inner, TypeInner::Array { .. })
        };
        // these languages write arrays where they are declared, and nowhere else
        let must_name = |e| {
            matches!(dialect, Dialect::Hlsl | Dialect::Msl | Dialect::C)
                && is_array(e)
                && !is_stored(function, e)
        };
        let plan = Plan::new(module, printer.info, function, info, &must_name)?;
        let mut out = Self {
            printer,
            handle,
            function,
            info,
            names: vec![None; function.expressions.len()],
            variables: FxHashMap::default(),
            births: FxHashMap::default(),
            arguments: Vec::new(),
            scope: printer.names.inside(),
            plan,
            out: String::new(),
            level: 0,
        };
        out.name_all();
        Ok(out)
    }

    fn name_all(&mut self) {
        let function = self.function;
        let arguments: Vec<String> = function
            .arguments
            .iter()
            .map(|a| self.scope.fresh(a.name.as_deref().unwrap_or("x")))
            .collect();
        for (handle, expression) in function.expressions.iter() {
            if let Expression::FunctionArgument(k) = *expression {
                self.names[handle.index()] = arguments.get(k as usize).cloned();
            }
        }
        self.arguments = arguments;
        self.name_variables();
        let users = function.named_expressions.iter();
        let users = users.filter(|(handle, _)| self.plan.named[handle.index()]);
        for (handle, name) in users {
            self.names[handle.index()] = Some(self.scope.fresh(name));
        }
        for (handle, _) in function.expressions.iter() {
            let at = handle.index();
            if !self.plan.named[at] || self.names[at].is_some() {
                continue;
            }
            let wanted = described(
                self.printer.module,
                function,
                &self.plan,
                &self.names,
                &|h| self.size(h) > 1,
                handle,
            );
            self.names[at] = Some(self.scope.fresh(wanted.as_deref().unwrap_or("t")));
        }
    }

    fn name_variables(&mut self) {
        let readings = names_of_readings(self.function, &self.plan);
        for (variable, local) in self.function.local_variables.iter() {
            let Some(birth) = self.plan.survey.birth(self.function, variable) else {
                continue;
            };
            let (Birth::Before(at) | Birth::In(at)) = birth;
            self.births.entry(at).or_default().push((variable, birth));
            let given = readings.get(&variable).or(local.name.as_ref());
            let name = self.scope.fresh(given.map_or("v", |n| n));
            self.variables.insert(variable, name.clone());
            for (handle, expression) in self.function.expressions.iter() {
                if matches!(expression, Expression::LocalVariable(v) if *v == variable) {
                    self.names[handle.index()] = Some(name.clone());
                }
            }
        }
    }

    /// The declaration and the whole text.
    pub(super) fn print(mut self) -> Result<(String, String), String> {
        let signature = self.signature()?;
        self.line(&format!("{signature} {{"));
        self.level += 1;
        self.mark_unused();
        self.block(&self.function.body)?;
        self.level -= 1;
        self.line("}");
        Ok((signature, self.out))
    }

    /// C compilers warn of arguments that a function does not use.
    fn mark_unused(&mut self) {
        if self.printer.dialect != Dialect::C {
            return;
        }
        let is_used = |k: usize| {
            self.function.expressions.iter().any(|(handle, e)| {
                matches!(e, Expression::FunctionArgument(index) if *index as usize == k)
                    && self.plan.needed[handle.index()]
            })
        };
        let all = self.arguments.iter().enumerate();
        let unused: Vec<String> = all
            .filter(|(k, _)| !is_used(*k))
            .map(|(_, name)| name.clone())
            .collect();
        for name in unused {
            self.line(&format!("(void){name};"));
        }
    }

    fn signature(&self) -> Result<String, String> {
        let printer = self.printer;
        let name = &printer.functions[&self.handle];
        let mut parameters = Vec::new();
        for (argument, name) in self.function.arguments.iter().zip(&self.arguments) {
            parameters.push(printer.declared(name, argument.ty)?);
        }
        let result = match &self.function.result {
            Some(result) => Some(printer.type_name(result.ty)?),
            None => None,
        };
        let list = match (printer.dialect, parameters.is_empty()) {
            (Dialect::C, true) => "void".to_owned(),
            _ => parameters.join(", "),
        };
        if printer.dialect == Dialect::Wgsl {
            let arrow = result.map_or(String::new(), |r| format!(" -> {r}"));
            return Ok(format!("fn {name}({list}){arrow}"));
        }
        let word = if printer.dialect == Dialect::C && !printer.wanted.contains(&self.handle) {
            "static inline "
        } else {
            ""
        };
        let result = result.unwrap_or_else(|| "void".to_owned());
        Ok(format!("{word}{result} {name}({list})"))
    }

    pub(super) fn line(&mut self, text: &str) {
        self.out.push_str(&wrap(text, self.level));
    }

    pub(super) fn is_wgsl(&self) -> bool {
        self.printer.dialect == Dialect::Wgsl
    }

    pub(super) fn block(&mut self, block: &'m Block) -> Result<(), String> {
        let statements: Vec<&'m Statement> = block.iter().collect();
        self.statements(&statements)
    }

    pub(super) fn statements(&mut self, statements: &[&'m Statement]) -> Result<(), String> {
        let mut rest = statements;
        while let Some((first, others)) = rest.split_first() {
            rest = others;
            if let Some(taken) = self.counted(first, others)? {
                rest = &others[taken..];
                continue;
            }
            self.declare_before(first)?;
            self.statement(first)?;
        }
        Ok(())
    }

    /// Variables that come into being before a statement.
    fn declare_before(&mut self, statement: &Statement) -> Result<(), String> {
        let born = self.births.get(&address(statement)).cloned();
        for (variable, birth) in born.unwrap_or_default() {
            if matches!(birth, Birth::Before(_)) {
                let line = self.declaration(variable)?;
                self.line(&format!("{line};"));
            }
        }
        Ok(())
    }

    /// `var x = 0.0`, without the semicolon.
    pub(super) fn declaration(&self, variable: Handle<LocalVariable>) -> Result<String, String> {
        let local = &self.function.local_variables[variable];
        let name = self.variable(variable);
        let start = match local.init {
            Some(init) => Some(self.formed(init)?.text),
            // other languages than WGSL do not set what they declare
            None if !self.is_wgsl() => Some(self.printer.zero(local.ty)?),
            None => None,
        };
        self.begun(&name, local.ty, start)
    }

    /// A variable with its first value.
    pub(super) fn begun(
        &self,
        name: &str,
        ty: Handle<naga::Type>,
        start: Option<String>,
    ) -> Result<String, String> {
        let declared = self.printer.declared(name, ty)?;
        Ok(match (start, self.is_wgsl()) {
            (None, true) => format!("var {declared}"),
            (None, false) => declared,
            (Some(start), true) => format!("var {name} = {start}"),
            (Some(start), false) => format!("{declared} = {start}"),
        })
    }

    fn named_value(&mut self, handle: Handle<Expression>) -> Result<(), String> {
        let at = handle.index();
        if !self.plan.needed[at] || !self.plan.named[at] {
            return Ok(());
        }
        let value = self.formed(handle)?.text;
        let name = self.names[at].clone().unwrap_or_default();
        let line = if self.is_wgsl() {
            format!("let {name} = {value};")
        } else {
            let inner = self.inner(handle);
            if let TypeInner::Array { base, size, .. } = inner {
                let naga::ArraySize::Constant(count) = size else {
                    return Err("an array without a fixed size".to_owned());
                };
                format!(
                    "{} {name}[{count}] = {value};",
                    self.printer.type_name(*base)?
                )
            } else {
                let ty = self.info[handle].ty.handle();
                format!("{} {name} = {value};", self.printer.inner_name(inner, ty)?)
            }
        };
        self.line(&line);
        Ok(())
    }

    fn statement(&mut self, statement: &'m Statement) -> Result<(), String> {
        match statement {
            Statement::Emit(range) => {
                for handle in range.clone() {
                    self.named_value(handle)?;
                }
                Ok(())
            }
            Statement::Call {
                result: Some(result),
                ..
            } => self.named_value(*result),
            Statement::Call {
                function,
                arguments,
                result: None,
            } => {
                let list = self.list(arguments)?;
                let name = self.printer.functions[function].clone();
                self.line(&format!("{name}({list});"));
                Ok(())
            }
            Statement::Store { pointer, value } => {
                let line = self.store(statement, *pointer, *value)?;
                self.line(&format!("{line};"));
                Ok(())
            }
            Statement::Block(inner) => self.block(inner),
            Statement::If {
                condition,
                accept,
                reject,
            } => self.choice(*condition, accept, reject, ""),
            Statement::Switch { selector, cases } => self.switch(*selector, cases),
            Statement::Loop {
                body,
                continuing,
                break_if,
            } => self.repeat(body, continuing, *break_if),
            Statement::Break => self.word("break;"),
            Statement::Continue => self.word("continue;"),
            Statement::Return { value: None } => self.word("return;"),
            Statement::Return { value: Some(value) } => {
                let value = self.value(*value)?.text;
                self.line(&format!("return {value};"));
                Ok(())
            }
            Statement::Kill if self.printer.dialect != Dialect::C => self.word("discard;"),
            _ => Err("a statement that formulas do not have".to_owned()),
        }
    }

    fn word(&mut self, word: &str) -> Result<(), String> {
        self.line(word);
        Ok(())
    }

    /// An assignment, without the semicolon.
    pub(super) fn store(
        &self,
        statement: &Statement,
        pointer: Handle<Expression>,
        value: Handle<Expression>,
    ) -> Result<String, String> {
        let born = self.births.get(&address(statement));
        let born = born.and_then(|all| all.iter().find(|b| matches!(b.1, Birth::In(_))));
        if let Some(&(variable, _)) = born {
            let start = self.value(value)?.text;
            let ty = self.function.local_variables[variable].ty;
            return self.begun(&self.variable(variable), ty, Some(start));
        }
        let place = self.value(pointer)?.text;
        if let Some(text) = self.compound(&place, value)? {
            return Ok(text);
        }
        Ok(format!("{place} = {}", self.value(value)?.text))
    }

    /// `x += y`.
    fn compound(&self, place: &str, value: Handle<Expression>) -> Result<Option<String>, String> {
        let Expression::Binary { op, left, right } = self.function.expressions[value] else {
            return Ok(None);
        };
        let Expression::Load { pointer: read } = self.function.expressions[left] else {
            return Ok(None);
        };
        let is_plain = !self.plan.named[value.index()] && !self.plan.named[left.index()];
        let vectors = self.size(left) > 1 || self.size(right) > 1;
        let in_c = self.printer.dialect == Dialect::C && vectors;
        let is_splat = matches!(self.function.expressions[right], Expression::Splat { .. });
        if !is_plain || in_c || is_splat || self.value(read)?.text != place {
            return Ok(None);
        }
        let sign = match op {
            BinaryOperator::Add => "+=",
            BinaryOperator::Subtract => "-=",
            BinaryOperator::Multiply => "*=",
            BinaryOperator::Divide => "/=",
            _ => return Ok(None),
        };
        Ok(Some(format!("{place} {sign} {}", self.value(right)?.text)))
    }

    /// The head of a branch or loop: languages that look like C want brackets.
    pub(super) fn condition(&self, text: &str) -> String {
        if self.is_wgsl() {
            text.to_owned()
        } else {
            format!("({text})")
        }
    }

    fn choice(
        &mut self,
        condition: Handle<Expression>,
        accept: &'m Block,
        reject: &'m Block,
        before: &str,
    ) -> Result<(), String> {
        let (yes, no) = (self.is_silent(accept), self.is_silent(reject));
        if yes && no {
            return Ok(());
        }
        let (text, accept, reject) = if yes {
            (self.negated(condition)?, reject, None)
        } else {
            let reject = (!no).then_some(reject);
            (self.value(condition)?.text, accept, reject)
        };
        let head = self.condition(&text);
        self.line(&format!("{before}if {head} {{"));
        self.level += 1;
        self.block(accept)?;
        self.level -= 1;
        let Some(reject) = reject else {
            return self.word("}");
        };
        if let Some((condition, accept, reject)) = self.lone_choice(reject) {
            return self.choice(condition, accept, reject, "} else ");
        }
        self.line("} else {");
        self.level += 1;
        self.block(reject)?;
        self.level -= 1;
        self.word("}")
    }

    /// The branch that is all that a block does.
    fn lone_choice(&self, block: &'m Block) -> Option<(Handle<Expression>, &'m Block, &'m Block)> {
        let mut loud = block.iter().filter(|s| !self.is_quiet(s));
        let (only, others) = (loud.next()?, loud.next());
        match only {
            Statement::If {
                condition,
                accept,
                reject,
            } if others.is_none() && !self.births.contains_key(&address(only)) => {
                Some((*condition, accept, reject))
            }
            Statement::Block(inner) if others.is_none() => self.lone_choice(inner),
            _ => None,
        }
    }

    fn is_silent(&self, block: &Block) -> bool {
        block.iter().all(|s| self.is_quiet(s))
    }

    /// Whether a statement leaves no text.
    pub(super) fn is_quiet(&self, statement: &Statement) -> bool {
        if self.births.contains_key(&address(statement)) {
            return false;
        }
        let hidden =
            |h: &Handle<Expression>| !self.plan.needed[h.index()] || !self.plan.named[h.index()];
        match statement {
            Statement::Emit(range) => range.clone().all(|h| hidden(&h)),
            Statement::Call {
                result: Some(result),
                ..
            } => hidden(result),
            Statement::Block(inner) => self.is_silent(inner),
            _ => false,
        }
    }

    /// The opposite of a condition.
    pub(super) fn negated(&self, condition: Handle<Expression>) -> Result<String, String> {
        if let Expression::Unary {
            op: naga::UnaryOperator::LogicalNot,
            expr,
        } = self.function.expressions[condition]
            && !self.plan.named[condition.index()]
        {
            return Ok(self.value(expr)?.text);
        }
        Ok(format!("!{}", self.value(condition)?.within(rank::NAME)))
    }

    fn switch(
        &mut self,
        selector: Handle<Expression>,
        cases: &'m [SwitchCase],
    ) -> Result<(), String> {
        let selector = self.value(selector)?.text;
        let head = self.condition(&selector);
        self.line(&format!("switch {head} {{"));
        self.level += 1;
        let mut labels: Vec<String> = Vec::new();
        for case in cases {
            labels.push(match case.value {
                SwitchValue::I32(value) => value.to_string(),
                SwitchValue::U32(value) => format!("{value}u"),
                SwitchValue::Default => "default".to_owned(),
            });
            if case.fall_through && case.body.is_empty() {
                continue;
            }
            if case.fall_through {
                return Err("a case that falls through".to_owned());
            }
            self.case(&std::mem::take(&mut labels), &case.body)?;
        }
        self.level -= 1;
        self.word("}")
    }

    fn case(&mut self, labels: &[String], body: &'m Block) -> Result<(), String> {
        if self.is_wgsl() {
            let only = labels.iter().any(|l| l == "default") && labels.len() == 1;
            let label = if only {
                "default".to_owned()
            } else {
                format!("case {}", labels.join(", "))
            };
            self.line(&format!("{label}: {{"));
        } else {
            let last = labels.len().saturating_sub(1);
            for (k, label) in labels.iter().enumerate() {
                let label = match label.as_str() {
                    "default" => "default:".to_owned(),
                    value => format!("case {value}:"),
                };
                let open = if k == last { " {" } else { "" };
                self.line(&format!("{label}{open}"));
            }
        }
        self.level += 1;
        self.block(body)?;
        let ends = body.last().is_some_and(|s| {
            matches!(
                s,
                Statement::Return { .. } | Statement::Break | Statement::Continue
            )
        });
        if !self.is_wgsl() && !ends {
            self.line("break;");
        }
        self.level -= 1;
        self.word("}")
    }
}

/// Whether a value is only what a variable is set to.
fn is_stored(function: &Function, value: Handle<Expression>) -> bool {
    let mut stack = vec![&function.body];
    while let Some(block) = stack.pop() {
        for statement in block {
            match statement {
                Statement::Store { value: stored, .. } if *stored == value => return true,
                Statement::Block(inner) => stack.push(inner),
                Statement::If { accept, reject, .. } => stack.extend([accept, reject]),
                Statement::Loop {
                    body, continuing, ..
                } => stack.extend([body, continuing]),
                Statement::Switch { cases, .. } => stack.extend(cases.iter().map(|c| &c.body)),
                _ => {}
            }
        }
    }
    false
}
