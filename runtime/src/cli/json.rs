//! Findings for programs such as editors: `docs/diagnostics.md`, `docs/schema/diagnostics-1.json`.

use pullback_compiler::program::{ConstantInfo, FunctionInfo, Outline, ParamInfo};
use pullback_compiler::types::Type;
use pullback_compiler::{Picture, Program};
use pullback_grammar::{Diagnostic, Severity, Span};
use serde::Serialize;

/// Version of the schema: the number grows when a program that reads the older one would misread the newer.
const VERSION: u32 = 1;

/// The findings of one run.
#[derive(Debug, Serialize)]
pub(super) struct Report {
    version: u32,
    files: Vec<FileReport>,
    summary: Summary,
}

#[derive(Debug, Serialize)]
struct Summary {
    files: usize,
    errors: usize,
    warnings: usize,
}

/// The findings about one input.
#[derive(Debug, Serialize)]
pub(super) struct FileReport {
    file: String,
    ok: bool,
    diagnostics: Vec<Finding>,
    symbols: Symbols,
    shows: Vec<Shown>,
}

#[derive(Debug, Serialize)]
struct Finding {
    severity: &'static str,
    code: &'static str,
    message: String,
    span: Place,
    label: Option<String>,
    related: Vec<Related>,
    hint: Option<String>,
}

#[derive(Debug, Serialize)]
struct Related {
    span: Place,
    message: String,
}

/// A part of the text: bytes, and lines with columns as the Language Server Protocol counts them.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Place {
    start: usize,
    end: usize,
    range: Range,
}

#[derive(Clone, Debug, Serialize)]
struct Range {
    start: Position,
    end: Position,
}

/// Line and UTF-16 code units in it, both from 0.
#[derive(Clone, Copy, Debug, Serialize, PartialEq, Eq)]
struct Position {
    line: usize,
    character: usize,
}

#[derive(Debug, Serialize)]
struct Symbols {
    functions: Vec<Function>,
    constants: Vec<Constant>,
    params: Vec<Param>,
}

#[derive(Debug, Serialize)]
struct Function {
    name: String,
    span: Place,
    parameters: Vec<Parameter>,
    signatures: Vec<Signature>,
}

#[derive(Debug, Serialize)]
struct Parameter {
    name: String,
    #[serde(rename = "type")]
    ty: Option<String>,
}

#[derive(Debug, Serialize)]
struct Signature {
    parameters: Vec<String>,
    result: String,
}

#[derive(Debug, Serialize)]
struct Constant {
    name: String,
    span: Place,
    #[serde(rename = "type")]
    ty: Option<String>,
}

#[derive(Debug, Serialize)]
struct Param {
    name: String,
    span: Place,
    default: f64,
    min: f64,
    max: f64,
}

#[derive(Debug, Serialize)]
struct Shown {
    scene: &'static str,
    function: String,
    span: Place,
    parameters: Vec<Parameter>,
    result: String,
}

impl Report {
    /// The findings about these files.
    pub(super) fn new(files: Vec<FileReport>) -> Self {
        let count = |severity: &str| {
            let findings = files.iter().flat_map(|file| &file.diagnostics);
            findings.filter(|found| found.severity == severity).count()
        };
        Self {
            version: VERSION,
            summary: Summary {
                files: files.len(),
                errors: count("error"),
                warnings: count("warning"),
            },
            files,
        }
    }
}

impl FileReport {
    /// The findings about a text.
    pub(super) fn new(
        file: &str,
        text: &str,
        diagnostics: &[Diagnostic],
        outline: &Outline,
        program: Option<&Program>,
    ) -> Self {
        let places = Places::new(text);
        let finding = |diagnostic: &Diagnostic| places.finding(diagnostic);
        let pictures = program.map(Program::pictures).unwrap_or_default();
        Self {
            file: file.to_owned(),
            ok: !diagnostics.iter().any(Diagnostic::is_error),
            diagnostics: diagnostics.iter().map(finding).collect(),
            symbols: Symbols {
                functions: outline
                    .functions
                    .iter()
                    .map(|f| places.function(f))
                    .collect(),
                constants: outline
                    .constants
                    .iter()
                    .map(|c| places.constant(c))
                    .collect(),
                params: outline
                    .params
                    .iter()
                    .map(|(span, info)| places.param(*span, info))
                    .collect(),
            },
            shows: pictures
                .iter()
                .map(|picture| places.shown(picture))
                .collect(),
        }
    }
}

/// A text and where its lines begin.
pub(super) struct Places<'a> {
    text: &'a str,
    starts: Vec<usize>,
}

impl<'a> Places<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        let bytes = text.as_bytes();
        let ends_line = |&at: &usize| match bytes[at] {
            b'\n' => true,
            b'\r' => bytes.get(at + 1) != Some(&b'\n'),
            _ => false,
        };
        let breaks = (0..bytes.len()).filter(ends_line).map(|at| at + 1);
        Self {
            text,
            starts: std::iter::once(0).chain(breaks).collect(),
        }
    }

    fn position(&self, at: usize) -> Position {
        let line = self
            .starts
            .partition_point(|&start| start <= at)
            .saturating_sub(1);
        let start = self.starts.get(line).copied().unwrap_or(0);
        let before = self.text.get(start..at).unwrap_or_default();
        Position {
            line,
            character: before.encode_utf16().count(),
        }
    }

    /// The place of a span; one beyond the text is at its end.
    pub(super) fn place(&self, span: Span) -> Place {
        let fit = |at: u32| {
            let at = (at as usize).min(self.text.len());
            (0..=at)
                .rev()
                .find(|&at| self.text.is_char_boundary(at))
                .unwrap_or(0)
        };
        let (start, end) = (fit(span.start), fit(span.end));
        Place {
            start,
            end,
            range: Range {
                start: self.position(start),
                end: self.position(end),
            },
        }
    }

    fn finding(&self, diagnostic: &Diagnostic) -> Finding {
        let related = |(span, message): &(Span, String)| Related {
            span: self.place(*span),
            message: message.clone(),
        };
        Finding {
            severity: match diagnostic.severity {
                Severity::Error => "error",
                Severity::Warning => "warning",
            },
            code: diagnostic.code,
            message: diagnostic.message.clone(),
            span: self.place(diagnostic.span),
            label: (!diagnostic.label.is_empty()).then(|| diagnostic.label.clone()),
            related: diagnostic.related.iter().map(related).collect(),
            hint: diagnostic.hint.clone(),
        }
    }

    fn function(&self, function: &FunctionInfo) -> Function {
        Function {
            name: function.name.clone(),
            span: self.place(function.span),
            parameters: function
                .params
                .iter()
                .map(|(name, ty)| parameter(name, *ty))
                .collect(),
            signatures: function
                .signatures
                .iter()
                .map(|signature| Signature {
                    parameters: signature.inputs.iter().map(Type::to_string).collect(),
                    result: signature.result.to_string(),
                })
                .collect(),
        }
    }

    fn constant(&self, constant: &ConstantInfo) -> Constant {
        Constant {
            name: constant.name.clone(),
            span: self.place(constant.span),
            ty: constant.ty.map(|ty| ty.to_string()),
        }
    }

    fn param(&self, span: Span, info: &ParamInfo) -> Param {
        Param {
            name: info.name.clone(),
            span: self.place(span),
            default: info.default,
            min: info.lo,
            max: info.hi,
        }
    }

    fn shown(&self, picture: &Picture) -> Shown {
        let formula = &picture.formula;
        let inputs = formula.inputs.iter();
        Shown {
            scene: picture.scene.name,
            function: formula.name.clone(),
            span: self.place(formula.span),
            parameters: inputs
                .map(|input| parameter(&input.name, Some(input.ty)))
                .collect(),
            result: formula.ty.to_string(),
        }
    }
}

fn parameter(name: &str, ty: Option<Type>) -> Parameter {
    Parameter {
        name: name.to_owned(),
        ty: ty.map(|ty| ty.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_utf16_code_units() {
        let text = "a\r\n𝟙é b\rc\nd";
        let places = Places::new(text);
        let check = |part: &str, line, character| {
            let at = text.find(part).unwrap();
            let wanted = Position { line, character };
            assert_eq!(places.position(at), wanted, "{part}");
        };
        check("a", 0, 0);
        check("𝟙", 1, 0);
        check("é", 1, 2);
        check("b", 1, 4);
        check("c", 2, 0);
        check("d", 3, 0);
        let end = places.place(Span::new(1000, 2000));
        assert_eq!((end.start, end.end), (text.len(), text.len()));
        assert_eq!(
            end.range.end,
            Position {
                line: 3,
                character: 1
            }
        );
        let inside = places.place(Span::new(4, 5));
        assert_eq!(inside.start, 3, "not within a character");
    }
}
