//! Loops as text: `for` where they count, `while` where they test first.

use naga::{Block, Expression, Handle, LocalVariable, Statement};

use super::dialect::Dialect;
use super::flow::FunctionPrinter;
use super::operands::variable_of;
use super::survey::{Birth, address};

/// A loop that tests before each step.
struct Tested<'m> {
    /// The condition to go on.
    condition: String,
    /// What is done after each step, if it is one assignment.
    update: Option<(String, Option<Handle<LocalVariable>>)>,
    /// The steps.
    steps: Vec<&'m Statement>,
}

impl<'m> FunctionPrinter<'_, 'm> {
    /// A statement that sets the variable which the loop behind it counts, together with that loop, or a loop whose variable is
    /// declared with it. Gives how many statements behind the first one were taken, or nothing where it is no such thing.
    pub(super) fn counted(
        &mut self,
        first: &'m Statement,
        others: &[&'m Statement],
    ) -> Result<Option<usize>, String> {
        let (taken, repeated, start) = match first {
            Statement::Loop { .. } => (0, first, None),
            Statement::Store { pointer, value } => {
                let Expression::LocalVariable(variable) = self.function.expressions[*pointer]
                else {
                    return Ok(None);
                };
                let Some(at) = others.iter().position(|s| !self.is_quiet(s)) else {
                    return Ok(None);
                };
                let is_start = self.is_born_in(first, variable);
                let alone =
                    self.plan
                        .survey
                        .is_only_in(variable, address(others[at]), address(first));
                if !is_start || !alone {
                    return Ok(None);
                }
                (
                    at + 1,
                    others[at],
                    Some((variable, self.value(*value)?.text)),
                )
            }
            _ => return Ok(None),
        };
        let Statement::Loop {
            body,
            continuing,
            break_if: None,
        } = repeated
        else {
            return Ok(None);
        };
        let Some(tested) = self.tested(body, continuing)? else {
            return Ok(None);
        };
        let Some((update, Some(counter))) = &tested.update else {
            return Ok(None);
        };
        let ty = self.function.local_variables[*counter].ty;
        let born = self.births.get(&address(repeated)).cloned();
        let born = born.unwrap_or_default();
        let start = match start {
            Some((variable, start)) if variable == *counter => {
                self.begun(&self.variable(variable), ty, Some(start))?
            }
            Some(_) => return Ok(None),
            None => {
                let has_start = self.function.local_variables[*counter].init.is_some();
                if !has_start || !born.iter().any(|b| b.0 == *counter) {
                    return Ok(None);
                }
                self.declaration(*counter)?
            }
        };
        // variables that live on behind the loop
        for (other, _) in born.iter().filter(|b| b.0 != *counter) {
            let line = self.declaration(*other)?;
            self.line(&format!("{line};"));
        }
        self.line(&format!("for ({start}; {}; {update}) {{", tested.condition));
        self.steps(&tested.steps)?;
        Ok(Some(taken))
    }

    fn is_born_in(&self, statement: &Statement, variable: Handle<LocalVariable>) -> bool {
        let born = self.births.get(&address(statement));
        born.is_some_and(|all| {
            all.iter()
                .any(|&(v, birth)| v == variable && matches!(birth, Birth::In(_)))
        })
    }

    fn steps(&mut self, steps: &[&'m Statement]) -> Result<(), String> {
        self.level += 1;
        self.statements(steps)?;
        self.level -= 1;
        self.line("}");
        Ok(())
    }

    /// A loop of any kind.
    pub(super) fn repeat(
        &mut self,
        body: &'m Block,
        continuing: &'m Block,
        break_if: Option<Handle<Expression>>,
    ) -> Result<(), String> {
        if break_if.is_none()
            && let Some(tested) = self.tested(body, continuing)?
        {
            let line = match &tested.update {
                Some((update, _)) => {
                    format!("for (; {}; {update}) {{", tested.condition)
                }
                None => format!("while {} {{", self.condition(&tested.condition)),
            };
            self.line(&line);
            return self.steps(&tested.steps);
        }
        let is_wgsl = self.printer.dialect == Dialect::Wgsl;
        let open = if is_wgsl { "loop {" } else { "for (;;) {" };
        self.line(open);
        self.level += 1;
        self.block(body)?;
        if !continuing.is_empty() || break_if.is_some() {
            if !is_wgsl && has_continue(body) {
                return Err("a loop that continues early".to_owned());
            }
            if is_wgsl {
                self.line("continuing {");
                self.level += 1;
            }
            self.block(continuing)?;
            if let Some(condition) = break_if {
                let text = self.value(condition)?.text;
                if is_wgsl {
                    self.line(&format!("break if {text};"));
                } else {
                    self.line(&format!("if ({text}) {{"));
                    self.level += 1;
                    self.line("break;");
                    self.level -= 1;
                    self.line("}");
                }
            }
            if is_wgsl {
                self.level -= 1;
                self.line("}");
            }
        }
        self.level -= 1;
        self.line("}");
        Ok(())
    }

    /// The loop as one that tests first, where it is.
    fn tested(&self, body: &'m Block, continuing: &'m Block) -> Result<Option<Tested<'m>>, String> {
        let Some(at) = body.iter().position(|s| !self.is_quiet(s)) else {
            return Ok(None);
        };
        let Statement::If {
            condition,
            accept,
            reject,
        } = &body[at]
        else {
            return Ok(None);
        };
        if self.births.contains_key(&address(&body[at])) {
            return Ok(None);
        }
        let leaves = |b: &Block| matches!(&b[..], [Statement::Break]);
        let condition = if leaves(accept) && reject.is_empty() {
            self.negated(*condition)?
        } else if leaves(reject) && accept.is_empty() {
            self.value(*condition)?.text
        } else {
            return Ok(None);
        };
        let loud: Vec<&Statement> = continuing.iter().filter(|s| !self.is_quiet(s)).collect();
        let update = match loud[..] {
            [] => None,
            [step @ &Statement::Store { pointer, value }] => {
                let text = self.store(step, pointer, value)?;
                Some((text, variable_of(self.function, pointer)))
            }
            _ => return Ok(None),
        };
        Ok(Some(Tested {
            condition,
            update,
            steps: body.iter().skip(at + 1).collect(),
        }))
    }
}

/// Whether a body has a `continue` of its own loop.
fn has_continue(block: &Block) -> bool {
    block.iter().any(|statement| match statement {
        Statement::Continue => true,
        Statement::Block(inner) => has_continue(inner),
        Statement::If { accept, reject, .. } => has_continue(accept) || has_continue(reject),
        Statement::Switch { cases, .. } => cases.iter().any(|c| has_continue(&c.body)),
        _ => false,
    })
}
