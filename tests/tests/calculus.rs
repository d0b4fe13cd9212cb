//! Derivatives that are written in the language: against closed forms, identities and independent references.

use pullback_tests::calculus::{Points, close_to, values};

/// Relative to the value and to 1, for values up to some hundreds in `f32` whose arguments were rounded to it.
#[cfg(feature = "gpu")]
const GPU_BOUND: f64 = 4e-6;

/// A program with a derivative, and one with its closed form.
type Case = (&'static str, &'static str);

const POLYNOMIALS: &[Case] = &[
    ("f(x, y) = diff(x^3 y, x)", "f(x, y) = 3 x² y"),
    ("f(x, y) = diff(x^3 y², x, y)", "f(x, y) = 6 x² y"),
    ("f(x, y) = diff(x^3 y², y, x)", "f(x, y) = 6 x² y"),
    ("f(x, y) = diff(x^3 y², x, 2, y)", "f(x, y) = 12 x y"),
    ("f(x, y) = diff(x^5 y, x, 4)", "f(x, y) = 120 x y"),
    ("f(x, y) = diff(x², y) + x", "f(x, y) = x + 0 y"),
    ("diff(x^3 y, x) + diff(y^2, y)", "3 x² y + 2 y"),
    ("diff((x + y)(x - 2y), y)", "-x - 4 y"),
];

const RULES: &[Case] = &[
    (
        "f(x, y) = diff(sin(x) cos(y x), x)",
        "f(x, y) = cos(x) cos(x y) - y sin(x) sin(x y)",
    ),
    (
        "f(x, y) = diff(x/(1 + x² + y²), x)",
        "f(x, y) = (1 - x² + y²)/(1 + x² + y²)²",
    ),
    (
        "f(x, y) = diff(exp(-x² y), x)",
        "f(x, y) = -2 x y exp(-x² y)",
    ),
    (
        "f(x, y) = diff(√(1 + x² + y²), x, y)",
        "f(x, y) = -x y/(1 + x² + y²)^1.5",
    ),
    (
        "f(x, y) = diff(if x < y then x² else x y, x)",
        "f(x, y) = if x < y then 2x else y",
    ),
    ("f(x, y) = diff(|x| y, x)", "f(x, y) = sign(x) y"),
    // through functions of the program and of the library
    (
        "g(t) = sin(t²)\nf(x, y) = diff(g(x y), x)",
        "f(x, y) = 2 x y² cos(x² y²)",
    ),
    (
        "g(t, s) = t² s\nf(x, y) = diff(g(x y, x), x)",
        "f(x, y) = 3 x² y²",
    ),
    (
        "f(x, y) = diff(smoothstep(-4, 4, x), x) y",
        "f(x, y) = y (6 t - 6 t²)/8 where t = (x + 4)/8",
    ),
];

const PRIMES: &[Case] = &[
    ("f(x, y) = sin'(x y)", "f(x, y) = cos(x y)"),
    (
        "f(x, y) = sin''(x) + log'(2 + y²)",
        "f(x, y) = -sin(x) + 1/(2 + y²)",
    ),
    (
        "g(t) = t^4\nf(x, y) = g'(x) + g''(y) + g'''(x y) + g''''(x)",
        "f(x, y) = 4x³ + 12 y² + 24 x y + 24",
    ),
    // at a point that depends on the variable
    (
        "h(t) = t³\ng(t) = h'(t²)\nf(x, y) = g'(x) + y",
        "f(x, y) = 12 x³ + y",
    ),
    (
        "h(t) = sin(t)\ng(t) = h'(h(t))\nf(x, y) = g'(x y)",
        "f(x, y) = -sin(sin(x y)) cos(x y)",
    ),
    // a vector of one real variable
    (
        "c(t) = (cos(t), t²)\nf(x, y) = dot(c'(x), c''(y))",
        "f(x, y) = sin(x) cos(y) + 4x",
    ),
    // a complex one, too
    (
        "c(t) = exp(i t)\nf(x, y) = im(c'(x y))",
        "f(x, y) = cos(x y)",
    ),
    ("f(x, y) = sqrt'(3)(x + y)", "f(x, y) = (x + y)/(2 √3)"),
    (
        "g(x, y) = diff(x² y, x)\nh(t) = g(t, t)\nf(x, y) = h'(x) y",
        "f(x, y) = 4 x y",
    ),
    (
        "mix3(t) = mix(1, 5, t)\nf(x, y) = mix3'(x) y",
        "f(x, y) = 4 y",
    ),
    (
        "f(x, y) = smoothstep01'(x/9) + y\nsmoothstep01(t) = smoothstep(-1, 1, t)",
        "f(x, y) = y + 3 (t - t²) where t = (x/9 + 1)/2",
    ),
    (
        "f(x, y) = diff(sin, x) + diff(cos)(x y)",
        "f(x, y) = cos(x) - sin(x y)",
    ),
    (
        "g(t) = t³\nf(x, y) = diff(g, x, 2) + diff(g)(y)",
        "f(x, y) = 6x + 3y²",
    ),
    ("g(x, y) = x³ y\nf(x, y) = diff(g, x)", "f(x, y) = 3 x² y"),
];

const SCOPES: &[Case] = &[
    // locals that depend on the variable
    (
        "f(x, y) = diff(a b, x) where a = x², b = a + y",
        "f(x, y) = 2x (2x² + y)",
    ),
    (
        "f(x, y) = diff(a², a) + diff(a², x) where a = x y",
        "f(x, y) = 2 x y + 2 x y²",
    ),
    (
        "f(x, y) = b where a = x², b = diff(a³, x) + y",
        "f(x, y) = 6 x^5 + y",
    ),
    (
        "f(x, y) = diff(x a, x, a) where a = x²",
        "f(x, y) = 1 + 0 x + 0 y",
    ),
    // a local of the same name as the variable of another function
    (
        "g(x) = diff(x², x)\nf(x, y) = g(y) + diff(x y, x)",
        "f(x, y) = 3 y + 0 x",
    ),
    // two parameters with one value: the derivative is by one of them
    (
        "g(a, b) = diff(a² b, a)\nf(x, y) = g(x, x) + 0 y",
        "f(x, y) = 2 x² + 0 y",
    ),
    (
        "g(a, b) = diff(a² b, a)\nf(x, y) = g(x y, x + y)",
        "f(x, y) = 2 x y (x + y)",
    ),
    (
        "g(x, y) = diff(x² y, x)\nf(x, y) = g(y, x)",
        "f(x, y) = 2 x y",
    ),
    (
        "g(t) = diff(t³, t)\nf(x, y) = diff(g(x y), x)",
        "f(x, y) = 6 x y²",
    ),
    ("f(x, y) = diff(diff(x³ y², x), y)", "f(x, y) = 6 x² y"),
    ("f(x, y) = diff(x diff(x² y, x), x)", "f(x, y) = 4 x y"),
    (
        "f(x, y) = diff(diff(a, x) x, x) where a = x² y",
        "f(x, y) = 4 x y",
    ),
    // a constant and a parameter
    (
        "param k = 3\nf(x, y) = diff(k² x, k) + y",
        "param k = 3\nf(x, y) = 2 k x + y",
    ),
    (
        "param k = 3\nc = 2k\nf(x, y) = diff(sin(c x), k) + y",
        "param k = 3\nf(x, y) = 2x cos(2 k x) + y",
    ),
    (
        "param k = 3\ng(t) = diff(k t, k)\nf(x, y) = g(k x) + y",
        "param k = 3\nf(x, y) = k x + y",
    ),
    (
        "f(x, y) = diff(x sin(time y), time)",
        "f(x, y) = x y cos(time y)",
    ),
    (
        "f(x, y) = diff(x a, time) where a = sin(time y)",
        "f(x, y) = x y cos(time y)",
    ),
];

const FIELDS: &[Case] = &[
    (
        "f(x, y) = dot(grad(x² y, x, y), (1, 10))",
        "f(x, y) = 2 x y + 10 x²",
    ),
    (
        "f(x, y) = dot(grad(x² y), (1, 10))",
        "f(x, y) = 2 x y + 10 x²",
    ),
    (
        "g(x, y) = x² y\nf(x, y) = dot(grad(g), (1, 10))",
        "f(x, y) = 2 x y + 10 x²",
    ),
    (
        "g(x, y) = x² y\nf(x, y) = dot(grad(g)(x y, y), (1, 10))",
        "f(x, y) = 2 x y² + 10 x² y²",
    ),
    (
        "g(p: vec2) = p.x² p.y\nf(x, y) = grad(g)((x, y)).x",
        "f(x, y) = 2 x y",
    ),
    (
        "g(p) = grad(dot(p, p), p)\nf(x, y) = g((x, y, 1)).y",
        "f(x, y) = 2 y + 0 x",
    ),
    (
        "f(x, y) = grad(length)((x, y)).x",
        "f(x, y) = x/hypot(x, y)",
    ),
    ("f(x, y) = div((x² y, x y²), x, y)", "f(x, y) = 4 x y"),
    ("f(x, y) = div((x² y, x y²))", "f(x, y) = 4 x y"),
    ("f(x, y) = curl((x² y, x y²))", "f(x, y) = y² - x²"),
    (
        "g(x, y, z) = curl((y z, x² z, x y³))\nf(x, y) = dot(g(x, y, 2), (1, 10, 100))",
        "f(x, y) = dot((3x y² - x², y - y³, 4x - 2), (1, 10, 100))",
    ),
    ("laplacian(x² y + x y³)", "2 y + 6 x y"),
    (
        "f(x, y) = laplacian(a², x, y) where a = x y",
        "f(x, y) = 2 x² + 2 y²",
    ),
    ("f(x, y) = laplacian((x² y, y³)).y + x", "f(x, y) = 6 y + x"),
    ("f(x, y) = im(laplacian((x + i y)² x))", "f(x, y) = 4 y"),
    ("f(x, y) = laplacian(sin(x), x) + y", "f(x, y) = y - sin(x)"),
    (
        "f(x, y) = jacobian((x² y, x + y²))",
        "f(x, y) = 4 x y² - x²",
    ),
    (
        "f(x, y) = jacobian((r cos(v), r sin(v)), r, v) where r = x + 3, v = y",
        "f(x, y) = x + 3 + 0 y",
    ),
    (
        "f(x, y) = jacobian((r sin(u) cos(v), r sin(u) sin(v), r cos(u)), r, u, v) where r = x + 3, u = y, v = 2",
        "f(x, y) = (x + 3)² sin(y)",
    ),
    (
        "f(x, y) = jacobian((a + b, a c, b d, c² d), a, b, c, d) where a = x, b = y, c = x y, d = 2",
        "f(x, y) = c² d (2b - a) where a = x, b = y, c = x y, d = 2",
    ),
    ("f(x, y) = hessian(x³ y + y²)", "f(x, y) = 12 x y - 9 x^4"),
    (
        "f(x, y) = hessian(x² y + x z² + z^4, x, y, z) where z = x y + 1",
        "f(x, y) = -4 x² (2x + 12 z²) where z = x y + 1",
    ),
];

const LOOPS: &[Case] = &[
    (
        "f(x, y) = diff(sum(k in 1..4, x^k y), x)",
        "f(x, y) = (1 + 2x + 3x² + 4x³) y",
    ),
    (
        "f(x, y) = diff(product(k in 1..3, x + k y), x)",
        "f(x, y) = 3x² + 12 x y + 11 y²",
    ),
    (
        "f(x, y) = diff(sum(k in 0..5, sin(k x)), x, 2) + y",
        "f(x, y) = y - sum(k in 0..5, k² sin(k x))",
    ),
    // inside of a loop, by what is outside, by the running variable, by a state
    (
        "f(x, y) = sum(k in 1..3, diff(x^k y, x))",
        "f(x, y) = (1 + 2x + 3x²) y",
    ),
    (
        "f(x, y) = sum(k in 1..3, diff(k² x, k)) + y",
        "f(x, y) = 12 x + y",
    ),
    (
        "f(x, y) = sum(k in 1..2, j in k..3, diff(a, k) + diff(a, j) where a = k² j x) + y",
        "f(x, y) = x sum(k in 1..2, j in k..3, 2 k j + k²) + y",
    ),
    (
        "f(x, y) = iterate(3, z = x, diff(z^3, z)/3) + y",
        "f(x, y) = x^8 + y",
    ),
    (
        "f(x, y) = iterate(2, z = x, diff(z² y, y)) + y",
        "f(x, y) = x^4 + y",
    ),
    (
        "s(t) = diff(t³, t)\nf(x, y) = iterate(2, z = x/2, s(z) + y)",
        "f(x, y) = 3 (3 x²/4 + y)² + y",
    ),
    // through a loop
    (
        "g(x, y) = iterate(3, z = x, z² + y)\nf(x, y) = diff(g, x) + diff(g, y)",
        "f(x, y) = d + e where a = x² + y, b = a² + y, d = 8 b a x, e = 2 b (2 a + 1) + 1",
    ),
    (
        "g(t) = iterate(3, z = t, sin(z))\nf(x, y) = g'(x y)",
        "f(x, y) = cos(sin(sin(t))) cos(sin(t)) cos(t) where t = x y",
    ),
    (
        "g(t) = iterate(2, z = t, z²)\nf(x, y) = g''(x) g'''(y)",
        "f(x, y) = 288 x² y",
    ),
    (
        "f(x, y) = diff(r², r) + y where r = iterate(2, z = x, z²)",
        "f(x, y) = 2 x^4 + y",
    ),
    (
        "f(x, y) = diff(r.z r.w, x) where r = iterate(2, z = x, w = y, (z w, w + z))",
        "f(x, y) = (2 x y + y²) w + x y (x + y) (1 + y) where w = x + y + x y",
    ),
    // the number of steps is a parameter that is differentiated by as well, and does not change
    (
        "g(x, n) = dot(grad(sum(k in 1..n, x^k)), (1, 5))\nf(x, y) = g(x, 3) + y",
        "f(x, y) = 1 + 2x + 3x² + y",
    ),
];

fn check(cases: &[Case]) {
    let mut wrong = Vec::new();
    for &(derived, closed) in cases {
        let found = values(derived, Points::Plane);
        let expected = values(closed, Points::Plane);
        match (found, expected) {
            (Ok(found), Ok(expected)) => wrong.extend(
                close_to(&found, &expected, 1e-13).map(|at| format!("{derived}\n    {at}")),
            ),
            (found, expected) => {
                wrong.extend(found.err());
                wrong.extend(expected.err());
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn polynomials() {
    check(POLYNOMIALS);
}

#[test]
fn rules_of_products_quotients_and_chains() {
    check(RULES);
}

#[test]
fn primes() {
    check(PRIMES);
}

#[test]
fn names_and_what_they_depend_on() {
    check(SCOPES);
}

#[test]
fn loops() {
    check(LOOPS);
}

#[test]
fn gradients_and_their_kin() {
    check(FIELDS);
}

/// All of them on the GPU, against the closed form in `f64`.
#[cfg(feature = "gpu")]
#[test]
fn closed_forms_on_the_gpu() {
    use pullback_compiler::What;
    use pullback_compiler::lower::Precision;
    use pullback_tests::accuracy::evaluators::{Machine, Point, suite_gpu};
    use pullback_tests::calculus::formula;

    let Some(gpu) = suite_gpu() else { return };
    let machine = Machine::Gpu(Box::new(gpu), Precision::Accurate);
    let mut wrong = Vec::new();
    for &(derived, closed) in [POLYNOMIALS, RULES, PRIMES, SCOPES, FIELDS, LOOPS]
        .into_iter()
        .flatten()
    {
        if derived.contains("time") {
            // the suites' GPU has its clock at 0
            continue;
        }
        let (formula, params) = formula(derived).unwrap_or_else(|e| panic!("{e}"));
        let width = formula.columns().len();
        let points: Vec<Point> = Points::Plane
            .rows()
            .iter()
            .map(|row| Point {
                args: row[..width].iter().map(|&x| f64::from(x as f32)).collect(),
                params: params.clone(),
            })
            .collect();
        let found = machine.run(&formula, What::Value, &points);
        let found = found.unwrap_or_else(|e| panic!("{derived}: {e}"));
        let expected = values(closed, Points::Plane).unwrap_or_else(|e| panic!("{e}"));
        wrong.extend(
            close_to(&found, &expected, GPU_BOUND).map(|at| format!("{derived}\n    {at}")),
        );
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
