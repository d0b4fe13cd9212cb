//! What closed forms of integrals along rays are made of: quotients that are continued through 0/0, spherical Bessel
//! functions, the error function and its kin.
//!
//! Families whose next member is the derivative of one: rules that cancel nowhere, whatever the order.

use naga::MathFunction;

use super::cardinal::{exprel_partial, horner};
use super::derivative::{call, plus, reciprocal, scaled};
use super::{Derivative, Gpu, Row, Typing, Weight};
use crate::ir::{Graph, Id, Op, Prim, Ty};
use crate::reference::{erf, rational, real};

/// The last member of the families of quotients and of erfcx that there is a function for.
pub const MAX_MOMENT: u8 = 7;
/// The last moment of a part of a Gaussian.
pub const MAX_MASS_MOMENT: u8 = 3;

pub fn rows() -> Vec<Row> {
    let rows = quotients().into_iter().chain(spherical());
    let rows = rows.chain(errors()).chain(masses());
    rows.chain(places()).collect()
}

fn weight(real: u16) -> Weight {
    Weight { real, complex: 0 }
}

fn quotients() -> [Row; 4] {
    [
        Row {
            prim: Prim::AtanQuotient(0),
            mnemonic: "atanq",
            names: &["atanq"],
            usage: "atanq(x)",
            doc: "atan(√x)/√x, continued through 1 at 0 to atanh(√-x)/√-x",
            typing: Typing::Real(1),
            real: Some(|a| rational::atan_quotient(0, a[0])),
            complex: None,
            derivative: Derivative::Partial(atan_quotient_partial),
            gpu: Gpu::Family("real_atan_quotient"),
            gpu_complex: "",
            cost: weight(24),
        },
        Row {
            prim: Prim::Atan2Quotient,
            mnemonic: "atan2q",
            names: &["atan2q"],
            usage: "atan2q(p, x)",
            doc: "atan2(√p, x)/√p, continued through p = 0: the integral of 1/(u² + p) from x to ∞",
            typing: Typing::Real(2),
            real: Some(|a| rational::atan2_quotient(a[0], a[1])),
            complex: None,
            derivative: Derivative::Partial(atan2_quotient_partial),
            gpu: Gpu::Library("real_atan2_quotient", None),
            gpu_complex: "",
            cost: weight(30),
        },
        Row {
            prim: Prim::Log1pRel(0),
            mnemonic: "log1prel",
            names: &["log1prel"],
            usage: "log1prel(a)",
            doc: "log(1 + a)/a, and 1 at 0",
            typing: Typing::Analytic(1),
            real: Some(|a| rational::log1prel(0, a[0])),
            complex: Some(|a| a[0].log1prel(0)),
            derivative: Derivative::Partial(log1prel_partial),
            gpu: Gpu::Family("real_log1prel"),
            gpu_complex: "complex_log1prel",
            cost: Weight {
                real: 14,
                complex: 46,
            },
        },
        Row {
            prim: Prim::Log1pExp,
            mnemonic: "log1pexp",
            names: &["log1pexp"],
            usage: "log1pexp(x)",
            doc: "log(1 + exp(x)) without overflow, the soft maximum of x and 0",
            typing: Typing::Real(1),
            real: Some(|a| real::log1pexp(a[0])),
            complex: None,
            derivative: Derivative::Partial(|g, args, _, _| sigmoid(g, args[0])),
            gpu: Gpu::Library("real_log1pexp", None),
            gpu_complex: "",
            cost: weight(20),
        },
    ]
}

fn spherical() -> [Row; 2] {
    [
        Row {
            prim: Prim::SphericalJ(0),
            mnemonic: "spherical_j",
            names: &[],
            usage: "",
            doc: "the spherical Bessel function jₙ",
            typing: Typing::Real(1),
            real: None,
            complex: None,
            derivative: Derivative::Partial(spherical_j_partial),
            gpu: Gpu::Family("real_spherical_j"),
            gpu_complex: "",
            cost: weight(40),
        },
        Row {
            prim: Prim::SphericalIScaled(0),
            mnemonic: "spherical_i_scaled",
            names: &[],
            usage: "",
            doc: "e^-|x| times the modified spherical Bessel function iₙ of the first kind",
            typing: Typing::Real(1),
            real: None,
            complex: None,
            derivative: Derivative::Partial(spherical_i_partial),
            gpu: Gpu::Family("real_spherical_i_scaled"),
            gpu_complex: "",
            cost: weight(40),
        },
    ]
}

fn errors() -> [Row; 6] {
    let one = |prim, name, usage, doc, real, derivative, gpu, cost| Row {
        prim,
        mnemonic: name,
        names: &[],
        usage,
        doc,
        typing: Typing::Real(1),
        real: Some(real),
        complex: None,
        derivative: Derivative::Partial(derivative),
        gpu,
        gpu_complex: "",
        cost: weight(cost),
    };
    let analytic = |row: Row| Row {
        typing: Typing::Analytic(1),
        gpu_complex: super::DEFINED,
        cost: Weight {
            complex: 800,
            ..row.cost
        },
        ..row
    };
    [
        analytic(Row {
            names: &["erf"],
            ..one(
                Prim::Erf,
                "erf",
                "erf(a)",
                "error function, 2/√π times the integral of exp(-u²) from 0 to a",
                |a: &[f64]| erf::erf(a[0]),
                |g, args, _, _| bell(g, std::f64::consts::FRAC_2_SQRT_PI, args[0]),
                Gpu::Library("real_erf", None),
                24,
            )
        }),
        analytic(Row {
            names: &["erfc"],
            ..one(
                Prim::Erfc,
                "erfc",
                "erfc(a)",
                "1 - erf(a), with all digits where it is small",
                |a: &[f64]| erf::erfc(a[0]),
                |g, args, _, _| bell(g, -std::f64::consts::FRAC_2_SQRT_PI, args[0]),
                Gpu::Library("real_erfc", None),
                30,
            )
        }),
        analytic(Row {
            names: &["erfcx"],
            ..one(
                Prim::Erfcx(0),
                "erfcx",
                "erfcx(a)",
                "exp(a²) erfc(a), which does not underflow",
                |a: &[f64]| erf::erfcx(0, a[0]),
                erfcx_partial,
                Gpu::Family("real_erfcx"),
                24,
            )
        }),
        one(
            Prim::Gauss,
            "gauss",
            "",
            "exp(-x²), with no error of the square",
            |a: &[f64]| erf::gauss(a[0]),
            |g, args, value, _| {
                let factor = scaled(g, -2.0, args[0]);
                g.mul(factor, value)
            },
            Gpu::Library("real_gauss", None),
            16,
        ),
        Row {
            typing: Typing::Real(2),
            ..one(
                Prim::GaussOfSum,
                "gauss_of_sum",
                "",
                "exp(-(x + y)²), with no error of the sum",
                |a: &[f64]| erf::gauss_of_sum(a[0], a[1]),
                |g, args, value, _| {
                    let sum = g.add(args[0], args[1]);
                    let factor = scaled(g, -2.0, sum);
                    g.mul(factor, value)
                },
                Gpu::Library("real_gauss_of_sum", None),
                20,
            )
        },
        Row {
            typing: Typing::Real(2),
            ..one(
                Prim::ExpOfProduct,
                "exp_of_product",
                "",
                "exp(x y), with no error of the product",
                |a: &[f64]| erf::exp_of_product(a[0], a[1]),
                |g, args, value, k| g.mul(args[1 - k], value),
                Gpu::Library("real_exp_of_product", None),
                20,
            )
        },
    ]
}

fn masses() -> [Row; 4] {
    [
        Row {
            prim: Prim::GaussMass,
            mnemonic: "gaussmass",
            names: &["gaussmass"],
            usage: "gaussmass(c, w)",
            doc: "the integral of exp(-u²) from c - w to c + w",
            typing: Typing::Real(2),
            real: Some(|a| erf::gauss_mass(a[0], a[1])),
            complex: None,
            derivative: Derivative::Partial(mass_partial),
            gpu: Gpu::Library("real_gauss_mass", None),
            gpu_complex: "",
            cost: weight(90),
        },
        Row {
            prim: Prim::GaussMassScaled,
            mnemonic: "gaussmassx",
            names: &["gaussmassx"],
            usage: "gaussmassx(c, w)",
            doc: "gaussmass(c, w) divided by the greatest exp(-u²) of the interval, which does not underflow",
            typing: Typing::Real(2),
            real: Some(|a| erf::gauss_mass_scaled(a[0], a[1])),
            complex: None,
            derivative: Derivative::Partial(scaled_mass_partial),
            gpu: Gpu::Library("real_gauss_mass_scaled", None),
            gpu_complex: "",
            cost: weight(80),
        },
        Row {
            prim: Prim::GaussMassMoment(1),
            mnemonic: "gauss_mass_moment",
            names: &[],
            usage: "",
            doc: "∫ (u - a)ᵏ exp(a² - u²) du over an interval right of 0 that begins at a",
            typing: Typing::Real(2),
            real: None,
            complex: None,
            derivative: Derivative::Partial(moment_partial),
            gpu: Gpu::Family("real_gauss_mass_moment"),
            gpu_complex: "",
            cost: weight(120),
        },
        Row {
            prim: Prim::SquarePlus,
            mnemonic: "square_plus",
            names: &[],
            usage: "",
            doc: "x² + p, rounded once",
            typing: Typing::Real(2),
            real: Some(|a| real::square_plus(a[0], a[1])),
            complex: None,
            derivative: Derivative::Partial(|g, args, _, k| match k {
                0 => scaled(g, 2.0, args[0]),
                _ => g.real(1.0),
            }),
            gpu: Gpu::Library("real_square_plus", None),
            gpu_complex: "",
            cost: weight(10),
        },
    ]
}

/// Places on a line.
fn places() -> [Row; 7] {
    [
        Row {
            prim: Prim::MulAdd,
            mnemonic: "fma",
            names: &[],
            usage: "",
            doc: "a b + c, rounded once where the adapter's fma is",
            typing: Typing::Real(3),
            real: Some(|a| a[0].mul_add(a[1], a[2])),
            complex: None,
            derivative: Derivative::Partial(|g, args, _, k| match k {
                0 => args[1],
                1 => args[0],
                _ => g.real(1.0),
            }),
            gpu: Gpu::Builtin(MathFunction::Fma),
            gpu_complex: "",
            cost: weight(2),
        },
        Row {
            prim: Prim::SumRest,
            mnemonic: "sum_rest",
            names: &[],
            usage: "",
            doc: "a + b - s exactly, where s is the rounded sum of a and b; 0 where that is no number: locally constant",
            typing: Typing::Real(3),
            real: Some(|a| real::sum_rest(a[0], a[1], a[2])),
            complex: None,
            derivative: Derivative::Zero,
            gpu: Gpu::Library("real_sum_rest", None),
            gpu_complex: "",
            cost: weight(8),
        },
        Row {
            prim: Prim::MulAddRest,
            mnemonic: "fma_rest",
            names: &[],
            usage: "",
            doc: "a b + c - s exactly, where s is that rounded; 0 where that is no number: locally constant",
            typing: Typing::Real(4),
            real: Some(|a| real::mul_add_rest([a[0], a[1], a[2]], a[3])),
            complex: None,
            derivative: Derivative::Zero,
            gpu: Gpu::Library("real_mul_add_rest", None),
            gpu_complex: "",
            cost: weight(11),
        },
        Row {
            prim: Prim::ProductRest,
            mnemonic: "product_rest",
            names: &[],
            usage: "",
            doc: "a b - p exactly, where p is the rounded product of a and b; 0 where that is no number: locally constant",
            typing: Typing::Real(3),
            real: Some(|a| real::product_rest(a[0], a[1], a[2])),
            complex: None,
            derivative: Derivative::Zero,
            gpu: Gpu::Library("real_product_rest", None),
            gpu_complex: "",
            cost: weight(5),
        },
        wave_rest(
            Prim::SineRest,
            "sine_rest",
            "sin x - s, where s is the rounded sine: locally constant",
            "real_sine_rest",
        ),
        wave_rest(
            Prim::CosineRest,
            "cosine_rest",
            "cos x - s, where s is the rounded cosine: locally constant",
            "real_cosine_rest",
        ),
        Row {
            prim: Prim::Foot,
            mnemonic: "foot",
            names: &[],
            usage: "",
            doc: "-b/a, about where a s² + 2 b s + c is least, 0 where that is no number of moderate size; for what does \
                  not depend on the place but is rounded least there: locally constant",
            typing: Typing::Real(2),
            real: Some(|a| rational::foot(a[0], a[1])),
            complex: None,
            derivative: Derivative::Zero,
            gpu: Gpu::Library("real_foot", None),
            gpu_complex: "",
            cost: weight(4),
        },
    ]
}

/// What a wave is rounded by: 0 where the format is wide.
fn wave_rest(prim: Prim, mnemonic: &'static str, doc: &'static str, function: &'static str) -> Row {
    Row {
        prim,
        mnemonic,
        names: &[],
        usage: "",
        doc,
        typing: Typing::Real(2),
        real: Some(|_| 0.0),
        complex: None,
        derivative: Derivative::Zero,
        gpu: Gpu::Library(function, None),
        gpu_complex: "",
        cost: weight(90),
    }
}

/// The member of a family that a node is.
fn order_of(g: &Graph, value: Id) -> u8 {
    match g.node(value).op {
        Op::Apply(prim) => prim.order().unwrap_or(0),
        _ => 0,
    }
}

/// a where c < d, else b.
fn where_less(g: &mut Graph, c: Id, d: Id, a: Id, b: Id) -> Id {
    let less = g.apply(Prim::Less, &[c, d]);
    g.apply(Prim::Select, &[less, a, b])
}

/// A = ∫ s²ⁿ/(1 + z s²) over [0, 1] has the derivative (1/(1 + z) - (2n + 1) A)/2z, and because z times the next member is
/// 1/(2n + 1) - A, ((2n + 1) A⁺ - 1/(1 + z))/2, where that does not cancel.
fn atan_quotient_partial(g: &mut Graph, args: &[Id], value: Id, _: usize) -> Id {
    let (z, n) = (args[0], order_of(g, value));
    atan_quotient_slope(g, z, n, value)
}

fn atan_quotient_slope(g: &mut Graph, z: Id, n: u8, value: Id) -> Id {
    let order = 2.0 * f64::from(n) + 1.0;
    let base = plus(g, z, 1.0);
    let end = reciprocal(g, base);
    let next = g.apply(Prim::AtanQuotient(n + 1), &[z]);
    let next = scaled(g, order, next);
    let difference = g.sub(next, end);
    let near = scaled(g, 0.5, difference);
    let own = scaled(g, order, value);
    let difference = g.sub(end, own);
    let double = scaled(g, 2.0, z);
    let far = g.div(difference, double);
    let two = g.real(2.0);
    where_less(g, z, two, near, far)
}

/// By x: -1/(x² + p). By p: for x > 0, |p| moderate beside x², by the derivative of atanq in p/x², else (x/(x² + p) - value)/2p.
fn atan2_quotient_partial(g: &mut Graph, args: &[Id], value: Id, k: usize) -> Id {
    let (p, x) = (args[0], args[1]);
    let sum = g.apply(Prim::SquarePlus, &[x, p]);
    if k == 1 {
        let inverse = reciprocal(g, sum);
        return g.neg(inverse);
    }
    let first = g.div(p, x);
    let ratio = g.div(first, x);
    let quotient = quotient_by_square(g, x, sum, first);
    let difference = g.sub(quotient, value);
    let double = scaled(g, 2.0, p);
    let far = g.div(difference, double);
    let inner = g.apply(Prim::AtanQuotient(0), &[ratio]);
    let mut near = atan_quotient_slope(g, ratio, 0, inner);
    for _ in 0..3 {
        near = g.div(near, x);
    }
    let (zero, least, most) = (g.real(0.0), g.real(-0.6), g.real(2.0));
    let right = g.apply(Prim::Less, &[zero, x]);
    let above = g.apply(Prim::Less, &[least, ratio]);
    let below = g.apply(Prim::Less, &[ratio, most]);
    let moderate = g.apply(Prim::And, &[above, below]);
    let is_near = g.apply(Prim::And, &[right, moderate]);
    g.apply(Prim::Select, &[is_near, near, far])
}

/// x/(x² + p) from x² + p and p/x: 1/(x + p/x) where x² may overflow.
fn quotient_by_square(g: &mut Graph, x: Id, sum: Id, first: Id) -> Id {
    let plain = g.div(x, sum);
    let inverse = g.add(x, first);
    let inverse = reciprocal(g, inverse);
    let size = call(g, Prim::Abs, x);
    let large = g.real(1e18);
    where_less(g, large, size, inverse, plain)
}

/// ∫ sⁿ/(1 + z s)ⁿ⁺¹ over [0, 1] has the derivative -(n + 1) times the next one.
fn log1prel_partial(g: &mut Graph, args: &[Id], value: Id, _: usize) -> Id {
    let n = order_of(g, value) + 1;
    let next = g.apply(Prim::Log1pRel(n), &[args[0]]);
    scaled(g, -f64::from(n), next)
}

/// 1/(1 + e^-x), left of 0 e^x/(1 + e^x).
fn sigmoid(g: &mut Graph, x: Id) -> Id {
    let rises = call(g, Prim::Exp, x);
    let base = plus(g, rises, 1.0);
    let left = g.div(rises, base);
    let turned = g.neg(x);
    let falls = call(g, Prim::Exp, turned);
    let base = plus(g, falls, 1.0);
    let right = reciprocal(g, base);
    let zero = g.real(0.0);
    where_less(g, x, zero, left, right)
}

/// j₀′ = -j₁, (2n + 1) jₙ′ = n jₙ₋₁ - (n + 1) jₙ₊₁ (DLMF 10.51.2).
fn spherical_j_partial(g: &mut Graph, args: &[Id], value: Id, _: usize) -> Id {
    let n = order_of(g, value);
    neighbours(g, args[0], n, Prim::SphericalJ, -1.0)
}

/// (n fₙ₋₁ ± (n + 1) fₙ₊₁)/(2n + 1)
fn neighbours(g: &mut Graph, x: Id, n: u8, family: fn(u8) -> Prim, sign: f64) -> Id {
    let order = f64::from(n);
    let above = g.apply(family(n + 1), &[x]);
    let above = scaled(g, sign * (order + 1.0) / (2.0 * order + 1.0), above);
    if n == 0 {
        return above;
    }
    let below = g.apply(family(n - 1), &[x]);
    let below = scaled(g, order / (2.0 * order + 1.0), below);
    g.add(below, above)
}

/// With f = e^-|x| iₙ: (2n + 1) f′ = n fₙ₋₁ + (n + 1) fₙ₊₁ - (2n + 1) sign(x) f (DLMF 10.51.5), and far out, where that
/// cancels, from the finite sum of DLMF 10.49.8. Of order 0 that of exprel(-2|x|).
fn spherical_i_partial(g: &mut Graph, args: &[Id], value: Id, _: usize) -> Id {
    let (x, n) = (args[0], order_of(g, value));
    let size = call(g, Prim::Abs, x);
    let sign = call(g, Prim::Sign, x);
    if n == 0 {
        let double = scaled(g, -2.0, size);
        let inner = call(g, Prim::Exprel, double);
        let slope = exprel_partial(g, &[double], inner, 0);
        let slope = scaled(g, -2.0, slope);
        return g.mul(sign, slope);
    }
    let sum = neighbours(g, x, n, Prim::SphericalIScaled, 1.0);
    let own = g.mul(sign, value);
    let near = g.sub(sum, own);
    let mut far = finite_sum_slope(g, size, n);
    if n.is_multiple_of(2) {
        far = g.mul(sign, far);
    }
    let order = f64::from(n);
    let limit = g.real((0.5 * order * (order + 1.0)).max(2.0));
    where_less(g, size, limit, near, far)
}

/// The derivative of r (S(r) ∓ e^-2a S(-r)) by a, with r = 1/2a and S(r) = Σ c (-r)ᵏ, c = (n + k)!/(k! (n - k)!).
fn finite_sum_slope(g: &mut Graph, a: Id, n: u8) -> Id {
    let mut factors = vec![1.0];
    for k in 0..n {
        let (order, k) = (f64::from(n), f64::from(k));
        let factor = (order + k + 1.0) * (order - k) / (k + 1.0);
        factors.push(factor * factors.last().copied().unwrap_or(1.0));
    }
    let weighted = |k: usize, c: f64| c * (k as f64 + 1.0);
    let turned = |k: usize, c: f64| if k.is_multiple_of(2) { c } else { -c };
    let list = |f: &dyn Fn(usize, f64) -> f64| -> Vec<f64> {
        factors.iter().enumerate().map(|(k, &c)| f(k, c)).collect()
    };
    let double = scaled(g, 2.0, a);
    let r = reciprocal(g, double);
    let sum = |coefficients: Vec<f64>, g: &mut Graph| horner(g, r, coefficients.into_iter().rev());
    let steady = sum(list(&|k, c| turned(k, weighted(k, c))), g);
    let plain = sum(list(&|_, c| c), g);
    let rising = sum(list(&weighted), g);
    let negative = g.neg(double);
    let exp = call(g, Prim::Exp, negative);
    let rising = g.mul(r, rising);
    let decay = g.add(plain, rising);
    let decay = g.mul(exp, decay);
    let steady = g.mul(r, steady);
    // -2 r (r S* ∓ e^-2a (S + r S*))
    let inside = if n.is_multiple_of(2) {
        g.sub(steady, decay)
    } else {
        g.add(steady, decay)
    };
    let product = g.mul(r, inside);
    scaled(g, -2.0, product)
}

/// c e^{-x²}
fn bell(g: &mut Graph, c: f64, x: Id) -> Id {
    if g.ty(x) == Ty::Complex {
        let square = g.apply(Prim::PowInt(2), &[x]);
        let exponent = g.neg(square);
        let value = call(g, Prim::Exp, exponent);
        return scaled(g, c, value);
    }
    let gauss = call(g, Prim::Gauss, x);
    scaled(g, c, gauss)
}

/// e^{x²} iⁿerfc x has the derivative -2 (n + 1) times the next one (DLMF 7.18.3 and 7.18.7).
fn erfcx_partial(g: &mut Graph, args: &[Id], value: Id, _: usize) -> Id {
    let n = order_of(g, value) + 1;
    let next = g.apply(Prim::Erfcx(n), &[args[0]]);
    scaled(g, -2.0 * f64::from(n), next)
}

/// By w: the integrand at both ends. By c: their difference, as sign(c w) e^{-(|c| - |w|)²} (e^{-4|c w|} - 1),
/// or where c w is small a form that is smooth there.
fn mass_partial(g: &mut Graph, args: &[Id], _: Id, k: usize) -> Id {
    let (c, w) = (args[0], args[1]);
    if k == 1 {
        let far = g.apply(Prim::GaussOfSum, &[c, w]);
        let turned = g.neg(w);
        let near = g.apply(Prim::GaussOfSum, &[c, turned]);
        return g.add(far, near);
    }
    let sizes = [c, w].map(|a| g.apply(Prim::Abs, &[a]));
    let turned = g.neg(sizes[1]);
    let near = g.apply(Prim::GaussOfSum, &[sizes[0], turned]);
    let product = g.mul(c, w);
    let size = call(g, Prim::Abs, product);
    let steepness = scaled(g, -4.0, size);
    let fall = call(g, Prim::Expm1, steepness);
    let sign = call(g, Prim::Sign, product);
    let fall = g.mul(sign, fall);
    let far = g.mul(near, fall);
    let close = difference_near_zero(g, c, w, product);
    let limit = g.real(0.25);
    where_less(g, size, limit, close, far)
}

/// -2 e^{-c²} e^{-w²} sinh(2 c w), smooth where the product is 0.
fn difference_near_zero(g: &mut Graph, c: Id, w: Id, product: Id) -> Id {
    let bells = [c, w].map(|x| g.apply(Prim::Gauss, &[x]));
    let bells = g.mul(bells[0], bells[1]);
    let angle = scaled(g, 2.0, product);
    let sinh = call(g, Prim::Sinh, angle);
    let wave = scaled(g, -2.0, sinh);
    g.mul(bells, wave)
}

/// Where the interval holds 0 that of the mass; else its first moment M gives both, by c -2 sign(c w) M, by w
/// 2 (e^{-4|c w|} + M).
fn scaled_mass_partial(g: &mut Graph, args: &[Id], value: Id, k: usize) -> Id {
    let (c, w) = (args[0], args[1]);
    let inside = mass_partial(g, args, value, k);
    let outside = moment_slope(g, c, w, 0, k);
    let turned = if k == 0 {
        let sign = call(g, Prim::Sign, w);
        g.mul(sign, outside)
    } else {
        outside
    };
    let sizes = [c, w].map(|a| g.apply(Prim::Abs, &[a]));
    where_less(g, sizes[1], sizes[0], turned, inside)
}

/// By |w| the n-th moment has the derivative 2 (2|w|)ⁿ e^{-4|c w|} + 2 M, by |c| -2 M, with the next moment M.
fn moment_partial(g: &mut Graph, args: &[Id], value: Id, k: usize) -> Id {
    let n = order_of(g, value);
    let slope = moment_slope(g, args[0], args[1], n, k);
    if k == 0 {
        return slope;
    }
    let sign = call(g, Prim::Sign, args[1]);
    g.mul(sign, slope)
}

/// The derivative of the n-th moment by c, or by |w|.
fn moment_slope(g: &mut Graph, c: Id, w: Id, n: u8, k: usize) -> Id {
    let next = g.apply(Prim::GaussMassMoment(n + 1), &[c, w]);
    if k == 0 {
        let sign = call(g, Prim::Sign, c);
        let slope = scaled(g, -2.0, next);
        return g.mul(sign, slope);
    }
    let sizes = [c, w].map(|a| g.apply(Prim::Abs, &[a]));
    let rate = scaled(g, -4.0, sizes[0]);
    let mut end = g.apply(Prim::ExpOfProduct, &[rate, sizes[1]]);
    if n > 0 {
        let length = scaled(g, 2.0, sizes[1]);
        let power = g.apply(Prim::PowInt(n.into()), &[length]);
        end = g.mul(power, end);
    }
    let sum = g.add(end, next);
    scaled(g, 2.0, sum)
}
