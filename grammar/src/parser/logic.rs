//! Logical operators and comparisons.

use crate::ast::{BinaryOp, CompareOp, Expr, UnaryOp};
use crate::cursor::{Node, Parser};
use crate::token::TokenKind;

impl Parser<'_> {
    /// `disjunction = conjunction { "or" conjunction }`
    #[inline(always)]
    pub(crate) fn disjunction(&mut self) -> Node {
        let mut lhs = self.conjunction();
        while self.eat(TokenKind::Or) {
            let rhs = self.conjunction();
            lhs = self.binary(BinaryOp::Or, lhs, rhs);
        }
        lhs
    }

    /// `conjunction = negation { "and" negation }`
    #[inline(always)]
    fn conjunction(&mut self) -> Node {
        let mut lhs = self.negation();
        while self.eat(TokenKind::And) {
            let rhs = self.negation();
            lhs = self.binary(BinaryOp::And, lhs, rhs);
        }
        lhs
    }

    /// `negation = "not" negation | comparison`
    #[inline(always)]
    pub(crate) fn negation(&mut self) -> Node {
        if !self.at(TokenKind::Not) {
            return self.comparison();
        }
        let operator = self.bump();
        let arg = self.nested(Self::negation);
        self.unary(UnaryOp::Not, arg, operator)
    }

    /// `comparison = sum { ( "<" | "<=" | ">" | ">=" | "==" | "!=" ) sum }`
    #[inline(always)]
    fn comparison(&mut self) -> Node {
        let first = self.sum();
        let mut rest = Vec::new();
        loop {
            let op = match self.kind() {
                TokenKind::Less => CompareOp::Less,
                TokenKind::LessEqual => CompareOp::LessEqual,
                TokenKind::Greater => CompareOp::Greater,
                TokenKind::GreaterEqual => CompareOp::GreaterEqual,
                TokenKind::EqualEqual => CompareOp::Equal,
                TokenKind::NotEqual => CompareOp::NotEqual,
                TokenKind::Equals => self.complain_equals(first),
                _ => break,
            };
            if self.is_abandoned() {
                return self.error_node(first.span);
            }
            self.bump();
            rest.push((op, self.sum().id));
        }
        if rest.is_empty() {
            return first;
        }
        let span = first.span.join(self.last_span());
        let first = first.id;
        self.node(Expr::Compare { first, rest }, span)
    }
}
