//! What holds for the answer to any text.

use pullback_compiler::lower::Precision;
use pullback_compiler::{Compilation, EmitWhat, Target, What};
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

/// Says what is wrong with the parser's answer to a text, if anything: places, and that printing and formatting
/// what was read changes nothing.
///
/// # Errors
/// What does not hold.
pub fn parsing(bytes: &[u8]) -> Result<(), String> {
    let is_function = pullback_compiler::check::is_builtin_function;
    let parsed = pullback_grammar::parse_bytes(bytes, &is_function);
    let Ok(text) = std::str::from_utf8(bytes) else {
        return if parsed.has_errors() {
            Ok(())
        } else {
            Err("no error for what is no text".into())
        };
    };
    diagnostics(text, &parsed.diagnostics)?;
    for (id, expr, span) in parsed.file.exprs.iter() {
        inside(text, span).ok_or(format!("{span:?} of {expr:?} is no place of the text"))?;
        let mut ordered = true;
        expr.for_each_child(|child| ordered &= child < id);
        if !ordered {
            return Err(format!("an operand behind its user {expr:?}"));
        }
    }
    let shown = pullback_grammar::render(&parsed.diagnostics, "fuzz.pull", text, true);
    if shown.is_empty() != parsed.diagnostics.is_empty() {
        return Err("diagnostics are not shown".into());
    }
    if parsed.has_errors() {
        return Ok(());
    }
    let again = |text: &str| pullback_grammar::parse(text, &is_function);
    let printed = pullback_grammar::print(&parsed.file);
    let reread = again(&printed);
    if reread.has_errors() {
        return Err(format!(
            "what is printed has errors: {printed}\n{:?}",
            reread.diagnostics
        ));
    }
    let twice = pullback_grammar::print(&reread.file);
    if twice != printed {
        return Err(format!("printed once\n{printed}\nprinted twice\n{twice}"));
    }
    crate::formatting::tree(text)
}

/// Says what is wrong with the compiler's answer to a text, if anything; of a program, also with its graph, its
/// values and, where `modules` is set, with its modules.
///
/// # Errors
/// What does not hold.
pub fn compiling(bytes: &[u8], modules: bool) -> Result<(), String> {
    let answer = pullback_compiler::compile_bytes(bytes);
    let Ok(text) = std::str::from_utf8(bytes) else {
        let refused =
            answer.program.is_none() && answer.diagnostics.iter().any(Diagnostic::is_error);
        return if refused {
            Ok(())
        } else {
            Err("no error for what is no text".into())
        };
    };
    compilation(text, &answer)?;
    if let Some(internal) = answer
        .diagnostics
        .iter()
        .find(|d| d.code.starts_with("internal"))
    {
        return Err(format!("{internal:?}"));
    }
    let Some(program) = &answer.program else {
        return Ok(());
    };
    let params: Vec<f64> = program.params().iter().map(|p| p.default).collect();
    for (k, picture) in program.pictures().iter().enumerate().take(3) {
        let formula = &picture.formula;
        pullback_compiler::ir::verify(&formula.graph).map_err(|e| format!("{e:?}"))?;
        if formula.graph.nodes().len() > 20_000 {
            continue;
        }
        for what in [What::Value, What::Gradient, What::Derivative, What::Hessian] {
            match program.evaluator(k, what) {
                Ok(mut evaluator) => {
                    let mut out = vec![0.0; evaluator.outputs().len()];
                    evaluator.eval(&params, 0.0, 0.01, &[0.3, -0.7, 1.1, 0.5], &mut out);
                }
                Err(problems) => refused(text, &problems)?,
            }
        }
        if modules {
            if let Err(problems) = program.scene_module(k, Precision::Accurate) {
                refused(text, &problems)?;
            }
            for target in Target::ALL {
                if let Err(problems) = program.emit(k, EmitWhat::Value, target, Precision::Fast) {
                    refused(text, &problems)?;
                }
            }
        }
    }
    Ok(())
}

/// A refusal has a reason that is not a mistake of ours.
fn refused(text: &str, problems: &[Diagnostic]) -> Result<(), String> {
    diagnostics(text, problems)?;
    match problems.iter().find(|d| d.code.starts_with("internal")) {
        Some(internal) => Err(format!("{internal:?}")),
        None if problems.is_empty() => Err("refused without a reason".into()),
        None => Ok(()),
    }
}
