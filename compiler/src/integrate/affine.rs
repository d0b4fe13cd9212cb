//! Powers, logarithms and other functions of what changes evenly, alone and beside polynomials.
//!
//! x = x_m + β s, w = β h, x₀ and x₁ the values at the ends, L the length.

use super::algebraic::{MAX_DEGREE_BESIDE_POWER, NEAR_NODES};
use super::arithmetic::{add, call, if_less, mul, scale, square, total};
use super::exponential::NEAR;
use super::legendre::nodes_for_exponential;
use super::pair::Pair;
use super::quadratic::Affine;
use super::rule::Rule;
use super::term::Factor;
use super::{Integrator, Problem};
use crate::ir::{Id, Prim};

/// The most that a logarithm of a ratio is taken to be: beyond it, its exponential is 0.
const FAR: f64 = 1e6;
/// Below it a number counts as 0 where its logarithm is multiplied by 0.
const TINY: f64 = 1e-37;

/// An affine function that is not negative in the middle.
#[derive(Clone, Copy)]
struct Upright {
    zero: Id,
    mid: Id,
    /// Half the difference of the ends.
    growth: Id,
    /// |growth|
    size: Id,
    ends: [Id; 2],
    /// The lesser end, mid - |growth|.
    least: Id,
}

impl Integrator<'_> {
    /// ∫ of a polynomial times a power of x.
    pub(super) fn affine_power(
        &mut self,
        source: Id,
        polynomials: &[Id],
        base: Id,
        exponent: Id,
    ) -> Result<(Id, Rule), Problem> {
        let degree = self.polynomial_degree(polynomials);
        if degree > MAX_DEGREE_BESIDE_POWER {
            return Err(self.bound_beside(source));
        }
        let x = self.affine(base);
        if degree == 0 {
            return Ok((self.power_of_affine(x, exponent), Rule::AffinePower));
        }
        let far = self.around_zero(polynomials, degree, x, |this, k| {
            let raised = this.g.real(f64::from(k));
            let exponent = add(this.g, exponent, raised);
            this.power_of_affine(x, exponent)
        });
        let integrand = self.beside(polynomials, Factor::Power(base, exponent));
        Ok((
            self.near_zero_or(x, integrand, degree, far),
            Rule::AffinePower,
        ))
    }

    /// ∫ of a polynomial times log x.
    pub(super) fn affine_log(
        &mut self,
        source: Id,
        polynomials: &[Id],
        base: Id,
    ) -> Result<(Id, Rule), Problem> {
        let degree = self.polynomial_degree(polynomials);
        if degree > MAX_DEGREE_BESIDE_POWER {
            return Err(self.bound_beside(source));
        }
        let x = self.affine(base);
        let far = self.around_zero(polynomials, degree, x, |this, k| this.log_moment(x, k));
        let integrand = self.beside(polynomials, Factor::Log(base));
        Ok((
            self.near_zero_or(x, integrand, degree, far),
            Rule::AffineLog,
        ))
    }

    /// L X^p φ((p + 1) λ)/φ(λ) with X the end that is greater in size, λ = log1p(-2|w|/|X|) the logarithm of the
    /// ratio of both ends and φ(y) = (e^y - 1)/y: one formula for every exponent, -1 included.
    fn power_of_affine(&mut self, x: Affine, exponent: Id) -> Id {
        let w = mul(self.g, x.slope, self.path.half);
        let upright = self.upright(x, w);
        let top = if_less(
            self.g,
            upright.growth,
            upright.zero,
            upright.ends[0],
            upright.ends[1],
        );
        let top = call(self.g, Prim::Abs, top);
        let ratio = self.g.div(upright.size, top);
        let [w, mid] = [w, x.mid].map(|v| call(self.g, Prim::Abs, v));
        let ratio = scale(self.g, -2.0, ratio);
        let all = self.g.real(-1.0);
        let ratio = self.g.apply(Prim::Max, &[ratio, all]);
        let log = call(self.g, Prim::Log1p, ratio);
        // between ends of different size the ratio of both, which the difference from 1 would round
        let small = if_less(
            self.g,
            upright.growth,
            upright.zero,
            upright.ends[1],
            upright.ends[0],
        );
        let part = self.g.div(small, top);
        let part = self.g.apply(Prim::Max, &[part, upright.zero]);
        let (half, whole) = (self.g.real(0.5), call(self.g, Prim::Log, part));
        let log = if_less(self.g, part, half, whole, log);
        let least = self.g.real(-FAR);
        let log = self.g.apply(Prim::Max, &[log, least]);
        let one = self.g.real(1.0);
        let raised = add(self.g, exponent, one);
        let scaled = mul(self.g, raised, log);
        let (above, below) = (
            call(self.g, Prim::Exprel, scaled),
            call(self.g, Prim::Exprel, log),
        );
        let size = Factor::Power(top, exponent).expression(self.g);
        let ratio = self.g.div(above, below);
        let mean = mul(self.g, size, ratio);
        let signed = self.with_sign(x.mid, exponent, mean);
        let through = self.through_zero(x, exponent);
        // an end that is beyond 0 by a rounding is at 0
        let beyond = scale(self.g, 1.0 + 1e-6, mid);
        let mean = if_less(self.g, beyond, w, through, signed);
        let length = self.length_of_path();
        mul(self.g, length, mean)
    }

    /// The mean of x^p where x changes its sign: of a constant exponent, which is negative or no whole number,
    /// infinite for even p, NaN for others; else (x₁^p x₁ - x₀^p x₀)/(2 w (p + 1)), where nothing cancels but what
    /// has two signs.
    fn through_zero(&mut self, x: Affine, exponent: Id) -> Id {
        if let Some(p) = self.g.as_real(exponent) {
            let is_even = p.rem_euclid(2.0) == 0.0;
            return self.g.real(if is_even { f64::INFINITY } else { f64::NAN });
        }
        let ends = x.ends.map(|end| {
            let power = self.g.apply(Prim::Pow, &[end, exponent]);
            self.g.mul(end, power)
        });
        let difference = self.g.sub(ends[1], ends[0]);
        let (one, w) = (self.g.real(1.0), mul(self.g, x.slope, self.path.half));
        let raised = self.g.add(exponent, one);
        let width = scale(self.g, 2.0, w);
        let bottom = self.g.mul(width, raised);
        self.g.div(difference, bottom)
    }

    /// The sign of x^p for x < 0: that of a whole p, NaN of another.
    pub(super) fn with_sign(&mut self, mid: Id, exponent: Id, value: Id) -> Id {
        let zero = self.g.real(0.0);
        match self.g.as_real(exponent) {
            Some(p) if p.fract() == 0.0 && p.rem_euclid(2.0) == 0.0 => value,
            Some(p) if p.fract() == 0.0 => {
                let back = self.g.neg(value);
                if_less(self.g, mid, zero, back, value)
            }
            Some(_) => {
                let nan = self.g.real(f64::NAN);
                if_less(self.g, mid, zero, nan, value)
            }
            None => {
                let minus = self.g.real(-1.0);
                let sign = self.g.apply(Prim::Pow, &[minus, exponent]);
                let turned = self.g.mul(sign, value);
                if_less(self.g, mid, zero, turned, value)
            }
        }
    }

    /// Σ p⁽ᵏ⁾/(k! βᵏ) at the zero of x, times moments ∫ xᵏ f(x).
    fn around_zero(
        &mut self,
        polynomials: &[Id],
        degree: u32,
        x: Affine,
        mut moment: impl FnMut(&mut Self, u32) -> Id,
    ) -> Id {
        let ratio = self.g.div(x.mid, x.slope);
        let foot = self.g.sub(self.path.middle, ratio);
        let low = self.pair_at(x.of, foot).total(self.g);
        let low = self.g.div(low, x.slope);
        let low = self.g.neg(low);
        let coefficients = self.taylor(polynomials, degree, foot, low);
        let mut parts = Vec::new();
        for (k, c) in (0_u32..).zip(coefficients) {
            let power = self
                .g
                .apply(Prim::PowInt(i32::try_from(k).unwrap_or(0)), &[x.slope]);
            let c = self.g.div(c, power);
            let value = moment(self, k);
            parts.push(mul(self.g, c, value));
        }
        total(self.g, parts)
    }

    /// Nodes of the integrand where |w| < |x_m|/2, so that the zero of x is twice as far as the ends.
    fn near_zero_or(&mut self, x: Affine, integrand: Id, degree: u32, far: Id) -> Id {
        let near = self.local_gauss(integrand, NEAR_NODES + degree.div_ceil(2) as usize);
        let w = mul(self.g, x.slope, self.path.half);
        let [w, mid] = [w, x.mid].map(|v| call(self.g, Prim::Abs, v));
        let limit = scale(self.g, 0.5, mid);
        if_less(self.g, w, limit, near, far)
    }

    /// x and p of x^p log x, for a known p other than -1.
    pub(super) fn power_by_log(&mut self, factors: &[Factor]) -> Option<(Id, f64)> {
        let (&[Factor::Power(x, p), Factor::Log(y)] | &[Factor::Log(y), Factor::Power(x, p)]) =
            factors
        else {
            return None;
        };
        let p = self.g.as_real(p).filter(|p| p.is_finite() && *p != -1.0)?;
        (x == y && self.degree(x) == Some(1)).then_some((x, p))
    }

    /// ∫ x^p log x = [x^(p + 1) (log x - 1/(p + 1))]/((p + 1) β), nodes on short intervals.
    pub(super) fn affine_power_by_log(&mut self, base: Id, p: f64) -> Id {
        let x = self.affine(base);
        let exponent = self.g.real(p);
        let [power, log] = [Factor::Power(base, exponent), Factor::Log(base)]
            .map(|factor| factor.expression(self.g));
        let integrand = mul(self.g, power, log);
        let floor = self.g.real(TINY);
        let ends = x.ends.map(|end| {
            // what is below 0 by a rounding is 0; NaN stays NaN
            let rounding = scale(self.g, 1e-6, x.mid);
            let size = call(self.g, Prim::Abs, end);
            let least = self.g.apply(Prim::Max, &[size, floor]);
            let inner = if_less(self.g, size, rounding, least, end);
            let log = call(self.g, Prim::Log, inner);
            let shift = self.g.real(1.0 / (p + 1.0));
            let rest = self.g.sub(log, shift);
            let raised = self.g.real(p + 1.0);
            let power = Factor::Power(inner, raised).expression(self.g);
            mul(self.g, power, rest)
        });
        let difference = self.g.sub(ends[1], ends[0]);
        let rate = scale(self.g, p + 1.0, x.slope);
        let far = self.g.div(difference, rate);
        self.near_zero_or(x, integrand, 0, far)
    }

    /// ∫ xᵏ log x = [xᵏ⁺¹ (log x - 1/(k + 1))]/((k + 1) β).
    fn log_moment(&mut self, x: Affine, k: u32) -> Id {
        let order = f64::from(k) + 1.0;
        let floor = self.g.real(TINY);
        let ends = x.ends.map(|end| {
            // what is below 0 by a rounding is 0; NaN stays NaN
            let rounding = scale(self.g, 1e-6, x.mid);
            let rounding = self.g.apply(Prim::Max, &[rounding, floor]);
            let size = call(self.g, Prim::Abs, end);
            let least = self.g.apply(Prim::Max, &[size, floor]);
            let inner = if_less(self.g, size, rounding, least, end);
            let log = call(self.g, Prim::Log, inner);
            let shift = self.g.real(1.0 / order);
            let rest = self.g.sub(log, shift);
            let power = self
                .g
                .apply(Prim::PowInt(i32::try_from(k + 1).unwrap_or(1)), &[end]);
            mul(self.g, power, rest)
        });
        let difference = self.g.sub(ends[1], ends[0]);
        let rate = scale(self.g, order, x.slope);
        self.g.div(difference, rate)
    }

    /// ∫ of functions of the table that have an elementary antiderivative, of x.
    pub(super) fn function(&mut self, factors: &[Factor]) -> Option<(Id, Rule)> {
        match *factors {
            [Factor::Function(Prim::Sech, x)] => Some((self.hyperbolic_secant(x), Rule::Bell)),
            [
                Factor::Function(Prim::Sech, x),
                Factor::Function(Prim::Sech, y),
            ] if x == y => Some((self.square_of_secant(x), Rule::Bell)),
            [Factor::Function(Prim::Erfc, x)] => Some((self.complementary(x), Rule::Sigmoidal)),
            [Factor::Function(prim, x)] => Some((self.sigmoidal(prim, x), Rule::Sigmoidal)),
            [Factor::Logistic(x)] => Some((self.logistic(x), Rule::Logistic)),
            _ => None,
        }
    }

    /// x or -x, whichever is not negative in the middle, with w = x' h. One comparison chooses the sign and one the lesser
    /// end, so that derivatives are right where both ends are the same.
    fn upright(&mut self, x: Affine, w: Id) -> Upright {
        let zero = self.g.real(0.0);
        let [mid, growth, low, high] = [x.mid, w, x.ends[0], x.ends[1]].map(|v| {
            let back = self.g.neg(v);
            if_less(self.g, x.mid, zero, back, v)
        });
        let falling = self.g.neg(growth);
        Upright {
            zero,
            mid,
            growth,
            size: if_less(self.g, growth, zero, falling, growth),
            ends: [low, high],
            least: if_less(self.g, growth, zero, high, low),
        }
    }

    /// ∫ sech x = L atan(w y)/w, y = (sinh w/w)/cosh x_m: the difference of two Gudermannians as one angle.
    fn hyperbolic_secant(&mut self, of: Id) -> Id {
        let x = self.affine(of);
        let w = mul(self.g, x.slope, self.path.half);
        let upright = self.upright(x, w);
        let (w, mid) = (upright.size, upright.mid);
        // y = 2 e^(|w| - |x_m|) φ(-2|w|)/(1 + e^(-2|x_m|))
        let difference = self.g.neg(upright.least);
        let size = call(self.g, Prim::Exp, difference);
        let (wide, steep) = (scale(self.g, -2.0, w), scale(self.g, -2.0, mid));
        let quotient = call(self.g, Prim::Exprel, wide);
        let tail = call(self.g, Prim::Exp, steep);
        let one = self.g.real(1.0);
        let base = self.g.add(one, tail);
        let top = mul(self.g, size, quotient);
        let top = scale(self.g, 2.0, top);
        let y = self.g.div(top, base);
        let product = mul(self.g, w, y);
        let z = square(self.g, product);
        let inner = self.g.apply(Prim::AtanQuotient(0), &[z]);
        let near = mul(self.g, y, inner);
        let angle = call(self.g, Prim::Atan, product);
        let far = self.g.div(angle, w);
        let mean = if_less(self.g, w, one, near, far);
        let length = self.length_of_path();
        mul(self.g, length, mean)
    }

    /// ∫ sech² x = L sinhc(2w)/(cosh x₀ cosh x₁), the exponents taken together.
    fn square_of_secant(&mut self, of: Id) -> Id {
        let x = self.affine(of);
        let w = mul(self.g, x.slope, self.path.half);
        let upright = self.upright(x, w);
        let (w, zero) = (upright.size, upright.zero);
        let sizes = upright.ends.map(|end| {
            let size = call(self.g, Prim::Abs, end);
            if_less(self.g, upright.least, zero, size, end)
        });
        // 2|w| - |x₀| - |x₁| is 0 where x changes its sign, else -2 times the lesser of both
        let beside = scale(self.g, -2.0, upright.least);
        let exponent = if_less(self.g, upright.least, zero, zero, beside);
        let size = call(self.g, Prim::Exp, exponent);
        // what the lesser end is rounded by
        let rests = self.pair_at_ends(of).map(|end| end.rest);
        let rest = if_less(self.g, upright.growth, zero, rests[1], rests[0]);
        let turned = self.g.neg(rest);
        let rest = if_less(self.g, x.mid, zero, turned, rest);
        let rest = scale(self.g, -2.0, rest);
        let rest = if_less(self.g, upright.least, zero, zero, rest);
        let wide = scale(self.g, -4.0, w);
        let quotient = call(self.g, Prim::Exprel, wide);
        let quotient = self.grown(quotient, rest);
        let mut value = mul(self.g, size, quotient);
        value = scale(self.g, 4.0, value);
        let one = self.g.real(1.0);
        for end in sizes {
            let steep = scale(self.g, -2.0, end);
            let tail = call(self.g, Prim::Exp, steep);
            let base = self.g.add(one, tail);
            value = self.g.div(value, base);
        }
        let length = self.length_of_path();
        mul(self.g, length, value)
    }

    /// ∫ of tanh, atan, asinh, erf: the difference of their antiderivatives where the interval is at least a half
    /// long, or half as long as the singularities are far; nodes of the function elsewhere.
    fn sigmoidal(&mut self, prim: Prim, of: Id) -> Id {
        let x = self.affine(of);
        let ends = x.ends.map(|end| self.antiderivative(prim, end));
        let difference = self.g.sub(ends[1], ends[0]);
        let far = self.g.div(difference, x.slope);
        let function = call(self.g, prim, of);
        let w = mul(self.g, x.slope, self.path.half);
        let w = call(self.g, Prim::Abs, w);
        let (limit, nodes) = match prim {
            Prim::Atan | Prim::Asinh => {
                let one = self.g.real(1.0);
                let distance = self.g.apply(Prim::Hypot, &[one, x.mid]);
                (scale(self.g, 0.5, distance), NEAR_NODES)
            }
            _ => (self.g.real(0.5), nodes_for_exponential(2.0, 0, NEAR)),
        };
        let near = self.local_gauss(function, nodes);
        if_less(self.g, w, limit, near, far)
    }

    fn antiderivative(&mut self, prim: Prim, x: Id) -> Id {
        let one = self.g.real(1.0);
        match prim {
            // log cosh x = |x| + log1p(e^(-2|x|)) - log 2
            Prim::Tanh => {
                let size = call(self.g, Prim::Abs, x);
                let steep = scale(self.g, -2.0, size);
                let tail = call(self.g, Prim::Log1pExp, steep);
                self.g.add(size, tail)
            }
            Prim::Atan => {
                let value = call(self.g, Prim::Atan, x);
                let product = mul(self.g, x, value);
                let size = self.g.apply(Prim::Hypot, &[one, x]);
                let log = call(self.g, Prim::Log, size);
                self.g.sub(product, log)
            }
            Prim::Asinh => {
                let value = call(self.g, Prim::Asinh, x);
                let product = mul(self.g, x, value);
                let size = self.g.apply(Prim::Hypot, &[one, x]);
                self.g.sub(product, size)
            }
            _ => {
                let value = call(self.g, Prim::Erf, x);
                let product = mul(self.g, x, value);
                let bell = call(self.g, Prim::Gauss, x);
                let bell = scale(self.g, std::f64::consts::FRAC_2_SQRT_PI / 2.0, bell);
                self.g.add(product, bell)
            }
        }
    }

    /// ∫ 1/(1 + e^-x) = L (log(1 + e^x₁) - log(1 + e^x₀))/(x₁ - x₀), for close ends by the logistic function of the
    /// lower one: L σ φ(δ) log1p(σ expm1 δ)/(σ expm1 δ) with δ = 2|w|.
    fn logistic(&mut self, of: Id) -> Id {
        let x = self.affine(of);
        let w = mul(self.g, x.slope, self.path.half);
        let (zero, falling) = (self.g.real(0.0), self.g.neg(w));
        let sides = self.pair_at_ends(of);
        let [low, high] = [0, 1].map(|k| Pair::if_less(self.g, w, zero, sides[1 - k], sides[k]));
        let w = if_less(self.g, w, zero, falling, w);
        // log(1 + e^x) = max(x, 0) + log(1 + e^-|x|): what is large in it is the width of the part right of 0. Left of 0 it is
        // an exponential, which the rest of its exponent changes by that
        let [from, to] = [low, high].map(|end| {
            let size = call(self.g, Prim::Abs, end.value);
            let fall = self.g.neg(size);
            let value = call(self.g, Prim::Log1pExp, fall);
            let rest = if_less(self.g, end.value, zero, end.rest, zero);
            self.grown(value, rest)
        });
        let width = scale(self.g, 2.0, w);
        let right = self.g.apply(Prim::Max, &[high.value, zero]);
        let right = if_less(self.g, low.value, zero, right, width);
        let difference = self.g.sub(to, from);
        let sum = self.g.add(right, difference);
        let far = self.g.div(sum, width);
        let one = self.g.real(1.0);
        let turned = self.g.neg(low.value);
        let fall = call(self.g, Prim::Exp, turned);
        let base = self.g.add(one, fall);
        let value = self.g.div(one, base);
        let beside = self.g.sub(one, value);
        let rest = mul(self.g, beside, low.rest);
        let value = self.grown(value, rest);
        let growth = call(self.g, Prim::Expm1, width);
        let inner = mul(self.g, value, growth);
        let (quotient, log) = (
            call(self.g, Prim::Exprel, width),
            call(self.g, Prim::Log1pRel(0), inner),
        );
        let near = mul(self.g, value, quotient);
        let near = mul(self.g, near, log);
        let mean = if_less(self.g, width, one, near, far);
        let length = self.length_of_path();
        mul(self.g, length, mean)
    }
}
