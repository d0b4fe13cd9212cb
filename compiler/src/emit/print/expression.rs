//! Expressions as text, with no more brackets than they need.

use naga::{
    BinaryOperator, Expression, Handle, LocalVariable, RelationalFunction, ScalarKind, TypeInner,
    UnaryOperator,
};

use super::c_vectors::CVector;
use super::dialect::Dialect;
use super::flow::FunctionPrinter;

/// How tightly operators bind, loosest first.
pub(super) mod rank {
    pub(in super::super) const CHOICE: u8 = 1;
    pub(in super::super) const OR: u8 = 2;
    pub(in super::super) const AND: u8 = 3;
    pub(in super::super) const BITS: u8 = 4;
    pub(in super::super) const COMPARE: u8 = 7;
    pub(in super::super) const SHIFT: u8 = 9;
    pub(in super::super) const SUM: u8 = 10;
    pub(in super::super) const PRODUCT: u8 = 11;
    pub(in super::super) const SIGN: u8 = 12;
    pub(in super::super) const NAME: u8 = 13;
}

/// A text with the rank of its outermost operator.
#[derive(Clone, Debug)]
pub(super) struct Text {
    pub(super) text: String,
    pub(super) rank: u8,
}

impl Text {
    pub(super) fn name(text: impl Into<String>) -> Self {
        Self {
            text: text.into(),
            rank: rank::NAME,
        }
    }

    /// In brackets, unless it binds at least so tightly.
    pub(super) fn within(self, least: u8) -> String {
        if self.rank >= least {
            self.text
        } else {
            format!("({})", self.text)
        }
    }
}

type Made = Result<Text, String>;

impl FunctionPrinter<'_, '_> {
    pub(super) fn inner(&self, handle: Handle<Expression>) -> &TypeInner {
        self.info[handle].ty.inner_with(&self.printer.module.types)
    }

    fn kind(&self, handle: Handle<Expression>) -> ScalarKind {
        self.inner(handle)
            .scalar()
            .map_or(ScalarKind::Float, |s| s.kind)
    }

    /// Number of components, 1 for a scalar.
    pub(super) fn size(&self, handle: Handle<Expression>) -> usize {
        match self.inner(handle) {
            TypeInner::Vector { size, .. } => *size as usize,
            _ => 1,
        }
    }

    /// The type of a vector in C.
    pub(super) fn c_vector(&self, handle: Handle<Expression>) -> CVector {
        CVector::new(self.kind(handle), self.size(handle))
    }

    /// The value as it is used in other expressions: its name, or what it is.
    pub(super) fn value(&self, handle: Handle<Expression>) -> Made {
        if self.plan.named[handle.index()] {
            let name = self.names[handle.index()].clone();
            return Ok(Text::name(name.unwrap_or_default()));
        }
        self.formed(handle)
    }

    /// What computes the value.
    pub(super) fn formed(&self, handle: Handle<Expression>) -> Made {
        let dialect = self.printer.dialect;
        match self.function.expressions[handle] {
            Expression::Literal(literal) => {
                let text = self.printer.literal(literal)?;
                let rank = if text.starts_with('-') {
                    rank::SIGN
                } else {
                    rank::NAME
                };
                Ok(Text { text, rank })
            }
            Expression::Constant(constant) => {
                if self.printer.module.constants[constant].name.is_none() {
                    return Err("a nameless constant".to_owned());
                }
                self.printer.used_constants.borrow_mut().insert(constant);
                let ty = self.printer.module.constants[constant].ty;
                self.printer.type_name(ty)?;
                Ok(Text::name(self.printer.constants[&constant].clone()))
            }
            Expression::ZeroValue(ty) => Ok(Text::name(self.printer.zero(ty)?)),
            Expression::Compose { ty, ref components } => self.compose(ty, components),
            Expression::Access { base, index } => {
                if dialect == Dialect::C && self.size(base) > 1 {
                    return Err("a component of a vector by a number".to_owned());
                }
                let base = self.value(base)?.within(rank::NAME);
                let index = self.value(index)?.text;
                Ok(Text::name(format!("{base}[{index}]")))
            }
            Expression::AccessIndex { base, index } => self.part(base, index),
            Expression::Splat { size, value } => {
                let name = self.printer.inner_name(self.inner(handle), None)?;
                let value = self.value(value)?;
                let value = match dialect {
                    Dialect::Hlsl => value.within(rank::SIGN),
                    _ => value.text,
                };
                let of = self.c_vector(handle);
                Ok(Text::name(self.printer.splat(
                    &name,
                    of,
                    size as usize,
                    &value,
                )))
            }
            Expression::Swizzle {
                size,
                vector,
                pattern,
            } => {
                let letters: String = pattern[..size as usize]
                    .iter()
                    .map(|c| ['x', 'y', 'z', 'w'][*c as usize])
                    .collect();
                if dialect == Dialect::C {
                    let helper = self.printer.c_swizzle(self.c_vector(vector), &letters);
                    return Ok(Text::name(format!(
                        "{helper}({})",
                        self.value(vector)?.text
                    )));
                }
                let base = self.value(vector)?.within(rank::NAME);
                Ok(Text::name(format!("{base}.{letters}")))
            }
            Expression::FunctionArgument(_) => Ok(Text::name(
                self.names[handle.index()].clone().unwrap_or_default(),
            )),
            Expression::LocalVariable(variable) => Ok(Text::name(self.variable(variable))),
            Expression::GlobalVariable(global) => {
                self.printer.used_globals.borrow_mut().insert(global);
                Ok(Text::name(self.printer.globals[&global].clone()))
            }
            Expression::Load { pointer } => self.value(pointer),
            Expression::CallResult(callee) => {
                let arguments = self.plan.survey.arguments.get(&handle);
                let arguments = self.list(arguments.map_or(&[][..], |a| a))?;
                let name = &self.printer.functions[&callee];
                Ok(Text::name(format!("{name}({arguments})")))
            }
            Expression::Unary { op, expr } => self.unary(op, expr),
            Expression::Binary { op, left, right } => self.binary(op, left, right),
            Expression::Select {
                condition,
                accept,
                reject,
            } => self.select(condition, accept, reject),
            Expression::Relational { fun, argument } => {
                let word = match fun {
                    RelationalFunction::All => "all",
                    RelationalFunction::Any => "any",
                    RelationalFunction::IsNan => "isnan",
                    RelationalFunction::IsInf => "isinf",
                };
                if dialect == Dialect::C {
                    return Err(format!("`{word}`"));
                }
                Ok(Text::name(format!(
                    "{word}({})",
                    self.value(argument)?.text
                )))
            }
            Expression::Math {
                fun,
                arg,
                arg1,
                arg2,
                ..
            } => {
                let arguments: Vec<_> = [Some(arg), arg1, arg2].into_iter().flatten().collect();
                self.math(fun, &arguments)
            }
            Expression::As { expr, convert, .. } => self.cast(handle, expr, convert.is_some()),
            _ => Err("something that formulas do not have".to_owned()),
        }
    }

    pub(super) fn variable(&self, variable: Handle<LocalVariable>) -> String {
        self.variables.get(&variable).cloned().unwrap_or_default()
    }

    pub(super) fn list(&self, values: &[Handle<Expression>]) -> Result<String, String> {
        let texts = values
            .iter()
            .map(|&v| Ok(self.value(v)?.text))
            .collect::<Result<Vec<_>, String>>()?;
        Ok(texts.join(", "))
    }

    fn part(&self, base: Handle<Expression>, index: u32) -> Made {
        let module = self.printer.module;
        let inner = match *self.inner(base) {
            TypeInner::Pointer { base, .. } => &module.types[base].inner,
            ref inner => inner,
        };
        let member = match inner {
            TypeInner::Struct { .. } => {
                let name = self.member(base, index);
                // uniforms of the languages that look like C stand by themselves
                if let Expression::GlobalVariable(global) = self.function.expressions[base]
                    && self.printer.dialect != Dialect::Wgsl
                {
                    self.printer.used_globals.borrow_mut().insert(global);
                    return Ok(Text::name(name));
                }
                format!(".{name}")
            }
            TypeInner::Vector { .. } | TypeInner::ValuePointer { .. } => {
                format!(".{}", ["x", "y", "z", "w"][index.min(3) as usize])
            }
            _ => format!("[{index}]"),
        };
        Ok(Text::name(self.value(base)?.within(rank::NAME) + &member))
    }

    fn member(&self, base: Handle<Expression>, index: u32) -> String {
        let module = self.printer.module;
        let handle = match self.info[base].ty.handle() {
            Some(handle) => match module.types[handle].inner {
                TypeInner::Pointer { base, .. } => Some(base),
                _ => Some(handle),
            },
            None => match *self.info[base].ty.inner_with(&module.types) {
                TypeInner::Pointer { base, .. } => Some(base),
                _ => None,
            },
        };
        let members = handle.and_then(|h| self.printer.members.get(&h));
        members
            .and_then(|m| m.get(index as usize).cloned())
            .unwrap_or_default()
    }

    fn compose(&self, ty: Handle<naga::Type>, components: &[Handle<Expression>]) -> Made {
        let printer = self.printer;
        let parts = components
            .iter()
            .map(|&c| Ok(self.value(c)?.text))
            .collect::<Result<Vec<_>, String>>()?;
        let is_vector = matches!(printer.module.types[ty].inner, TypeInner::Vector { .. });
        if printer.dialect == Dialect::C && is_vector {
            let sizes: Vec<usize> = components.iter().map(|&c| self.size(c)).collect();
            printer.type_name(ty)?;
            if sizes.iter().any(|&s| s > 1) {
                let of = CVector::new(self.kind(components[0]), sizes.iter().sum());
                let helper = printer.c_joined(of, &sizes);
                return Ok(Text::name(format!("{helper}({})", parts.join(", "))));
            }
        }
        Ok(Text::name(printer.composed(ty, &parts)?))
    }

    fn unary(&self, op: UnaryOperator, expr: Handle<Expression>) -> Made {
        let size = self.size(expr);
        let value = self.value(expr)?;
        let sign = match op {
            UnaryOperator::Negate => "-",
            UnaryOperator::LogicalNot => "!",
            UnaryOperator::BitwiseNot => "~",
        };
        if self.printer.dialect == Dialect::C && size > 1 {
            let helper = self.printer.c_signed(self.c_vector(expr), sign);
            return Ok(Text::name(format!("{helper}({})", value.text)));
        }
        let operand = value.within(rank::SIGN);
        let text = if operand.starts_with(sign) {
            format!("{sign}({operand})")
        } else {
            format!("{sign}{operand}")
        };
        Ok(Text {
            text,
            rank: rank::SIGN,
        })
    }

    fn binary(
        &self,
        op: BinaryOperator,
        left: Handle<Expression>,
        right: Handle<Expression>,
    ) -> Made {
        let dialect = self.printer.dialect;
        let sign = self.sign(op, left)?;
        if dialect == Dialect::C && (self.size(left) > 1 || self.size(right) > 1) {
            return self.c_operation(sign, left, right);
        }
        if dialect.is_glsl() && self.size(left) > 1 && matches!(op, BinaryOperator::Modulo) {
            return Err("the remainder of vectors".to_owned());
        }
        if dialect.is_glsl()
            && self.size(left) > 1
            && let Some(word) = comparison(sign)
        {
            let list = self.list(&[left, right])?;
            return Ok(Text::name(format!("{word}({list})")));
        }
        // which a signed number may not be shifted by there
        let is_unsigned_shift = dialect == Dialect::Godot
            && matches!(op, BinaryOperator::ShiftLeft | BinaryOperator::ShiftRight)
            && self.kind(left) == ScalarKind::Sint
            && self.kind(right) == ScalarKind::Uint;
        let (least_left, least_right, rank) = ranks(sign);
        let (left, right) = if matches!(sign, "+" | "-" | "*" | "/") {
            (self.operand(left, right)?, self.operand(right, left)?)
        } else {
            (self.value(left)?, self.value(right)?)
        };
        // chains of one operator need no brackets on the left
        let same = left.text.contains(&format!(" {sign} ")) && left.rank == rank;
        let left = match rank {
            rank::OR | rank::AND if left.rank == rank => left.text,
            rank::BITS if same && is_chain(&left.text, sign) => left.text,
            _ => left.within(least_left),
        };
        let right = if is_unsigned_shift {
            format!("int({})", right.text)
        } else {
            right.within(least_right)
        };
        Ok(Text {
            text: format!("{left} {sign} {right}"),
            rank,
        })
    }

    /// An operand; a number beside a vector stands for a vector of it.
    fn operand(&self, handle: Handle<Expression>, other: Handle<Expression>) -> Made {
        if let Expression::Splat { value, .. } = self.function.expressions[handle]
            && !self.plan.named[handle.index()]
            && !matches!(self.function.expressions[other], Expression::Splat { .. })
        {
            return self.value(value);
        }
        self.value(handle)
    }

    fn sign(&self, op: BinaryOperator, left: Handle<Expression>) -> Result<&'static str, String> {
        let is_truth = self.kind(left) == ScalarKind::Bool;
        let is_wgsl = self.printer.dialect == Dialect::Wgsl;
        Ok(match op {
            BinaryOperator::Add => "+",
            BinaryOperator::Subtract => "-",
            BinaryOperator::Multiply => "*",
            BinaryOperator::Divide => "/",
            BinaryOperator::Modulo if self.kind(left) == ScalarKind::Float && !is_wgsl => {
                return Err("the remainder of floating-point numbers".to_owned());
            }
            BinaryOperator::Modulo => "%",
            BinaryOperator::Equal => "==",
            BinaryOperator::NotEqual => "!=",
            BinaryOperator::Less => "<",
            BinaryOperator::LessEqual => "<=",
            BinaryOperator::Greater => ">",
            BinaryOperator::GreaterEqual => ">=",
            BinaryOperator::And if is_truth && !is_wgsl => "&&",
            BinaryOperator::And => "&",
            BinaryOperator::ExclusiveOr => "^",
            BinaryOperator::InclusiveOr if is_truth && !is_wgsl => "||",
            BinaryOperator::InclusiveOr => "|",
            BinaryOperator::LogicalAnd => "&&",
            BinaryOperator::LogicalOr => "||",
            BinaryOperator::ShiftLeft => "<<",
            BinaryOperator::ShiftRight => ">>",
        })
    }

    fn c_operation(&self, sign: &str, left: Handle<Expression>, right: Handle<Expression>) -> Made {
        let printer = self.printer;
        let of = match self.size(left) {
            1 => self.c_vector(right),
            _ => self.c_vector(left),
        };
        let number = |handle: Handle<Expression>| match self.function.expressions[handle] {
            Expression::Splat { value, .. } if !self.plan.named[handle.index()] => Some(value),
            _ if self.size(handle) == 1 => Some(handle),
            _ => None,
        };
        let none = || format!("`{sign}` of vectors");
        let scaled = match (number(left), number(right)) {
            (None, Some(s)) => printer.c_scaled(of, sign).map(|h| (h, left, s)),
            (Some(s), None) if sign == "*" => printer.c_scaled(of, sign).map(|h| (h, right, s)),
            _ => None,
        };
        let both = || printer.c_binary(of, sign).map(|h| (h, left, right));
        let (helper, a, b) = scaled.or_else(both).ok_or_else(none)?;
        let (a, b) = (self.value(a)?.text, self.value(b)?.text);
        Ok(Text::name(format!("{helper}({a}, {b})")))
    }

    fn select(
        &self,
        condition: Handle<Expression>,
        accept: Handle<Expression>,
        reject: Handle<Expression>,
    ) -> Made {
        let is_vector = self.size(condition) > 1;
        let dialect = self.printer.dialect;
        if dialect == Dialect::Wgsl || (is_vector && dialect == Dialect::Msl) {
            let list = self.list(&[reject, accept, condition])?;
            return Ok(Text::name(format!("select({list})")));
        }
        if is_vector && dialect.is_glsl() {
            let list = self.list(&[reject, accept, condition])?;
            let word = match self.kind(accept) {
                ScalarKind::Sint | ScalarKind::Uint => {
                    self.printer.glsl_select(self.c_vector(accept))
                }
                _ => "mix".to_owned(),
            };
            return Ok(Text::name(format!("{word}({list})")));
        }
        if is_vector && dialect == Dialect::C {
            let helper = self.printer.c_select(self.c_vector(accept));
            let list = self.list(&[reject, accept, condition])?;
            return Ok(Text::name(format!("{helper}({list})")));
        }
        let condition = self.value(condition)?.within(rank::OR);
        let accept = self.value(accept)?.within(rank::OR);
        let reject = self.value(reject)?.within(rank::OR);
        Ok(Text {
            text: format!("{condition} ? {accept} : {reject}"),
            rank: rank::CHOICE,
        })
    }
}

/// The function by which GLSL compares vectors.
fn comparison(sign: &str) -> Option<&'static str> {
    Some(match sign {
        "<" => "lessThan",
        "<=" => "lessThanEqual",
        ">" => "greaterThan",
        ">=" => "greaterThanEqual",
        "==" => "equal",
        "!=" => "notEqual",
        _ => return None,
    })
}

/// Whether all operators outside of brackets are this one.
fn is_chain(text: &str, sign: &str) -> bool {
    let mut depth = 0_u32;
    let mut outside = String::new();
    for c in text.chars() {
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth = depth.saturating_sub(1),
            c if depth == 0 => outside.push(c),
            _ => {}
        }
    }
    let operators = [
        "&", "|", "^", "&&", "||", "<", ">", "<=", ">=", "==", "!=", "+", "-", "*",
    ];
    outside
        .split(' ')
        .all(|word| word == sign || !operators.contains(&word))
}

/// Ranks that the operands of an operator need, and its own. WGSL wants brackets where operators on bits or truth values mix,
/// and so do people.
fn ranks(sign: &str) -> (u8, u8, u8) {
    match sign {
        "+" | "-" => (rank::SUM, rank::PRODUCT, rank::SUM),
        "*" | "/" | "%" => (rank::PRODUCT, rank::SIGN, rank::PRODUCT),
        "<<" | ">>" => (rank::SIGN, rank::SIGN, rank::SHIFT),
        "&" | "|" | "^" => (rank::SIGN, rank::SIGN, rank::BITS),
        "&&" => (rank::COMPARE, rank::COMPARE, rank::AND),
        "||" => (rank::COMPARE, rank::COMPARE, rank::OR),
        _ => (rank::SUM, rank::SUM, rank::COMPARE),
    }
}
