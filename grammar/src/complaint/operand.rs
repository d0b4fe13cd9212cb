//! Missing operands, and numbers that are none.

use crate::ast::UnaryOp;
use crate::cursor::{Node, Parser};
use crate::token::TokenKind;
use crate::{Diagnostic, Span};

impl Parser<'_> {
    /// Stands for the operand that is not here.
    #[cold]
    pub(crate) fn no_operand(&mut self) -> Node {
        match self.kind() {
            TokenKind::Error => {
                let begins_notation = matches!(self.span().text(self.text), "∂" | "∫");
                self.skip_strays();
                if begins_notation {
                    // what follows is no formula: it has been said how to write it
                    let place = self.last_span();
                    self.abandon();
                    return self.error_node(place);
                }
                if self.operand_follows() {
                    return self.primary();
                }
                self.missing_node()
            }
            TokenKind::Not => {
                self.complain_misplaced_not();
                let operator = self.bump();
                let arg = self.nested(Self::negation);
                self.unary(UnaryOp::Not, arg, operator)
            }
            TokenKind::Bang => {
                self.complain_leading_bang();
                let operator = self.bump();
                while self.eat(TokenKind::Bang) {}
                let arg = self.nested(Self::prefix);
                self.error_node(operator.join(arg.span))
            }
            TokenKind::Param | TokenKind::Show => {
                self.complain_reserved();
                let word = self.bump();
                self.error_node(word)
            }
            TokenKind::Prime | TokenKind::Superscript | TokenKind::Dot => {
                self.complain_missing_operand();
                let mut place = self.bump();
                if self.text_of_dot(place) && self.at(TokenKind::Name) {
                    place = place.join(self.bump());
                }
                self.error_node(place)
            }
            _ => {
                self.complain_missing_operand();
                self.missing_node()
            }
        }
    }

    fn text_of_dot(&self, span: Span) -> bool {
        span.text(self.text) == "."
    }

    /// The empty place behind the last token, as an expression that could not be read.
    pub(crate) fn missing_node(&mut self) -> Node {
        let end = self.last_span().end;
        self.error_node(Span::new(end, end))
    }

    /// Whether an operand begins here.
    fn operand_follows(&self) -> bool {
        use TokenKind::{Bar, If, Imaginary, LBrace, LParen, Name, Number};
        match self.kind() {
            Name => self.ahead(1) != TokenKind::Equals,
            kind => matches!(kind, Number | Imaginary | LParen | Bar | If | LBrace),
        }
    }

    #[cold]
    fn complain_missing_operand(&mut self) {
        if self.is_hushed() {
            return;
        }
        let (before, here) = (self.behind(), self.kind());
        let last = self.last_span();
        let applies = before.is_infix() || matches!(before, TokenKind::Not | TokenKind::Root);
        let stands_behind = here.is_infix()
            || matches!(
                here,
                TokenKind::Prime | TokenKind::Superscript | TokenKind::Dot
            );
        let diagnostic = if applies && stands_behind {
            let signs = self.short(last.join(self.span()));
            if matches!(signs.as_str(), "->" | "=>") {
                self.complain_arrow(last);
                return;
            }
            let (first, second) = (self.quote(last), self.describe());
            let hint = match signs.as_str() {
                "<>" | "><" => "write `!=` for unequal",
                "=<" => "write `<=`",
                _ => "remove one of them, or write what stands between them",
            };
            let message = format!("missing operand between {first} and {second}");
            Diagnostic::error("missing-operand", last.join(self.span()), message)
                .with_label("two operators side by side")
                .with_hint(hint)
        } else if before == TokenKind::EqualEqual && here == TokenKind::Equals {
            let message = "`===` is no operator";
            Diagnostic::error("missing-operand", last.join(self.span()), message)
                .with_label("one sign too many")
                .with_hint("write `==` to compare")
        } else if before.is_infix() && here == TokenKind::Equals {
            let place = last.join(self.span());
            let message = format!("{} changes the value of a name", self.quote(place));
            Diagnostic::error("missing-operand", place, message)
                .with_label("a name keeps its value")
                .with_hint("write the new value where it is needed, or give it a name with `where`")
        } else if applies {
            let message = format!("missing operand after {}", self.quote(last));
            let operand = self.span_behind(1);
            let is_star = before == TokenKind::Star
                && operand.end == last.start
                && self.behind_by(1) == TokenKind::Name;
            let hint = if is_star {
                let name = self.short(operand);
                format!("write the operand; the conjugate of {name} is `conj({name})`")
            } else {
                "write the operand, or remove the operator".to_owned()
            };
            Diagnostic::error("missing-operand", last, message)
                .with_label("needs an operand on its right")
                .with_hint(hint)
        } else if stands_behind {
            let message = format!("missing operand before {}", self.describe());
            Diagnostic::error("missing-operand", self.span(), message)
                .with_label("needs an operand on its left")
                .with_hint("write the operand, or remove the operator")
        } else if before == TokenKind::End {
            self.complain_unexpected(None);
            return;
        } else {
            let message = format!("missing expression after {}", self.quote(last));
            let hint = match (before, here) {
                (TokenKind::Comma, TokenKind::RParen) => "remove the comma, or write what follows",
                (TokenKind::Comma, TokenKind::Comma) => "remove one of the commas",
                _ => "write the expression",
            };
            Diagnostic::error("missing-expression", last, message)
                .with_label(format!("expected an expression before {}", self.describe()))
                .with_hint(hint)
        };
        self.complain(diagnostic);
    }

    /// `f(x, y) -> x y`: the rest of the statement is left unread.
    #[cold]
    pub(crate) fn complain_arrow(&mut self, first: Span) {
        let arrow = first.join(self.span());
        let head = self.short(Span::new(self.first_span().start, first.start));
        self.bump();
        let value = self.short(self.rest());
        let hint = if let Some((name, list)) = head.split_once('=') {
            format!("write `{}{} = {value}`", name.trim(), list.trim())
        } else if head.contains(':') {
            "a function is `f(x) = …`; its types follow".to_owned()
        } else if head.starts_with('(') {
            format!("write `f{head} = {value}`")
        } else {
            format!("write `{head} = {value}`")
        };
        let message = format!("{} defines nothing", self.quote(arrow));
        self.report(
            Diagnostic::error(
                "foreign-arrow",
                self.first_span().join(self.rest()),
                message,
            )
            .with_label("a function is defined by `=`")
            .with_hint(hint),
        );
        self.abandon();
    }

    #[cold]
    fn complain_misplaced_not(&mut self) {
        self.complain(
            Diagnostic::error(
                "misplaced-not",
                self.span(),
                "`not` stands inside of a calculation",
            )
            .with_label("binds less tightly than what is before it")
            .with_hint("put brackets around it: `(not c)`"),
        );
    }

    #[cold]
    fn complain_leading_bang(&mut self) {
        self.complain(
            Diagnostic::error("leading-bang", self.span(), "`!` stands before its operand")
                .with_label("a factorial is written `n!`")
                .with_hint("write `not` for a negated condition"),
        );
    }

    /// The value of a number's text; complains where binary64 does not hold it.
    pub(crate) fn value_of(&mut self, text: &str) -> f64 {
        let digits = text.strip_suffix('i').unwrap_or(text);
        let value = digits.parse::<f64>().unwrap_or(f64::NAN);
        if value.is_infinite() {
            self.complain(
                Diagnostic::error("number-too-large", self.span(), "the number is too large")
                    .with_label("the largest is about 1.8e308")
                    .with_hint("write `inf` for infinity"),
            );
        } else if value == 0.0 {
            let mantissa = digits.split(['e', 'E']).next().unwrap_or(digits);
            if mantissa.contains(|c: char| matches!(c, '1'..='9')) {
                self.report(
                    Diagnostic::warning("number-too-small", self.span(), "the number is read as 0")
                        .with_label("the smallest is about 4.9e-324")
                        .with_hint("write `0`"),
                );
            }
        }
        value
    }
}
