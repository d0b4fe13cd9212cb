//! Diagnostics to text for people, with the lines that they are about.

use std::ops::Range;

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet};

use crate::{Diagnostic, Severity, Span};

/// Most bytes of source that are shown in one piece; beyond, each place is cut out with what is around it.
const WINDOW: usize = 2000;
/// Characters shown on either side of a place that is cut out.
const AROUND: usize = 60;
/// Most bytes of a place that is cut out.
const CUT: usize = 120;

/// The diagnostics as a compiler shows them: message, place, line with remarks, and the hint as help.
///
/// Spans that do not fit `source` are moved to the nearest place that does. With `color`, ANSI escapes are used.
#[must_use]
pub fn render(diagnostics: &[Diagnostic], file_name: &str, source: &str, color: bool) -> String {
    let renderer = if color {
        Renderer::styled()
    } else {
        Renderer::plain()
    };
    let renderer = renderer.decor_style(DecorStyle::Ascii);
    let lines = Lines::new(source);
    let mut out = String::new();
    for diagnostic in diagnostics {
        let group = group(diagnostic, file_name, &lines);
        out.push_str(&renderer.render(&[group]));
        out.push_str("\n\n");
    }
    out.pop();
    out
}

/// A source text and where its lines begin.
struct Lines<'a> {
    source: &'a str,
    starts: Vec<usize>,
}

impl<'a> Lines<'a> {
    fn new(source: &'a str) -> Self {
        let breaks = source.match_indices('\n').map(|(at, _)| at + 1);
        Self {
            source,
            starts: std::iter::once(0).chain(breaks).collect(),
        }
    }

    /// Index of the line of a byte.
    fn line(&self, at: usize) -> usize {
        self.starts
            .partition_point(|&start| start <= at)
            .saturating_sub(1)
    }

    /// The range of bytes of a line, without its break.
    fn range(&self, line: usize) -> Range<usize> {
        let start = self.starts.get(line).copied().unwrap_or(0);
        let next = self.starts.get(line + 1).map(|next| next - 1);
        start..next.unwrap_or(self.source.len())
    }

    /// File, line and column of a byte.
    fn origin<'b>(&self, file_name: &'b str, at: usize) -> Origin<'b> {
        let line = self.line(at);
        let before = self.source.get(self.range(line).start..at).unwrap_or("");
        Origin::path(file_name)
            .line(line + 1)
            .char_column(before.chars().count() + 1)
    }

    /// The nearest range that lies in the text and on characters.
    fn fit(&self, span: Span) -> Range<usize> {
        let start = floor(self.source, span.start as usize);
        let end = ceil(self.source, span.end as usize);
        start..end.max(start)
    }
}

fn group<'a>(diagnostic: &'a Diagnostic, file_name: &'a str, lines: &Lines<'a>) -> Group<'a> {
    let level = match diagnostic.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
    };
    let title = level.primary_title(diagnostic.message.as_str());
    let mut group = Group::with_title(title.id(diagnostic.code));
    let primary = lines.fit(diagnostic.span);
    let mut places = vec![(
        primary.clone(),
        diagnostic.label.as_str(),
        AnnotationKind::Primary,
    )];
    for (span, remark) in &diagnostic.related {
        places.push((lines.fit(*span), remark.as_str(), AnnotationKind::Context));
    }
    let first = places.iter().map(|place| place.0.start).min().unwrap_or(0);
    let last = places.iter().map(|place| place.0.end).max().unwrap_or(0);
    let window = lines.range(lines.line(first)).start..lines.range(lines.line(last)).end;
    if window.len() <= WINDOW {
        let text = lines.source.get(window.clone()).unwrap_or("");
        if text.is_empty() {
            group = group.element(lines.origin(file_name, primary.start));
        } else {
            // The carriage return of a line break would be drawn.
            let text = text.replace('\r', " ");
            let mut snippet = Snippet::source(text)
                .path(file_name)
                .line_start(lines.line(first) + 1);
            for (place, label, kind) in places {
                let place = place.start - window.start..place.end - window.start;
                snippet = snippet.annotation(annotation(place, label, kind));
            }
            group = group.element(snippet);
        }
    } else {
        group = group.element(lines.origin(file_name, primary.start));
        for (place, label, kind) in places {
            let (text, shown) = cut(lines, &place);
            let snippet = Snippet::source(text).line_start(lines.line(place.start) + 1);
            group = group.element(snippet.annotation(annotation(shown, label, kind)));
        }
    }
    if let Some(hint) = &diagnostic.hint {
        group = group.element(Level::HELP.message(hint.as_str()));
    }
    group
}

fn annotation<'a>(
    place: Range<usize>,
    label: &'a str,
    kind: AnnotationKind,
) -> annotate_snippets::Annotation<'a> {
    let annotation = kind.span(place);
    if label.is_empty() {
        annotation
    } else {
        annotation.label(label)
    }
}

/// A place with a little of its line around it, and the range of the place in that text.
fn cut(lines: &Lines<'_>, place: &Range<usize>) -> (String, Range<usize>) {
    let source = lines.source;
    let line = lines.range(lines.line(place.start));
    let end = place
        .end
        .min(place.start + CUT)
        .min(line.end)
        .max(place.start);
    let end = floor(source, end).max(place.start);
    let before = source.get(line.start..place.start).unwrap_or("");
    let after = source.get(end..line.end).unwrap_or("");
    let from = before
        .char_indices()
        .rev()
        .nth(AROUND)
        .map_or(0, |(at, _)| at);
    let to = after
        .char_indices()
        .nth(AROUND)
        .map_or(after.len(), |(at, _)| at);
    let mut text = String::new();
    if from > 0 {
        text.push('…');
    }
    text.push_str(before.get(from..).unwrap_or(""));
    let start = text.len();
    text.push_str(source.get(place.start..end).unwrap_or(""));
    let stop = text.len();
    text.push_str(after.get(..to).unwrap_or(""));
    if to < after.len() {
        text.push('…');
    }
    (text, start..stop)
}

/// The last boundary of characters at or before `at`.
fn floor(text: &str, at: usize) -> usize {
    let at = at.min(text.len());
    (0..=at)
        .rev()
        .find(|&at| text.is_char_boundary(at))
        .unwrap_or(0)
}

/// The first boundary of characters at or behind `at`.
fn ceil(text: &str, at: usize) -> usize {
    (at..text.len())
        .find(|&at| text.is_char_boundary(at))
        .unwrap_or(text.len())
}
