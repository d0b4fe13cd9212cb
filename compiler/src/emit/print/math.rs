//! Built-in functions and conversions as text.

use naga::{Expression, Handle, MathFunction, Scalar, ScalarKind, TypeInner};

use super::c_vectors::CVector;
use super::dialect::Dialect;
use super::expression::{Text, rank};
use super::flow::FunctionPrinter;

type Made = Result<Text, String>;

impl FunctionPrinter<'_, '_> {
    pub(super) fn math(&self, fun: MathFunction, arguments: &[Handle<Expression>]) -> Made {
        let printer = self.printer;
        let dialect = printer.dialect;
        let first = arguments[0];
        let scalar = self.inner(first).scalar().unwrap_or(Scalar::F32);
        if dialect == Dialect::C && arguments.iter().any(|&a| self.size(a) > 1) {
            let word = format!("{fun:?}").to_lowercase();
            let helper = printer.c_vector_function(self.c_vector(first), &word);
            let helper = helper.ok_or_else(|| format!("`{word}` of vectors"))?;
            return Ok(Text::name(format!("{helper}({})", self.list(arguments)?)));
        }
        if let Some(name) = dialect.math(fun, scalar.kind) {
            let list = self.math_list(arguments)?;
            return Ok(Text::name(format!("{name}({list})")));
        }
        let list = self.list(arguments)?;
        let kind = match scalar.kind {
            ScalarKind::Sint => "int",
            ScalarKind::Uint => "uint",
            _ => "float",
        };
        let helper = |name: &str| printer.helper(name);
        let name = match (fun, dialect) {
            (MathFunction::Saturate, Dialect::Glsl | Dialect::Godot) => {
                return Ok(Text::name(format!("clamp({list}, 0.0, 1.0)")));
            }
            (MathFunction::Fma, _) => return self.fused(arguments),
            (MathFunction::InverseSqrt, Dialect::C) => {
                return Ok(Text {
                    text: format!("1.0f / sqrtf({list})"),
                    rank: rank::PRODUCT,
                });
            }
            (MathFunction::CountLeadingZeros, Dialect::Hlsl) => {
                return Ok(Text {
                    text: format!("31u - firstbithigh({list})"),
                    rank: rank::SUM,
                });
            }
            (MathFunction::CountLeadingZeros, _) => helper("leading_zeros")?,
            (MathFunction::Asinh, Dialect::Hlsl) => helper("inverse_sinh")?,
            (MathFunction::Acosh, Dialect::Hlsl) => helper("inverse_cosh")?,
            (MathFunction::Atanh, Dialect::Hlsl) => helper("inverse_tanh")?,
            (fun, _) => helper(&format!("{}_{kind}", format!("{fun:?}").to_lowercase()))?,
        };
        Ok(Text::name(format!("{name}({list})")))
    }

    /// Arguments; where all are literals, with the suffix that says which numbers they are.
    fn math_list(&self, arguments: &[Handle<Expression>]) -> Result<String, String> {
        let is_literal = |&a: &Handle<Expression>| {
            matches!(self.function.expressions[a], Expression::Literal(_))
        };
        if self.printer.dialect == Dialect::Wgsl && arguments.iter().all(is_literal) {
            let texts = arguments
                .iter()
                .map(|&a| self.typed_literal(a))
                .collect::<Result<Vec<_>, String>>()?;
            return Ok(texts.join(", "));
        }
        self.list(arguments)
    }

    /// A literal of WGSL that cannot be taken for another type.
    fn typed_literal(&self, handle: Handle<Expression>) -> Result<String, String> {
        let text = self.value(handle)?.text;
        Ok(match self.function.expressions[handle] {
            Expression::Literal(naga::Literal::F32(_)) => format!("{text}f"),
            Expression::Literal(naga::Literal::I32(_)) if !text.contains('(') => {
                format!("{text}i")
            }
            _ => text,
        })
    }

    /// a b + c, in languages without a function for it. WGSL leaves open whether it is rounded once.
    fn fused(&self, arguments: &[Handle<Expression>]) -> Made {
        let &[a, b, c] = arguments else {
            return Err("`fma`".to_owned());
        };
        let a = self.value(a)?.within(rank::PRODUCT);
        let b = self.value(b)?.within(rank::SIGN);
        let c = self.value(c)?.within(rank::PRODUCT);
        Ok(Text {
            text: format!("{a} * {b} + {c}"),
            rank: rank::SUM,
        })
    }

    /// A conversion of numbers, or of their bits.
    pub(super) fn cast(
        &self,
        handle: Handle<Expression>,
        expr: Handle<Expression>,
        converts: bool,
    ) -> Made {
        let dialect = self.printer.dialect;
        let from = self.inner(expr).scalar().unwrap_or(Scalar::F32);
        let to = self.inner(handle).scalar().unwrap_or(Scalar::F32);
        let name = self.printer.inner_name(self.inner(handle), None)?;
        let value = self.value(expr)?;
        if dialect == Dialect::C {
            if matches!(self.inner(handle), TypeInner::Vector { .. }) {
                let vectors = [self.c_vector(expr), self.c_vector(handle)];
                return self.c_vector_cast(vectors, [from.kind, to.kind], value, converts);
            }
            return self.c_cast(&name, from, to, value, converts);
        }
        let between_integers = from.kind != ScalarKind::Float && to.kind != ScalarKind::Float;
        let text = match dialect {
            Dialect::Wgsl if converts => format!("{name}({})", value.text),
            Dialect::Wgsl => {
                let text = match self.function.expressions[expr] {
                    Expression::Literal(_) => self.typed_literal(expr)?,
                    _ => value.text,
                };
                format!("bitcast<{name}>({text})")
            }
            _ if converts || between_integers => format!("{name}({})", value.text),
            Dialect::Msl => format!("as_type<{name}>({})", value.text),
            Dialect::Hlsl => {
                let word = match to.kind {
                    ScalarKind::Float => "asfloat",
                    ScalarKind::Uint => "asuint",
                    _ => "asint",
                };
                format!("{word}({})", value.text)
            }
            _ => {
                let word = match (from.kind, to.kind) {
                    (ScalarKind::Float, ScalarKind::Uint) => "floatBitsToUint",
                    (ScalarKind::Float, _) => "floatBitsToInt",
                    (ScalarKind::Uint, _) => "uintBitsToFloat",
                    _ => "intBitsToFloat",
                };
                format!("{word}({})", value.text)
            }
        };
        Ok(Text::name(text))
    }

    fn c_cast(&self, name: &str, from: Scalar, to: Scalar, value: Text, converts: bool) -> Made {
        use ScalarKind::{Bool, Float, Sint, Uint};
        let helper = match (from.kind, to.kind, converts) {
            (Float, Sint, true) => "int_of_float",
            (Float, Uint, true) => "uint_of_float",
            (Float, Uint, false) => "bits_of_float",
            (Uint, Float, false) => "float_of_bits",
            (Float, Bool, _) => {
                return Ok(Text {
                    text: format!("{} != 0.0f", value.within(rank::SUM)),
                    rank: rank::COMPARE,
                });
            }
            (Float, _, false) | (_, Float, false) => return Err("bits as a signed number".into()),
            _ => {
                return Ok(Text {
                    text: format!("({name}){}", value.within(rank::SIGN)),
                    rank: rank::SIGN,
                });
            }
        };
        let helper = self.printer.helper(helper)?;
        Ok(Text::name(format!("{helper}({})", value.text)))
    }

    /// A conversion of each component.
    fn c_vector_cast(
        &self,
        [from, to]: [CVector; 2],
        kinds: [ScalarKind; 2],
        value: Text,
        converts: bool,
    ) -> Made {
        use ScalarKind::{Float, Sint, Uint};
        let printer = self.printer;
        let (word, by) = match (kinds, converts) {
            ([Float, Uint], false) => ("bits", printer.helper("bits_of_float")?),
            ([Uint, Float], false) => ("of_bits", printer.helper("float_of_bits")?),
            ([Float, Sint], true) => ("of", printer.helper("int_of_float")?),
            ([Float, Uint], true) => ("of", printer.helper("uint_of_float")?),
            ([Sint | Uint, Float], true) => ("of", "(float)".to_owned()),
            ([Sint, Uint], _) => ("of", "(uint32_t)".to_owned()),
            ([Uint, Sint], _) => ("of", "(int32_t)".to_owned()),
            _ => return Err("this conversion of vectors".to_owned()),
        };
        let helper = printer.c_converted(from, to, word, &by);
        Ok(Text::name(format!("{helper}({})", value.text)))
    }
}
