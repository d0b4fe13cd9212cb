//! What leaves the range of numbers on its way to a result that does not: quotients of powers and of sums of squares,
//! and the argument of an exponential.

use smallvec::SmallVec;

use super::Phase;
use super::guard::{choose, is_real, less};
use super::pass::Pass;
use super::polynomial::{Expand, Monomial, Polynomial, build, build_monomial, build_term};
use super::rule::Rule;
use crate::ir::{Graph, Id, Op, Prim};

/// Beyond this a sum of squares is scaled: 1 is nothing beside its square.
const LARGE: f64 = (1_u64 << 60) as f64;
/// The scale of large numbers: squares of float32 numbers do not overflow below it.
const DOWN: f64 = 1.0 / (1_u128 << 64) as f64;

/// Most nodes that are searched for what may be NaN.
const MAX_SEARCH: usize = 64;

/// Functions that overflow before their arguments do.
fn grows_fast(prim: Prim) -> bool {
    matches!(
        prim,
        Prim::Exp | Prim::Exp2 | Prim::Sinh | Prim::Cosh | Prim::Gamma | Prim::Pow
    )
}

impl Pass {
    /// A quotient whose numerator and divisor may leave the range where it does not.
    pub(super) fn in_range(&mut self, g: &mut Graph, n: Id, d: Id) -> Option<Id> {
        let found = self.reciprocal(g, n, d);
        let found = found.or_else(|| self.power_quotient(g, n, d));
        found.or_else(|| self.square_quotient(g, n, d))
    }

    /// c/cosh a = c·sech a for a constant c, and so on
    fn reciprocal(&mut self, g: &mut Graph, n: Id, d: Id) -> Option<Id> {
        let factor = g.as_real(n)?;
        let (Some(wave), &[a]) = self.view(g, d) else {
            return None;
        };
        let reciprocal = match wave {
            Prim::Cosh => Prim::Sech,
            Prim::Sinh => Prim::Csch,
            Prim::Cos if !is_real(g, a) => Prim::Sec,
            Prim::Sin if !is_real(g, a) => Prim::Csc,
            _ => return None,
        };
        if !self.on(Rule::Reciprocal) {
            return None;
        }
        let value = g.apply(reciprocal, &[a]);
        let new = super::guard::scaled(g, factor, value);
        self.by(Rule::Reciprocal, new)
    }

    /// aᵐ·b/aⁿ = aᵐ⁻ⁿ·b, of sums over one product, too
    fn power_quotient(&mut self, g: &mut Graph, n: Id, d: Id) -> Option<Id> {
        if !self.on(Rule::PowerQuotient) {
            return None;
        }
        let below = self.by_bases(g, d)?;
        let [(divisor, scale)] = below.terms.as_slice() else {
            return None;
        };
        let above = self.by_bases(g, n)?;
        if above.terms.is_empty() || above.cancelled > 0 || below.cancelled > 0 {
            return None;
        }
        let mut common = Monomial::new();
        let mut worth = false;
        for &(atom, power) in divisor {
            let powers = above.terms.iter().map(|(m, _)| power_of(m, atom));
            let shared = if power > 0 {
                powers.fold(power, |least, p| least.min(p.max(0)))
            } else {
                powers.fold(power, |most, p| most.max(p.min(0)))
            };
            if shared != 0 {
                common.push((atom, -shared));
                let fast = self.view(g, atom).0.is_some_and(grows_fast);
                worth |= fast || power.abs() > 1 || most_of(&above, atom) > 1;
            }
        }
        if !worth {
            return None;
        }
        let mut left = Polynomial::default();
        for (monomial, value) in &above.terms {
            left.terms.push((product(monomial, &common), *value));
        }
        let mut divisor = product(divisor, &common);
        if let [(monomial, _)] = left.terms.as_mut_slice() {
            // negative powers of the one term divide
            for &(atom, power) in monomial.iter().filter(|(_, power)| *power < 0) {
                divisor = times(&divisor, (atom, -power));
            }
            monomial.retain(|(_, power)| *power > 0);
        }
        self.lose_factors(g, &common, &left, &divisor);
        let quotient = self.over(g, left, &divisor, *scale);
        self.by(Rule::PowerQuotient, quotient)
    }

    /// A polynomial over a term.
    fn over(&mut self, g: &mut Graph, above: Polynomial, divisor: &Monomial, scale: f64) -> Id {
        if let ([(monomial, value)], true) = (above.terms.as_slice(), divisor.is_empty()) {
            let factor = value / scale;
            if factor * scale == *value && factor.mul_add(scale, -value) == 0.0 {
                return build_term(g, monomial, factor);
            }
        }
        let above = self.built(g, above, 4);
        let below = build_term(g, divisor, scale);
        g.div(above, below)
    }

    /// Reads a node as a polynomial in which powers are powers of their bases, and divisors negative ones.
    fn by_bases(&self, g: &Graph, id: Id) -> Option<Polynomial> {
        let p = self.polynomial(g, id, Expand::Constants)?;
        let mut out = Polynomial {
            cancelled: p.cancelled,
            ..Polynomial::default()
        };
        for (monomial, value) in &p.terms {
            let mut flat = Monomial::new();
            for &(atom, power) in monomial {
                let factor = match self.view(g, atom) {
                    (Some(Prim::PowInt(n)), &[base]) => (base, power.checked_mul(n)?),
                    _ => (atom, power),
                };
                flat = times(&flat, factor);
            }
            out.terms.push((flat, *value));
        }
        Some(out)
    }

    /// Notes the arguments of what has been cancelled and is nowhere else, so that their NaN is kept.
    fn lose_factors(
        &mut self,
        g: &Graph,
        common: &Monomial,
        left: &Polynomial,
        divisor: &Monomial,
    ) {
        for &(atom, _) in common {
            let stays = left.terms.iter().any(|(m, _)| power_of(m, atom) != 0);
            if stays || power_of(divisor, atom) != 0 {
                continue;
            }
            match self.view(g, atom) {
                (Some(f), args) if grows_fast(f) => {
                    let args: SmallVec<[Id; 2]> = args.into();
                    for arg in args.iter().flat_map(|&arg| witnesses(g, arg)) {
                        self.lose_atom(arg);
                    }
                }
                _ => self.lose_atom(atom),
            }
        }
    }

    /// b/(a² + c) = (b·s)/((a·s)² + c·s²)·s and d·a²/(a² + c) = d·(a·s)²/((a·s)² + c·s²), s = 2⁻⁶⁴ where |a| > 2⁶⁰, else 1
    fn square_quotient(&mut self, g: &mut Graph, n: Id, d: Id) -> Option<Id> {
        if !self.on(Rule::SquareQuotient) || !is_real(g, d) {
            return None;
        }
        let below = self.polynomial(g, d, Expand::Constants)?;
        let above = self.polynomial(g, n, Expand::Constants)?;
        if below.cancelled > 0 || above.cancelled > 0 || above.constant().is_some() {
            return None;
        }
        let mut sides: SmallVec<[Id; 4]> = SmallVec::new();
        for (monomial, value) in &below.terms {
            match monomial.as_slice() {
                // a difference may vanish, and has forms that are better where it does
                [] if *value > 0.0 && *value < LARGE => {}
                [(atom, 2)] if *value > 0.0 && is_real(g, *atom) => sides.push(*atom),
                _ => return None,
            }
        }
        if sides.is_empty() || below.terms.len() < 2 || sides.iter().any(|&a| is_scaled(g, a)) {
            return None;
        }
        let homogeneous = sides.len() == below.terms.len();
        let scales = Scales::of(g, &sides, homogeneous);
        let one = g.real(1.0);
        let scale = scales.times(g, one);
        let down: SmallVec<[(Id, Id); 4]> =
            sides.iter().map(|&a| (a, scales.times(g, a))).collect();
        let mut divisor = Polynomial::default();
        for (monomial, value) in &below.terms {
            let scaled = match monomial.as_slice() {
                [(atom, _)] => (small(&down, *atom)?, 2),
                _ => (scale, 2),
            };
            divisor
                .terms
                .push((Monomial::from_slice(&[scaled]), *value));
        }
        // a sum or difference of two sides is of their size
        let mut sized = down.clone();
        for &(atom, _) in above.terms.iter().flat_map(|(monomial, _)| monomial) {
            if joins_two(g, atom, &sides) && small(&sized, atom).is_none() {
                sized.push((atom, scales.times(g, atom)));
            }
        }
        let mut squares = Polynomial::default();
        let mut rest: SmallVec<[(Monomial, f64); 8]> = SmallVec::new();
        for (monomial, value) in &above.terms {
            match twice_scaled(&sized, monomial) {
                Some(scaled) => squares.terms.push((scaled, *value)),
                None => rest.push((monomial.clone(), *value)),
            }
        }
        let divisor = build(g, &divisor.terms);
        if squares.terms.is_empty() {
            let rest = Polynomial {
                terms: rest,
                ..Polynomial::default()
            };
            let above = self.built(g, rest, 4);
            let above = scales.times(g, above);
            let quotient = g.div(above, divisor);
            let new = g.mul(quotient, scale);
            return self.by(Rule::SquareQuotient, new);
        }
        for (monomial, value) in rest {
            let term = match build_monomial(g, &monomial) {
                Some(product) => {
                    let once = scales.times(g, product);
                    Monomial::from_slice(&[(once, 1), (scale, 1)])
                }
                None => Monomial::from_slice(&[(scale, 2)]),
            };
            squares.terms.push((term, value));
        }
        let above = self.built(g, squares, 4);
        let new = g.div(above, divisor);
        self.by(Rule::SquareQuotient, new)
    }

    /// arg exp z = im z, reduced to (-π, π]
    pub(super) fn arg_of(&mut self, g: &mut Graph, a: Id) -> Option<Id> {
        let z = self.argument(g, a, Prim::Exp)?;
        if is_real(g, z) || !self.on(Rule::ArgExp) {
            return None;
        }
        let new = reduced_angle(g, z);
        self.by(Rule::ArgExp, new)
    }

    /// log exp z = re z + i·arg exp z; only of what is computed, because it hides that this is holomorphic.
    pub(super) fn log_of_exp(&mut self, g: &mut Graph, z: Id) -> Option<Id> {
        if is_real(g, z) || !self.on(Rule::ArgExp) || self.phase == Phase::Early {
            return None;
        }
        let (re, angle) = (g.apply(Prim::Re, &[z]), reduced_angle(g, z));
        let new = g.apply(Prim::Complex, &[re, angle]);
        self.by(Rule::ArgExp, new)
    }
}

/// The imaginary part of a complex number in (-π, π], NaN where the real part is.
fn reduced_angle(g: &mut Graph, z: Id) -> Id {
    let (re, im) = (g.apply(Prim::Re, &[z]), g.apply(Prim::Im, &[z]));
    let (sin, cos) = (g.apply(Prim::Sin, &[im]), g.apply(Prim::Cos, &[im]));
    let angle = g.apply(Prim::Atan2, &[sin, cos]);
    let is_number = g.apply(Prim::Equal, &[re, re]);
    choose(g, is_number, angle, re)
}

/// The scale of a sum of squares: 2⁻⁶⁴ where one of the numbers is large, 2⁶⁴ where all are small, else 1.
struct Scales {
    is_large: Id,
    /// Not where 1 is among the squares.
    is_small: Option<Id>,
}

impl Scales {
    fn of(g: &mut Graph, sides: &[Id], small_too: bool) -> Self {
        let sizes: SmallVec<[Id; 4]> = sides.iter().map(|&a| g.apply(Prim::Abs, &[a])).collect();
        let greatest = sizes[1..]
            .iter()
            .fold(sizes[0], |a, &b| g.apply(Prim::Max, &[a, b]));
        let large = g.real(LARGE);
        let least = g.real(LARGE.recip());
        Self {
            is_large: less(g, large, greatest),
            is_small: small_too.then(|| less(g, greatest, least)),
        }
    }

    /// A number times the scale: a choice, so that what is scaled is one number to the rules.
    fn times(&self, g: &mut Graph, a: Id) -> Id {
        let mut out = a;
        if let Some(is_small) = self.is_small {
            let up = super::guard::scaled(g, DOWN.recip(), a);
            out = choose(g, is_small, up, out);
        }
        let down = super::guard::scaled(g, DOWN, a);
        choose(g, self.is_large, down, out)
    }
}

/// Whether a number is one that [`Scales::times`] has made.
fn is_scaled(g: &Graph, id: Id) -> bool {
    let node = g.node(id);
    let (Op::Apply(Prim::Select), &[_, down, _]) = (node.op, node.args.as_slice()) else {
        return false;
    };
    let is_scale = |id: Id| g.as_real(id).is_some_and(|c| c.to_bits() == DOWN.to_bits());
    is_scale(down) || g.node(down).args.iter().any(|&factor| is_scale(factor))
}

/// What is NaN where a node is: the leaves below it where no operation between makes one of its own, else itself.
fn witnesses(g: &Graph, id: Id) -> SmallVec<[Id; 4]> {
    let mut leaves: SmallVec<[Id; 4]> = SmallVec::new();
    let mut stack = vec![id];
    for _ in 0..MAX_SEARCH {
        let Some(next) = stack.pop() else {
            return leaves;
        };
        let node = g.node(next);
        match node.op {
            Op::Apply(
                Prim::Add
                | Prim::Sub
                | Prim::Mul
                | Prim::Neg
                | Prim::Sin
                | Prim::Cos
                | Prim::Re
                | Prim::Im
                | Prim::Complex
                | Prim::Abs,
            ) => stack.extend(node.args.iter().copied()),
            Op::Apply(Prim::PowInt(n)) if n > 0 => stack.extend(node.args.iter().copied()),
            Op::Const(bits) if !f64::from_bits(bits).is_nan() => {}
            Op::Input(_) | Op::Param(_) | Op::Time | Op::Pixel => leaves.push(next),
            _ => break,
        }
    }
    SmallVec::from_slice(&[id])
}

/// Whether a node is a sum or difference of two of some others.
fn joins_two(g: &Graph, id: Id, others: &[Id]) -> bool {
    let node = g.node(id);
    matches!(node.op, Op::Apply(Prim::Add | Prim::Sub))
        && node.args.iter().all(|a| others.contains(a))
}

/// The scaled form of one of the numbers that are squared.
fn small(down: &[(Id, Id)], atom: Id) -> Option<Id> {
    down.iter().find(|(a, _)| *a == atom).map(|(_, s)| *s)
}

/// A monomial with two of its factors scaled, where it has two that are squared below.
fn twice_scaled(down: &[(Id, Id)], monomial: &Monomial) -> Option<Monomial> {
    let mut left = 2;
    let mut out = Monomial::new();
    for &(atom, power) in monomial {
        match small(down, atom) {
            Some(scaled) if left > 0 && power > 0 => {
                let taken = power.min(left);
                left -= taken;
                out.push((scaled, taken));
                if power > taken {
                    out.push((atom, power - taken));
                }
            }
            _ => out.push((atom, power)),
        }
    }
    out.sort_unstable();
    (left == 0).then_some(out)
}

/// The exponent of an atom, 0 where it is none of the factors.
fn power_of(monomial: &Monomial, atom: Id) -> i32 {
    monomial
        .iter()
        .find(|(a, _)| *a == atom)
        .map_or(0, |(_, power)| *power)
}

/// The greatest magnitude of an atom's exponent.
fn most_of(p: &Polynomial, atom: Id) -> i32 {
    let powers = p.terms.iter().map(|(m, _)| power_of(m, atom).abs());
    powers.max().unwrap_or(0)
}

/// A monomial times one more factor, of any degree.
fn times(monomial: &Monomial, (atom, power): (Id, i32)) -> Monomial {
    let mut out = monomial.clone();
    match out.iter_mut().find(|(a, _)| *a == atom) {
        Some(slot) => slot.1 = slot.1.saturating_add(power),
        None => out.push((atom, power)),
    }
    out.retain(|(_, power)| *power != 0);
    out.sort_unstable();
    out
}

/// The product of two monomials, of any degree.
fn product(a: &Monomial, b: &Monomial) -> Monomial {
    b.iter().fold(a.clone(), |out, &factor| times(&out, factor))
}
