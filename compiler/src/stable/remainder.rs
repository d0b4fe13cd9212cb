//! What is left of a function when the first terms of its Taylor series are taken away.

use super::guard::{choose, is_real, within};
use super::pass::Pass;
use super::polynomial::{Expand, Polynomial};
use super::rule::Rule;
use crate::ir::{Graph, Id, Prim};

/// The rest of a series: a^first Σ c_k a^(step k), with the sum of the terms before it.
struct Series {
    first: i32,
    step: i32,
    coefficients: [f64; 9],
}

impl Pass {
    /// The sum with the first terms of the series of one of its functions and that function put together.
    pub(super) fn remainder(&mut self, g: &mut Graph, p: &Polynomial) -> Option<Polynomial> {
        if !self.on(Rule::Remainder) {
            return None;
        }
        for (monomial, value) in &p.terms {
            let Some(u) = super::pass::only_atom(monomial) else {
                continue;
            };
            let (Some(f), &[a]) = self.view(g, u) else {
                continue;
            };
            if !has_series(f) || !is_real(g, u) {
                continue;
            }
            let Some(leading) = self.leading(g, f, a) else {
                continue;
            };
            let mut function = Polynomial::default();
            function.terms.push((monomial.clone(), 1.0));
            // p - value f + value (first terms) must have lost all of these
            let without = p.clone().add(&function, -value)?;
            let Some(rest) = without.add(&leading, *value) else {
                continue;
            };
            if rest.terms.len() + leading.terms.len() + 1 != p.terms.len() {
                continue;
            }
            let written = {
                let first = super::polynomial::build(g, &leading.terms);
                g.sub(u, first)
            };
            let new = rest_of_series(g, f, a, written)?;
            let out = Polynomial {
                terms: rest.terms,
                ..Polynomial::default()
            };
            let out = out.add(&Polynomial::atom(new), *value)?;
            return self.by(Rule::Remainder, out);
        }
        None
    }

    /// The first terms of the series of f(a).
    fn leading(&self, g: &Graph, f: Prim, a: Id) -> Option<Polynomial> {
        let a = self.polynomial(g, a, Expand::Constants)?;
        match f {
            Prim::Exp => Polynomial::one().add(&a, 1.0),
            Prim::Cos => Polynomial::one().add(&a.mul(&a)?, -0.5),
            Prim::Cosh => Polynomial::one().add(&a.mul(&a)?, 0.5),
            _ => Some(a),
        }
    }
}

fn has_series(f: Prim) -> bool {
    matches!(
        f,
        Prim::Sin | Prim::Sinh | Prim::Exp | Prim::Expm1 | Prim::Cos | Prim::Cosh | Prim::Tan
    )
}

/// The rest of the series of f(a) where |a| < 1, else what is written.
fn rest_of_series(g: &mut Graph, f: Prim, a: Id, written: Id) -> Option<Id> {
    let near = match f {
        // tan a - a = (sin a - a cos a)/cos a
        Prim::Tan => {
            let rest = sum(g, &sine_less_cosine(), a);
            let cos = g.apply(Prim::Cos, &[a]);
            g.div(rest, cos)
        }
        Prim::Sin => sum(g, &factorials(3, 2, -1.0, -1.0), a),
        Prim::Sinh => sum(g, &factorials(3, 2, 1.0, 1.0), a),
        Prim::Cos => sum(g, &factorials(4, 2, 1.0, -1.0), a),
        Prim::Cosh => sum(g, &factorials(4, 2, 1.0, 1.0), a),
        Prim::Exp | Prim::Expm1 => exponential_rest(g, a),
        _ => return None,
    };
    let condition = within(g, a, 1.0);
    Some(choose(g, condition, near, written))
}

/// Σ start · sign^k a^(first + step k)/(first + step k)!
fn factorials(first: i32, step: i32, start: f64, sign: f64) -> Series {
    let mut coefficients = [0.0; 9];
    let mut value = start;
    for n in 2..=first {
        value /= f64::from(n);
    }
    let mut n = first;
    for slot in &mut coefficients {
        *slot = value;
        for _ in 0..step {
            n += 1;
            value /= f64::from(n);
        }
        value *= sign;
    }
    Series {
        first,
        step,
        coefficients,
    }
}

/// sin a - a cos a = Σ (-1)^k 2(k+1) a^(2k+3)/(2k+3)!
fn sine_less_cosine() -> Series {
    let mut series = factorials(3, 2, 1.0, -1.0);
    let mut factor = 2.0;
    for slot in &mut series.coefficients {
        *slot *= factor;
        factor += 2.0;
    }
    series
}

/// exp a - 1 - a = a²/2 + … of 17 terms, in two interleaved series, so that the sum is short.
fn exponential_rest(g: &mut Graph, a: Id) -> Id {
    let (even, odd) = (
        sum(g, &factorials(2, 2, 1.0, 1.0), a),
        sum(g, &factorials(3, 2, 1.0, 1.0), a),
    );
    g.add(even, odd)
}

/// The sum by Horner's rule.
fn sum(g: &mut Graph, series: &Series, a: Id) -> Id {
    let z = g.apply(Prim::PowInt(series.step), &[a]);
    let mut out: Option<Id> = None;
    for &c in series.coefficients.iter().rev() {
        let c = g.real(c);
        out = Some(match out {
            Some(so_far) => {
                let product = g.mul(z, so_far);
                g.add(c, product)
            }
            None => c,
        });
    }
    let power = g.apply(Prim::PowInt(series.first), &[a]);
    let value = out.unwrap_or(power);
    g.mul(power, value)
}
