//! Statements: what runs, and for which lanes.
//!
//! Lanes that do not run wait in registers. Where none is left the code goes on at the end of the block that is open, where
//! others may join.

use naga::{Block, Expression, Handle, Span, Statement, SwitchCase, SwitchValue};

use super::Translator;
use super::body::{Body, Exits, Known, Returns};
use crate::executor::code::{Compare, Form, Inst, Op};
use crate::executor::fault::{Fault, LoopSite};
use crate::executor::lanes::Slot;
use crate::executor::trace::SiteKind;

impl<'m> Translator<'m> {
    /// The instruction goes on at the end of the block that is open.
    pub(super) fn go_on_at_end(&mut self, inst: usize) {
        if let Some(pending) = self.pending.last_mut() {
            pending.push(inst);
        }
    }

    /// The block that was opened last ends here.
    pub(super) fn join_here(&mut self) {
        let here = self.here();
        for inst in self.pending.pop().unwrap_or_default() {
            self.code[inst].x = here;
        }
    }

    /// A block that only some lanes may go through.
    fn block(&mut self, body: &mut Body<'m>, block: &'m Block) -> Result<(), Fault> {
        self.open_block();
        self.statements(body, block)?;
        self.close_block();
        Ok(())
    }

    pub(super) fn statements(
        &mut self,
        body: &mut Body<'m>,
        block: &'m Block,
    ) -> Result<(), Fault> {
        for (statement, &span) in block.span_iter() {
            if let Statement::Emit(range) = statement {
                for handle in range.clone() {
                    self.tick(body);
                    self.emitted(body, handle)?;
                }
                continue;
            }
            self.tick(body);
            self.statement(body, statement, span)?;
            self.tick(body);
        }
        Ok(())
    }

    fn emitted(&mut self, body: &mut Body<'m>, handle: Handle<Expression>) -> Result<(), Fault> {
        let mark = self.temporaries.len();
        let known = self.expression(body, handle)?;
        self.keep(body, handle, known);
        self.trace(body, SiteKind::Expression(handle), handle)?;
        self.drop_temporaries(mark);
        Ok(())
    }

    fn statement(
        &mut self,
        body: &mut Body<'m>,
        statement: &'m Statement,
        span: Span,
    ) -> Result<(), Fault> {
        match statement {
            Statement::Block(block) => self.statements(body, block),
            Statement::If {
                condition,
                accept,
                reject,
            } => self.branch(body, *condition, accept, reject),
            Statement::Switch { selector, cases } => self.switch(body, *selector, cases),
            Statement::Loop {
                body: steps,
                continuing,
                break_if,
            } => {
                self.loops.push(LoopSite::new(body.function, span));
                self.repeat(body, steps, continuing, *break_if)
            }
            Statement::Break => {
                let exits = body.exits.last().copied();
                self.leave(exits.map(|exits| exits.broken))
            }
            Statement::Continue => {
                let mut exits = body.exits.iter().rev();
                let exit = exits.find_map(|exits| exits.continued);
                self.leave(exit)
            }
            Statement::Return { value } => self.give(body, *value),
            Statement::Store { pointer, value } => {
                let mark = self.temporaries.len();
                let parts = self.value(body, *value)?;
                let place = self.pointer(body, *pointer)?;
                self.store(&place, &parts)?;
                self.trace(body, SiteKind::Store(*pointer), *value)?;
                self.drop_temporaries(mark);
                Ok(())
            }
            Statement::Call {
                function,
                arguments,
                result,
            } => self.call(body, *function, arguments, *result),
            other => Err(Fault::unsupported(words(other))),
        }
    }

    /// Lanes wait until those that wait in a register go on.
    fn leave(&mut self, exit: Option<Slot>) -> Result<(), Fault> {
        let exit = exit.ok_or_else(|| Fault::unsupported("a way out of no loop"))?;
        let inst = self.emit(Inst::new(Op::Leave).to(exit));
        self.go_on_at_end(inst);
        Ok(())
    }

    fn give(
        &mut self,
        body: &mut Body<'m>,
        value: Option<Handle<Expression>>,
    ) -> Result<(), Fault> {
        let parts = match value {
            Some(value) => self.value(body, value)?,
            None => Vec::new(),
        };
        if body.returns == Returns::AtEnd {
            for &slot in &parts {
                self.frame.retain(slot);
            }
            body.results = parts;
            return Ok(());
        }
        for (&d, &a) in body.results.clone().iter().zip(&parts) {
            self.emit(Inst::new(Op::Store).to(d).of(a));
        }
        if self.options.watched.is_everything() && value.is_some() {
            let mut forms = Vec::new();
            if let Some(result) = &body.function.result {
                self.shapes
                    .forms(&self.module.types[result.ty].inner, &mut forms)?;
            }
            self.add_site(body, SiteKind::Leave, None, parts, forms);
        }
        let inst = match body.returns {
            Returns::Leave(gone) => self.emit(Inst::new(Op::Leave).to(gone)),
            _ => self.emit(Inst::new(Op::Quit)),
        };
        self.go_on_at_end(inst);
        Ok(())
    }

    fn branch(
        &mut self,
        body: &mut Body<'m>,
        condition: Handle<Expression>,
        accept: &'m Block,
        reject: &'m Block,
    ) -> Result<(), Fault> {
        let condition = self.one(body, condition)?;
        if let (Some(exit), true) = (only_exit(body, accept), reject.is_empty()) {
            let inst = Inst::new(Op::LeaveIf).to(exit).of(condition);
            let inst = self.emit(inst);
            self.go_on_at_end(inst);
            // its statement is two ticks, as any other
            self.tick(body);
            self.tick(body);
            return Ok(());
        }
        let others = self.frame.take()?;
        let inst = self.emit(Inst::new(Op::If).to(others).of(condition));
        self.pending.push(vec![inst]);
        self.block(body, accept)?;
        self.join_here();
        if !reject.is_empty() {
            let inst = self.emit(Inst::new(Op::Else).to(others));
            self.pending.push(vec![inst]);
            self.block(body, reject)?;
            self.join_here();
        }
        let end = self.emit(Inst::new(Op::EndIf).to(others));
        self.go_on_at_end(end);
        self.frame.release(others);
        Ok(())
    }

    fn repeat(
        &mut self,
        body: &mut Body<'m>,
        steps: &'m Block,
        continuing: &'m Block,
        break_if: Option<Handle<Expression>>,
    ) -> Result<(), Fault> {
        let (broken, continued) = (self.frame.take()?, self.frame.take()?);
        let this = self.loops.len() as u32 - 1;
        self.emit(Inst::new(Op::Enter).to(broken).of(continued).at(this));
        let start = self.here();
        body.exits.push(Exits {
            broken,
            continued: Some(continued),
        });
        self.pending.push(Vec::new());
        self.block(body, steps)?;
        self.join_here();
        let join = self.emit(Inst::new(Op::Join).to(continued));
        self.pending.push(Vec::new());
        self.block(body, continuing)?;
        self.join_here();
        let ends = match break_if {
            Some(condition) => self.one(body, condition)?,
            None => self.constant(0),
        };
        self.emit(Inst::new(Op::Repeat).to(broken).of(ends).at(start));
        self.code[join].x = self.here();
        let end = self.emit(Inst::new(Op::Resume).to(broken));
        self.go_on_at_end(end);
        body.exits.pop();
        self.frame.release(broken);
        self.frame.release(continued);
        Ok(())
    }

    fn switch(
        &mut self,
        body: &mut Body<'m>,
        selector: Handle<Expression>,
        cases: &'m [SwitchCase],
    ) -> Result<(), Fault> {
        let mark = self.temporaries.len();
        let chosen = self.one(body, selector)?;
        let form = self.form(body, selector)?;
        let conditions = self.conditions(chosen, form, cases)?;
        let (rest, merged) = (self.frame.take()?, self.frame.take()?);
        self.emit(Inst::new(Op::Clear).to(merged).of(rest));
        let next = self.here() + 1;
        self.emit(Inst::new(Op::Leave).to(rest).at(next));
        body.exits.push(Exits {
            broken: merged,
            continued: None,
        });
        // in the order of the text, which lifetimes go by; the default takes what no other case does
        for (case, condition) in cases.iter().zip(conditions) {
            let Some(condition) = condition else {
                continue;
            };
            let start = self.emit(Inst::new(Op::Case).to(rest).of(condition));
            self.pending.push(Vec::new());
            self.block(body, &case.body)?;
            self.join_here();
            let next = self.here() + 1;
            self.emit(Inst::new(Op::Leave).to(merged).at(next));
            self.code[start].x = next;
        }
        let end = self.emit(Inst::new(Op::Resume).to(merged));
        self.go_on_at_end(end);
        body.exits.pop();
        self.frame.release(rest);
        self.frame.release(merged);
        self.drop_temporaries(mark);
        Ok(())
    }

    /// For each case with a body, whether the selector chooses it.
    fn conditions(
        &mut self,
        chosen: Slot,
        form: Form,
        cases: &[SwitchCase],
    ) -> Result<Vec<Option<Slot>>, Fault> {
        let mut named = self.constant(0);
        let mut all = Vec::with_capacity(cases.len());
        let mut group = (self.constant(0), false);
        for case in cases {
            let value = match case.value {
                SwitchValue::I32(n) => Some(u64::from(n.cast_unsigned())),
                SwitchValue::U32(n) => Some(u64::from(n)),
                SwitchValue::Default => None,
            };
            match value {
                Some(word) => {
                    let word = self.constant(word);
                    let equal = self.binary(Op::Compare(form, Compare::Equal), chosen, word)?;
                    group.0 = self.binary(Op::Or, group.0, equal)?;
                    named = self.binary(Op::Or, named, equal)?;
                }
                None => group.1 = true,
            }
            if case.fall_through {
                if !case.body.is_empty() {
                    return Err(Fault::unsupported(
                        "a case that falls through into the next",
                    ));
                }
                all.push(None);
            } else {
                all.push(Some(group));
                group = (self.constant(0), false);
            }
        }
        let all = all.into_iter().map(|group| match group {
            None => Ok(None),
            Some((condition, false)) => Ok(Some(condition)),
            Some((condition, true)) => {
                let unnamed = self.unary(Op::Not, named)?;
                self.binary(Op::Or, condition, unnamed).map(Some)
            }
        });
        all.collect()
    }

    /// The one word of a scalar.
    pub(super) fn one(
        &mut self,
        body: &mut Body<'m>,
        handle: Handle<Expression>,
    ) -> Result<Slot, Fault> {
        let parts = self.value(body, handle)?;
        let first = parts.first().copied();
        first.ok_or_else(|| Fault::unsupported("a value without components"))
    }

    /// The parts of a value.
    pub(super) fn value(
        &mut self,
        body: &mut Body<'m>,
        handle: Handle<Expression>,
    ) -> Result<Vec<Slot>, Fault> {
        if let Some(Known::Value(parts)) = &body.known[handle.index()] {
            return Ok(parts.clone());
        }
        match self.expression(body, handle)? {
            Known::Value(parts) => Ok(parts),
            Known::Pointer(_) => Err(Fault::unsupported("a pointer as a value")),
        }
    }
}

/// Where lanes wait that leave by a block which does nothing else.
fn only_exit(body: &Body, block: &Block) -> Option<Slot> {
    let mut statements = block.iter();
    let (first, None) = (statements.next()?, statements.next()) else {
        return None;
    };
    match first {
        Statement::Break => body.exits.last().map(|exits| exits.broken),
        Statement::Continue => body.exits.iter().rev().find_map(|exits| exits.continued),
        Statement::Return { value: None } => match body.returns {
            Returns::Leave(gone) => Some(gone),
            _ => None,
        },
        _ => None,
    }
}

fn words(statement: &Statement) -> String {
    let text = match statement {
        Statement::Kill => "discarding a fragment",
        Statement::ControlBarrier(_) | Statement::MemoryBarrier(_) => "a barrier",
        Statement::ImageStore { .. } | Statement::ImageAtomic { .. } => "writing a texture",
        Statement::Atomic { .. } => "an atomic operation",
        Statement::WorkGroupUniformLoad { .. } => "workgroup memory",
        Statement::RayQuery { .. } | Statement::RayPipelineFunction(_) => "ray tracing",
        _ => "a statement of this kind",
    };
    text.to_owned()
}
