//! Functions on vectors: what they build.

use std::ops::RangeInclusive;
use std::sync::OnceLock;

use pullback_grammar::{Diagnostic, Span};
use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use super::{Builder, Value};
use crate::ir::{Id, Prim, Ty};
use crate::types::Type;

/// A function of the language that is taken apart into primitives.
#[derive(Debug)]
pub struct Builtin {
    /// Names, the first is the usual one.
    pub names: &'static [&'static str],
    /// How it is written.
    pub usage: &'static str,
    /// One line: what it is.
    pub doc: &'static str,
    /// Numbers of arguments that it takes.
    pub arity: RangeInclusive<usize>,
    /// Builds the value; reports operands that do not fit.
    pub build: fn(&mut Builder, &[Value], Span) -> Value,
}

/// Every such function.
pub fn builtins() -> &'static [Builtin] {
    static BUILTINS: OnceLock<Vec<Builtin>> = OnceLock::new();
    BUILTINS.get_or_init(|| {
        vec![
            Builtin {
                names: &["vec2"],
                usage: "vec2(x, y)",
                doc: "vector of two components; of one real, that real twice",
                arity: 1..=2,
                build: |b, args, span| vector(b, args, span, 2),
            },
            Builtin {
                names: &["vec3"],
                usage: "vec3(x, y, z)",
                doc: "vector of three components, from reals and vectors; of one real, that real three times",
                arity: 1..=3,
                build: |b, args, span| vector(b, args, span, 3),
            },
            Builtin {
                names: &["vec4"],
                usage: "vec4(x, y, z, w)",
                doc: "vector of four components, from reals and vectors; of one real, that real four times",
                arity: 1..=4,
                build: |b, args, span| vector(b, args, span, 4),
            },
            Builtin {
                names: &["length"],
                usage: "length(p), |p|",
                doc: "Euclidean length, without overflow; its derivative at 0 is 0",
                arity: 1..=1,
                build: |b, args, span| length(b, &args[0], span),
            },
            Builtin {
                names: &["distance"],
                usage: "distance(p, q)",
                doc: "Euclidean distance",
                arity: 2..=2,
                build: |b, args, span| {
                    let difference = b.arithmetic(Prim::Sub, &args[0], &args[1], span);
                    length(b, &difference, span)
                },
            },
            Builtin {
                names: &["dot"],
                usage: "dot(p, q)",
                doc: "scalar product",
                arity: 2..=2,
                build: dot,
            },
            Builtin {
                names: &["cross"],
                usage: "cross(p, q)",
                doc: "vector product",
                arity: 2..=2,
                build: cross,
            },
            Builtin {
                names: &["normalize"],
                usage: "normalize(p)",
                doc: "p / |p|",
                arity: 1..=1,
                build: normalized,
            },
            Builtin {
                names: &["rotate"],
                usage: "rotate(p, angle)",
                doc: "vec2 turned about the origin, anticlockwise, by an angle in radians",
                arity: 2..=2,
                build: rotate,
            },
        ]
    })
}

/// The function of this name.
pub fn by_name(name: &str) -> Option<&'static Builtin> {
    static INDEX: OnceLock<FxHashMap<&'static str, &'static Builtin>> = OnceLock::new();
    let index = INDEX.get_or_init(|| {
        builtins()
            .iter()
            .flat_map(|b| b.names.iter().map(move |&n| (n, b)))
            .collect()
    });
    index.get(name).copied()
}

fn mismatch(b: &mut Builder, span: Span, expected: &str, found: &Value) -> Value {
    let Some(ty) = found.ty(&b.graph) else {
        return Value::Error;
    };
    b.report(
        Diagnostic::error(
            "type-mismatch",
            span,
            format!("{expected} is needed here, and this is {}", ty.in_words()),
        )
        .with_hint(advice(ty, expected.contains("vec"))),
    )
}

/// How a value of this type becomes what is wanted: a vector, or a real number.
pub fn advice(found: Type, wants_vector: bool) -> &'static str {
    match found {
        Type::Complex => "take re(…), im(…) or abs(…) of the complex number",
        Type::Bool => "a condition is no number: `if … then 1 else 0` is one",
        Type::Vector(_) if wants_vector => {
            "vectors must have the same number of components; a swizzle such as p.xy shortens one"
        }
        Type::Vector(_) => "take a component such as v.x, or the length |v|",
        Type::Real => "write a vector such as (x, y) or (x, y, z)",
    }
}

fn vector(b: &mut Builder, args: &[Value], span: Span, size: usize) -> Value {
    let mut items: SmallVec<[Id; 4]> = SmallVec::new();
    for arg in args {
        match arg.ty(&b.graph) {
            Some(Type::Real | Type::Vector(_)) => items.extend(arg.ids()),
            Some(_) => return mismatch(b, span, "reals or vectors", arg),
            None => return Value::Error,
        }
    }
    if items.len() == 1 {
        items = SmallVec::from_elem(items[0], size);
    }
    if items.len() == size {
        return Value::Vector(items);
    }
    b.report(
        Diagnostic::error(
            "type-mismatch",
            span,
            format!("vec{size} needs {size} components, found {}", items.len()),
        )
        .with_hint("shorten a vector with a swizzle such as p.xy"),
    )
}

/// The components of a vector, or the error.
fn components(b: &mut Builder, value: &Value, span: Span) -> Result<SmallVec<[Id; 4]>, Value> {
    match value {
        Value::Vector(items) => Ok(items.clone()),
        _ => Err(mismatch(b, span, "a vector", value)),
    }
}

/// |v|: absolute value, modulus or length.
pub fn length(b: &mut Builder, value: &Value, span: Span) -> Value {
    let items = match value {
        Value::Vector(items) => items,
        Value::Record(_) | Value::Error => return Value::Error,
        Value::Scalar(id) if b.graph.ty(*id) == Ty::Bool => {
            return mismatch(b, span, "a number or vector", value);
        }
        Value::Scalar(id) => return Value::Scalar(b.graph.apply(Prim::Abs, &[*id])),
    };
    Value::Scalar(match *items.as_slice() {
        [x, y] => b.graph.apply(Prim::Hypot, &[x, y]),
        [x, y, z] => b.graph.apply(Prim::Hypot3, &[x, y, z]),
        [x, y, z, w] => {
            let xyz = b.graph.apply(Prim::Hypot3, &[x, y, z]);
            b.graph.apply(Prim::Hypot, &[xyz, w])
        }
        _ => return Value::Error,
    })
}

/// p/|p|, NaN at the origin. The coordinates of a direction are operations of their own: their derivatives do not cancel, as
/// those of a quotient do, and they are numbers where the length overflows.
fn normalized(b: &mut Builder, args: &[Value], span: Span) -> Value {
    let size = length(b, &args[0], span);
    let (Value::Vector(items), &Value::Scalar(r)) = (&args[0], &size) else {
        return b.arithmetic(Prim::Div, &args[0], &size, span);
    };
    let point = items.as_slice();
    let g = &mut b.graph;
    let directions: SmallVec<[Id; 4]> = match point {
        &[x, y, z, w] => {
            let xyz = g.apply(Prim::Hypot3, &[x, y, z]);
            let share = crate::table::direction(g, &[xyz, w], 0, r);
            let mut out: SmallVec<[Id; 4]> = (0..3)
                .map(|k| {
                    let within = crate::table::direction(g, &[x, y, z], k, xyz);
                    g.mul(within, share)
                })
                .collect();
            out.push(crate::table::direction(g, &[xyz, w], 1, r));
            out
        }
        _ => (0..point.len())
            .map(|k| crate::table::direction(g, point, k, r))
            .collect(),
    };
    let (zero, hole) = (g.real(0.0), g.real(f64::NAN));
    let at_origin = g.apply(Prim::Equal, &[r, zero]);
    let items = directions
        .into_iter()
        .map(|d| g.apply(Prim::Select, &[at_origin, hole, d]))
        .collect();
    Value::Vector(items)
}

fn dot(b: &mut Builder, args: &[Value], span: Span) -> Value {
    let (p, q) = match (components(b, &args[0], span), components(b, &args[1], span)) {
        (Ok(p), Ok(q)) => (p, q),
        (Err(e), _) | (_, Err(e)) => return e,
    };
    if p.len() != q.len() {
        return mismatch(b, span, &format!("a vec{}", p.len()), &args[1]);
    }
    let mut sum = None;
    for (&x, &y) in p.iter().zip(&q) {
        let term = if x == y {
            b.graph.apply(Prim::PowInt(2), &[x])
        } else {
            b.graph.mul(x, y)
        };
        sum = Some(match sum {
            Some(sum) => b.graph.add(sum, term),
            None => term,
        });
    }
    sum.map_or(Value::Error, Value::Scalar)
}

fn cross(b: &mut Builder, args: &[Value], span: Span) -> Value {
    for arg in args {
        match arg {
            Value::Vector(items) if items.len() == 3 => {}
            Value::Error => return Value::Error,
            _ => return mismatch(b, span, "a vec3", arg),
        }
    }
    let (p, q) = (args[0].ids(), args[1].ids());
    let g = &mut b.graph;
    let mut minor = |i: usize, j: usize| {
        let (left, right) = (g.mul(p[i], q[j]), g.mul(p[j], q[i]));
        g.sub(left, right)
    };
    Value::Vector(SmallVec::from_slice(&[
        minor(1, 2),
        minor(2, 0),
        minor(0, 1),
    ]))
}

fn rotate(b: &mut Builder, args: &[Value], span: Span) -> Value {
    let angle = match (&args[0], &args[1]) {
        (Value::Error, _) | (_, Value::Error) => return Value::Error,
        (Value::Vector(items), Value::Scalar(angle)) if items.len() == 2 => *angle,
        (Value::Vector(items), _) if items.len() == 2 => {
            return mismatch(b, span, "a real angle", &args[1]);
        }
        _ => return mismatch(b, span, "a vec2", &args[0]),
    };
    if b.graph.ty(angle) != Ty::Real {
        return mismatch(b, span, "a real angle", &args[1]);
    }
    let p = args[0].ids();
    let g = &mut b.graph;
    let (c, s) = (g.apply(Prim::Cos, &[angle]), g.apply(Prim::Sin, &[angle]));
    let (cx, sy) = (g.mul(c, p[0]), g.mul(s, p[1]));
    let (sx, cy) = (g.mul(s, p[0]), g.mul(c, p[1]));
    Value::Vector(SmallVec::from_slice(&[g.sub(cx, sy), g.add(sx, cy)]))
}
