//! Sums, products, iterations and integrals that are written in another way than ours.

use crate::ast::{BinaryOp, Expr, ExprId, Method, Name, Range};
use crate::cursor::{Node, Opened, Parser};
use crate::piece::Piece;
use crate::scope::Form;
use crate::stray::shorten;
use crate::{Diagnostic, Span};

impl Parser<'_> {
    /// Complains that the items of a form are not what it needs, and shows how they are written.
    #[cold]
    pub(crate) fn foreign_form(&mut self, form: Form, callee: &Name, pieces: &[Piece]) -> Node {
        let span = callee.span.join(self.last_span());
        if self.is_hushed() {
            return self.error_node(span);
        }
        let name = shorten(&callee.text);
        let takes_function =
            matches!(pieces, [Piece::Value(body), ..] if self.is_bare_function(*body));
        let guess = self.guess(pieces).filter(|_| !takes_function);
        let diagnostic = if matches!(form, Form::Integral(_)) {
            let example = guess.unwrap_or_else(|| self.guess_integral(pieces));
            Diagnostic::error(
                "bad-integral",
                span,
                format!("`{name}` needs an expression, its variable and both ends"),
            )
            .with_label("expected `expr, t, a, b`, or `t in a..b, expr`")
            .with_hint(format!("write `{name}({example})`"))
        } else {
            let hint = match guess {
                Some(example) => format!("write `{name}({example})`"),
                None => self.hint_for_plain(&name, pieces),
            };
            let message = format!("`{name}` without a range");
            Diagnostic::error("missing-range", span, message)
                .with_label("expected `k in 1..n` first")
                .with_hint(hint)
        };
        self.complain(diagnostic);
        self.error_node(span)
    }

    /// The items as they should be written: `k in a..b, term`.
    fn guess(&self, pieces: &[Piece]) -> Option<String> {
        let behind = pieces.get(1..).and_then(|rest| self.range_of(rest));
        let in_front = self.range_of(pieces);
        let (range, term) = match (pieces, behind, in_front) {
            ([Piece::Value(term), rest @ ..], Some((range, used)), _) if used == rest.len() => {
                (range, Some(*term))
            }
            ([Piece::Start(name, lower, None), Piece::Value(term)], ..) => {
                let range = format!("{} in {}..n", shorten(&name.text), self.short(*lower));
                (range, Some(*term))
            }
            (_, _, Some((range, used))) => match (pieces.get(used..), pieces) {
                (Some([Piece::Value(term)]), _) => (range, Some(*term)),
                // `sum(x, y, z)` rather adds three values.
                (Some([]), [_, Piece::Value(lower), _])
                    if !matches!(self.exprs[lower.id], Expr::Number(_)) =>
                {
                    return None;
                }
                (Some([]), _) => (range, None),
                _ => return None,
            },
            _ => return None,
        };
        let term = term.map_or_else(|| "term".to_owned(), |term| self.short(term.span));
        Some(format!("{range}, {term}"))
    }

    /// The range that the first items name in some other way, and how many they are.
    fn range_of(&self, pieces: &[Piece]) -> Option<(String, usize)> {
        let text = |node: &Node| self.short(node.span);
        let is_name =
            |node: &Node| self.bare_name(*node).is_some() && !self.is_bare_function(*node);
        let (name, lower, upper, used) = match pieces {
            [Piece::Running(range), ..] => {
                let [lower, upper] = [range.lower, range.upper].map(|id| self.short_expr(id));
                (shorten(&range.name.text), lower, upper, 1)
            }
            [Piece::Start(name, lower, Some(upper)), ..] => {
                let (lower, upper) = (self.short(*lower), self.short(*upper));
                (shorten(&name.text), lower, upper, 1)
            }
            [Piece::Start(name, lower, None), Piece::Value(upper), ..] => {
                let name = shorten(&name.text);
                (name, self.short(*lower), text(upper), 2)
            }
            [Piece::Value(name), Piece::Interval(lower, upper), ..] if is_name(name) => {
                (text(name), self.short(*lower), self.short(*upper), 2)
            }
            [
                Piece::Value(name),
                Piece::Value(lower),
                Piece::Value(upper),
                ..,
            ] if is_name(name) => (text(name), text(lower), text(upper), 3),
            [Piece::List(items), ..] => self.range_of_list(items)?,
            [Piece::Value(list), ..] => match &self.exprs[list.id] {
                Expr::Vector(items) => self.range_of_list(items)?,
                _ => return None,
            },
            _ => return None,
        };
        Some((format!("{name} in {lower}..{upper}"), used))
    }

    /// The range that `(k, a, b)` stands for, as one item.
    fn range_of_list(&self, items: &[ExprId]) -> Option<(String, String, String, usize)> {
        let [name, lower, upper] = *items else {
            return None;
        };
        let is_name = matches!(self.exprs[name], Expr::Name(_));
        let [name, lower, upper] = [name, lower, upper].map(|id| self.short_expr(id));
        is_name.then_some((name, lower, upper, 1))
    }

    /// The text of an expression, shortened.
    fn short_expr(&self, id: ExprId) -> String {
        self.short(self.exprs.span(id))
    }

    /// What may be meant by an integral without its variable or its ends.
    fn guess_integral(&self, pieces: &[Piece]) -> String {
        let text = |node: &Node| self.short(node.span);
        let values = values(pieces);
        let Some([body, rest @ ..]) = values.as_deref() else {
            return Form::Integral(Method::Closed).example().to_owned();
        };
        let is_function = self.is_bare_function(*body);
        let body = format!("{}{}", text(body), if is_function { "(t)" } else { "" });
        match rest {
            [] => format!("{body}, t, a, b"),
            [name] if self.bare_name(*name).is_some() => format!("{body}, {}, a, b", text(name)),
            [name, upper] if self.bare_name(*name).is_some() && !is_function => {
                format!("{body}, {}, a, {}", text(name), text(upper))
            }
            [lower, upper] => format!("{body}, t, {}, {}", text(lower), text(upper)),
            [_, lower, upper] if is_function => {
                format!("{body}, t, {}, {}", text(lower), text(upper))
            }
            _ => Form::Integral(Method::Closed).example().to_owned(),
        }
    }

    /// The advice where a series has values alone: `sum(x, y)`.
    fn hint_for_plain(&self, name: &str, pieces: &[Piece]) -> String {
        let example = format!("`{name}(k in 1..n, term)`");
        let sign = if matches!(name, "product" | "∏") {
            " * "
        } else {
            " + "
        };
        match values(pieces) {
            Some(values) if (2..=4).contains(&values.len()) => {
                let values: Vec<String> = values.iter().map(|node| self.short(node.span)).collect();
                format!("write `{}`, or {example} over a range", values.join(sign))
            }
            _ => format!("write {example}"),
        }
    }

    #[cold]
    pub(crate) fn complain_missing_term(&mut self, callee: &Name, ranges: &[Range]) {
        let name = shorten(&callee.text);
        let (Some(first), Some(last)) = (ranges.first(), ranges.last()) else {
            return;
        };
        let span = first.name.span.join(self.exprs.span(last.upper));
        let what = if matches!(self.scope.form(&callee.text), Some(Form::Integral(_))) {
            "an expression"
        } else {
            "a term"
        };
        let message = format!("`{name}` without {what}");
        let (shown, term) = match self.exprs[last.upper] {
            // `sum(k in 1..3 k)`: the comma is missing.
            Expr::Binary {
                op: BinaryOp::ImplicitMul,
                lhs,
                rhs,
            } => (
                self.short(first.name.span.join(self.exprs.span(lhs))),
                self.short_expr(rhs),
            ),
            _ => (self.short(span), format!("{}^2", shorten(&last.name.text))),
        };
        self.complain(
            Diagnostic::error("missing-term", span, message)
                .with_label(format!("expected `,` and {what} behind the range"))
                .with_hint(format!("add a term behind it: `{name}({shown}, {term})`")),
        );
    }

    #[cold]
    pub(crate) fn complain_second_term(
        &mut self,
        callee: &Name,
        term: Node,
        place: Span,
        more: &[Piece],
    ) {
        let name = shorten(&callee.text);
        let hint = match more {
            [Piece::Value(second)] => {
                let (first, second) = (self.short(term.span), self.short(second.span));
                format!("write `({first}, {second})` for a vector")
            }
            [Piece::Running(_), ..] => "write the ranges first, the outermost in front".to_owned(),
            _ => "put brackets around the components of a vector".to_owned(),
        };
        let message = format!("{} behind the term of `{name}`", self.quote(place));
        self.complain(
            Diagnostic::error("second-term", place, message)
                .with_label("the term is the last item")
                .with_hint(hint),
        );
    }

    #[cold]
    pub(crate) fn complain_missing_count(&mut self) {
        let (place, state) = if self.state_follows() {
            (self.span(), self.short(self.span()))
        } else {
            (self.last_span(), "z".to_owned())
        };
        self.complain(
            Diagnostic::error(
                "missing-count",
                place,
                "an iteration without its greatest number of steps",
            )
            .with_label("expected a number first")
            .with_hint(format!(
                "begin with a number: `iterate(100, {state} = …, step)`"
            )),
        );
    }

    /// A state behind a step.
    #[cold]
    pub(crate) fn late_state(&mut self, states: &mut Vec<(Name, ExprId)>) {
        let message = format!("the state {} stands behind a step", self.describe());
        self.complain(
            Diagnostic::error("state-after-step", self.span(), message)
                .with_label("a start, not a step")
                .with_hint("write `iterate(n, z = …, w = …, step of z, step of w)`"),
        );
        let state = self.state();
        self.bind_name(&state.0);
        states.push(state);
    }

    /// Items behind the condition of an iteration.
    #[cold]
    pub(crate) fn skip_behind_condition(&mut self, opened: &Opened) {
        let message = format!("{} behind the condition of `until`", self.describe());
        self.complain(
            Diagnostic::error("until-not-last", self.span(), message)
                .with_label("the condition is the last item")
                .with_hint("an iteration is `iterate(n, z = start, step until condition)`"),
        );
        self.skip_pieces(opened);
    }

    /// Whether an iteration has states, and as many steps; complains where not.
    pub(crate) fn steps_fit(
        &mut self,
        callee: &Name,
        count: ExprId,
        states: &[(Name, ExprId)],
        steps: &[ExprId],
    ) -> bool {
        if states.is_empty() {
            self.complain_missing_state(callee, count);
        } else if steps.is_empty() {
            self.complain_missing_step(callee, states);
        } else if states.len() != steps.len()
            && self.exprs.joint_step(steps, states.len()).is_none()
        {
            self.complain_step_count(states, steps);
        } else {
            return true;
        }
        false
    }

    #[cold]
    fn complain_missing_state(&mut self, callee: &Name, count: ExprId) {
        let message = "an iteration without a state";
        let count = match self.exprs[count] {
            Expr::Number(_) => self.short_expr(count),
            _ => "n".to_owned(),
        };
        self.complain(
            Diagnostic::error("missing-state", callee.span, message)
                .with_label("expected `name = start` behind the number of steps")
                .with_hint(format!(
                    "an iteration is `iterate({count}, z = start, step)`"
                )),
        );
    }

    #[cold]
    fn complain_missing_step(&mut self, callee: &Name, states: &[(Name, ExprId)]) {
        let names = self.names_of(states);
        let example: Vec<String> = states
            .iter()
            .take(3)
            .map(|state| format!("{}^2 + c", shorten(&state.0.text)))
            .collect();
        let message = format!("an iteration without the next value of {names}");
        self.complain(
            Diagnostic::error("missing-step", callee.span, message)
                .with_label("expected a step behind the states")
                .with_hint(format!("write it last, such as `{}`", example.join(", "))),
        );
    }

    #[cold]
    fn complain_step_count(&mut self, states: &[(Name, ExprId)], steps: &[ExprId]) {
        let place = |id: &ExprId| self.exprs.span(*id);
        let span = steps.iter().map(place).reduce(Span::join);
        let plural = |count: usize, noun: &str| {
            let ending = if count == 1 { "" } else { "s" };
            format!("{count} {noun}{ending}")
        };
        let message = format!(
            "{} and {}",
            plural(states.len(), "state"),
            plural(steps.len(), "step")
        );
        let hint = if states.len() == 1 {
            "name a state for each step, or put brackets around the components of a vector"
                .to_owned()
        } else {
            let names = self.names_of(states);
            format!("give one step for each of {names}, in this order")
        };
        self.complain(
            Diagnostic::error("step-count", span.unwrap_or_default(), message)
                .with_label("expected one step for each state")
                .with_hint(hint),
        );
    }

    /// The names of states, quoted.
    fn names_of(&self, states: &[(Name, ExprId)]) -> String {
        let mut names: Vec<String> = states
            .iter()
            .take(6)
            .map(|state| format!("`{}`", shorten(&state.0.text)))
            .collect();
        if states.len() > names.len() {
            names.push("…".to_owned());
        }
        names.join(", ")
    }
}

/// The items of a form if all of them are values.
fn values(pieces: &[Piece]) -> Option<Vec<Node>> {
    let value = |piece: &Piece| match piece {
        Piece::Value(node) => Some(*node),
        _ => None,
    };
    pieces.iter().map(value).collect()
}
