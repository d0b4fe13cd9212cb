//! The expressions of a function that is made anew: folded where they are known, else with what their operands have become.

use naga::{Expression, Handle, Literal, LocalVariable, ScalarKind, Span, Type, TypeInner};

use super::function::{Fixed, Rewriter, Slot};
use super::known::Known;
use super::operands::each_operand;
use super::{fold, functions};

impl<'a> Rewriter<'a, '_> {
    /// Makes an expression anew, where a statement emits it.
    pub(super) fn compute(&mut self, handle: Handle<Expression>) {
        let mut expression = self.old.expressions[handle].clone();
        if let Some(known) = self.folded(&expression) {
            self.slots[handle.index()] = Slot {
                known: Some(known),
                at: None,
            };
            return;
        }
        if let Expression::Select {
            condition,
            accept,
            reject,
        } = expression
            && let Some(truth) = self.slots[condition.index()]
                .known
                .as_ref()
                .and_then(Known::bool)
        {
            let taken = if truth { accept } else { reject };
            self.slots[handle.index()] = self.slots[taken.index()].clone();
            return;
        }
        let bits = match expression {
            Expression::As {
                expr,
                kind: ScalarKind::Float,
                convert: None,
            } => self.known(expr).cloned(),
            _ => None,
        };
        match bits {
            Some(bits) => self.hide_bits(&mut expression, &bits),
            None => each_operand(&mut expression, &mut |operand| {
                *operand = self.operand(*operand);
            }),
        }
        let span = self.old.expressions.get_span(handle);
        let start = self.expressions.len();
        let made = self.expressions.append(expression, span);
        self.run.get_or_insert(start);
        self.slots[handle.index()] = Slot {
            known: None,
            at: Some(made),
        };
    }

    /// Lets bits that are no plain number be read from a variable: as constants, an infinity or NaN made of them would be
    /// refused (WGSL, 8.1: the value of a constant expression is finite).
    fn hide_bits(&mut self, expression: &mut Expression, bits: &Known) {
        let ty = match bits {
            Known::Composite(ty, _) => *ty,
            Known::Scalar(literal) => self.pools.scalar(literal.scalar()),
        };
        let init = self.made(bits, ty);
        let variable = LocalVariable {
            name: None,
            ty,
            init: Some(init),
        };
        let variable = self.locals.append(variable, Span::UNDEFINED);
        self.flush();
        let pointer = Expression::LocalVariable(variable);
        let pointer = self.expressions.append(pointer, Span::UNDEFINED);
        let start = self.expressions.len();
        let load = Expression::Load { pointer };
        let load = self.expressions.append(load, Span::UNDEFINED);
        self.run.get_or_insert(start);
        if let Expression::As { expr, .. } = expression {
            *expr = load;
        }
    }

    /// What an operand has become, made if it is a known value.
    pub(super) fn operand(&mut self, old: Handle<Expression>) -> Handle<Expression> {
        let slot = &self.slots[old.index()];
        if let Some(at) = slot.at {
            return at;
        }
        let made = match slot.known.clone() {
            Some(Known::Composite(ty, parts)) => self.made(&Known::Composite(ty, parts), ty),
            Some(known @ Known::Scalar(_)) => self.made_literal(&known),
            // not in a valid module: operands come before their users
            None => {
                self.is_sound = false;
                return old;
            }
        };
        self.slots[old.index()].at = Some(made);
        made
    }

    /// An expression for a known value: a literal, or a constant of the module. Neither needs to be emitted.
    pub(super) fn made(&mut self, known: &Known, ty: Handle<Type>) -> Handle<Expression> {
        if matches!(known, Known::Scalar(_)) {
            return self.made_literal(known);
        }
        let key = known.key();
        if let Some(&made) = self.literals.get(&key) {
            return made;
        }
        let constant = self.pools.constant(known, ty);
        self.flush();
        let made = self
            .expressions
            .append(Expression::Constant(constant), Span::UNDEFINED);
        self.literals.insert(key, made);
        made
    }

    fn made_literal(&mut self, known: &Known) -> Handle<Expression> {
        let key = known.key();
        if let Some(&made) = self.literals.get(&key) {
            return made;
        }
        let literal = known.literal().unwrap_or(Literal::Bool(false));
        self.flush();
        let made = self
            .expressions
            .append(Expression::Literal(literal), Span::UNDEFINED);
        self.literals.insert(key, made);
        made
    }

    pub(super) fn known(&self, handle: Handle<Expression>) -> Option<&Known> {
        self.slots[handle.index()].known.as_ref()
    }

    /// The value of an expression, if it is known.
    pub(super) fn folded(&mut self, expression: &Expression) -> Option<Known> {
        match *expression {
            Expression::Load { pointer } => self.loaded(pointer),
            Expression::Compose { ty, ref components } => {
                let parts: Option<Vec<Known>> =
                    components.iter().map(|&c| self.known(c).cloned()).collect();
                self.pools.composed(ty, |_| parts)
            }
            Expression::Splat { size, value } => {
                let part = self.known(value)?.clone();
                self.pools.vector(vec![part; size as usize])
            }
            Expression::Swizzle {
                size,
                vector,
                pattern,
            } => {
                let from = self.known(vector)?;
                let parts: Option<Vec<Known>> = pattern[..size as usize]
                    .iter()
                    .map(|c| from.part(*c as usize).cloned())
                    .collect();
                self.pools.vector(parts?)
            }
            Expression::AccessIndex { base, index } => {
                self.known(base)?.part(index as usize).cloned()
            }
            Expression::Access { base, index } => {
                self.known(base)?.part(self.known(index)?.index()?).cloned()
            }
            Expression::Unary { op, expr } => fold::unary(op, self.known(expr)?),
            Expression::Binary { op, left, right } => {
                let known = fold::binary(op, self.known(left)?, self.known(right)?)?;
                if fold::compares(op) {
                    self.pools.retyped(known)
                } else {
                    Some(known)
                }
            }
            Expression::Select {
                condition,
                accept,
                reject,
            } => {
                let taken = if self.known(condition)?.bool()? {
                    accept
                } else {
                    reject
                };
                self.known(taken).cloned()
            }
            Expression::Relational { fun, argument } => {
                fold::relational(fun, self.known(argument)?)
            }
            Expression::Math {
                fun,
                arg,
                arg1,
                arg2,
                arg3: None,
            } => {
                let mut args = vec![self.known(arg)?];
                for next in [arg1, arg2].into_iter().flatten() {
                    args.push(self.known(next)?);
                }
                functions::math(fun, &args)
            }
            Expression::As {
                expr,
                kind,
                convert: None,
            } => {
                let known = fold::each(self.known(expr)?, &|x| fold::with_bits(x, kind))?;
                self.pools.retyped(known)
            }
            Expression::As {
                expr,
                kind,
                convert: Some(4),
            } => {
                let known = fold::each(self.known(expr)?, &|x| fold::converted(x, kind))?;
                self.pools.retyped(known)
            }
            _ => None,
        }
    }

    /// The value behind a pointer: of a local variable, or of a setting.
    fn loaded(&self, pointer: Handle<Expression>) -> Option<Known> {
        if let Expression::LocalVariable(local) = self.old.expressions[pointer] {
            return self.values.get(&local).cloned();
        }
        let read = |(fixed, ty, offset): (&Fixed, _, _)| {
            let word = |offset, kind| fixed.word(offset, kind);
            self.pools.read(ty, offset, &word)
        };
        if let Some(place) = self.place(pointer) {
            return read(place);
        }
        // a component of a vector has no place of a type of its own
        let Expression::AccessIndex { base, index } = self.old.expressions[pointer] else {
            return None;
        };
        read(self.place(base)?)?.part(index as usize).cloned()
    }

    /// The uniform that a pointer points into, the type of the part, and its offset in bytes.
    fn place(&self, pointer: Handle<Expression>) -> Option<(&Fixed<'a>, Handle<Type>, u32)> {
        match self.old.expressions[pointer] {
            Expression::GlobalVariable(global) => {
                let fixed = self.fixed.iter().find(|fixed| fixed.global == global)?;
                Some((fixed, fixed.ty, 0))
            }
            Expression::AccessIndex { base, index } => {
                let (fixed, ty, offset) = self.place(base)?;
                match self.pools.inner(ty) {
                    TypeInner::Struct { members, .. } => {
                        let member = members.get(index as usize)?;
                        Some((fixed, member.ty, offset + member.offset))
                    }
                    TypeInner::Array { base, stride, .. } => {
                        Some((fixed, *base, offset + index * stride))
                    }
                    _ => None,
                }
            }
            _ => None,
        }
    }
}
