//! Limits of complex functions where a component is infinite (C99 Annex G), and of their derivatives.

use std::f64::consts::{FRAC_PI_2, PI};

use pullback_compiler::What;
use pullback_tests::accuracy::error::Judge;

use super::{label, machines, run};

#[test]
fn complex_limits_at_infinity_are_reached() {
    let up = f64::INFINITY;
    let limits: [(&str, [f64; 2], [f64; 2]); 30] = [
        ("exp", [-up, 1.0], [0.0, 0.0]),
        ("exp", [up, 0.0], [up, 0.0]),
        ("exp", [up, 1.0], [up, up]),
        ("exp", [up, 2.0], [-up, up]),
        ("log", [up, 1.0], [up, 0.0]),
        ("log", [-up, 1.0], [up, PI]),
        ("log", [-up, -1.0], [up, -PI]),
        ("log", [1.0, up], [up, FRAC_PI_2]),
        ("sqrt", [up, 1.0], [up, 0.0]),
        ("sqrt", [-up, 1.0], [0.0, up]),
        ("sqrt", [-up, -1.0], [0.0, -up]),
        ("sinh", [up, 0.0], [up, 0.0]),
        ("sinh", [-up, 0.0], [-up, 0.0]),
        ("cosh", [-up, 1.0], [up, -up]),
        ("tanh", [up, 1.0], [1.0, 0.0]),
        ("tanh", [-up, 1.0], [-1.0, 0.0]),
        ("tan", [1.0, up], [0.0, 1.0]),
        ("tan", [1.0, -up], [0.0, -1.0]),
        ("sin", [1.0, up], [up, up]),
        ("cos", [1.0, up], [up, -up]),
        ("asin", [up, 1.0], [FRAC_PI_2, up]),
        ("asin", [-up, -1.0], [-FRAC_PI_2, -up]),
        ("acos", [up, 1.0], [0.0, -up]),
        ("acos", [-up, 1.0], [PI, -up]),
        ("atan", [up, 1.0], [FRAC_PI_2, 0.0]),
        ("atan", [1.0, -up], [FRAC_PI_2, 0.0]),
        ("asinh", [up, 1.0], [up, 0.0]),
        ("acosh", [-up, 1.0], [up, PI]),
        ("atanh", [up, 1.0], [0.0, FRAC_PI_2]),
        ("atanh", [1.0, up], [0.0, FRAC_PI_2]),
    ];
    let mut wrong = Vec::new();
    for machine in &machines() {
        let near = |got: f64, limit: f64| {
            got == limit || (got - limit).abs() <= 4.0 * machine.format().unit(limit)
        };
        for group in limits.chunk_by(|a, b| a.0 == b.0) {
            let name = group[0].0;
            let points: Vec<Vec<f64>> = group.iter().map(|(_, at, _)| at.to_vec()).collect();
            let source = format!("f(z: complex) = {name}(z)\n");
            let rows = run(machine, &source, What::Value, &points);
            for ((_, at, limit), got) in group.iter().zip(&rows) {
                if !(near(got[0], limit[0]) && near(got[1], limit[1])) {
                    wrong.push(format!(
                        "{}: {name}({at:?}) = {got:?}, not {limit:?}",
                        label(machine)
                    ));
                }
            }
        }
        // quotients and powers that vanish, and derivatives that flatten out
        for (text, at, limit) in [
            ("1/z", [up, 1.0], [0.0, 0.0]),
            ("z^-3", [-up, 0.0], [0.0, 0.0]),
            ("diff(exp(z), z)", [-up, 1.0], [0.0, 0.0]),
            ("diff(log(z), z)", [up, 1.0], [0.0, 0.0]),
            ("diff(atan(z), z)", [up, 1.0], [0.0, 0.0]),
        ] {
            let source = format!("f(z: complex) = {text}\n");
            let got = &run(machine, &source, What::Value, &[at.to_vec()])[0];
            if !(near(got[0], limit[0]) && near(got[1], limit[1])) {
                wrong.push(format!("{}: {text} at {at:?} is {got:?}", label(machine)));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
