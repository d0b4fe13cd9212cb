//! The operands that begin with a token of their own.

use crate::ast::{Expr, UnaryOp};
use crate::cursor::{Node, Parser};
use crate::paste::is_conversion;
use crate::scope::Role;
use crate::token::TokenKind;

impl Parser<'_> {
    /// `primary = number | name | group | bars | conditional | piecewise`
    pub(crate) fn primary(&mut self) -> Node {
        match self.kind() {
            TokenKind::Number | TokenKind::Imaginary => self.number(),
            TokenKind::Name => self.name(),
            TokenKind::LParen => self.nested(Self::group),
            TokenKind::Bar => self.nested(Self::bars),
            TokenKind::If => self.nested(Self::conditional),
            TokenKind::LBrace => self.nested(Self::piecewise),
            _ => self.no_operand(),
        }
    }

    /// `number = NUMBER | IMAGINARY`
    fn number(&mut self) -> Node {
        let is_imaginary = self.at(TokenKind::Imaginary);
        let span = self.span();
        let value = self.value_of(self.spelling(span));
        self.bump();
        let expr = if is_imaginary {
            Expr::Imaginary(value)
        } else {
            Expr::Number(value)
        };
        self.node(expr, span)
    }

    /// `name = NAME | call | barred`
    fn name(&mut self) -> Node {
        let mut name = self.bump_name();
        let is_adjacent = name.span.end == self.span().start;
        let primes = self.primes();
        let opens = self.at(TokenKind::LParen);
        match self.role_of(&mut name) {
            Role::Unknown if opens && is_adjacent && primes == 0 && is_conversion(&name.text) => {
                self.conversion(&name)
            }
            Role::Function if self.at(TokenKind::Bar) && self.form_of(&name).is_none() => {
                self.barred(name, primes)
            }
            Role::Function => self.call(name, primes),
            Role::Unknown if self.is_foreign_loop(&name) => self.foreign_loop(&name),
            Role::Unknown if opens && (is_adjacent || primes > 0) => self.call(name, primes),
            _ => {
                if primes > 0 {
                    self.complain_no_function(&name);
                }
                let span = name.span;
                self.node(Expr::Name(name), span)
            }
        }
    }

    /// `group = "(" expr { "," expr } ")"`: brackets around one expression, a vector of two to four
    fn group(&mut self) -> Node {
        let opened = self.open();
        if self.at(TokenKind::RParen) {
            self.complain_empty_brackets(opened.span);
            self.close(&opened);
            let whole = opened.span.join(self.last_span());
            return self.error_node(whole);
        }
        let first = self.expr();
        if !self.separator(&opened) {
            let span = opened.span.join(self.last_span());
            return Node { id: first.id, span };
        }
        let mut items = vec![first.id, self.expr().id];
        while self.separator(&opened) {
            items.push(self.expr().id);
        }
        let span = opened.span.join(self.last_span());
        if items.len() > 4 {
            self.complain_long_vector(span, items.len());
            return self.error_node(span);
        }
        self.node(Expr::Vector(items), span)
    }

    /// `bars = "|" expr "|"`
    pub(crate) fn bars(&mut self) -> Node {
        let opening = self.bump();
        self.bars += 1;
        let mut arg = self.expr();
        self.bars = self.bars.saturating_sub(1);
        if !self.eat(TokenKind::Bar) {
            self.complain_missing_bar(opening);
        }
        arg.span = arg.span.join(self.last_span());
        self.unary(UnaryOp::Abs, arg, opening)
    }
}
