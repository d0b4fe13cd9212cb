//! What holds for the answer to any text.

use pullback_compiler::Compilation;
use pullback_grammar::{Diagnostic, Span};

/// Longest message, label or hint, in characters: names and numbers of any length are cut.
const LONGEST: usize = 400;

/// Says what is wrong with an answer of the compiler, if anything: spans inside of the text and on characters,
/// an error wherever there is no program and none where there is one, texts of bounded length.
///
/// # Errors
/// What does not hold.
pub fn compilation(text: &str, answer: &Compilation) -> Result<(), String> {
    diagnostics(text, &answer.diagnostics)?;
    let failed = answer.diagnostics.iter().any(Diagnostic::is_error);
    match (&answer.program, failed) {
        (None, false) => Err("neither a program nor an error".into()),
        (Some(_), true) => Err("a program in spite of an error".into()),
        (Some(program), false) if program.pictures().is_empty() => Err("nothing is shown".into()),
        _ => Ok(()),
    }
}

/// Says what is wrong with diagnostics about a text, if anything.
///
/// # Errors
/// What does not hold.
pub fn diagnostics(text: &str, diagnostics: &[Diagnostic]) -> Result<(), String> {
    for diagnostic in diagnostics {
        let related = diagnostic.related.iter().map(|(span, _)| span);
        for span in std::iter::once(&diagnostic.span).chain(related) {
            inside(text, *span)
                .ok_or(format!("{span:?} is no place of the text: {diagnostic:?}"))?;
        }
        wording(diagnostic)?;
    }
    Ok(())
}

fn inside(text: &str, span: Span) -> Option<()> {
    text.get(span.start as usize..span.end as usize).map(|_| ())
}

/// Short, lower case, without a full stop, and on one line.
fn wording(diagnostic: &Diagnostic) -> Result<(), String> {
    let kebab = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    let code = diagnostic.code;
    if code.is_empty() || !code.chars().all(kebab) {
        return Err(format!("{code:?} is no code"));
    }
    let message = diagnostic.message.as_str();
    if message.is_empty()
        || message.ends_with('.')
        || message.starts_with(|c: char| c.is_uppercase())
    {
        return Err(format!("the message {message:?} of {code}"));
    }
    let remarks = diagnostic.related.iter().map(|(_, remark)| remark.as_str());
    let texts = [message, &diagnostic.label].into_iter().chain(remarks);
    for text in texts.chain(diagnostic.hint.as_deref()) {
        if text.chars().count() > LONGEST {
            return Err(format!(
                "{code} has a text of {} characters",
                text.chars().count()
            ));
        }
        if text.chars().any(char::is_control) {
            return Err(format!("{code} has a control character in {text:?}"));
        }
    }
    Ok(())
}
