//! Rays of every kind that may make a closed form fail: a part of what docs/integrals-stability.md tells of, and the reference
//! of that against mpmath at 60 digits (tests/oracle/integrals_stability.py).

use std::fmt::Write as _;

use pullback_compiler::lower::Precision;
use pullback_runtime::executor::Arithmetic;
use pullback_tests::accuracy::evaluators::Machine;
use pullback_tests::stability::classes::CLASSES;
use pullback_tests::stability::rays::{Distance, Ray, Slant, rays};
use pullback_tests::stability::{BOUND, Found, measure, tables};

use super::{DOUBLE, densities};

/// Rays of each class.
const COUNT: usize = 40;

/// The class of which more than one ray in a thousand is within the bound only with the roundings of the ray; all others
/// have to be without.
const WITH_ALLOWANCE: [&str; 1] = ["products of waves"];

fn single() -> Machine {
    Machine::Processor(Arithmetic::Ieee32, Precision::Accurate)
}

/// Origins within 10 units: nothing is beyond the bound, of a few classes nothing but what eight roundings of the numbers of
/// the ray explain, and a number is a number.
#[test]
fn rays_of_every_kind() {
    let rays = rays(COUNT, 5);
    let mut wrong = String::new();
    let mut all: Vec<Found> = Vec::new();
    for class in &CLASSES {
        let found = measure(class, &rays, &single()).unwrap();
        let roundings = if WITH_ALLOWANCE.contains(&class.name) {
            8.0
        } else {
            0.0
        };
        let is_bad = found
            .at(Distance::Near)
            .any(|o| !o.is_within(roundings) || !o.found.is_finite());
        if is_bad {
            wrong += &tables::unexplained(&found, roundings, 5);
        }
        all.push(found);
    }
    print!("{}\n{}", tables::by_class(&all), tables::by_slant(&all));
    assert!(wrong.is_empty(), "{wrong}");
}

/// Adaptive quadrature, and the closed forms in f64 and binary32, against 60 digits.
#[test]
fn the_reference_of_stability_is_right() {
    let mut wrong = String::new();
    let mut count = 0;
    for density in densities("stability") {
        let class = CLASSES.iter().find(|c| c.formula == density.text);
        let class = class.unwrap_or_else(|| panic!("{} is no class", density.text));
        let of_numbers = |exact: &super::Ray| Ray {
            numbers: std::array::from_fn(|k| exact.args[k]),
            slant: Slant::General,
            distance: Distance::Near,
        };
        let rays: Vec<Ray> = density.rays.iter().map(of_numbers).collect();
        let found = measure(class, &rays, &Machine::Reference).unwrap();
        for outcome in &found.outcomes {
            let is_it = |exact: &&super::Ray| exact.args == outcome.ray.numbers;
            let exact = density.rays.iter().find(is_it).unwrap();
            count += 1;
            let off = (outcome.exact - exact.exact).abs() / exact.size.max(1e-30);
            let closed = (outcome.found - exact.exact).abs() / exact.size.max(1e-30);
            if off > BOUND * 1e-2 || closed > DOUBLE * 1e2 {
                let _ = writeln!(
                    wrong,
                    "{} on {:?}: {:e} by quadrature and {:e} in closed form, not {:e}",
                    class.formula, outcome.ray.numbers, outcome.exact, outcome.found, exact.exact
                );
            }
        }
    }
    println!("{count} rays");
    assert!(wrong.is_empty(), "{wrong}");
}
