//! How long the values of a function are needed, so that their registers can be used again.
//!
//! A function is walked in the order in which it is translated. Each emitted expression is one tick, each other statement
//! two, one before and one after what is inside. A value that a statement uses deeper inside, as a loop may do again and
//! again, is needed up to that statement's end.

use naga::{Block, Expression, Function, Handle, Statement};

use super::fault::Fault;

/// Deepest nesting of blocks in a function; naga's validator recurses over them, too.
pub(super) const MAX_DEPTH: usize = 256;

/// The last tick at which each emitted value is needed, in the order of the ticks.
#[derive(Debug, Default)]
pub(super) struct Lifetimes {
    ends: Vec<(u32, Handle<Expression>)>,
    next: usize,
    tick: u32,
}

impl Lifetimes {
    /// With `contracted`, the factors of a product are needed as long as a sum that it may be fused into.
    pub fn of(function: &Function, contracted: bool) -> Result<Self, Fault> {
        let mut walk = Walk {
            function,
            contracted,
            tick: 0,
            depth: vec![None; function.expressions.len()],
            last: vec![0; function.expressions.len()],
            pending: Vec::new(),
        };
        walk.block(&function.body)?;
        let mut ends: Vec<_> = function
            .expressions
            .iter()
            .map(|(handle, _)| (walk.last[handle.index()], handle))
            .filter(|&(last, _)| last > 0)
            .collect();
        ends.sort_unstable_by_key(|&(last, handle)| (last, handle.index()));
        Ok(Self {
            ends,
            next: 0,
            tick: 0,
        })
    }

    /// Goes on by a tick; hands over the values that are not needed any more.
    pub fn tick(&mut self) -> impl Iterator<Item = Handle<Expression>> + use<> {
        self.tick += 1;
        let rest = &self.ends[self.next..];
        let done = rest.partition_point(|&(last, _)| last < self.tick);
        let ended: Vec<_> = rest[..done].iter().map(|&(_, handle)| handle).collect();
        self.next += done;
        ended.into_iter()
    }

    /// The values that are needed to the end.
    pub fn finish(&mut self) -> impl Iterator<Item = Handle<Expression>> + use<> {
        let ended: Vec<_> = self.ends[self.next..].iter().map(|&(_, h)| h).collect();
        self.next = self.ends.len();
        ended.into_iter()
    }
}

struct Walk<'f> {
    function: &'f Function,
    contracted: bool,
    tick: u32,
    /// Nesting of the block in which a value is made.
    depth: Vec<Option<usize>>,
    last: Vec<u32>,
    /// At each nesting, values from there that the statement at hand uses deeper inside.
    pending: Vec<Vec<Handle<Expression>>>,
}

impl Walk<'_> {
    fn make(&mut self, handle: Handle<Expression>) {
        self.depth[handle.index()] = Some(self.pending.len() - 1);
        self.last[handle.index()] = self.tick;
    }

    fn need(&mut self, handle: Handle<Expression>) {
        let here = self.pending.len() - 1;
        match self.depth[handle.index()] {
            None => {}
            Some(depth) if depth >= here => self.last[handle.index()] = self.tick,
            Some(depth) => self.pending[depth].push(handle),
        }
    }

    fn enter(&mut self) -> Result<(), Fault> {
        if self.pending.len() >= MAX_DEPTH {
            let construct = format!("nesting deeper than {MAX_DEPTH} blocks");
            return Err(Fault::unsupported(construct));
        }
        self.pending.push(Vec::new());
        Ok(())
    }

    fn block(&mut self, block: &Block) -> Result<(), Fault> {
        self.enter()?;
        self.statements(block)?;
        self.pending.pop();
        Ok(())
    }

    fn statements(&mut self, block: &Block) -> Result<(), Fault> {
        for statement in block {
            if let Statement::Emit(range) = statement {
                for handle in range.clone() {
                    self.tick += 1;
                    let function = self.function;
                    operands(&function.expressions[handle], |used| {
                        self.need(used);
                        if self.contracted
                            && let product @ Expression::Binary { .. } = &function.expressions[used]
                        {
                            operands(product, |factor| self.need(factor));
                        }
                    });
                    self.make(handle);
                }
                continue;
            }
            self.tick += 1;
            self.statement(statement)?;
            self.tick += 1;
            if let Some(pending) = self.pending.last_mut() {
                for handle in std::mem::take(pending) {
                    self.last[handle.index()] = self.tick;
                }
            }
        }
        Ok(())
    }

    fn statement(&mut self, statement: &Statement) -> Result<(), Fault> {
        match statement {
            Statement::Block(block) => self.block(block)?,
            Statement::If {
                condition,
                accept,
                reject,
            } => {
                self.need(*condition);
                self.block(accept)?;
                self.block(reject)?;
            }
            Statement::Switch { selector, cases } => {
                self.need(*selector);
                for case in cases {
                    self.block(&case.body)?;
                }
            }
            Statement::Loop {
                body,
                continuing,
                break_if,
            } => {
                self.enter()?;
                // what the body makes is seen by the continuing block
                self.statements(body)?;
                self.statements(continuing)?;
                if let Some(condition) = break_if {
                    self.need(*condition);
                }
                self.pending.pop();
            }
            Statement::Return { value: Some(value) } => self.need(*value),
            Statement::Store { pointer, value } => {
                self.need(*pointer);
                self.need(*value);
            }
            Statement::Call {
                arguments, result, ..
            } => {
                for &argument in arguments {
                    self.need(argument);
                }
                if let Some(result) = result {
                    self.tick += 1;
                    self.make(*result);
                    self.tick -= 1;
                }
            }
            _ => {}
        }
        Ok(())
    }
}

/// Calls `f` with each operand of an expression of ours.
pub(super) fn operands(expression: &Expression, mut f: impl FnMut(Handle<Expression>)) {
    match expression {
        Expression::Compose { components, .. } => components.iter().for_each(|&c| f(c)),
        Expression::Access { base, index } => {
            f(*base);
            f(*index);
        }
        Expression::AccessIndex { base, .. } => f(*base),
        Expression::Splat { value, .. } => f(*value),
        Expression::Swizzle { vector, .. } => f(*vector),
        Expression::Load { pointer } => f(*pointer),
        Expression::Unary { expr, .. } | Expression::As { expr, .. } => f(*expr),
        Expression::Binary { left, right, .. } => {
            f(*left);
            f(*right);
        }
        Expression::Select {
            condition,
            accept,
            reject,
        } => {
            f(*condition);
            f(*accept);
            f(*reject);
        }
        Expression::Relational { argument, .. } => f(*argument),
        Expression::Math {
            arg,
            arg1,
            arg2,
            arg3,
            ..
        } => {
            f(*arg);
            [arg1, arg2, arg3].into_iter().flatten().for_each(|&a| f(a));
        }
        _ => {}
    }
}
