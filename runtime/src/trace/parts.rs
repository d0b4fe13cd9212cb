//! The numbers that a value is made of.

use naga::{ScalarKind, Type, TypeInner, UniqueArena};

use super::site::Shape;

/// More parts of a structure are not told.
const MAX_PARTS: usize = 24;

/// A number within a value.
pub(super) struct Part {
    pub(super) name: String,
    pub(super) path: Vec<u32>,
    pub(super) shape: Shape,
}

/// The numbers that a value of a type is made of, at most [`MAX_PARTS`]. `pairs`: whether vectors
/// of two are pairs.
pub(super) fn parts(types: &UniqueArena<Type>, ty: &TypeInner, pairs: bool) -> Vec<Part> {
    let mut parts = Vec::new();
    let mut stack = vec![(String::new(), Vec::new(), ty)];
    while let Some((name, path, ty)) = stack.pop() {
        if parts.len() >= MAX_PARTS {
            break;
        }
        let below = |index: u32| [path.as_slice(), &[index]].concat();
        if let Some(shape) = shape(ty, pairs) {
            parts.push(Part { name, path, shape });
            continue;
        }
        match ty {
            TypeInner::Struct { members, .. } => {
                for (k, member) in (0u32..).zip(members).collect::<Vec<_>>().into_iter().rev() {
                    let field = member.name.as_deref().unwrap_or_default();
                    let inner = &types[member.ty].inner;
                    stack.push((format!("{name}.{field}"), below(k), inner));
                }
            }
            TypeInner::Vector { size, scalar } => {
                for (k, letter) in (0..*size as u32).zip(["x", "y", "z", "w"]) {
                    if let Some(shape) = scalar_shape(scalar.kind, scalar.width) {
                        parts.push(Part {
                            name: format!("{name}.{letter}"),
                            path: below(k),
                            shape,
                        });
                    }
                }
            }
            _ => {}
        }
    }
    parts
}

fn shape(ty: &TypeInner, pairs: bool) -> Option<Shape> {
    match *ty {
        TypeInner::Scalar(scalar) => scalar_shape(scalar.kind, scalar.width),
        TypeInner::Vector { size, scalar }
            if scalar.kind == ScalarKind::Float && scalar.width == 4 =>
        {
            let count = size as u8;
            Some(if pairs && count == 2 {
                Shape::Pair
            } else {
                Shape::Single(count)
            })
        }
        _ => None,
    }
}

fn scalar_shape(kind: ScalarKind, width: u8) -> Option<Shape> {
    match (kind, width) {
        (ScalarKind::Float, 4) => Some(Shape::Single(1)),
        (ScalarKind::Float, 8) => Some(Shape::Double),
        (ScalarKind::Uint, 4) => Some(Shape::Word),
        (ScalarKind::Sint, 4) => Some(Shape::Integer),
        (ScalarKind::Bool, _) => Some(Shape::Truth),
        _ => None,
    }
}
