//! What docs/special-functions.md says of poles, branch points and infinity, of complex numbers in `f64`; and that the page has a
//! picture of every function.

use pullback_compiler::{Evaluator, What, compile};
use pullback_tests::corpus::{files, read, root};
use pullback_tests::special::special_formulas;

/// Real and imaginary part of f(z).
fn value(body: &str, [x, y]: [f64; 2]) -> [f64; 2] {
    let text = format!("f(z: complex) = {body} + 0i\n");
    let program = compile(&text).program.expect(&text);
    let formula = &program.pictures()[0].formula;
    let mut evaluator = Evaluator::new(formula, What::Value).expect(&text);
    let mut found = [f64::NAN; 2];
    evaluator.eval(&[], 0.0, 0.0, &[x, y], &mut found);
    found
}

#[test]
fn poles_are_infinite() {
    let poles = [
        ("gamma(z)", 0.0),
        ("loggamma(z)", 0.0),
        ("loggamma(z)", -1.0),
        ("digamma(z)", 0.0),
        ("trigamma(z)", -1.0),
        ("euler_beta(z, 0.5)", 0.0),
        ("expint_e1(z)", 0.0),
        ("expint_ei(z)", 0.0),
        ("cosint(z)", 0.0),
        ("logint(z)", 1.0),
        ("lambertw(z, 1)", 0.0),
        ("zeta(z)", 1.0),
        ("hurwitz_zeta(z, 0.25)", 1.0),
        ("elliptic_k(z)", 1.0),
        ("weierstrass_p(z, i)", 0.0),
        ("weierstrass_p_invariants(z, 4, 1)", 0.0),
    ];
    for (body, x) in poles {
        let found = value(body, [x, 0.0]);
        assert!(found[0].is_infinite(), "{body} at {x}: {found:?}");
    }
}

#[test]
fn outside_of_a_domain_there_is_no_number() {
    let outside = [
        ("gamma(z)", [-1.0, 0.0]),
        ("digamma(z)", [-2.0, 0.0]),
        ("euler_beta(z, 0.5)", [-40.0, 1.0]),
        ("zeta(z)", [0.5, 501.0]),
        ("dirichlet_eta(z)", [0.5, -501.0]),
        ("dirichlet_beta(z)", [0.5, 501.0]),
        ("hurwitz_zeta(z, 0.25)", [-0.5, 1.0]),
        ("hurwitz_zeta(2, z)", [1.0, 0.5]),
        ("weierstrass_p(1/4, z)", [0.0, -1.0]),
        ("jacobi_theta1(1/4, z)", [1.0, 0.0]),
        ("jacobi_theta4(1/4, z)", [0.8, 0.7]),
        ("eisenstein_e2(z)", [0.5, 0.0]),
        ("eisenstein_e4(z)", [0.5, -1.0]),
        ("klein_j(z)", [0.5, 0.0]),
        ("dedekind_eta(z)", [0.5, -0.5]),
        ("modular_lambda(z)", [0.5, -0.5]),
        ("hypergeometric(0.5, 0.75, 1.5, z)", [1.0, 0.0]),
        ("hypergeometric(0.5, 0.75, 1.5, z)", [3.0, 1.0]),
        ("besselj(z, 1/2 + 0i)", [0.5, 0.0]),
    ];
    for (body, z) in outside {
        let found = value(body, z);
        assert!(found[0].is_nan(), "{body} at {z:?}: {found:?}");
    }
}

#[test]
fn what_is_said_of_far_points_is_so() {
    let pi = std::f64::consts::PI;
    let limits: [(&str, [f64; 2], [f64; 2]); 20] = [
        ("erf(z)", [60.0, 1.0], [1.0, 0.0]),
        ("erfc(z)", [-60.0, 1.0], [2.0, 0.0]),
        ("erfcx(z)", [1e8, 1.0], [0.0, 0.0]),
        ("faddeeva(z)", [1e8, 1.0], [0.0, 0.0]),
        ("fresnel_s(z)", [1e9, 0.0], [0.5, 0.0]),
        ("fresnel_s(z)", [0.0, 1e9], [0.0, -0.5]),
        ("fresnel_c(z)", [0.0, 1e9], [0.0, 0.5]),
        ("expint_e1(z)", [800.0, 1.0], [0.0, 0.0]),
        ("expint_ei(z)", [-800.0, 1.0], [0.0, pi]),
        ("sinint(z)", [-1e9, 0.0], [-pi / 2.0, 0.0]),
        ("cosint(z)", [-1e9, 0.1], [0.0, pi]),
        ("zeta(z)", [80.0, 3.0], [1.0, 0.0]),
        ("dirichlet_beta(z)", [80.0, 3.0], [1.0, 0.0]),
        ("airy_ai(z)", [200.0, 3.0], [0.0, 0.0]),
        ("dilog(z)", [1.0, 0.0], [pi * pi / 6.0, 0.0]),
        ("elliptic_e(z)", [1.0, 0.0], [1.0, 0.0]),
        ("elliptic_k(z)", [1e30, 1.0], [0.0, 0.0]),
        ("eisenstein_e4(z)", [0.3, 40.0], [1.0, 0.0]),
        ("eisenstein_e6(z)", [0.0, 1.0], [0.0, 0.0]),
        ("modular_lambda(z)", [0.3, 40.0], [0.0, 0.0]),
    ];
    for (body, z, expected) in limits {
        let found = value(body, z);
        let apart = (found[0] - expected[0]).hypot(found[1] - expected[1]);
        assert!(apart < 1e-7, "{body} at {z:?}: {found:?}");
    }
}

/// A constant that is outside is told when the program is compiled, and one inside is not.
#[test]
fn constants_outside_of_a_domain_are_warned_of() {
    let told = |text: &str| {
        let answer = compile(text);
        assert!(answer.program.is_some(), "{text}");
        answer
            .diagnostics
            .iter()
            .any(|d| d.code == "outside-domain")
    };
    for text in [
        "f(z) = jacobi_theta1(z, 2)",
        "f(z) = jacobi_theta3(z, 0.8 + 0.7i)",
        "f(z) = weierstrass_p(z, -i)",
        "f(z) = weierstrass_p(z, 1)",
        "f(z) = z klein_j(1/2 - i)",
        "f(z) = z zeta(1/2 + 600i)",
        "f(z) = hurwitz_zeta(z, -1)",
        "f(z) = z hurwitz_zeta(-1, 1/2)",
        "f(z) = euler_beta(z, -40.5)",
        "f(z) = hypergeometric(1, 2, -1, z)",
        "f(z) = hypergeometric(z, 2, 3, 2 + i)",
        "f(x: real) = x dilog(2)",
    ] {
        assert!(told(text), "{text}");
    }
    for text in [
        "f(z) = jacobi_theta1(z, 0.9)",
        "f(z) = weierstrass_p(z, 1/2 + i)",
        "f(z) = z zeta(1/2 + 100i)",
        "f(z) = hurwitz_zeta(z, 1/4)",
        "f(z) = hypergeometric(-1, 2, -3, z)",
        "f(z) = hypergeometric(z, 2, 3, -5)",
    ] {
        assert!(!told(text), "{text}");
    }
}

/// Every function has a program that draws it, its picture, and a row.
#[test]
fn the_page_has_every_function() {
    let page = read(&root().join("docs/special-functions.md"));
    let programs = files("docs/special-functions", "pull");
    for formula in special_formulas() {
        let name = formula.name;
        let program = programs.iter().find(|p| p.name == name);
        let program = program.unwrap_or_else(|| panic!("{name} has no program"));
        assert!(program.text.contains(&format!("{name}(")), "{name}");
        let picture = root().join(format!("docs/special-functions/{name}.png"));
        assert!(picture.exists(), "{name} has no picture");
        let row =
            format!("[![{name}](special-functions/{name}.png)](special-functions/{name}.pull)");
        assert!(page.contains(&row), "{name} has no row");
    }
    let graphs = [
        "lgamma",
        "bessely",
        "besseli",
        "besselk",
        "legendre_p",
        "chebyshev_u",
        "spherical_harmonic",
    ];
    for name in graphs {
        let program = programs.iter().find(|p| p.name == name);
        let program = program.unwrap_or_else(|| panic!("{name} has no program"));
        assert!(program.text.contains("show implicit(f)"), "{name}");
    }
    for program in &programs {
        let name = &program.name;
        let row =
            format!("[![{name}](special-functions/{name}.png)](special-functions/{name}.pull)");
        assert!(page.contains(&row), "{name} has no row");
    }
    for program in programs {
        let answer = compile(&program.text);
        assert!(
            answer.program.is_some() && answer.diagnostics.is_empty(),
            "{}",
            program.name
        );
    }
}
