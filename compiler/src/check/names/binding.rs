//! Names that hold in a part of an expression: locals, running variables, and states of iterations.

use pullback_grammar::ast::{ExprId, Local, Name, Range};
use pullback_grammar::{Diagnostic, Span};
use rustc_hash::FxHashMap;

use super::Walk;
use crate::check::suggest::quoted;
use crate::check::symbols::reserved;

/// Where each name of a list was first given.
type Seen<'a> = FxHashMap<&'a str, Span>;

impl<'a> Walk<'a, '_> {
    pub(super) fn locals(&mut self, body: ExprId, locals: &'a [Local]) {
        let depth = self.scope.len();
        let pending = self.pending.len();
        let mut seen = Seen::default();
        let defined = locals.iter().rev().filter(|local| local.field.is_none());
        self.pending.extend(defined.map(|local| &local.name));
        for local in locals {
            if local.field.is_some() {
                self.name(&local.name);
                self.expr(local.value);
            } else {
                self.definition_of_local(local, &mut seen);
                self.pending.pop();
            }
            self.scope.push(&local.name.text, false);
        }
        self.pending.truncate(pending);
        self.expr(body);
        self.scope.truncate(depth);
    }

    /// `name = value`; a name that was defined before must be used in its new value.
    fn definition_of_local(&mut self, local: &'a Local, seen: &mut Seen<'a>) {
        let name = &local.name;
        let Some(&first) = seen.get(name.text.as_str()) else {
            seen.insert(&name.text, name.span);
            self.check_bindable(name);
            self.expr(local.value);
            return;
        };
        if let Some(used) = self.scope.get_mut(&name.text) {
            *used = false;
        }
        self.expr(local.value);
        if self.scope.get(&name.text) == Some(&false) {
            self.diagnostics.push(duplicate(name, first).with_hint(
                "rename one of them; a new value may replace the old one where it uses that",
            ));
        }
    }

    /// Ranges of a series: each sees the running variables before it.
    pub(super) fn series(&mut self, ranges: &'a [Range], term: ExprId) {
        let depth = self.scope.len();
        let mut seen = Seen::default();
        for range in ranges {
            self.expr(range.lower);
            self.expr(range.upper);
            self.bind(&range.name, &mut seen);
            self.scope.push(&range.name.text, false);
        }
        self.expr(term);
        self.scope.truncate(depth);
    }

    /// An integral: its ends do not see the variable.
    pub(super) fn integral(&mut self, body: ExprId, range: &'a Range) {
        self.series(std::slice::from_ref(range), body);
    }

    /// States of an iteration: their starts do not see them.
    pub(super) fn iteration(
        &mut self,
        count: ExprId,
        states: &'a [(Name, ExprId)],
        steps: &[ExprId],
        until: Option<ExprId>,
    ) {
        self.expr(count);
        let mut seen = Seen::default();
        for (name, start) in states {
            self.bind(name, &mut seen);
            self.expr(*start);
        }
        let depth = self.scope.len();
        for (name, _) in states {
            self.scope.push(&name.text, false);
        }
        steps.iter().chain(&until).for_each(|&e| self.expr(e));
        self.scope.truncate(depth);
    }

    /// Checks a name that is given once in a list.
    fn bind(&mut self, name: &'a Name, seen: &mut Seen<'a>) {
        self.check_bindable(name);
        match seen.get(name.text.as_str()) {
            Some(&first) => {
                let problem = duplicate(name, first).with_hint("rename one of them");
                self.diagnostics.push(problem);
            }
            None => {
                seen.insert(&name.text, name.span);
            }
        }
    }

    fn check_bindable(&mut self, name: &Name) {
        self.diagnostics.extend(reserved(name));
    }
}

fn duplicate(name: &Name, first: Span) -> Diagnostic {
    let message = format!("{} is defined twice", quoted(&name.text));
    Diagnostic::error("duplicate-definition", name.span, message)
        .with_label("defined again")
        .with_related(first, "first defined here")
}
