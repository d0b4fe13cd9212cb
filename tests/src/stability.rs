//! How far closed forms of ray integrals are off in binary32, class by class, on rays of every kind, against an adaptive
//! rule in f64 that knows nothing of them.

pub mod classes;
pub mod operations;
pub mod rays;
pub mod tables;

use pullback_compiler::formula::Formula;
use pullback_compiler::integrate::{Otherwise, field_integral, shifted_field_integral};
use pullback_compiler::{Evaluator, What, compile, compile_function};

use crate::accuracy::evaluators::{Machine, Point};
use crate::marches::quadrature::adaptive;
use classes::{Class, Poles};
use rays::{Distance, Ray, Slant};

/// What an error may be, as a part of ∫ |f|.
pub const BOUND: f64 = 1e-6;
/// Half a unit in the last place of binary32 beside 1.
const ROUNDING: f64 = 6e-8;
/// What is beyond counts as too large for binary32.
const LARGEST: f64 = 3e37;
/// What is below counts as 0 in binary32.
const LEAST: f64 = 1e-37;
/// Steps by which the place nearest to the centre is found.
const STEPS: usize = 4;
/// Greatest number of panels that a ray is begun with, each of two radians of the fastest wave; where that is not enough it is
/// left out.
const PANELS: f64 = 3000.0;

/// What was found on one ray. Errors are parts of ∫ |f|, infinite where the value is no number.
#[derive(Clone, Copy, Debug)]
pub struct Outcome {
    /// The ray.
    pub ray: Ray,
    /// ∫ f
    pub exact: f64,
    /// ∫ |f|
    pub size: f64,
    /// What the closed form gives.
    pub found: f64,
    /// Its error.
    pub error: f64,
    /// How much the exact integral changes where each of the eight numbers of the ray is rounded: the sum of the
    /// changes. Only known where the error is beyond the bound.
    pub moved: f64,
    /// The error where the origin was moved, in f64, to the place nearest to the centre, and what the numbers of the moved ray
    /// were rounded by is handed over; of origins that are not near.
    pub shifted: f64,
    /// The same without what they were rounded by.
    pub rounded: f64,
    /// The error of the textbook's form, where there is one.
    pub textbook: f64,
}

impl Outcome {
    /// Whether the error is within the bound and as many roundings of the numbers of the ray.
    #[must_use]
    pub fn is_within(&self, roundings: f64) -> bool {
        self.error <= BOUND || roundings > 0.0 && self.error <= BOUND + roundings * self.moved
    }
}

/// What was found of a class.
#[derive(Clone, Debug)]
pub struct Found {
    /// The class.
    pub class: Class,
    /// One for each ray on which the integral is a number that binary32 holds.
    pub outcomes: Vec<Outcome>,
}

/// The exact integral along a ray.
#[derive(Clone, Copy, Debug)]
struct Truth {
    value: f64,
    size: f64,
}

/// The formula of a density.
///
/// # Panics
/// It does not compile.
#[must_use]
pub fn formula(text: &str) -> Formula {
    let program = compile(&format!("f(x, y, z) = {text}")).program;
    let program = program.unwrap_or_else(|| panic!("{text}"));
    program.pictures()[0].formula.clone()
}

/// F(b) - F(a) as a function of the ray, of an antiderivative as [`Class::textbook`] has it.
///
/// # Panics
/// It does not compile.
#[must_use]
pub fn textbook(antiderivative: &str) -> Formula {
    let text = format!(
        "f(o: vec3, d: vec3, a: real, b: real) = F(o, d, b) - F(o, d, a)\n\
         F(o: vec3, d: vec3, t: real) = G(t, o.y + t d.y, d.y, dot(d, d), dot(o, d), dot(o, o))\n\
         G(t, v, w, A, B, C) = H(t, v, w, A, B, C, A C - B^2, A t^2 + 2 B t + C)\n\
         H(t, v, w, A, B, C, D, q) = {antiderivative}\n"
    );
    compile_function(&text).unwrap_or_else(|e| panic!("{text}: {e:?}"))
}

/// ∫ of a density as a function of the ray.
///
/// # Panics
/// A part of the density has no closed form.
#[must_use]
pub fn closed_form(of: &Formula) -> Formula {
    let made = field_integral(of, Otherwise::Refuse);
    made.unwrap_or_else(|e| panic!("{e:?}")).into_formula(of)
}

/// The same as a function of a ray whose origin was moved, and of what its numbers were rounded by.
///
/// # Panics
/// A part of the density has no closed form.
#[must_use]
pub fn shifted_closed_form(of: &Formula) -> Formula {
    let made = shifted_field_integral(of, Otherwise::Refuse);
    made.unwrap_or_else(|e| panic!("{e:?}")).into_formula(of)
}

/// Measures a class on the rays, by the machine.
///
/// # Errors
/// The machine's, in words.
///
/// # Panics
/// A part of the density has no closed form.
pub fn measure(class: &Class, rays: &[Ray], machine: &Machine) -> Result<Found, String> {
    measure_changed(class, rays, machine, &|integral| integral)
}

/// The same of integrals with a change.
///
/// # Errors
/// The machine's, in words.
///
/// # Panics
/// A part of the density has no closed form.
pub fn measure_changed(
    class: &Class,
    rays: &[Ray],
    machine: &Machine,
    change: &dyn Fn(Formula) -> Formula,
) -> Result<Found, String> {
    let of = formula(class.formula);
    let integral = change(closed_form(&of));
    is_written_alike(class, &of, rays)?;
    let exact: Vec<(Ray, Truth)> = rays
        .iter()
        .filter_map(|ray| Some((*ray, truth(class, ray)?)))
        .collect();
    let run = |formula: &Formula, of: &dyn Fn(&Ray) -> Vec<f64>| -> Result<Vec<f64>, String> {
        let point = |(ray, _): &(Ray, Truth)| Point {
            args: of(ray),
            params: Vec::new(),
        };
        let points: Vec<Point> = exact.iter().map(point).collect();
        let rows = machine.run(formula, What::Value, &points)?;
        Ok(rows.iter().map(|row| row[0]).collect())
    };
    let as_it_is = |ray: &Ray| ray.numbers.to_vec();
    let own = run(&integral, &as_it_is)?;
    let rounded = run(&integral, &|ray| ray.shifted().0.numbers.to_vec())?;
    let shifted = run(&change(shifted_closed_form(&of)), &|ray| {
        let (ray, rests) = ray.shifted();
        [ray.numbers.as_slice(), &rests].concat()
    })?;
    let naive = match class.textbook {
        Some(text) => run(&textbook(text), &as_it_is)?,
        None => vec![f64::NAN; exact.len()],
    };
    let outcome = |(k, (ray, truth)): (usize, &(Ray, Truth))| Outcome {
        ray: *ray,
        exact: truth.value,
        size: truth.size,
        found: own[k],
        error: error(own[k], truth),
        moved: 0.0,
        shifted: error(shifted[k], truth),
        rounded: error(rounded[k], truth),
        textbook: error(naive[k], truth),
    };
    let mut outcomes: Vec<Outcome> = exact.iter().enumerate().map(outcome).collect();
    let beyond: Vec<usize> = (0..exact.len())
        .filter(|&k| outcomes[k].error > BOUND)
        .collect();
    let rays: Vec<Ray> = beyond.iter().map(|&k| exact[k].0).collect();
    for (k, moved) in beyond.into_iter().zip(movements(&integral, &rays)?) {
        outcomes[k].moved = moved / exact[k].1.size.max(LEAST);
    }
    Ok(Found {
        class: *class,
        outcomes,
    })
}

/// Compares the density of the reference with the formula, in the middles of some rays.
fn is_written_alike(class: &Class, of: &Formula, rays: &[Ray]) -> Result<(), String> {
    let mut evaluator = Evaluator::new(of, What::Value).map_err(|e| format!("{e:?}"))?;
    for ray in rays.iter().take(100) {
        let p = ray.at(0.5 * ray.numbers[6] + 0.5 * ray.numbers[7]);
        let mut out = [0.0];
        evaluator.eval(&[], 0.0, 0.0, &p, &mut out);
        let (own, other) = ((class.density)(p), out[0]);
        let is_near = (own - other).abs() <= 1e-9 * own.abs().max(1e-3);
        if !is_near && own.is_finite() {
            return Err(format!("{} is {other:e}, not {own:e}", class.formula));
        }
    }
    Ok(())
}

fn point(ray: &Ray) -> Point {
    Point {
        args: ray.numbers.to_vec(),
        params: Vec::new(),
    }
}

/// What is below the least normal number of the format is 0.
fn error(found: f64, truth: &Truth) -> f64 {
    let off = (found - truth.value).abs();
    if off.is_nan() {
        f64::INFINITY
    } else if off < LEAST {
        0.0
    } else {
        off / truth.size.max(LEAST)
    }
}

/// How much the integral along each ray changes where each number of the ray is rounded, the sum over the eight.
fn movements(integral: &Formula, rays: &[Ray]) -> Result<Vec<f64>, String> {
    let mut points = Vec::new();
    for ray in rays {
        points.push(point(ray));
        for k in 0..8 {
            let mut moved = *ray;
            moved.numbers[k] += ROUNDING * moved.numbers[k].abs();
            points.push(point(&moved));
        }
    }
    let rows = Machine::Reference.run(integral, What::Value, &points)?;
    let change = |rows: &[Vec<f64>]| {
        rows[1..]
            .iter()
            .map(|row| (row[0] - rows[0][0]).abs())
            .sum()
    };
    Ok(rows.chunks(9).map(change).collect())
}

/// A ray whose t is counted from the place of its interval that is nearest to the centre, so that f64 tells how it passes there.
struct Seen {
    base: [f64; 3],
    direction: [f64; 3],
    ends: [f64; 2],
}

impl Seen {
    fn of(ray: &Ray) -> Self {
        let n = ray.numbers;
        let mut out = Self {
            base: [n[0], n[1], n[2]],
            direction: [n[3], n[4], n[5]],
            ends: [n[6].min(n[7]), n[6].max(n[7])],
        };
        // each step finds the rest of the last one, which was rounded
        for _ in 0..STEPS {
            let foot = out.foot().clamp(out.ends[0], out.ends[1]);
            out.base = out.at(foot);
            out.ends = out.ends.map(|t| t - foot);
        }
        out
    }

    fn square(&self) -> f64 {
        self.direction.iter().map(|d| d * d).sum()
    }

    /// Where the line is nearest to the centre.
    fn foot(&self) -> f64 {
        let along: f64 = (0..3).map(|c| self.base[c] * self.direction[c]).sum();
        let square = self.square();
        if square > 0.0 { -along / square } else { 0.0 }
    }

    fn at(&self, t: f64) -> [f64; 3] {
        std::array::from_fn(|c| t.mul_add(self.direction[c], self.base[c]))
    }

    /// Whether the ray goes through the centre, in the interval. Products of numbers of binary32 are exact in f64.
    fn meets(&self, ray: &Ray) -> bool {
        let n = ray.numbers;
        let is_parallel = |(i, j): (usize, usize)| n[i] * n[3 + j] == n[j] * n[3 + i];
        let is_inside = (self.ends[0]..=self.ends[1]).contains(&self.foot());
        is_inside && [(0, 1), (1, 2), (2, 0)].into_iter().all(is_parallel)
    }
}

/// The integral, where it is a number that binary32 holds and so is f on the way, of a pole that is integrable any number.
fn truth(class: &Class, ray: &Ray) -> Option<Truth> {
    let seen = Seen::of(ray);
    if class.poles == Poles::Weak && seen.meets(ray) {
        return None;
    }
    let places = places(class, &seen)?;
    let (mut greatest, mut low, mut high): (f64, f64, f64) =
        (0.0, f64::INFINITY, f64::NEG_INFINITY);
    let mut has_pole = false;
    let exact = adaptive(&places, |t| {
        if has_pole {
            return f64::NAN;
        }
        let f = (class.density)(seen.at(t));
        greatest = greatest.max(if f.is_nan() { f64::INFINITY } else { f.abs() });
        (low, high) = (low.min(f), high.max(f));
        // f changes its sign there, or is beyond all that it is elsewhere
        has_pole = class.poles == Poles::Strong && (low < 0.0 && high > 0.0 || greatest > 1e6);
        f
    });
    let largest = if class.poles == Poles::Weak {
        f64::INFINITY
    } else {
        LARGEST
    };
    let is_number = greatest < largest && exact.value.is_finite() && exact.size < LARGEST;
    let sign = if ray.numbers[6] > ray.numbers[7] {
        -1.0
    } else {
        1.0
    };
    (is_number && !has_pole).then_some(Truth {
        value: sign * exact.value,
        size: exact.size,
    })
}

/// Where panels begin and end: at the ends, around the place nearest to the centre and those where a coordinate is 0, at
/// distances that grow by the factor 4, and evenly where the density turns.
fn places(class: &Class, seen: &Seen) -> Option<Vec<f64>> {
    let ends = seen.ends;
    let square = seen.square();
    let speed = square.sqrt();
    let pieces = (class.turns * speed * (ends[1] - ends[0]) / 2.0).ceil();
    if pieces > PANELS {
        return None;
    }
    let mut out = vec![ends[0], ends[1]];
    let mut around = |centre: f64, mut step: f64| {
        while step > 0.0 && step < 1e6 {
            out.extend([centre - step, centre, centre + step]);
            step *= 4.0;
        }
    };
    for (base, slope) in seen.base.iter().zip(seen.direction) {
        if slope != 0.0 {
            around(-base / slope, 0.05 / slope.abs());
        }
    }
    if square > 0.0 {
        let foot = seen.foot();
        let miss = seen.at(foot).iter().map(|x| x * x).sum::<f64>().sqrt();
        let least = if class.poles == Poles::Weak {
            1e-100
        } else {
            1e-9
        };
        around(foot, miss.clamp(least, 0.1) / speed);
    }
    let width = (ends[1] - ends[0]) / pieces.max(1.0);
    out.extend((1..pieces as u32).map(|k| ends[0] + f64::from(k) * width));
    out.retain(|t| (ends[0]..=ends[1]).contains(t));
    out.sort_by(f64::total_cmp);
    out.dedup();
    Some(out)
}

impl Found {
    /// The outcomes of origins at this distance.
    pub fn at(&self, distance: Distance) -> impl Iterator<Item = &Outcome> {
        self.outcomes
            .iter()
            .filter(move |o| o.ray.distance == distance)
    }

    /// The outcomes of origins that are near, of rays of this slant.
    pub fn slanted(&self, slant: Slant) -> impl Iterator<Item = &Outcome> {
        self.at(Distance::Near)
            .filter(move |o| o.ray.slant == slant)
    }
}
