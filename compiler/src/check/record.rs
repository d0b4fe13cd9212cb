//! Records: the final states of an iteration under one name; and vectors with components replaced.

use pullback_grammar::Diagnostic;
use pullback_grammar::ast::{Expr, ExprId, Local, Name};
use smallvec::SmallVec;

use super::suggest::{quoted, shortened};
use super::{Builder, Value, nearest};
use crate::ir::Id;
use crate::types::Type;

/// Named values, such as the final states of an iteration.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Record {
    /// What the record is where a number or vector is wanted; `None` where a member has to be named.
    pub value: Option<Value>,
    /// Names and values of the members, in order.
    pub members: Vec<(String, Value)>,
}

type Items = SmallVec<[Id; 4]>;
type Places = SmallVec<[usize; 4]>;

impl Record {
    fn member(&self, name: &str) -> Option<&Value> {
        let mut named = self.members.iter().filter(|member| member.0 == name);
        named.next().map(|member| &member.1)
    }

    /// `z, w and count`
    fn names(&self) -> String {
        let quoted: Vec<String> = self.members.iter().map(|m| quoted(&m.0)).collect();
        match quoted.split_last() {
            Some((last, [])) => last.clone(),
            Some((last, before)) => shortened(&format!("{} and {last}", before.join(", "))),
            None => String::new(),
        }
    }
}

impl<'a> Builder<'a> {
    /// The value of an expression as a number, vector or truth value; reports a record of several states.
    pub fn number(&mut self, value: Value, id: ExprId) -> Value {
        let Value::Record(record) = value else {
            return value;
        };
        if let Some(value) = record.value {
            return value;
        }
        let span = self.span(id);
        let first = record.members.first().map_or("", |m| m.0.as_str());
        let hint = match &self.file.exprs[id] {
            Expr::Name(name) => {
                let name = shortened(&name.text);
                format!("name one of them: `{name}.{}`", shortened(first))
            }
            _ => format!("name one of them: `r.{} where r = …`", shortened(first)),
        };
        self.report(
            Diagnostic::error(
                "record-as-number",
                span,
                "these are several values, where one is needed",
            )
            .with_label(format!("has {}", record.names()))
            .with_hint(hint),
        )
    }

    /// `r.z`: a member of a record, or components of a vector.
    pub(super) fn member(&mut self, base: ExprId, field: &'a Name) -> Value {
        let value = self.any(base);
        let Value::Record(record) = value else {
            return self.swizzle(&value, field);
        };
        if let Some(member) = record.member(&field.text) {
            return member.clone();
        }
        if let Some(value @ (Value::Vector(_) | Value::Error)) = &record.value {
            return self.swizzle(value, field);
        }
        let members = record.members.iter().map(|m| m.0.as_str());
        let problem = Diagnostic::error(
            "unknown-member",
            field.span,
            format!("there is no member {}", quoted(&field.text)),
        );
        self.report(match nearest(&field.text, members) {
            Some(near) => problem.with_hint(format!("did you mean {}?", quoted(near))),
            None => problem.with_hint(format!("there are {}", record.names())),
        })
    }

    /// Components of a vector.
    fn swizzle(&mut self, value: &Value, field: &Name) -> Value {
        let Some((items, places)) = self.components(value, field) else {
            return Value::Error;
        };
        let ids: SmallVec<[Id; 4]> = places.iter().map(|&k| items[k]).collect();
        match ids.as_slice() {
            [id] => Value::Scalar(*id),
            _ => Value::Vector(ids),
        }
    }

    /// The components of a vector, and which of them the letters of a swizzle mean.
    fn components(&mut self, value: &Value, field: &Name) -> Option<(Items, Places)> {
        if let Value::Vector(items) = value {
            let places = self.places(items.len(), field)?;
            return Some((items.clone(), places));
        }
        let ty = value.ty(&self.graph)?;
        let problem = Diagnostic::error(
            "bad-swizzle",
            field.span,
            format!(
                "only vectors have components, and this is {}",
                ty.in_words()
            ),
        );
        self.report(if ty == Type::Complex {
            problem.with_hint("the parts of a complex number are re(z) and im(z)")
        } else {
            problem.with_hint("a vector is `(x, y)`; between numbers, a product has a blank or `*`")
        });
        None
    }

    /// One to four components of a vector of this size.
    fn places(&mut self, size: usize, field: &Name) -> Option<Places> {
        let mut places = Places::new();
        for letter in field.text.chars() {
            match place(letter).filter(|&k| k < size) {
                Some(k) => places.push(k),
                None => {
                    self.bad_swizzle(field, letter, size);
                    return None;
                }
            }
        }
        if !(1..=4).contains(&places.len()) {
            self.bad_swizzle(field, ' ', size);
            return None;
        }
        Some(places)
    }

    fn bad_swizzle(&mut self, field: &Name, letter: char, size: usize) -> Value {
        let (known, twins) = (&"xyzw"[..size.min(4)], &"rgba"[..size.min(4)]);
        let (message, hint) = if letter == ' ' {
            let message = format!("{} has more than four letters", quoted(&field.text));
            (message, "a vector has at most 4 components".to_owned())
        } else {
            let message = format!("a vec{size} has no component `{letter}`");
            (
                message,
                format!("the components of a vec{size} are {known}, or {twins}"),
            )
        };
        self.report(Diagnostic::error("bad-swizzle", field.span, message).with_hint(hint))
    }

    /// The value of a local: of `p.xy = …`, the vector p with those components replaced.
    pub(super) fn local(&mut self, local: &'a Local) -> Value {
        let Some(field) = &local.field else {
            return self.any(local.value);
        };
        let old = self.name(&local.name);
        let old = match old {
            Value::Record(record) => record.value.unwrap_or(Value::Error),
            other => other,
        };
        let new = self.expr(local.value);
        if !is_update(field) {
            // reported by the parser
            return Value::Error;
        }
        let Some((mut items, places)) = self.components(&old, field) else {
            return Value::Error;
        };
        let Some(found) = new.ty(&self.graph) else {
            return Value::Error;
        };
        let wanted = match u8::try_from(places.len()) {
            Ok(size) if size > 1 => Type::Vector(size),
            _ => Type::Real,
        };
        if found != wanted {
            let span = self.span(local.value);
            let target = format!("{}.{}", local.name.text, field.text);
            let problem = Diagnostic::error(
                "type-mismatch",
                span,
                format!(
                    "{} is {}, and this is {}",
                    quoted(&target),
                    wanted.in_words(),
                    found.in_words()
                ),
            )
            .with_label(format!("this is {}", found.in_words()));
            return self.report(match (wanted, found) {
                (Type::Vector(_), Type::Real) => {
                    problem.with_hint(format!("for the same number in each write `{wanted}(…)`"))
                }
                _ => problem.with_hint(super::builtins::advice(
                    found,
                    matches!(wanted, Type::Vector(_)),
                )),
            });
        }
        for (&place, id) in places.iter().zip(new.ids()) {
            items[place] = id;
        }
        Value::Vector(items)
    }
}

/// Which component a letter names.
fn place(letter: char) -> Option<usize> {
    "xyzw".find(letter).or_else(|| "rgba".find(letter))
}

/// Whether the letters name components to replace, each once.
fn is_update(field: &Name) -> bool {
    let mut seen = [false; 4];
    let mut is_new = |letter| place(letter).is_some_and(|k| !std::mem::replace(&mut seen[k], true));
    field.text.chars().all(&mut is_new)
}
