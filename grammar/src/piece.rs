//! Steps of sums, products, iterations and integrals that have no syntax of their own.

use crate::Span;
use crate::ast::{Expr, ExprId, Name, Range};
use crate::cursor::{Node, Opened, Parser};
use crate::scope::Role;
use crate::token::TokenKind;

/// An item in the brackets of a form, read before it is known what it is for.
pub(crate) enum Piece {
    /// `expr`
    Value(Node),
    /// `a..b`
    Interval(Span, Span),
    /// `k in a..b`
    Running(Range),
    /// `k = a`, `k = a..b`
    Start(Name, Span, Option<Span>),
    /// `{ k, a, b }`, which is no item of any form.
    List(Vec<ExprId>),
}

impl Parser<'_> {
    /// A name begins to hold.
    pub(crate) fn bind_name(&mut self, name: &Name) {
        self.scope.bind(self.spelling(name.span));
    }

    /// Names end to hold.
    pub(crate) fn unbind_names<'n>(&mut self, names: impl IntoIterator<Item = &'n Name>) {
        for name in names {
            self.scope.unbind(&name.text);
        }
    }

    /// Whether `name in` is here.
    pub(crate) fn running_follows(&self) -> bool {
        self.at(TokenKind::Name) && self.ahead(1) == TokenKind::In
    }

    /// Whether `name =` is here.
    pub(crate) fn state_follows(&self) -> bool {
        self.at(TokenKind::Name) && self.ahead(1) == TokenKind::Equals
    }

    /// Whether the point of `grad(f)(x, y)` follows, behind what has been read so far.
    pub(crate) fn point_follows(&self, callee: &Name, args: &[ExprId]) -> bool {
        let touches = self.last_span().end == self.span().start;
        let [only] = args else { return false };
        let Expr::Name(function) = &self.exprs[*only] else {
            return false;
        };
        touches
            && self.at(TokenKind::LParen)
            && self.scope.takes_point(&callee.text)
            && self.scope.role(&function.text) != Role::Value
    }

    /// The term of a form with ranges, and the end of its brackets; complains where there is none, or more than one.
    /// `more` says whether anything stands behind the ranges.
    pub(crate) fn term(
        &mut self,
        callee: &Name,
        ranges: &[Range],
        more: bool,
        opened: &Opened,
    ) -> ExprId {
        if !more {
            self.complain_missing_term(callee, ranges);
            return self.missing_node().id;
        }
        let term = self.expr();
        if self.separator(opened) {
            let place = self.span();
            let pieces = self.pieces(opened);
            self.complain_second_term(callee, term, place, &pieces);
        }
        term.id
    }

    /// The number of steps of an iteration, and whether more follows in its brackets.
    pub(crate) fn step_count(&mut self, opened: &Opened) -> (ExprId, bool) {
        if self.at(TokenKind::RParen) || self.state_follows() {
            let more = self.state_follows();
            if !more {
                self.close(opened);
            }
            self.complain_missing_count();
            return (self.missing_node().id, more);
        }
        let count = self.expr().id;
        (count, self.separator(opened))
    }

    /// The steps of the states: one bracketed list of as many items is that list.
    pub(crate) fn steps_of(&self, states: &[(Name, ExprId)], steps: Vec<ExprId>) -> Vec<ExprId> {
        if let [only] = steps[..]
            && let Expr::Vector(items) = &self.exprs[only]
            && states.len() > 1
            && items.len() == states.len()
        {
            return items.clone();
        }
        steps
    }

    /// Everything in the brackets of a form, up to their end.
    pub(crate) fn pieces(&mut self, opened: &Opened) -> Vec<Piece> {
        let mut pieces = Vec::new();
        if self.at(TokenKind::RParen) {
            self.close(opened);
            return pieces;
        }
        let layout = self.layout;
        let variable = layout.variable(self.position());
        let variable = variable.map(|name| self.token_text(name));
        if let Some(name) = variable {
            self.scope.bind(name);
        }
        self.takes_functions = true;
        pieces.push(self.piece());
        self.takes_functions = false;
        let mut more = self.separator(opened);
        if more {
            pieces.push(self.piece());
            more = self.separator(opened);
        }
        if let Some(name) = variable {
            self.scope.unbind(name);
        }
        while more {
            pieces.push(self.piece());
            more = self.separator(opened);
        }
        for piece in &pieces {
            if let Piece::Running(Range { name, .. }) | Piece::Start(name, ..) = piece {
                self.scope.unbind(&name.text);
            }
        }
        pieces
    }

    fn piece(&mut self) -> Piece {
        if self.running_follows() {
            return Piece::Running(self.running());
        }
        let name = self.state_follows().then(|| self.bump_name());
        if let Some(name) = name {
            self.bump();
            let value = self.disjunction().span;
            let upper = self.eat(TokenKind::DotDot).then(|| self.disjunction().span);
            self.bind_name(&name);
            return Piece::Start(name, value, upper);
        }
        if self.list_follows() {
            return Piece::List(self.list());
        }
        let value = self.expr();
        if self.eat(TokenKind::DotDot) {
            return Piece::Interval(value.span, self.disjunction().span);
        }
        Piece::Value(value)
    }

    /// Whether `{ name,` is here, as other languages write the range of a sum.
    fn list_follows(&self) -> bool {
        self.at(TokenKind::LBrace)
            && self.ahead(1) == TokenKind::Name
            && self.ahead(2) == TokenKind::Comma
    }

    /// `{ k, 1, 10 }`
    fn list(&mut self) -> Vec<ExprId> {
        let opened = self.open();
        let mut items = vec![self.expr().id];
        while self.separator(&opened) {
            items.push(self.expr().id);
        }
        items
    }

    /// Leaves out the items here and the end of their brackets.
    pub(crate) fn skip_pieces(&mut self, opened: &Opened) {
        let _ = self.pieces(opened);
    }

    /// The integrand and the range of `integral(expr, t, a, b)`.
    pub(crate) fn integral_of(&self, pieces: &[Piece]) -> Option<(ExprId, Range)> {
        let [
            Piece::Value(body),
            Piece::Value(variable),
            Piece::Value(lower),
            Piece::Value(upper),
        ] = pieces
        else {
            return None;
        };
        if self.is_bare_function(*body) {
            return None;
        }
        let name = self.bare_name(*variable)?;
        let (lower, upper) = (lower.id, upper.id);
        Some((body.id, Range { name, lower, upper }))
    }

    /// Whether an expression is the name of a function.
    pub(crate) fn is_bare_function(&self, node: Node) -> bool {
        let name = self.bare_name(node);
        name.is_some_and(|name| self.scope.role(&name.text) == Role::Function)
    }

    /// The name that an expression is, without brackets.
    pub(crate) fn bare_name(&self, node: Node) -> Option<Name> {
        match &self.exprs[node.id] {
            Expr::Name(name) if name.span == node.span => Some(name.clone()),
            _ => None,
        }
    }
}
