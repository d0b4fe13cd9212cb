//! Sums: terms that cancel, and pairs of terms whose difference has a better form.

use smallvec::SmallVec;

use super::Phase;
use super::guard::{choose, is_real, less, scaled};
use super::pass::{Pass, only_atom};
use super::polynomial::{
    Expand, Monomial, Polynomial, build, build_monomial, build_term, constant, exact_product,
    monomial_product,
};
use super::rule::Rule;
use crate::ir::{Graph, Id, Op, Prim};

/// Most terms of a sum whose pairs are looked at.
const MAX_PAIRED: usize = 8;
/// Deepest nesting of differences of arguments.
const MAX_DEPTH: usize = 8;

type Term = (Monomial, f64);

impl Pass {
    /// A better form of a sum, where there is one.
    pub(super) fn sum_node(&mut self, g: &mut Graph, id: Id) -> Option<Id> {
        let p = self.polynomial(g, id, Expand::Constants)?;
        if p.terms.len() < 2 && p.cancelled == 0 {
            return None;
        }
        self.inputs_too = false;
        if p.vanished == 0
            && let Some(term) = self.one_term(g, id)
        {
            return Some(term);
        }
        let strict = self.improved(g, p.clone(), MAX_DEPTH);
        if strict.is_some() || self.phase == Phase::Early {
            return strict;
        }
        self.inputs_too = true;
        let found = self.improved(g, p, MAX_DEPTH);
        self.inputs_too = false;
        found
    }

    /// The one term that is left of a sum where its products are multiplied out, and others vanish.
    fn one_term(&mut self, g: &mut Graph, id: Id) -> Option<Id> {
        if !self.on(Rule::Cancel) {
            return None;
        }
        let forms = [Expand::All, Expand::Multiples];
        let left = |p: &Polynomial| p.vanished > 0 && p.single().is_some_and(|t| !t.0.is_empty());
        let found = forms
            .into_iter()
            .filter_map(|expand| self.polynomial(g, id, expand))
            .find(left)?;
        self.lose(&found);
        let term = build(g, &found.terms);
        self.by(Rule::Cancel, term)
    }

    /// u - v, where it is simpler than that.
    pub(super) fn difference(&mut self, g: &mut Graph, u: Id, v: Id, depth: usize) -> Option<Id> {
        let depth = depth.checked_sub(1)?;
        let question = (u, v, self.inputs_too);
        if self.hopeless.get(&question).is_some_and(|&to| depth <= to) {
            return None;
        }
        let (p, q) = (
            self.polynomial(g, u, Expand::Constants)?,
            self.polynomial(g, v, Expand::Constants)?,
        );
        let found = self.improved(g, p.add(&q, -1.0)?, depth);
        // without patience left it is not known
        if found.is_none() && self.patience > 0 {
            self.hopeless.insert(question, depth);
        }
        found
    }

    /// factor · (u + v), simplified where that is possible.
    pub(super) fn total(&mut self, g: &mut Graph, factor: f64, u: Id, v: Id) -> Option<Id> {
        let (p, q) = (
            self.polynomial(g, u, Expand::Constants)?,
            self.polynomial(g, v, Expand::Constants)?,
        );
        let p = Polynomial::default().add(&p.add(&q, 1.0)?, factor)?;
        self.lose(&p);
        Some(build(g, &p.terms))
    }

    /// The polynomial as nodes, in a better form where there is one.
    pub(super) fn built(&mut self, g: &mut Graph, p: Polynomial, depth: usize) -> Id {
        let terms = p.terms.clone();
        match self.improved(g, p, depth) {
            Some(id) => id,
            None => build(g, &terms),
        }
    }

    /// A better form of a sum of terms, where there is one: something cancels, or a pair of terms has one.
    pub(super) fn improved(&mut self, g: &mut Graph, p: Polynomial, depth: usize) -> Option<Id> {
        let (used, lost) = self.marks();
        let found = self.improve(g, p, depth);
        if found.is_none() {
            self.reset(used, lost);
        }
        found
    }

    fn improve(&mut self, g: &mut Graph, mut p: Polynomial, depth: usize) -> Option<Id> {
        let mut changed = false;
        if p.cancelled > 0 && p.vanished == 0 {
            // 3a - 2a: written so, and as good
            return None;
        }
        if p.vanished > 0 {
            if !self.on(Rule::Cancel) {
                return None;
            }
            self.lose(&p);
            self.by(Rule::Cancel, ())?;
            changed = true;
        }
        while p.terms.len() > 1 && p.terms.len() <= MAX_PAIRED && depth > 0 {
            if let Some(rest) = self.remainder(g, &p) {
                p = rest;
                changed = true;
                continue;
            }
            let Some((rest, node)) = self.any_pair(g, &p.terms, depth) else {
                break;
            };
            let mut next = Polynomial::default();
            next.terms.extend(rest);
            p = next.add(&self.polynomial(g, node, Expand::Constants)?, 1.0)?;
            self.lose(&p);
            changed = true;
        }
        changed.then(|| build(g, &p.terms))
    }

    /// The first pair of terms that has a better form: the other terms, and that form.
    fn any_pair(
        &mut self,
        g: &mut Graph,
        terms: &[Term],
        depth: usize,
    ) -> Option<(SmallVec<[Term; 8]>, Id)> {
        for i in 0..terms.len() {
            for j in i + 1..terms.len() {
                self.patience = self.patience.checked_sub(1)?;
                let (used, lost) = self.marks();
                let alone = std::mem::replace(&mut self.alone, terms.len() == 2);
                let found = self.pair(g, &terms[i], &terms[j], depth);
                self.alone = alone;
                let Some(node) = found else {
                    self.reset(used, lost);
                    continue;
                };
                let others = terms.iter().enumerate();
                let others = others.filter(|(k, _)| *k != i && *k != j);
                return Some((others.map(|(_, t)| t.clone()).collect(), node));
            }
        }
        None
    }

    /// A better form of the sum of two terms.
    fn pair(&mut self, g: &mut Graph, first: &Term, second: &Term, depth: usize) -> Option<Id> {
        let common = common(&first.0, &second.0);
        let rest = |m: &Monomial| monomial_product(m, &inverse(&common));
        let (a, b) = (rest(&first.0)?, rest(&second.0)?);
        for ((a, x), (b, y)) in [
            ((&a, first.1), (&b, second.1)),
            ((&b, second.1), (&a, first.1)),
        ] {
            // x a + y b = x (a - k b)
            let k = -y / x;
            if a.is_empty() || !k.is_finite() || k * x != -y || x.mul_add(k, y) != 0.0 {
                continue;
            }
            let Some(difference) = self.scaled_difference(g, a, k, b, depth) else {
                continue;
            };
            if common.is_empty() {
                return Some(times(g, x, difference));
            }
            if !self.on(Rule::Factor) {
                return None;
            }
            let factor = build_term(g, &common, x);
            let product = g.mul(factor, difference);
            return self.by(Rule::Factor, product);
        }
        None
    }

    /// a - k b of two monomials without a common factor, where there is a better form.
    fn scaled_difference(
        &mut self,
        g: &mut Graph,
        a: &Monomial,
        k: f64,
        b: &Monomial,
        depth: usize,
    ) -> Option<Id> {
        let attempts = [
            Self::by_function,
            Self::by_conjugate,
            Self::by_squares,
            Self::by_cubes,
            Self::by_quotient,
            Self::by_product,
        ];
        for attempt in attempts {
            let (used, lost) = self.marks();
            let found = attempt(self, g, a, k, b, depth);
            if found.is_some() {
                return found;
            }
            self.reset(used, lost);
        }
        None
    }

    /// a² - b² = (a - b)(a + b)
    fn by_squares(
        &mut self,
        g: &mut Graph,
        a: &Monomial,
        k: f64,
        b: &Monomial,
        depth: usize,
    ) -> Option<Id> {
        if k < 0.0 {
            return self.by_complex_squares(g, a, k, b);
        }
        let (u, v) = self.roots(g, a, k, b, 2)?;
        if let Some(found) = self.pythagoras(g, u, v) {
            return Some(found);
        }
        if !self.on(Rule::Squares) {
            return None;
        }
        if is_real(g, u)
            && let Some(simple) = self.difference(g, u, v, depth)
        {
            let sum = self.total(g, 1.0, u, v)?;
            let product = g.mul(simple, sum);
            return self.by(Rule::Squares, product);
        }
        // beside a third term, the rounding of a² is not what counts
        if !self.alone {
            return None;
        }
        if is_real(g, u) && !is_real(g, v) {
            return None;
        }
        if !is_real(g, u) {
            let product = self.squares_of_parts(g, a, u, v)?;
            return self.by(Rule::Squares, product);
        }
        // a numerator stays a product, of which one factor is divided
        let new = if depth == MAX_DEPTH && (is_step(g, u) || is_step(g, v)) {
            Self::beside_constant(g, u, v)
        } else {
            let (left, right) = (g.apply(Prim::Abs, &[u]), g.apply(Prim::Abs, &[v]));
            let (difference, sum) = (g.sub(left, right), g.add(left, right));
            g.mul(difference, sum)
        };
        self.by(Rule::Squares, new)
    }

    /// u² - v², of which one is a constant, as written where it is more than half of the square of the other, x², else from
    /// x - c. Of e the unit of rounding, what is written loses e x² in its square and e |x² - c²| in the difference: more
    /// only where 2 |x² - c²| < x², and there x - c is exact. That is √(2/3) |c| < |x| < √2 |c|, and asked so: a driver would
    /// not fuse the square with the difference if the condition needed it, too. (Without a constant the errors of u - v and u + v are opposite ones and compensate: the product is better everywhere.)
    fn beside_constant(g: &mut Graph, u: Id, v: Id) -> Id {
        let (x, c) = if is_step(g, v) { (u, v) } else { (v, u) };
        let [square, other] = [u, v].map(|x| g.apply(Prim::PowInt(2), &[x]));
        let written = g.sub(square, other);
        let [size, from] = [x, c].map(|x| g.apply(Prim::Abs, &[x]));
        let difference = g.sub(size, from);
        let beside = square_beside(g, from, difference);
        let beside = if x == u { beside } else { g.neg(beside) };
        let (low, high) = ((2.0_f64 / 3.0).sqrt() - 1.0, std::f64::consts::SQRT_2 - 1.0);
        let middle = scaled(g, (low + high) / 2.0, from);
        let reach = scaled(g, (high - low) / 2.0, from);
        let away = g.sub(difference, middle);
        let away = g.apply(Prim::Abs, &[away]);
        let condition = less(g, away, reach);
        choose(g, condition, beside, written)
    }

    /// z² - v² for a constant v: the real part of (z - v)(z + v), and the imaginary part of z², which does not cancel
    /// and whose sign chooses the side of a cut.
    fn squares_of_parts(&self, g: &mut Graph, square: &Monomial, z: Id, v: Id) -> Option<Id> {
        if g.as_real(v).is_none() && g.as_complex(v).is_none() {
            return None;
        }
        let (left, right) = (g.sub(z, v), g.add(z, v));
        let product = g.mul(left, right);
        let square = build_monomial(g, square)?;
        let parts = [g.apply(Prim::Re, &[product]), g.apply(Prim::Im, &[square])];
        Some(g.apply(Prim::Complex, &parts))
    }

    /// z² + c² = (z - c i)(z + c i)
    fn by_complex_squares(
        &mut self,
        g: &mut Graph,
        a: &Monomial,
        k: f64,
        b: &Monomial,
    ) -> Option<Id> {
        if !self.alone || !b.is_empty() || !self.on(Rule::ComplexSquares) {
            return None;
        }
        let (z, c) = self.roots(g, a, -k, b, 2)?;
        let c = g.as_real(c)?;
        if is_real(g, z) {
            return None;
        }
        let c = g.complex(0.0, c);
        let product = self.squares_of_parts(g, a, z, c)?;
        self.by(Rule::ComplexSquares, product)
    }

    /// aⁿ - bⁿ = (a - b)(aⁿ⁻¹ + aⁿ⁻² b + … + bⁿ⁻¹), n odd
    fn by_cubes(
        &mut self,
        g: &mut Graph,
        a: &Monomial,
        k: f64,
        b: &Monomial,
        depth: usize,
    ) -> Option<Id> {
        if !self.on(Rule::Cubes) {
            return None;
        }
        let found = [3, 5, 7]
            .into_iter()
            .find_map(|n| Some((n, self.roots(g, a, k, b, n)?)));
        let (n, (u, v)) = found?;
        let real = is_real(g, u) && is_real(g, v);
        let difference = match self.difference(g, u, v, depth) {
            Some(simple) => simple,
            None if real && n == 3 && self.alone => g.sub(u, v),
            None => return None,
        };
        let sum = if n == 3 {
            sum_of_three_products(g, u, v)
        } else {
            power_sum(g, u, v, n)
        };
        let product = g.mul(difference, sum);
        self.by(Rule::Cubes, product)
    }

    /// u and v with uⁿ = a and vⁿ = k b, where both are monomials.
    fn roots(&self, g: &mut Graph, a: &Monomial, k: f64, b: &Monomial, n: i32) -> Option<(Id, Id)> {
        if a.iter().chain(b).any(|(_, power)| power % n != 0) {
            return None;
        }
        let root = match n {
            2 => k.sqrt(),
            _ => k.abs().powf(1.0 / f64::from(n)).round().copysign(k),
        };
        let power = (1..n).try_fold(root, |power, _| exact_product(power, root));
        if !root.is_finite() || power != Some(k) || root.abs() > 1e6 {
            return None;
        }
        let part = |m: &Monomial| -> Monomial { m.iter().map(|&(a, p)| (a, p / n)).collect() };
        let u = build_monomial(g, &part(a))?;
        Some((u, build_term(g, &part(b), root)))
    }

    /// a b - c d = a (b - d) + d (a - c)
    fn by_product(
        &mut self,
        g: &mut Graph,
        a: &Monomial,
        k: f64,
        b: &Monomial,
        depth: usize,
    ) -> Option<Id> {
        if !self.on(Rule::Products) || k.to_bits() != 1.0_f64.to_bits() {
            return None;
        }
        let (left, right) = (self.factors(g, a)?, self.factors(g, b)?);
        for (c, d) in [(right.0, right.1), (right.1, right.0)] {
            let (a, b) = left;
            if !is_real(g, a) || !is_real(g, b) || !is_real(g, c) || !is_real(g, d) {
                return None;
            }
            let Some(second) = self.difference(g, b, d, depth) else {
                continue;
            };
            let Some(first) = self.difference(g, a, c, depth) else {
                continue;
            };
            // a difference that is still one may cancel as before, and then nothing is gained
            let remains = |id| matches!(self.view(g, id).0, Some(Prim::Add | Prim::Sub));
            if remains(first) || remains(second) {
                continue;
            }
            let (left, right) = (g.mul(a, second), g.mul(d, first));
            let sum = g.add(left, right);
            return self.by(Rule::Products, sum);
        }
        None
    }

    /// The two factors of a monomial.
    fn factors(&self, g: &Graph, monomial: &Monomial) -> Option<(Id, Id)> {
        match monomial.as_slice() {
            [(a, 1), (b, 1)] => Some((*a, *b)),
            _ => match self.view(g, only_atom(monomial)?) {
                (Some(Prim::Mul), &[a, b]) => Some((a, b)),
                _ => None,
            },
        }
    }
}

/// x a, the sign inside of a quotient of a constant.
fn times(g: &mut Graph, x: f64, a: Id) -> Id {
    let node = g.node(a);
    if let (true, Op::Apply(Prim::Div), &[n, d]) = (x < 0.0, node.op, node.args.as_slice())
        && let Some(n) = g.as_real(n)
    {
        let n = g.real(-n);
        let quotient = g.div(n, d);
        let size = g.real(-x);
        return g.mul(size, quotient);
    }
    let x = g.real(x);
    g.mul(x, a)
}

/// Whether a node is a constant, or a choice of two or three, such as a scale.
fn is_step(g: &Graph, id: Id) -> bool {
    let mut next = id;
    for _ in 0..3 {
        let node = g.node(next);
        match (node.op, node.args.as_slice()) {
            (Op::Apply(Prim::Select), &[_, a, b]) if constant(g, a).is_some() => next = b,
            _ => break,
        }
    }
    constant(g, next).is_some()
}

/// (v + d)² - v² = d² + 2 v d, which rounds less than d (2 v + d) where d is small beside v.
fn square_beside(g: &mut Graph, v: Id, d: Id) -> Id {
    let square = g.apply(Prim::PowInt(2), &[d]);
    let double = scaled(g, 2.0, v);
    let rest = g.mul(double, d);
    g.add(square, rest)
}

/// uⁿ⁻¹ + uⁿ⁻² v + … + vⁿ⁻¹
fn power_sum(g: &mut Graph, u: Id, v: Id, n: i32) -> Id {
    let mut sum = g.add(u, v);
    for k in 2..n {
        let power = g.apply(Prim::PowInt(k), &[v]);
        let product = g.mul(sum, u);
        sum = g.add(product, power);
    }
    sum
}

/// u² + u v + v² = 3/4 (u + v)² + 1/4 (u - v)², where no infinity meets a zero
pub(super) fn sum_of_three_products(g: &mut Graph, u: Id, v: Id) -> Id {
    let (sum, difference) = (g.add(u, v), g.sub(u, v));
    let [plus, minus] = [(0.75, sum), (0.25, difference)].map(|(factor, x)| {
        let factor = g.real(factor);
        let square = g.apply(Prim::PowInt(2), &[x]);
        g.mul(factor, square)
    });
    g.add(plus, minus)
}

/// What two monomials share.
fn common(a: &Monomial, b: &Monomial) -> Monomial {
    let shared = a.iter().filter_map(|&(atom, p)| {
        let (_, q) = b.iter().find(|(other, _)| *other == atom)?;
        (p > 0 && *q > 0).then(|| (atom, p.min(*q)))
    });
    shared.collect()
}

fn inverse(m: &Monomial) -> Monomial {
    m.iter().map(|&(atom, p)| (atom, -p)).collect()
}
