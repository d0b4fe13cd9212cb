//! Writing the body of a naga function: which expressions must be emitted, and when.

use naga::proc::Emitter;
use naga::{Block, Expression, Function, Handle, Literal, LocalVariable, Span, Statement, Type};
use rustc_hash::FxHashMap;

/// A function whose body is being written.
#[derive(Debug)]
pub struct Body {
    /// The function.
    pub function: Function,
    emitter: Emitter,
    literals: FxHashMap<u32, Handle<Expression>>,
    /// Where in the user's text the expressions come from that are added.
    span: Span,
    /// Blocks around the one that is being written.
    outer: Vec<Block>,
}

impl Body {
    /// Begins the body of a function.
    #[must_use]
    pub fn new(function: Function) -> Self {
        Self {
            function,
            emitter: Emitter::default(),
            literals: FxHashMap::default(),
            span: Span::UNDEFINED,
            outer: Vec::new(),
        }
    }

    /// Says where in the user's text the expressions come from that are added from now on.
    pub fn at(&mut self, span: pullback_grammar::Span) {
        self.span = Span::new(span.start, span.end);
    }

    /// Adds an expression that is computed here.
    pub fn emit(&mut self, expression: Expression) -> Handle<Expression> {
        if !self.emitter.is_running() {
            self.emitter.start(&self.function.expressions);
        }
        self.function.expressions.append(expression, self.span)
    }

    /// Adds an expression that must not be emitted: an argument, a literal, a variable.
    pub fn declare(&mut self, expression: Expression) -> Handle<Expression> {
        self.flush();
        self.function.expressions.append(expression, self.span)
    }

    /// A finite literal, each value once.
    pub fn literal(&mut self, value: f32) -> Handle<Expression> {
        if let Some(&handle) = self.literals.get(&value.to_bits()) {
            return handle;
        }
        let handle = self.declare(Expression::Literal(Literal::F32(value)));
        self.literals.insert(value.to_bits(), handle);
        handle
    }

    /// Adds a local variable, and gives the pointer to it.
    pub fn variable(&mut self, name: String, ty: Handle<Type>) -> Handle<Expression> {
        let variable = LocalVariable {
            name: Some(name),
            ty,
            init: None,
        };
        let variable = self
            .function
            .local_variables
            .append(variable, Span::UNDEFINED);
        self.declare(Expression::LocalVariable(variable))
    }

    /// Reads a variable here.
    pub fn load(&mut self, pointer: Handle<Expression>) -> Handle<Expression> {
        self.emit(Expression::Load { pointer })
    }

    /// Writes a variable here.
    pub fn store(&mut self, pointer: Handle<Expression>, value: Handle<Expression>) {
        self.flush();
        self.push(Statement::Store { pointer, value });
    }

    /// What is written next goes into a block of its own, up to [`Self::close`].
    pub fn open(&mut self) {
        self.flush();
        let outer = std::mem::take(&mut self.function.body);
        self.outer.push(outer);
    }

    /// Ends the block that was opened last, and gives it.
    pub fn close(&mut self) -> Block {
        self.flush();
        let outer = self.outer.pop().unwrap_or_default();
        std::mem::replace(&mut self.function.body, outer)
    }

    /// Adds a statement that is no expression: a branch, a loop.
    pub fn statement(&mut self, statement: Statement) {
        self.flush();
        self.push(statement);
    }

    /// Adds a statement that comes from a part of the user's text.
    pub fn statement_of(&mut self, statement: Statement, span: pullback_grammar::Span) {
        self.flush();
        let span = Span::new(span.start, span.end);
        self.function.body.push(statement, span);
    }

    /// Calls a function and gives its result.
    pub fn call(
        &mut self,
        function: Handle<Function>,
        arguments: Vec<Handle<Expression>>,
    ) -> Handle<Expression> {
        let result = self.declare(Expression::CallResult(function));
        self.push(Statement::Call {
            function,
            arguments,
            result: Some(result),
        });
        result
    }

    /// Ends the body with its result.
    #[must_use]
    pub fn finish(mut self, value: Handle<Expression>) -> Function {
        self.flush();
        self.push(Statement::Return { value: Some(value) });
        self.function
    }

    fn push(&mut self, statement: Statement) {
        self.function.body.push(statement, Span::UNDEFINED);
    }

    fn flush(&mut self) {
        if self.emitter.is_running()
            && let Some((statement, span)) = self.emitter.finish(&self.function.expressions)
        {
            self.function.body.push(statement, span);
        }
    }
}
