//! Writing the body of a naga function: which expressions must be emitted, and when.

use naga::proc::Emitter;
use naga::{Expression, Function, Handle, Literal, Span, Statement};
use rustc_hash::FxHashMap;

/// A function whose body is being written.
#[derive(Debug)]
pub struct Body {
    /// The function.
    pub function: Function,
    emitter: Emitter,
    literals: FxHashMap<u32, Handle<Expression>>,
}

impl Body {
    /// Begins the body of a function.
    #[must_use]
    pub fn new(function: Function) -> Self {
        Self {
            function,
            emitter: Emitter::default(),
            literals: FxHashMap::default(),
        }
    }

    /// Adds an expression that is computed here.
    pub fn emit(&mut self, expression: Expression) -> Handle<Expression> {
        if !self.emitter.is_running() {
            self.emitter.start(&self.function.expressions);
        }
        self.function
            .expressions
            .append(expression, Span::UNDEFINED)
    }

    /// Adds an expression that must not be emitted: an argument, a literal, a variable.
    pub fn declare(&mut self, expression: Expression) -> Handle<Expression> {
        self.flush();
        self.function
            .expressions
            .append(expression, Span::UNDEFINED)
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
