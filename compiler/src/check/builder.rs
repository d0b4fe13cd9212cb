//! Building the IR of an expression, with types.

use pullback_grammar::ast::{Expr, ExprId, File, Function, Local, Name};
use pullback_grammar::{Diagnostic, Span};
use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use super::bounds::Bounds;
use super::builtins::advice;
use super::fold::FoldBudget;
use super::iteration::Iteration;
use super::names::MAX_CALL_DEPTH;
use super::nesting::{Extent, Nesting};
use super::scope::Scope;
use super::symbols::Symbols;
use super::{Value, library, named_constant};
use crate::ir::{Graph, Id, Op, Ty};
use crate::types::Type;

/// Greatest depth of nested expressions, those of called functions included.
pub const MAX_DEPTH: usize = 400;

/// Which text an expression belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Source {
    /// The user's program.
    Program,
    /// The library written in the language.
    Library,
}

/// Builds expressions into one graph, and collects what is wrong with them.
#[derive(Debug)]
pub struct Builder<'a> {
    /// The graph.
    pub graph: Graph,
    /// What was found.
    pub diagnostics: Vec<Diagnostic>,
    pub(super) symbols: &'a Symbols<'a>,
    pub(super) file: &'a File,
    pub(super) source: Source,
    pub(super) scope: Scope<'a, Value>,
    pub(super) depth: usize,
    /// Functions and constants whose values are being built.
    pub(super) active: Vec<&'a str>,
    pub(super) calls: FxHashMap<(Source, &'a str, Vec<Value>), Known>,
    /// Values of constants, each with the number of those that were known before it.
    pub(super) constants: FxHashMap<&'a str, (Value, usize)>,
    pub(super) bounds: Bounds,
    pub(super) nesting: Nesting,
    pub(super) folding: FoldBudget,
    program: &'a File,
}

/// A call that was built.
#[derive(Clone, Debug)]
pub(super) struct Known {
    pub value: Value,
    /// The loops that it contains.
    pub loops: Extent,
    /// The number of calls that were known before it.
    pub place: usize,
}

impl<'a> Builder<'a> {
    /// A builder for expressions of a program.
    #[must_use]
    pub fn new(program: &'a File, symbols: &'a Symbols<'a>) -> Self {
        Self {
            graph: Graph::new(),
            diagnostics: Vec::new(),
            symbols,
            file: program,
            source: Source::Program,
            scope: Scope::default(),
            depth: 0,
            active: Vec::new(),
            calls: FxHashMap::default(),
            constants: FxHashMap::default(),
            bounds: Bounds::default(),
            nesting: Nesting::default(),
            folding: FoldBudget::default(),
            program,
        }
    }

    /// The same, knowing the ranges of the parameters that have one, in the order of their indices.
    #[must_use]
    pub fn with_ranges(mut self, ranges: &[Option<(f64, f64)>]) -> Self {
        self.bounds.params = ranges.to_vec();
        self
    }

    /// The operations that were spent on computing constant loops.
    #[must_use]
    pub fn spent(&self) -> u64 {
        self.folding.spent()
    }

    /// The program's functions that have been called.
    pub fn called(&self) -> impl Iterator<Item = &'a str> + '_ {
        let of_program = |key: &&(Source, &'a str, Vec<Value>)| key.0 == Source::Program;
        self.calls.keys().filter(of_program).map(|key| key.1)
    }

    /// Reports a problem; the value is then an error, which is not reported again.
    pub fn report(&mut self, problem: Diagnostic) -> Value {
        self.diagnostics.push(problem);
        Value::Error
    }

    /// Defines a name for what is built next, such as an input of a formula.
    pub fn define(&mut self, name: &'a str, value: Value) {
        self.scope.push(name, value);
    }

    /// Builds an expression of the current text, which must be a number, a vector or a truth value.
    pub fn expr(&mut self, id: ExprId) -> Value {
        let value = self.any(id);
        self.number(value, id)
    }

    /// Builds an expression of the current text, which may be a record.
    pub(super) fn any(&mut self, id: ExprId) -> Value {
        if self.graph.budget().is_err() {
            return Value::Error;
        }
        if self.depth >= MAX_DEPTH {
            let span = self.file.exprs.span(id);
            return self.report(
                Diagnostic::error(
                    "too-deep",
                    span,
                    format!("expressions and calls are nested more than {MAX_DEPTH} deep"),
                )
                .with_hint("name parts of the formula with `where`"),
            );
        }
        self.depth += 1;
        let value = self.nested(id);
        self.depth -= 1;
        value
    }

    fn nested(&mut self, id: ExprId) -> Value {
        let file = self.file;
        let span = file.exprs.span(id);
        match &file.exprs[id] {
            Expr::Error => Value::Error,
            Expr::Number(value) => Value::Scalar(self.graph.real(*value)),
            Expr::Imaginary(value) => Value::Scalar(self.graph.complex(0.0, *value)),
            Expr::Name(name) => self.name(name),
            Expr::Binary { .. } => self.chain(id),
            Expr::Unary { op, arg } => {
                let value = self.expr(*arg);
                self.unary(*op, &value, span, file.exprs.span(*arg))
            }
            Expr::Compare { first, rest } => self.comparison(*first, rest, span),
            Expr::Call {
                callee,
                primes,
                args,
            } => self.call(callee, *primes, args, span),
            Expr::Member { base, field } => self.member(*base, field),
            Expr::Vector(items) => self.vector(items),
            Expr::If {
                cond,
                then,
                otherwise,
            } => self.choice(std::iter::once((*cond, *then)), Some(*otherwise), span),
            Expr::Piecewise { arms, otherwise } => {
                self.choice(arms.iter().copied(), *otherwise, span)
            }
            Expr::Where { body, locals } => self.locals(*body, locals),
            Expr::Series { kind, ranges, term } => self.series(*kind, ranges, *term),
            Expr::Iterate {
                count,
                states,
                steps,
                until,
            } => self.iteration(&Iteration {
                count: *count,
                states,
                steps,
                until: *until,
            }),
            Expr::Integral { .. } => Value::Error,
        }
    }

    /// A left-leaning chain of binary operators, without recursion along the chain.
    fn chain(&mut self, id: ExprId) -> Value {
        let file = self.file;
        let mut links = Vec::new();
        let mut first = id;
        while let Expr::Binary { op, lhs, rhs } = &file.exprs[first] {
            links.push((first, *op, *rhs));
            first = *lhs;
        }
        let mut value = self.expr(first);
        let mut span = file.exprs.span(first);
        while let Some((node, op, rhs)) = links.pop() {
            let right = self.expr(rhs);
            let whole = file.exprs.span(node);
            value = self.binary(op, (&value, span), (&right, file.exprs.span(rhs)), whole);
            span = whole;
        }
        value
    }

    fn locals(&mut self, body: ExprId, locals: &'a [Local]) -> Value {
        let depth = self.scope.len();
        for local in locals {
            let value = self.local(local);
            self.name_value(&local.name.text, &value);
            self.scope.push(&local.name.text, value);
        }
        let value = self.any(body);
        self.scope.truncate(depth);
        value
    }

    /// Remembers the user's name for a computed value.
    pub fn name_value(&mut self, name: &str, value: &Value) {
        if self.source != Source::Program {
            return;
        }
        let computed = |g: &Graph, id: Id| matches!(g.node(id).op, Op::Apply(_));
        match value {
            Value::Scalar(id) if computed(&self.graph, *id) => self.graph.set_name(*id, name),
            Value::Vector(items) => {
                for (&id, letter) in items.iter().zip(["x", "y", "z", "w"]) {
                    if computed(&self.graph, id) {
                        self.graph.set_name(id, &format!("{name}_{letter}"));
                    }
                }
            }
            _ => {}
        }
    }

    pub(super) fn name(&mut self, name: &'a Name) -> Value {
        let text = name.text.as_str();
        if let Some(value) = self.scope.get(text) {
            return value.clone();
        }
        if self.source == Source::Program {
            if let Some(&(index, _)) = self.symbols.params.get(text) {
                return Value::Scalar(self.graph.leaf(Op::Param(index), Ty::Real));
            }
            if let Some(constant) = self.symbols.constants.get(text) {
                return self.constant(text, constant.value);
            }
        }
        match text {
            "i" => Value::Scalar(self.graph.complex(0.0, 1.0)),
            "time" => Value::Scalar(self.graph.leaf(Op::Time, Ty::Real)),
            "pixel" => Value::Scalar(self.graph.leaf(Op::Pixel, Ty::Real)),
            "true" | "false" => Value::Scalar(self.graph.truth(text == "true")),
            // names without a meaning have been reported by the pass over names
            _ => named_constant(text)
                .map_or(Value::Error, |value| Value::Scalar(self.graph.real(value))),
        }
    }

    fn constant(&mut self, name: &'a str, body: ExprId) -> Value {
        if let Some((value, _)) = self.constants.get(name) {
            return value.clone();
        }
        if self.active.contains(&name) {
            return Value::Error;
        }
        let around = self.nesting.outermost();
        let value = self.outside(name, Source::Program, Scope::default(), body);
        self.nesting = around;
        self.name_value(name, &value);
        let place = self.constants.len();
        self.constants.insert(name, (value.clone(), place));
        value
    }

    /// Builds the body of a definition in a scope of its own.
    pub(super) fn outside(
        &mut self,
        name: &'a str,
        source: Source,
        scope: Scope<'a, Value>,
        body: ExprId,
    ) -> Value {
        // longer chains have been reported by the pass over names
        if self.active.len() > MAX_CALL_DEPTH + 1 {
            return Value::Error;
        }
        let file = match source {
            Source::Program => self.program,
            Source::Library => library::file(),
        };
        let file = std::mem::replace(&mut self.file, file);
        let source = std::mem::replace(&mut self.source, source);
        let scope = std::mem::replace(&mut self.scope, scope);
        self.active.push(name);
        let value = self.any(body);
        self.active.pop();
        (self.file, self.source, self.scope) = (file, source, scope);
        value
    }

    fn vector(&mut self, items: &'a [ExprId]) -> Value {
        let mut ids: SmallVec<[Id; 4]> = SmallVec::new();
        let mut failed = false;
        for &item in items {
            let value = self.expr(item);
            match value.ty(&self.graph) {
                Some(Type::Real) => ids.extend(value.ids()),
                Some(ty) => {
                    let span = self.file.exprs.span(item);
                    self.report(
                        Diagnostic::error(
                            "type-mismatch",
                            span,
                            format!("a component of a vector is real, found {ty}"),
                        )
                        .with_label(format!("this is {ty}"))
                        .with_hint(match ty {
                            Type::Vector(_) => "join vectors by vec3(…) or vec4(…)",
                            _ => advice(ty, false),
                        }),
                    );
                    failed = true;
                }
                None => failed = true,
            }
        }
        if failed {
            Value::Error
        } else {
            Value::Vector(ids)
        }
    }

    /// The function of the program with this name.
    pub(super) fn user_function(&self, name: &str) -> Option<&'a Function> {
        (self.source == Source::Program)
            .then(|| self.symbols.functions.get(name).copied())
            .flatten()
    }

    /// Where an expression of the current text stands, in the user's text.
    pub(super) fn span(&self, id: ExprId) -> Span {
        self.file.exprs.span(id)
    }
}
