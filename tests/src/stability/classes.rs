//! A density for each class of closed forms.

use pullback_compiler::reference::erf::erf;

/// What singularities a density may have on a ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Poles {
    /// None, or none that counts.
    None,
    /// One that has an integral on every ray but through it.
    Weak,
    /// Those that have none; intervals with one in them are left out.
    Strong,
}

/// A class of densities that have a closed form, by one of them.
#[derive(Clone, Copy, Debug)]
pub struct Class {
    /// What it is called.
    pub name: &'static str,
    /// The density.
    pub formula: &'static str,
    /// The density once more, for the reference.
    pub density: fn([f64; 3]) -> f64,
    /// How many radians it turns per unit of length, 0 where it does not.
    pub turns: f64,
    /// Its singularities.
    pub poles: Poles,
    /// Its antiderivative as a textbook has it, at t with the height v = o.y + t d.y, its rate w = d.y, and
    /// q = A t² + 2 B t + C for |p|².
    pub textbook: Option<&'static str>,
}

const fn class(name: &'static str, formula: &'static str, density: fn([f64; 3]) -> f64) -> Class {
    Class {
        name,
        formula,
        density,
        turns: 0.0,
        poles: Poles::None,
        textbook: None,
    }
}

const fn waves(
    name: &'static str,
    formula: &'static str,
    density: fn([f64; 3]) -> f64,
    turns: f64,
) -> Class {
    Class {
        turns,
        ..class(name, formula, density)
    }
}

const fn with_poles(
    name: &'static str,
    formula: &'static str,
    density: fn([f64; 3]) -> f64,
) -> Class {
    Class {
        poles: Poles::Strong,
        ..class(name, formula, density)
    }
}

const fn with_weak_pole(
    name: &'static str,
    formula: &'static str,
    density: fn([f64; 3]) -> f64,
) -> Class {
    Class {
        poles: Poles::Weak,
        ..class(name, formula, density)
    }
}

const fn beside(of: Class, antiderivative: &'static str) -> Class {
    Class {
        textbook: Some(antiderivative),
        ..of
    }
}

/// |p|²
fn q(p: [f64; 3]) -> f64 {
    p[0] * p[0] + p[1] * p[1] + p[2] * p[2]
}

fn gyroid(p: [f64; 3]) -> f64 {
    let [x, y, z] = p.map(|v| 3.0 * v);
    x.sin() * y.cos() + y.sin() * z.cos() + z.sin() * x.cos()
}

/// From -1 to 1.
fn smoothstep(y: f64) -> f64 {
    let u = (0.5 * (y + 1.0)).clamp(0.0, 1.0);
    u * u * (3.0 - 2.0 * u)
}

/// The classes.
pub const CLASSES: [Class; 43] = [
    beside(
        class("polynomial, degree 4", "(x^2 + y^2 + z^2 - 1)^2", |p| {
            (q(p) - 1.0).powi(2)
        }),
        "A^2 t^5/5 + A B t^4 + (4 B^2 + 2 A (C - 1)) t^3/3 + 2 B (C - 1) t^2 + (C - 1)^2 t",
    ),
    class("polynomial, degree 20", "x^20 - 20 x^18 y^2 + 0.75", |p| {
        p[0].powi(20) - 20.0 * p[0].powi(18) * p[1] * p[1] + 0.75
    }),
    beside(
        waves("wave", "sin(3 y)", |p| (3.0 * p[1]).sin(), 3.0),
        "-cos(3 v)/(3 w)",
    ),
    beside(
        waves(
            "square of a wave",
            "sin(3 y)^2",
            |p| (3.0 * p[1]).sin().powi(2),
            6.0,
        ),
        "t/2 - sin(6 v)/(12 w)",
    ),
    waves(
        "products of waves",
        "(sin(3 x) cos(3 y) + sin(3 y) cos(3 z) + sin(3 z) cos(3 x))^2",
        |p| gyroid(p).powi(2),
        12.0,
    ),
    beside(
        class("exponential", "exp(-2 y)", |p| (-2.0 * p[1]).exp()),
        "-exp(-2 v)/(2 w)",
    ),
    class("hyperbolic wave", "cosh(y - z)", |p| (p[1] - p[2]).cosh()),
    waves(
        "exponential by wave",
        "exp(-y) (1 + 0.5 cos(5 x))",
        |p| (-p[1]).exp() * (1.0 + 0.5 * (5.0 * p[0]).cos()),
        5.0,
    ),
    waves(
        "polynomial by wave",
        "x^2 sin(5 y)",
        |p| p[0] * p[0] * (5.0 * p[1]).sin(),
        5.0,
    ),
    beside(
        class("polynomial by exponential", "y exp(-y)", |p| {
            p[1] * (-p[1]).exp()
        }),
        "-(v + 1) exp(-v)/w",
    ),
    beside(
        class("Gaussian", "exp(-(x^2 + y^2 + z^2))", |p| (-q(p)).exp()),
        "sqrt(pi)/(2 sqrt(A)) exp(-D/A) erf((A t + B)/sqrt(A))",
    ),
    class(
        "polynomial by Gaussian",
        "(x^2 + y^2) exp(-2 (x^2 + y^2 + z^2))",
        |p| (p[0] * p[0] + p[1] * p[1]) * (-2.0 * q(p)).exp(),
    ),
    beside(
        class("1/q", "1/(x^2 + y^2 + z^2 + 0.01)", |p| 1.0 / (q(p) + 0.01)),
        "atan((A t + B)/sqrt(D + 0.01 A))/sqrt(D + 0.01 A)",
    ),
    beside(
        class("1/q²", "1/(x^2 + y^2 + z^2 + 0.01)^2", |p| {
            (q(p) + 0.01).powi(-2)
        }),
        "(A t + B)/(2 k (q + 0.01)) + A atan((A t + B)/sqrt(k))/(2 k sqrt(k)) where k = D + 0.01 A",
    ),
    class("1/q³", "1/(x^2 + y^2 + z^2 + 0.1)^3", |p| {
        (q(p) + 0.1).powi(-3)
    }),
    class("q^(-5/2)", "1/(x^2 + y^2 + z^2 + 0.1)^2.5", |p| {
        (q(p) + 0.1).powf(-2.5)
    }),
    class("√q", "sqrt(x^2 + y^2 + z^2 + 0.04)", |p| {
        (q(p) + 0.04).sqrt()
    }),
    beside(
        class("|p|", "length((x, y, z))", |p| q(p).sqrt()),
        "(A t + B) sqrt(q)/(2 A) + D log(A t + B + sqrt(A) sqrt(q))/(2 A sqrt(A))",
    ),
    beside(
        with_weak_pole("1/|p|", "1/length((x, y, z))", |p| 1.0 / q(p).sqrt()),
        "log(A t + B + sqrt(A) sqrt(q))/sqrt(A)",
    ),
    class("q^(-3/2)", "1/(x^2 + y^2 + z^2 + 0.01)^1.5", |p| {
        (q(p) + 0.01).powf(-1.5)
    }),
    class("|p|³", "length((x, y, z))^3", |p| q(p).powf(1.5)),
    class("polynomial by √q", "x^2 length((x, y, z))", |p| {
        p[0] * p[0] * q(p).sqrt()
    }),
    class("polynomial by 1/q", "x/(x^2 + y^2 + z^2 + 0.1)", |p| {
        p[0] / (q(p) + 0.1)
    }),
    class("log q", "log(x^2 + y^2 + z^2 + 0.01)", |p| {
        (q(p) + 0.01).ln()
    }),
    class(
        "polynomial by log q",
        "x^2 log(x^2 + y^2 + z^2 + 0.1)",
        |p| p[0] * p[0] * (q(p) + 0.1).ln(),
    ),
    with_poles("1/q, q of either sign", "1/(x^2 + y^2 - 4)", |p| {
        1.0 / (p[0] * p[0] + p[1] * p[1] - 4.0)
    }),
    with_poles("1/q³, q of either sign", "1/(x^2 + y^2 - 4)^3", |p| {
        (p[0] * p[0] + p[1] * p[1] - 4.0).powi(-3)
    }),
    with_poles("1/q², q of either sign", "1/(x^2 + y^2 - 4)^2", |p| {
        (p[0] * p[0] + p[1] * p[1] - 4.0).powi(-2)
    }),
    class(
        "√q, q of either curvature",
        "sqrt(144 - x^2 + y^2)",
        |p| (144.0 - p[0] * p[0] + p[1] * p[1]).sqrt(),
    ),
    beside(
        with_poles("1/x", "1/(y + 12)", |p| 1.0 / (p[1] + 12.0)),
        "log(v + 12)/w",
    ),
    class("x^p", "(y + 12)^0.3", |p| (p[1] + 12.0).powf(0.3)),
    class("log x", "log(y + 12)", |p| (p[1] + 12.0).ln()),
    beside(
        class("tanh", "tanh(3 y)", |p| (3.0 * p[1]).tanh()),
        "log(cosh(3 v))/(3 w)",
    ),
    beside(
        class("sech²", "1/cosh(4 y)^2", |p| (4.0 * p[1]).cosh().powi(-2)),
        "tanh(4 v)/(4 w)",
    ),
    class("atan", "atan(5 y)", |p| (5.0 * p[1]).atan()),
    class("logistic", "1/(1 + exp(-6 y))", |p| {
        1.0 / (1.0 + (-6.0 * p[1]).exp())
    }),
    class("erf", "erf(2 y)", |p| erf(2.0 * p[1])),
    beside(
        class("ramp", "max(0, y)", |p| p[1].max(0.0)),
        "max(0, v)^2/(2 w)",
    ),
    class(
        "cuts of a linear form",
        "smoothstep(-1, 1, y) abs(x)",
        |p| smoothstep(p[1]) * p[0].abs(),
    ),
    class("compact blob", "max(0, 1 - x^2 - y^2 - z^2)^3", |p| {
        (1.0 - q(p)).max(0.0).powi(3)
    }),
    class(
        "jump at a sphere",
        "if x^2 + y^2 + z^2 < 1 then 1 + y else 0",
        |p| if q(p) < 1.0 { 1.0 + p[1] } else { 0.0 },
    ),
    waves(
        "polynomial by Gaussian by wave",
        "x^2 exp(-(x^2 + y^2 + z^2)) cos(5 y)",
        |p| p[0] * p[0] * (-q(p)).exp() * (5.0 * p[1]).cos(),
        5.0,
    ),
    class("growing Gaussian", "x^3 exp(x^2)", |p| {
        p[0].powi(3) * (p[0] * p[0]).exp()
    }),
];
