//! Sums, products, prefixes and powers.

use crate::ast::{BinaryOp, UnaryOp};
use crate::complaint::Division;
use crate::cursor::{Node, Parser};
use crate::token::TokenKind;

impl Parser<'_> {
    /// `sum = product { ( "+" | "-" ) product }`
    #[inline(always)]
    pub(crate) fn sum(&mut self) -> Node {
        let mut lhs = self.product();
        loop {
            let op = match self.kind() {
                TokenKind::Plus => BinaryOp::Add,
                TokenKind::Minus => BinaryOp::Sub,
                _ => return lhs,
            };
            self.bump();
            let rhs = self.product();
            lhs = self.binary(op, lhs, rhs);
        }
    }

    /// `product = prefix { ( "*" | "/" ) prefix | power }`
    fn product(&mut self) -> Node {
        let mut lhs = self.prefix();
        let mut division = Division::default();
        loop {
            let op = match self.kind() {
                TokenKind::Star => BinaryOp::Mul,
                TokenKind::Slash => BinaryOp::Div,
                _ if self.factor_follows() => BinaryOp::ImplicitMul,
                _ => break,
            };
            if op == BinaryOp::ImplicitMul {
                let rhs = self.power();
                division.multiplied_by(rhs.span);
                lhs = self.binary(op, lhs, rhs);
                continue;
            }
            self.bump();
            self.warn_of(&division);
            let rhs = self.prefix();
            division = Division::of(op, lhs.span, rhs.span);
            lhs = self.binary(op, lhs, rhs);
        }
        self.warn_of(&division);
        lhs
    }

    /// `prefix = ( "-" | "+" ) prefix | power`
    pub(crate) fn prefix(&mut self) -> Node {
        match self.kind() {
            TokenKind::Minus => {
                let operator = self.bump();
                let arg = self.nested(Self::prefix);
                self.unary(UnaryOp::Neg, arg, operator)
            }
            TokenKind::Plus => {
                let operator = self.bump();
                let arg = self.nested(Self::prefix);
                Node {
                    id: arg.id,
                    span: operator.join(arg.span),
                }
            }
            _ => self.power(),
        }
    }

    /// `power = root | postfix [ "^" prefix ]`
    #[inline(always)]
    fn power(&mut self) -> Node {
        if self.at(TokenKind::Root) {
            return self.root();
        }
        let base = self.postfix();
        if !self.eat(TokenKind::Caret) {
            return base;
        }
        let exponent = self.nested(Self::prefix);
        self.binary(BinaryOp::Pow, base, exponent)
    }

    /// `root = "√" prefix`
    fn root(&mut self) -> Node {
        let operator = self.bump();
        let arg = self.nested(Self::prefix);
        self.unary(UnaryOp::Sqrt, arg, operator)
    }
}
