//! Statements.

use crate::Span;
use crate::ast::{Constant, ExprId, Formal, Formula, Function, Item, Param};
use crate::cursor::Parser;
use crate::layout::{Statement, StatementKind};
use crate::token::TokenKind;

impl Parser<'_> {
    /// `file = { statement }`
    pub(crate) fn file(&mut self) -> Vec<Item> {
        let layout = self.layout;
        let statements = layout.statements.iter();
        statements.map(|found| self.statement(found)).collect()
    }

    /// `statement = function | constant | param | show | formula`
    fn statement(&mut self, found: &Statement) -> Item {
        self.enter(found);
        let start = self.span();
        self.skip_foreign_words(found.head);
        let mut item = match found.kind {
            StatementKind::Function => Item::Function(self.function()),
            StatementKind::Constant => Item::Constant(self.constant()),
            StatementKind::Param => Item::Param(self.param()),
            StatementKind::Show => Item::Show(self.show()),
            StatementKind::Formula => Item::Formula(self.formula()),
        };
        self.skip_leftovers();
        let whole = self.spread(found).join(start.join(self.last_span()));
        *match &mut item {
            Item::Function(item) => &mut item.span,
            Item::Constant(item) => &mut item.span,
            Item::Param(item) => &mut item.span,
            Item::Show(item) => &mut item.span,
            Item::Formula(item) => &mut item.span,
        } = whole;
        item
    }

    /// `function = NAME "(" [ formal { "," formal } ] ")" "=" expr`
    fn function(&mut self) -> Function {
        let name = self.name_to_define();
        let opened = self.open();
        let mut params = Vec::new();
        if self.at(TokenKind::RParen) {
            self.close(&opened);
        } else {
            loop {
                params.extend(self.formal());
                if !self.missing_comma_between_parameters() && !self.separator(&opened) {
                    break;
                }
            }
        }
        self.expect_equals();
        for param in &params {
            self.scope.bind(self.spelling(param.name.span));
        }
        let body = self.expr();
        for param in &params {
            self.scope.unbind(&param.name.text);
        }
        Function {
            name,
            params,
            body: body.id,
            span: Span::default(),
        }
    }

    /// `formal = NAME [ ":" NAME ]`
    fn formal(&mut self) -> Option<Formal> {
        let Some(name) = self.expect_parameter() else {
            // the name in `f(2x)` is one all the same
            let name = (self.at(TokenKind::Number) || self.at(TokenKind::Minus))
                && self.ahead(1) == TokenKind::Name;
            if !name {
                self.skip_to_separator();
                return None;
            }
            self.bump();
            let name = self.bump_name();
            self.skip_to_separator();
            return Some(Formal { name, ty: None });
        };
        let ty = if self.eat(TokenKind::Colon) {
            self.expect_type()
        } else {
            None
        };
        Some(Formal { name, ty })
    }

    /// `constant = NAME "=" expr`
    fn constant(&mut self) -> Constant {
        let name = self.name_to_define();
        self.expect_equals();
        let mut value = self.expr();
        if self.is_abandoned() {
            value = self.error_node(value.span);
        }
        Constant {
            name,
            value: value.id,
            span: Span::default(),
        }
    }

    /// `param = "param" NAME "=" disjunction [ "in" range ]`
    fn param(&mut self) -> Param {
        self.bump();
        let name = self.name_to_define();
        let default = self.expect_default(&name).id;
        let range = if self.eat(TokenKind::In) {
            self.range()
        } else {
            None
        };
        Param {
            name,
            default,
            range,
            span: Span::default(),
        }
    }

    /// `range = disjunction ".." disjunction`
    pub(crate) fn range(&mut self) -> Option<(ExprId, ExprId)> {
        let lower = self.disjunction();
        if !self.eat(TokenKind::DotDot) {
            self.complain_bad_range(lower);
            return None;
        }
        Some((lower.id, self.disjunction().id))
    }

    /// `formula = expr`
    fn formula(&mut self) -> Formula {
        self.bind_free_variables();
        let mut body = self.expr();
        if self.is_abandoned() {
            // what is wrong has been said; its names need not mean anything
            body = self.error_node(body.span);
        }
        self.unbind_free_variables();
        Formula {
            body: body.id,
            span: Span::default(),
        }
    }
}
