//! Warnings about integrals that a scene asks for and that have no closed form.

use pullback_grammar::{Diagnostic, Span};

use super::checker::Checker;
use crate::formula::Formula;
use crate::integrate::{Otherwise, field_integral};
use crate::scene::Scene;

impl Checker<'_> {
    /// Warns where a scene that integrates its formula along rays does so numerically. What exceeds a bound is an error
    /// once the scene is made.
    pub(super) fn warn_of_quadrature(&mut self, scene: &Scene, formula: &Formula) {
        let mut functions = scene.module().functions.iter();
        if !functions.any(|(_, f)| f.name.as_deref() == Some("field_integral")) {
            return;
        }
        let Ok(made) = field_integral(formula, Otherwise::Quadrature) else {
            return;
        };
        for problem in &made.integral.numerical {
            let place = if problem.span == Span::default() {
                formula.span
            } else {
                problem.span
            };
            let message = "the integral of this along a ray is computed numerically";
            let warning = Diagnostic::warning("no-closed-form", place, message)
                .with_label(problem.reason.in_words());
            if !self.diagnostics.contains(&warning) {
                self.diagnostics.push(warning);
            }
        }
    }
}
