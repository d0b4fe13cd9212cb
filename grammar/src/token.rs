//! Text to tokens.

use logos::Logos;

use crate::diagnostic::MAX_DIAGNOSTICS;
use crate::stray;
use crate::{Diagnostic, Span};

/// What a [`Token`] is. Unicode twins of an operator have the kind of their ASCII spelling.
#[derive(Logos, Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[logos(skip r"[ \t\x0B\x0C\u{A0}\u{2000}-\u{200B}\u{202F}\u{205F}\u{2060}\u{3000}\u{FEFF}]+")]
pub enum TokenKind {
    /// `12`, `1.5`, `.5`, `1e-3`
    #[regex(r"([0-9]+(\.[0-9]+)?|\.[0-9]+)([eE][+-]?[0-9]+)?")]
    Number,
    /// `2i`
    Imaginary,
    /// A name: Latin and Greek letters, digits, `_` and subscripts; `π`, `τ`, `φ`, `∞`, `∑` and `∏` stand alone.
    #[regex(r"[A-Za-z_Α-ΡΣ-Ωα-ορ-συχ-ωϑϱϵ][A-Za-z0-9_Α-ΡΣ-Ωα-ορ-συχ-ωϑϱϵ₀-₉]*")]
    #[regex(r"[πτφ∞∑∏]")]
    Name,
    /// `²`, `⁻¹`
    #[regex(r"[⁺⁻]?[⁰¹²³⁴⁵⁶⁷⁸⁹]+")]
    Superscript,
    /// `'`, `′`
    #[token("'")]
    #[token("′")]
    Prime,
    /// `+`
    #[token("+")]
    Plus,
    /// `-`, `−`
    #[token("-")]
    #[token("−")]
    Minus,
    /// `*`, `·`, `×`, `∙`, `⋅`
    #[token("*")]
    #[token("·")]
    #[token("×")]
    #[token("∙")]
    #[token("⋅")]
    Star,
    /// `/`, `÷`
    #[token("/")]
    #[token("÷")]
    Slash,
    /// `^`, `**`
    #[token("^")]
    #[token("**")]
    Caret,
    /// `!`
    #[token("!")]
    Bang,
    /// `√`
    #[token("√")]
    Root,
    /// `(`
    #[token("(")]
    LParen,
    /// `)`
    #[token(")")]
    RParen,
    /// `{`
    #[token("{")]
    LBrace,
    /// `}`
    #[token("}")]
    RBrace,
    /// `|`
    #[token("|")]
    Bar,
    /// `,`
    #[token(",")]
    Comma,
    /// `;`
    #[token(";")]
    Semicolon,
    /// `:`
    #[token(":")]
    Colon,
    /// `.`
    #[token(".")]
    Dot,
    /// `..`, `…`
    #[token("..")]
    #[token("…")]
    DotDot,
    /// `=`
    #[token("=")]
    Equals,
    /// `<`
    #[token("<")]
    Less,
    /// `<=`, `≤`
    #[token("<=")]
    #[token("≤")]
    LessEqual,
    /// `>`
    #[token(">")]
    Greater,
    /// `>=`, `≥`
    #[token(">=")]
    #[token("≥")]
    GreaterEqual,
    /// `==`
    #[token("==")]
    EqualEqual,
    /// `!=`, `≠`
    #[token("!=")]
    #[token("≠")]
    NotEqual,
    /// `param`
    #[token("param")]
    Param,
    /// `in`
    #[token("in")]
    In,
    /// `where`
    #[token("where")]
    Where,
    /// `show`
    #[token("show")]
    Show,
    /// `if`
    #[token("if")]
    If,
    /// `then`
    #[token("then")]
    Then,
    /// `else`
    #[token("else")]
    Else,
    /// `until`
    #[token("until")]
    Until,
    /// `and`, `∧`, `&&`
    #[token("and")]
    #[token("∧")]
    #[token("&&")]
    And,
    /// `or`, `∨`
    #[token("or")]
    #[token("∨")]
    Or,
    /// `not`, `¬`
    #[token("not")]
    #[token("¬")]
    Not,
    /// `\sin`, `\,`: a command of LaTeX
    #[regex(r"\\([A-Za-z]+|\r\n|[^A-Za-z])")]
    Command,
    /// `$`, around a formula of LaTeX
    #[token("$")]
    Dollar,
    /// `?`, the choice of C
    #[token("?")]
    Question,
    /// `&`, between the columns of LaTeX
    #[token("&")]
    Ampersand,
    /// `[`
    #[token("[")]
    LSquare,
    /// `]`
    #[token("]")]
    RSquare,
    /// Text that is no token; a diagnostic has been given.
    Error,
    /// The end of the text, or of the statement being read.
    End,
    /// A line break; never in the list that [`tokenize`] returns.
    #[regex(r"[\r\n]+")]
    Newline,
    /// `// …` or `# …`; never in the list that [`tokenize`] returns.
    #[regex(r"(//|#)[^\r\n]*", allow_greedy = true)]
    LineComment,
    /// `/* … */`; never in the list that [`tokenize`] returns.
    #[token("/*")]
    BlockComment,
}

impl TokenKind {
    /// Whether this is a reserved word or its Unicode twin.
    #[must_use]
    pub fn is_keyword(self) -> bool {
        use TokenKind::{And, Else, If, In, Not, Or, Param, Show, Then, Until, Where};
        matches!(
            self,
            Param | In | Where | Show | If | Then | Else | Until | And | Or | Not
        )
    }

    /// Whether this stands between two operands.
    #[must_use]
    pub fn is_infix(self) -> bool {
        use TokenKind::{And, Caret, Minus, Or, Plus, Slash, Star};
        self.is_comparison() || matches!(self, Plus | Minus | Star | Slash | Caret | And | Or)
    }

    /// Whether this compares its operands.
    #[must_use]
    pub fn is_comparison(self) -> bool {
        use TokenKind::{EqualEqual, Greater, GreaterEqual, Less, LessEqual, NotEqual};
        matches!(
            self,
            EqualEqual | Greater | GreaterEqual | Less | LessEqual | NotEqual
        )
    }
}

/// A piece of the text: what it is and where.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Token {
    /// What it is.
    pub kind: TokenKind,
    /// Where it stands.
    pub span: Span,
    /// Whether a line break lies between this token and the one before.
    pub starts_line: bool,
}

/// The tokens of a text, without blanks and comments, and what could not be read. Those of other notations, such as
/// [`TokenKind::Command`], are still as they were written.
///
/// Bytes beyond [`MAX_SOURCE_BYTES`](crate::ast::MAX_SOURCE_BYTES) are the caller's to refuse.
#[must_use]
pub fn tokenize(text: &str) -> (Vec<Token>, Vec<Diagnostic>) {
    let mut tokens: Vec<Token> = Vec::with_capacity(text.len() / 3 + 4);
    let mut diagnostics = Vec::new();
    let mut lexer = TokenKind::lexer(text);
    let mut starts_line = true;
    while let Some(result) = lexer.next() {
        let mut kind = result.unwrap_or(TokenKind::Error);
        match kind {
            TokenKind::Newline => {
                starts_line = true;
                continue;
            }
            TokenKind::LineComment => continue,
            TokenKind::BlockComment => {
                let opening = span(lexer.span());
                if let Some(end) = lexer.remainder().find("*/") {
                    lexer.bump(end + 2);
                } else {
                    lexer.bump(lexer.remainder().len());
                    diagnostics.push(
                        Diagnostic::error("unterminated-comment", opening, "unterminated comment")
                            .with_label("opened here")
                            .with_hint("close it with `*/`"),
                    );
                    tokens.push(Token {
                        kind: TokenKind::Error,
                        span: opening,
                        starts_line: starts_line || lexer.slice().contains(['\n', '\r']),
                    });
                }
                starts_line |= lexer.slice().contains(['\n', '\r']);
                continue;
            }
            TokenKind::Number => {
                let rest = lexer.remainder();
                let mut after = rest.chars();
                if after.next() == Some('i') && !after.next().is_some_and(is_name_character) {
                    lexer.bump(1);
                    kind = TokenKind::Imaginary;
                } else if separates_digits(rest) {
                    let tail = rest.find(|c: char| !matches!(c, '0'..='9' | '_'));
                    lexer.bump(tail.unwrap_or(rest.len()));
                    kind = TokenKind::Error;
                    let number = lexer.slice().replace('_', "");
                    diagnostics.push(
                        Diagnostic::error(
                            "digit-separator",
                            span(lexer.span()),
                            "a number has no `_` between its digits",
                        )
                        .with_hint(format!("write `{}`", stray::shorten(&number))),
                    );
                }
            }
            TokenKind::Error => {
                let place = lexer.span();
                let culprit = text.get(place.start..).and_then(|rest| rest.chars().next());
                let Some(culprit) = culprit else { continue };
                let mut start = place.start;
                if culprit.is_alphabetic() {
                    // One complaint for one word: `größe` is not three names and two strays.
                    let rest = lexer.remainder();
                    let word = |c: char| !(is_name_character(c) || c.is_alphabetic());
                    lexer.bump(rest.find(word).unwrap_or(rest.len()));
                    if let Some(last) = tokens.last().copied()
                        && last.kind == TokenKind::Name
                        && last.span.end as usize == start
                    {
                        start = last.span.start as usize;
                        starts_line = last.starts_line;
                        tokens.pop();
                    }
                }
                // Found in the order of the text: what is not listed need not be made.
                if diagnostics.len() <= MAX_DIAGNOSTICS {
                    diagnostics.push(stray::complaint(culprit, span(place)));
                }
                kind = stray::stands_for(culprit);
                tokens.push(Token {
                    kind,
                    span: span(start..lexer.span().end),
                    starts_line,
                });
                starts_line = false;
                continue;
            }
            _ => {}
        }
        tokens.push(Token {
            kind,
            span: span(lexer.span()),
            starts_line,
        });
        starts_line = false;
    }
    (tokens, diagnostics)
}

/// The places of the comments of a text, in order.
#[must_use]
pub fn comments(text: &str) -> Vec<Span> {
    let mut found = Vec::new();
    let mut lexer = TokenKind::lexer(text);
    while let Some(result) = lexer.next() {
        match result {
            Ok(TokenKind::LineComment) => found.push(span(lexer.span())),
            Ok(TokenKind::BlockComment) => {
                let rest = lexer.remainder();
                lexer.bump(rest.find("*/").map_or(rest.len(), |end| end + 2));
                found.push(span(lexer.span()));
            }
            _ => {}
        }
    }
    found
}

/// The kind of the one token that a word is; nothing where it is several, or none.
pub(crate) fn kind_of_word(word: &str) -> Option<TokenKind> {
    let mut lexer = TokenKind::lexer(word);
    let kind = lexer.next()?.ok()?;
    lexer.remainder().is_empty().then_some(kind)
}

/// Whether `c` can stand inside a name.
pub(crate) fn is_name_character(c: char) -> bool {
    matches!(c, 'A'..='Z' | 'a'..='z' | '0'..='9' | '_' | '₀'..='₉')
        || matches!(c, 'Α'..='Ω' | 'α'..='ω' | 'ϑ' | 'ϱ' | 'ϵ') && !matches!(c, 'π' | 'τ' | 'φ')
}

/// Whether what follows a number is `_` and a digit.
fn separates_digits(rest: &str) -> bool {
    let after = rest.trim_start_matches('_');
    after.len() < rest.len() && after.starts_with(|c: char| c.is_ascii_digit())
}

/// A range of bytes as a span.
fn span(range: std::ops::Range<usize>) -> Span {
    let clamp = |at: usize| u32::try_from(at).unwrap_or(u32::MAX);
    Span::new(clamp(range.start), clamp(range.end))
}
