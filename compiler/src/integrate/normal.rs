//! Sums of powers by exponentials and waves, and quotients of them: a normal form in which equal expressions are equal.
//!
//! Σ c xᵅ e^(P + iQ) with polynomials P and Q: over the powers, exponentials of different polynomials are linearly
//! independent, so that a sum is 0 only where every coefficient is. Coefficients are f64, and one counts as 0 that is 1e-12 of
//! what it is the sum of: constants of a rule, as nodes and weights, are rounded to that.

use rustc_hash::FxHashMap;
use smallvec::SmallVec;

/// What a coefficient is to be of the sizes that it is the sum of.
const NEGLIGIBLE: f64 = 1e-12;
/// The same of coefficients of an exponent, which are rounded to 40 bits.
const ROUNDINGS: f64 = 1e-11;
/// Greatest number of terms of a sum.
const MAX_LENGTH: usize = 20_000;

/// Numbers of variables with their powers, in order.
type Powers = SmallVec<[(u16, u16); 4]>;
/// A polynomial: powers with the bits of their coefficients, which are rounded to 40 bits, in order.
type Exponent = SmallVec<[(Powers, u64); 1]>;

/// xᵅ e^(P + iQ)
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
struct Key {
    powers: Powers,
    growth: Exponent,
    phase: Exponent,
}

#[derive(Clone, Copy, Debug, Default)]
struct Coefficient {
    re: f64,
    im: f64,
    /// The sum of the sizes of what it is the sum of.
    size: f64,
}

impl Coefficient {
    fn is_negligible(&self) -> bool {
        self.re.hypot(self.im) <= NEGLIGIBLE * self.size
    }
}

/// A sum.
#[derive(Clone, Debug, Default)]
pub struct Form {
    terms: FxHashMap<Key, Coefficient>,
}

/// A quotient of two sums.
#[derive(Clone, Debug)]
pub struct Quotient {
    /// What is divided.
    pub top: Form,
    /// By what.
    pub bottom: Form,
}

/// How many products of terms are still formed.
#[derive(Debug)]
pub struct Budget(pub usize);

impl Form {
    /// A number.
    pub fn constant(v: f64) -> Self {
        let mut out = Self::default();
        out.push(
            Key::default(),
            Coefficient {
                re: v,
                im: 0.0,
                size: v.abs(),
            },
        );
        out.without_zeros()
    }

    /// A variable.
    pub fn variable(k: u16) -> Self {
        let key = Key {
            powers: SmallVec::from_slice(&[(k, 1)]),
            ..Key::default()
        };
        let mut out = Self::default();
        out.push(
            key,
            Coefficient {
                re: 1.0,
                im: 0.0,
                size: 1.0,
            },
        );
        out
    }

    /// (e^(±p)) for a real polynomial, of `round` (e^(±ip)), times a number re + i im.
    fn exponential(p: &Exponent, round: bool, (re, im): (f64, f64)) -> Self {
        let key = if round {
            Key {
                phase: p.clone(),
                ..Key::default()
            }
        } else {
            Key {
                growth: p.clone(),
                ..Key::default()
            }
        };
        let mut out = Self::default();
        out.push(
            key,
            Coefficient {
                re,
                im,
                size: re.hypot(im),
            },
        );
        out
    }

    /// e^p; `None` where p is no real polynomial.
    pub fn exp(p: &Self) -> Option<Self> {
        Some(Self::exponential(&p.exponent()?, false, (1.0, 0.0)))
    }

    /// sin p and cos p, or sinh p and cosh p, by Euler.
    pub fn waves(p: &Self, round: bool) -> Option<[Self; 2]> {
        let plus = p.exponent()?;
        let minus: Exponent = plus
            .iter()
            .map(|(powers, bits)| (powers.clone(), (-f64::from_bits(*bits)).to_bits()))
            .collect();
        let (up, down) = if round {
            ((0.0, -0.5), (0.0, 0.5))
        } else {
            ((0.5, 0.0), (-0.5, 0.0))
        };
        let both = |a, b| {
            Self::exponential(&plus, round, a).plus(&Self::exponential(&minus, round, b), 1.0)
        };
        Some([both(up, down), both((0.5, 0.0), (0.5, 0.0))])
    }

    /// The same as an exponent.
    fn exponent(&self) -> Option<Exponent> {
        let mut out = Exponent::new();
        for (key, c) in &self.terms {
            if !key.growth.is_empty() || !key.phase.is_empty() || c.im != 0.0 {
                return None;
            }
            out.push((key.powers.clone(), rounded(c.re)));
        }
        out.sort_unstable();
        Some(out)
    }

    fn push(&mut self, key: Key, c: Coefficient) {
        let known = self.terms.entry(key).or_default();
        known.re += c.re;
        known.im += c.im;
        known.size += c.size;
    }

    fn without_zeros(mut self) -> Self {
        self.terms.retain(|_, c| !c.is_negligible());
        self
    }

    /// Whether it is 0.
    pub fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// The number that it is.
    pub fn as_number(&self) -> Option<f64> {
        if self.is_zero() {
            return Some(0.0);
        }
        let only = self.terms.get(&Key::default()).filter(|c| c.im == 0.0)?;
        (self.terms.len() == 1).then_some(only.re)
    }

    /// a + v b
    pub fn plus(&self, other: &Self, v: f64) -> Self {
        let mut out = self.clone();
        for (key, c) in &other.terms {
            let c = Coefficient {
                re: v * c.re,
                im: v * c.im,
                size: v.abs() * c.size,
            };
            out.push(key.clone(), c);
        }
        out.without_zeros()
    }

    /// a b; `None` where that has too many terms.
    pub fn times(&self, other: &Self, budget: &mut Budget) -> Option<Self> {
        let count = self.terms.len() * other.terms.len();
        let Some(left) = budget.0.checked_sub(count) else {
            budget.0 = 0;
            return None;
        };
        budget.0 = left;
        let mut out = Self::default();
        for (left, a) in &self.terms {
            for (right, b) in &other.terms {
                let key = Key {
                    powers: product(&left.powers, &right.powers),
                    growth: sum(&left.growth, &right.growth),
                    phase: sum(&left.phase, &right.phase),
                };
                let c = Coefficient {
                    re: a.re * b.re - a.im * b.im,
                    im: a.re * b.im + a.im * b.re,
                    size: a.size * b.size,
                };
                out.push(key, c);
            }
            if out.terms.len() > MAX_LENGTH {
                return None;
            }
        }
        Some(out.without_zeros())
    }

    /// The derivative by a variable.
    pub fn slope(&self, by: u16) -> Self {
        let mut out = Self::default();
        for (key, c) in &self.terms {
            let mut push = |key: Key, (re, im): (f64, f64)| {
                let c = Coefficient {
                    re: c.re * re - c.im * im,
                    im: c.re * im + c.im * re,
                    size: c.size * re.hypot(im),
                };
                out.push(key, c);
            };
            if let Some((powers, n)) = lowered(&key.powers, by) {
                let powers = Key {
                    powers,
                    ..key.clone()
                };
                push(powers, (n, 0.0));
            }
            for (exponent, is_phase) in [(&key.growth, false), (&key.phase, true)] {
                for (powers, bits) in exponent {
                    if let Some((powers, n)) = lowered(powers, by) {
                        let v = n * f64::from_bits(*bits);
                        let powers = Key {
                            powers: product(&key.powers, &powers),
                            ..key.clone()
                        };
                        push(powers, if is_phase { (0.0, v) } else { (v, 0.0) });
                    }
                }
            }
        }
        out.without_zeros()
    }

    /// 1 or -1 where a positive or negative multiple of this is the other.
    pub fn side_of(&self, other: &Self) -> Option<f64> {
        let (key, first) = self.terms.iter().next()?;
        let second = other.terms.get(key)?;
        if first.im != 0.0 || second.im != 0.0 {
            return None;
        }
        let ratio = second.re / first.re;
        other.plus(self, -ratio).is_zero().then(|| ratio.signum())
    }
}

impl Quotient {
    /// A sum over 1.
    pub fn whole(top: Form) -> Self {
        Self {
            top,
            bottom: Form::constant(1.0),
        }
    }

    /// a + v b
    pub fn plus(&self, other: &Self, v: f64, budget: &mut Budget) -> Option<Self> {
        if self.bottom.plus(&other.bottom, -1.0).is_zero() {
            let top = self.top.plus(&other.top, v);
            return Some(Self {
                top,
                bottom: self.bottom.clone(),
            });
        }
        let left = self.top.times(&other.bottom, budget)?;
        let right = other.top.times(&self.bottom, budget)?;
        let bottom = self.bottom.times(&other.bottom, budget)?;
        Some(Self {
            top: left.plus(&right, v),
            bottom,
        })
    }

    /// a b
    pub fn times(&self, other: &Self, budget: &mut Budget) -> Option<Self> {
        Some(Self {
            top: self.top.times(&other.top, budget)?,
            bottom: self.bottom.times(&other.bottom, budget)?,
        })
    }

    /// a/b; `None` where b is 0.
    pub fn over(&self, other: &Self, budget: &mut Budget) -> Option<Self> {
        if other.top.is_zero() {
            return None;
        }
        let turned = Self {
            top: other.bottom.clone(),
            bottom: other.top.clone(),
        };
        self.times(&turned, budget)
    }

    /// The derivative by a variable.
    pub fn slope(&self, by: u16, budget: &mut Budget) -> Option<Self> {
        let (top, bottom) = (self.top.slope(by), self.bottom.slope(by));
        let left = top.times(&self.bottom, budget)?;
        let right = self.top.times(&bottom, budget)?;
        Some(Self {
            top: left.plus(&right, -1.0),
            bottom: self.bottom.times(&self.bottom, budget)?,
        })
    }

    /// Whether both are the same; `None` where that takes too many terms.
    pub fn equals(&self, other: &Self, budget: &mut Budget) -> Option<bool> {
        Some(self.plus(other, -1.0, budget)?.top.is_zero())
    }

    /// The sum that it is, where it is divided by a number.
    pub fn as_form(&self) -> Option<Form> {
        let v = self.bottom.as_number()?;
        Some(Form::default().plus(&self.top, 1.0 / v))
    }
}

/// The derivative of powers by a variable: lowered by one, and what that is multiplied by.
fn lowered(powers: &Powers, by: u16) -> Option<(Powers, f64)> {
    let n = powers.iter().find(|p| p.0 == by)?.1;
    let lower = |&(k, m): &(u16, u16)| (k, if k == by { m - 1 } else { m });
    let out = powers.iter().map(lower).filter(|p| p.1 > 0).collect();
    Some((out, f64::from(n)))
}

fn product(a: &Powers, b: &Powers) -> Powers {
    let mut out = a.clone();
    for &(k, n) in b {
        match out.iter_mut().find(|p| p.0 == k) {
            Some(known) => known.1 += n,
            None => out.push((k, n)),
        }
    }
    out.sort_unstable();
    out
}

fn sum(a: &Exponent, b: &Exponent) -> Exponent {
    let mut out = a.clone();
    for (powers, bits) in b {
        match out.iter_mut().find(|p| p.0 == *powers) {
            Some(known) => {
                let (x, y) = (f64::from_bits(known.1), f64::from_bits(*bits));
                let is_none = (x + y).abs() <= ROUNDINGS * x.abs().max(y.abs());
                known.1 = if is_none { 0 } else { rounded(x + y) };
            }
            None => out.push((powers.clone(), *bits)),
        }
    }
    out.retain(|p| p.1 != 0);
    out.sort_unstable();
    out
}

/// The bits of a number to 40 places.
fn rounded(v: f64) -> u64 {
    const BELOW: u64 = 1 << 12;
    (v.to_bits() + BELOW / 2) & !(BELOW - 1)
}
