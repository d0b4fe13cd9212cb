//! Steps of the productions that build nodes or look at names, and have no syntax of their own.

use std::ops::Range;

use crate::Span;
use crate::ast::{BinaryOp, Expr, Name, UnaryOp};
use crate::cursor::{Node, Parser};
use crate::scope::{FREE_VARIABLES, Role};
use crate::token::TokenKind;

impl Parser<'_> {
    pub(crate) fn unary(&mut self, op: UnaryOp, arg: Node, operator: Span) -> Node {
        let span = operator.join(arg.span);
        self.node(Expr::Unary { op, arg: arg.id }, span)
    }

    pub(crate) fn binary(&mut self, op: BinaryOp, lhs: Node, rhs: Node) -> Node {
        let span = lhs.span.join(rhs.span);
        let (lhs, rhs) = (lhs.id, rhs.id);
        self.node(Expr::Binary { op, lhs, rhs }, span)
    }

    /// The exponent here, a superscript or a number.
    pub(crate) fn raised(&mut self) -> Node {
        let text = self.span().text(self.text);
        let is_negative = text.starts_with('⁻');
        let digits: String = text.chars().filter_map(plain_digit).collect();
        let value = self.value_of(&digits);
        let span = self.bump();
        let node = self.node(Expr::Number(value), span);
        if is_negative {
            self.unary(UnaryOp::Neg, node, span)
        } else {
            node
        }
    }

    /// The name here; the token is known to be one.
    pub(crate) fn bump_name(&mut self) -> Name {
        let span = self.bump();
        Name {
            text: self.spelling(span).to_owned(),
            span,
        }
    }

    /// What a name of the text stands for here.
    pub(crate) fn role_of_ours(&mut self, name: &Name) -> Role {
        let text = self.spelling(name.span);
        self.scope.role_of_text(text)
    }

    /// Goes past the primes here and counts them.
    pub(crate) fn primes(&mut self) -> u32 {
        let mut primes = 0_u32;
        while self.eat(TokenKind::Prime) {
            primes = primes.saturating_add(1);
        }
        primes
    }

    /// Whether `²(` or `^2(` is here, which squares the value of the function before it.
    pub(crate) fn function_is_raised(&mut self, callee: &Name) -> bool {
        let (kind, next) = (self.kind(), self.ahead(1));
        if kind == TokenKind::Superscript && next == TokenKind::LParen {
            if self.span().text(self.text) == "⁻¹" {
                let place = self.span();
                self.complain_inverse(callee, place);
            }
            return true;
        }
        let is_power = kind == TokenKind::Caret
            && next == TokenKind::Number
            && self.ahead(2) == TokenKind::LParen;
        if is_power {
            return true;
        }
        if kind == TokenKind::Caret && next == TokenKind::Minus {
            let exponent = self.span_ahead(2);
            if exponent.text(self.text) == "1" && self.ahead(3) == TokenKind::LParen {
                let place = self.span().join(exponent);
                self.complain_inverse(callee, place);
                self.bump();
                self.bump();
                return true;
            }
        }
        false
    }

    /// A function's name that is not called: allowed where the whole argument is that name.
    pub(crate) fn no_arguments(&mut self, callee: Name, primes: u32) -> Node {
        let before = self.behind_by(1 + primes as usize);
        let is_whole = matches!(
            before,
            TokenKind::LParen | TokenKind::Comma | TokenKind::Equals
        ) && matches!(
            self.kind(),
            TokenKind::Comma | TokenKind::RParen | TokenKind::RBrace | TokenKind::End
        );
        let span = callee.span;
        if self.takes_functions && is_whole && primes == 0 {
            return self.node(Expr::Name(callee), span);
        }
        self.complain_not_called(&callee, primes);
        self.error_node(span)
    }

    /// Whether what is here multiplies what is before it without a sign; complains where a sign is needed.
    pub(crate) fn factor_follows(&mut self) -> bool {
        self.skip_strays();
        match self.kind() {
            TokenKind::LParen | TokenKind::Root => true,
            TokenKind::Name => self.ahead(1) != TokenKind::Equals,
            TokenKind::Bar => self.bars == 0,
            // `if c { a } else { b }`: the missing `then` is the one thing to complain about.
            TokenKind::LBrace if self.in_condition => false,
            TokenKind::Number
            | TokenKind::Imaginary
            | TokenKind::If
            | TokenKind::LBrace
            | TokenKind::Not => {
                self.complain_missing_operator();
                true
            }
            _ => false,
        }
    }

    /// The locals of the expression that begins at token `start` begin to hold.
    pub(crate) fn bind_locals(&mut self, start: usize) {
        let layout = self.layout;
        for name in layout.locals(start, 0) {
            self.scope.bind(self.token_text(name));
        }
    }

    /// The locals at the tokens `names` of the expression that began at token `start` end to hold.
    pub(crate) fn unbind_locals(&mut self, start: usize, names: Range<usize>) {
        let layout = self.layout;
        let ended = layout.locals(start, names.start);
        for name in ended.take_while(|name| *name < names.end) {
            self.scope.unbind(self.token_text(name));
        }
    }

    /// The variables of a bare formula begin to hold.
    pub(crate) fn bind_free_variables(&mut self) {
        for name in FREE_VARIABLES {
            if !self.scope.defines_function(name) {
                self.scope.bind(name);
            }
        }
    }

    /// The variables of a bare formula end to hold.
    pub(crate) fn unbind_free_variables(&mut self) {
        for name in FREE_VARIABLES {
            self.scope.unbind(name);
        }
    }

    /// The functions and constants that the statements define are known from the beginning.
    pub(crate) fn collect_definitions(&mut self) {
        use crate::layout::StatementKind::{Constant, Function, Param};
        let layout = self.layout;
        for statement in &layout.statements {
            let name = self.token_text(statement.head);
            match statement.kind {
                Function => self.scope.define_function(name),
                Constant => self.scope.define_constant(name),
                Param => {
                    let name = self.token_text(statement.head + 1);
                    self.scope.define_constant(name);
                }
                _ => {}
            }
        }
    }
}

/// The digit that a superscript stands for.
fn plain_digit(c: char) -> Option<char> {
    Some(match c {
        '0'..='9' | '.' | 'e' | 'E' | '+' | '-' => c,
        '¹' => '1',
        '²' => '2',
        '³' => '3',
        '⁰' => '0',
        '⁴'..='⁹' => char::from(b'4' + u8::try_from(u32::from(c) - u32::from('⁴')).ok()?),
        _ => return None,
    })
}
