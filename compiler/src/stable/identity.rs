//! Closed identities of one operation with its operands.

use smallvec::SmallVec;

use super::guard::{choose, is_real, less};
use super::pass::{Pass, only_atom};
use super::polynomial::{Expand, Monomial, Polynomial, build, build_monomial};
use super::rule::Rule;
use crate::ir::{Graph, Id, Op, Prim};

impl Pass {
    /// A better form of an operation that is no sum, where there is one.
    pub(super) fn identity(&mut self, g: &mut Graph, prim: Prim, id: Id) -> Option<Id> {
        let args: SmallVec<[Id; 3]> = g.node(id).args.clone();
        self.inputs_too = false;
        match (prim, args.as_slice()) {
            (Prim::Sqrt, &[a]) => {
                let found = self.hypot(g, a);
                found.or_else(|| self.root_of_squares(g, a))
            }
            (Prim::Log, &[a]) => self.log_of(g, a),
            (Prim::Arg, &[a]) => self.arg_of(g, a),
            (Prim::Mul, &[a, b]) => {
                let product = self.exp_product(g, a, b, 1.0);
                // of a divisor by itself, so that its quotient stays one
                let product = product.or_else(|| self.cardinal(g, id));
                product.or_else(|| self.constants(g, Prim::Mul, a, b))
            }
            (Prim::Div, &[a, b]) => {
                let quotient = self.exp_product(g, a, b, -1.0);
                let quotient = quotient.or_else(|| self.exp_ratio(g, a, b));
                let quotient = quotient.or_else(|| self.tan_half(g, a, b));
                let quotient = quotient.or_else(|| self.ratio(g, a, b));
                let quotient = quotient.or_else(|| self.in_range(g, a, b));
                let quotient = quotient.or_else(|| self.cardinal(g, id));
                let quotient = quotient.or_else(|| self.constants(g, Prim::Div, a, b));
                quotient.or_else(|| self.over_length(g, a, b))
            }
            (Prim::Acos, &[a]) => self.acos(g, id, a),
            (Prim::Pow, &[base, exponent]) => self.compound_power(g, id, base, exponent),
            _ => None,
        }
    }

    /// √(a² + b² + c²), √(a² + b²), √(a²)
    fn hypot(&mut self, g: &mut Graph, a: Id) -> Option<Id> {
        if !is_real(g, a) || !self.on(Rule::Hypot) {
            return None;
        }
        let p = self.polynomial(g, a, Expand::Constants)?;
        if p.terms.is_empty() || p.terms.len() > 3 || p.cancelled > 0 || p.constant().is_some() {
            return None;
        }
        let mut sides: SmallVec<[Id; 3]> = SmallVec::new();
        for (monomial, value) in &p.terms {
            // beside another side, the root of a factor must be exact
            let alone = p.terms.len() == 1;
            sides.push(root(g, monomial, *value, alone)?);
        }
        flatten(g, &mut sides);
        let length = match sides.as_slice() {
            [one] => {
                let new = g.apply(Prim::Abs, &[*one]);
                return self.by(Rule::Hypot, new);
            }
            [_, _] => g.apply(Prim::Hypot, &sides),
            _ => g.apply(Prim::Hypot3, &sides),
        };
        // the rounding of a side that is a product counts twice in its square, those of the factors of a written square do not
        let rounds_as_written = p.terms.iter().all(|(m, c)| is_side(m, *c));
        let new = if rounds_as_written {
            length
        } else {
            root_in_middle_of_range(g, self.plain(a), length)
        };
        self.by(Rule::Hypot, new)
    }

    /// a divided by a length that is as written in the middle of the range: a/√s there, a/1/length elsewhere. Graphics
    /// processors round a/√s once, by the inverse root, which a choice between divisors or quotients would hide from them.
    fn over_length(&mut self, g: &mut Graph, a: Id, b: Id) -> Option<Id> {
        let length = Length::of(g, b)?;
        let one = g.real(1.0);
        let square = length.choose(g, length.square, one);
        let root = g.apply(Prim::Sqrt, &[square]);
        let rest = length.choose(g, one, length.outside);
        let quotient = g.div(a, root);
        let new = g.div(quotient, rest);
        self.by(Rule::Hypot, new)
    }

    /// √(a² - b²) = √(|a| - |b|) √(|a| + |b|)
    fn root_of_squares(&mut self, g: &mut Graph, a: Id) -> Option<Id> {
        if !is_real(g, a) || !self.on(Rule::RootOfSquares) {
            return None;
        }
        let p = self.polynomial(g, a, Expand::Constants)?;
        let (u, v) = match p.terms.as_slice() {
            [u, v] if v.1 < 0.0 => (u, v),
            [v, u] if v.1 < 0.0 => (u, v),
            _ => return None,
        };
        // beside a constant, nothing overflows before the root is infinite
        if p.cancelled > 0 || u.1 <= 0.0 || u.0.is_empty() || v.0.is_empty() {
            return None;
        }
        let (u, v) = (root(g, &u.0, u.1, false)?, root(g, &v.0, -v.1, false)?);
        let (u, v) = (g.apply(Prim::Abs, &[u]), g.apply(Prim::Abs, &[v]));
        let (difference, sum) = (g.sub(u, v), g.add(u, v));
        let (left, right) = (
            g.apply(Prim::Sqrt, &[difference]),
            g.apply(Prim::Sqrt, &[sum]),
        );
        let product = g.mul(left, right);
        // there the difference of the squares may be 0, because both are
        let (is_below, written) = (less(g, u, v), g.apply(Prim::Sqrt, &[self.plain(a)]));
        let new = choose(g, is_below, written, product);
        self.by(Rule::RootOfSquares, new)
    }

    fn log_of(&mut self, g: &mut Graph, a: Id) -> Option<Id> {
        let found = match self.view(g, a) {
            (Some(Prim::Abs), &[z]) => self.log_of_size(g, z),
            (Some(Prim::Exp), &[x]) if is_real(g, x) && self.on(Rule::LogPower) => {
                self.by(Rule::LogPower, x)
            }
            (Some(Prim::Exp), &[z]) => self.log_of_exp(g, z),
            (Some(Prim::PowInt(n)), &[x])
                if n % 2 == 0 && is_real(g, x) && self.on(Rule::LogPower) =>
            {
                let new = Self::times_log(g, f64::from(n), x);
                self.by(Rule::LogPower, new)
            }
            (Some(Prim::Mul), &[x, y]) if x == y && is_real(g, x) && self.on(Rule::LogPower) => {
                let new = Self::times_log(g, 2.0, x);
                self.by(Rule::LogPower, new)
            }
            (Some(Prim::Div), &[n, d]) => self.log_of_quotient(g, a, n, d),
            _ => None,
        };
        let found = found.or_else(|| self.inverse_hyperbolic(g, a));
        let found = found.or_else(|| self.log_of_exponentials(g, a));
        found.or_else(|| {
            if !self.on(Rule::Log1p) {
                return None;
            }
            let rest = self.minus_one(g, a)?;
            let new = g.apply(Prim::Log1p, &[rest]);
            self.by(Rule::Log1p, new)
        })
    }

    /// log|z|
    fn log_of_size(&mut self, g: &mut Graph, z: Id) -> Option<Id> {
        if self.on(Rule::LogPower) {
            match self.view(g, z) {
                (Some(Prim::PowInt(n)), &[x]) => {
                    let new = if is_real(g, x) {
                        Self::times_log(g, f64::from(n), x)
                    } else {
                        let log = g.apply(Prim::Log, &[x]);
                        let re = g.apply(Prim::Re, &[log]);
                        super::guard::scaled(g, f64::from(n), re)
                    };
                    return self.by(Rule::LogPower, new);
                }
                (Some(Prim::Exp), &[x]) => {
                    let new = g.apply(Prim::Re, &[x]);
                    return self.by(Rule::LogPower, new);
                }
                _ => {}
            }
        }
        if is_real(g, z) || !self.on(Rule::LogAbs) {
            return None;
        }
        let log = match self.minus_one(g, z) {
            Some(rest) if self.on(Rule::Log1p) => g.apply(Prim::Log1p, &[rest]),
            _ => g.apply(Prim::Log, &[z]),
        };
        let new = g.apply(Prim::Re, &[log]);
        self.by(Rule::LogAbs, new)
    }

    /// log(a/b) = 2 atanh((a - b)/(a + b)) where a + b is a constant, else log1p((a - b)/b)
    fn log_of_quotient(&mut self, g: &mut Graph, written: Id, a: Id, b: Id) -> Option<Id> {
        if !is_real(g, a) || !is_real(g, b) || !self.on(Rule::LogQuotient) {
            return None;
        }
        let difference = self.difference(g, a, b, 4)?;
        let sum = self.total(g, 1.0, a, b)?;
        if let Some(c) = super::guard::nonzero_constant(g, sum) {
            let c = g.real(c);
            let half = g.div(difference, c);
            let atanh = g.apply(Prim::Atanh, &[half]);
            let new = super::guard::scaled(g, 2.0, atanh);
            return self.by(Rule::LogQuotient, new);
        }
        let quotient = g.div(difference, b);
        let new = g.apply(Prim::Log1p, &[quotient]);
        let condition = super::guard::within(g, quotient, 0.5);
        let written = g.apply(Prim::Log, &[written]);
        let new = super::guard::choose(g, condition, new, written);
        self.by(Rule::LogQuotient, new)
    }

    /// log(x + √(x² ± 1))
    fn inverse_hyperbolic(&mut self, g: &mut Graph, a: Id) -> Option<Id> {
        if !is_real(g, a) || !self.on(Rule::Asinh) {
            return None;
        }
        let p = self.polynomial(g, a, Expand::Constants)?;
        let [(x, one), (y, other)] = p.terms.as_slice() else {
            return None;
        };
        if one.to_bits() != 1.0_f64.to_bits() || other.to_bits() != 1.0_f64.to_bits() {
            return None;
        }
        for (x, root) in [(x, y), (y, x)] {
            let Some(inner) = only_atom(root).and_then(|r| self.argument(g, r, Prim::Sqrt)) else {
                continue;
            };
            let mut square = Polynomial::default();
            square.terms.push((x.clone(), 1.0));
            let square = square.mul(&square)?;
            let rest = self
                .polynomial(g, inner, Expand::Constants)?
                .add(&square, -1.0)?;
            let f = match rest.constant() {
                Some(1.0) => Prim::Asinh,
                Some(-1.0) => Prim::Acosh,
                _ => continue,
            };
            let x = build_monomial(g, x)?;
            let new = g.apply(f, &[x]);
            return self.by(Rule::Asinh, new);
        }
        None
    }

    /// exp a · exp b, or exp a / exp b, where terms of the exponents cancel.
    fn exp_product(&mut self, g: &mut Graph, a: Id, b: Id, sign: f64) -> Option<Id> {
        if !self.on(Rule::ExpProduct) || !self.on(Rule::Cancel) {
            return None;
        }
        let (a, b) = (
            self.argument(g, a, Prim::Exp)?,
            self.argument(g, b, Prim::Exp)?,
        );
        let (p, q) = (
            self.polynomial(g, a, Expand::Constants)?,
            self.polynomial(g, b, Expand::Constants)?,
        );
        let sum = p.add(&q, sign)?;
        if sum.lost.is_empty() {
            return None;
        }
        self.lose(&sum);
        let exponent = build(g, &sum.terms);
        let new = g.apply(Prim::Exp, &[exponent]);
        self.by(Rule::ExpProduct, new)
    }

    /// exp a/(exp a - 1) = -1/expm1(-a)
    fn exp_ratio(&mut self, g: &mut Graph, n: Id, d: Id) -> Option<Id> {
        let a = self.argument(g, n, Prim::Exp)?;
        if !is_real(g, a) || !self.on(Rule::ExpRatio) || !self.on(Rule::Expm1) {
            return None;
        }
        // the divisor has been rewritten before
        let node = g.node(d);
        if node.op != crate::ir::Op::Apply(Prim::Expm1) || node.args[0] != a {
            return None;
        }
        let minus = g.neg(a);
        let below = g.apply(Prim::Expm1, &[minus]);
        let one = g.real(-1.0);
        let new = g.div(one, below);
        self.by(Rule::ExpRatio, new)
    }

    /// sinh a/cosh a = tanh a and its inverse, expm1(2a)/expm1 a = exp a + 1, up to constants
    fn ratio(&mut self, g: &mut Graph, n: Id, d: Id) -> Option<Id> {
        if !self.on(Rule::Ratio) || !is_real(g, n) || !is_real(g, d) {
            return None;
        }
        let function = |id: Id| -> Option<(f64, Prim, Id)> {
            let scaled = |id: Id| {
                let node = g.node(id);
                match (node.op, node.args.as_slice()) {
                    (crate::ir::Op::Apply(Prim::Mul), &[c, x]) => Some((g.as_real(c)?, x)),
                    _ => Some((1.0, id)),
                }
            };
            let (c, f) = scaled(id)?;
            let node = g.node(f);
            match (node.op, node.args.as_slice()) {
                (crate::ir::Op::Apply(prim), &[a]) => Some((c, prim, a)),
                _ => None,
            }
        };
        let ((c, f, a), (e, h, b)) = (function(n)?, function(d)?);
        let factor = c / e;
        if factor * e != c || !factor.is_finite() || factor == 0.0 {
            return None;
        }
        let value = match (f, h) {
            (Prim::Sinh, Prim::Cosh) if a == b => g.apply(Prim::Tanh, &[a]),
            (Prim::Cosh, Prim::Sinh) if a == b => {
                let tanh = g.apply(Prim::Tanh, &[a]);
                let one = g.real(1.0);
                g.div(one, tanh)
            }
            (Prim::Expm1, Prim::Expm1) => {
                let (p, q) = (
                    self.polynomial(g, a, Expand::Constants)?,
                    self.polynomial(g, b, Expand::Constants)?,
                );
                if !p.add(&q, -2.0)?.terms.is_empty() {
                    return None;
                }
                let (exp, one) = (g.apply(Prim::Exp, &[b]), g.real(1.0));
                g.add(exp, one)
            }
            _ => return None,
        };
        let new = super::guard::scaled(g, factor, value);
        self.by(Rule::Ratio, new)
    }

    /// (1 - cos a)/sin a = tan(a/2)
    fn tan_half(&mut self, g: &mut Graph, n: Id, d: Id) -> Option<Id> {
        let a = self.argument(g, d, Prim::Sin)?;
        if !is_real(g, a) || !self.on(Rule::TanHalf) {
            return None;
        }
        let cos = g.find_unary(Prim::Cos, a)?;
        let p = self.polynomial(g, n, Expand::Constants)?;
        let sign = |wanted: f64| {
            let expected = Polynomial::one().add(&Polynomial::atom(cos), -1.0);
            let expected = expected.and_then(|e| Polynomial::default().add(&e, wanted));
            expected
                .and_then(|e| e.add(&p, -1.0))
                .is_some_and(|rest| rest.terms.is_empty())
        };
        let factor = [1.0, -1.0].into_iter().find(|&s| sign(s))?;
        let half = super::guard::scaled(g, 0.5, a);
        let tan = g.apply(Prim::Tan, &[half]);
        let new = super::guard::scaled(g, factor, tan);
        self.by(Rule::TanHalf, new)
    }

    /// Two constant factors made one.
    fn constants(&mut self, g: &mut Graph, prim: Prim, a: Id, b: Id) -> Option<Id> {
        if !self.on(Rule::Constants) {
            return None;
        }
        let (outer, inner) = match (prim, g.as_real(a), g.as_real(b)) {
            (Prim::Mul, Some(c), None) => (c, b),
            (Prim::Mul, None, Some(c)) => (c, a),
            (Prim::Div, None, Some(c)) if c.recip() * c == 1.0 && is_exact_inverse(c) => {
                (c.recip(), a)
            }
            _ => return None,
        };
        let node = g.node(inner);
        if node.op != crate::ir::Op::Apply(Prim::Mul) {
            return None;
        }
        let &[x, y] = node.args.as_slice() else {
            return None;
        };
        let (c, rest) = match (g.as_real(x), g.as_real(y)) {
            (Some(c), None) => (c, y),
            (None, Some(c)) => (c, x),
            _ => return None,
        };
        let product = outer * c;
        let sane = |c: f64| c.is_finite() && (1e-30..1e30).contains(&c.abs());
        if !sane(product) || !sane(c) || !sane(outer) || outer.mul_add(c, -product) != 0.0 {
            return None;
        }
        let new = super::guard::scaled(g, product, rest);
        self.by(Rule::Constants, new)
    }
}

/// √value · the root of a monomial of even powers, but for signs; of a value whose root is not exact only where `rounded`.
fn root(g: &mut Graph, monomial: &Monomial, value: f64, rounded: bool) -> Option<Id> {
    let root = value.sqrt();
    let even = monomial.iter().all(|(_, power)| power % 2 == 0);
    let exact = root * root == value && root.mul_add(root, -value) == 0.0;
    if !even || !(exact || rounded && root.is_normal()) {
        return None;
    }
    let half: Monomial = monomial.iter().map(|&(atom, p)| (atom, p / 2)).collect();
    let factor = g.real(root);
    Some(match build_monomial(g, &half) {
        Some(product) => g.mul(factor, product),
        None => factor,
    })
}

/// Puts the sides of a length of two in its place, where it is one of two sides.
fn flatten(g: &Graph, sides: &mut SmallVec<[Id; 3]>) {
    let is_length = |id: &Id| g.node(*id).op == Op::Apply(Prim::Hypot);
    if sides.len() == 2
        && let Some(place) = sides.iter().position(is_length)
    {
        let inner = sides.remove(place);
        sides.extend(g.node(inner).args.iter().copied());
    }
}

/// Whether the root of a monomial is an atom, but for a power of two, or a constant that single precision holds with its
/// square.
fn is_side(monomial: &Monomial, value: f64) -> bool {
    let is_single = |x: f64| f64::from(x as f32) == x;
    match monomial.as_slice() {
        [] => is_single(value) && is_single(value.sqrt()),
        [(_, 2)] => is_exact_inverse(value),
        _ => false,
    }
}

/// The root of a sum of squares as it is written where the sum is so far from the ends of the range of single precision that
/// none of its terms counts and was lost, else `outside`.
fn root_in_middle_of_range(g: &mut Graph, sum: Id, outside: Id) -> Id {
    let [low, high] = [Length::LOW, Length::HIGH].map(|x| g.real(x));
    // the maximum hides the sum of squares from the rule that made this
    let held = g.apply(Prim::Max, &[sum, low]);
    let written = g.apply(Prim::Sqrt, &[held]);
    let (is_above, is_below) = (less(g, low, sum), less(g, sum, high));
    let length = Length {
        is_above,
        is_below,
        square: held,
        outside,
    };
    length.choose(g, written, outside)
}

/// What [`root_in_middle_of_range`] has made.
struct Length {
    /// Whether the sum of squares is not too small for the written form, and whether it is not too large.
    is_above: Id,
    is_below: Id,
    /// The sum of squares, held above the lower end.
    square: Id,
    /// The form for the ends of the range.
    outside: Id,
}

impl Length {
    /// Sums of squares between these lose nothing to the range of float32.
    const LOW: f64 = 1e-30;
    const HIGH: f64 = 1e30;

    fn of(g: &Graph, id: Id) -> Option<Self> {
        let [is_above, inner, outside] = operands(g, id, Prim::Select)?;
        let [is_below, written, other] = operands(g, inner, Prim::Select)?;
        let [held] = operands(g, written, Prim::Sqrt)?;
        let [sum, low] = operands(g, held, Prim::Max)?;
        let [below, same] = operands(g, is_above, Prim::Less)?;
        let is_one = outside == other
            && (below, same) == (low, sum)
            && g.as_real(low) == Some(Self::LOW)
            && operands(g, is_below, Prim::Less).is_some_and(|[s, _]| s == sum);
        is_one.then_some(Self {
            is_above,
            is_below,
            square: held,
            outside,
        })
    }

    /// `inside` where the sum of squares is in the middle of the range, else `outside`.
    fn choose(&self, g: &mut Graph, inside: Id, outside: Id) -> Id {
        let below = choose(g, self.is_below, inside, outside);
        choose(g, self.is_above, below, outside)
    }
}

/// The operands of an operation, where it is `prim`.
fn operands<const N: usize>(g: &Graph, id: Id, prim: Prim) -> Option<[Id; N]> {
    let node = g.node(id);
    (node.op == Op::Apply(prim))
        .then(|| node.args.as_slice().try_into().ok())
        .flatten()
}

/// Whether 1/c is exact: c is a power of two.
fn is_exact_inverse(c: f64) -> bool {
    c.is_normal() && c.to_bits() & ((1 << 52) - 1) == 0
}
