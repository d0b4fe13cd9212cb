//! Arithmetic as a person writes it, for the tier `fast`: constant factors gathered, lengths from sums of squares.
//!
//! Each rule is an equation of real numbers, and none of them holds bit for bit: where the results round, overflow or
//! underflow may differ. Other tiers have bounds to keep, and do without.

use smallvec::SmallVec;

use crate::ir::{Graph, Id, Node, Op, Prim, Ty, transcribe};

/// How deep in a product a constant factor is looked for.
const DEPTH: u8 = 8;
/// Below it a length counts as 0, where there is no direction.
const NO_LENGTH: f64 = 1.2e-38;
/// What a length without overflow counts, in operations.
const CAREFUL: usize = 20;

/// The same values in fewer operations, or nothing where there are no fewer.
pub(super) fn plain(graph: &Graph, roots: &[Id]) -> Option<(Graph, Vec<Id>)> {
    let mut out = Graph::new();
    let live = graph.reachable(roots);
    let mut nodes = graph.ids().filter(|id| live[id.index()]);
    let has_rests = nodes.any(|id| matches!(graph.node(id).op, Op::Apply(prim) if is_rest(prim)));
    let new = transcribe(graph, roots, &mut out, |out, node, args| {
        let of_rest = has_rests.then(|| without_rest(out, node, args)).flatten();
        of_rest
            .or_else(|| rewritten(out, node, args))
            .or_else(|| of_constants(out, node, args))
            .unwrap_or_else(|| out.intern(node.op, node.ty, args))
    });
    (operations(&out, &new) < operations(graph, roots)).then_some((out, new))
}

fn operations(graph: &Graph, roots: &[Id]) -> usize {
    let live = graph.reachable(roots);
    let of = |id: Id| match graph.node(id).op {
        Op::Apply(Prim::Hypot | Prim::Hypot3 | Prim::Direction | Prim::Direction3) => CAREFUL,
        Op::Apply(_) => 1,
        _ => 0,
    };
    graph.ids().filter(|id| live[id.index()]).map(of).sum()
}

/// What is left of operands that have become constants.
fn of_constants(g: &mut Graph, node: &Node, args: &[Id]) -> Option<Id> {
    let Op::Apply(prim) = node.op else {
        return None;
    };
    let is_constant = |&id: &Id| matches!(g.node(id).op, Op::Const(_) | Op::Truth(_));
    (node.ty != Ty::Complex && args.iter().all(is_constant)).then(|| g.apply(prim, args))
}

fn rewritten(g: &mut Graph, node: &Node, args: &[Id]) -> Option<Id> {
    let Op::Apply(prim) = node.op else {
        return None;
    };
    if let (Prim::Select, &[condition, yes, no]) = (prim, args)
        && let Op::Truth(is_so) = g.node(condition).op
    {
        return Some(if is_so { yes } else { no });
    }
    if node.ty != Ty::Real || args.iter().any(|&a| g.ty(a) == Ty::Complex) {
        return None;
    }
    match (prim, args) {
        (Prim::Neg, &[x]) => absorbed(g, x, -1.0, DEPTH),
        (Prim::Mul, &[x, y]) => product(g, x, y),
        // x/2 = x·0.5
        (Prim::Div, &[x, y]) => {
            let inverse = 1.0 / g.as_real(y)?;
            is_short(inverse).then(|| scaled(g, inverse, x))
        }
        (Prim::Add | Prim::Sub, &[x, y]) => {
            without_zero(g, prim, x, y).or_else(|| common_factor(g, prim, x, y))
        }
        (Prim::MulAdd, &[x, y, z]) => shorter_sum(g, x, y, z),
        (Prim::Hypot | Prim::Hypot3, parts) => {
            let squares: SmallVec<[Id; 3]> = parts.iter().map(|&x| g.mul(x, x)).collect();
            let sum = squares
                .into_iter()
                .reduce(|sum, square| g.add(sum, square))?;
            Some(g.apply(Prim::Sqrt, &[sum]))
        }
        // x/r, and 0 where r is
        (Prim::Direction | Prim::Direction3, &[x, .., r]) => {
            let least = g.real(NO_LENGTH);
            let r = g.apply(Prim::Max, &[r, least]);
            Some(g.div(x, r))
        }
        (Prim::Select, &[_, between, there]) => {
            middle(g, between, there).or_else(|| difference_of_squares(g, between, there))
        }
        _ => None,
    }
}

/// What rounding took from an operation.
fn is_rest(prim: Prim) -> bool {
    matches!(
        prim,
        Prim::SumRest | Prim::MulAddRest | Prim::ProductRest | Prim::SineRest | Prim::CosineRest
    )
}

/// Rests of roundings are for those who keep bounds: here they are 0, and so are their multiples. A 0 that stands in what has been
/// integrated is counted as one of them.
fn without_rest(g: &mut Graph, node: &Node, args: &[Id]) -> Option<Id> {
    let Op::Apply(prim) = node.op else {
        return None;
    };
    let is_zero = |&x: &Id| g.as_real(x) == Some(0.0);
    let is_nothing = match (prim, args) {
        (Prim::Mul, args) => args.iter().any(is_zero),
        (Prim::Div, [x, _]) => is_zero(x),
        _ => is_rest(prim),
    };
    (is_nothing && node.ty == Ty::Real).then(|| g.real(0.0))
}

/// Whether a constant is as short in single precision as its factors were.
fn is_short(value: f64) -> bool {
    #[allow(clippy::cast_possible_truncation, reason = "this is asked here")]
    let single = value as f32;
    value.is_normal() && f64::from(single).to_bits() == value.to_bits()
}

/// c x, with c in a constant factor of x where there is one.
fn scaled(g: &mut Graph, c: f64, x: Id) -> Id {
    absorbed(g, x, c, DEPTH).unwrap_or_else(|| times(g, c, x))
}

/// c x, without looking into x.
fn times(g: &mut Graph, c: f64, x: Id) -> Id {
    if c.to_bits() == 1.0_f64.to_bits() {
        return x;
    }
    let c = g.real(c);
    g.mul(c, x)
}

/// The operands of a real operation.
fn operands(g: &Graph, id: Id, prim: Prim) -> Option<[Id; 2]> {
    let node = g.node(id);
    match (
        node.op == Op::Apply(prim) && node.ty == Ty::Real,
        &*node.args,
    ) {
        (true, &[x, y]) => Some([x, y]),
        _ => None,
    }
}

/// A product as a constant factor and the rest: (c, y) of c y.
fn constant_factor(g: &Graph, id: Id) -> Option<(f64, Id)> {
    let [x, y] = operands(g, id, Prim::Mul)?;
    match (g.as_real(x), g.as_real(y)) {
        (Some(c), None) => Some((c, y)),
        (None, Some(c)) => Some((c, x)),
        _ => None,
    }
}

/// c x by a change of a constant factor that x has already: c (d y) = (c d) y.
fn absorbed(g: &mut Graph, x: Id, c: f64, depth: u8) -> Option<Id> {
    if depth == 0 || g.ty(x) != Ty::Real {
        return None;
    }
    if let Some((d, y)) = constant_factor(g, x) {
        return is_short(c * d).then(|| times(g, c * d, y));
    }
    if let &Node {
        op: Op::Apply(Prim::Neg),
        ref args,
        ..
    } = g.node(x)
    {
        let inner = args[0];
        return Some(scaled(g, -c, inner));
    }
    for prim in [Prim::Mul, Prim::Div] {
        let Some([a, b]) = operands(g, x, prim) else {
            continue;
        };
        if let (Prim::Div, Some(d)) = (prim, g.as_real(a)) {
            // a reciprocal is shared as it is, and a second division would cost more than a product
            if d.abs().to_bits() == 1.0_f64.to_bits() || !is_short(c * d) {
                return None;
            }
            let top = g.real(c * d);
            return Some(g.div(top, b));
        }
        if let Some(a) = absorbed(g, a, c, depth - 1) {
            return Some(g.apply(prim, &[a, b]));
        }
        if prim == Prim::Mul {
            let b = absorbed(g, b, c, depth - 1)?;
            return Some(g.mul(a, b));
        }
    }
    None
}

fn product(g: &mut Graph, x: Id, y: Id) -> Option<Id> {
    for (x, y) in [(x, y), (y, x)] {
        if g.as_real(x) == Some(0.0) && is_finite(g, y) {
            return Some(g.real(0.0));
        }
    }
    for (x, y) in [(x, y), (y, x)] {
        if let Some(c) = g.as_real(x) {
            return absorbed(g, y, c, DEPTH);
        }
    }
    // (x/2)·(2 y) = x y
    let ((c, x), (d, y)) = (constant_factor(g, x)?, constant_factor(g, y)?);
    ((c * d).to_bits() == 1.0_f64.to_bits()).then(|| g.mul(x, y))
}

/// Whether a value is a number that is given, and so no infinity or NaN.
fn is_finite(g: &Graph, x: Id) -> bool {
    !matches!(g.node(x).op, Op::Apply(_))
}

/// x y + z where one of them is 0, and x y - x y, which is what rounding took from a product.
fn shorter_sum(g: &mut Graph, x: Id, y: Id, z: Id) -> Option<Id> {
    if g.as_real(z) == Some(0.0) {
        return product(g, x, y).or_else(|| Some(g.mul(x, y)));
    }
    if is_negative_product(g, z, x, y) {
        return Some(g.real(0.0));
    }
    let is_zero = |g: &Graph, x: Id| g.as_real(x) == Some(0.0);
    (is_zero(g, x) || is_zero(g, y)).then_some(z)
}

/// Whether z is -x y, as it stands or with a constant factor.
fn is_negative_product(g: &Graph, z: Id, x: Id, y: Id) -> bool {
    let is_both = |a: Id, b: Id| (a, b) == (x, y) || (a, b) == (y, x);
    if let Some((c, w)) = constant_factor(g, z) {
        return [(x, y), (y, x)]
            .into_iter()
            .any(|(x, y)| y == w && g.as_real(x) == Some(-c));
    }
    let node = g.node(z);
    node.op == Op::Apply(Prim::Neg)
        && operands(g, node.args[0], Prim::Mul).is_some_and(|[a, b]| is_both(a, b))
}

/// x + 0, 0 + x and x - 0.
fn without_zero(g: &Graph, prim: Prim, x: Id, y: Id) -> Option<Id> {
    if g.as_real(y) == Some(0.0) {
        return Some(x);
    }
    (prim == Prim::Add && g.as_real(x) == Some(0.0)).then_some(y)
}

/// c x + c y = c (x + y)
fn common_factor(g: &mut Graph, prim: Prim, x: Id, y: Id) -> Option<Id> {
    let ((c, x), (d, y)) = (constant_factor(g, x)?, constant_factor(g, y)?);
    if c.to_bits() != d.to_bits() {
        return None;
    }
    let inner = g.apply(prim, &[x, y]);
    Some(scaled(g, c, inner))
}

/// Two forms of a difference of squares, of which one is better beside its zeros: t² + 2c t = x² - c² with t = |x| - c. The second
/// is the one that a person writes.
fn difference_of_squares(g: &Graph, near: Id, far: Id) -> Option<Id> {
    let [square, constant] = operands(g, far, Prim::Sub)?;
    let [x, same] = operands(g, square, Prim::Mul)?;
    let [first, second] = operands(g, near, Prim::Add)?;
    let [t, other] = operands(g, first, Prim::Mul)?;
    let (double, last) = constant_factor(g, second)?;
    let [size, c] = operands(g, t, Prim::Sub)?;
    let size = g.node(size);
    let c = g.as_real(c)?;
    let fits = x == same
        && [other, last] == [t, t]
        && size.op == Op::Apply(Prim::Abs)
        && size.args[0] == x
        && double.to_bits() == (2.0 * c).to_bits()
        && g.as_real(constant)?.to_bits() == (c * c).to_bits();
    fits.then_some(far)
}

/// Two forms of the middle of a line's stretch, of which one is chosen by what it rounds to:
/// (o + a s)/2 + (o + b s)/2 = o + (a + b)/2 s. The second takes fewer operations.
fn middle(g: &Graph, between: Id, there: Id) -> Option<Id> {
    let fused = |id: Id| {
        let node = g.node(id);
        (node.op == Op::Apply(Prim::MulAdd)).then(|| [node.args[0], node.args[1], node.args[2]])
    };
    let [half, high, low] = fused(between)?;
    let (other_half, low) = constant_factor(g, low)?;
    let [[mean, s, o], [b, s1, o1], [a, s0, o0]] = [fused(there)?, fused(high)?, fused(low)?];
    let (c, sum) = constant_factor(g, mean)?;
    let of_ends = operands(g, sum, Prim::Add)?;
    let is_half = |c: f64| c.to_bits() == 0.5_f64.to_bits();
    let are_halves = is_half(g.as_real(half)?) && is_half(other_half) && is_half(c);
    let is_same = [s0, s1] == [s, s] && [o0, o1] == [o, o] && of_ends == [a, b];
    (are_halves && is_same).then_some(there)
}
