//! Integrals on the adapter of the suite, in the tier `accurate`.

use std::fmt::Write as _;

use pullback_compiler::integrate::{Otherwise, field_integral};
use pullback_compiler::lower::Precision;
use pullback_compiler::{What, compile};
use pullback_tests::accuracy::evaluators::{Machine, Point, suite_gpu};

use super::language::OF_THE_LANGUAGE;
use super::{Density, SINGLE, densities, formula, points, with_allowances};

/// Densities of every class, `each` from one to the next.
fn sample(each: usize) -> Vec<Density> {
    let classes = [
        "polynomials",
        "waves",
        "exponentials",
        "mixed",
        "pieces",
        "algebraic",
        "affine",
        "bells",
        "scenes",
        "random",
    ];
    let all = classes.into_iter().map(|c| densities(c).into_iter());
    all.flat_map(|of_class| of_class.step_by(each)).collect()
}

/// The integral along a ray is as near to mpmath's as in binary32 on the processor.
#[test]
fn rays_on_the_gpu() {
    let Some(gpu) = suite_gpu() else { return };
    let machine = Machine::Gpu(Box::new(gpu), Precision::Accurate);
    let (mut wrong, mut rays, mut good) = (String::new(), 0, 0);
    for density in sample(12) {
        let of = formula(&density.text);
        let made = field_integral(&of, Otherwise::Refuse)
            .unwrap_or_else(|e| panic!("{}: {e:?}", density.text));
        let (integral, allowed) = with_allowances(&of, made, &density.rays);
        let at = points(density.rays.iter().map(|r| r.args.clone()));
        let values = machine
            .run(&integral, What::Value, &at)
            .unwrap_or_else(|e| panic!("{}: {e}", density.text));
        let mut worst: f64 = 0.0;
        for ((ray, value), allowed) in density.rays.iter().zip(&values).zip(allowed) {
            let error = (value[0] - ray.exact).abs();
            let scale = ray.size.max(1e-37);
            rays += 1;
            good += u32::from(error <= SINGLE * scale);
            worst = worst.max(error / scale);
            // what is below the least normal number of the format is 0
            let is_right = error < 1e-37 || error - allowed <= SINGLE * scale;
            let is_empty = ray.args[6] == ray.args[7];
            if !is_right || is_empty && value[0] != 0.0 {
                let _ = writeln!(
                    wrong,
                    "{} on {:?}: {:e}, not {:e}; {:.1e} of ∫ |f|",
                    density.text,
                    ray.args,
                    value[0],
                    ray.exact,
                    error / scale
                );
            }
        }
        println!("{:<60} {worst:.0e}", density.text);
    }
    println!("{rays} rays, {good} within 1e-6 of ∫ |f|");
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn integrals_of_the_language_on_the_gpu() {
    let Some(gpu) = suite_gpu() else { return };
    let machine = Machine::Gpu(Box::new(gpu), Precision::Accurate);
    let at = [Point {
        args: vec![2.0, 1.0],
        params: Vec::new(),
    }];
    let mut wrong = String::new();
    for (text, exact) in OF_THE_LANGUAGE {
        let answer = compile(&format!("f(x, y) = {text}"));
        let program = answer
            .program
            .unwrap_or_else(|| panic!("{text}: {:?}", answer.diagnostics));
        let formula = &program.pictures()[0].formula;
        let found = machine
            .run(formula, What::Value, &at)
            .unwrap_or_else(|e| panic!("{text}: {e}"))[0][0];
        let error = ((found - exact) / exact).abs();
        println!("{text:<60} {error:.0e}");
        if error.is_nan() || error > 2e-6 {
            let _ = writeln!(wrong, "{text}: {found}, not {exact}");
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}
