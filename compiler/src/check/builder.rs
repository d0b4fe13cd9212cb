//! Building the IR of an expression, with types.

use pullback_grammar::ast::{Expr, ExprId, File, Function, Local, Name};
use pullback_grammar::{Diagnostic, Span};
use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use super::bounds::Bounds;
use super::fold::FoldBudget;
use super::iteration::Iteration;
use super::library::MAX_LIBRARY_DEPTH;
use super::names::MAX_CALL_DEPTH;
use super::nesting::{Extent, Nesting};
use super::scope::Scope;
use super::symbols::Symbols;
use super::variables::Frame;
use super::{Value, library, named_constant};
use crate::defined::Digits;
use crate::ir::{Graph, Id, Op, Ty};
use crate::stable::Rewrites;
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
    pub(super) frame: Frame<'a>,
    /// Derivatives of functions at values, by their order.
    pub(super) derivatives: FxHashMap<(Source, &'a str, u32, Value), Known>,
    /// Number of nodes that the passes which take derivatives have visited.
    pub(super) visits: usize,
    /// Number of integrals that were built.
    pub(super) integrals: usize,
    /// The rewrites of what is differentiated.
    pub(super) rewrites: Rewrites,
    /// Whether something was rewritten before it was differentiated.
    pub(super) rewrote: bool,
    /// The digits that definitions of the library are for.
    pub(super) digits: Digits,
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
            frame: Frame::default(),
            derivatives: FxHashMap::default(),
            visits: 0,
            integrals: 0,
            rewrites: Rewrites::OFF,
            rewrote: false,
            digits: Digits::Wide,
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

    /// The same, which takes derivatives of expressions as these rewrites make them, not of those that are written.
    #[must_use]
    pub fn with_rewrites(mut self, rewrites: Rewrites) -> Self {
        self.rewrites = rewrites;
        self
    }

    /// The same, for a definition of the library that some digits are wanted of.
    #[must_use]
    pub fn for_digits(mut self, digits: Digits) -> Self {
        self.digits = digits;
        self
    }

    /// Whether derivatives have been taken.
    #[must_use]
    pub fn has_differentiated(&self) -> bool {
        self.visits > 0
    }

    /// Whether a derivative is that of an expression that was rewritten before.
    #[must_use]
    pub fn has_rewritten(&self) -> bool {
        self.rewrote
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

    /// The program's functions that have been called without an error, with the types of the arguments and of the
    /// value; one for each call.
    pub fn signatures(&self) -> impl Iterator<Item = (&'a str, Vec<Type>, Type)> + '_ {
        self.calls
            .iter()
            .filter_map(|((source, name, arguments), value)| {
                let types = arguments.iter().map(|argument| argument.ty(&self.graph));
                let inputs = types.collect::<Option<Vec<Type>>>()?;
                let result = value.value.ty(&self.graph)?;
                (*source == Source::Program).then_some((*name, inputs, result))
            })
    }

    /// The program's constants that have been used without an error, with their types.
    pub fn constant_types(&self) -> impl Iterator<Item = (&'a str, Type)> + '_ {
        let typed =
            |(name, known): (&&'a str, &(Value, usize))| Some((*name, known.0.ty(&self.graph)?));
        self.constants.iter().filter_map(typed)
    }

    /// Reports a problem; the value is then an error, which is not reported again.
    pub fn report(&mut self, problem: Diagnostic) -> Value {
        self.diagnostics.push(problem);
        Value::Error
    }

    /// Defines a name for what is built next, such as an input of a formula.
    pub fn define(&mut self, name: &'a str, value: Value) {
        self.frame.parameters.push((name, value.clone()));
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
        if self.source == Source::Program {
            let span = self.file.exprs.span(id);
            self.graph.cover(span);
            if let Value::Scalar(node) = value {
                self.graph.place(node, span);
            }
        }
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
            Expr::Where { body, locals } => self.locals(*body, locals, span),
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
            Expr::Integral {
                method,
                body,
                range,
            } => self.integral(*method, *body, range, span),
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
            if self.source == Source::Program {
                self.graph.cover(whole);
            }
            span = whole;
        }
        value
    }

    fn locals(&mut self, body: ExprId, locals: &'a [Local], span: Span) -> Value {
        let (depth, bound) = (self.scope.len(), self.bound());
        self.bind_locals(locals, span);
        let mut value = self.any(body);
        self.scope.truncate(depth);
        self.release(bound, std::slice::from_mut(&mut value));
        value
    }

    /// The items of a list with local names behind it.
    pub(super) fn items(&mut self, id: ExprId) -> Vec<Value> {
        let file = self.file;
        match &file.exprs[id] {
            Expr::Where { body, locals } => {
                let span = file.exprs.span(id);
                let (depth, bound) = (self.scope.len(), self.bound());
                self.bind_locals(locals, span);
                let mut values = self.items(*body);
                self.scope.truncate(depth);
                self.release(bound, &mut values);
                values
            }
            Expr::Vector(items) => items.iter().map(|&item| self.expr(item)).collect(),
            _ => vec![self.expr(id)],
        }
    }

    fn bind_locals(&mut self, locals: &'a [Local], span: Span) {
        for local in locals {
            let value = self.local(local);
            // rather than by the function that it is a value of
            self.name_by(&local.name.text, &value, Graph::rename);
            self.bind_local(&local.name.text, value, span);
        }
    }

    /// Remembers the user's name for a computed value.
    pub fn name_value(&mut self, name: &str, value: &Value) {
        self.name_by(name, value, Graph::set_name);
    }

    fn name_by(&mut self, name: &str, value: &Value, set: fn(&mut Graph, Id, &str)) {
        if self.source != Source::Program {
            return;
        }
        let computed = |g: &Graph, id: Id| matches!(g.node(id).op, Op::Apply(_));
        match value {
            Value::Scalar(id) if computed(&self.graph, *id) => set(&mut self.graph, *id, name),
            Value::Vector(items) => {
                for (&id, letter) in items.iter().zip(["x", "y", "z", "w"]) {
                    if computed(&self.graph, id) {
                        set(&mut self.graph, id, &format!("{name}_{letter}"));
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
        mut scope: Scope<'a, Value>,
        body: ExprId,
    ) -> Value {
        // longer chains have been reported by the pass over names
        if self.active.len() > MAX_CALL_DEPTH + MAX_LIBRARY_DEPTH + 1 {
            return Value::Error;
        }
        let file = match source {
            Source::Program => self.program,
            Source::Library => library::file(),
        };
        let file = std::mem::replace(&mut self.file, file);
        let source = std::mem::replace(&mut self.source, source);
        let frame = self.frame_of(&mut scope, self.span(body));
        let frame = std::mem::replace(&mut self.frame, frame);
        let scope = std::mem::replace(&mut self.scope, scope);
        self.active.push(name);
        let mut value = self.any(body);
        self.active.pop();
        self.release(0, std::slice::from_mut(&mut value));
        (self.file, self.source) = (file, source);
        (self.scope, self.frame) = (scope, frame);
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
                    let hint = match ty {
                        Type::Vector(_) => "join vectors by `vec3(…)` or `vec4(…)`".to_owned(),
                        _ => self.advice_at(ty, false, span),
                    };
                    self.report(
                        Diagnostic::error(
                            "type-mismatch",
                            span,
                            format!(
                                "a component of a vector is a real number, and this is {}",
                                ty.in_words()
                            ),
                        )
                        .with_label(format!("this is {}", ty.in_words()))
                        .with_hint(hint),
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

    /// Whether the program defines a value of this name.
    pub(super) fn is_defined_value(&self, name: &str) -> bool {
        self.source == Source::Program
            && (self.symbols.constants.contains_key(name) || self.symbols.params.contains_key(name))
    }

    /// Where an expression of the current text stands, in the user's text.
    pub(super) fn span(&self, id: ExprId) -> Span {
        self.file.exprs.span(id)
    }
}
