//! The body of a function while it is translated: what is known of its values.

use naga::valid::FunctionInfo;
use naga::{Block, Expression, Function, Handle, LocalVariable, Statement};

use super::pointer::Place;
use super::{Parts, Translator};
use crate::executor::Contraction;
use crate::executor::code::{Inst, Op};
use crate::executor::fault::Fault;
use crate::executor::lanes::Slot;
use crate::executor::lifetime::Lifetimes;
use crate::executor::trace::{Site, SiteKind};

/// What is known of an expression.
#[derive(Clone, Debug)]
pub(super) enum Known {
    Value(Parts),
    Pointer(Place),
}

/// How a body returns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Returns {
    /// Its last statement does, and no other.
    AtEnd,
    /// Lanes that return stop until the function's end.
    Quit,
    /// Lanes that return wait here: the body is written out in another.
    Leave(Slot),
}

/// Where lanes wait that leave a loop or a switch, or go on with the next step of a loop.
#[derive(Clone, Copy, Debug)]
pub(super) struct Exits {
    pub broken: Slot,
    /// None of a switch.
    pub continued: Option<Slot>,
}

/// Registers one after another.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    pub first: Slot,
    pub count: u32,
}

pub(super) struct Body<'m> {
    pub function: &'m Function,
    pub info: &'m FunctionInfo,
    pub handle: Option<Handle<Function>>,
    pub known: Vec<Option<Known>>,
    pub arguments: Vec<Parts>,
    pub results: Parts,
    pub returns: Returns,
    pub locals: Vec<Row>,
    pub lifetimes: Lifetimes,
    pub exits: Vec<Exits>,
}

impl<'m> Body<'m> {
    pub fn new(
        function: &'m Function,
        info: &'m FunctionInfo,
        handle: Option<Handle<Function>>,
        contraction: Contraction,
    ) -> Result<Self, Fault> {
        Ok(Self {
            function,
            info,
            handle,
            known: vec![None; function.expressions.len()],
            arguments: Vec::new(),
            results: Vec::new(),
            returns: Returns::AtEnd,
            locals: Vec::new(),
            lifetimes: Lifetimes::of(function, contraction != Contraction::None)?,
            exits: Vec::new(),
        })
    }

    /// Whether nothing but the last statement returns.
    pub fn returns_at_end(&self) -> bool {
        let last = self.function.body.len().saturating_sub(1);
        let mut stack: Vec<&Block> = Vec::new();
        for (k, statement) in self.function.body.iter().enumerate() {
            if matches!(statement, Statement::Return { .. }) && k < last {
                return false;
            }
            inside(statement, &mut stack);
        }
        while let Some(block) = stack.pop() {
            for statement in block {
                if matches!(statement, Statement::Return { .. }) {
                    return false;
                }
                inside(statement, &mut stack);
            }
        }
        true
    }
}

/// Adds the blocks of a statement.
fn inside<'f>(statement: &'f Statement, stack: &mut Vec<&'f Block>) {
    match statement {
        Statement::Block(block) => stack.push(block),
        Statement::If { accept, reject, .. } => stack.extend([accept, reject]),
        Statement::Switch { cases, .. } => stack.extend(cases.iter().map(|case| &case.body)),
        Statement::Loop {
            body, continuing, ..
        } => stack.extend([body, continuing]),
        _ => {}
    }
}

impl<'m> Translator<'m> {
    /// Makes the local variables, with their values at the start.
    pub(super) fn begin(&mut self, body: &mut Body<'m>) -> Result<(), Fault> {
        if self
            .options
            .watched
            .sees_entry(body.function.name.as_deref())
        {
            let (parts, mut forms) = (body.arguments.concat(), Vec::new());
            for argument in &body.function.arguments {
                self.shapes
                    .forms(&self.module.types[argument.ty].inner, &mut forms)?;
            }
            self.add_site(body, SiteKind::Enter, None, parts, forms);
        }
        for (_, variable) in body.function.local_variables.iter() {
            let count = self.shapes.size(variable.ty)?;
            let first = self.frame.row(count)?;
            body.locals.push(Row { first, count });
        }
        for (handle, variable) in body.function.local_variables.iter() {
            let row = body.locals[handle.index()];
            let start = match variable.init {
                Some(init) => self.value(body, init)?,
                None => vec![self.constant(0); row.count as usize],
            };
            for (k, a) in (0..row.count).zip(start) {
                let d = Slot::register(row.first.number() + k);
                self.emit(Inst::new(Op::Copy).to(d).of(a));
            }
        }
        Ok(())
    }

    pub(super) fn release_row(&mut self, row: Row) {
        for k in 0..row.count {
            self.frame.release(Slot::register(row.first.number() + k));
        }
    }

    /// Remembers what an expression is, for as long as it is needed.
    pub(super) fn keep(&mut self, body: &mut Body<'m>, handle: Handle<Expression>, known: Known) {
        match &known {
            Known::Value(parts) => parts.iter().for_each(|&slot| self.frame.retain(slot)),
            Known::Pointer(place) => place.index.iter().for_each(|&slot| self.frame.retain(slot)),
        }
        body.known[handle.index()] = Some(known);
    }

    /// An expression is not needed any more.
    pub(super) fn forget(&mut self, body: &mut Body<'m>, handle: Handle<Expression>) {
        match body.known[handle.index()].take() {
            Some(Known::Value(parts)) => parts.iter().for_each(|&slot| self.frame.release(slot)),
            Some(Known::Pointer(place)) => {
                place
                    .index
                    .iter()
                    .for_each(|&slot| self.frame.release(slot));
            }
            None => {}
        }
    }

    /// Goes on by a tick of the lifetimes.
    pub(super) fn tick(&mut self, body: &mut Body<'m>) {
        for handle in body.lifetimes.tick() {
            self.forget(body, handle);
        }
    }

    /// Gives up what the expression at hand has made, but for what was kept.
    pub(super) fn drop_temporaries(&mut self, mark: usize) {
        while self.temporaries.len() > mark {
            if let Some(slot) = self.temporaries.pop() {
                self.frame.release(slot);
            }
        }
    }

    /// Shows an expression's value to the observer.
    pub(super) fn trace(
        &mut self,
        body: &mut Body<'m>,
        kind: SiteKind,
        value: Handle<Expression>,
    ) -> Result<(), Fault> {
        if !self.options.watched.is_everything() {
            return Ok(());
        }
        let named = match kind {
            SiteKind::Store(pointer) => pointer,
            _ => value,
        };
        let mut forms = Vec::new();
        let inner = self.inner(body, value);
        if self.shapes.forms(inner, &mut forms).is_err() {
            return Ok(()); // a pointer
        }
        let parts = self.value(body, value)?;
        let name = match variable(body.function, named) {
            Some(local) => body.function.local_variables[local].name.clone(),
            None => body.function.named_expressions.get(&named).cloned(),
        };
        self.add_site(body, kind, name, parts, forms);
        Ok(())
    }

    /// Shows the results of a body that is at its end.
    pub(super) fn trace_results(&mut self, body: &mut Body<'m>) -> Result<(), Fault> {
        let is_seen = self.options.watched.is_everything();
        if let (true, Some(result)) = (is_seen, &body.function.result) {
            let mut forms = Vec::new();
            self.shapes
                .forms(&self.module.types[result.ty].inner, &mut forms)?;
            let parts = body.results.clone();
            if body.returns == Returns::AtEnd {
                self.add_site(body, SiteKind::Leave, None, parts, forms);
            }
        }
        Ok(())
    }

    pub(super) fn add_site(
        &mut self,
        body: &Body<'m>,
        kind: SiteKind,
        name: Option<String>,
        parts: Parts,
        forms: Vec<crate::executor::code::Form>,
    ) {
        self.sites.push(Site {
            function: body.handle,
            function_name: body.function.name.clone().unwrap_or_default(),
            kind,
            name,
            parts,
            forms,
        });
        let place = self.sites.len() as u32 - 1;
        self.emit(Inst::new(Op::Trace).at(place));
    }
}

/// The variable that a pointer leads into.
fn variable(function: &Function, mut pointer: Handle<Expression>) -> Option<Handle<LocalVariable>> {
    loop {
        match function.expressions[pointer] {
            Expression::LocalVariable(variable) => return Some(variable),
            Expression::AccessIndex { base, .. } | Expression::Access { base, .. } => {
                pointer = base;
            }
            _ => return None,
        }
    }
}
