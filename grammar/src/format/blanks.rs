//! Which tokens are apart on a line.

use super::pieces::Piece;
use crate::paste::names::is_type_mark;
use crate::token::{Token, TokenKind};

/// Where a token stands among operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    /// A bracket or bar that opens.
    Opening,
    /// The bracket that opens arguments or parameters.
    OpeningArguments,
    /// A bracket or bar that closes.
    Closing,
    /// A sign before its operand.
    Prefix,
    /// A sign behind its operand.
    Postfix,
    /// An operator between two operands.
    Infix,
    /// Anything else.
    Operand,
}

impl Place {
    /// The place of an opening bracket where a name before it calls.
    pub(super) fn in_call(self, calls: bool) -> Self {
        if calls && self == Self::Opening {
            Self::OpeningArguments
        } else {
            self
        }
    }

    /// Whether this opens a bracket or bar.
    pub(super) fn opens(self) -> bool {
        matches!(self, Self::Opening | Self::OpeningArguments)
    }
}

/// Whether a blank stands between two tokens of a line. `gap` says whether the author left them apart, which counts
/// between the factors of a product without a sign.
pub(super) fn blank_between(
    text: &str,
    before: (Token, Place),
    after: (Token, Place),
    gap: bool,
) -> bool {
    use TokenKind::{Caret, Colon, Comma, Dot, DotDot, Equals, LBrace, Slash};
    let (left, right) = (before.0.kind, after.0.kind);
    let is_apart = |token: Token| token.kind.is_keyword() || token.kind == Equals;
    if right == Dot && matches!(left, TokenKind::Number | TokenKind::Imaginary) {
        // `0 .f`, which is no number
        return true;
    }
    if left == TokenKind::Number && right == TokenKind::Name {
        // `2 f`, which is a product wherever it stands
        return gap || is_type_mark(after.0.span.text(text), false);
    }
    if before.1.opens() || matches!(right, Comma | Colon | DotDot | Dot) || left == Dot {
        return false;
    }
    if left == DotDot {
        // `1.. .5`, not three points.
        return after.0.span.text(text).starts_with('.');
    }
    if left == TokenKind::Superscript && right == left {
        // `x² ³` is (x²)³, and x²³ is not.
        return gap;
    }
    match (before.1, after.1) {
        (_, Place::Postfix | Place::OpeningArguments) => return false,
        (Place::Prefix, _) => return before.0.span.text(text) == "not",
        _ => {}
    }
    if matches!(left, Caret | Slash) || matches!(right, Caret | Slash) {
        return false;
    }
    before.1 == Place::Infix
        || after.1 == Place::Infix
        || matches!(left, Comma | Colon)
        || is_apart(before.0)
        || is_apart(after.0)
        || right == LBrace
        || gap
}

/// Sets blanks around the `/` of products that have a `*`, too: `a * b / c`, but `a b/c`; and `a * b/c d`, where the
/// blanks say that d is no part of the divisor.
pub(super) fn even_out_division(run: &mut [Piece<'_>]) {
    let mut start = 0;
    while start < run.len() {
        let ends = |piece: &Piece| piece_ends_product(piece);
        let rest = run.get(start..).unwrap_or_default();
        let length = rest.iter().position(ends).unwrap_or(rest.len());
        let product = run.get_mut(start..start + length).unwrap_or_default();
        let multiplies = product.iter().any(|piece| piece.kind == TokenKind::Star);
        if multiplies && !has_factor_apart(product) {
            let mut behind = false;
            for piece in product {
                let divides = piece.kind == TokenKind::Slash;
                piece.blank |= behind || divides;
                behind = divides;
            }
        }
        start += length + 1;
    }
}

/// Whether a factor without a sign stands apart behind a division.
fn has_factor_apart(product: &[Piece<'_>]) -> bool {
    let is_sign = |piece: &Piece| matches!(piece.kind, TokenKind::Star | TokenKind::Slash);
    let mut parts = product.chunk_by(|_, next| !is_sign(next));
    parts.any(|part| {
        let divides = part
            .first()
            .is_some_and(|piece| piece.kind == TokenKind::Slash);
        divides && part.iter().skip(2).any(|piece| piece.blank)
    })
}

/// Whether no product goes on over this piece.
fn piece_ends_product(piece: &Piece<'_>) -> bool {
    use TokenKind::{Caret, Colon, Comma, DotDot, Equals, Slash, Star};
    match piece.kind {
        Star | Slash | Caret => false,
        Comma | Colon | Equals | DotDot => true,
        kind => piece.is_infix || kind.is_keyword(),
    }
}
