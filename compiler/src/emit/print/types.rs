//! Types, constants and uniforms as text.

use naga::{
    AddressSpace, ArraySize, Constant, Expression, GlobalVariable, Handle, Literal, Scalar,
    ScalarKind, Type, TypeInner,
};

use super::Printer;
use super::c_vectors::CVector;
use super::dialect::Dialect;
use super::layout;

impl Printer<'_> {
    /// The name of a type that is no array, or of the elements of one.
    pub(super) fn type_name(&self, handle: Handle<Type>) -> Result<String, String> {
        self.inner_name(&self.module.types[handle].inner, Some(handle))
    }

    pub(super) fn inner_name(
        &self,
        inner: &TypeInner,
        handle: Option<Handle<Type>>,
    ) -> Result<String, String> {
        match *inner {
            TypeInner::Scalar(scalar) => Ok(self.dialect.scalar(scalar)?.to_owned()),
            TypeInner::Vector { size, scalar } => {
                let vector = CVector::new(scalar.kind, size as usize);
                self.vectors.borrow_mut().insert(vector);
                self.dialect.vector(size, scalar)
            }
            TypeInner::Struct { .. } => {
                let handle = handle.ok_or("a nameless structure")?;
                self.used_types.borrow_mut().insert(handle);
                Ok(self.types[&handle].clone())
            }
            TypeInner::Array { base, size, .. } => {
                let element = self.type_name(base)?;
                let count = count(size)?;
                Ok(match self.dialect {
                    Dialect::Wgsl => format!("array<{element}, {count}>"),
                    _ => format!("{element}[{count}]"),
                })
            }
            _ => Err("a type that formulas do not have".to_owned()),
        }
    }

    /// `name: type`, `type name`, or `type name[n]`.
    pub(super) fn declared(&self, name: &str, ty: Handle<Type>) -> Result<String, String> {
        if self.dialect == Dialect::Wgsl {
            return Ok(format!("{name}: {}", self.type_name(ty)?));
        }
        if let TypeInner::Array { base, size, .. } = self.module.types[ty].inner {
            return Ok(format!(
                "{} {name}[{}]",
                self.type_name(base)?,
                count(size)?
            ));
        }
        Ok(format!("{} {name}", self.type_name(ty)?))
    }

    /// The structures that are used, those in others first.
    pub(super) fn structures(&self) -> Result<Vec<String>, String> {
        let mut out = Vec::new();
        for (handle, ty) in self.module.types.iter() {
            let TypeInner::Struct { members, .. } = &ty.inner else {
                continue;
            };
            if !self.used_types.borrow().contains(&handle) || self.is_block(handle) {
                continue;
            }
            let name = &self.types[&handle];
            let mut text = match self.dialect {
                Dialect::C => "typedef struct {\n".to_owned(),
                _ => format!("struct {name} {{\n"),
            };
            for (member, name) in members.iter().zip(&self.members[&handle]) {
                let declared = self.declared(name, member.ty)?;
                let end = if self.dialect == Dialect::Wgsl {
                    ","
                } else {
                    ";"
                };
                text.push_str(&format!("    {declared}{end}\n"));
            }
            text.push_str(&match self.dialect {
                Dialect::Wgsl => "}\n".to_owned(),
                Dialect::C => format!("}} {name};\n"),
                _ => "};\n".to_owned(),
            });
            if self.dialect == Dialect::Hlsl {
                text.push_str(&self.maker(handle)?);
            }
            out.push(text);
        }
        Ok(out)
    }

    /// HLSL has no expression for a structure: a function that makes one.
    fn maker(&self, handle: Handle<Type>) -> Result<String, String> {
        let TypeInner::Struct { members, .. } = &self.module.types[handle].inner else {
            return Ok(String::new());
        };
        let (name, inside) = (&self.types[&handle], &self.members[&handle]);
        let mut parameters = Vec::new();
        let mut body = String::new();
        for (member, name) in members.iter().zip(inside) {
            parameters.push(self.declared(name, member.ty)?);
            body.push_str(&format!("    made.{name} = {name};\n"));
        }
        let head = format!("{name} make_{name}({}) {{", parameters.join(", "));
        let head = layout::wrap(&head, 0);
        Ok(format!(
            "\n{head}    {name} made;\n{body}    return made;\n}}\n"
        ))
    }

    /// Whether a structure is only that of a uniform, whose members stand by themselves.
    fn is_block(&self, handle: Handle<Type>) -> bool {
        let of_uniform = |g: &GlobalVariable| g.ty == handle;
        self.dialect != Dialect::Wgsl
            && self
                .module
                .global_variables
                .iter()
                .any(|(_, g)| of_uniform(g))
    }

    /// A named constant.
    pub(super) fn constant(&self, handle: Handle<Constant>) -> Result<String, String> {
        let constant = &self.module.constants[handle];
        let value = self.constant_value(constant.init)?;
        let declared = self.declared(&self.constants[&handle], constant.ty)?;
        let word = match self.dialect {
            Dialect::Wgsl | Dialect::Glsl | Dialect::Godot => "const",
            Dialect::Hlsl | Dialect::C => "static const",
            Dialect::Msl => "constant",
        };
        let line = format!("{word} {declared} = {value};");
        Ok(layout::wrap(&line, 0).trim_end().to_owned())
    }

    /// An expression of the module, which is made of literals.
    fn constant_value(&self, handle: Handle<Expression>) -> Result<String, String> {
        let all = &self.module.global_expressions;
        match all[handle] {
            Expression::Literal(literal) => self.literal(literal),
            Expression::Constant(other) => self.constant_value(self.module.constants[other].init),
            Expression::ZeroValue(ty) => self.zero(ty),
            Expression::Splat { size, value } => {
                let value = self.constant_value(value)?;
                let parts = vec![value; size as usize];
                let name = self.dialect.vector(size, Scalar::F32)?;
                let vector = CVector::new(ScalarKind::Float, size as usize);
                self.vectors.borrow_mut().insert(vector);
                Ok(self.made(&name, &parts))
            }
            Expression::Compose { ty, ref components } => {
                let parts = components
                    .iter()
                    .map(|&c| self.constant_value(c))
                    .collect::<Result<Vec<_>, _>>()?;
                if self.dialect == Dialect::C {
                    self.type_name(ty)?;
                    return Ok(format!("{{{}}}", parts.join(", ")));
                }
                self.composed(ty, &parts)
            }
            _ => Err("a constant that is computed".to_owned()),
        }
    }

    /// A literal.
    pub(super) fn literal(&self, literal: Literal) -> Result<String, String> {
        Ok(match literal {
            Literal::F32(value) => self.dialect.float(value),
            Literal::AbstractFloat(value) => format!("{value:?}"),
            Literal::U32(value) => self.dialect.unsigned(value),
            Literal::I32(value) => self.dialect.signed(value),
            Literal::AbstractInt(value) => value.to_string(),
            Literal::Bool(value) => value.to_string(),
            _ => return Err("numbers of 64 bits".to_owned()),
        })
    }

    /// The zero of a type.
    pub(super) fn zero(&self, handle: Handle<Type>) -> Result<String, String> {
        match &self.module.types[handle].inner {
            TypeInner::Scalar(scalar) => Ok(self.zero_scalar(*scalar)),
            TypeInner::Vector { size, scalar } => {
                let name = self.type_name(handle)?;
                let zero = self.zero_scalar(*scalar);
                let vector = CVector::new(scalar.kind, *size as usize);
                Ok(self.splat(&name, vector, *size as usize, &zero))
            }
            TypeInner::Struct { .. } if self.dialect == Dialect::Wgsl => {
                Ok(format!("{}()", self.type_name(handle)?))
            }
            TypeInner::Struct { members, .. } => {
                let parts = members
                    .iter()
                    .map(|m| self.zero(m.ty))
                    .collect::<Result<Vec<_>, _>>()?;
                self.composed(handle, &parts)
            }
            TypeInner::Array { base, size, .. } => {
                if self.dialect == Dialect::Wgsl {
                    return Ok(format!("{}()", self.type_name(handle)?));
                }
                let zero = self.zero(*base)?;
                self.composed(handle, &vec![zero; count(*size)? as usize])
            }
            _ => Err("a type that formulas do not have".to_owned()),
        }
    }

    fn zero_scalar(&self, scalar: Scalar) -> String {
        match scalar.kind {
            ScalarKind::Float => self.dialect.float(0.0),
            ScalarKind::Uint => "0u".to_owned(),
            ScalarKind::Bool => "false".to_owned(),
            _ => "0".to_owned(),
        }
    }

    /// A vector of equal components.
    pub(super) fn splat(&self, name: &str, of: CVector, size: usize, value: &str) -> String {
        match self.dialect {
            Dialect::Hlsl => format!("(({name}){value})"),
            Dialect::C
                if value
                    .chars()
                    .all(|c| c.is_alphanumeric() || c == '.' || c == '_') =>
            {
                self.made(name, &vec![value.to_owned(); size])
            }
            Dialect::C => format!("{}({value})", self.c_splat(of)),
            _ => format!("{name}({value})"),
        }
    }

    /// `name(parts)`, as the language writes it.
    pub(super) fn made(&self, name: &str, parts: &[String]) -> String {
        let parts = parts.join(", ");
        match self.dialect {
            Dialect::C => format!("({name}){{{parts}}}"),
            _ => format!("{name}({parts})"),
        }
    }

    /// A structure, vector or array of its parts.
    pub(super) fn composed(&self, ty: Handle<Type>, parts: &[String]) -> Result<String, String> {
        let name = self.type_name(ty)?;
        Ok(match (&self.module.types[ty].inner, self.dialect) {
            (TypeInner::Array { .. }, Dialect::Hlsl | Dialect::Msl | Dialect::C) => {
                format!("{{{}}}", parts.join(", "))
            }
            (TypeInner::Struct { .. }, Dialect::Hlsl) => {
                format!("make_{name}({})", parts.join(", "))
            }
            (TypeInner::Struct { .. }, Dialect::Msl) => format!("{name}{{{}}}", parts.join(", ")),
            _ => self.made(&name, parts),
        })
    }

    /// A uniform, as the language declares it.
    pub(super) fn global(&self, handle: Handle<GlobalVariable>) -> Result<String, String> {
        let global = &self.module.global_variables[handle];
        let name = &self.globals[&handle];
        let TypeInner::Struct { members, .. } = &self.module.types[global.ty].inner else {
            return Err("a uniform that is no structure".to_owned());
        };
        if global.space != AddressSpace::Uniform {
            return Err("a buffer".to_owned());
        }
        let inside = &self.members[&global.ty];
        let lines = |before: &str| -> Result<String, String> {
            let mut out = String::new();
            for (member, name) in members.iter().zip(inside) {
                out.push_str(&format!("{before}{};\n", self.declared(name, member.ty)?));
            }
            Ok(out)
        };
        Ok(match self.dialect {
            Dialect::Wgsl => {
                let at = global.binding.map_or((0, 0), |b| (b.group, b.binding));
                format!(
                    "@group({}) @binding({})\nvar<uniform> {name}: {};\n",
                    at.0,
                    at.1,
                    self.type_name(global.ty)?
                )
            }
            Dialect::Glsl | Dialect::Godot => lines("uniform ")?,
            Dialect::Hlsl => format!("cbuffer Parameters {{\n{}}};\n", lines("    ")?),
            Dialect::Msl | Dialect::C => return Err("a uniform outside of functions".to_owned()),
        })
    }
}

fn count(size: ArraySize) -> Result<u32, String> {
    match size {
        ArraySize::Constant(count) => Ok(count.get()),
        _ => Err("an array without a fixed size".to_owned()),
    }
}
