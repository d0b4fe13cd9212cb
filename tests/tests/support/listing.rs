//! The generated programs that have values of 60 digits, each with a point.

use pullback_tests::mutate::Random;

use super::formulas::{any_real, holomorphic, samples, smooth};

/// A generated program at a point.
pub struct Generated {
    /// Of z; else of x and y.
    pub is_complex: bool,
    /// The formula.
    pub body: String,
    /// x and y, or the parts of z.
    pub point: [f64; 2],
}

/// Ten thousand of them, the same in every run.
pub fn programs() -> Vec<Generated> {
    let mut random = Random::new(60);
    let mut all = Vec::new();
    let mut add = |bodies: Vec<String>, is_complex: bool| {
        all.extend(bodies.into_iter().map(|body| Generated {
            is_complex,
            body,
            point: [coordinate(&mut random), coordinate(&mut random)],
        }));
    };
    add(samples(4500, &smooth()), false);
    add(samples(4000, &any_real()), false);
    add(samples(1500, &holomorphic()), true);
    all
}

/// Mostly any number from -3 to 3; at times a zero of either sign, or a whole number.
fn coordinate(random: &mut Random) -> f64 {
    match random.below(16) {
        0 => 0.0,
        1 => -0.0,
        2 => random.below(7) as f64 - 3.0,
        _ => random.below(6 << 40) as f64 / (1u64 << 40) as f64 - 3.0,
    }
}

/// A line for each: kind, formula, and point.
pub fn listing(programs: &[Generated]) -> String {
    let line = |program: &Generated| {
        let kind = if program.is_complex {
            "complex"
        } else {
            "real"
        };
        let [x, y] = program.point;
        format!("{kind}\t{}\t{x:?}\t{y:?}\n", program.body)
    };
    programs.iter().map(line).collect()
}
