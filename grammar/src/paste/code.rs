//! Numbers, names and brackets of programs: GLSL, WGSL, HLSL, C, Python, MATLAB and Mathematica.

use super::Translator;
use super::names::{function_of, is_namespace, is_type_mark};
use crate::Diagnostic;
use crate::stray::shorten;
use crate::token::TokenKind;

impl Translator<'_> {
    /// A number without the mark of its type: `1.0f`, `2u`, `3.`; `2j` is imaginary.
    pub(super) fn number(&mut self) {
        let has_point = self.word_ahead(0).contains('.');
        if self.ahead(1) == TokenKind::Name && self.touches(0) && self.is_suffix(1, has_point) {
            let is_imaginary = matches!(self.word_ahead(1), "j" | "J");
            let span = self.bump();
            let kind = if is_imaginary {
                TokenKind::Imaginary
            } else {
                TokenKind::Number
            };
            self.emit(kind, span);
            self.bump();
            return;
        }
        self.pass();
        if has_point || self.kind() != TokenKind::Dot || self.last_span().end != self.span().start {
            return;
        }
        let is_name = matches!(self.ahead(1), TokenKind::Name | TokenKind::Number);
        if is_name && self.touches(0) {
            if self.is_suffix(1, true) {
                self.bump();
                self.bump();
            }
            return;
        }
        self.bump();
    }

    /// Whether the name `n` places on, directly behind a number, is the mark of a type and not a factor: it is no
    /// name of the program.
    fn is_suffix(&self, n: usize, has_point: bool) -> bool {
        let word = self.word_ahead(n);
        is_type_mark(word, has_point)
            && !self.facts.values.contains(word)
            && (has_point || !self.facts.called.contains(word))
            && !(self.ahead(n + 1) == TokenKind::LParen && self.touches(n))
    }

    /// `.^`, `.*` and `./` of MATLAB go by components, as ours do.
    pub(super) fn dot(&mut self) {
        let next = self.ahead(1);
        let is_sign = matches!(next, TokenKind::Caret | TokenKind::Star | TokenKind::Slash);
        if is_sign && self.touches(0) && self.is_behind_operand() {
            self.bump();
        } else {
            self.pass();
        }
    }

    /// A name, without the library that it is taken from.
    pub(super) fn name(&mut self) {
        while self.is_qualified() {
            for _ in 0..3 {
                self.bump();
            }
        }
        let word = self.word_ahead(0);
        let touches = self.touches(0);
        // behind a point it is a component
        let is_library =
            self.last != TokenKind::Dot && self.ahead(1) == TokenKind::Dot && is_namespace(word);
        if is_library && !self.facts.values.contains(word) {
            return self.of_library();
        }
        let is_vector = matches!(word, "vec2" | "vec3" | "vec4")
            && self.ahead(1) == TokenKind::Less
            && matches!(self.word_ahead(2), "f32" | "f16" | "f64")
            && self.ahead(3) == TokenKind::Greater
            && self.ahead(4) == TokenKind::LParen
            && (0..4).all(|n| self.touches(n));
        if is_vector {
            self.pass();
            for _ in 0..3 {
                self.bump();
            }
            return;
        }
        let is_open = word.ends_with('_')
            && touches
            && matches!(self.ahead(1), TokenKind::LBrace | TokenKind::Command);
        if !is_open {
            return self.pass();
        }
        let word = word.to_owned();
        let span = self.bump();
        self.named(span, &word);
    }

    /// Whether `std::` and a name are here.
    fn is_qualified(&self) -> bool {
        matches!(self.word_ahead(0), "std" | "glm")
            && self.ahead(1) == TokenKind::Colon
            && self.ahead(2) == TokenKind::Colon
            && self.ahead(3) == TokenKind::Name
    }

    /// `np.sin`, `Math.PI`; the name and the point are here.
    fn of_library(&mut self) {
        let is_numpy = matches!(self.word_ahead(0), "np" | "numpy" | "jnp");
        // `np. np.sin`: once is enough
        while self.ahead(2) == TokenKind::Name
            && is_namespace(self.word_ahead(2))
            && self.ahead(3) == TokenKind::Dot
        {
            self.bump();
            self.bump();
        }
        match self.ahead(2) {
            TokenKind::Name => {}
            TokenKind::Where if self.ahead(3) == TokenKind::LParen => return self.numpy_where(),
            TokenKind::Command => {
                self.bump();
                self.bump();
                return;
            }
            _ => return self.pass(),
        }
        self.bump();
        self.bump();
        let is_inner = matches!(self.word_ahead(0), "linalg" | "special")
            && self.ahead(1) == TokenKind::Dot
            && self.ahead(2) == TokenKind::Name;
        if is_inner {
            self.bump();
            self.bump();
        }
        if is_numpy && self.word_ahead(0) == "sinc" {
            self.complain(
                "other-meaning",
                self.span(),
                "the `sinc` of NumPy is sin(πx)/(πx)",
                "sin(x)/x here",
                "with its π here: `sinc(π x)`",
            );
        }
        let word = self.word_ahead(0).to_owned();
        let span = self.bump();
        match function_of(&word) {
            Some(ours) if self.kind() == TokenKind::LParen => {
                self.emit_spelt(TokenKind::Name, span, ours);
            }
            _ => self.emit(TokenKind::Name, span),
        }
    }

    /// `np.where(c, a, b)` as `(if c then a else b)`
    fn numpy_where(&mut self) {
        self.bump();
        self.bump();
        let word = self.bump();
        let opening = self.bump();
        self.emit(TokenKind::LParen, opening);
        self.emit(TokenKind::If, word);
        self.deeper(|this| {
            this.closers.parens += 1;
            for kind in [TokenKind::Then, TokenKind::Else] {
                this.until(|this| this.kind() == TokenKind::Comma);
                if this.kind() == TokenKind::Comma {
                    let comma = this.bump();
                    this.emit(kind, comma);
                    this.follow(kind);
                }
            }
            this.until(|_| false);
            this.closers.parens -= 1;
        });
        if self.kind() == TokenKind::RParen {
            self.pass();
        }
    }

    /// `[`: a call of Mathematica behind the name of a function, else a mistake.
    pub(super) fn square(&mut self) {
        let before = self.last_span();
        let is_behind_name = self.last == TokenKind::Name && before.end == self.span().start;
        let word = before.text(self.text);
        let is_call = is_behind_name
            && (self.bracketed.contains(word)
                || word.starts_with(|c: char| c.is_ascii_uppercase())
                    && function_of(word).is_some());
        let is_head = is_behind_name
            && self.ahead(1) != TokenKind::Number
            && matches!(
                word,
                "If" | "Which"
                    | "Piecewise"
                    | "Sum"
                    | "Product"
                    | "Integrate"
                    | "D"
                    | "Limit"
                    | "Module"
                    | "With"
                    | "Plot"
                    | "Plot3D"
                    | "ContourPlot"
                    | "DensityPlot"
            );
        if is_call || is_head {
            // a head without a meaning here is reported as an unknown function
            let span = self.bump();
            self.emit(TokenKind::LParen, span);
        } else if is_behind_name {
            let name = shorten(word);
            let is_index = self.ahead(1) == TokenKind::Number;
            let hint = if is_index {
                format!("a component is `{name}.x`, `{name}.y`, `{name}.z` or `{name}.w`")
            } else {
                format!("write `{name}(…)` for a call")
            };
            let span = self.bump();
            self.report(
                Diagnostic::error(
                    "stray-character",
                    span,
                    "stray character `[`, a square bracket",
                )
                .with_hint(hint),
            );
            self.emit(TokenKind::LParen, span);
        } else {
            self.stray();
        }
        self.inside(TokenKind::RSquare);
        if self.kind() == TokenKind::RSquare {
            let span = self.bump();
            self.emit(TokenKind::RParen, span);
        }
    }
}
