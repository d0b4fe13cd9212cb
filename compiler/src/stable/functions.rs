//! f(a) - f(b) from a - b, function by function, and f(a) - c where c is a value of f.
//!
//! Every method here gives a well-conditioned form of the difference, or `None`.

use super::guard::{choose, is_input, is_real, less, nonzero_constant, positive, scaled, within};
use super::pass::{Pass, only_atom};
use super::polynomial::{Expand, Monomial, Polynomial, build_term};
use super::rule::Rule;
use super::sum::sum_of_three_products;
use crate::ir::{Graph, Id, Prim};

/// The two values of one function, their arguments, and how much those differ.
#[derive(Clone, Copy)]
struct Two {
    /// f(a)
    u: Id,
    /// f(b)
    v: Id,
    a: Id,
    b: Id,
    /// a - b
    delta: Id,
    /// Whether a - b is a constant other than 0.
    constant: Option<f64>,
}

impl Two {
    /// f(a) - f(b) as it is written.
    fn written(self, g: &mut Graph) -> Id {
        g.sub(self.u, self.v)
    }

    fn is_real(self, g: &Graph) -> bool {
        is_real(g, self.u) && is_real(g, self.v)
    }
}

/// Functions with f(-x) = -f(x).
fn is_odd(prim: Prim) -> bool {
    matches!(
        prim,
        Prim::Sin | Prim::Tan | Prim::Atan | Prim::Cbrt | Prim::Sinh | Prim::Tanh
    )
}

impl Pass {
    /// U - k V of two functions, or of a function and a constant.
    pub(super) fn by_function(
        &mut self,
        g: &mut Graph,
        a: &Monomial,
        k: f64,
        b: &Monomial,
        depth: usize,
    ) -> Option<Id> {
        let u = only_atom(a)?;
        if b.is_empty() {
            return self.minus_constant(g, u, k, depth);
        }
        let v = only_atom(b)?;
        if k.abs().to_bits() != 1.0_f64.to_bits() {
            return None;
        }
        let (Some(f), args) = self.view(g, u) else {
            return None;
        };
        let args: smallvec::SmallVec<[Id; 2]> = args.into();
        let (Some(other), others) = self.view(g, v) else {
            return None;
        };
        if f != other {
            return None;
        }
        if f == Prim::Pow && k > 0.0 {
            return self.power_difference(g, u, v, depth);
        }
        let (&[a], &[b]) = (args.as_slice(), others) else {
            return None;
        };
        if f == Prim::Exp && k < 0.0 {
            return self.cosh(g, a, b);
        }
        let (v, b) = match (k < 0.0, is_odd(f)) {
            (false, _) => (v, b),
            (true, true) => (g.neg(v), g.neg(b)),
            (true, false) => return None,
        };
        if f == Prim::Exp
            && let Some(found) = self.sinh(g, a, b)
        {
            return Some(found);
        }
        let delta = match self.difference(g, a, b, depth) {
            Some(delta) => delta,
            None if self.inputs_too && is_input(g, a) && is_input(g, b) => g.sub(a, b),
            None => return None,
        };
        let two = Two {
            u,
            v,
            a,
            b,
            delta,
            constant: nonzero_constant(g, delta),
        };
        match f {
            Prim::Sqrt => self.sqrt(g, two),
            Prim::Cbrt => self.cbrt(g, two),
            Prim::Log => self.log(g, two),
            Prim::Exp => self.exp(g, two),
            Prim::Sin => self.sin(g, two),
            Prim::Cos => self.cos(g, two),
            Prim::Tan => self.tan(g, two),
            Prim::Atan => self.atan(g, two),
            Prim::Sinh | Prim::Cosh | Prim::Tanh => self.hyperbolic(g, f, two),
            Prim::AtanSlope => self.slope(g, two),
            _ => None,
        }
    }

    /// √a - √b = (a - b)/(√a + √b)
    fn sqrt(&mut self, g: &mut Graph, two: Two) -> Option<Id> {
        let upper_half = two.constant.is_some() && is_real(g, two.delta);
        if !self.on(Rule::Sqrt) || !(two.is_real(g) || upper_half) {
            return None;
        }
        let sum = g.add(two.u, two.v);
        let quotient = g.div(two.delta, sum);
        if two.constant.is_some() {
            return self.by(Rule::Sqrt, quotient);
        }
        let size = g.apply(Prim::Abs, &[two.delta]);
        let (condition, written) = (less(g, size, two.b), two.written(g));
        let chosen = choose(g, condition, quotient, written);
        self.by(Rule::Sqrt, chosen)
    }

    /// cbrt a - cbrt b = (a - b)/(cbrt² a + cbrt a cbrt b + cbrt² b)
    fn cbrt(&mut self, g: &mut Graph, two: Two) -> Option<Id> {
        if !self.on(Rule::Cbrt) {
            return None;
        }
        let sum = sum_of_three_products(g, two.u, two.v);
        let quotient = g.div(two.delta, sum);
        if two.constant.is_some() {
            return self.by(Rule::Cbrt, quotient);
        }
        let (condition, written) = (positive(g, sum), two.written(g));
        let chosen = choose(g, condition, quotient, written);
        self.by(Rule::Cbrt, chosen)
    }

    /// log a - log b = log1p((a - b)/b)
    fn log(&mut self, g: &mut Graph, two: Two) -> Option<Id> {
        if !self.on(Rule::Log) {
            return None;
        }
        let quotient = g.div(two.delta, two.b);
        let log = g.apply(Prim::Log1p, &[quotient]);
        if !two.is_real(g) {
            let upper_half = two.constant.is_some() && is_real(g, two.delta);
            return if upper_half {
                self.by(Rule::Log, log)
            } else {
                None
            };
        }
        let size = g.apply(Prim::Abs, &[two.delta]);
        let size = scaled(g, 2.0, size);
        let (condition, written) = (less(g, size, two.b), two.written(g));
        let chosen = choose(g, condition, log, written);
        self.by(Rule::Log, chosen)
    }

    /// exp a - exp b = exp b expm1(a - b)
    fn exp(&mut self, g: &mut Graph, two: Two) -> Option<Id> {
        if !self.on(Rule::Exp) || two.constant.is_some_and(|c| c.abs() > 1.0) {
            return None;
        }
        let small = g.apply(Prim::Expm1, &[two.delta]);
        let product = g.mul(two.v, small);
        if two.constant.is_some() {
            return self.by(Rule::Exp, product);
        }
        let (condition, written) = (within(g, two.delta, 1.0), two.written(g));
        let chosen = choose(g, condition, product, written);
        self.by(Rule::Exp, chosen)
    }

    /// exp a - exp b = 2 exp((a + b)/2) sinh((a - b)/2), where a + b is a constant.
    fn sinh(&mut self, g: &mut Graph, a: Id, b: Id) -> Option<Id> {
        self.by_half_sum(g, a, b, Prim::Sinh, Rule::SinhExp)
    }

    /// exp a + exp b = 2 exp((a + b)/2) cosh((a - b)/2), where a + b is a constant.
    fn cosh(&mut self, g: &mut Graph, a: Id, b: Id) -> Option<Id> {
        self.by_half_sum(g, a, b, Prim::Cosh, Rule::CoshExp)
    }

    fn by_half_sum(&mut self, g: &mut Graph, a: Id, b: Id, f: Prim, rule: Rule) -> Option<Id> {
        if !self.on(rule) {
            return None;
        }
        let (p, q) = (
            self.polynomial(g, a, Expand::Constants)?,
            self.polynomial(g, b, Expand::Constants)?,
        );
        let half_sum = 0.5 * p.clone().add(&q, 1.0)?.constant()?;
        let factor = 2.0 * crate::reference::real::exp(half_sum);
        // of the two signs, that argument which needs no minus: a itself, or (a - b)/2
        let argument = if half_sum == 0.0 {
            a
        } else {
            let half = Polynomial::default().add(&p.add(&q, -1.0)?, 0.5)?;
            super::polynomial::build(g, &half.terms)
        };
        if half_sum.abs() > 60.0 {
            return None;
        }
        let value = g.apply(f, &[argument]);
        let product = scaled(g, factor, value);
        self.by(rule, product)
    }

    /// (sin d, cos d, sin b, cos b) with d = (a - b)/2
    fn waves(g: &mut Graph, two: Two) -> [Id; 4] {
        let d = scaled(g, 0.5, two.delta);
        [
            g.apply(Prim::Sin, &[d]),
            g.apply(Prim::Cos, &[d]),
            g.apply(Prim::Sin, &[two.b]),
            g.apply(Prim::Cos, &[two.b]),
        ]
    }

    /// sin a - sin b = 2 sin d cos(b + d), d = (a - b)/2
    fn sin(&mut self, g: &mut Graph, two: Two) -> Option<Id> {
        if !self.on(Rule::Sin) {
            return None;
        }
        let new = if two.is_real(g) {
            let [sin_d, cos_d, sin_b, cos_b] = Self::waves(g, two);
            let (left, right) = (g.mul(cos_b, cos_d), g.mul(sin_b, sin_d));
            let wave = g.sub(left, right);
            let double = scaled(g, 2.0, sin_d);
            g.mul(double, wave)
        } else {
            self.double_product(g, two, Prim::Sin, Prim::Cos, 2.0)?
        };
        let new = self.near(g, two, new);
        self.by(Rule::Sin, new)
    }

    /// cos a - cos b = -2 sin d sin(b + d), d = (a - b)/2
    fn cos(&mut self, g: &mut Graph, two: Two) -> Option<Id> {
        if !self.on(Rule::Cos) {
            return None;
        }
        let new = if two.is_real(g) {
            let [sin_d, cos_d, sin_b, cos_b] = Self::waves(g, two);
            let (left, right) = (g.mul(sin_b, cos_d), g.mul(cos_b, sin_d));
            let wave = g.add(left, right);
            let double = scaled(g, -2.0, sin_d);
            g.mul(double, wave)
        } else {
            self.double_product(g, two, Prim::Sin, Prim::Sin, -2.0)?
        };
        let new = self.near(g, two, new);
        self.by(Rule::Cos, new)
    }

    /// factor · f((a - b)/2) · h((a + b)/2)
    fn double_product(
        &mut self,
        g: &mut Graph,
        two: Two,
        f: Prim,
        h: Prim,
        factor: f64,
    ) -> Option<Id> {
        let (half, middle) = (scaled(g, 0.5, two.delta), self.total(g, 0.5, two.a, two.b)?);
        let (small, large) = (g.apply(f, &[half]), g.apply(h, &[middle]));
        let double = scaled(g, factor, small);
        Some(g.mul(double, large))
    }

    /// Of inputs the new form only where they are near one another: elsewhere their difference rounds.
    fn near(&self, g: &mut Graph, two: Two, new: Id) -> Id {
        if !self.inputs_too || two.constant.is_some() {
            return new;
        }
        let (condition, written) = (within(g, two.delta, 1.0), two.written(g));
        choose(g, condition, new, written)
    }

    /// tan a - tan b = sin(a - b)/cos a/cos b
    fn tan(&mut self, g: &mut Graph, two: Two) -> Option<Id> {
        if !self.on(Rule::Tan) || !two.is_real(g) {
            return None;
        }
        let sin = g.apply(Prim::Sin, &[two.delta]);
        let (cos_a, cos_b) = (g.apply(Prim::Cos, &[two.a]), g.apply(Prim::Cos, &[two.b]));
        let quotient = g.div(sin, cos_a);
        let quotient = g.div(quotient, cos_b);
        let new = self.near(g, two, quotient);
        self.by(Rule::Tan, new)
    }

    /// atan a - atan b = atan2(a - b, 1 + a b)
    fn atan(&mut self, g: &mut Graph, two: Two) -> Option<Id> {
        if !self.on(Rule::Atan) || !two.is_real(g) {
            return None;
        }
        let product = g.mul(two.a, two.b);
        let one = g.real(1.0);
        let cosine = g.add(one, product);
        let angle = g.apply(Prim::Atan2, &[two.delta, cosine]);
        if two.constant.is_some() {
            return self.by(Rule::Atan, angle);
        }
        let sizes = [two.delta, two.b].map(|x| g.apply(Prim::Abs, &[x]));
        let (condition, written) = (less(g, sizes[0], sizes[1]), two.written(g));
        let chosen = choose(g, condition, angle, written);
        self.by(Rule::Atan, chosen)
    }

    fn hyperbolic(&mut self, g: &mut Graph, f: Prim, two: Two) -> Option<Id> {
        if !self.on(Rule::Hyperbolic) || !two.is_real(g) || self.inputs_too {
            return None;
        }
        let new = match f {
            Prim::Sinh => self.double_product(g, two, Prim::Sinh, Prim::Cosh, 2.0)?,
            Prim::Cosh => self.double_product(g, two, Prim::Sinh, Prim::Sinh, 2.0)?,
            _ => {
                let sinh = g.apply(Prim::Sinh, &[two.delta]);
                let cosh = [two.a, two.b].map(|x| g.apply(Prim::Cosh, &[x]));
                let quotient = g.div(sinh, cosh[0]);
                let quotient = g.div(quotient, cosh[1]);
                if two.constant.is_some_and(|c| c.abs() < 60.0) {
                    quotient
                } else {
                    let (condition, written) = (within(g, two.delta, 1.0), two.written(g));
                    choose(g, condition, quotient, written)
                }
            }
        };
        self.by(Rule::Hyperbolic, new)
    }

    /// 1/(1 + a²) - 1/(1 + b²) = (b - a)(b + a)/(1 + a²)/(1 + b²)
    fn slope(&mut self, g: &mut Graph, two: Two) -> Option<Id> {
        if !self.on(Rule::Slope) || !two.is_real(g) {
            return None;
        }
        let sum = self.total(g, 1.0, two.a, two.b)?;
        let left = g.mul(two.delta, two.u);
        let right = g.mul(sum, two.v);
        let product = g.mul(left, right);
        let product = g.neg(product);
        self.by(Rule::Slope, product)
    }

    /// √a - k b = (a - k² b²)/(√a + k b) where k b > 0.
    pub(super) fn by_conjugate(
        &mut self,
        g: &mut Graph,
        a: &Monomial,
        k: f64,
        b: &Monomial,
        depth: usize,
    ) -> Option<Id> {
        if !self.on(Rule::Conjugate) || (b.is_empty() && k <= 0.0) {
            return None;
        }
        let root = only_atom(a)?;
        let inner = self.argument(g, root, Prim::Sqrt)?;
        let w = build_term(g, b, k);
        if !is_real(g, root) || !is_real(g, w) {
            return None;
        }
        let mut term = Polynomial::default();
        term.terms.push((b.clone(), k));
        let square = self.squared(g, &term)?;
        let p = self.polynomial(g, inner, Expand::Constants)?;
        let rest = p.add(&square, -1.0)?;
        // b² itself must go, or there is nothing to gain
        let gone = rest.terms.iter().all(|(m, _)| *m != square.terms[0].0);
        if rest.cancelled == 0 || !gone {
            return None;
        }
        let numerator = self.built(g, rest, depth.checked_sub(1)?);
        let sum = g.add(root, w);
        let quotient = g.div(numerator, sum);
        // beyond, nothing cancels, and numerator or root may be infinite; for w ≤ 0 it does not hold
        let limit = scaled(g, 4.0, w);
        let condition = less(g, root, limit);
        let written = g.sub(root, w);
        let chosen = choose(g, condition, quotient, written);
        self.by(Rule::Conjugate, chosen)
    }

    /// The square of a term, where its factors are read as polynomials of their own.
    fn squared(&self, g: &mut Graph, term: &Polynomial) -> Option<Polynomial> {
        let (monomial, value) = term.single()?;
        let id = build_term(g, monomial, *value);
        let p = self.polynomial(g, id, Expand::Constants)?;
        let p = if p.terms.len() == 1 { p } else { term.clone() };
        p.mul(&p)
    }

    /// f(a) - k for a constant k.
    fn minus_constant(&mut self, g: &mut Graph, u: Id, k: f64, depth: usize) -> Option<Id> {
        let (Some(f), args) = self.view(g, u) else {
            return None;
        };
        let args: smallvec::SmallVec<[Id; 2]> = args.into();
        let real = is_real(g, u);
        let is = |value: f64| k.to_bits() == value.to_bits();
        match (f, args.as_slice()) {
            (Prim::Exp, &[a]) if is(1.0) && self.on(Rule::Expm1) => {
                let new = g.apply(Prim::Expm1, &[a]);
                self.by(Rule::Expm1, new)
            }
            // 2^x - 1 = expm1(x log 2)
            (Prim::Exp2, &[a]) if is(1.0) && self.on(Rule::Expm1) => {
                let scaled = scaled(g, std::f64::consts::LN_2, a);
                let new = g.apply(Prim::Expm1, &[scaled]);
                self.by(Rule::Expm1, new)
            }
            (Prim::Cos, &[a]) if k.abs().to_bits() == 1.0_f64.to_bits() => {
                if !self.on(Rule::CosMinusOne) {
                    return None;
                }
                let (wave, factor) = if k > 0.0 {
                    (Prim::Sin, -2.0)
                } else {
                    (Prim::Cos, 2.0)
                };
                let new = twice_square(g, wave, a, factor);
                self.by(Rule::CosMinusOne, new)
            }
            (Prim::Cosh, &[a]) if is(1.0) && self.on(Rule::CoshMinusOne) => {
                let new = twice_square(g, Prim::Sinh, a, 2.0);
                self.by(Rule::CoshMinusOne, new)
            }
            (Prim::Tanh, &[a]) if real && k.abs().to_bits() == 1.0_f64.to_bits() => {
                if !self.on(Rule::TanhMinusOne) {
                    return None;
                }
                let double = scaled(g, 2.0 * k, a);
                let exp = g.apply(Prim::Exp, &[double]);
                let one = g.real(1.0);
                let sum = g.add(exp, one);
                let numerator = g.real(-2.0 * k);
                let new = g.div(numerator, sum);
                self.by(Rule::TanhMinusOne, new)
            }
            (Prim::Cbrt, &[a]) if self.on(Rule::Cbrt) => {
                let cube = g.real(k * k * k);
                let (p, q) = (
                    self.polynomial(g, a, Expand::Constants)?,
                    self.polynomial(g, cube, Expand::Constants)?,
                );
                let rest = p.add(&q, -1.0)?;
                if rest.cancelled == 0 || rest.terms.iter().any(|(m, _)| m.is_empty()) {
                    return None;
                }
                let numerator = self.built(g, rest, depth.checked_sub(1)?);
                let k = g.real(k);
                let sum = sum_of_three_products(g, u, k);
                let new = g.div(numerator, sum);
                self.by(Rule::Cbrt, new)
            }
            (Prim::Div, &[n, d]) if real => self.logistic(g, n, d, k),
            // atan(exp a) - π/4 = atan(tanh(a/2))
            (Prim::Atan, &[a]) if real && is(std::f64::consts::FRAC_PI_4) => {
                let exponent = self.argument(g, a, Prim::Exp)?;
                if !self.on(Rule::Gudermann) {
                    return None;
                }
                let half = scaled(g, 0.5, exponent);
                let tanh = g.apply(Prim::Tanh, &[half]);
                let new = g.apply(Prim::Atan, &[tanh]);
                self.by(Rule::Gudermann, new)
            }
            (Prim::Pow, &[base, exponent]) if real && is(1.0) => {
                self.power_minus_one(g, u, base, exponent)
            }
            _ => None,
        }
    }

    /// 1 - cos² a = sin² a and its like, for the roots u and v = 1.
    pub(super) fn pythagoras(&mut self, g: &mut Graph, u: Id, v: Id) -> Option<Id> {
        if g.as_real(v) != Some(1.0) || !self.on(Rule::Pythagoras) {
            return None;
        }
        let (Some(f), &[a]) = self.view(g, u) else {
            return None;
        };
        // f² - 1 = ± h²
        let (h, sign) = match f {
            Prim::Cos => (Prim::Sin, -1.0),
            Prim::Sin => (Prim::Cos, -1.0),
            Prim::Cosh => (Prim::Sinh, 1.0),
            Prim::Tanh => (Prim::Sech, -1.0),
            _ => return None,
        };
        let value = g.apply(h, &[a]);
        let square = g.apply(Prim::PowInt(2), &[value]);
        let new = scaled(g, sign, square);
        self.by(Rule::Pythagoras, new)
    }
}

/// factor · f(a/2)²
fn twice_square(g: &mut Graph, f: Prim, a: Id, factor: f64) -> Id {
    let half = scaled(g, 0.5, a);
    let value = g.apply(f, &[half]);
    let square = g.apply(Prim::PowInt(2), &[value]);
    scaled(g, factor, square)
}
