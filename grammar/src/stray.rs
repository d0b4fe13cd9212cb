//! Characters that are no part of the language: what they are called and what was probably meant.

use crate::token::TokenKind;
use crate::{Diagnostic, Span};

/// The complaint about a character that begins no token.
pub(crate) fn complaint(culprit: char, span: Span) -> Diagnostic {
    let message = format!("stray character {}", describe(culprit));
    let diagnostic = Diagnostic::error("stray-character", span, message);
    match hint(culprit) {
        Some(hint) => diagnostic.with_hint(hint),
        None => diagnostic,
    }
}

/// A text of at most thirty characters, the rest elided.
pub(crate) fn shorten(text: &str) -> String {
    const LIMIT: usize = 30;
    let mut short = String::new();
    let mut blank = false;
    let mut length = 0;
    // Blanks count too in how far this looks, as there may be millions of them.
    for c in text.chars().take(100 * LIMIT) {
        if c.is_whitespace() || c.is_control() {
            blank = !short.is_empty();
            continue;
        }
        if length >= LIMIT {
            short.push('…');
            break;
        }
        if std::mem::take(&mut blank) {
            short.push(' ');
        }
        short.push(c);
        length += 1;
    }
    short
}

/// The character where it can be seen, its name where we know it, and its code point unless it is ASCII.
fn describe(c: char) -> String {
    let code = format!("U+{:04X}", u32::from(c));
    match (name(c), c.is_control() || is_invisible(c)) {
        (Some(name), true) => format!("{code}, {name}"),
        (None, true) => code,
        (None, false) if c.is_ascii() => format!("`{c}`"),
        (None, false) => format!("`{c}` ({code})"),
        (Some(name), false) if c.is_ascii() => format!("`{c}`, {name}"),
        (Some(name), false) => format!("`{c}` ({code}, {name})"),
    }
}

/// Whether nothing is drawn for the character, or it turns the direction of what is drawn.
fn is_invisible(c: char) -> bool {
    matches!(c, '\u{200C}'..='\u{200F}' | '\u{2028}'..='\u{202E}' | '\u{2061}'..='\u{206F}' | '\u{AD}'
        | '\u{E0000}'..='\u{E007F}' | '\u{FE00}'..='\u{FE0F}')
}

/// The name of a character that is often pasted by accident.
fn name(c: char) -> Option<&'static str> {
    Some(match c {
        '\0' => "a null character",
        '\u{1}'..='\u{1F}' | '\u{7F}'..='\u{9F}' => "a control character",
        '\u{AD}' => "a soft hyphen",
        '\u{200C}' | '\u{200D}' => "a zero-width joiner",
        '\u{200E}' | '\u{200F}' | '\u{202A}'..='\u{202E}' | '\u{2066}'..='\u{2069}' => {
            "a mark that turns the direction of writing"
        }
        '\u{2028}' | '\u{2029}' => "a line separator",
        '\u{2061}'..='\u{2064}' => "an invisible operator",
        '\u{FFFD}' => "a replacement for unreadable bytes",
        '"' => "a quotation mark",
        '`' => "a backquote",
        '[' | ']' => "a square bracket",
        '\\' => "a backslash",
        '‐' | '‑' => "a hyphen",
        '‒' | '–' => "an en dash",
        '—' | '―' => "an em dash",
        '“' | '”' | '„' | '‟' | '‘' | '’' | '‚' | '‛' | '«' | '»' => {
            "a typographic quotation mark"
        }
        '\u{FF01}'..='\u{FF5E}' => "a full-width character",
        '⁺' | '⁻' | '⁼' | '⁽' | '⁾' | 'ⁿ' | 'ⁱ' => "a superscript",
        '₀'..='₉' => "a subscript without a name",
        '\u{1D400}'..='\u{1D7FF}' => "a letter of mathematical style",
        'а'..='я' | 'А'..='Я' => "a Cyrillic letter",
        'µ' => "the micro sign",
        '\u{2126}' => "the ohm sign",
        'ϕ' => "the phi symbol",
        'ϖ' => "the pi symbol",
        _ => return None,
    })
}

/// What was probably meant.
fn hint(c: char) -> Option<String> {
    if let Some(twin) = twin(c) {
        return Some(format!("write `{twin}`"));
    }
    let advice = match c {
        '"' | '“' | '”' | '„' | '‟' | '«' | '»' => {
            "the language has no texts; remove the quotation marks"
        }
        '[' | ']' => "write `(a, b)` for a vector, `lo..hi` for a range and `p.x` for a component",
        '?' => "write `if c then a else b`",
        '%' => "write `mod(a, b)` for a remainder",
        '&' => "write `and`",
        '~' => "write `not a`, `-a`, or `==` for equal",
        '$' | '@' | '\\' | '`' => "names are letters, digits and `_`",
        'ⁿ' => "write `^n`",
        'ⁱ' => "write `^i`",
        '⁺' | '⁻' | '⁼' | '⁽' | '⁾' => "write `^` and the exponent",
        '≡' | '≟' => "write `==` to compare",
        '≈' => "write `|a - b| < 1e-3`, or how near you want it",
        '₀'..='₉' => "a subscript belongs directly behind a name, as in `x₀`",
        '½' => "write `1/2`",
        '⅓' => "write `1/3`",
        '¼' => "write `1/4`",
        '¾' => "write `3/4`",
        '∛' => "write `x^(1/3)`",
        '∜' => "write `x^(1/4)`",
        '∫' => "write `integral(expr, t, a, b)`",
        '∂' => "write `diff(expr, x)` or `f'(x)`",
        '∇' => "write `grad(f)`",
        '‖' | '∥' => "write `|p|` for the length",
        '⌊' | '⌋' => "write `floor(x)`",
        '⌈' | '⌉' => "write `ceil(x)`",
        '⟨' | '⟩' => "write `(a, b)` for a vector, `dot(a, b)` for the inner product",
        '″' => "write `''`",
        '°' => "angles are in radians; write `x π/180` for degrees",
        '±' | '∓' => "write the two formulas, one with `+` and one with `-`",
        '→' | '↦' | '⇒' => "write `name(x) = …` to define a function",
        '\u{FFFD}' => "save the file as UTF-8",
        _ if c.is_control() || is_invisible(c) => "remove it",
        _ if c.is_alphabetic() => "names are Latin and Greek letters, digits and `_`",
        _ => return None,
    };
    Some(advice.to_owned())
}

/// What a stray sign is read as, so that one complaint about it is enough.
pub(crate) fn stands_for(c: char) -> TokenKind {
    match twin(c).unwrap_or(c) {
        '+' => TokenKind::Plus,
        '-' => TokenKind::Minus,
        '*' => TokenKind::Star,
        '/' => TokenKind::Slash,
        '^' => TokenKind::Caret,
        '=' => TokenKind::Equals,
        '<' => TokenKind::Less,
        '>' => TokenKind::Greater,
        '|' => TokenKind::Bar,
        ',' => TokenKind::Comma,
        ';' => TokenKind::Semicolon,
        ':' => TokenKind::Colon,
        '\'' => TokenKind::Prime,
        '(' | '[' => TokenKind::LParen,
        ')' | ']' => TokenKind::RParen,
        '{' => TokenKind::LBrace,
        '}' => TokenKind::RBrace,
        '&' => TokenKind::And,
        _ => TokenKind::Error,
    }
}

/// The character of the language that looks or means the same.
fn twin(c: char) -> Option<char> {
    Some(match c {
        '\u{FF01}'..='\u{FF5E}' => char::from_u32(u32::from(c) - 0xFEE0)?,
        '\u{1D400}'..='\u{1D6A3}' => {
            let letter = u8::try_from((u32::from(c) - 0x1D400) % 52).ok()?;
            char::from(if letter < 26 {
                b'A' + letter
            } else {
                b'a' + letter - 26
            })
        }
        '\u{1D7CE}'..='\u{1D7FF}' => {
            char::from(b'0' + u8::try_from((u32::from(c) - 0x1D7CE) % 10).ok()?)
        }
        '‐' | '‑' | '‒' | '–' | '—' | '―' | '➖' | '\u{AD}' => '-',
        '➕' => '+',
        '∗' | '•' | '✕' | '✖' | '⨯' | '∘' => '*',
        '∕' | '⁄' | '➗' => '/',
        '‘' | '’' | '‛' | '´' => '\'',
        '‚' | '、' => ',',
        '。' => '.',
        '∶' | 'ː' => ':',
        'ϕ' => 'φ',
        'ϖ' => 'π',
        'µ' => 'μ',
        '\u{2126}' => 'Ω',
        '∆' => 'Δ',
        'а' => 'a',
        'е' => 'e',
        'о' => 'o',
        'р' => 'p',
        'с' => 'c',
        'у' => 'y',
        'х' => 'x',
        'А' => 'A',
        'В' => 'B',
        'Е' => 'E',
        'К' => 'K',
        'М' => 'M',
        'Н' => 'H',
        'О' => 'O',
        'Р' => 'P',
        'С' => 'C',
        'Т' => 'T',
        'Х' => 'X',
        _ => return None,
    })
}
