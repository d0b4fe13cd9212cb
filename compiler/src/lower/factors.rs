//! Constant factors and signs of products gathered, in the tier `accurate`.
//!
//! Each rule is an equation of real numbers that is taken only where the result is at least as good as that of the form it
//! replaces: it is rounded no more often, and overflows nowhere else. That is more than [`super::plain`] may say of its
//! rules, which the tier `fast` has.

use crate::ir::{Graph, Id, Node, Op, Prim, Ty, transcribe};

/// How deep in a product a constant factor is looked for.
const DEPTH: u8 = 8;
/// The largest power of two that is moved out of a product: by so much nearer is its underflow.
const MOST: f64 = 16.0;

/// The same values in fewer operations, or nothing where there are no fewer.
pub(super) fn gathered(graph: &Graph, roots: &[Id]) -> Option<(Graph, Vec<Id>)> {
    let mut out = Graph::new();
    let new = transcribe(graph, roots, &mut out, |out, node, args| {
        rewritten(out, node, args).unwrap_or_else(|| out.intern(node.op, node.ty, args))
    });
    (price(&out, &new) <= price(graph, roots)).then_some((out, new))
}

/// The number of operations, and then that of negative constants.
fn price(graph: &Graph, roots: &[Id]) -> (usize, usize) {
    let live = graph.reachable(roots);
    let nodes = graph.ids().filter(|id| live[id.index()]);
    nodes.fold((0, 0), |(operations, negative), id| {
        match graph.node(id).op {
            Op::Apply(_) => (operations + 1, negative),
            Op::Const(bits) => (
                operations,
                negative + usize::from(f64::from_bits(bits) < 0.0),
            ),
            _ => (operations, negative),
        }
    })
}

fn rewritten(g: &mut Graph, node: &Node, args: &[Id]) -> Option<Id> {
    let Op::Apply(prim) = node.op else {
        return None;
    };
    if node.ty != Ty::Real || args.iter().any(|&a| g.ty(a) != Ty::Real) {
        return None;
    }
    match (prim, args) {
        (Prim::Neg, &[x]) => negated(g, x, DEPTH),
        (Prim::Mul, &[x, y]) => match (g.as_real(x), g.as_real(y)) {
            (Some(c), None) => multiplied(g, c, y),
            (None, Some(c)) => multiplied(g, c, x),
            _ => None,
        },
        (Prim::Div, &[x, y]) => divided(g, x, y),
        (Prim::Add | Prim::Sub, &[x, y]) => without_minus(g, prim, x, y),
        _ => None,
    }
}

/// (c x)/d = (c/d) x where the quotient is exact.
fn divided(g: &mut Graph, x: Id, y: Id) -> Option<Id> {
    let d = single(g.as_real(y)?);
    let (c, x) = constant_factor(g, x)?;
    let quotient = single(c) / d;
    let is_exact =
        short_product(quotient, d).is_some_and(|back| back.to_bits() == single(c).to_bits());
    (is_exact && single(quotient).to_bits() == quotient.to_bits()).then(|| times(g, quotient, x))
}

/// a + (-c) x = a - c x, (-c) x + a = a - c x and a - (-c) x = a + c x with a constant c > 0, and the same of a constant alone.
fn without_minus(g: &mut Graph, prim: Prim, x: Id, y: Id) -> Option<Id> {
    let other = match prim {
        Prim::Add => Prim::Sub,
        _ => Prim::Add,
    };
    if let Some(y) = positive(g, y, DEPTH) {
        return Some(g.apply(other, &[x, y]));
    }
    if prim == Prim::Sub {
        return None;
    }
    let x = positive(g, x, DEPTH)?;
    Some(g.sub(y, x))
}

/// -x of a negative constant, and of a product with one.
fn positive(g: &mut Graph, x: Id, depth: u8) -> Option<Id> {
    if depth == 0 {
        return None;
    }
    if let Some(c) = g.as_real(x) {
        return (c < 0.0).then(|| g.real(-c));
    }
    let node = g.node(x);
    let (Op::Apply(prim @ (Prim::Mul | Prim::Div)), &[a, b]) = (node.op, node.args.as_slice())
    else {
        return None;
    };
    if let Some(a) = positive(g, a, depth - 1) {
        return Some(g.apply(prim, &[a, b]));
    }
    let b = positive(g, b, depth - 1)?;
    Some(g.apply(prim, &[a, b]))
}

/// A constant as it is in single precision.
fn single(c: f64) -> f64 {
    #[allow(clippy::cast_possible_truncation, reason = "this is what it is for")]
    let single = c as f32;
    f64::from(single)
}

/// The product of two constants of single precision, where it is one, too.
fn short_product(c: f64, d: f64) -> Option<f64> {
    let product = single(c) * single(d);
    #[allow(clippy::cast_possible_truncation, reason = "this is asked here")]
    let is_short = (product as f32).is_normal() && single(product).to_bits() == product.to_bits();
    is_short.then_some(product)
}

/// Whether a number is ±2ⁿ.
fn is_power_of_two(c: f64) -> bool {
    c.is_normal() && c.to_bits() & ((1 << 52) - 1) == 0
}

/// A value as a constant factor and the rest: (d, x) of d x, and of x/2ⁿ, which is rounded like x 2⁻ⁿ.
fn constant_factor(g: &Graph, id: Id) -> Option<(f64, Id)> {
    let node = g.node(id);
    match (node.op, node.args.as_slice()) {
        (Op::Apply(Prim::Mul), &[x, y]) => match (g.as_real(x), g.as_real(y)) {
            (Some(d), None) => Some((d, y)),
            (None, Some(d)) => Some((d, x)),
            _ => None,
        },
        (Op::Apply(Prim::Div), &[x, y]) => {
            let inverse = 1.0 / g.as_real(y)?;
            is_power_of_two(inverse).then_some((inverse, x))
        }
        _ => None,
    }
}

/// c x
fn times(g: &mut Graph, c: f64, x: Id) -> Id {
    let c = g.real(c);
    g.mul(c, x)
}

fn multiplied(g: &mut Graph, c: f64, x: Id) -> Option<Id> {
    // c (d x) = (c d) x: rounded once where it was rounded twice
    if let Some((d, x)) = constant_factor(g, x) {
        return short_product(c, d).map(|product| times(g, product, x));
    }
    let &Node {
        op: Op::Apply(prim),
        ref args,
        ..
    } = g.node(x)
    else {
        return None;
    };
    match (prim, args.as_slice()) {
        (Prim::Mul, &[a, b]) => moved_out(g, c, a, b).or_else(|| moved_out(g, c, b, a)),
        (Prim::Add | Prim::Sub, &[a, b]) => of_sum(g, c, prim, a, b),
        _ => None,
    }
}

/// c ((2ⁿ a) b) = (2ⁿ c) (a b): the power of two rounds nothing, and the smaller product overflows no sooner.
fn moved_out(g: &mut Graph, c: f64, a: Id, b: Id) -> Option<Id> {
    let (d, a) = constant_factor(g, a)?;
    if !is_power_of_two(d) || !(1.0..=MOST).contains(&d.abs()) {
        return None;
    }
    let product = short_product(c, d)?;
    let inner = g.mul(a, b);
    Some(times(g, product, inner))
}

/// c (2ⁿ a ± 2ⁿ b) = (2ⁿ c) (a ± b) with a power of two c, where the sum overflows no sooner than the result.
fn of_sum(g: &mut Graph, c: f64, prim: Prim, a: Id, b: Id) -> Option<Id> {
    let ((d, a), (e, b)) = (constant_factor(g, a)?, constant_factor(g, b)?);
    let are_same = d.to_bits() == e.to_bits() && is_power_of_two(d) && is_power_of_two(c);
    let product = c * d;
    if !are_same || product.abs() < 1.0 {
        return None;
    }
    let sum = g.apply(prim, &[a, b]);
    Some(times(g, product, sum))
}

/// -(c x) = (-c) x, with the factor anywhere in the product
fn negated(g: &mut Graph, x: Id, depth: u8) -> Option<Id> {
    if depth == 0 {
        return None;
    }
    if let Some((d, x)) = constant_factor(g, x) {
        return Some(times(g, -d, x));
    }
    let node = g.node(x);
    let (Op::Apply(Prim::Mul), &[a, b]) = (node.op, node.args.as_slice()) else {
        return None;
    };
    if let Some(a) = negated(g, a, depth - 1) {
        return Some(g.mul(a, b));
    }
    let b = negated(g, b, depth - 1)?;
    Some(g.mul(a, b))
}
