//! Where the values of an expression are while its path's parameter is anywhere in a disc of the complex plane.
//!
//! Around the middle of the path the parameter t = m + z, |z| ≤ R, takes each operation to a disc: its centre is the
//! value at m, its radius is found from the discs of the operands by the inequality above each rule. The rules bound
//! the Taylor series of the operation by its absolute values, and hold where the disc of the operand has no singularity
//! of the operation in it; elsewhere the radius is infinite. What is piecewise is analytic where the disc decides its
//! conditions. All of it is IR: the bound is found again for each ray.
//!
//! Petkovic and Petkovic, Complex Interval Arithmetic and Its Applications, 1998, chapter 1, for discs.

use std::f64::consts::{FRAC_2_SQRT_PI, LN_2, LN_10};

use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use super::Integrator;
use super::arithmetic::{add, call, div, is_zero, mul, scale, square, sub, total};
use super::path::cone;
use crate::ir::{Graph, Id, Op, Prim, Ty};

/// Centre and radius. Of a truth value: itself in the centre, and whether the disc decides it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Disc {
    pub centre: Id,
    pub radius: Id,
}

impl Integrator<'_> {
    /// The disc of an expression while t is within `reach` of the middle of the path.
    ///
    /// # Errors
    /// The first operation that has no rule.
    pub(super) fn disc(&mut self, root: Id, reach: Id) -> Result<Disc, Id> {
        let mut known: FxHashMap<Id, Disc> = FxHashMap::default();
        for c in self.path.coordinates.clone() {
            let rate = call(self.g, Prim::Abs, c.slope);
            let radius = mul(self.g, rate, reach);
            let centre = c.mid;
            known.insert(c.leaf, Disc { centre, radius });
        }
        for id in cone(self.g, &[root]) {
            if known.contains_key(&id) {
                continue;
            }
            let disc = if self.moves(id) {
                self.disc_of_operation(id, &known).ok_or(id)?
            } else {
                let is_truth = self.g.ty(id) == Ty::Bool;
                let radius = if is_truth {
                    self.g.truth(true)
                } else {
                    self.g.real(0.0)
                };
                Disc { centre: id, radius }
            };
            known.insert(id, disc);
        }
        known.get(&root).copied().ok_or(root)
    }

    fn disc_of_operation(&mut self, id: Id, known: &FxHashMap<Id, Disc>) -> Option<Disc> {
        let node = self.g.node(id).clone();
        let Op::Apply(prim) = node.op else {
            return None;
        };
        let args: Option<SmallVec<[Disc; 3]>> =
            node.args.iter().map(|a| known.get(a).copied()).collect();
        let args = args?;
        if node.ty == Ty::Complex || node.args.iter().any(|&a| self.g.ty(a) == Ty::Complex) {
            return None;
        }
        let centres: SmallVec<[Id; 3]> = args.iter().map(|a| a.centre).collect();
        let centre = self.g.apply(prim, &centres);
        let radius = match *args.as_slice() {
            _ if node.ty == Ty::Bool => decided(self.g, prim, &args)?,
            [a] => of_one(self.g, prim, a, centre)?,
            [a, b] => of_two(self.g, prim, a, b, centre)?,
            [a, b, c] => of_three(self.g, prim, [a, b, c], centre)?,
            _ => return None,
        };
        Some(Disc { centre, radius })
    }
}

/// Whether the disc decides a condition: |a - b| > r_a + r_b.
fn decided(g: &mut Graph, prim: Prim, args: &[Disc]) -> Option<Id> {
    match (prim, args) {
        (Prim::Less | Prim::LessEqual | Prim::Equal | Prim::NotEqual, &[a, b]) => {
            Some(apart(g, a, b))
        }
        (Prim::And | Prim::Or, &[a, b]) => Some(g.apply(Prim::And, &[a.radius, b.radius])),
        (Prim::Not, &[a]) => Some(a.radius),
        _ => None,
    }
}

fn apart(g: &mut Graph, a: Disc, b: Disc) -> Id {
    let difference = g.sub(a.centre, b.centre);
    let distance = call(g, Prim::Abs, difference);
    let reach = add(g, a.radius, b.radius);
    g.apply(Prim::Less, &[reach, distance])
}

/// `then` where a < b, else ∞.
fn where_less(g: &mut Graph, a: Id, b: Id, then: Id) -> Id {
    let infinity = g.real(f64::INFINITY);
    super::arithmetic::if_less(g, a, b, then, infinity)
}

fn abs(g: &mut Graph, a: Id) -> Id {
    call(g, Prim::Abs, a)
}

/// -log(1 - r/d) where r < d.
fn log_of_part(g: &mut Graph, r: Id, d: Id) -> Id {
    let part = div(g, r, d);
    let part = g.neg(part);
    let log = call(g, Prim::Log1p, part);
    let log = g.neg(log);
    where_less(g, r, d, log)
}

/// r/(d (d - r)) where r < d: |1/(d + z) - 1/d|, and the integral of 1/(d - ρ)² from 0 to r.
fn of_reciprocal(g: &mut Graph, r: Id, d: Id) -> Id {
    let rest = sub(g, d, r);
    let bottom = mul(g, d, rest);
    let value = div(g, r, bottom);
    where_less(g, r, d, value)
}

#[allow(clippy::too_many_lines, reason = "one arm for each operation")]
fn of_one(g: &mut Graph, prim: Prim, a: Disc, centre: Id) -> Option<Id> {
    let (c, r) = (a.centre, a.radius);
    let size = abs(g, c);
    let value = abs(g, centre);
    let growth = call(g, Prim::Expm1, r);
    let one = g.real(1.0);
    Some(match prim {
        Prim::Neg => r,
        // |sin(c + z) - sin c| ≤ e^r - 1, and of what is a mean of such
        Prim::Sin | Prim::Cos | Prim::Sinc | Prim::SphericalJ(_) => growth,
        // e^c (e^r - 1)
        Prim::Exp | Prim::Expm1 | Prim::Exp2 => {
            let (power, growth) = if prim == Prim::Exp2 {
                let scaled = scale(g, LN_2, r);
                (centre, call(g, Prim::Expm1, scaled))
            } else {
                (call(g, Prim::Exp, c), growth)
            };
            mul(g, power, growth)
        }
        // cosh c (e^r - 1)
        Prim::Sinh | Prim::Cosh | Prim::Sinhc => {
            let top = call(g, Prim::Cosh, c);
            mul(g, top, growth)
        }
        // of a mean of e^(x u), 0 ≤ u ≤ 1
        Prim::Exprel => {
            let power = call(g, Prim::Exp, c);
            let top = g.apply(Prim::Max, &[power, one]);
            mul(g, top, growth)
        }
        // sinh r/(cos² c (1 - (e^r - 1)/|cos c|)), and sinh r/(cosh² c (1 - (e^r - 1)))
        Prim::Tan | Prim::Tanh => {
            let (bottom, change) = if prim == Prim::Tan {
                let bottom = call(g, Prim::Cos, c);
                (abs(g, bottom), growth)
            } else {
                let bottom = call(g, Prim::Cosh, c);
                (bottom, mul(g, bottom, growth))
            };
            let rest = sub(g, bottom, change);
            let product = mul(g, bottom, rest);
            let top = call(g, Prim::Sinh, r);
            let inside = div(g, top, product);
            where_less(g, change, bottom, inside)
        }
        Prim::Sec | Prim::Csc | Prim::Sech | Prim::Csch => {
            let under = match prim {
                Prim::Sec => Prim::Cos,
                Prim::Csc => Prim::Sin,
                Prim::Sech => Prim::Cosh,
                _ => Prim::Sinh,
            };
            let bottom = call(g, under, c);
            let bottom = abs(g, bottom);
            let change = if matches!(prim, Prim::Sec | Prim::Csc) {
                growth
            } else {
                let top = call(g, Prim::Cosh, c);
                mul(g, top, growth)
            };
            of_reciprocal(g, change, bottom)
        }
        // |√(c + z) - √c| = |z|/|√(c + z) + √c|
        Prim::Sqrt => {
            let inside = div(g, r, value);
            where_less(g, r, c, inside)
        }
        Prim::Cbrt => {
            let part = div(g, r, size);
            let inside = mul(g, value, part);
            where_less(g, r, size, inside)
        }
        Prim::Log => log_of_part(g, r, c),
        Prim::Log2 => {
            let inner = log_of_part(g, r, c);
            scale(g, 1.0 / LN_2, inner)
        }
        Prim::Log10 => {
            let inner = log_of_part(g, r, c);
            scale(g, 1.0 / LN_10, inner)
        }
        Prim::Log1p => {
            let base = g.add(one, c);
            log_of_part(g, r, base)
        }
        // the singularities of the derivative are at ±i, at the distance √(1 + c²)
        Prim::Atan => {
            let distance = g.apply(Prim::Hypot, &[one, c]);
            of_reciprocal(g, r, distance)
        }
        Prim::Asinh => {
            let distance = g.apply(Prim::Hypot, &[one, c]);
            log_of_part(g, r, distance)
        }
        Prim::Asin | Prim::Acos => {
            let distance = g.sub(one, size);
            log_of_part(g, r, distance)
        }
        Prim::Atanh => {
            let distance = g.sub(one, size);
            of_reciprocal(g, r, distance)
        }
        Prim::Acosh => {
            let distance = g.sub(c, one);
            log_of_part(g, r, distance)
        }
        // the derivative is e^(-x²) times 2/√π: -Re (c + z)² ≤ -c² + 2 |c| r + r²
        Prim::Erf | Prim::Erfc => {
            let (bell, spread) = (call(g, Prim::Gauss, c), spread(g, size, r));
            let spread = call(g, Prim::Exp, spread);
            let product = mul(g, bell, spread);
            let product = mul(g, r, product);
            scale(g, FRAC_2_SQRT_PI, product)
        }
        Prim::Gauss => {
            let spread = spread(g, size, r);
            let spread = call(g, Prim::Expm1, spread);
            mul(g, value, spread)
        }
        Prim::PowInt(n) => of_power(g, n, size, r, value),
        Prim::Abs => where_less(g, r, size, r),
        Prim::Sign => {
            let zero = g.real(0.0);
            where_less(g, r, size, zero)
        }
        Prim::Floor | Prim::Ceil | Prim::Trunc | Prim::Round | Prim::Fract => {
            let shifted = if prim == Prim::Round {
                let half = g.real(0.5);
                g.add(c, half)
            } else {
                c
            };
            let kept = if prim == Prim::Fract { r } else { g.real(0.0) };
            between_whole(g, shifted, r, kept)
        }
        Prim::Hash => {
            let (least, zero) = (g.real(f64::MIN_POSITIVE), g.real(0.0));
            where_less(g, r, least, zero)
        }
        _ => return None,
    })
}

/// 2 |c| r + r²
fn spread(g: &mut Graph, size: Id, r: Id) -> Id {
    let twice = scale(g, 2.0, size);
    let sum = add(g, twice, r);
    mul(g, r, sum)
}

/// (|c| + r)ⁿ - |c|ⁿ for n > 0, and the reciprocal of that disc.
fn of_power(g: &mut Graph, n: i32, size: Id, r: Id, value: Id) -> Id {
    let top = add(g, size, r);
    let power = n.saturating_abs();
    let [most, least] = [top, size].map(|v| g.apply(Prim::PowInt(power), &[v]));
    let change = g.sub(most, least);
    if n > 0 {
        return change;
    }
    let rest = g.sub(least, change);
    let part = div(g, change, rest);
    let inside = mul(g, value, part);
    where_less(g, change, least, inside)
}

/// A radius where no whole number is within r of c, else ∞.
fn between_whole(g: &mut Graph, c: Id, r: Id, kept: Id) -> Id {
    let (one, below) = (g.real(1.0), call(g, Prim::Fract, c));
    let above = g.sub(one, below);
    let distance = g.apply(Prim::Min, &[below, above]);
    where_less(g, r, distance, kept)
}

fn of_two(g: &mut Graph, prim: Prim, a: Disc, b: Disc, centre: Id) -> Option<Id> {
    let sizes = [a.centre, b.centre].map(|v| abs(g, v));
    Some(match prim {
        Prim::Add | Prim::Sub => add(g, a.radius, b.radius),
        // |c_a| r_b + |c_b| r_a + r_a r_b
        Prim::Mul => {
            let parts = [
                mul(g, sizes[0], b.radius),
                mul(g, sizes[1], a.radius),
                mul(g, a.radius, b.radius),
            ];
            total(g, parts)
        }
        // (r_a + |c_a/c_b| r_b)/(|c_b| - r_b)
        Prim::Div => {
            let value = abs(g, centre);
            let part = mul(g, value, b.radius);
            let top = add(g, a.radius, part);
            let bottom = sub(g, sizes[1], b.radius);
            let inside = div(g, top, bottom);
            if is_zero(g, b.radius) {
                return Some(inside);
            }
            where_less(g, b.radius, sizes[1], inside)
        }
        Prim::Min | Prim::Max => {
            let is_first = g.apply(Prim::Less, &[a.centre, b.centre]);
            let (first, second) = if prim == Prim::Min { (a, b) } else { (b, a) };
            let kept = g.apply(Prim::Select, &[is_first, first.radius, second.radius]);
            let infinity = g.real(f64::INFINITY);
            let apart = apart(g, a, b);
            g.apply(Prim::Select, &[apart, kept, infinity])
        }
        Prim::Hypot => of_length(g, &[a, b], centre),
        Prim::Pow => of_general_power(g, a, b, centre),
        Prim::Mod if is_zero(g, b.radius) => {
            let (quotient, part) = (g.div(a.centre, b.centre), g.div(a.radius, sizes[1]));
            between_whole(g, quotient, part, a.radius)
        }
        Prim::Hash => {
            let r = add(g, a.radius, b.radius);
            let (least, zero) = (g.real(f64::MIN_POSITIVE), g.real(0.0));
            where_less(g, r, least, zero)
        }
        _ => return None,
    })
}

/// |(c + z)^(p + w) - c^p| ≤ c^p (e^(|log c| r_p + (|p| + r_p) (-log(1 - r/c))) - 1)
fn of_general_power(g: &mut Graph, base: Disc, exponent: Disc, centre: Id) -> Id {
    let log = call(g, Prim::Log, base.centre);
    let log = abs(g, log);
    let first = mul(g, log, exponent.radius);
    let size = abs(g, exponent.centre);
    let size = add(g, size, exponent.radius);
    let change = if is_zero(g, base.radius) {
        base.radius
    } else {
        log_of_part(g, base.radius, base.centre)
    };
    let second = mul(g, size, change);
    let sum = add(g, first, second);
    let growth = call(g, Prim::Expm1, sum);
    let value = abs(g, centre);
    mul(g, value, growth)
}

/// Σ (2 |c| r + r²)/√(Σ c²) where that is less than Σ c² before the division: the root of the sum of squares.
fn of_length(g: &mut Graph, parts: &[Disc], centre: Id) -> Id {
    let changes: Vec<Id> = parts
        .iter()
        .map(|p| {
            let size = abs(g, p.centre);
            spread(g, size, p.radius)
        })
        .collect();
    let change = total(g, changes);
    let sum = square(g, centre);
    let inside = div(g, change, centre);
    where_less(g, change, sum, inside)
}

fn of_three(g: &mut Graph, prim: Prim, [a, b, c]: [Disc; 3], centre: Id) -> Option<Id> {
    match prim {
        Prim::Select => {
            let infinity = g.real(f64::INFINITY);
            let kept = g.apply(Prim::Select, &[a.centre, b.radius, c.radius]);
            Some(g.apply(Prim::Select, &[a.radius, kept, infinity]))
        }
        Prim::Hypot3 => Some(of_length(g, &[a, b, c], centre)),
        Prim::Hash => {
            let r = total(g, [a, b, c].map(|d| d.radius));
            let (least, zero) = (g.real(f64::MIN_POSITIVE), g.real(0.0));
            Some(where_less(g, r, least, zero))
        }
        _ => None,
    }
}
