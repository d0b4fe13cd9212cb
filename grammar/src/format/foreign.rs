//! Where statements in another notation are.

use crate::Span;

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
