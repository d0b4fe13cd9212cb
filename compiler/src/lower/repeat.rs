//! Lowering a loop.

use naga::{BinaryOperator, Block, Expression, Handle, MathFunction, Statement, UnaryOperator};

use rustc_hash::FxHashSet;

use super::LowerError;
use super::function::Lowering;
use crate::ir::{Id, Op, Plan, Prim, Schedule, Ty};

/// A whole number that grows by one in each step, which is counted in the place of the steps.
#[derive(Clone, Copy)]
struct Numbered {
    /// The node that has it.
    id: Id,
    /// Its value in the first step.
    first: f32,
    /// Its value behind the last step.
    end: f32,
}

/// With no more than 100,000 steps behind it, such a number is exact in single precision.
const MOST_FIRST: f64 = 1e6;

impl Lowering<'_, '_, '_> {
    /// Writes a loop: its states are variables, read at the begin of each step and written at its end.
    pub(super) fn repeat(&mut self, schedule: &Schedule, plan: &Plan) -> Result<(), LowerError> {
        let it = &plan.it;
        let numbered = self.numbered(plan);
        let (count, start, name) = match numbered {
            Some(Numbered { id, first, end }) => {
                let name = self.graph.name(id).map(super::identifier);
                (self.body.literal(end), self.body.literal(first), name)
            }
            None => (self.count(plan)?, self.body.literal(0.0), None),
        };
        let name = name.unwrap_or_else(|| "steps".to_owned());
        let done = self.body.variable(name, self.types.real);
        let mut variables = Vec::new();
        for state in &it.states {
            let ty = match self.graph.ty(state.leaf) {
                Ty::Complex => self.numbers.complex,
                Ty::Bool => self.types.truth,
                Ty::Real | Ty::Loop => self.numbers.real,
            };
            let variable = self.body.variable(self.state_name(state.leaf), ty);
            let init = self.value(state.init)?;
            self.body.store(variable, init);
            variables.push(variable);
        }
        // last before the loop, so that the text can have it in the loop's head
        self.body.store(done, start);

        self.body.open();
        let now = self.body.load(done);
        // the count may be NaN: then there is no step
        let goes_on = self.binary(BinaryOperator::Less, now, count);
        let ends = self.unary(UnaryOperator::LogicalNot, goes_on);
        self.leave_if(ends);
        if let Some(Numbered { id, .. }) = numbered {
            // the variable has its name
            self.values[id.index()] = Some(self.widened(now)?);
            self.depths[id.index()] = 0;
        } else if let Some(counter) = plan.counter {
            let steps = self.widened(now)?;
            self.keep(counter, steps);
        }
        for (state, &variable) in it.states.iter().zip(&variables) {
            let value = self.body.load(variable);
            self.keep(state.leaf, value);
        }
        self.block(schedule, &plan.before)?;
        if let Some(until) = it.until {
            let ends = self.value(until)?;
            self.leave_if(ends);
        }
        self.block(schedule, &plan.after)?;
        for (state, &variable) in it.states.iter().zip(&variables) {
            let next = self.value(state.next)?;
            if next != self.value(state.leaf)? {
                self.body.store(variable, next);
            }
        }
        let body = self.body.close();
        self.body.open();
        let now = self.body.load(done);
        let one = self.body.literal(1.0);
        let next = self.binary(BinaryOperator::Add, now, one);
        self.body.store(done, next);
        let continuing = self.body.close();
        let of_text = plan.results.first().map(|&result| self.graph.span(result));
        let repeated = Statement::Loop {
            body,
            continuing,
            break_if: None,
        };
        self.body
            .statement_of(repeated, of_text.unwrap_or_default());
        self.forget(plan);
        self.results(plan, &variables);
        Ok(())
    }

    /// What the steps of the loop are numbered by, where its number of steps is known and they are used in no other way.
    fn numbered(&self, plan: &Plan) -> Option<Numbered> {
        let counter = plan.counter?;
        let is_user = |&id: &Id| self.is_live(id) && self.graph.node(id).args.contains(&counter);
        let mut users = self.graph.ids().filter(is_user);
        let (id, None) = (users.next()?, users.next()) else {
            return None;
        };
        let node = self.graph.node(id);
        let (Op::Apply(Prim::Add), &[a, b]) = (node.op, &*node.args) else {
            return None;
        };
        let first = self.graph.as_real(if a == counter { b } else { a })?;
        let count = self.graph.as_real(plan.it.count)?;
        let count = count.floor().clamp(0.0, f64::from(plan.it.limit));
        let is_exact = first.fract() == 0.0 && first.abs() < MOST_FIRST && node.ty == Ty::Real;
        #[allow(clippy::cast_possible_truncation, reason = "integers below 2²⁴")]
        is_exact.then_some(Numbered {
            id,
            first: first as f32,
            end: (first + count) as f32,
        })
    }

    /// The number of steps: rounded down, at most the limit; NaN stays NaN, which no number is less than.
    fn count(&mut self, plan: &Plan) -> Result<Handle<Expression>, LowerError> {
        let it = &plan.it;
        if let Some(count) = self.graph.as_real(it.count) {
            let count = count.floor().clamp(0.0, f64::from(it.limit));
            #[allow(
                clippy::cast_possible_truncation,
                reason = "an integer of at most 100,000"
            )]
            return Ok(self.body.literal(count as f32));
        }
        let count = self.value(it.count)?;
        // rounded down before it is narrowed, which could round up
        let floor = self.builtin(MathFunction::Floor, &[count])?;
        let floor = self.narrowed(floor)?;
        #[allow(
            clippy::cast_precision_loss,
            reason = "the limit is at most 100,000, which is exact"
        )]
        let limit = self.body.literal(it.limit as f32);
        let beyond = self.binary(BinaryOperator::Greater, floor, limit);
        let count = self.body.emit(Expression::Select {
            condition: beyond,
            accept: limit,
            reject: floor,
        });
        // else it would be written out in the condition, and computed in every step
        let named = &mut self.body.function.named_expressions;
        named.insert(count, "count".to_owned());
        Ok(count)
    }

    fn leave_if(&mut self, condition: Handle<Expression>) {
        let mut accept = Block::new();
        accept.push(Statement::Break, naga::Span::UNDEFINED);
        self.body.statement(Statement::If {
            condition,
            accept,
            reject: Block::new(),
        });
    }

    /// The value of a leaf during a step, under the user's name where it has one.
    fn keep(&mut self, leaf: Id, value: Handle<Expression>) {
        self.values[leaf.index()] = Some(value);
        if let Some(name) = self.graph.name(leaf) {
            let name = super::identifier(name);
            self.body.function.named_expressions.insert(value, name);
        }
    }

    /// What was computed in the steps does not hold outside of the loop.
    fn forget(&mut self, plan: &Plan) {
        let of_body = plan.before.iter().chain(&plan.after).copied();
        let leaves = plan.it.states.iter().map(|state| state.leaf);
        let inside: FxHashSet<Id> = of_body.chain(leaves).chain(plan.counter).collect();
        for id in &inside {
            self.values[id.index()] = None;
        }
        self.pairs.retain(|key, _| !inside.contains(&key.1));
    }

    fn results(&mut self, plan: &Plan, variables: &[Handle<Expression>]) {
        for &result in &plan.results {
            let leaf = self.graph.leaf_of_result(result);
            let places = plan.it.states.iter().zip(variables);
            let mut found = places.filter(|(state, _)| Some(state.leaf) == leaf);
            if let Some((_, &variable)) = found.next() {
                let value = self.body.load(variable);
                self.values[result.index()] = Some(value);
                self.depths[result.index()] = 0;
            }
        }
    }

    fn state_name(&self, leaf: Id) -> String {
        match (self.graph.name(leaf), self.graph.node(leaf).op) {
            (Some(name), _) => format!("{}_state", super::identifier(name)),
            (None, Op::State(_, k)) => format!("state{k}"),
            _ => "state".to_owned(),
        }
    }
}
