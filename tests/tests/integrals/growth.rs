//! How large integrals become as their integrands grow.

use pullback_compiler::integrate::{MAX_NODES, Otherwise, field_integral};

use super::formula;

/// Nodes of the integral; `None` where it is refused.
fn nodes(text: &str) -> Option<usize> {
    let of = formula(text);
    let made = field_integral(&of, Otherwise::Refuse).ok()?;
    assert!(made.graph.nodes().len() < 2 * MAX_NODES, "{text}");
    Some(made.graph.compacted(&[made.integral.value]).0.nodes().len())
}

/// Of a polynomial, by its degree: nodes times what it costs to compute.
#[test]
fn polynomials_grow_with_their_degree() {
    let sizes = [10, 20, 40, 60].map(|degree| nodes(&format!("(x + y + z)^{degree}")).unwrap());
    println!("{sizes:?}");
    assert!(sizes[3] < 8 * sizes[0], "{sizes:?}");
    let dense = [10, 20, 40, 60].map(|n| {
        let terms: Vec<String> = (1..=n).map(|k| format!("x^{k} y^{}", n - k)).collect();
        nodes(&terms.join(" + ")).unwrap()
    });
    println!("{dense:?}");
    // as many nodes of the rule as half the degree, each with as many terms as the degree
    assert!(dense[3] < 40 * dense[0], "{dense:?}");
}

/// Of products, by the number of their factors.
#[test]
fn products_are_bounded() {
    for of in [
        |k: usize| format!("sin({k} x + y)"),
        |k: usize| format!("(x + {k} y)"),
        |k: usize| format!("exp(-{k} x)"),
        |k: usize| format!("max(0, x + {k}/7)"),
        |k: usize| format!("(1 + cos({k} z))"),
        |k: usize| format!("(x^2 + y^2 + {k})"),
        |k: usize| format!("cosh(x/{k})"),
    ] {
        let sizes = [2, 4, 6, 8, 10].map(|n| {
            let factors: Vec<String> = (1..=n).map(of).collect();
            nodes(&factors.join(" * "))
        });
        println!("{} … {sizes:?}", of(1));
        assert!(sizes[0].is_some(), "{}", of(1));
        assert!(sizes.iter().flatten().all(|&n| n < MAX_NODES), "{sizes:?}");
    }
}
