//! What stands behind its operand.

use crate::ast::{BinaryOp, Expr, UnaryOp};
use crate::cursor::{Node, Parser};
use crate::token::TokenKind;

impl Parser<'_> {
    /// `postfix = primary { "!" | SUPERSCRIPT | component }`
    #[inline(always)]
    pub(crate) fn postfix(&mut self) -> Node {
        let mut node = self.primary();
        loop {
            match self.kind() {
                TokenKind::Bang => {
                    let operator = self.bump();
                    node = self.unary(UnaryOp::Factorial, node, operator);
                }
                TokenKind::Superscript => {
                    let exponent = self.raised();
                    node = self.binary(BinaryOp::Pow, node, exponent);
                }
                TokenKind::Dot => node = self.component(node),
                TokenKind::Prime => self.complain_stray_prime(),
                _ => return node,
            }
        }
    }

    /// `component = "." NAME`
    fn component(&mut self, base: Node) -> Node {
        self.bump();
        let Some(field) = self.expect_component() else {
            return base;
        };
        let span = base.span.join(field.span);
        let base = base.id;
        self.node(Expr::Member { base, field }, span)
    }
}
