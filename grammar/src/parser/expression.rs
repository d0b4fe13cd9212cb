//! Expressions with local names, and the conditional forms.

use crate::ast::{Expr, ExprId, Local};
use crate::cursor::{Node, Parser};
use crate::token::TokenKind;

impl Parser<'_> {
    /// `expr = disjunction { "where" local { "," local } }`
    pub(crate) fn expr(&mut self) -> Node {
        let start = self.position();
        self.bind_locals(start);
        let mut node = self.disjunction();
        let mut ended = start;
        while self.eat(TokenKind::Where) {
            // a local is no argument
            self.takes_functions = false;
            let mut locals = Vec::new();
            loop {
                locals.extend(self.local());
                if !self.another_local() {
                    break;
                }
            }
            let span = node.span.join(self.last_span());
            let body = node.id;
            node = self.node(Expr::Where { body, locals }, span);
            // The locals of the next `where` do not see those of this one.
            self.unbind_locals(start, ended..self.position());
            ended = self.position();
        }
        self.unbind_locals(start, ended..usize::MAX);
        node
    }

    /// `local = NAME [ "." NAME ] "=" disjunction`
    fn local(&mut self) -> Option<Local> {
        let (name, field) = self.expect_local()?;
        let value = self.disjunction().id;
        Some(Local { name, field, value })
    }

    /// `conditional = "if" disjunction "then" disjunction "else" disjunction`
    pub(crate) fn conditional(&mut self) -> Node {
        let opening = self.bump();
        let outer = std::mem::replace(&mut self.in_condition, true);
        let mut cond = self.disjunction();
        if self.at(TokenKind::In) {
            cond = self.range_as_condition(cond);
        }
        self.in_condition = outer;
        if self.is_foreign_conditional(opening, cond) {
            return self.error_node(opening.join(self.last_span()));
        }
        self.expect_then(opening);
        let then = self.disjunction();
        let otherwise = if self.expect_else(opening) {
            self.disjunction()
        } else {
            self.missing_node()
        };
        let span = opening.join(self.last_span());
        let expr = Expr::If {
            cond: cond.id,
            then: then.id,
            otherwise: otherwise.id,
        };
        self.node(expr, span)
    }

    /// `piecewise = "{" arm { "," arm } [ "," ] "}"`
    pub(crate) fn piecewise(&mut self) -> Node {
        let opened = self.open();
        let mut arms = Vec::new();
        let mut otherwise = None;
        if self.at(TokenKind::RBrace) {
            self.complain_empty_piecewise(opened.span);
            self.close(&opened);
            let whole = opened.span.join(self.last_span());
            return self.error_node(whole);
        }
        if self.is_foreign_list(&opened) {
            return self.error_node(opened.span.join(self.last_span()));
        }
        loop {
            if otherwise.is_some() {
                self.complain_after_else();
            }
            match self.arm() {
                (Some(cond), value) => arms.push((cond, value)),
                (None, value) => otherwise = Some(value),
            }
            if !self.separator(&opened) {
                break;
            }
            if self.at(TokenKind::RBrace) {
                self.close(&opened);
                break;
            }
        }
        let span = opened.span.join(self.last_span());
        self.node(Expr::Piecewise { arms, otherwise }, span)
    }

    /// `arm = ( expr | "else" ) ":" expr`
    fn arm(&mut self) -> (Option<ExprId>, ExprId) {
        let start = self.span();
        let cond = if self.eat(TokenKind::Else) {
            None
        } else {
            Some(self.expr().id)
        };
        if !self.eat(TokenKind::Colon) {
            self.complain_missing_colon(cond.is_none(), start);
            return (cond, self.missing_node().id);
        }
        (cond, self.expr().id)
    }
}
