//! Whether two trees say the same.

use crate::ast::{Expr, ExprId, Exprs, File, Formal, Item, Range, Setting};

/// Whether two files have the same tree, places in the text aside: the same statements in the same order, with the
/// same names, operators and numbers, bit for bit.
#[must_use]
pub fn same_tree(one: &File, other: &File) -> bool {
    let mut pairs = Vec::new();
    one.items.len() == other.items.len()
        && one
            .items
            .iter()
            .zip(&other.items)
            .all(|(a, b)| same_item(a, b, &mut pairs))
        && same_expressions((&one.exprs, &other.exprs), pairs)
}

/// Expressions that must be the same, one of each tree.
type Pairs = Vec<(ExprId, ExprId)>;

/// Whether two statements are the same but for their expressions, which are added to `pairs`.
fn same_item(one: &Item, other: &Item, pairs: &mut Pairs) -> bool {
    match (one, other) {
        (Item::Function(a), Item::Function(b)) => {
            pairs.push((a.body, b.body));
            a.name.text == b.name.text && same_formals(&a.params, &b.params)
        }
        (Item::Constant(a), Item::Constant(b)) => {
            pairs.push((a.value, b.value));
            a.name.text == b.name.text
        }
        (Item::Param(a), Item::Param(b)) => {
            pairs.push((a.default, b.default));
            if let (Some(a), Some(b)) = (a.range, b.range) {
                pairs.extend([(a.0, b.0), (a.1, b.1)]);
            }
            a.name.text == b.name.text && a.range.is_some() == b.range.is_some()
        }
        (Item::Show(a), Item::Show(b)) => {
            pairs.extend(a.args.iter().copied().zip(b.args.iter().copied()));
            a.scene.text == b.scene.text
                && a.args.len() == b.args.len()
                && a.settings.len() == b.settings.len()
                && a.settings
                    .iter()
                    .zip(&b.settings)
                    .all(|(a, b)| same_setting(a, b, pairs))
        }
        (Item::Formula(a), Item::Formula(b)) => {
            pairs.push((a.body, b.body));
            true
        }
        _ => false,
    }
}

fn same_formals(one: &[Formal], other: &[Formal]) -> bool {
    let parts = |formal: &Formal| {
        let ty = formal.ty.as_ref().map(|ty| ty.text.clone());
        (formal.name.text.clone(), ty)
    };
    one.iter().map(parts).eq(other.iter().map(parts))
}

fn same_setting(one: &Setting, other: &Setting, pairs: &mut Pairs) -> bool {
    pairs.push((one.value, other.value));
    pairs.extend(one.upper.zip(other.upper));
    one.name.text == other.name.text && one.upper.is_some() == other.upper.is_some()
}

/// Whether the expressions of each pair are the same, with a stack of its own: chains have any length.
fn same_expressions(trees: (&Exprs, &Exprs), mut pairs: Pairs) -> bool {
    let operands = |expr: &Expr| {
        let mut found = Vec::new();
        expr.for_each_child(|child| found.push(child));
        found
    };
    while let Some((a, b)) = pairs.pop() {
        let (a, b) = (&trees.0[a], &trees.1[b]);
        let (of_a, of_b) = (operands(a), operands(b));
        if of_a.len() != of_b.len() || !same_node(a, b) {
            return false;
        }
        pairs.extend(of_a.into_iter().zip(of_b));
    }
    true
}

/// Whether two expressions are the same but for their operands, of which they have as many.
fn same_node(one: &Expr, other: &Expr) -> bool {
    match (one, other) {
        (Expr::Error, Expr::Error)
        | (Expr::Vector(_), Expr::Vector(_))
        | (Expr::If { .. }, Expr::If { .. }) => true,
        (Expr::Number(a), Expr::Number(b)) | (Expr::Imaginary(a), Expr::Imaginary(b)) => {
            a.to_bits() == b.to_bits()
        }
        (Expr::Name(a), Expr::Name(b))
        | (Expr::Member { field: a, .. }, Expr::Member { field: b, .. }) => a.text == b.text,
        (Expr::Unary { op: a, .. }, Expr::Unary { op: b, .. }) => a == b,
        (Expr::Binary { op: a, .. }, Expr::Binary { op: b, .. }) => a == b,
        (Expr::Compare { rest: a, .. }, Expr::Compare { rest: b, .. }) => {
            a.iter().map(|step| step.0).eq(b.iter().map(|step| step.0))
        }
        (
            Expr::Call {
                callee: a,
                primes: of_a,
                ..
            },
            Expr::Call {
                callee: b,
                primes: of_b,
                ..
            },
        ) => a.text == b.text && of_a == of_b,
        (Expr::Piecewise { arms: a, .. }, Expr::Piecewise { arms: b, .. }) => a.len() == b.len(),
        (Expr::Where { locals: a, .. }, Expr::Where { locals: b, .. }) => {
            let field = |field: &Option<crate::ast::Name>| field.as_ref().map(|f| f.text.clone());
            a.iter()
                .zip(b)
                .all(|(a, b)| a.name.text == b.name.text && field(&a.field) == field(&b.field))
        }
        (
            Expr::Series {
                kind: a,
                ranges: of_a,
                ..
            },
            Expr::Series {
                kind: b,
                ranges: of_b,
                ..
            },
        ) => a == b && same_ranges(of_a, of_b),
        (
            Expr::Iterate {
                states: a,
                until: of_a,
                ..
            },
            Expr::Iterate {
                states: b,
                until: of_b,
                ..
            },
        ) => {
            let names =
                |(a, b): (&(crate::ast::Name, _), &(crate::ast::Name, _))| a.0.text == b.0.text;
            a.len() == b.len() && a.iter().zip(b).all(names) && of_a.is_some() == of_b.is_some()
        }
        (
            Expr::Integral {
                method: of_a,
                range: a,
                ..
            },
            Expr::Integral {
                method: of_b,
                range: b,
                ..
            },
        ) => of_a == of_b && a.name.text == b.name.text,
        _ => false,
    }
}

fn same_ranges(one: &[Range], other: &[Range]) -> bool {
    let name = |range: &Range| range.name.text.clone();
    one.iter().map(name).eq(other.iter().map(name))
}
