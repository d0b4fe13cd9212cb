//! Names where names are wanted, and the signs behind them.

use crate::Diagnostic;
use crate::Span;
use crate::ast::{Expr, ExprId, Name};
use crate::cursor::{Node, Parser};
use crate::stray::shorten;
use crate::token::TokenKind;

impl Parser<'_> {
    #[cold]
    pub(crate) fn complain_reserved(&mut self) {
        let message = format!("{} is a reserved word", self.describe());
        self.complain(
            Diagnostic::error("reserved-word", self.span(), message)
                .with_label("cannot be a name")
                .with_hint("choose another name"),
        );
    }

    /// A name that stands for one that is missing.
    fn no_name(&mut self) -> Name {
        let end = self.last_span().end;
        Name {
            text: String::new(),
            span: Span::new(end, end),
        }
    }

    /// The name that a statement defines.
    pub(crate) fn name_to_define(&mut self) -> Name {
        self.skip_strays();
        let name = if self.at(TokenKind::Name) {
            self.bump_name()
        } else if self.kind().is_keyword() {
            self.complain_reserved();
            self.bump_name()
        } else {
            let message = format!("missing name before {}", self.describe());
            let span = self.span();
            self.complain(
                Diagnostic::error("missing-name", span, message)
                    .with_label("expected a name")
                    .with_hint("a slider is `param name = value in lo..hi`"),
            );
            self.no_name()
        };
        let place = self.span();
        if self.primes() > 0 {
            let span = place.join(self.last_span());
            self.report(
                Diagnostic::error(
                    "primes-in-definition",
                    span,
                    "a derivative cannot be defined",
                )
                .with_label("a prime is no part of a name")
                .with_hint(format!(
                    "define `{0}`; its derivative `{0}'` follows",
                    shorten(&name.text)
                )),
            );
        }
        name
    }

    /// The `=` of a definition.
    pub(crate) fn expect_equals(&mut self) {
        if !self.eat(TokenKind::Equals) {
            let message = format!("missing `=` before {}", self.describe());
            let span = self.span();
            self.complain(
                Diagnostic::error("missing-equals", span, message)
                    .with_label("expected `=`")
                    .with_hint("a definition is `name = value`"),
            );
        }
    }

    /// The name of a formal parameter.
    pub(crate) fn expect_parameter(&mut self) -> Option<Name> {
        match self.kind() {
            TokenKind::Name => return Some(self.bump_name()),
            TokenKind::Error => {
                self.skip_strays();
                return None;
            }
            kind if kind.is_keyword() => self.complain_reserved(),
            _ => {
                let message = format!("a parameter is a name, not {}", self.describe());
                let span = self.span();
                self.complain(
                    Diagnostic::error("bad-parameter", span, message)
                        .with_label("expected a name")
                        .with_hint("a function is `f(x, y) = …`, with names in the brackets"),
                );
            }
        }
        None
    }

    /// The annotation of a formal parameter.
    pub(crate) fn expect_type(&mut self) -> Option<Name> {
        if self.at(TokenKind::Name) {
            return Some(self.bump_type());
        }
        let message = format!("missing type before {}", self.describe());
        let span = self.span();
        self.complain(
            Diagnostic::error("missing-type", span, message)
                .with_label("expected a type")
                .with_hint("types are `real`, `complex`, `vec2`, `vec3` and `vec4`"),
        );
        None
    }

    /// The letters behind a point.
    pub(crate) fn expect_component(&mut self) -> Option<Name> {
        if self.at(TokenKind::Name) {
            return Some(self.bump_name());
        }
        let point = self.last_span();
        let before = self.behind_by(1);
        let diagnostic = if matches!(before, TokenKind::Number | TokenKind::Imaginary) {
            Diagnostic::error("missing-digits", point, "missing digits after the point")
                .with_label("expected a digit")
                .with_hint("a number is `2.0` or `2`")
        } else {
            let message = format!("missing component before {}", self.describe());
            Diagnostic::error("missing-component", point, message)
                .with_label("expected a component")
                .with_hint("a component is `p.x`, a product `p * x`")
        };
        self.complain(diagnostic);
        None
    }

    /// `name =` or `name.field =` of a local.
    pub(crate) fn expect_local(&mut self) -> Option<(Name, Option<Name>)> {
        self.skip_strays();
        if self.at(TokenKind::Name) {
            if self.local_begins(0) {
                let name = self.bump_name();
                let field = self.eat(TokenKind::Dot).then(|| self.bump_name());
                self.bump();
                if let Some(field) = &field {
                    self.check_field(&name, field);
                }
                return Some((name, field));
            }
            if self.ahead(1) == TokenKind::LParen {
                self.no_local_function();
                return None;
            }
        }
        if self.kind().is_keyword() && self.ahead(1) == TokenKind::Equals {
            self.complain_reserved();
            self.bump();
            self.bump();
            self.disjunction();
            return None;
        }
        self.complain_missing_local();
        self.skip_local();
        None
    }

    #[cold]
    fn complain_missing_local(&mut self) {
        if self.is_hushed() {
            return;
        }
        let message = format!("missing definition after {}", self.quote(self.last_span()));
        let span = if self.at(TokenKind::End) {
            self.last_span()
        } else {
            self.span()
        };
        let hint = self.hint_for_local();
        self.complain(
            Diagnostic::error("missing-local", span, message)
                .with_label("expected `name = value`")
                .with_hint(hint),
        );
    }

    /// How the local that is here should be written.
    fn hint_for_local(&self) -> String {
        let has_field = self.ahead(1) == TokenKind::Dot && self.ahead(2) == TokenKind::Name;
        let last = if has_field { 2 } else { 0 };
        let is_compound =
            self.ahead(last + 1).is_infix() && self.ahead(last + 2) == TokenKind::Equals;
        let name = self.short(self.span().join(self.span_ahead(last)));
        match self.kind() {
            TokenKind::Name if is_compound => {
                let operator = self.short(self.span_ahead(last + 1));
                format!("write `{name} = {name} {operator} …`")
            }
            TokenKind::Name if has_field => format!("write `{name} = …`"),
            _ => "write `… where a = value, b = value`".to_owned(),
        }
    }

    /// Goes past what stands where a local should.
    fn skip_local(&mut self) {
        if !self.eat(TokenKind::Name) {
            return;
        }
        while self.eat(TokenKind::Dot) {
            self.eat(TokenKind::Name);
        }
        self.eat(TokenKind::Equals);
        if self.kind().is_infix() && self.ahead(1) == TokenKind::Equals {
            self.bump();
            self.bump();
        }
        if !matches!(self.kind(), TokenKind::End | TokenKind::Comma) {
            self.disjunction();
        }
    }

    /// `where g(t) = …`
    fn no_local_function(&mut self) {
        let name = self.short(self.span());
        let span = self.span();
        self.complain(
            Diagnostic::error("local-function", span, "a local is a value, not a function")
                .with_label("has parameters")
                .with_hint(format!("define `{name}(…) = …` in a statement of its own")),
        );
        self.bump();
        self.bump();
        loop {
            self.skip_to_separator();
            if !self.eat(TokenKind::Comma) {
                break;
            }
        }
        self.eat(TokenKind::RParen);
        if self.eat(TokenKind::Equals) {
            self.disjunction();
        }
    }

    /// Whether `name =` or `name.field =` stands `at` places on.
    fn local_begins(&self, at: usize) -> bool {
        let defines =
            |at| self.ahead(at) == TokenKind::Name && self.ahead(at + 1) == TokenKind::Equals;
        defines(at)
            || self.ahead(at) == TokenKind::Name
                && self.ahead(at + 1) == TokenKind::Dot
                && defines(at + 2)
    }

    /// Complains where the components that a local replaces are none, or are named twice.
    fn check_field(&mut self, name: &Name, field: &Name) {
        let mut seen = [false; 4];
        let mut fits = field.text.len() <= 4;
        for letter in field.text.chars() {
            let index = "xyzw".find(letter).or_else(|| "rgba".find(letter));
            let place = index.and_then(|index| seen.get_mut(index));
            fits &= place.is_some_and(|seen| !std::mem::replace(seen, true));
        }
        if !fits {
            self.complain_bad_field(name, field);
        }
    }

    #[cold]
    fn complain_bad_field(&mut self, name: &Name, field: &Name) {
        let (name, letters) = (shorten(&name.text), shorten(&field.text));
        let message = format!("`.{letters}` does not name components to replace");
        self.report(
            Diagnostic::error("bad-update", field.span, message)
                .with_label("expected letters of `xyzw` or `rgba`, each once")
                .with_hint(format!("write `{name}.x = …` or `{name}.xy = …`")),
        );
    }

    /// Whether another local follows; the comma of an enclosing list is left alone.
    pub(crate) fn another_local(&mut self) -> bool {
        let begins = |at: usize, parser: &Self| {
            parser.local_begins(at)
                || parser.ahead(at).is_keyword() && parser.ahead(at + 1) == TokenKind::Equals
        };
        if begins(0, self) {
            let message = format!("missing `,` before {}", self.describe());
            let span = self.span();
            self.complain(
                Diagnostic::error("missing-comma", span, message)
                    .with_label("expected `,`")
                    .with_hint("write `… where a = value, b = value`"),
            );
            return true;
        }
        let is_outside = self.open_parens == 0 && self.open_braces == 0;
        if self.at(TokenKind::Comma) && (is_outside || begins(1, self)) {
            self.bump();
            return true;
        }
        false
    }

    /// Whether a setting follows without a comma; complains about that.
    pub(crate) fn missing_comma(&mut self) -> bool {
        let found = self.at(TokenKind::Name) && self.ahead(1) == TokenKind::Equals;
        if found {
            let message = format!("missing `,` before {}", self.describe());
            let span = self.span();
            self.complain(
                Diagnostic::error("missing-comma", span, message)
                    .with_label("expected `,`")
                    .with_hint("put `,` between settings"),
            );
        }
        found
    }

    /// Whether a parameter follows without a comma; complains about that.
    pub(crate) fn missing_comma_between_parameters(&mut self) -> bool {
        let found = self.at(TokenKind::Name);
        if found {
            let message = format!("missing `,` before {}", self.describe());
            let span = self.span();
            self.complain(
                Diagnostic::error("missing-comma", span, message)
                    .with_label("expected `,`")
                    .with_hint("put `,` between parameters"),
            );
        }
        found
    }

    /// `name =` of a setting.
    pub(crate) fn expect_setting(&mut self) -> Option<Name> {
        self.skip_strays();
        if self.at(TokenKind::Name) {
            let name = self.bump_name();
            if self.at(TokenKind::Equals) {
                self.bump();
                return Some(name);
            }
            let message = format!("missing `=` before {}", self.describe());
            let span = self.span();
            self.complain(
                Diagnostic::error("missing-equals", span, message)
                    .with_label("expected `=`")
                    .with_hint(if self.at(TokenKind::Colon) {
                        "write `=`".to_owned()
                    } else {
                        format!("a setting is `{} = value`", shorten(&name.text))
                    }),
            );
            if self.eat(TokenKind::Colon) {
                return Some(name);
            }
            return None;
        }
        if self.kind().is_keyword() {
            self.complain_reserved();
        } else {
            let message = format!("a setting begins with its name, not {}", self.describe());
            let span = self.span();
            self.complain(
                Diagnostic::error("missing-name", span, message)
                    .with_label("expected a name")
                    .with_hint("settings are `{ name = value, name = lo..hi }`"),
            );
        }
        None
    }

    /// `then`
    pub(crate) fn expect_then(&mut self, opening: Span) {
        if !self.eat(TokenKind::Then) {
            self.complain_conditional("missing-then", "then", opening);
        }
    }

    /// `else`; false where it is missing.
    pub(crate) fn expect_else(&mut self, opening: Span) -> bool {
        let found = self.eat(TokenKind::Else);
        if !found {
            self.complain_conditional("missing-else", "else", opening);
        }
        found
    }

    /// `if x in 0..1`: a condition on a range is written by comparisons.
    #[cold]
    pub(crate) fn range_as_condition(&mut self, subject: Node) -> Node {
        self.bump();
        let lower = self.disjunction();
        let upper = if self.eat(TokenKind::DotDot) {
            Some(self.disjunction())
        } else {
            None
        };
        let whole = subject.span.join(self.last_span());
        let text = |node: Node| self.short(node.span);
        let ends = match (&self.exprs[lower.id], upper) {
            (_, Some(upper)) => Some((text(lower), text(upper))),
            (Expr::Vector(ends), None) if ends.len() == 2 => {
                let [a, b] = [ends[0], ends[1]].map(|id| self.short(self.exprs.span(id)));
                Some((a, b))
            }
            _ => None,
        };
        let hint = match ends {
            Some((a, b)) => format!("write `{a} <= {} <= {b}`", text(subject)),
            None => "a condition on a range is `0 <= x <= 1`".to_owned(),
        };
        self.complain(
            Diagnostic::error("range-as-condition", whole, "`in` makes no condition")
                .with_label("compare with both ends")
                .with_hint(hint),
        );
        self.error_node(whole)
    }

    /// `if (c, a, b)` and `if (c) { a } else { b }`, as in other languages; whether it was one of these.
    pub(crate) fn is_foreign_conditional(&mut self, opening: Span, cond: Node) -> bool {
        if self.at(TokenKind::Then) || self.is_hushed() {
            return false;
        }
        let text = |id: &ExprId| self.short(self.exprs.span(*id));
        let (whole, hint) = match &self.exprs[cond.id] {
            Expr::Vector(items) => {
                let shown: Vec<String> = items.iter().map(text).collect();
                let hint = match shown.as_slice() {
                    [c, a, b] => format!("write `if {c} then {a} else {b}`"),
                    [c, a] => format!("write `if {c} then {a} else nan`"),
                    _ => return false,
                };
                (opening.join(cond.span), hint)
            }
            _ => {
                let Some(value) = self
                    .brackets_ahead(0)
                    .filter(|_| self.at(TokenKind::LBrace))
                else {
                    return false;
                };
                let inner = |span: Span| {
                    let inside = Span::new(span.start + 1, span.end.saturating_sub(1));
                    inside
                        .text(self.text)
                        .trim()
                        .trim_end_matches(';')
                        .to_owned()
                };
                let condition = self.short(cond.span);
                let shown = shorten(&inner(value));
                let hint = format!("write `if {condition} then {shown} else …`, without braces");
                (opening.join(value), hint)
            }
        };
        self.report(
            Diagnostic::error("missing-then", whole, "a conditional of another language")
                .with_label("`then` and `else` are missing")
                .with_hint(hint),
        );
        if self.at(TokenKind::LBrace) {
            self.abandon();
        }
        true
    }

    #[cold]
    fn complain_conditional(&mut self, code: &'static str, word: &str, opening: Span) {
        if let Some(place) = self.retract_missing_operator(opening) {
            self.report(
                Diagnostic::error(code, place, format!("missing `{word}`"))
                    .with_label(format!("expected `{word}` between these"))
                    .with_related(opening, "the conditional begins here")
                    .with_hint(format!(
                        "add `{word}` there: `if condition then value else value`"
                    )),
            );
            self.mark_complained();
            return;
        }
        if self.is_hushed() {
            return;
        }
        let begun = self.short(opening.join(self.last_span()));
        let hint = match (word, self.kind()) {
            ("then", TokenKind::Colon) => "write `then`".to_owned(),
            ("else", TokenKind::Colon | TokenKind::End) | ("else", TokenKind::RParen) => {
                format!("say what the value is otherwise: `{begun} else 0`, or `else nan` for none")
            }
            _ => format!("go on with `{begun} {word} …`"),
        };
        let message = format!("missing `{word}` before {}", self.describe());
        self.complain(
            Diagnostic::error(code, self.span(), message)
                .with_label(format!("expected `{word}`"))
                .with_related(opening, "the conditional begins here")
                .with_hint(hint),
        );
    }
}
