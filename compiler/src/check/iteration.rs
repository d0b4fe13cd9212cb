//! Series and iterations: from their syntax to loops.

use pullback_grammar::ast::{Expr, ExprId, Name, Range, SeriesKind};
use pullback_grammar::{Diagnostic, Span};
use smallvec::SmallVec;

use super::nesting::{Extent, open_param};
use super::suggest::{quoted, shortened};
use super::{Builder, MAX_STEPS, Record, Value};
use crate::ir::{Binder, Id, Loop, Op, Prim, State, Ty};
use crate::types::Type;

/// Greatest number of times that the steps of an iteration are built, until the types of its states are settled.
const MAX_ROUNDS: usize = 4;

/// The parts of [`Expr::Iterate`].
pub(super) struct Iteration<'a> {
    pub count: ExprId,
    pub states: &'a [(Name, ExprId)],
    pub steps: &'a [ExprId],
    pub until: Option<ExprId>,
}

/// How many steps a loop does.
#[derive(Clone, Copy)]
struct Steps {
    count: Id,
    limit: u32,
    /// Where this fails the result is NaN; `None` where it cannot fail.
    guard: Option<Id>,
}

/// The body of an iteration: for each state the leaf, the start and the next value.
struct Body {
    binder: Binder,
    leaves: Vec<Value>,
    starts: Vec<Value>,
    nexts: Vec<Value>,
    until: Value,
}

impl<'a> Builder<'a> {
    /// A series: one loop for each running variable, the first outermost.
    pub(super) fn series(&mut self, kind: SeriesKind, ranges: &'a [Range], term: ExprId) -> Value {
        let Some((range, inner)) = ranges.split_first() else {
            return self.expr(term);
        };
        let place = self.span(range.lower).join(self.span(range.upper));
        let (lower, upper) = (
            self.real(range.lower, "a range"),
            self.real(range.upper, "a range"),
        );
        let steps = match (lower, upper) {
            (Some(a), Some(b)) => {
                let count = self.terms(a, b);
                self.steps(count, place, range.upper)
            }
            _ => None,
        };
        let limit = steps.map_or(1, |s| s.limit);
        if steps.is_some() && !self.admits(own(limit), place) {
            return Value::Error;
        }
        let binder = self.graph.binder();
        let running = lower.map(|a| self.running(a, binder));
        if let Some(leaf) = running.filter(|&id| matches!(self.graph.node(id).op, Op::Counter(_))) {
            self.graph.set_name(leaf, &range.name.text);
        }
        let running = running.map_or(Value::Error, Value::Scalar);
        let before = self.nesting.enter(limit);
        self.bounds.limits.insert(binder, limit);
        let (depth, bound) = (self.scope.len(), self.bound());
        self.name_value(&range.name.text, &running);
        let seen_in = self.span(range.upper).join(self.span(term));
        self.bind_running(&range.name.text, running, seen_in);
        let mut value = self.series(kind, inner, term);
        self.scope.truncate(depth);
        self.release(bound, std::slice::from_mut(&mut value));
        let inside = self.nesting.leave(limit, before);
        match steps {
            Some(steps) => self.accumulate(kind, binder, steps, inside, (&value, term)),
            None => Value::Error,
        }
    }

    /// The number of terms of a range: floor(b - a) + 1.
    fn terms(&mut self, a: Id, b: Id) -> Id {
        // floor(b - 1) + 1 = floor(b), and a loop rounds its count down
        if self.graph.as_real(a) == Some(1.0) {
            return b;
        }
        let distance = match self.bounds.difference(&self.graph, b, a) {
            Some(distance) => self.graph.real(distance),
            None => self.graph.sub(b, a),
        };
        let whole = self.graph.apply(Prim::Floor, &[distance]);
        let one = self.graph.real(1.0);
        self.graph.add(whole, one)
    }

    /// The running variable: a + 0, a + 1, …
    fn running(&mut self, a: Id, binder: Binder) -> Id {
        let counter = self.graph.counter(binder);
        if self.graph.as_real(a) == Some(0.0) {
            return counter;
        }
        self.graph.add(a, counter)
    }

    /// The sum or product of the values of a term.
    fn accumulate(
        &mut self,
        kind: SeriesKind,
        binder: Binder,
        steps: Steps,
        inside: Extent,
        (value, term): (&Value, ExprId),
    ) -> Value {
        match value.ty(&self.graph) {
            None => return Value::Error,
            Some(Type::Bool) => {
                let span = self.span(term);
                return self.report(
                    Diagnostic::error("type-mismatch", span, "a condition cannot be summed up")
                        .with_label("this is a condition")
                        .with_hint(format!(
                            "to count where it holds, write `if {} then 1 else 0`",
                            shortened(&pullback_grammar::print_expr(&self.file.exprs, term))
                        )),
                );
            }
            Some(_) => {}
        }
        let (prim, neutral, name) = match kind {
            SeriesKind::Sum => (Prim::Add, 0.0, "sum"),
            SeriesKind::Product => (Prim::Mul, 1.0, "product"),
        };
        let mut states = SmallVec::new();
        for term in value.ids() {
            let ty = self.graph.ty(term);
            let leaf = self.graph.new_state(binder, ty);
            let init = match ty {
                Ty::Complex => self.graph.complex(neutral, 0.0),
                _ => self.graph.real(neutral),
            };
            let next = self.graph.apply(prim, &[leaf, term]);
            states.push(State { leaf, init, next });
        }
        self.name_states(name, value, states.iter().map(|s: &State| s.leaf));
        let results = self.repeat(binder, steps, None, states, inside);
        match value {
            Value::Vector(_) => Value::Vector(results),
            _ => results
                .first()
                .map_or(Value::Error, |&id| Value::Scalar(id)),
        }
    }

    /// Gives the states of a loop the user's name.
    fn name_states(&mut self, name: &str, value: &Value, leaves: impl Iterator<Item = Id>) {
        for (leaf, letter) in leaves.zip(["x", "y", "z", "w"]) {
            match value {
                Value::Vector(_) => self.graph.set_name(leaf, &format!("{name}_{letter}")),
                _ => self.graph.set_name(leaf, name),
            }
        }
    }

    /// An iteration: the final state with its number of steps, or the final states.
    pub(super) fn iteration(&mut self, it: &Iteration<'a>) -> Value {
        let count = self.real(it.count, "the number of steps");
        let place = self.span(it.count);
        let steps = count.and_then(|count| self.steps(count, place, it.count));
        let limit = steps.map_or(1, |s| s.limit);
        if steps.is_some() && !self.admits(own(limit), place) {
            return Value::Error;
        }
        let starts: Vec<Value> = it.states.iter().map(|state| self.start(state)).collect();
        let before = self.nesting.enter(limit);
        let body = self.body(it, starts, limit);
        let inside = self.nesting.leave(limit, before);
        match (steps, self.settled(it, body)) {
            (Some(steps), Some(body)) => self.finish(it, &body, steps, inside),
            _ => Value::Error,
        }
    }

    /// The value of a state at the start.
    fn start(&mut self, (name, value): &'a (Name, ExprId)) -> Value {
        let start = self.expr(*value);
        if start.ty(&self.graph) != Some(Type::Bool) {
            return start;
        }
        let span = self.span(*value);
        let message = format!("the state {} cannot be a condition", quoted(&name.text));
        self.report(
            Diagnostic::error("type-mismatch", span, message)
                .with_label("this is a condition")
                .with_hint(format!(
                    "write `if {} then 1 else 0` to keep a number",
                    shortened(&pullback_grammar::print_expr(&self.file.exprs, *value))
                )),
        )
    }

    /// Builds the steps, again with complex states in the place of real ones where the steps turn out complex.
    fn body(&mut self, it: &Iteration<'a>, mut starts: Vec<Value>, limit: u32) -> Body {
        let mut round = 1;
        loop {
            let found = self.diagnostics.len();
            let known = (self.calls.len(), self.constants.len());
            let body = self.round(it, starts, limit);
            let promoted = self.promoted(&body);
            if round == MAX_ROUNDS || promoted == body.starts {
                return body;
            }
            self.diagnostics.truncate(found);
            self.forget(known.0, known.1);
            starts = promoted;
            round += 1;
        }
    }

    fn round(&mut self, it: &Iteration<'a>, starts: Vec<Value>, limit: u32) -> Body {
        let binder = self.graph.binder();
        self.bounds.limits.insert(binder, limit);
        let depth = self.scope.len();
        let mut leaves = Vec::new();
        for ((name, _), start) in it.states.iter().zip(&starts) {
            let leaf = self.leaf_like(start, binder);
            self.name_states(&name.text, &leaf, leaf.ids().into_iter());
            leaves.push(leaf);
        }
        for ((name, _), leaf) in it.states.iter().zip(&leaves) {
            self.scope.push(&name.text, leaf.clone());
        }
        let nexts = match it.steps {
            [joint] if it.states.len() > 1 => self.items(*joint),
            steps => steps.iter().map(|&step| self.expr(step)).collect(),
        };
        let until = match it.until {
            Some(until) => self.ending(until),
            None => Value::Error,
        };
        self.scope.truncate(depth);
        Body {
            binder,
            leaves,
            starts,
            nexts,
            until,
        }
    }

    fn ending(&mut self, until: ExprId) -> Value {
        let value = self.expr(until);
        match &value {
            Value::Scalar(id) if self.graph.ty(*id) == Ty::Bool => value,
            _ => {
                let span = self.span(until);
                self.condition_expected(&value, span)
            }
        }
    }

    fn leaf_like(&mut self, start: &Value, binder: Binder) -> Value {
        match start {
            Value::Scalar(id) => {
                let ty = self.graph.ty(*id);
                Value::Scalar(self.graph.new_state(binder, ty))
            }
            Value::Vector(items) => {
                let leaves = items.iter().map(|_| self.graph.new_state(binder, Ty::Real));
                Value::Vector(leaves.collect())
            }
            Value::Record(_) | Value::Error => Value::Error,
        }
    }

    /// The starts, complex where a real state has a complex step.
    fn promoted(&mut self, body: &Body) -> Vec<Value> {
        let mut out = Vec::new();
        for (start, next) in body.starts.iter().zip(&body.nexts) {
            out.push(match (start, next) {
                (Value::Scalar(start), Value::Scalar(next))
                    if self.graph.ty(*next) == Ty::Complex =>
                {
                    Value::Scalar(self.graph.widen(*start))
                }
                _ => start.clone(),
            });
        }
        out
    }

    /// The body, where every step has the type of its state; reports those that have not.
    fn settled(&mut self, it: &Iteration<'a>, mut body: Body) -> Option<Body> {
        let mut fits = it.until.is_none() || body.until != Value::Error;
        let parts = body.starts.iter().zip(&mut body.nexts);
        let written = self.file.exprs.joint_step(it.steps, it.states.len());
        let written = written.unwrap_or(it.steps);
        for (((name, start), step), (first, next)) in it.states.iter().zip(written).zip(parts) {
            let (Some(was), Some(is)) = (first.ty(&self.graph), next.ty(&self.graph)) else {
                fits = false;
                continue;
            };
            match next {
                _ if was == is => {}
                Value::Scalar(id) if was == Type::Complex && is == Type::Real => {
                    *id = self.graph.widen(*id);
                }
                _ => {
                    self.unsettled(name, (*start, was), (*step, is));
                    fits = false;
                }
            }
        }
        let complete = body.nexts.len() == it.states.len();
        (fits && complete).then_some(body)
    }

    fn unsettled(&mut self, name: &Name, (start, was): (ExprId, Type), (step, is): (ExprId, Type)) {
        let hint = match (was, is) {
            (_, Type::Bool) => format!(
                "write `if {} then 1 else 0` to keep a number",
                shortened(&pullback_grammar::print_expr(&self.file.exprs, step))
            ),
            (Type::Real, Type::Vector(_)) => match &self.file.exprs[start] {
                Expr::Number(_) | Expr::Name(_) => {
                    let text = pullback_grammar::print_expr(&self.file.exprs, start);
                    format!("start with `{is}({})`", shortened(&text))
                }
                _ => format!("start with a vector such as `{is}(0)`"),
            },
            (Type::Vector(_), Type::Real) => format!("give every component: `{was}(…)`"),
            (Type::Vector(_), Type::Vector(_)) => {
                "give both the same number of components".to_owned()
            }
            (Type::Real, _) => "start with a complex number such as `0 + 0i`".to_owned(),
            _ => super::builtins::advice(is, matches!(was, Type::Vector(_))).to_owned(),
        };
        let (span, started) = (self.span(step), self.span(start));
        self.report(
            Diagnostic::error(
                "type-mismatch",
                span,
                format!(
                    "{} starts as {}, but a step makes it {}",
                    quoted(&name.text),
                    was.in_words(),
                    is.in_words()
                ),
            )
            .with_label(format!("this is {}", is.in_words()))
            .with_related(started, format!("this is {}", was.in_words()))
            .with_hint(hint),
        );
    }

    /// The loop, and its final states under their names.
    fn finish(&mut self, it: &Iteration<'a>, body: &Body, steps: Steps, inside: Extent) -> Value {
        let mut states: SmallVec<[State; 4]> = SmallVec::new();
        for ((leaf, start), next) in body.leaves.iter().zip(&body.starts).zip(&body.nexts) {
            for ((leaf, init), next) in leaf.ids().into_iter().zip(start.ids()).zip(next.ids()) {
                states.push(State { leaf, init, next });
            }
        }
        states.push(self.count_of(body.binder));
        let until = match body.until {
            Value::Scalar(id) => Some(id),
            _ => None,
        };
        let results = self.repeat(body.binder, steps, until, states, inside);
        let mut results = results.into_iter();
        let mut members = Vec::new();
        for ((name, _), leaf) in it.states.iter().zip(&body.leaves) {
            let value = match leaf {
                Value::Vector(items) => Value::Vector(results.by_ref().take(items.len()).collect()),
                _ => results.next().map_or(Value::Error, Value::Scalar),
            };
            members.push((name.text.clone(), value));
        }
        let value = match members.as_slice() {
            [only] => Some(only.1.clone()),
            _ => None,
        };
        if let Some(count) = results.next() {
            members.push(("count".to_owned(), Value::Scalar(count)));
        }
        Value::Record(Box::new(Record { value, members }))
    }

    /// The state that counts the steps.
    fn count_of(&mut self, binder: Binder) -> State {
        let leaf = self.graph.new_state(binder, Ty::Real);
        self.graph.set_name(leaf, "count");
        let (init, one) = (self.graph.real(0.0), self.graph.real(1.0));
        let next = self.graph.add(leaf, one);
        State { leaf, init, next }
    }

    /// Adds a loop, and gives its final states: constants where it depends on nothing, NaN where its number of
    /// steps is not admitted.
    fn repeat(
        &mut self,
        binder: Binder,
        steps: Steps,
        until: Option<Id>,
        states: SmallVec<[State; 4]>,
        inside: Extent,
    ) -> SmallVec<[Id; 4]> {
        let mut results: SmallVec<[Id; 4]> = states.iter().map(|state| state.init).collect();
        if steps.limit > 0 {
            let leaves: SmallVec<[Id; 4]> = states.iter().map(|state| state.leaf).collect();
            let repeated = self.graph.repeat(&Loop {
                binder,
                count: steps.count,
                limit: steps.limit,
                until,
                states,
            });
            results = leaves
                .iter()
                .map(|&leaf| self.graph.result(repeated, leaf))
                .collect();
            let cost = u64::from(steps.limit).saturating_mul(inside.steps);
            if let Some(constants) = self.folding.fold(&mut self.graph, &results, cost) {
                results = constants;
            }
        }
        let Some(guard) = steps.guard else {
            return results;
        };
        for result in &mut results {
            let nan = match self.graph.ty(*result) {
                Ty::Complex => self.graph.complex(f64::NAN, f64::NAN),
                _ => self.graph.real(f64::NAN),
            };
            *result = self.graph.apply(Prim::Select, &[guard, *result, nan]);
        }
        results
    }

    /// An expression that must be real; `what` says what it is of.
    fn real(&mut self, id: ExprId, what: &str) -> Option<Id> {
        let value = self.expr(id);
        let ty = value.ty(&self.graph)?;
        if let (Value::Scalar(id), Type::Real) = (&value, ty) {
            return Some(*id);
        }
        let span = self.span(id);
        let hint = self.advice_at(ty, false, span);
        self.report(
            Diagnostic::error(
                "type-mismatch",
                span,
                format!(
                    "{what} must be a real number, and this is {}",
                    ty.in_words()
                ),
            )
            .with_hint(hint),
        );
        None
    }

    /// How many steps a loop does at most; reports where that is not known, or too many.
    fn steps(&mut self, count: Id, span: Span, written: ExprId) -> Option<Steps> {
        if let Some(value) = self.graph.as_real(count) {
            let never = self.graph.truth(false);
            let limit = self.limit(value.floor(), span)?;
            return Some(Steps {
                count,
                limit,
                guard: value.is_nan().then_some(never),
            });
        }
        let stated = self.bounds.of(&self.graph, count, true);
        if stated.hi == f64::INFINITY {
            self.unbounded(count, span, written);
            return None;
        }
        // in f32 a count can come out above its maximum by rounding: 100 · 0.29 is 29, not 28.999…
        let rounding = 4e-6 * stated.hi.abs();
        let limit = self.limit((stated.hi + rounding).floor(), span)?;
        let sure = self.bounds.of(&self.graph, count, false);
        let beyond = f64::from(limit) + 1.0;
        let guard = (sure.nan || sure.hi >= beyond).then(|| {
            let beyond = self.graph.real(beyond);
            self.graph.apply(Prim::Less, &[count, beyond])
        });
        Some(Steps {
            count,
            limit,
            guard,
        })
    }

    /// A greatest number of steps as an integer; negative and NaN are none.
    fn limit(&mut self, steps: f64, span: Span) -> Option<u32> {
        if steps > f64::from(MAX_STEPS) {
            let message = if steps.is_infinite() {
                "a loop cannot have infinitely many steps".to_owned()
            } else {
                let steps = crate::numeral::Numeral(steps);
                format!("up to {steps} steps are more than {MAX_STEPS}")
            };
            self.report(
                Diagnostic::error("too-many-steps", span, message)
                    .with_hint(format!("take at most {MAX_STEPS}")),
            );
            return None;
        }
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "at most MAX_STEPS; a cast takes negative numbers and NaN to 0"
        )]
        Some(steps as u32)
    }

    fn unbounded(&mut self, count: Id, span: Span, written: ExprId) {
        let has_range = |k: u16| {
            let range = self.bounds.params.get(usize::from(k));
            range.is_some_and(Option::is_some)
        };
        let open = open_param(&self.graph, count, has_range);
        let mut params = self.symbols.params.values();
        let param = open.and_then(|k| params.find(|param| param.0 == k));
        let problem = Diagnostic::error(
            "unbounded-loop",
            span,
            "it is not known how many steps this has at most",
        )
        .with_label("has no maximum");
        let text = pullback_grammar::print_expr(&self.file.exprs, written);
        let problem = match param {
            Some((_, param)) => problem
                .with_related(param.name.span, "this parameter has no range")
                .with_hint(format!(
                    "give the parameter a range: `param {} = … in 0..100`",
                    shortened(&param.name.text)
                )),
            None => problem.with_hint(format!(
                "state a maximum: `min({}, 1000)`",
                shortened(&text)
            )),
        };
        self.report(problem);
    }
}

fn own(limit: u32) -> Extent {
    Extent {
        steps: u64::from(limit),
        depth: 1,
    }
}
