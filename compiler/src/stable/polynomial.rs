//! Sums as polynomials of the parts that are no sums or products, with exact coefficients.
//!
//! What cancels here cancels exactly: coefficients are added and multiplied only where the `f64` result is exact.

use std::cell::Cell;

use smallvec::SmallVec;

use crate::ir::{Graph, Id, Op, Prim};

/// A product of powers of atoms, ordered by atom; no factors are the monomial 1.
pub type Monomial = SmallVec<[(Id, i32); 4]>;

/// Most terms that a polynomial is followed to.
const MAX_TERMS: usize = 12;
/// Greatest degree of a monomial.
const MAX_DEGREE: i32 = 8;
/// Deepest nesting of sums and products that is looked through.
const MAX_DEPTH: usize = 24;
/// Most nodes that are looked at for one polynomial.
const MAX_NODES: usize = 64;

/// Σ coefficient · monomial, no monomial twice, no coefficient 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polynomial {
    /// The terms, in the order in which they were met.
    pub terms: SmallVec<[(Monomial, f64); 8]>,
    /// How many pairs of terms have cancelled each other, wholly or in part.
    pub cancelled: usize,
    /// How many terms have cancelled wholly.
    pub vanished: usize,
    /// What has cancelled wholly.
    pub lost: SmallVec<[Monomial; 2]>,
}

/// How far products are multiplied out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Expand {
    /// A constant times a sum; any other product with a sum is an atom.
    Constants,
    /// Every product.
    All,
    /// Every product, but a multiple by a constant without an exact square is an atom.
    Multiples,
}

impl Polynomial {
    /// The polynomial 1.
    pub fn one() -> Self {
        let mut out = Self::default();
        out.terms.push((Monomial::new(), 1.0));
        out
    }

    /// An atom by itself.
    pub fn atom(id: Id) -> Self {
        let mut out = Self::default();
        let mut monomial = Monomial::new();
        monomial.push((id, 1));
        out.terms.push((monomial, 1.0));
        out
    }

    /// The one term, where there is just one.
    pub fn single(&self) -> Option<&(Monomial, f64)> {
        match self.terms.as_slice() {
            [term] => Some(term),
            _ => None,
        }
    }

    /// The value of a constant polynomial.
    pub fn constant(&self) -> Option<f64> {
        match self.terms.as_slice() {
            [] => Some(0.0),
            [(monomial, value)] if monomial.is_empty() => Some(*value),
            _ => None,
        }
    }

    /// Adds `factor` times another one; `None` where a coefficient is not exact or it gets too long.
    pub fn add(mut self, other: &Self, factor: f64) -> Option<Self> {
        self.cancelled += other.cancelled;
        self.vanished += other.vanished;
        for lost in &other.lost {
            self.lost.push(lost.clone());
        }
        for (monomial, value) in &other.terms {
            self.push(monomial, exact_product(*value, factor)?)?;
        }
        Some(self)
    }

    fn push(&mut self, monomial: &Monomial, value: f64) -> Option<()> {
        let Some(k) = self.terms.iter().position(|(m, _)| m == monomial) else {
            if self.terms.len() >= MAX_TERMS {
                return None;
            }
            self.terms.push((monomial.clone(), value));
            return Some(());
        };
        let old = self.terms[k].1;
        if (old < 0.0) != (value < 0.0) {
            self.cancelled += 1;
        }
        let sum = exact_sum(old, value)?;
        if sum == 0.0 {
            self.terms.remove(k);
            self.vanished += 1;
            if !monomial.is_empty() {
                self.lost.push(monomial.clone());
            }
        } else {
            self.terms[k].1 = sum;
        }
        Some(())
    }

    /// The product; `None` where a coefficient is not exact, or it gets too long.
    pub fn mul(&self, other: &Self) -> Option<Self> {
        let mut out = Self {
            cancelled: self.cancelled + other.cancelled,
            vanished: self.vanished + other.vanished,
            ..Self::default()
        };
        for lost in self.lost.iter().chain(&other.lost) {
            out.lost.push(lost.clone());
        }
        for (a, x) in &self.terms {
            for (b, y) in &other.terms {
                out.push(&monomial_product(a, b)?, exact_product(*x, *y)?)?;
            }
        }
        Some(out)
    }
}

/// The product of two monomials, unless its degree is too great.
pub fn monomial_product(a: &Monomial, b: &Monomial) -> Option<Monomial> {
    let mut out = a.clone();
    for &(atom, power) in b {
        match out.iter_mut().find(|(other, _)| *other == atom) {
            Some(slot) => slot.1 += power,
            None => out.push((atom, power)),
        }
    }
    out.retain(|(_, power)| *power != 0);
    out.sort_unstable();
    (degree(&out) <= MAX_DEGREE).then_some(out)
}

/// Sum of the exponents' magnitudes.
pub fn degree(monomial: &Monomial) -> i32 {
    monomial.iter().map(|(_, power)| power.abs()).sum()
}

fn exact_sum(a: f64, b: f64) -> Option<f64> {
    let sum = a + b;
    let t = sum - a;
    let error = (a - (sum - t)) + (b - t);
    (error == 0.0 && sum.is_finite()).then_some(sum)
}

pub fn exact_product(a: f64, b: f64) -> Option<f64> {
    let product = a * b;
    let exact = product.is_finite() && (product == 0.0) == (a == 0.0 || b == 0.0);
    (exact && a.mul_add(b, -product) == 0.0).then_some(product)
}

/// Reads a node as a polynomial. `plain` gives the written form of a node that has been rewritten. `None` where it
/// is too long, too deep, or a coefficient cannot be exact.
pub fn polynomial(
    g: &Graph,
    plain: &dyn Fn(Id) -> Id,
    id: Id,
    expand: Expand,
) -> Option<Polynomial> {
    let left = Cell::new(MAX_NODES);
    let reader = Reader {
        g,
        plain,
        expand,
        left: &left,
    };
    read(&reader, id, MAX_DEPTH)
}

struct Reader<'a> {
    g: &'a Graph,
    plain: &'a dyn Fn(Id) -> Id,
    expand: Expand,
    left: &'a Cell<usize>,
}

/// No deeper than [`MAX_DEPTH`].
fn read(reader: &Reader, id: Id, depth: usize) -> Option<Polynomial> {
    let &Reader {
        g,
        plain,
        expand,
        left,
    } = reader;
    let depth = depth.checked_sub(1)?;
    left.set(left.get().checked_sub(1)?);
    let node = g.node(plain(id));
    let go = |id| read(reader, id, depth);
    if let Some(value) = constant(g, plain(id)) {
        let mut out = Polynomial::default();
        if value != 0.0 {
            out.terms.push((Monomial::new(), value));
        }
        return value.is_finite().then_some(out);
    }
    let atom = || Some(Polynomial::atom(id));
    match (node.op, node.args.as_slice()) {
        (Op::Apply(Prim::Neg), &[a]) => Polynomial::default().add(&go(a)?, -1.0),
        (Op::Apply(Prim::Add), &[a, b]) => go(a)?.add(&go(b)?, 1.0),
        (Op::Apply(Prim::Sub), &[a, b]) => go(a)?.add(&go(b)?, -1.0),
        (Op::Apply(Prim::Mul), &[a, b])
            if expand == Expand::Multiples
                && [a, b].iter().any(|&factor| has_no_square(g, plain(factor))) =>
        {
            atom()
        }
        (Op::Apply(Prim::Mul), &[a, b]) => {
            let (Some(p), Some(q)) = (go(a), go(b)) else {
                return atom();
            };
            product(&p, &q, expand)
                .or_else(|| as_factor(p, a).mul(&as_factor(q, b)))
                .map_or_else(atom, Some)
        }
        (Op::Apply(Prim::Div), &[a, b]) => {
            let inverse = constant(g, b)
                .filter(|b| is_power_of_two(*b))
                .map(f64::recip);
            match (inverse, go(a)) {
                (Some(inverse), Some(p)) => Polynomial::default().add(&p, inverse),
                _ => atom(),
            }
        }
        (Op::Apply(Prim::PowInt(n @ 2..=8)), &[a]) => {
            let Some(p) = go(a) else { return atom() };
            let power = |p: &Polynomial| {
                (0..n).try_fold(Polynomial::one(), |out, _| product(&out, p, expand))
            };
            power(&p)
                .or_else(|| power(&as_factor(p, a)))
                .map_or_else(atom, Some)
        }
        _ => atom(),
    }
}

/// Whether a node is a constant whose square is not exact.
fn has_no_square(g: &Graph, id: Id) -> bool {
    constant(g, id).is_some_and(|c| exact_product(c, c).is_none())
}

/// A sum as one factor.
fn as_factor(p: Polynomial, id: Id) -> Polynomial {
    if p.terms.len() <= 1 {
        p
    } else {
        Polynomial::atom(id)
    }
}

fn product(p: &Polynomial, q: &Polynomial, expand: Expand) -> Option<Polynomial> {
    let fits = match expand {
        Expand::All | Expand::Multiples => true,
        Expand::Constants => {
            let short = |p: &Polynomial| p.terms.len() <= 1;
            (short(p) && short(q)) || p.constant().is_some() || q.constant().is_some()
        }
    };
    if fits { p.mul(q) } else { None }
}

fn is_power_of_two(x: f64) -> bool {
    x.is_normal() && x.to_bits() & ((1 << 52) - 1) == 0 && x.recip().is_normal()
}

/// The value of a real constant, also where it has been widened.
pub fn constant(g: &Graph, id: Id) -> Option<f64> {
    match g.as_complex(id) {
        Some((re, im)) if im.to_bits() == 0 => Some(re),
        Some(_) => None,
        None => g.as_real(id),
    }
}

/// A constant times a product of powers, as nodes.
pub fn build_monomial(g: &mut Graph, monomial: &Monomial) -> Option<Id> {
    let mut out: Option<Id> = None;
    for &(atom, power) in monomial {
        let factor = g.apply(Prim::PowInt(power), &[atom]);
        out = Some(match out {
            Some(so_far) => g.mul(so_far, factor),
            None => factor,
        });
    }
    out
}

/// A coefficient times a monomial, as nodes.
pub fn build_term(g: &mut Graph, monomial: &Monomial, coefficient: f64) -> Id {
    let value = g.real(coefficient);
    match build_monomial(g, monomial) {
        Some(product) => g.mul(value, product),
        None => value,
    }
}

/// The polynomial as nodes: a term that is added comes first, where there is one.
pub fn build(g: &mut Graph, terms: &[(Monomial, f64)]) -> Id {
    let first = terms
        .iter()
        .position(|(m, value)| *value > 0.0 && !m.is_empty());
    let first = first.or_else(|| terms.iter().position(|(_, value)| *value > 0.0));
    let first = first.unwrap_or(0);
    let Some((monomial, value)) = terms.get(first) else {
        return g.real(0.0);
    };
    let mut out = build_term(g, monomial, *value);
    for (k, (monomial, value)) in terms.iter().enumerate() {
        if k == first {
            continue;
        }
        let term = build_term(g, monomial, value.abs());
        out = if *value < 0.0 {
            g.sub(out, term)
        } else {
            g.add(out, term)
        };
    }
    out
}
