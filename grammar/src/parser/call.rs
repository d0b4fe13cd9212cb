//! Calls.

use crate::ast::{BinaryOp, Expr, ExprId, Name};
use crate::cursor::{Node, Parser};
use crate::scope::Form;
use crate::token::TokenKind;

impl Parser<'_> {
    /// `call = NAME { "'" } [ SUPERSCRIPT | "^" NUMBER ] ( arguments [ arguments ] | series | iteration | integration )`
    pub(crate) fn call(&mut self, callee: Name, primes: u32) -> Node {
        let exponent = if self.at(TokenKind::LParen) {
            None
        } else if self.function_is_raised(&callee) {
            self.eat(TokenKind::Caret);
            Some(self.raised())
        } else {
            return self.no_arguments(callee, primes);
        };
        if !self.enter_arguments() {
            let whole = callee.span.join(self.last_span());
            return self.error_node(whole);
        }
        let form = self.form_of(&callee);
        if form.is_some() && primes > 0 {
            self.complain_prime_of_form(&callee);
        }
        let call = match form {
            Some(Form::Series(kind)) => self.series(kind, &callee),
            Some(Form::Iterate) => self.iteration(&callee),
            Some(Form::Integral(method)) => self.integration(method, &callee),
            None => {
                let mut args = self.arguments(&callee.text);
                if self.point_follows(&callee, &args) {
                    args.extend(self.arguments(""));
                    self.check_point(&callee, &args);
                }
                let span = callee.span.join(self.last_span());
                let expr = Expr::Call {
                    callee: self.by_arguments(callee, args.len()),
                    primes,
                    args,
                };
                self.node(expr, span)
            }
        };
        self.ascend();
        match exponent {
            Some(exponent) => self.binary(BinaryOp::Pow, call, exponent),
            None => call,
        }
    }

    /// `barred = NAME { "'" } bars`: `log|x|` is `log(|x|)`; what a power behind it would mean is not clear
    pub(crate) fn barred(&mut self, callee: Name, primes: u32) -> Node {
        let arg = self.nested(Self::bars);
        if matches!(
            self.kind(),
            TokenKind::Caret | TokenKind::Superscript | TokenKind::Bang
        ) {
            self.complain_power_of_bars(&callee, arg.span);
        }
        let span = callee.span.join(arg.span);
        let args = vec![arg.id];
        self.node(
            Expr::Call {
                callee,
                primes,
                args,
            },
            span,
        )
    }

    /// `arguments = "(" [ expr { "," expr } ] ")"`
    fn arguments(&mut self, callee: &str) -> Vec<ExprId> {
        let opened = self.open();
        let mut args = Vec::new();
        if self.at(TokenKind::RParen) {
            self.close(&opened);
            return args;
        }
        self.takes_functions = self.scope.takes_function(callee);
        loop {
            args.push(self.expr().id);
            self.takes_functions = false;
            if !self.separator(&opened) {
                return args;
            }
        }
    }
}
