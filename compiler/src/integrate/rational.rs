//! Rational functions of one linear function with known numbers, as partial fractions.
//!
//! N/Π (u - rₖ)^mₖ is a polynomial and Σ cₖⱼ (u - rₖ)^-j, of which cₖⱼ are the Taylor coefficients at rₖ of what is left
//! without that pole; two that are conjugate are one real fraction over (u - p)² + q². Each is integrated by the rule of its
//! class. On short intervals the function is taken as it is written, by nodes, as the fractions may cancel.
//!
//! Henrici, Applied and Computational Complex Analysis I, section 7.1. The zeros are found by Aberth's method
//! (Mathematics of Computation 27, 1973).

use rustc_hash::FxHashMap;

use super::Integrator;
use super::arithmetic::{add, mul, scale, square};
use super::path::{Body, cone};
use super::term::{Factor, Term};
use crate::ir::{Graph, Id, Op, Prim, Ty};
use crate::reference::complex::{Complex, complex};

/// Greatest degree of a numerator or a divisor.
const MAX_RATIONAL_DEGREE: usize = 24;
/// How many expressions are tried as the linear function.
const MAX_FORMS: usize = 32;
/// Zeros that are nearer to one another, as a part of their size, are not told apart.
const APART: f64 = 1e-5;
/// Zeros of two factors that are nearer are the same.
const SAME: f64 = 1e-13;
/// Steps of Aberth's method.
const STEPS: usize = 200;

/// A polynomial by its coefficients, that of degree 0 first.
type Polynomial = Vec<f64>;

/// A numerator over a product of powers of polynomials.
#[derive(Clone, Debug)]
struct Fraction {
    top: Polynomial,
    bottom: Vec<(Polynomial, usize)>,
}

/// A zero of the divisor; of two that are conjugate the upper one.
#[derive(Clone, Copy, Debug)]
struct Pole {
    at: Complex,
    order: usize,
}

impl Integrator<'_> {
    /// The integrals of the partial fractions of a term that is such a function, each with its term.
    pub(super) fn by_fractions(&mut self, term: &Term) -> Option<Vec<(Term, Id)>> {
        let known = self.parts.len();
        let terms = self.fractions(term)?;
        let mut out = Vec::with_capacity(terms.len());
        for part in terms {
            match self.term(&part) {
                Ok(value) => out.push((part, value)),
                Err(_) => {
                    self.parts.truncate(known);
                    return None;
                }
            }
        }
        Some(out)
    }

    fn fractions(&mut self, term: &Term) -> Option<Vec<Term>> {
        let (level, whole) = {
            let whole = term.moving(self.g);
            self.without_level(whole)
        };
        let mut forms = cone(self.g, &[whole]);
        forms.retain(|&id| {
            self.g.ty(id) == Ty::Real && self.degree(id) == Some(1) && self.moves(id)
        });
        let forms = forms.into_iter().rev().take(MAX_FORMS);
        let (form, function) = forms.into_iter().find_map(|form| {
            let leaf = self.g.new_variable(Ty::Real);
            let body = Body::new(self.g, &[whole], std::iter::once(form));
            let function = body.at(self.g, &[(form, leaf)])[0];
            if self.moves(function) {
                return None;
            }
            Some((form, fraction(self.g, function, leaf)?))
        })?;
        let parts = self.written_out(form, &function)?;
        let product = term.guards.is_empty().then(|| term.integrand(self.g));
        let with_rest = |(coefficient, factors): (Id, Vec<Factor>)| Term {
            coefficient: {
                let coefficient = mul(self.g, level, coefficient);
                mul(self.g, term.coefficient, coefficient)
            },
            factors: factors.into_iter().collect(),
            product,
            ..term.clone()
        };
        Some(parts.into_iter().map(with_rest).collect())
    }

    /// An expression as a factor that does not change along the path, and the rest.
    fn without_level(&mut self, id: Id) -> (Id, Id) {
        let (mut level, mut rest) = (self.g.real(1.0), id);
        loop {
            let node = self.g.node(rest).clone();
            let Op::Apply(prim) = node.op else {
                return (level, rest);
            };
            let (still, next) = match (prim, node.args.as_slice()) {
                (Prim::Mul, &[a, b]) if !self.moves(a) => (a, b),
                (Prim::Mul, &[a, b]) if !self.moves(b) => (b, a),
                (Prim::Div, &[a, b]) if !self.moves(a) && self.g.as_real(a) != Some(1.0) => {
                    let one = self.g.real(1.0);
                    (a, self.g.div(one, b))
                }
                _ => return (level, rest),
            };
            level = mul(self.g, level, still);
            rest = next;
        }
    }

    /// Coefficients and factors of the partial fractions in u.
    fn written_out(&mut self, u: Id, function: &Fraction) -> Option<Vec<(Id, Vec<Factor>)>> {
        let (lead, poles) = poles(&function.bottom)?;
        let mut out = Vec::new();
        let one = self.g.real(1.0);
        let whole = quotient(&function.top, &divisor(&function.bottom)?);
        if whole.iter().any(|&c| c != 0.0) {
            let value = self.horner(&whole, u);
            match self.degree(value) {
                Some(0) => out.push((value, Vec::new())),
                _ => out.push((one, vec![Factor::Polynomial(value)])),
            }
        }
        for (k, pole) in poles.iter().enumerate() {
            let series = series_at(&function.top, lead, &poles, k);
            let q = pole.at.im;
            let back = self.g.real(-pole.at.re);
            let v = add(self.g, u, back);
            for (j, &c) in (1_u8..).zip(series.iter().rev()) {
                let exponent = self.g.real(-f64::from(j));
                if q == 0.0 {
                    if c.re != 0.0 {
                        out.push((self.g.real(c.re), vec![Factor::Power(v, exponent)]));
                    }
                    continue;
                }
                let base = square(self.g, v);
                let rest = self.g.real(q * q);
                let base = add(self.g, base, rest);
                let top = conjugate_top(c, q, usize::from(j));
                let top = self.horner(&top, v);
                let power = Factor::Power(base, exponent);
                match self.degree(top) {
                    Some(0) => out.push((top, vec![power])),
                    _ => out.push((one, vec![Factor::Polynomial(top), power])),
                }
            }
        }
        Some(out)
    }

    fn horner(&mut self, coefficients: &[f64], u: Id) -> Id {
        let mut sum = self.g.real(0.0);
        for &c in coefficients.iter().rev() {
            let c = self.g.real(c);
            let product = match self.g.as_real(sum) {
                Some(v) => scale(self.g, v, u),
                None => mul(self.g, sum, u),
            };
            sum = add(self.g, product, c);
        }
        sum
    }
}

/// An expression of one leaf and numbers as a fraction.
fn fraction(g: &Graph, root: Id, leaf: Id) -> Option<Fraction> {
    let mut known: FxHashMap<Id, Fraction> = FxHashMap::default();
    for id in cone(g, &[root]) {
        let found = if id == leaf {
            whole(vec![0.0, 1.0])
        } else if let Some(v) = g.as_real(id) {
            whole(vec![v])
        } else {
            let node = g.node(id);
            let Op::Apply(prim) = node.op else {
                return None;
            };
            let of = |k: usize| node.args.get(k).and_then(|a| known.get(a));
            let exponent = |v: f64| {
                #[allow(
                    clippy::cast_possible_truncation,
                    reason = "a whole number of at most 24"
                )]
                let n = (v.fract() == 0.0 && v.abs() <= 24.0).then_some(v as i32);
                n
            };
            match prim {
                Prim::Neg => of(0)?.scaled(-1.0),
                Prim::Add => of(0)?.plus(of(1)?)?,
                Prim::Sub => of(0)?.plus(&of(1)?.scaled(-1.0))?,
                Prim::Mul => of(0)?.times(of(1)?)?,
                Prim::Div => of(0)?.times(&of(1)?.power(-1)?)?,
                Prim::PowInt(n) => of(0)?.power(n)?,
                Prim::Pow => of(0)?.power(exponent(g.as_real(node.args[1])?)?)?,
                _ => return None,
            }
        };
        known.insert(id, found);
    }
    known.remove(&root).filter(|f| !f.bottom.is_empty())
}

fn whole(top: Polynomial) -> Fraction {
    Fraction {
        top,
        bottom: Vec::new(),
    }
}

impl Fraction {
    fn scaled(&self, v: f64) -> Self {
        Self {
            top: self.top.iter().map(|c| v * c).collect(),
            bottom: self.bottom.clone(),
        }
    }

    fn plus(&self, other: &Self) -> Option<Self> {
        if self.bottom == other.bottom {
            return Some(Self {
                top: sum(&self.top, &other.top),
                bottom: self.bottom.clone(),
            });
        }
        let (left, right) = (divisor(&self.bottom)?, divisor(&other.bottom)?);
        let top = sum(&product(&self.top, &right)?, &product(&other.top, &left)?);
        Some(Self {
            top,
            bottom: [self.bottom.as_slice(), other.bottom.as_slice()].concat(),
        })
    }

    fn times(&self, other: &Self) -> Option<Self> {
        Some(Self {
            top: product(&self.top, &other.top)?,
            bottom: [self.bottom.as_slice(), other.bottom.as_slice()].concat(),
        })
    }

    fn power(&self, n: i32) -> Option<Self> {
        let count = n.unsigned_abs() as usize;
        if n >= 0 {
            let bottom = self.bottom.iter().map(|(p, m)| (p.clone(), m * count));
            return Some(Self {
                top: raised(&self.top, count)?,
                bottom: bottom.collect(),
            });
        }
        let top = raised(&divisor(&self.bottom)?, count)?;
        match *self.top.as_slice() {
            [c] => Some(whole(top).scaled(c.powi(n))),
            _ => Some(Self {
                top,
                bottom: vec![(self.top.clone(), count)],
            }),
        }
    }
}

fn sum(a: &[f64], b: &[f64]) -> Polynomial {
    let at = |of: &[f64], k: usize| of.get(k).copied().unwrap_or(0.0);
    (0..a.len().max(b.len()))
        .map(|k| at(a, k) + at(b, k))
        .collect()
}

fn product(a: &[f64], b: &[f64]) -> Option<Polynomial> {
    let mut out = vec![0.0; (a.len() + b.len()).saturating_sub(1)];
    if out.len() > MAX_RATIONAL_DEGREE + 1 {
        return None;
    }
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            out[i + j] += x * y;
        }
    }
    Some(out)
}

fn raised(p: &[f64], count: usize) -> Option<Polynomial> {
    (0..count).try_fold(vec![1.0], |power, _| product(&power, p))
}

/// The product of all factors.
fn divisor(bottom: &[(Polynomial, usize)]) -> Option<Polynomial> {
    bottom
        .iter()
        .try_fold(vec![1.0], |all, (p, m)| product(&all, &raised(p, *m)?))
}

/// Without leading zeros.
fn trimmed(p: &[f64]) -> &[f64] {
    let end = p.iter().rposition(|&c| c != 0.0).map_or(0, |k| k + 1);
    &p[..end]
}

/// The whole part of p/d.
fn quotient(p: &[f64], d: &[f64]) -> Polynomial {
    let d = trimmed(d);
    let mut rest = trimmed(p).to_vec();
    let mut out = vec![0.0; (rest.len() + 1).saturating_sub(d.len())];
    for k in (0..out.len()).rev() {
        let c = rest[k + d.len() - 1] / d[d.len() - 1];
        out[k] = c;
        for (j, x) in d.iter().enumerate() {
            rest[k + j] -= c * x;
        }
    }
    out
}

/// The leading coefficient of a product of powers, and its zeros. `None` where they are not told apart.
fn poles(bottom: &[(Polynomial, usize)]) -> Option<(f64, Vec<Pole>)> {
    let mut lead = 1.0;
    let mut out: Vec<Pole> = Vec::new();
    for (p, order) in bottom {
        let p = trimmed(p);
        let &last = p.last()?;
        lead *= last.powi(i32::try_from(*order).ok()?);
        for at in zeros(p)? {
            let distance = |pole: &Pole| (pole.at - at).abs() / (1e-3 + at.abs());
            match out.iter_mut().find(|pole| distance(pole) < APART) {
                Some(pole) if distance(pole) <= SAME => pole.order += order,
                Some(_) => return None,
                None => out.push(Pole { at, order: *order }),
            }
        }
    }
    let is_known = lead.is_finite() && lead != 0.0 && out.iter().all(|p| p.at.abs().is_finite());
    is_known.then_some((lead, out))
}

/// The zeros of a polynomial, of two that are conjugate the upper one; no double ones.
fn zeros(p: &[f64]) -> Option<Vec<Complex>> {
    if let [c, b, a] = *p {
        let half = -0.5 * b / a;
        let inside = half * half - c / a;
        if inside < 0.0 {
            return Some(vec![complex(half, (-inside).sqrt())]);
        }
        let far = half + inside.sqrt().copysign(half);
        let near = if far == 0.0 { 0.0 } else { c / a / far };
        return (far != near).then(|| vec![complex(far, 0.0), complex(near, 0.0)]);
    }
    if p.first() == Some(&0.0) {
        let mut rest = zeros(&p[1..])?;
        rest.push(complex(0.0, 0.0));
        return Some(rest);
    }
    match *p {
        [] => None,
        [_] => Some(Vec::new()),
        [b, a] => Some(vec![complex(-b / a, 0.0)]),
        _ => by_aberth(p),
    }
}

fn by_aberth(p: &[f64]) -> Option<Vec<Complex>> {
    let degree = p.len() - 1;
    let lead = p[degree];
    let radius = 1.0
        + p[..degree]
            .iter()
            .fold(0.0, |m: f64, c| m.max((c / lead).abs()));
    let count = u32::try_from(degree).ok()?;
    let mut all: Vec<Complex> = (0..count)
        .map(|k| {
            let angle = std::f64::consts::TAU * f64::from(k) / f64::from(count) + 0.4;
            complex(angle.cos(), angle.sin()).scale(0.5 * radius)
        })
        .collect();
    for _ in 0..STEPS {
        for k in 0..all.len() {
            let z = all[k];
            let (mut value, mut slope) = (complex(0.0, 0.0), complex(0.0, 0.0));
            for &c in p.iter().rev() {
                slope = slope * z + value;
                value = value * z + complex(c, 0.0);
            }
            if value.abs() == 0.0 {
                continue;
            }
            let newton = value / slope;
            let others = (0..all.len()).filter(|&j| j != k);
            let pull = others.fold(complex(0.0, 0.0), |sum, j| sum + (z - all[j]).inverse());
            all[k] = z - newton / (complex(1.0, 0.0) - newton * pull);
        }
    }
    let mut out: Vec<Complex> = Vec::new();
    for z in all {
        let z = if z.im.abs() < 1e-12 * z.abs() {
            complex(z.re, 0.0)
        } else {
            z
        };
        let is_apart = |other: &Complex| (*other - z).abs() > APART * (1e-3 + z.abs());
        if !z.abs().is_finite() || !out.iter().all(is_apart) {
            return None;
        }
        out.push(z);
    }
    let lower = out.iter().filter(|z| z.im < 0.0).count();
    let upper = out.iter().filter(|z| z.im > 0.0).count();
    out.retain(|z| z.im >= 0.0);
    (lower == upper).then_some(out)
}

/// The Taylor coefficients of N/(lead Π (u - s)^m) without the k-th pole at that pole, as many as its order.
fn series_at(top: &[f64], lead: f64, poles: &[Pole], k: usize) -> Vec<Complex> {
    let Pole { at, order } = poles[k];
    let mut series = shifted(top, at, order);
    for value in &mut series {
        *value = value.scale(1.0 / lead);
    }
    let zeros = poles.iter().enumerate().flat_map(|(j, pole)| {
        let below = complex(pole.at.re, -pole.at.im);
        let below = (pole.at.im != 0.0).then_some((None, below, pole.order));
        std::iter::once((Some(j), pole.at, pole.order)).chain(below)
    });
    for (own, s, order) in zeros {
        if own != Some(k) {
            (0..order).for_each(|_| divide_series(&mut series, at - s));
        }
    }
    series
}

/// Divides a series in v by (v + c).
fn divide_series(series: &mut [Complex], c: Complex) {
    let mut before = complex(0.0, 0.0);
    for value in series {
        *value = (*value - before) / c;
        before = *value;
    }
}

/// The first Taylor coefficients of a polynomial at a place.
fn shifted(p: &[f64], at: Complex, count: usize) -> Vec<Complex> {
    let mut rest: Vec<Complex> = p.iter().map(|&c| complex(c, 0.0)).collect();
    let mut out = Vec::with_capacity(count);
    for _ in 0..count {
        let mut value = complex(0.0, 0.0);
        for c in rest.iter_mut().rev() {
            value = value * at + *c;
            *c = value;
        }
        out.push(value);
        if !rest.is_empty() {
            rest.remove(0);
        }
    }
    out
}

/// 2 Re(c (v + iq)^j), by powers of v.
fn conjugate_top(c: Complex, q: f64, j: usize) -> Polynomial {
    let mut power = vec![c];
    for _ in 0..j {
        let mut next = vec![complex(0.0, 0.0); power.len() + 1];
        for (k, &x) in power.iter().enumerate() {
            next[k] = next[k] + complex(-q * x.im, q * x.re);
            next[k + 1] = next[k + 1] + x;
        }
        power = next;
    }
    let size = power.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    let real = |x: &Complex| {
        if x.re.abs() < 1e-15 * size {
            0.0
        } else {
            2.0 * x.re
        }
    };
    power.iter().map(real).collect()
}
