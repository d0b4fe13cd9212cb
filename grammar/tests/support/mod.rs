//! What the suites share: builtin names, a tree as text, and the structure that every tree has.

#![allow(dead_code)]

pub mod fixture;
pub mod generate;

use pullback_grammar::ast::{Expr, ExprId, File, Item, Method, Name, Range};
use pullback_grammar::token::{TokenKind, tokenize};
use pullback_grammar::{Parsed, Span, parse};

/// Builtin functions, as far as these tests need them.
pub fn is_function(name: &str) -> bool {
    matches!(
        name,
        "sin"
            | "cos"
            | "tan"
            | "asin"
            | "acos"
            | "atan"
            | "exp"
            | "log"
            | "sqrt"
            | "abs"
            | "max"
            | "min"
            | "length"
            | "noise"
            | "re"
            | "im"
            | "vec2"
            | "vec3"
            | "vec4"
            | "asinh"
            | "atan2"
            | "cbrt"
            | "ceil"
            | "clamp"
            | "conj"
            | "cosh"
            | "cot"
            | "floor"
            | "heaviside"
            | "inversesqrt"
            | "log10"
            | "log2"
            | "pow"
            | "sign"
            | "sinh"
    )
}

/// Reads a text and holds the structure of its tree.
pub fn read(text: &str) -> Parsed {
    let parsed = parse(text, &is_function);
    check_structure(text, &parsed);
    parsed
}

/// The whole file, one statement a line; names of operators are those of the tree.
pub fn show_file(file: &File) -> String {
    let lines: Vec<String> = file
        .items
        .iter()
        .map(|item| show_item(file, item))
        .collect();
    lines.join("\n")
}

fn show_item(file: &File, item: &Item) -> String {
    let show = |id| show(file, id);
    match item {
        Item::Function(function) => {
            let params: Vec<String> = function
                .params
                .iter()
                .map(|param| match &param.ty {
                    Some(ty) => format!("{}:{}", param.name.text, ty.text),
                    None => param.name.text.clone(),
                })
                .collect();
            format!(
                "{}({}) = {}",
                function.name.text,
                params.join(" "),
                show(function.body)
            )
        }
        Item::Constant(constant) => format!("{} = {}", constant.name.text, show(constant.value)),
        Item::Param(param) => {
            let range = param
                .range
                .map(|(lo, hi)| format!(" in {}..{}", show(lo), show(hi)))
                .unwrap_or_default();
            format!("param {} = {}{range}", param.name.text, show(param.default))
        }
        Item::Show(item) => {
            let args: Vec<String> = item.args.iter().map(|&arg| show(arg)).collect();
            let settings: Vec<String> = item
                .settings
                .iter()
                .map(|setting| {
                    let upper = setting.upper.map(|upper| format!("..{}", show(upper)));
                    let (value, upper) = (show(setting.value), upper.unwrap_or_default());
                    format!(" {}={value}{upper}", setting.name.text)
                })
                .collect();
            format!(
                "show {}({}){}",
                item.scene.text,
                args.join(", "),
                settings.concat()
            )
        }
        Item::Formula(formula) => show(formula.body),
    }
}

/// An expression as nested brackets.
pub fn show(file: &File, id: ExprId) -> String {
    let show = |id: ExprId| show(file, id);
    let list = |ids: &[ExprId]| {
        ids.iter()
            .map(|&id| format!(" {}", show(id)))
            .collect::<String>()
    };
    let range = |r: &Range| format!("[{} {} {}]", r.name.text, show(r.lower), show(r.upper));
    match &file.exprs[id] {
        Expr::Error => "?".to_owned(),
        Expr::Number(value) => format!("{value:?}").trim_end_matches(".0").to_owned(),
        Expr::Imaginary(value) => format!("{}i", format!("{value:?}").trim_end_matches(".0")),
        Expr::Name(name) => name.text.clone(),
        Expr::Unary { op, arg } => format!("({op:?} {})", show(*arg)),
        Expr::Binary { op, lhs, rhs } => format!("({op:?} {} {})", show(*lhs), show(*rhs)),
        Expr::Compare { first, rest } => {
            let steps: String = rest
                .iter()
                .map(|(op, id)| format!(" {op:?} {}", show(*id)))
                .collect();
            format!("(Compare {}{steps})", show(*first))
        }
        Expr::Call {
            callee,
            primes,
            args,
        } => {
            let primes = "'".repeat(*primes as usize);
            format!("({}{primes}(){})", callee.text, list(args))
        }
        Expr::Member { base, field } => format!("(. {} {})", show(*base), field.text),
        Expr::Vector(items) => format!("(Vector{})", list(items)),
        Expr::If {
            cond,
            then,
            otherwise,
        } => {
            format!("(If {} {} {})", show(*cond), show(*then), show(*otherwise))
        }
        Expr::Piecewise { arms, otherwise } => {
            let arms: String = arms
                .iter()
                .map(|(c, v)| format!(" [{} {}]", show(*c), show(*v)))
                .collect();
            let otherwise = otherwise.map(|id| format!(" [else {}]", show(id)));
            format!("(Piecewise{arms}{})", otherwise.unwrap_or_default())
        }
        Expr::Where { body, locals } => {
            let locals: String = locals
                .iter()
                .map(|local| {
                    let field = local.field.as_ref();
                    let field = field.map_or(String::new(), |f| format!(".{}", f.text));
                    format!(" [{}{field} {}]", local.name.text, show(local.value))
                })
                .collect();
            format!("(Where {}{locals})", show(*body))
        }
        Expr::Series { kind, ranges, term } => {
            let ranges: String = ranges.iter().map(|r| format!(" {}", range(r))).collect();
            format!("({kind:?}{ranges} {})", show(*term))
        }
        Expr::Iterate {
            count,
            states,
            steps,
            until,
        } => {
            let states: String = states
                .iter()
                .map(|(n, v)| format!(" [{} {}]", n.text, show(*v)))
                .collect();
            let steps: String = steps.iter().map(|s| format!(" {}", show(*s))).collect();
            let until = until.map_or(String::new(), |c| format!(" [until {}]", show(c)));
            format!("(Iterate {}{states}{steps}{until})", show(*count))
        }
        Expr::Integral {
            method,
            body,
            range: r,
        } => {
            let word = if *method == Method::Closed {
                "Integral"
            } else {
                "Quadrature"
            };
            format!("({word} {} {})", range(r), show(*body))
        }
    }
}

/// Whether a name that stands for another notation can be written in this language.
fn is_name(name: &str) -> bool {
    let (tokens, problems) = tokenize(name);
    problems.is_empty() && matches!(tokens.as_slice(), [only] if only.kind == TokenKind::Name)
}

/// Holds what every tree and every complaint has: spans inside of the text and on characters, operands before
/// their users and inside of them, expressions inside of their statements.
pub fn check_structure(text: &str, parsed: &Parsed) {
    let inside = |span: Span| {
        assert!(span.start <= span.end, "{span:?} in {text:?}");
        assert!(
            text.get(span.start as usize..span.end as usize).is_some(),
            "{span:?} in {text:?}"
        );
    };
    let within = |outer: Span, inner: Span| {
        assert!(
            outer.start <= inner.start && inner.end <= outer.end,
            "{inner:?} not in {outer:?} of {text:?}"
        );
    };
    let named = |outer: Span, name: &Name| {
        within(outer, name.span);
        let written = name.span.text(text);
        assert!(
            written == name.text || is_name(&name.text),
            "{written:?} is no name in {text:?}"
        );
    };
    let file = &parsed.file;
    for (id, expr, span) in file.exprs.iter() {
        inside(span);
        expr.for_each_child(|child| {
            assert!(child < id, "operand after its user in {text:?}");
            within(span, file.exprs.span(child));
        });
        match expr {
            Expr::Name(name)
            | Expr::Call { callee: name, .. }
            | Expr::Member { field: name, .. } => named(span, name),
            Expr::Error => assert!(parsed.has_errors(), "an unreported error in {text:?}"),
            Expr::Compare { rest, .. } => assert!(!rest.is_empty()),
            Expr::Vector(items) => assert!((2..=4).contains(&items.len())),
            Expr::Series { ranges, .. } => {
                assert!(!ranges.is_empty());
                ranges.iter().for_each(|range| named(span, &range.name));
            }
            Expr::Iterate { states, steps, .. } => {
                let joint = parsed.file.exprs.joint_step(steps, states.len());
                assert!(!states.is_empty());
                assert!(states.len() == steps.len() || joint.is_some());
                states.iter().for_each(|state| named(span, &state.0));
            }
            Expr::Integral { range, .. } => named(span, &range.name),
            Expr::Where { locals, .. } => {
                for local in locals {
                    named(span, &local.name);
                    local.field.iter().for_each(|field| named(span, field));
                }
            }
            _ => {}
        }
    }
    for item in &file.items {
        let (whole, parts): (Span, Vec<ExprId>) = match item {
            Item::Function(item) => (item.span, vec![item.body]),
            Item::Constant(item) => (item.span, vec![item.value]),
            Item::Formula(item) => (item.span, vec![item.body]),
            Item::Param(item) => {
                let ends = item.range.iter().flat_map(|range| [range.0, range.1]);
                (item.span, ends.chain([item.default]).collect())
            }
            Item::Show(item) => {
                let settings = item.settings.iter().flat_map(|s| [Some(s.value), s.upper]);
                (
                    item.span,
                    settings
                        .flatten()
                        .chain(item.args.iter().copied())
                        .collect(),
                )
            }
        };
        inside(whole);
        for part in parts {
            within(whole, file.exprs.span(part));
        }
    }
    for diagnostic in &parsed.diagnostics {
        inside(diagnostic.span);
        for (span, _) in &diagnostic.related {
            inside(*span);
        }
        let message = &diagnostic.message;
        assert!(
            !message.is_empty() && !message.ends_with('.'),
            "{message:?}"
        );
        assert!(
            !message.starts_with(|c: char| c.is_uppercase()),
            "{message:?}"
        );
        assert!(
            diagnostic
                .code
                .chars()
                .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-')
        );
    }
}
