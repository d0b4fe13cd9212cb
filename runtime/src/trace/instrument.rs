//! Adding to a shader what tells its values: a pass over a naga module.
//!
//! After each value that is wanted, a call of a recorder of `record.wgsl` is put with the number of the site. Whoever
//! runs the module, the same events come in the same order as long as the same way is taken.

use naga::proc::TypeResolution;
use naga::valid::FunctionInfo;
use naga::{
    Block, Expression, Function, Handle, Literal, Module, Range, Span, Statement, Type, TypeInner,
    UniqueArena,
};
use pullback_compiler::lower::Format;

use super::operands;
use super::parts::{Part, parts};
use super::recorders::Handles;
use super::site::{Site, What};
use super::text::Writer;

/// How much a function tells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Detail {
    /// Nothing.
    Nothing,
    /// What has a name: arguments, values, variables, conditions and the result.
    Names,
    /// Also every operation; the function is generated from the user's text.
    Operations,
    /// Only what it returns.
    Result,
}

/// How a function is to be instrumented.
#[derive(Clone, Copy)]
pub(super) struct Scope<'m> {
    pub(super) detail: Detail,
    /// That of the generated functions.
    pub(super) format: Format,
    pub(super) source: &'m str,
    pub(super) recorders: &'m Handles,
}

/// One function on its way.
pub(super) struct Instrument<'m, 's> {
    types: &'m UniqueArena<Type>,
    /// As it was.
    before: &'m Function,
    info: &'m FunctionInfo,
    writer: Writer<'m>,
    scope: Scope<'m>,
    /// As it will be.
    function: Function,
    sites: &'s mut Vec<Site>,
    /// Sites of values, and of the parts of values, by the indices that lead to them.
    known: operands::Known,
}

/// What is to be told of a value.
struct Told<'a> {
    what: What,
    name: &'a str,
    text: String,
    /// The value, where it is an operation.
    operation: Option<Handle<Expression>>,
    /// Whether users of the value find it here.
    is_source: bool,
}

impl<'m, 's> Instrument<'m, 's> {
    pub(super) fn new(
        module: &'m Module,
        before: &'m Function,
        info: &'m FunctionInfo,
        scope: Scope<'m>,
        sites: &'s mut Vec<Site>,
    ) -> Self {
        Self {
            types: &module.types,
            before,
            info,
            writer: Writer::new(
                module,
                before,
                info,
                if scope.detail == Detail::Operations {
                    scope.source
                } else {
                    ""
                },
            ),
            scope,
            function: before.clone(),
            sites,
            known: operands::Known::default(),
        }
    }

    pub(super) fn run(mut self) -> Function {
        let body = std::mem::take(&mut self.function.body);
        let mut out = Block::new();
        if self.scope.detail != Detail::Result {
            self.arguments(&mut out);
        }
        let rest = self.block(body);
        out.extend_block(rest);
        self.function.body = out;
        self.function
    }

    fn arguments(&mut self, out: &mut Block) {
        for (k, argument) in (0..).zip(&self.before.arguments) {
            let is_it = |(_, e): &(Handle<Expression>, &Expression)| matches!(e, Expression::FunctionArgument(n) if *n == k);
            // one that is not there is not used
            let Some((value, _)) = self.before.expressions.iter().find(is_it) else {
                continue;
            };
            self.tell(
                out,
                value,
                &Told {
                    what: What::Argument,
                    name: argument.name.as_deref().unwrap_or_default(),
                    text: String::new(),
                    operation: None,
                    is_source: true,
                },
            );
        }
    }

    fn block(&mut self, block: Block) -> Block {
        let mut out = Block::with_capacity(2 * block.len());
        for (statement, span) in block.span_into_iter() {
            self.statement(&mut out, statement, span);
        }
        out
    }

    fn statement(&mut self, out: &mut Block, statement: Statement, span: Span) {
        match statement {
            Statement::Emit(range) => {
                out.push(Statement::Emit(range.clone()), span);
                for value in range {
                    self.value(out, value);
                }
            }
            Statement::Call { result, .. } => {
                out.push(statement, span);
                if let Some(value) = result {
                    self.value(out, value);
                }
            }
            Statement::Store { pointer, value } => {
                out.push(statement, span);
                self.stored(out, pointer, value);
            }
            Statement::If {
                condition,
                accept,
                reject,
            } => {
                self.condition(out, condition);
                let (accept, reject) = (self.block(accept), self.block(reject));
                let statement = Statement::If {
                    condition,
                    accept,
                    reject,
                };
                out.push(statement, span);
            }
            Statement::Switch {
                selector,
                mut cases,
            } => {
                self.condition(out, selector);
                for case in &mut cases {
                    let body = std::mem::take(&mut case.body);
                    case.body = self.block(body);
                }
                out.push(Statement::Switch { selector, cases }, span);
            }
            Statement::Loop {
                body,
                continuing,
                break_if,
            } => {
                let statement = Statement::Loop {
                    body: self.block(body),
                    continuing: self.block(continuing),
                    break_if,
                };
                out.push(statement, span);
            }
            Statement::Block(inner) => {
                let inner = self.block(inner);
                out.push(Statement::Block(inner), span);
            }
            Statement::Return { value: Some(value) } => {
                self.result(out, value);
                out.push(statement, span);
            }
            other => out.push(other, span),
        }
    }

    /// A value that has just been computed.
    fn value(&mut self, out: &mut Block, value: Handle<Expression>) {
        let name = self.before.named_expressions.get(&value).cloned();
        let all = self.scope.detail == Detail::Operations;
        let is_operation = operands::is_operation(&self.before.expressions[value]);
        let wanted = match self.scope.detail {
            Detail::Names => name.is_some(),
            Detail::Operations => name.is_some() || is_operation,
            Detail::Nothing | Detail::Result => false,
        };
        if !wanted {
            return;
        }
        let told = Told {
            what: if name.is_some() {
                What::Named
            } else {
                What::Operation
            },
            name: name.as_deref().unwrap_or_default(),
            text: self.writer.operation(value),
            operation: (all && is_operation).then_some(value),
            is_source: true,
        };
        self.tell(out, value, &told);
    }

    fn stored(&mut self, out: &mut Block, pointer: Handle<Expression>, value: Handle<Expression>) {
        if self.scope.detail == Detail::Result {
            return;
        }
        let mut base = pointer;
        loop {
            base = match self.before.expressions[base] {
                Expression::Access { base, .. } | Expression::AccessIndex { base, .. } => base,
                // the compiler's own have no name
                Expression::LocalVariable(v) if self.before.local_variables[v].name.is_some() => {
                    break;
                }
                _ => return,
            };
        }
        let name = self.writer.operation(pointer);
        self.tell(
            out,
            value,
            &Told {
                what: What::Variable,
                name: &name,
                text: self.writer.operation(value),
                operation: None,
                is_source: false,
            },
        );
    }

    fn condition(&mut self, out: &mut Block, value: Handle<Expression>) {
        if self.scope.detail == Detail::Result {
            return;
        }
        let text = self.writer.operation(value);
        self.tell(
            out,
            value,
            &Told {
                what: What::Condition,
                name: "",
                text,
                operation: None,
                is_source: false,
            },
        );
    }

    /// What the function returns: of an array each element that is not zero by construction.
    fn result(&mut self, out: &mut Block, value: Handle<Expression>) {
        let before = self.before;
        let elements = match &before.expressions[value] {
            Expression::Compose { ty, components }
                if matches!(self.types[*ty].inner, TypeInner::Array { .. }) =>
            {
                components.clone()
            }
            _ => return self.returned(out, value, ""),
        };
        for (k, element) in elements.into_iter().enumerate() {
            if !matches!(before.expressions[element], Expression::ZeroValue(_)) {
                self.returned(out, element, &format!("[{k}]"));
            }
        }
    }

    fn returned(&mut self, out: &mut Block, value: Handle<Expression>, name: &str) {
        let text = self.writer.operation(value);
        self.tell(
            out,
            value,
            &Told {
                what: What::Result,
                name,
                text,
                operation: None,
                is_source: false,
            },
        );
    }

    /// Puts the calls that tell every part of a value.
    fn tell(&mut self, out: &mut Block, value: Handle<Expression>, told: &Told) {
        let ty = match &self.info[value].ty {
            TypeResolution::Handle(ty) => &self.types[*ty].inner,
            TypeResolution::Value(inner) => inner,
        };
        // templates hand over and take single precision
        let wide =
            !matches!(told.what, What::Argument | What::Result) || told.name.starts_with('[');
        let pairs =
            wide && self.scope.format == Format::Pair && self.scope.detail == Detail::Operations;
        for part in parts(self.types, ty, pairs) {
            let Some(&recorder) = self.scope.recorders.get(part.shape.recorder()) else {
                continue;
            };
            let site = self.site(value, told, &part);
            if told.is_source {
                self.known.insert(value, part.path.clone(), site);
            }
            let number = self.access(out, value, &part.path);
            let index = u32::try_from(site).unwrap_or(u32::MAX);
            let index = Expression::Literal(Literal::U32(index));
            let index = self.function.expressions.append(index, Span::UNDEFINED);
            out.push(
                Statement::Call {
                    function: recorder,
                    arguments: vec![index, number],
                    result: None,
                },
                Span::UNDEFINED,
            );
        }
    }

    fn site(&mut self, value: Handle<Expression>, told: &Told, part: &Part) -> usize {
        let generated = self.scope.detail == Detail::Operations;
        let span = self.before.expressions.get_span(value).to_range();
        let span = span.filter(|span| generated && !span.is_empty());
        let taken = match told.operation {
            Some(operation) => operands::taken(self.before, &self.writer, &self.known, operation),
            None if generated && !told.is_source => operands::Taken {
                operands: operands::parts(self.before, &self.known, value),
                ..operands::Taken::default()
            },
            None => operands::Taken::default(),
        };
        self.sites.push(Site {
            function: self.before.name.clone().unwrap_or_default(),
            what: told.what,
            name: format!("{}{}", told.name, part.name),
            text: told.text.clone(),
            span: span.map(|s| pullback_grammar::Span::new(s.start as u32, s.end as u32)),
            shape: part.shape,
            operands: taken.operands,
            choice: taken.choice,
            is_operation: taken.is_complete,
        });
        self.sites.len() - 1
    }

    /// The part of a value that indices lead to.
    fn access(
        &mut self,
        out: &mut Block,
        value: Handle<Expression>,
        path: &[u32],
    ) -> Handle<Expression> {
        let mut base = value;
        let mut first = None;
        for &index in path {
            let next = Expression::AccessIndex { base, index };
            base = self.function.expressions.append(next, Span::UNDEFINED);
            first.get_or_insert(base);
        }
        if let Some(first) = first {
            let range = Range::new_from_bounds(first, base);
            out.push(Statement::Emit(range), Span::UNDEFINED);
        }
        base
    }
}
