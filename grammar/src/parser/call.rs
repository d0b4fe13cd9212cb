//! Calls.

use crate::Span;
use crate::ast::{BinaryOp, Expr, ExprId, Name};
use crate::cursor::{Node, Parser};
use crate::token::TokenKind;

impl Parser<'_> {
    /// `call = NAME { "'" } [ SUPERSCRIPT | "^" NUMBER ] arguments`
    pub(crate) fn call(&mut self, callee: Name, primes: u32) -> Node {
        let exponent = if self.at(TokenKind::LParen) {
            None
        } else if self.function_is_raised(&callee) {
            self.eat(TokenKind::Caret);
            Some(self.raised())
        } else {
            return self.no_arguments(callee, primes);
        };
        let start = callee.span;
        let Some(args) = self.arguments(&callee.text) else {
            let whole = start.join(self.last_span());
            return self.error_node(whole);
        };
        let span = start.join(self.last_span());
        let expr = Expr::Call {
            callee: self.by_arguments(callee, args.len()),
            primes,
            args,
        };
        let call = self.node(expr, span);
        match exponent {
            Some(exponent) => self.binary(BinaryOp::Pow, call, exponent),
            None => call,
        }
    }

    /// `arguments = "(" [ ( expr | binding ) { "," ( expr | binding ) } ] ")"`; none where a binding was among them
    fn arguments(&mut self, callee: &str) -> Option<Vec<ExprId>> {
        if !self.enter_arguments() {
            return None;
        }
        let binds = self.scope.binds_in_arguments(callee);
        let takes_functions = self.scope.takes_functions(callee);
        let opened = self.open();
        let mut args = Vec::new();
        let mut bound = Vec::new();
        if self.at(TokenKind::RParen) {
            self.close(&opened);
        } else {
            loop {
                if binds && self.binding_follows() {
                    if bound.is_empty() {
                        self.complain_not_yet();
                    }
                    bound.push(self.binding());
                } else {
                    self.takes_functions = takes_functions;
                    args.push(self.expr().id);
                    self.takes_functions = false;
                }
                if !self.separator(&opened) {
                    break;
                }
            }
        }
        self.leave_arguments(&bound);
        bound.is_empty().then_some(args)
    }

    /// `binding = NAME "in" range | NAME "=" disjunction`
    fn binding(&mut self) -> Span {
        let name = self.span();
        self.bump();
        self.scope.bind(self.spelling(name));
        if self.eat(TokenKind::In) {
            self.range();
        } else {
            self.eat(TokenKind::Equals);
            self.disjunction();
        }
        name
    }
}
