//! Statements that are not what they should be.

use crate::ast::{Expr, MAX_NESTING, Name};
use crate::cursor::{Node, Parser};
use crate::layout::StatementKind;
use crate::stray::shorten;
use crate::token::TokenKind;
use crate::{Diagnostic, Span};

impl Parser<'_> {
    /// Words of other languages before a definition, such as `let`.
    pub(crate) fn skip_foreign_words(&mut self, head: usize) {
        if self.position() >= head {
            return;
        }
        let word = self.bump();
        let name = self.short(self.span());
        let text = word.text(self.text);
        if is_loop(text) {
            self.complain_foreign_loop(word);
            self.abandon();
            return;
        }
        let hint = if is_foreign_word(text) {
            format!("remove it: a definition is `{name} = …` or `{name}(x) = …`")
        } else if self.ahead(1) == TokenKind::Equals {
            let word = self.short(word);
            format!("write `{word}({name}) = …` for a function, `{name} = …` for a constant")
        } else {
            format!("write `{name}(x) = …`")
        };
        let message = format!("{} does not begin a statement", self.quote(word));
        self.complain(
            Diagnostic::error("unknown-statement", word, message)
                .with_label("expected `name =`, `name(params) =`, `param` or `show`")
                .with_hint(hint),
        );
    }

    /// Whether a name that nothing defines begins a loop of another language, or a statement of one.
    pub(crate) fn is_foreign_loop(&self, name: &Name) -> bool {
        let is_first =
            self.position() == self.start() + 1 && self.statement == StatementKind::Formula;
        self.begins_operand()
            && (is_loop(&name.text) || is_first && foreign_statement(&name.text).is_some())
    }

    /// Leaves the rest of a statement unread that has a loop of another language in it.
    #[cold]
    pub(crate) fn foreign_loop(&mut self, name: &Name) -> Node {
        match foreign_statement(&name.text) {
            Some(hint) => self.complain_foreign_word(name, hint),
            None => self.complain_foreign_loop(name.span),
        }
        let node = self.error_node(name.span);
        self.abandon();
        node
    }

    /// `import …`, `def …`: the word has been passed.
    #[cold]
    fn complain_foreign_word(&mut self, word: &Name, hint: &'static str) {
        let message = format!("`{}` is no word of the language", shorten(&word.text));
        self.report(
            Diagnostic::error("foreign-statement", word.span, message)
                .with_label("a program has definitions, formulas and `show`")
                .with_hint(hint),
        );
    }

    /// `for k in 1..n`, `while c`; the word has been passed.
    #[cold]
    fn complain_foreign_loop(&mut self, word: Span) {
        let hint = if word.text(self.text) == "while" {
            "to repeat write `iterate(n, z = start, step until condition)`; it ends where the condition holds"
                .to_owned()
        } else {
            let compares = (0..8).any(|n| {
                use TokenKind::{Greater, GreaterEqual, Less, LessEqual};
                matches!(self.ahead(n), Greater | GreaterEqual | Less | LessEqual)
            });
            if compares && !self.at(TokenKind::LParen) && !self.running_follows() {
                let condition = self.short(self.rest());
                let message = "`for` is no word of the language";
                return self.complain(
                    Diagnostic::error("foreign-loop", word, message)
                        .with_label("a condition stands before its value")
                        .with_hint(format!(
                            "write it as a choice: `if {condition} then … else nan`"
                        )),
                );
            }
            let range = if self.running_follows() {
                self.range_ahead()
            } else {
                "k in 1..n".to_owned()
            };
            format!(
                "to repeat write `sum({range}, term)`, `product(…)`, or `iterate(n, z = start, step)`"
            )
        };
        let message = format!("{} is no word of the language", self.quote(word));
        self.complain(
            Diagnostic::error("foreign-loop", word, message)
                .with_label("a loop is an expression with a value here")
                .with_hint(hint),
        );
    }

    /// The text of the range that begins here, if it ends soon; else a range as an example.
    fn range_ahead(&self) -> String {
        let ends = |n: &usize| {
            use TokenKind::{Colon, Comma, End, LBrace, LParen, RBrace, RParen};
            matches!(
                self.ahead(*n),
                End | Comma | Colon | LParen | RParen | LBrace | RBrace
            )
        };
        let end = (2..12).find(ends).unwrap_or(2);
        if (2..end).any(|n| self.ahead(n) == TokenKind::DotDot) {
            return self.short(self.span().join(self.span_ahead(end - 1)));
        }
        format!("{} in 1..n", self.short(self.span()))
    }

    /// Complains once about what a statement leaves unread, and reads it for further problems.
    pub(crate) fn skip_leftovers(&mut self) {
        self.skip_strays();
        if self.at(TokenKind::End) {
            return;
        }
        self.complain_unexpected(None);
        while !self.at(TokenKind::End) {
            self.bump();
            while !self.at(TokenKind::End) && !self.begins_operand() {
                self.bump();
            }
            if !self.at(TokenKind::End) {
                self.expr();
            }
        }
    }

    fn begins_operand(&self) -> bool {
        use TokenKind::{Bar, If, Imaginary, LBrace, LParen, Name, Not, Number, Root};
        match self.kind() {
            Name => self.ahead(1) != TokenKind::Equals,
            kind => matches!(
                kind,
                Number | Imaginary | LParen | LBrace | Bar | If | Not | Root
            ),
        }
    }

    /// `= value` of a parameter.
    pub(crate) fn expect_default(&mut self, name: &Name) -> Node {
        if self.eat(TokenKind::Equals) {
            return self.disjunction();
        }
        let shown = if name.text.is_empty() {
            "name".to_owned()
        } else {
            shorten(&name.text)
        };
        let span = self.span();
        let diagnostic =
            Diagnostic::error("missing-default", span, "missing default of a parameter")
                .with_label("expected `=` and a value")
                .with_hint(format!(
                    "give it a value: `param {shown} = value in lo..hi`"
                ));
        self.complain(diagnostic);
        if matches!(self.kind(), TokenKind::In | TokenKind::End) {
            return self.missing_node();
        }
        if self.at(TokenKind::Colon) {
            self.bump();
            self.eat(TokenKind::Equals);
        }
        self.disjunction()
    }

    /// `in` without two ends.
    #[cold]
    pub(crate) fn complain_bad_range(&mut self, lower: Node) {
        let span = if lower.span.start == lower.span.end {
            self.span()
        } else {
            lower.span
        };
        let span = if self.at(TokenKind::Colon) {
            span.join(self.span_ahead(1))
        } else {
            span
        };
        let in_form = self.open_parens > 0 && self.statement != StatementKind::Param;
        let hint = match &self.exprs[lower.id] {
            Expr::Vector(ends) if ends.len() == 2 => {
                let ends: Vec<String> = ends
                    .iter()
                    .map(|&end| self.short(self.exprs.span(end)))
                    .collect();
                format!("write `{}`", ends.join(".."))
            }
            Expr::Number(value) if *value > 0.0 && !in_form && self.at(TokenKind::End) => {
                format!("write `0..{}`", self.short(lower.span))
            }
            _ if self.at(TokenKind::Colon)
                && matches!(self.ahead(1), TokenKind::Number | TokenKind::Name) =>
            {
                let upper = self.short(self.span_ahead(1));
                format!("write `{}..{upper}`", self.short(lower.span))
            }
            Expr::Number(_) | Expr::Name(_) if in_form => {
                format!("write `1..{}`", self.short(lower.span))
            }
            _ => "a range is `in lo..hi`".to_owned(),
        };
        self.complain(
            Diagnostic::error("bad-range", span, "a range has two ends")
                .with_label("expected `lo..hi`")
                .with_hint(hint),
        );
        if !self.at(TokenKind::End) && (self.open_parens, self.open_braces) == (0, 0) {
            self.bump();
            if self.begins_operand() || self.at(TokenKind::Minus) {
                self.disjunction();
            }
        }
    }

    /// The name of a scene.
    pub(crate) fn expect_scene(&mut self) -> Name {
        self.skip_strays();
        if self.at(TokenKind::Name) {
            return self.bump_name();
        }
        let message = format!("missing scene before {}", self.describe());
        let span = self.span();
        self.complain(
            Diagnostic::error("missing-name", span, message)
                .with_label("expected the name of a scene")
                .with_hint("a picture is `show surface(f)`"),
        );
        let end = self.last_span().end;
        Name {
            text: String::new(),
            span: Span::new(end, end),
        }
    }

    /// Whether the arguments of a scene follow; complains where there are none.
    pub(crate) fn expect_subjects(&mut self, scene: &Name) -> bool {
        let opens = self.at(TokenKind::LParen);
        if opens && self.ahead(1) != TokenKind::RParen {
            return true;
        }
        if self.at(TokenKind::Name) && self.ahead(1) == TokenKind::End {
            self.complain_bare_subject(scene);
            return false;
        }
        let shown = if scene.text.is_empty() {
            "surface".to_owned()
        } else {
            shorten(&scene.text)
        };
        let span = if opens {
            self.span().join(self.span_ahead(1))
        } else {
            self.span()
        };
        let message = format!("nothing to show in `{shown}`");
        self.complain(
            Diagnostic::error("missing-arguments", span, message)
                .with_label("expected a function or formula in brackets")
                .with_hint(format!("say what is shown: `show {shown}(f)`")),
        );
        if opens {
            self.bump();
            self.bump();
        }
        while !matches!(self.kind(), TokenKind::End | TokenKind::LBrace) {
            self.bump();
        }
        false
    }

    /// `show f`: the function, but no scene. Whether that is it.
    pub(crate) fn lacks_scene(&mut self, name: &Name) -> bool {
        let is_alone = self.at(TokenKind::End) && self.scope.defines_function(&name.text);
        if is_alone {
            let shown = shorten(&name.text);
            let message = format!("`{shown}` is a function, not a scene");
            self.report(
                Diagnostic::error("unknown-scene", name.span, message)
                    .with_label("which scene?")
                    .with_hint(format!(
                        "write `levels({shown})`; other scenes are `domain` and `surface`"
                    )),
            );
        }
        is_alone
    }

    /// `show levels(f, height = 2)`: a setting among what is shown. Whether that is it; the rest is left unread.
    pub(crate) fn is_setting_inside(&mut self) -> bool {
        let found = self.at(TokenKind::Name) && self.ahead(1) == TokenKind::Equals;
        if found {
            let name = self.short(self.span());
            let message = format!("the setting `{name}` stands among what is shown");
            self.complain(
                Diagnostic::error("missing-braces", self.span(), message)
                    .with_label("settings stand in braces")
                    .with_hint(format!("put it behind the brackets: `{{ {name} = … }}`")),
            );
            self.abandon();
        }
        found
    }

    /// `show levels f`
    #[cold]
    fn complain_bare_subject(&mut self, scene: &Name) {
        let subject = self.bump();
        let shown = format!("{}({})", shorten(&scene.text), self.short(subject));
        let message = "what is shown has no brackets";
        self.report(
            Diagnostic::error("missing-arguments", scene.span.join(subject), message)
                .with_label("brackets are missing")
                .with_hint(format!("write `{shown}`")),
        );
    }

    /// Whether `=` behind `lhs` makes an equation of the whole statement.
    pub(crate) fn is_bare_equation(&self, lhs: Node) -> bool {
        self.statement == StatementKind::Formula && lhs.span.start == self.first_span().start
    }

    /// Gives the statement up; said once for each.
    #[cold]
    pub(crate) fn complain_too_deep(&mut self, span: Span) {
        if !self.is_abandoned() {
            let message = format!("nested more than {MAX_NESTING} deep");
            self.report(
                Diagnostic::error("too-deep", span, message)
                    .with_label("not read from here on")
                    .with_hint("name parts of it in definitions of their own"),
            );
        }
        self.abandon();
    }

    /// Goes one level deeper into arguments; false where that is too deep.
    pub(crate) fn enter_arguments(&mut self) -> bool {
        let may = self.descend();
        if !may {
            let span = self.span();
            self.complain_too_deep(span);
        }
        may
    }
}

/// What to do in place of a statement of another language that begins with this word.
pub(crate) fn foreign_statement(word: &str) -> Option<&'static str> {
    Some(match word {
        "import" | "from" | "using" | "include" | "require" => {
            "remove the line: all functions of the language are there"
        }
        "def" | "function" | "fn" | "func" | "void" | "lambda" | "class" | "struct" => {
            "define a function by one expression: `f(x, y) = value where a = …`"
        }
        "return" | "print" | "echo" | "plot" | "draw" | "Plot" | "Draw" | "Plot3D"
        | "ContourPlot" | "DensityPlot" => {
            "a program shows its formula: write that alone, or `show levels(formula)`"
        }
        "uniform" | "varying" | "attribute" | "slider" => {
            "a number that can be changed is `param name = value in lo..hi`"
        }
        "out" | "precision" | "layout" => "remove the line: a scene draws the formula",
        "let" | "var" | "const" | "local" => "a definition is `name = value`",
        _ => return None,
    })
}

/// Words with which loops begin in other languages.
fn is_loop(word: &str) -> bool {
    matches!(word, "for" | "foreach" | "while" | "repeat")
}

/// Words with which definitions begin in other languages.
fn is_foreign_word(word: &str) -> bool {
    matches!(word, "int" | "uniform" | "parameter" | "slider" | "global")
}
