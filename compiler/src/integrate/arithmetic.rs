//! Arithmetic of integrals: terms that are zero by construction are left out.
//!
//! What stands here is arithmetic of the formulas of the rules, not of what the user has written: a slope or a
//! coefficient that is the constant 0 drops its term even where the other factor may be NaN.

use crate::ir::{Graph, Id, Prim};

/// `a + b`
pub fn add(g: &mut Graph, a: Id, b: Id) -> Id {
    match (is_zero(g, a), is_zero(g, b)) {
        (true, _) => b,
        (_, true) => a,
        _ => g.add(a, b),
    }
}

/// `a - b`
pub fn sub(g: &mut Graph, a: Id, b: Id) -> Id {
    match (is_zero(g, a), is_zero(g, b)) {
        (_, true) => a,
        (true, _) => g.neg(b),
        _ => g.sub(a, b),
    }
}

/// `a · b`
pub fn mul(g: &mut Graph, a: Id, b: Id) -> Id {
    if is_zero(g, a) || is_zero(g, b) {
        return g.real(0.0);
    }
    if let Some(v) = g.as_real(a)
        && let Some(product) = folded(g, v, b)
    {
        return product;
    }
    if let Some(v) = g.as_real(b)
        && let Some(product) = folded(g, v, a)
    {
        return product;
    }
    g.mul(a, b)
}

/// `a b + c`, rounded once where the adapter's `fma` is.
pub fn mul_add(g: &mut Graph, a: Id, b: Id, c: Id) -> Id {
    let is_one = |g: &Graph, id: Id| g.as_real(id) == Some(1.0);
    let is_known = |g: &Graph, id: Id| g.as_real(id).is_some();
    let is_short = is_zero(g, a)
        || is_zero(g, b)
        || is_zero(g, c)
        || is_one(g, a)
        || is_one(g, b)
        || is_known(g, a) && is_known(g, b);
    if is_short {
        let product = mul(g, a, b);
        return add(g, c, product);
    }
    g.apply(Prim::MulAdd, &[a, b, c])
}

/// v · (w x), or v · ((w x) y), with the constants v and w multiplied before.
fn folded(g: &mut Graph, v: f64, b: Id) -> Option<Id> {
    let product = |g: &Graph, id: Id| {
        let node = g.node(id);
        (node.op == crate::ir::Op::Apply(Prim::Mul)).then(|| (node.args[0], node.args[1]))
    };
    let by_constant = |g: &Graph, id: Id| {
        let (x, y) = product(g, id)?;
        match (g.as_real(x), g.as_real(y)) {
            (Some(w), None) => Some((w, y)),
            (None, Some(w)) => Some((w, x)),
            _ => None,
        }
    };
    if let Some((w, rest)) = by_constant(g, b) {
        let constant = g.real(v * w);
        return Some(g.mul(constant, rest));
    }
    let (x, y) = product(g, b)?;
    let (w, rest) = by_constant(g, x)?;
    let constant = g.real(v * w);
    let left = g.mul(constant, rest);
    Some(g.mul(left, y))
}

/// `v · a`
pub fn scale(g: &mut Graph, v: f64, a: Id) -> Id {
    let v = g.real(v);
    mul(g, v, a)
}

/// `a / b`
pub fn div(g: &mut Graph, a: Id, b: Id) -> Id {
    if is_zero(g, a) { a } else { g.div(a, b) }
}

/// A function of one number.
pub fn call(g: &mut Graph, prim: Prim, a: Id) -> Id {
    g.apply(prim, &[a])
}

/// `a²`
pub fn square(g: &mut Graph, a: Id) -> Id {
    g.apply(Prim::PowInt(2), &[a])
}

/// `if a < b then then else otherwise`
pub fn if_less(g: &mut Graph, a: Id, b: Id, then: Id, otherwise: Id) -> Id {
    let condition = g.apply(Prim::Less, &[a, b]);
    g.apply(Prim::Select, &[condition, then, otherwise])
}

/// Σ of all, 0 of none.
pub fn total(g: &mut Graph, terms: impl IntoIterator<Item = Id>) -> Id {
    let mut sum = g.real(0.0);
    for term in terms {
        sum = add(g, sum, term);
    }
    sum
}

/// Whether a node is the constant 0.
pub fn is_zero(g: &Graph, id: Id) -> bool {
    g.as_real(id) == Some(0.0)
}
