//! Integration by nodes where there is no closed form: the bound that chooses the panels holds, and is kept.

use pullback_compiler::What;
use pullback_compiler::formula::Formula;
use pullback_compiler::integrate::{
    FieldIntegral, MAX_PANELS, Otherwise, TOLERANCE, field_integral,
};
use pullback_compiler::lower::Precision;
use pullback_runtime::executor::Arithmetic;
use pullback_tests::accuracy::evaluators::Machine;

use super::{Ray, densities, formula, points};

fn made(of: &Formula) -> FieldIntegral {
    field_integral(of, Otherwise::Quadrature).unwrap()
}

/// The number of panels and the bound of the error, as functions of the ray.
fn bounds(of: &Formula, made: &FieldIntegral) -> Option<[Formula; 2]> {
    let [rest] = made.integral.rest.as_slice() else {
        return None;
    };
    Some(rest.bound?.map(|value| {
        let mut one = made.clone();
        one.integral.value = value;
        one.into_formula(of)
    }))
}

fn values(of: &Formula, rays: &[Ray], machine: Machine) -> Vec<f64> {
    let at = points(rays.iter().map(|r| r.args.clone()));
    let found = machine.run(of, What::Value, &at).unwrap();
    found.into_iter().map(|v| v[0]).collect()
}

/// Every density without a closed form, against mpmath at 60 digits.
#[test]
fn bounds_of_the_error_hold() {
    let mut wrong = String::new();
    let (mut rays, mut taken, mut kept) = (0, 0.0, 0);
    for density in densities("rest") {
        let of = formula(&density.text);
        let made = made(&of);
        assert!(!made.integral.numerical.is_empty(), "{}", density.text);
        let Some(bounds) = bounds(&of, &made) else {
            panic!("{}: no bound", density.text);
        };
        let integral = made.into_formula(&of);
        let found = values(&integral, &density.rays, Machine::Reference);
        let single = Machine::Processor(Arithmetic::Ieee32, Precision::Accurate);
        let single = values(&integral, &density.rays, single);
        let [panels, errors] = bounds.map(|b| values(&b, &density.rays, Machine::Reference));
        let (mut most, mut worst, mut worst_single) = (0.0_f64, 0.0_f64, 0.0_f64);
        for (k, ray) in density.rays.iter().enumerate() {
            let size = ray.size.max(1e-30);
            let error = (found[k] - ray.exact).abs();
            let allowed = errors[k] + 1e-14 * size;
            if error.is_nan() || error > allowed || panels[k] > f64::from(MAX_PANELS) {
                wrong += &format!(
                    "{} {:?}: {:e}, not {:e}: {:.1e} of {size:e}, at most {:.1e}, {} panels\n",
                    density.text,
                    ray.args,
                    found[k],
                    ray.exact,
                    error / size,
                    errors[k] / size,
                    panels[k]
                );
            }
            most = most.max(panels[k]);
            worst = worst.max(error / size);
            worst_single = worst_single.max((single[k] - ray.exact).abs() / size);
            taken += panels[k];
            rays += 1;
            kept += usize::from(errors[k] <= 2.0 * TOLERANCE * size);
        }
        println!(
            "  {:<45} f64 {worst:.0e}  f32 {worst_single:.0e}  at most {most} panels",
            density.text
        );
    }
    println!(
        "{rays} rays, {:.1} panels each, {kept} bounds within {TOLERANCE:e} of the mean",
        taken / f64::from(rays)
    );
    assert!(wrong.is_empty(), "{wrong}");
}

/// Kinks, jumps and peaks at places that no rule knows: by antiderivatives of our own, along the x axis.
#[test]
fn what_is_not_smooth_is_cut_by_the_bound() {
    use std::f64::consts::PI;
    type Exact = fn(f64) -> f64;
    let cases: [(&str, Exact, f64); 4] = [
        // ∫ |sin 3x| from 0
        (
            "abs(sin(3 x))",
            |x| {
                let whole = (3.0 * x / PI).floor();
                (2.0 * whole + 1.0 - (3.0 * x - whole * PI).cos()) / 3.0
            },
            1e-8,
        ),
        (
            "floor(x)",
            |x| {
                let n = x.floor();
                n * (n - 1.0) / 2.0 + n * (x - n)
            },
            2e-6,
        ),
        (
            "fract(x)^2",
            |x| (x.floor() + (x - x.floor()).powi(3)) / 3.0,
            2e-6,
        ),
        (
            "if sin(x) > 0.5 then 1 else 0",
            |x| {
                let (turn, rest) = ((x / (2.0 * PI)).floor(), x.rem_euclid(2.0 * PI));
                turn * 2.0 * PI / 3.0 + (rest.clamp(PI / 6.0, 5.0 * PI / 6.0) - PI / 6.0)
            },
            2e-6,
        ),
    ];
    for (text, exact, bound) in cases {
        let of = formula(text);
        let integral = made(&of).into_formula(&of);
        for end in [0.5, 2.0, 5.0, 7.75] {
            let ray = Ray {
                args: vec![0.0, 0.2, 0.1, 1.0, 0.0, 0.0, 0.0, end],
                exact: exact(end),
                size: 1.0,
            };
            let value = values(&integral, std::slice::from_ref(&ray), Machine::Reference)[0];
            assert!(
                (value - ray.exact).abs() < bound * end,
                "{text} to {end}: {value}, not {}",
                ray.exact
            );
        }
    }
}

/// A peak of width 1e-4 and height 1e4: no node of a rule that is not told of it would meet it.
#[test]
fn a_narrow_peak_is_found() {
    let of = formula("1/(1e-4 + 1e4*sin(x)^2)");
    let integral = made(&of).into_formula(&of);
    let ray = Ray {
        args: vec![0.0, 0.0, 0.0, 1.0, 0.0, 0.0, -1.0, 1.3],
        exact: 0.0,
        size: 1.0,
    };
    let value = values(&integral, &[ray], Machine::Reference)[0];
    // ∫ dx/(a + b sin² x) = atan(√((a + b)/a) tan x)/√(a (a + b))
    let (a, b) = (1e-4_f64, 1e4);
    let at = |x: f64| (((a + b) / a).sqrt() * x.tan()).atan() / (a * (a + b)).sqrt();
    let exact = at(1.3) - at(-1.0);
    assert!((value / exact - 1.0).abs() < 1e-8, "{value}, not {exact}");
}

/// Where an operation has no bound, the fixed rule is taken and the operation is named.
#[test]
fn what_has_no_bound_is_named() {
    let of = formula("x + gamma(3 + x^2)");
    let made = made(&of);
    let [rest] = made.integral.rest.as_slice() else {
        panic!("{:?}", made.integral.rest);
    };
    assert!(rest.bound.is_none());
    let without = rest.without.as_ref().unwrap();
    let text = format!("{:?}", made.graph.node(without.node).op);
    assert!(text.contains("amma"), "{text}");
}
