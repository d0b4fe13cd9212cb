//! Rays whose origin is moved: the integral takes what their numbers are rounded by.

use std::fmt::Write as _;

use pullback_compiler::integrate::{
    INPUTS, Otherwise, SHIFTED_INPUTS, field_integral, shifted_field_integral,
};
use pullback_compiler::lower::Precision;
use pullback_compiler::{EmitWhat, Target, What, compile};
use pullback_runtime::executor::Arithmetic;
use pullback_tests::accuracy::evaluators::Machine;
use pullback_tests::stability::classes::CLASSES;
use pullback_tests::stability::rays::{Distance, rays};
use pullback_tests::stability::{BOUND, measure};

use super::{formula, points};

/// Rays from 100 units away and more, moved in f64: what is left is within the bound, on every ray of every class.
#[test]
fn moved_rays_are_the_rays_that_are_meant() {
    let single = Machine::Processor(Arithmetic::Ieee32, Precision::Accurate);
    let rays: Vec<_> = rays(90, 11)
        .into_iter()
        .filter(|ray| ray.distance == Distance::Hundred)
        .collect();
    let (mut count, mut lost, mut wrong) = (0, 0, String::new());
    for class in &CLASSES {
        for o in measure(class, &rays, &single).unwrap().outcomes {
            count += 1;
            lost += u32::from(o.rounded > BOUND);
            if o.shifted > BOUND {
                let _ = writeln!(
                    wrong,
                    "{} on {:?}: {:.1e}, without rests {:.1e}",
                    class.formula, o.ray.numbers, o.shifted, o.rounded
                );
            }
        }
    }
    println!("{count} rays, {lost} of them are beyond {BOUND:.0e} without rests");
    assert!(wrong.is_empty(), "{wrong}");
}

/// Which of the roundings of a moved ray counts, in f64: on how many rays the integral changes by more than the bound without the rests
/// of the origin, of a, or of b. `RAYS=4000` takes more rays.
#[test]
fn roundings_of_a_moved_ray_count() {
    let count = std::env::var("RAYS").map_or(90, |n| n.parse().unwrap());
    let rays: Vec<_> = rays(count, 11)
        .into_iter()
        .filter(|ray| ray.distance == Distance::Hundred)
        .collect();
    let (mut all, mut beyond) = (0, [0, 0, 0]);
    for class in &CLASSES {
        let of = formula(class.formula);
        let made = shifted_field_integral(&of, Otherwise::Refuse).unwrap();
        let integral = made.into_formula(&of);
        let found = measure(class, &rays, &Machine::Reference).unwrap();
        all += found.outcomes.len();
        let without = |range: std::ops::Range<usize>| {
            let numbers = found.outcomes.iter().map(|o| {
                let (ray, mut rests) = o.ray.shifted();
                rests[range.clone()].fill(0.0);
                [ray.numbers.as_slice(), &rests].concat()
            });
            let at = points(numbers);
            Machine::Reference.run(&integral, What::Value, &at).unwrap()
        };
        let exact = without(0..0);
        for (k, range) in [0..3, 3..4, 4..5].into_iter().enumerate() {
            for ((exact, o), value) in exact.iter().zip(&found.outcomes).zip(without(range)) {
                let change = (value[0] - exact[0]).abs() / o.size.max(1e-37);
                beyond[k] += usize::from(change > BOUND);
            }
        }
    }
    println!("{all} rays, beyond {BOUND:.0e} without the rests of o, a, b: {beyond:?}");
    assert!(beyond.iter().sum::<usize>() > 0, "{beyond:?}");
}

/// Where nothing is rounded the integral is that of the ray as it is.
#[test]
fn rests_of_0_change_nothing() {
    let rays = rays(60, 3);
    for class in &CLASSES {
        let of = formula(class.formula);
        let plain = field_integral(&of, Otherwise::Refuse).unwrap();
        let shifted = shifted_field_integral(&of, Otherwise::Refuse).unwrap();
        assert!(!plain.is_shifted && shifted.is_shifted);
        let numbers = |rests: usize| {
            rays.iter().map(move |ray| {
                let mut numbers = ray.numbers.to_vec();
                numbers.extend(vec![0.0; rests]);
                numbers
            })
        };
        let [plain, shifted] =
            [(plain, 0), (shifted, SHIFTED_INPUTS.len() - INPUTS.len())].map(|(made, rests)| {
                let integral = made.into_formula(&of);
                let at = points(numbers(rests));
                Machine::Reference.run(&integral, What::Value, &at).unwrap()
            });
        for ((plain, shifted), ray) in plain.iter().zip(&shifted).zip(&rays) {
            let (plain, shifted) = (plain[0], shifted[0]);
            let is_far = ray.distance != Distance::Near;
            let scale = plain.abs().max(1e-3);
            let is_same = (plain - shifted).abs() <= 1e-9 * scale || plain.is_nan();
            assert!(
                is_far || is_same || plain == shifted,
                "{} on {:?}: {shifted:e}, not {plain:e}",
                class.formula,
                ray.numbers
            );
        }
    }
}

/// `emit --what shifted-integral` writes it in every shading language.
#[test]
fn shifted_integrals_are_emitted() {
    let program = compile("haze(x, y, z) = exp(-2 y)").program.unwrap();
    for target in [
        Target::Wgsl,
        Target::Glsl,
        Target::Hlsl,
        Target::Msl,
        Target::Spirv,
        Target::C,
    ] {
        let made = program.emit(0, EmitWhat::ShiftedIntegral, target, Precision::Accurate);
        let made = made.unwrap_or_else(|e| panic!("{target:?}: {e:?}"));
        if target == Target::Wgsl {
            let text = String::from_utf8(made).unwrap();
            let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
            let signature = "fn haze_shifted_integral(o: vec3f, d: vec3f, a: f32, b: f32, o_rest: vec3f, a_rest: f32, b_rest: f32)";
            assert!(text.contains(signature), "{text}");
        }
    }
}
