//! One partial derivative of a value.

use pullback_grammar::ast::{Expr, ExprId, UnaryOp};
use pullback_grammar::{Diagnostic, Span};
use smallvec::SmallVec;

use crate::check::{Builder, Source, Value};
use crate::derive::{ComplexVariable, NoDerivative, forward, jet};
use crate::ir::{Id, Op, Prim, Ty};
use crate::stable::before_derivative;
use crate::table::{self, Derivative, MAX_POLYGAMMA};
use crate::types::Type;

/// Greatest number of nodes that all passes of a builder that take derivatives may visit, so that programs of very
/// many derivatives are answered soon.
const MAX_VISITS: usize = 300_000_000;

/// What is differentiated, for messages.
#[derive(Clone, Copy)]
pub(super) struct Subject {
    /// The place of the whole.
    pub span: Span,
    /// The expression that may hold what has no derivative.
    pub text: Option<ExprId>,
}

impl Subject {
    pub(super) fn of(span: Span, text: ExprId) -> Self {
        let text = Some(text);
        Self { span, text }
    }
}

impl Builder<'_> {
    /// The value of a function as a number or vector; reports a record of several states.
    pub(super) fn as_number(&mut self, value: Value, span: Span) -> Value {
        let Value::Record(record) = value else {
            return value;
        };
        match record.value {
            Some(value) => value,
            None => self.report(
                Diagnostic::error("record-as-number", span, "this function has several values")
                    .with_label("of which one is differentiated?")
                    .with_hint("name one of them in a function: g(x) = f(x).z"),
            ),
        }
    }

    /// ∂value/∂leaf: of a complex leaf the complex derivative. `None` where there is none; that has been reported.
    pub(super) fn partial(&mut self, value: &Value, leaf: Id, subject: Subject) -> Option<Value> {
        self.charge(subject)?;
        match value.ty(&self.graph)? {
            Type::Bool => {
                let problem = Diagnostic::error(
                    "type-mismatch",
                    subject.span,
                    "a condition has no derivative",
                );
                self.report(problem.with_hint(
                    "differentiate a number: a condition becomes one by `if … then 1 else 0`",
                ));
                None
            }
            _ if self.graph.ty(leaf) == Ty::Complex => self.complex_partial(value, leaf, subject),
            _ => {
                let ids = self.tangents(&value.ids(), leaf, subject)?;
                Some(value.with_ids(&ids))
            }
        }
    }

    /// Derivatives of reals and complex numbers by a real leaf.
    pub(super) fn tangents(
        &mut self,
        roots: &[Id],
        leaf: Id,
        subject: Subject,
    ) -> Option<SmallVec<[Id; 4]>> {
        self.charge(subject)?;
        let one = self.graph.real(1.0);
        let stable = self.prepared(roots);
        match forward(&mut self.graph, &stable, &[(leaf, one)]) {
            Ok(tangents) => {
                let zero = self.graph.real(0.0);
                let typed = |(&root, tangent): (&Id, Option<Id>)| {
                    let tangent = tangent.unwrap_or(zero);
                    if self.graph.ty(root) == Ty::Complex {
                        self.graph.widen(tangent)
                    } else {
                        tangent
                    }
                };
                Some(roots.iter().zip(tangents).map(typed).collect())
            }
            Err(missing) => self.no_derivative(missing, subject),
        }
    }

    fn complex_partial(&mut self, value: &Value, leaf: Id, subject: Subject) -> Option<Value> {
        let Value::Scalar(root) = *value else {
            self.not_holomorphic(value, leaf, subject);
            return None;
        };
        let stable = self.prepared(&[root]);
        match jet(&mut self.graph, stable[0], ComplexVariable::Whole(leaf)) {
            Ok(jet) if jet.dzbar.is_none() => Some(Value::Scalar(jet.dz)),
            Ok(_) => {
                self.not_holomorphic(value, leaf, subject);
                None
            }
            Err(missing) => self.no_derivative(missing, subject),
        }
    }

    /// The form in which roots are differentiated.
    pub(super) fn prepared(&mut self, roots: &[Id]) -> Vec<Id> {
        match before_derivative(&mut self.graph, roots, self.rewrites) {
            Some(stable) => {
                self.rewrote = true;
                stable
            }
            None => roots.to_vec(),
        }
    }

    /// Counts the nodes that a pass visits; `None` beyond the bound, which is reported.
    pub(super) fn charge(&mut self, subject: Subject) -> Option<()> {
        if self.graph.budget().is_err() {
            return None;
        }
        self.visits += self.graph.nodes().len();
        if self.visits > MAX_VISITS {
            let message = "the derivatives of this program need too many operations";
            self.report(
                Diagnostic::error("too-large", subject.span, message)
                    .with_hint("use fewer derivatives, or of smaller functions"),
            );
            return None;
        }
        Some(())
    }

    pub(super) fn no_derivative<T>(
        &mut self,
        missing: NoDerivative,
        subject: Subject,
    ) -> Option<T> {
        // the only operation that ends: further derivatives of it have no function
        let digamma = matches!(missing.prim, Prim::Polygamma(_));
        let name = if digamma {
            "digamma"
        } else {
            table::written(missing.prim).sign()
        };
        let mut problem = Diagnostic::error(
            "no-derivative",
            subject.span,
            if digamma {
                format!(
                    "the derivative of `digamma` of order {} is not available",
                    MAX_POLYGAMMA + 1
                )
            } else {
                format!("`{name}` has no {}", table::lacking(missing.prim))
            },
        )
        .with_label("cannot be differentiated");
        if let Some(place) = self.place_of(subject, missing.prim) {
            problem = problem.with_related(place, format!("`{name}` is here"));
        }
        let hint = match missing.prim {
            Prim::Polygamma(_) => {
                format!("available are the derivatives of digamma up to order {MAX_POLYGAMMA}")
            }
            _ => format!("write it without {name}"),
        };
        self.report(problem.with_hint(hint));
        None
    }

    fn not_holomorphic(&mut self, value: &Value, leaf: Id, subject: Subject) {
        let culprit = self.culprit(&value.ids(), leaf);
        let name = culprit.map_or("re", |prim| table::row(prim).sign());
        let mut problem = Diagnostic::error(
            "not-holomorphic",
            subject.span,
            format!("this has no complex derivative: `{name}` is not holomorphic"),
        )
        .with_label("not holomorphic");
        if let Some(place) = culprit.and_then(|prim| self.place_of(subject, prim)) {
            problem = problem.with_related(place, format!("`{name}` is here"));
        }
        self.report(problem.with_hint(
            "take real variables, f(x, y) with z = x + i y, and use diff(…, x) and diff(…, y)",
        ));
    }

    /// The first operation on the way from a complex leaf to a root that is not holomorphic.
    fn culprit(&self, roots: &[Id], leaf: Id) -> Option<Prim> {
        let live = self.graph.reachable(roots);
        let g = &self.graph;
        let mut depends = vec![false; live.len()];
        depends[leaf.index()] = true;
        for (id, node) in g.ids().zip(g.nodes()) {
            if !live[id.index()] || !node.args.iter().any(|a| depends[a.index()]) {
                continue;
            }
            let constant = match node.op {
                Op::Apply(prim) => matches!(table::row(prim).derivative, Derivative::Zero),
                _ => false,
            };
            if constant || node.ty == Ty::Bool {
                continue;
            }
            depends[id.index()] = true;
            if let Op::Apply(prim @ (Prim::Conj | Prim::Re | Prim::Im | Prim::Abs | Prim::Arg)) =
                node.op
            {
                return Some(prim);
            }
        }
        None
    }

    /// Where an operation is written in the user's text.
    fn place_of(&self, subject: Subject, prim: Prim) -> Option<Span> {
        if self.source != Source::Program {
            return None;
        }
        let exprs = &self.file.exprs;
        let names = table::row(prim).names;
        let mut stack = vec![subject.text?];
        let mut found: Option<Span> = None;
        while let Some(id) = stack.pop() {
            let is_here = match &exprs[id] {
                Expr::Call { callee, .. } => names.contains(&callee.text.as_str()),
                Expr::Unary {
                    op: UnaryOp::Abs, ..
                } => prim == Prim::Abs,
                _ => false,
            };
            let span = exprs.span(id);
            if is_here && found.is_none_or(|first| span.start < first.start) {
                found = Some(span);
            }
            exprs[id].for_each_child(|child| stack.push(child));
        }
        found
    }
}
