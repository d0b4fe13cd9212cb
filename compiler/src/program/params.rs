//! Parameters and constant expressions.

use super::ParamInfo;
use super::checker::Checker;
use crate::check::{MAX_PARAMS, Value, not_constant};
use crate::ir::{Graph, Id};
use crate::numeral::Numeral;
use crate::types::Type;
use pullback_grammar::Diagnostic;
use pullback_grammar::ast::{ExprId, Item, Param};

impl<'a> Checker<'a> {
    pub(super) fn params(&mut self) -> Vec<ParamInfo> {
        let file = self.file;
        let params = file.items.iter().filter_map(|item| match item {
            Item::Param(param) => Some(param),
            _ => None,
        });
        // more have been refused
        let mut out = Vec::new();
        let mut ranges = Vec::new();
        for param in params.take(MAX_PARAMS) {
            let info = self.param(param);
            ranges.push(param.range.map(|_| (info.lo, info.hi)));
            out.push(info);
        }
        self.ranges = ranges;
        out
    }

    pub(super) fn param(&mut self, param: &'a Param) -> ParamInfo {
        let default = self
            .constant(param.default, "the default of a parameter")
            .unwrap_or(0.0);
        let reach = default.abs().max(1.0);
        let (mut lo, mut hi) = (
            (default - reach).max(f64::MIN),
            (default + reach).min(f64::MAX),
        );
        if let Some((from, to)) = param.range {
            lo = self.constant(from, "an end of a range").unwrap_or(lo);
            hi = self.constant(to, "an end of a range").unwrap_or(hi);
            let span = self.file.exprs.span(from).join(self.file.exprs.span(to));
            if lo >= hi {
                self.diagnostics.push(
                    Diagnostic::error(
                        "bad-range",
                        span,
                        format!("the range {}..{} is empty", Numeral(lo), Numeral(hi)),
                    )
                    .with_label("the first end must be the lesser one")
                    .with_hint(if lo > hi {
                        format!("write `{}..{}`", Numeral(hi), Numeral(lo))
                    } else {
                        "write two different ends".to_owned()
                    }),
                );
            } else if !(lo..=hi).contains(&default) {
                self.diagnostics.push(
                    Diagnostic::error(
                        "default-outside-range",
                        self.file.exprs.span(param.default),
                        format!(
                            "the default {} is not in {}..{}",
                            Numeral(default),
                            Numeral(lo),
                            Numeral(hi)
                        ),
                    )
                    .with_related(span, "the range")
                    .with_hint(format!(
                        "make the range `{}..{}` to include it, or choose a default inside",
                        Numeral(lo.min(default)),
                        Numeral(hi.max(default))
                    )),
                );
            }
        }
        ParamInfo {
            name: param.name.text.clone(),
            default,
            lo,
            hi,
        }
    }

    /// The value of a real constant expression; reports one that is not.
    pub(super) fn constant(&mut self, expr: ExprId, what: &str) -> Option<f64> {
        let span = self.file.exprs.span(expr);
        let (value, graph) = self.constant_value(expr)?;
        match value.ty(&graph)? {
            Type::Real => self.finite(&value, &graph, expr, what),
            ty => {
                let problem = Diagnostic::error(
                    "type-mismatch",
                    span,
                    format!(
                        "{what} must be a real number, and this is {}",
                        ty.in_words()
                    ),
                );
                self.diagnostics.push(if ty == Type::Complex {
                    problem.with_hint("use one parameter for each part, as in `a + b i`")
                } else {
                    problem.with_hint("use one parameter for each number")
                });
                None
            }
        }
    }

    /// Builds an expression that must be constant. Warnings are left out where the value is refused anyway.
    pub(super) fn constant_value(&mut self, expr: ExprId) -> Option<(Value, Graph)> {
        let mut builder = self.builder();
        let value = builder.expr(expr);
        let is_number = |id: &Id| builder.graph.as_real(*id).is_none_or(f64::is_finite);
        if !value.ids().iter().all(is_number) {
            builder.diagnostics.retain(Diagnostic::is_error);
        }
        self.finish(&mut builder);
        (value != Value::Error).then_some((value, builder.graph))
    }

    pub(super) fn finite(
        &mut self,
        value: &Value,
        graph: &Graph,
        expr: ExprId,
        what: &str,
    ) -> Option<f64> {
        let span = self.file.exprs.span(expr);
        let number = value.ids().first().and_then(|&id| graph.as_real(id));
        match number {
            Some(x) if x.is_finite() => Some(x),
            Some(x) => {
                self.diagnostics.push(
                    Diagnostic::error(
                        "not-finite",
                        span,
                        format!("{what} is {}", infinity_or_nan(x)),
                    )
                    .with_hint("write a finite number"),
                );
                None
            }
            None => {
                if !self.has_error_in(span) {
                    self.diagnostics.push(not_constant(span, what));
                }
                None
            }
        }
    }
}

pub(super) fn infinity_or_nan(x: f64) -> &'static str {
    if x.is_nan() {
        "not a number"
    } else {
        "infinite"
    }
}
