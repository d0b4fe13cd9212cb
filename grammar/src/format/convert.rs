//! Statements in another notation: they are written anew.

use crate::Span;
use crate::ast::{Exprs, Item};
use crate::printer::print_item;

/// What a statement consists of, where some of it is another notation.
pub(super) struct Foreign<'a> {
    text: &'a str,
    places: &'a [Span],
}

impl<'a> Foreign<'a> {
    /// The places in the text that are another notation, in order.
    pub(super) fn new(text: &'a str, places: &'a [Span]) -> Self {
        Self { text, places }
    }

    /// The place of the next statement with what belongs to it in another notation, if anything does. `span` is the
    /// place of its tokens, `next` where those of the statement behind it begin. To be asked in the order of the text.
    pub(super) fn extent(&mut self, span: Span, next: u32) -> Option<Span> {
        let mut whole = None;
        while let Some((&place, rest)) = self.places.split_first() {
            let belongs =
                place.start < span.end || (place.start < next && !self.is_apart(span.end, place));
            if !belongs {
                break;
            }
            whole = Some(whole.unwrap_or(span).join(place));
            self.places = rest;
        }
        whole
    }

    /// Whether a line or statement ends between a statement that ends at `from` and what stands at a place.
    fn is_apart(&self, from: u32, place: Span) -> bool {
        let closes = matches!(place.text(self.text), "}" | ")" | "]");
        let between = self.text.get(from as usize..place.start as usize);
        !closes && between.is_some_and(|gap| gap.contains(['\n', '\r', ';']))
    }
}

/// The lines of a statement that is written anew. `is_function` says which names are functions, those of the file
/// among them.
pub(super) fn lines(exprs: &Exprs, item: &Item, is_function: &dyn Fn(&str) -> bool) -> String {
    let printed = print_item(exprs, item);
    let letters = |text: &str| -> String { text.split_whitespace().collect() };
    match super::unconverted(&printed, is_function) {
        Some(broken) if letters(&broken) == letters(&printed) => broken.trim_end().to_owned(),
        _ => printed,
    }
}
