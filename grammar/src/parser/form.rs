//! Sums, products, iterations and integrals: calls that name variables of their own.

use crate::ast::{Expr, ExprId, Method, Name, Range, SeriesKind};
use crate::cursor::{Node, Parser};
use crate::scope::Form;
use crate::token::TokenKind;

impl Parser<'_> {
    /// `series = "(" running { "," running } "," expr ")"`
    pub(crate) fn series(&mut self, kind: SeriesKind, callee: &Name) -> Node {
        let opened = self.open();
        let mut ranges = Vec::new();
        let mut more = true;
        while more && self.running_follows() {
            ranges.push(self.running());
            more = self.separator(&opened);
        }
        if ranges.is_empty() {
            let pieces = self.pieces(&opened);
            return self.foreign_form(Form::Series(kind), callee, &pieces);
        }
        let term = self.term(callee, &ranges, more, &opened);
        self.unbind_names(ranges.iter().map(|range| &range.name));
        let span = callee.span.join(self.last_span());
        self.node(Expr::Series { kind, ranges, term }, span)
    }

    /// `running = NAME "in" range`
    pub(crate) fn running(&mut self) -> Range {
        let name = self.bump_name();
        self.bump();
        let ends = self.range();
        let (lower, upper) =
            ends.unwrap_or_else(|| (self.missing_node().id, self.missing_node().id));
        self.bind_name(&name);
        Range { name, lower, upper }
    }

    /// `iteration = "(" expr "," state { "," state } "," expr { "," expr } [ [ "," ] "until" expr ] ")"`
    pub(crate) fn iteration(&mut self, callee: &Name) -> Node {
        let opened = self.open();
        let (count, mut more) = self.step_count(&opened);
        let mut states = Vec::new();
        while more && self.state_follows() {
            states.push(self.state());
            more = self.separator(&opened);
        }
        for (name, _) in &states {
            self.bind_name(name);
        }
        let mut steps = Vec::new();
        while more && !self.at(TokenKind::Until) {
            if self.state_follows() {
                self.late_state(&mut states);
            } else {
                steps.push(self.expr().id);
            }
            more = self.at(TokenKind::Until) || self.separator(&opened);
        }
        let until = (more && self.eat(TokenKind::Until)).then(|| self.expr().id);
        if until.is_some() && self.separator(&opened) {
            self.skip_behind_condition(&opened);
        }
        self.unbind_names(states.iter().map(|state| &state.0));
        let steps = self.steps_of(&states, steps);
        let span = callee.span.join(self.last_span());
        if !self.steps_fit(callee, count, &states, &steps) {
            return self.error_node(span);
        }
        let expr = Expr::Iterate {
            count,
            states,
            steps,
            until,
        };
        self.node(expr, span)
    }

    /// `state = NAME "=" disjunction`
    pub(crate) fn state(&mut self) -> (Name, ExprId) {
        let name = self.bump_name();
        self.bump();
        (name, self.disjunction().id)
    }

    /// `integration = "(" ( running "," expr | expr "," NAME "," expr "," expr ) ")"`
    pub(crate) fn integration(&mut self, method: Method, callee: &Name) -> Node {
        let opened = self.open();
        if !self.running_follows() {
            let pieces = self.pieces(&opened);
            return match self.integral_of(&pieces) {
                Some((body, range)) => {
                    let span = callee.span.join(self.last_span());
                    self.node(
                        Expr::Integral {
                            method,
                            body,
                            range,
                        },
                        span,
                    )
                }
                None => self.foreign_form(Form::Integral(method), callee, &pieces),
            };
        }
        let range = self.running();
        let more = self.separator(&opened);
        let body = self.term(callee, std::slice::from_ref(&range), more, &opened);
        self.unbind_names([&range.name]);
        let span = callee.span.join(self.last_span());
        self.node(
            Expr::Integral {
                method,
                body,
                range,
            },
            span,
        )
    }
}
