//! What the parser complains about, one function for each problem, and how it goes on from there.

mod bracket;
mod call;
mod division;
mod form;
mod name;
mod operand;
mod operator;
mod statement;

pub(crate) use division::Division;
pub(crate) use statement::foreign_statement;

use crate::Span;
use crate::cursor::Parser;
use crate::stray::shorten;
use crate::token::TokenKind;

impl Parser<'_> {
    /// The token here, quoted.
    pub(crate) fn describe(&self) -> String {
        if self.at(TokenKind::End) {
            "the end of the statement".to_owned()
        } else {
            self.quote(self.span())
        }
    }

    /// The text at a place, quoted and short.
    pub(crate) fn quote(&self, span: Span) -> String {
        format!("`{}`", self.short(span))
    }

    /// The text at a place, shortened.
    pub(crate) fn short(&self, span: Span) -> String {
        shorten(span.text(self.text))
    }
}
