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

/// Joins the complaints about characters that belong together in one line, such as both quotation marks around a text:
/// that is one mistake. The diagnostics are in the order of their places.
pub(crate) fn join_pairs(text: &str, diagnostics: &mut Vec<Diagnostic>) {
    let family = |diagnostic: &Diagnostic| match diagnostic.span.text(text).chars().next() {
        _ if diagnostic.code != "stray-character" => None,
        Some('"' | '“' | '”' | '„' | '‟' | '«' | '»') => Some('"'),
        Some('⌊' | '⌋') => Some('⌊'),
        Some('⌈' | '⌉') => Some('⌈'),
        Some('‖' | '∥') => Some('‖'),
        Some('⟨' | '⟩') => Some('⟨'),
        Some('∂') => Some('∂'),
        _ => None,
    };
    let mut open: Option<(char, usize)> = None;
    let mut kept: Vec<Diagnostic> = Vec::with_capacity(diagnostics.len());
    for diagnostic in diagnostics.drain(..) {
        let found = family(&diagnostic);
        let first = open.and_then(|(family, at)| Some((family, kept.get_mut(at)?)));
        let twin = first.filter(|(family, first)| {
            let between = Span::new(first.span.start, diagnostic.span.end).text(text);
            found == Some(*family) && between.len() < 200 && !between.contains('\n')
        });
        match twin {
            Some((family, first)) => {
                *first = of_pair(text, family, first.span.join(diagnostic.span));
                if family == '∂' {
                    with_variable(text, first);
                }
                open = None;
            }
            None => {
                if let Some(family) = found {
                    open = Some((family, kept.len()));
                }
                kept.push(diagnostic);
            }
        }
    }
    // `in [0, 1]`: the range has been complained about
    let ranges: Vec<Span> = kept
        .iter()
        .filter(|d| matches!(d.code, "bad-range" | "range-as-condition"))
        .map(|d| d.span)
        .collect();
    kept.retain(|d| {
        let is_inside = |range: &Span| range.start <= d.span.start && d.span.end <= range.end;
        d.code != "stray-character" || !ranges.iter().any(is_inside)
    });
    *diagnostics = kept;
}

/// `∂f/∂x`: the name behind the second sign is the variable.
fn with_variable(text: &str, diagnostic: &mut Diagnostic) {
    let rest = text.get(diagnostic.span.end as usize..).unwrap_or_default();
    let letters = rest.chars().take(20).take_while(|c| c.is_alphanumeric());
    let variable: String = letters.collect();
    let whole = diagnostic.span.text(text);
    let what = whole
        .trim_start_matches('∂')
        .trim_end_matches(['∂', '/', ' ']);
    let is_wrapped = what.starts_with('(') && what.ends_with(')');
    let inner = what
        .get(1..what.len().saturating_sub(1))
        .filter(|_| is_wrapped);
    let what = shorten(inner.unwrap_or(what));
    if !variable.is_empty() && !what.is_empty() {
        let length = u32::try_from(variable.len()).unwrap_or_default();
        diagnostic.span = Span::new(diagnostic.span.start, diagnostic.span.end + length);
        diagnostic.hint = Some(format!("write `diff({what}, {variable})`"));
    }
}

/// One complaint about both characters of a pair, with what is between them.
fn of_pair(text: &str, family: char, span: Span) -> Diagnostic {
    let whole = span.text(text);
    let mut inside = whole.chars();
    inside.next();
    inside.next_back();
    let inside = shorten(inside.as_str().trim());
    let (message, hint) = match family {
        '"' => (
            "the language has no texts".to_owned(),
            format!("write `{inside}`, without quotation marks"),
        ),
        '⌊' => (
            "stray characters `⌊ ⌋`".to_owned(),
            format!("write `floor({inside})`"),
        ),
        '⌈' => (
            "stray characters `⌈ ⌉`".to_owned(),
            format!("write `ceil({inside})`"),
        ),
        '‖' => (
            "stray characters `‖ ‖`".to_owned(),
            format!("write `|{inside}|` for the length"),
        ),
        '⟨' => (
            "stray characters `⟨ ⟩`".to_owned(),
            format!("write `({inside})` for a vector, `dot(a, b)` for the inner product"),
        ),
        _ => {
            let what = inside.trim_end_matches(['/', ' ']);
            let hint =
                format!("write `diff({what}, x)`, with the name of the variable in place of x");
            ("`∂` is no sign of the language".to_owned(), hint)
        }
    };
    Diagnostic::error("stray-character", span, message).with_hint(hint)
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
        '[' | ']' => "a vector is `(a, b)`, a range `lo..hi`, a component `p.x`",
        '?' => "a choice is `if c then a else b`",
        '%' => "a remainder is `mod(a, b)`, one per cent is `1/100`",
        '&' => "write `and`",
        '~' => "the opposite is `not a` or `-a`, equal is `==`",
        '$' | '@' | '\\' | '`' => "remove it: names are letters, digits and `_`",
        'ⁿ' => "write `^n`",
        'ⁱ' => "write `^i`",
        '⁺' | '⁻' | '⁼' | '⁽' | '⁾' => "write `^` and the exponent",
        '≡' | '≟' => "write `==`",
        '≈' => "say how near: `|a - b| < 1e-3`",
        '₀'..='₉' => "a subscript belongs directly behind a name, as in `x₀`",
        '½' => "write `1/2`",
        '⅓' => "write `1/3`",
        '¼' => "write `1/4`",
        '¾' => "write `3/4`",
        '∛' => "a root is a power: `x^(1/3)`",
        '∜' => "a root is a power: `x^(1/4)`",
        '∫' => "an integral is `integral(t^2, t, a, b)`",
        '∂' => "a derivative is `diff(x^2 y, x)`, or `f'(x)`",
        '∇' => "a gradient is `grad(f)(x, y)`, or `grad(x^2 y, x, y)`",
        '‖' | '∥' => "the length is `|p|`",
        '⌊' | '⌋' => "write it as a function: `floor(x)`",
        '⌈' | '⌉' => "write it as a function: `ceil(x)`",
        '⟨' | '⟩' => "a vector is `(a, b)`, the inner product `dot(a, b)`",
        '″' => "write `''`",
        '°' => "angles are in radians: write `radians(90)` for 90°",
        '±' | '∓' => "write the two formulas, one with `+` and one with `-`",
        '→' | '↦' | '⇒' => "a function is defined by `name(x) = …`",
        '\u{304}' | '\u{305}' => "the conjugate is `conj(z)`",
        '\u{300}'..='\u{36F}' => "remove the mark above or below the letter",
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
