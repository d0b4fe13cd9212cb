//! Derivatives in the language: `f'(x)`, `diff`, `grad` and what is made of them.

mod arguments;
mod call;
mod curvature;
mod fields;
mod integral;
mod partial;
mod prime;

pub(super) use arguments::{arities_of, order, point_and_order};
pub use prime::MAX_ORDER;
pub(super) use prime::{primes_misused, too_high};

/// An operator of the calculus, as the function reference lists it.
#[derive(Debug)]
pub struct Operator {
    /// Its name; empty where it has only a sign.
    pub name: &'static str,
    /// How it is written.
    pub usage: &'static str,
    /// What it takes, in words.
    pub takes: &'static str,
    /// One line: what it is.
    pub doc: &'static str,
    /// Which one it is.
    pub(super) kind: Kind,
}

/// Which operator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Prime,
    Diff,
    Grad,
    Div,
    Curl,
    Laplacian,
    Jacobian,
    Hessian,
    MeanCurvature,
    GaussianCurvature,
    Integral,
}

static OPERATORS: [Operator; 12] = [
    Operator {
        name: "",
        usage: "f'(x), f''(x)",
        takes: "a function of one number",
        doc: "exact derivative of f at x; of a complex number only where f is holomorphic",
        kind: Kind::Prime,
    },
    Operator {
        name: "diff",
        usage: "diff(e, x), diff(e, x, y), diff(e, x, 2)",
        takes: "real, complex, vectors",
        doc: "exact partial derivative of the expression e by the name x, then by y; a number repeats the name before it",
        kind: Kind::Diff,
    },
    Operator {
        name: "grad",
        usage: "grad(e, x, y), grad(e, p), grad(f)(x, y)",
        takes: "real → vector",
        doc: "gradient of an expression, or of a function at a point; without variables, by the parameters around it",
        kind: Kind::Grad,
    },
    Operator {
        name: "div",
        usage: "div(v, x, y), div(v, p), div(f)(p)",
        takes: "vector → real",
        doc: "divergence ∂v.x/∂x + ∂v.y/∂y + …",
        kind: Kind::Div,
    },
    Operator {
        name: "curl",
        usage: "curl(v, x, y, z), curl(v, p), curl(f)(p)",
        takes: "vec3 → vec3, vec2 → real",
        doc: "rotation; in the plane ∂v.y/∂x - ∂v.x/∂y",
        kind: Kind::Curl,
    },
    Operator {
        name: "laplacian",
        usage: "laplacian(e, x, y), laplacian(e, p), laplacian(f)(x, y)",
        takes: "real, complex, vectors",
        doc: "sum of the second derivatives by each variable; of a vector by components",
        kind: Kind::Laplacian,
    },
    Operator {
        name: "jacobian",
        usage: "jacobian(v, x, y), jacobian(v, p), jacobian(f)(p)",
        takes: "vector, complex → real",
        doc: "determinant of the first derivatives of the components: how areas or volumes grow",
        kind: Kind::Jacobian,
    },
    Operator {
        name: "hessian",
        usage: "hessian(e, x, y), hessian(e, p), hessian(f)(x, y)",
        takes: "real",
        doc: "determinant of the second derivatives",
        kind: Kind::Hessian,
    },
    Operator {
        name: "mean_curvature",
        usage: "mean_curvature(e, x, y, z), mean_curvature(f)(p)",
        takes: "real",
        doc: "mean curvature div(n)/2, n = ∇e/|∇e|, of the level surface of e through the point, 1/r for the sphere |p| - r; in the plane the curvature div(n) of the level line; nan where ∇e = 0",
        kind: Kind::MeanCurvature,
    },
    Operator {
        name: "gaussian_curvature",
        usage: "gaussian_curvature(e, x, y, z), gaussian_curvature(f)(p)",
        takes: "real",
        doc: "Gaussian curvature of the level surface of e through the point; nan where ∇e = 0",
        kind: Kind::GaussianCurvature,
    },
    Operator {
        name: "integral",
        usage: "integral(e, t, a, b), integral(t in a..b, e)",
        takes: "real, complex, vectors",
        doc: "definite integral by the real t from a to b, in closed form",
        kind: Kind::Integral,
    },
    Operator {
        name: "quadrature",
        usage: "quadrature(e, t, a, b), quadrature(t in a..b, e)",
        takes: "real, complex, vectors",
        doc: "definite integral by Gauss-Legendre nodes, as many as a bound of the error asks for",
        kind: Kind::Integral,
    },
];

/// Every operator.
pub fn operators() -> &'static [Operator] {
    &OPERATORS
}

/// The operator of this name.
pub fn by_name(name: &str) -> Option<&'static Operator> {
    OPERATORS
        .iter()
        .find(|o| o.name == name && !name.is_empty())
}
