//! Copying parts of one module into another.

use naga::{
    Arena, ArraySize, Block, Constant, Expression, Function, GlobalVariable, Handle, Module, Span,
    Statement, StructMember, Type, TypeInner,
};
use rustc_hash::FxHashMap;

use super::LinkError;

/// Remembers what of one source module has been copied, and whereto.
#[derive(Debug, Default)]
pub struct Importer {
    types: FxHashMap<Handle<Type>, Handle<Type>>,
    constants: FxHashMap<Handle<Constant>, Handle<Constant>>,
    globals: FxHashMap<Handle<GlobalVariable>, Handle<GlobalVariable>>,
    expressions: FxHashMap<Handle<Expression>, Handle<Expression>>,
}

impl Importer {
    /// Copies a type with the types that it is made of.
    pub fn ty(
        &mut self,
        from: &Module,
        to: &mut Module,
        handle: Handle<Type>,
    ) -> Result<Handle<Type>, LinkError> {
        if let Some(&done) = self.types.get(&handle) {
            return Ok(done);
        }
        let ty = &from.types[handle];
        let inner = match &ty.inner {
            TypeInner::Pointer { base, space } => TypeInner::Pointer {
                base: self.ty(from, to, *base)?,
                space: *space,
            },
            TypeInner::Array { base, size, stride } => {
                if matches!(size, ArraySize::Pending(_)) {
                    return Err(LinkError::Unsupported("an array whose size is an override"));
                }
                TypeInner::Array {
                    base: self.ty(from, to, *base)?,
                    size: *size,
                    stride: *stride,
                }
            }
            TypeInner::Struct { members, span } => {
                let members = members
                    .iter()
                    .map(|m| {
                        Ok(StructMember {
                            ty: self.ty(from, to, m.ty)?,
                            ..m.clone()
                        })
                    })
                    .collect::<Result<_, LinkError>>()?;
                TypeInner::Struct {
                    members,
                    span: *span,
                }
            }
            inner @ (TypeInner::Scalar(_)
            | TypeInner::Vector { .. }
            | TypeInner::Matrix { .. }
            | TypeInner::Atomic(_)
            | TypeInner::ValuePointer { .. }) => inner.clone(),
            _ => {
                return Err(LinkError::Unsupported(
                    "a type other than numbers and aggregates",
                ));
            }
        };
        let copy = to.types.insert(
            Type {
                name: ty.name.clone(),
                inner,
            },
            Span::UNDEFINED,
        );
        self.types.insert(handle, copy);
        Ok(copy)
    }

    /// Copies a global variable, or finds the one of the same name that another module brought.
    pub fn global(
        &mut self,
        from: &Module,
        to: &mut Module,
        handle: Handle<GlobalVariable>,
    ) -> Result<Handle<GlobalVariable>, LinkError> {
        if let Some(&done) = self.globals.get(&handle) {
            return Ok(done);
        }
        let mut variable = from.global_variables[handle].clone();
        if variable.init.is_some() {
            return Err(LinkError::Unsupported("a global variable with a value"));
        }
        variable.ty = self.ty(from, to, variable.ty)?;
        let known = to
            .global_variables
            .iter()
            .find(|(_, g)| g.name == variable.name);
        let copy = match known {
            Some((known, other))
                if other.ty == variable.ty && other.binding == variable.binding =>
            {
                known
            }
            Some(_) => {
                return Err(LinkError::Signature(variable.name.unwrap_or_default()));
            }
            None => to.global_variables.append(variable, Span::UNDEFINED),
        };
        self.globals.insert(handle, copy);
        Ok(copy)
    }

    fn constant(
        &mut self,
        from: &Module,
        to: &mut Module,
        handle: Handle<Constant>,
    ) -> Result<Handle<Constant>, LinkError> {
        if let Some(&done) = self.constants.get(&handle) {
            return Ok(done);
        }
        let constant = &from.constants[handle];
        let ty = self.ty(from, to, constant.ty)?;
        let init = self.global_expression(from, to, constant.init)?;
        let copy = to.constants.append(
            Constant {
                name: constant.name.clone(),
                ty,
                init,
            },
            Span::UNDEFINED,
        );
        self.constants.insert(handle, copy);
        Ok(copy)
    }

    fn global_expression(
        &mut self,
        from: &Module,
        to: &mut Module,
        handle: Handle<Expression>,
    ) -> Result<Handle<Expression>, LinkError> {
        if let Some(&done) = self.expressions.get(&handle) {
            return Ok(done);
        }
        let copy = match &from.global_expressions[handle] {
            Expression::Compose { ty, components } => {
                let ty = self.ty(from, to, *ty)?;
                let components = components
                    .iter()
                    .map(|&c| self.global_expression(from, to, c))
                    .collect::<Result<_, _>>()?;
                Expression::Compose { ty, components }
            }
            Expression::Splat { size, value } => Expression::Splat {
                size: *size,
                value: self.global_expression(from, to, *value)?,
            },
            Expression::Constant(c) => Expression::Constant(self.constant(from, to, *c)?),
            Expression::ZeroValue(ty) => Expression::ZeroValue(self.ty(from, to, *ty)?),
            literal @ Expression::Literal(_) => literal.clone(),
            _ => return Err(LinkError::Unsupported("a constant that is computed")),
        };
        let copy = to.global_expressions.append(copy, Span::UNDEFINED);
        self.expressions.insert(handle, copy);
        Ok(copy)
    }

    /// Rewrites a copy of a function of `from` to refer to `to`; `callees` says where its callees are.
    pub fn function(
        &mut self,
        from: &Module,
        to: &mut Module,
        function: &mut Function,
        callees: &FxHashMap<Handle<Function>, Handle<Function>>,
    ) -> Result<(), LinkError> {
        for argument in &mut function.arguments {
            argument.ty = self.ty(from, to, argument.ty)?;
        }
        if let Some(result) = &mut function.result {
            result.ty = self.ty(from, to, result.ty)?;
        }
        for (_, local) in function.local_variables.iter_mut() {
            local.ty = self.ty(from, to, local.ty)?;
        }
        let mut expressions: Arena<Expression> = Arena::new();
        for (handle, expression) in function.expressions.iter() {
            let mut expression = expression.clone();
            self.expression(from, to, &mut expression, callees)?;
            expressions.append(expression, function.expressions.get_span(handle));
        }
        function.expressions = expressions;
        function.diagnostic_filter_leaf = None;
        redirect(&mut function.body, callees);
        Ok(())
    }

    fn expression(
        &mut self,
        from: &Module,
        to: &mut Module,
        expression: &mut Expression,
        callees: &FxHashMap<Handle<Function>, Handle<Function>>,
    ) -> Result<(), LinkError> {
        match expression {
            Expression::Constant(c) => *c = self.constant(from, to, *c)?,
            Expression::ZeroValue(ty) | Expression::Compose { ty, .. } => {
                *ty = self.ty(from, to, *ty)?;
            }
            Expression::GlobalVariable(g) => *g = self.global(from, to, *g)?,
            Expression::CallResult(f) => *f = callees.get(f).copied().unwrap_or(*f),
            Expression::Override(_)
            | Expression::AtomicResult { .. }
            | Expression::WorkGroupUniformLoadResult { .. }
            | Expression::Derivative { .. } => {
                return Err(LinkError::Unsupported(
                    "an override, an atomic, a workgroup load or a hardware derivative",
                ));
            }
            _ => {}
        }
        Ok(())
    }
}

/// Points every call of a block at the copied callees.
fn redirect(block: &mut Block, callees: &FxHashMap<Handle<Function>, Handle<Function>>) {
    for statement in block.iter_mut() {
        match statement {
            Statement::Call { function, .. } => {
                *function = callees.get(function).copied().unwrap_or(*function);
            }
            Statement::Block(inner) => redirect(inner, callees),
            Statement::If { accept, reject, .. } => {
                redirect(accept, callees);
                redirect(reject, callees);
            }
            Statement::Switch { cases, .. } => {
                cases
                    .iter_mut()
                    .for_each(|c| redirect(&mut c.body, callees));
            }
            Statement::Loop {
                body, continuing, ..
            } => {
                redirect(body, callees);
                redirect(continuing, callees);
            }
            _ => {}
        }
    }
}
