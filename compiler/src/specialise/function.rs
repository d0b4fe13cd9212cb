//! One function, with what is known put in its place and what cannot be reached left out.

use naga::{
    Arena, Block, Expression, Function, GlobalVariable, Handle, Literal, LocalVariable, ScalarKind,
    Span, Statement, SwitchCase, SwitchValue, Type,
};
use rustc_hash::{FxHashMap, FxHashSet};

use super::calls::Calls;
use super::known::{Key, Known};
use super::operands::each_operand;
use super::pools::Pools;
use super::stores::{ends_by_condition, tracked, ways_out, writes};

/// A uniform, and those of its words that are fixed; `None` for those that may change.
#[derive(Clone, Debug)]
pub struct Fixed<'a> {
    pub global: Handle<GlobalVariable>,
    pub ty: Handle<Type>,
    pub words: &'a [Option<u32>],
}

impl Fixed<'_> {
    /// The number at an offset in bytes. Numbers that no literal can be, and subnormal ones, which machines treat
    /// differently, count as unknown.
    pub(super) fn word(&self, offset: u32, kind: ScalarKind) -> Option<Literal> {
        let bits = (*self.words.get(offset as usize / 4)?)?;
        match kind {
            ScalarKind::Float => {
                let x = f32::from_bits(bits);
                (x == 0.0 || x.is_normal()).then_some(Literal::F32(x))
            }
            ScalarKind::Uint => Some(Literal::U32(bits)),
            ScalarKind::Sint => Some(Literal::I32(bits.cast_signed())),
            _ => None,
        }
    }
}

/// What has become of an expression.
#[derive(Clone, Debug, Default)]
pub(super) struct Slot {
    pub known: Option<Known>,
    pub at: Option<Handle<Expression>>,
}

/// A construct that no shader of ours has: the function is left as it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unforeseen;

/// Makes a function anew.
pub struct Rewriter<'a, 'm> {
    pub(super) old: &'a Function,
    pub(super) fixed: &'a [Fixed<'a>],
    pub(super) pools: &'a mut Pools<'m>,
    calls: &'a mut Calls,
    /// All functions of the module.
    functions: &'a Arena<Function>,
    arguments: Vec<Option<Known>>,
    pub(super) expressions: Arena<Expression>,
    pub(super) locals: Arena<LocalVariable>,
    pub(super) slots: Vec<Slot>,
    pub(super) literals: FxHashMap<Key, Handle<Expression>>,
    /// Locals whose every use is seen, and the values of those that are known here.
    tracked: FxHashSet<Handle<LocalVariable>>,
    pub(super) values: FxHashMap<Handle<LocalVariable>, Known>,
    /// Blocks that are being made, the innermost last.
    out: Vec<Block>,
    /// Where expressions begin that no statement emits yet.
    pub(super) run: Option<usize>,
    /// Values of the returns.
    returned: Vec<Option<Known>>,
    /// Whether it does anything but compute.
    acts: bool,
    /// Whether the turn of a loop is being tried.
    is_trying: bool,
    /// Whether every operand was there when it was used.
    pub(super) is_sound: bool,
}

impl<'a, 'm> Rewriter<'a, 'm> {
    pub fn new(
        old: &'a Function,
        arguments: Vec<Option<Known>>,
        fixed: &'a [Fixed<'a>],
        pools: &'a mut Pools<'m>,
        calls: &'a mut Calls,
        functions: &'a Arena<Function>,
    ) -> Self {
        Self {
            old,
            fixed,
            pools,
            calls,
            functions,
            arguments,
            expressions: Arena::new(),
            locals: Arena::new(),
            slots: vec![Slot::default(); old.expressions.len()],
            literals: FxHashMap::default(),
            tracked: tracked(old),
            values: FxHashMap::default(),
            out: Vec::new(),
            run: None,
            returned: Vec::new(),
            acts: false,
            is_trying: false,
            is_sound: true,
        }
    }

    /// The new function, and its value if that is known and nothing else is done.
    pub fn run(mut self) -> Result<(Function, Option<Known>), Unforeseen> {
        for (handle, expression) in self.old.expressions.iter() {
            if expression.needs_pre_emit() {
                self.declare(handle, expression);
            }
        }
        self.locals = self.local_variables()?;
        let (body, _) = self.block(&self.old.body)?;
        if !self.is_sound {
            return Err(Unforeseen);
        }
        let named_expressions = self
            .old
            .named_expressions
            .iter()
            .filter_map(|(handle, name)| {
                let at = self.slots[handle.index()].at?;
                let is_named = !self.expressions[at].needs_pre_emit();
                is_named.then(|| (at, name.clone()))
            })
            .collect();
        let value = self.value();
        let function = Function {
            name: self.old.name.clone(),
            arguments: self.old.arguments.clone(),
            result: self.old.result.clone(),
            local_variables: self.locals,
            expressions: self.expressions,
            named_expressions,
            body,
            diagnostic_filter_leaf: self.old.diagnostic_filter_leaf,
        };
        Ok((function, value))
    }

    /// What the function always returns.
    fn value(&self) -> Option<Known> {
        let first = self.returned.first()?.as_ref()?;
        let same = |value: &Option<Known>| value.as_ref().is_some_and(|x| x.is(first));
        (!self.acts && self.returned.iter().all(same)).then(|| first.clone())
    }

    /// Expressions that are there from the beginning.
    fn declare(&mut self, handle: Handle<Expression>, expression: &Expression) {
        let known = match *expression {
            Expression::Literal(literal) => Some(Known::Scalar(literal)),
            Expression::Constant(constant) => self.pools.value(constant),
            Expression::ZeroValue(ty) => self.pools.zero(ty),
            Expression::FunctionArgument(k) => self.arguments[k as usize].clone(),
            _ => None,
        };
        let span = self.old.expressions.get_span(handle);
        // what is known and turns out to be needed is made where it is needed
        let is_copied = known.is_none() || matches!(expression, Expression::Constant(_));
        let at = is_copied.then(|| self.expressions.append(expression.clone(), span));
        self.slots[handle.index()] = Slot { known, at };
    }

    fn local_variables(&mut self) -> Result<Arena<LocalVariable>, Unforeseen> {
        let mut all = Arena::new();
        for (handle, variable) in self.old.local_variables.iter() {
            let mut variable = variable.clone();
            if let Some(init) = variable.init {
                // initial values are constant expressions, which need not be emitted anywhere
                let known = self.constant(init).ok_or(Unforeseen)?;
                variable.init = Some(self.made(&known, variable.ty));
                if self.tracked.contains(&handle) {
                    self.values.insert(handle, known);
                }
            }
            let span = self.old.local_variables.get_span(handle);
            // the handle is the same: all variables are kept, in their order
            all.append(variable, span);
        }
        Ok(all)
    }

    /// The value of a constant expression.
    fn constant(&mut self, handle: Handle<Expression>) -> Option<Known> {
        if let Some(known) = &self.slots[handle.index()].known {
            return Some(known.clone());
        }
        let expression = self.old.expressions[handle].clone();
        let mut is_whole = true;
        let mut parts = Vec::new();
        each_operand(&mut expression.clone(), &mut |part| parts.push(*part));
        for part in parts {
            let known = self.constant(part);
            is_whole &= known.is_some();
            self.slots[part.index()].known = known;
        }
        if is_whole {
            self.folded(&expression)
        } else {
            None
        }
    }

    // Blocks and statements

    /// A block made anew, and whether nothing after it is reached.
    fn block(&mut self, old: &Block) -> Result<(Block, bool), Unforeseen> {
        self.out.push(Block::new());
        let ended = self.statements(old)?;
        self.flush();
        let made = self.out.pop().unwrap_or_default();
        Ok((made, ended))
    }

    fn statements(&mut self, old: &Block) -> Result<bool, Unforeseen> {
        for (statement, span) in old.span_iter() {
            if self.statement(statement, *span)? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Makes a statement anew; whether nothing after it is reached.
    fn statement(&mut self, statement: &Statement, span: Span) -> Result<bool, Unforeseen> {
        match statement {
            Statement::Emit(range) => {
                range.clone().for_each(|handle| self.compute(handle));
            }
            Statement::Block(inner) => {
                let (block, ended) = self.block(inner)?;
                self.push(Statement::Block(block), span);
                return Ok(ended);
            }
            Statement::If {
                condition,
                accept,
                reject,
            } => return self.branch(*condition, (accept, reject), span),
            Statement::Switch { selector, cases } => self.switch(*selector, cases, span)?,
            Statement::Loop {
                body,
                continuing,
                break_if,
            } => self.repeat((body, continuing), *break_if, span)?,
            Statement::Break | Statement::Continue | Statement::Kill => {
                self.acts |= matches!(statement, Statement::Kill);
                self.push(statement.clone(), span);
                return Ok(true);
            }
            Statement::Return { value } => {
                let known = value.map(|v| self.slots[v.index()].known.clone());
                self.returned.push(known.flatten());
                let value = value.map(|v| self.operand(v));
                self.push(Statement::Return { value }, span);
                return Ok(true);
            }
            Statement::Store { pointer, value } => self.store(*pointer, *value, span),
            Statement::Call {
                function,
                arguments,
                result,
            } => {
                if let Some(result) = result
                    && let Some(known) = self.called(*function, arguments)
                {
                    self.slots[result.index()].known = Some(known);
                    return Ok(false);
                }
                self.acts = true;
                let known = arguments
                    .iter()
                    .map(|a| self.slots[a.index()].known.as_ref());
                self.calls.note(*function, known);
                let arguments = arguments.iter().map(|&a| self.operand(a)).collect();
                self.flush();
                let result = result.map(|old| {
                    let span = self.old.expressions.get_span(old);
                    let call = Expression::CallResult(*function);
                    let made = self.expressions.append(call, span);
                    self.slots[old.index()].at = Some(made);
                    made
                });
                let function = *function;
                let call = Statement::Call {
                    function,
                    arguments,
                    result,
                };
                self.push(call, span);
            }
            _ => return Err(Unforeseen),
        }
        Ok(false)
    }

    /// The value of a call, if the function always returns it, or returns it for these arguments, which are known.
    fn called(
        &mut self,
        function: Handle<Function>,
        arguments: &[Handle<Expression>],
    ) -> Option<Known> {
        if let Some(known) = self.calls.value(function) {
            return Some(known.clone());
        }
        let known: Option<Vec<Known>> = arguments.iter().map(|&a| self.known(a).cloned()).collect();
        let known = known?;
        let key: Vec<Key> = known.iter().map(Known::key).collect();
        if let Some(tried) = self.calls.tried(function, &key) {
            return tried;
        }
        self.calls.begin_trial();
        let trial = Rewriter::new(
            &self.functions[function],
            known.into_iter().map(Some).collect(),
            self.fixed,
            self.pools,
            self.calls,
            self.functions,
        );
        let value = trial.run().ok().and_then(|(_, value)| value);
        self.calls.end_trial(function, key, value.clone());
        value
    }

    fn store(&mut self, pointer: Handle<Expression>, value: Handle<Expression>, span: Span) {
        if let Expression::LocalVariable(local) = self.old.expressions[pointer] {
            match &self.slots[value.index()].known {
                Some(known) if self.tracked.contains(&local) => {
                    self.values.insert(local, known.clone());
                }
                _ => {
                    self.values.remove(&local);
                }
            }
        } else {
            self.acts = true;
        }
        let store = Statement::Store {
            pointer: self.operand(pointer),
            value: self.operand(value),
        };
        self.push(store, span);
    }

    fn branch(
        &mut self,
        condition: Handle<Expression>,
        (accept, reject): (&Block, &Block),
        span: Span,
    ) -> Result<bool, Unforeseen> {
        if let Some(truth) = self.slots[condition.index()]
            .known
            .as_ref()
            .and_then(Known::bool)
        {
            return self.statements(if truth { accept } else { reject });
        }
        let condition = self.operand(condition);
        self.flush();
        let before = self.values.clone();
        let (accept, accept_ends) = self.block(accept)?;
        let after_accept = std::mem::replace(&mut self.values, before);
        let (reject, reject_ends) = self.block(reject)?;
        match (accept_ends, reject_ends) {
            (true, _) => {}
            (false, true) => self.values = after_accept,
            (false, false) => self.values.retain(|local, value| {
                let other = after_accept.get(local);
                other.is_some_and(|other| other.is(value))
            }),
        }
        let branch = Statement::If {
            condition,
            accept,
            reject,
        };
        self.push(branch, span);
        Ok(accept_ends && reject_ends)
    }

    fn switch(
        &mut self,
        selector: Handle<Expression>,
        cases: &[SwitchCase],
        span: Span,
    ) -> Result<(), Unforeseen> {
        if cases
            .iter()
            .any(|case| case.fall_through && !case.body.is_empty())
        {
            return Err(Unforeseen);
        }
        let known = self.slots[selector.index()].known.clone();
        let chosen = known.as_ref().and_then(|known| taken(known, cases));
        let selector = self.operand(selector);
        self.flush();
        for case in cases {
            for (local, _) in writes(self.old, &case.body) {
                self.values.remove(&local);
            }
        }
        let before = self.values.clone();
        let mut made = Vec::new();
        if let Some(case) = chosen {
            let (body, _) = self.block(&case.body)?;
            made.push(SwitchCase {
                value: SwitchValue::Default,
                body,
                fall_through: false,
            });
        } else {
            for case in cases {
                let (body, _) = self.block(&case.body)?;
                self.values.clone_from(&before);
                made.push(SwitchCase {
                    body,
                    ..case.clone()
                });
            }
        }
        self.values = before;
        let cases = made;
        self.push(Statement::Switch { selector, cases }, span);
        Ok(())
    }

    fn repeat(
        &mut self,
        (body, continuing): (&Block, &Block),
        break_if: Option<Handle<Expression>>,
        span: Span,
    ) -> Result<(), Unforeseen> {
        if !self.is_trying && self.only_turn(body)? {
            return Ok(());
        }
        self.acts = true;
        self.flush();
        for (local, stored) in [body, continuing]
            .into_iter()
            .flat_map(|block| writes(self.old, block))
        {
            // what is stored again and again may be what is there
            let same = match (self.values.get(&local), &self.old.expressions[stored]) {
                (Some(value), Expression::Literal(x)) => value.is(&Known::Scalar(*x)),
                _ => false,
            };
            if !same {
                self.values.remove(&local);
            }
        }
        let around = self.values.clone();
        let (body, _) = self.block(body)?;
        self.values.clone_from(&around);
        self.out.push(Block::new());
        self.statements(continuing)?;
        let break_if = break_if.map(|condition| self.operand(condition));
        self.flush();
        let continuing = self.out.pop().unwrap_or_default();
        self.values = around;
        let repeat = Statement::Loop {
            body,
            continuing,
            break_if,
        };
        self.push(repeat, span);
        Ok(())
    }

    /// Tries whether the loop certainly ends in its first turn; then that turn is made, without the loop.
    fn only_turn(&mut self, body: &Block) -> Result<bool, Unforeseen> {
        if !ends_by_condition(body) {
            return Ok(false);
        }
        self.flush();
        let before = (self.slots.clone(), self.values.clone(), self.acts);
        let returns = self.returned.len();
        self.is_trying = true;
        let tried = self.block(body);
        self.is_trying = false;
        let (mut turn, _) = tried?;
        if let Some(Statement::Break) = turn.last()
            && ways_out(&turn) == 1
        {
            turn.cull(turn.len() - 1..);
            if let Some(block) = self.out.last_mut() {
                block.extend_block(turn);
            }
            return Ok(true);
        }
        (self.slots, self.values, self.acts) = before;
        self.returned.truncate(returns);
        Ok(false)
    }

    fn push(&mut self, statement: Statement, span: Span) {
        self.flush();
        if let Some(block) = self.out.last_mut() {
            block.push(statement, span);
        }
    }

    /// Emits the expressions made since the last statement.
    pub(super) fn flush(&mut self) {
        if let Some(start) = self.run.take() {
            let range = self.expressions.range_from(start);
            if let Some(block) = self.out.last_mut() {
                block.push(Statement::Emit(range), Span::UNDEFINED);
            }
        }
    }
}

/// The case that a known number takes.
fn taken<'a>(selector: &Known, cases: &'a [SwitchCase]) -> Option<&'a SwitchCase> {
    let is_it = |case: &SwitchCase| match (selector.literal(), case.value) {
        (Some(Literal::I32(x)), SwitchValue::I32(y)) => x == y,
        (Some(Literal::U32(x)), SwitchValue::U32(y)) => x == y,
        _ => false,
    };
    let start = cases.iter().position(is_it).or_else(|| {
        cases
            .iter()
            .position(|case| case.value == SwitchValue::Default)
    })?;
    // cases that share a body fall through, with none of their own, to the one that has it
    cases[start..].iter().find(|case| !case.fall_through)
}
