//! How far the numbers are from the true ones that a picture is made of.

use super::judgement::Spread;
use super::readings::{Meaning, Quantity, Reading};

/// How far a quantity is from the truth, over the middles of the pixels at which the truth is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Number {
    /// Which.
    pub quantity: Quantity,
    /// The errors, in [`Quantity::unit`], where both have a number.
    pub error: Spread,
    /// Share of the pixels at which one has a number, a surface, and the other has none.
    pub apart: f64,
    /// At how many pixels there is something to compare.
    pub pixels: usize,
}

/// Pictures of numbers, one for each reading of the scene, all of the same pixels.
pub(super) type Pictures = Vec<Vec<[f64; 4]>>;

/// What a pixel has of a formula.
#[derive(Clone, Copy, Debug, Default)]
struct Field {
    value: [f64; 2],
    slopes: [f64; 4],
    /// Change of the value from pixel to pixel.
    rate: f64,
}

/// Errors of the pixels of one quantity, on their way.
#[derive(Debug)]
struct Tally {
    quantity: Quantity,
    errors: Vec<f64>,
    apart: usize,
}

impl Tally {
    fn new(quantity: Quantity) -> Self {
        Self {
            quantity,
            errors: Vec::new(),
            apart: 0,
        }
    }

    /// Adds an error; without a number, both are apart.
    fn add(&mut self, error: Option<f64>) {
        match error.filter(|e| e.is_finite()) {
            Some(error) => self.errors.push(error),
            None => self.apart += 1,
        }
    }

    fn number(self) -> Option<Number> {
        let pixels = self.errors.len() + self.apart;
        (pixels > 0).then(|| Number {
            quantity: self.quantity,
            error: Spread::of(self.errors),
            apart: self.apart as f64 / pixels as f64,
            pixels,
        })
    }
}

/// Judges a choice's numbers by the true ones. `pixel` is the side of a pixel of the plane in world units, and `height`
/// that of the view, both 0 in space.
pub(super) fn compare(
    readings: &[Reading],
    truth: &Pictures,
    found: &Pictures,
    [pixel, height]: [f64; 2],
) -> Vec<Number> {
    let all = Quantity::ALL.map(Tally::new);
    let [
        mut value,
        mut gradient,
        mut position,
        mut depth,
        mut radiance,
    ] = all;
    let count = truth.first().map_or(0, Vec::len);
    for k in 0..count {
        let (truth, found) = (at(truth, k), at(found, k));
        if truth.iter().chain(&found).all(|n| *n == [0.0; 4]) {
            continue;
        }
        if let Some((truth, found)) =
            field(readings, &truth, pixel).zip(field(readings, &found, pixel))
        {
            value.add(value_error(&truth, &found));
            gradient.add(gradient_error(&truth, &found, height));
            if truth.rate > 0.0 && truth.rate.is_finite() {
                position.add(displacement(&truth, &found));
            }
        }
        for (reading, (truth, found)) in readings.iter().zip(truth.iter().zip(&found)) {
            match reading.meaning {
                Meaning::Distance => {
                    depth.add(both(truth[1], found[1], || (truth[0] - found[0]).abs()))
                }
                Meaning::Point => depth.add(both(truth[3], found[3], || {
                    length(&difference(&truth[..3], &found[..3]))
                })),
                Meaning::Light => radiance.add(light_error(truth, found)),
                _ => {}
            }
        }
    }
    [value, gradient, position, depth, radiance]
        .into_iter()
        .filter_map(Tally::number)
        .collect()
}

fn at(pictures: &Pictures, k: usize) -> Vec<[f64; 4]> {
    let missing = [f64::NAN; 4];
    let one = |picture: &Vec<[f64; 4]>| picture.get(k).copied().unwrap_or(missing);
    pictures.iter().map(one).collect()
}

/// The formula's numbers at a pixel, if the scene's readings are of those.
fn field(readings: &[Reading], numbers: &[[f64; 4]], pixel: f64) -> Option<Field> {
    let mut out = Field::default();
    let mut is_field = false;
    let mut unit = 1.0;
    for (reading, &[a, b, c, d]) in readings.iter().zip(numbers) {
        match reading.meaning {
            Meaning::Jet(3) => {
                is_field = true;
                (out.value[0], out.slopes) = (c, [a, b, 0.0, 0.0]);
                out.rate = a.hypot(b) * pixel;
            }
            Meaning::Jet(_) => {
                is_field = true;
                (out.value[0], out.slopes) = (d, [a, b, c, 0.0]);
            }
            Meaning::Rate => out.rate = a,
            Meaning::Complex => {
                is_field = true;
                unit = c.exp2();
                out.value = [a * unit, b * unit];
            }
            Meaning::Derivatives => {
                out.slopes = [a, b, c, d].map(|slope| slope * unit);
                out.rate = (a.hypot(b) + c.hypot(d)) * unit * pixel;
            }
            Meaning::Distance | Meaning::Point | Meaning::Light => {}
        }
    }
    is_field.then_some(out)
}

/// The error of the value, relative to it, or, where that is more, to its change over a pixel.
fn value_error(truth: &Field, found: &Field) -> Option<f64> {
    relative(&truth.value, &found.value, truth.rate)
}

/// The error of the gradient, relative to it, or, where that is more, to the slope by which the value would change by
/// itself over the height of the view.
fn gradient_error(truth: &Field, found: &Field, height: f64) -> Option<f64> {
    let floor = if height > 0.0 {
        length(&truth.value) / height
    } else {
        0.0
    };
    relative(&truth.slopes, &found.slopes, floor)
}

/// How far the error of the value moves a line, in pixels, to first order.
fn displacement(truth: &Field, found: &Field) -> Option<f64> {
    if !alike(&truth.value, &found.value)? {
        return Some(0.0);
    }
    Some(length(&difference(&truth.value, &found.value)) / truth.rate)
}

/// Nothing where one has a number and the other has not; 0 where neither has, and both have the same instead.
fn relative(truth: &[f64], found: &[f64], floor: f64) -> Option<f64> {
    if !alike(truth, found)? {
        return Some(0.0);
    }
    let error = length(&difference(truth, found));
    let floor = if floor.is_finite() { floor } else { 0.0 };
    let scale = length(truth).max(floor);
    Some(if error == 0.0 { 0.0 } else { error / scale })
}

/// Whether both are numbers; nothing where they have nothing in common. What overflows single precision is infinite.
fn alike(truth: &[f64], found: &[f64]) -> Option<bool> {
    let narrow = |x: &f64| f64::from(*x as f32);
    let is_number = |all: &[f64]| all.iter().all(|x| narrow(x).is_finite());
    match (is_number(truth), is_number(found)) {
        (true, true) => Some(true),
        (false, false) => {
            let same = |(a, b): (&f64, &f64)| {
                let (a, b) = (narrow(a), narrow(b));
                a == b || (a.is_nan() && b.is_nan()) || (a.is_finite() && b.is_finite())
            };
            truth.iter().zip(found).all(same).then_some(false)
        }
        _ => None,
    }
}

/// An error where both have a surface, 0 where neither has.
fn both(truth: f64, found: f64, error: impl Fn() -> f64) -> Option<f64> {
    match (truth > 0.0, found > 0.0) {
        (true, true) => Some(error()),
        (false, false) => Some(0.0),
        _ => None,
    }
}

fn light_error(truth: &[f64; 4], found: &[f64; 4]) -> Option<f64> {
    if !alike(&truth[..3], &found[..3])? {
        return Some(0.0);
    }
    let apart = difference(&truth[..3], &found[..3]);
    Some(apart.iter().fold(0.0, |most: f64, x| most.max(x.abs())))
}

fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

fn length(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |sum: f64, x| sum.hypot(*x))
}

#[cfg(test)]
mod tests {
    use super::super::readings::readings;
    use super::*;

    fn of(numbers: &[Number], quantity: Quantity) -> &Number {
        numbers.iter().find(|n| n.quantity == quantity).unwrap()
    }

    #[test]
    fn a_plane_has_value_gradient_and_position() {
        let truth = vec![vec![[3.0, 4.0, 10.0, 0.0], [3.0, 4.0, 0.0, 0.0]]];
        let found = vec![vec![[3.0, 4.0, 10.1, 0.0], [3.0, 4.5, 0.05, 0.0]]];
        let numbers = compare(readings("levels"), &truth, &found, [0.1, 2.0]);
        // relative to 10, and to the change of 0.5 over a pixel
        let value = of(&numbers, Quantity::Value);
        assert!((value.error.max - 0.1).abs() < 1e-12, "{numbers:?}");
        let gradient = of(&numbers, Quantity::Gradient);
        assert!((gradient.error.max - 0.1).abs() < 1e-12, "{numbers:?}");
        let position = of(&numbers, Quantity::Position);
        assert!((position.error.max - 0.2).abs() < 1e-12, "{numbers:?}");
        assert_eq!((numbers.len(), value.apart, value.pixels), (3, 0.0, 2));
    }

    #[test]
    fn complex_derivatives_count_together() {
        let truth = vec![vec![[3.0, 4.0, 0.0, 0.0]], vec![[0.0, 2.0, 0.0, 0.0]]];
        let found = vec![vec![[3.0, 4.5, 0.0, 0.0]], vec![[0.0, 2.0, 0.0, 1.0]]];
        let numbers = compare(readings("domain"), &truth, &found, [0.5, 100.0]);
        let max = |quantity| of(&numbers, quantity).error.max;
        assert!((max(Quantity::Value) - 0.1).abs() < 1e-12);
        assert!((max(Quantity::Gradient) - 0.5).abs() < 1e-12);
        assert!((max(Quantity::Position) - 0.5).abs() < 1e-12);
    }

    #[test]
    fn what_is_beyond_single_precision_is_by_a_power_of_two() {
        let truth = vec![vec![[3e30, 4e30, 0.0, 0.0]], vec![[0.0, 2e30, 0.0, 0.0]]];
        let by = 2f64.powi(-40);
        let parts = [3e30, 4e30, 2e30].map(|x| x * by);
        let value = [parts[0], parts[1], 40.0, 0.0];
        let found = vec![vec![value], vec![[0.0, parts[2], 0.0, 0.0]]];
        let numbers = compare(readings("domain"), &truth, &found, [0.5, 100.0]);
        for quantity in [Quantity::Value, Quantity::Gradient] {
            let number = of(&numbers, quantity);
            assert_eq!((number.error.max, number.apart), (0.0, 0.0));
        }
    }

    #[test]
    fn surfaces_that_one_misses_are_counted_apart() {
        let truth = vec![vec![[2.0, 1.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0; 4]]];
        let found = vec![vec![[2.5, 1.0, 0.0, 0.0], [0.0; 4], [0.0; 4]]];
        let numbers = compare(readings("surface"), &truth, &found, [0.0; 2]);
        let depth = of(&numbers, Quantity::Depth);
        assert_eq!((depth.error.max, depth.apart, depth.pixels), (0.5, 0.5, 2));
        let truth = vec![vec![[1.0, 2.0, 3.0, 0.5]]];
        let found = vec![vec![[1.0, 2.0, 3.25, 0.1]]];
        let numbers = compare(readings("nested"), &truth, &found, [0.0; 2]);
        assert_eq!(of(&numbers, Quantity::Depth).error.max, 0.25);
    }

    #[test]
    fn what_is_no_number_in_one_alone_is_apart() {
        let nan = f64::NAN;
        let truth = vec![vec![[nan, nan, nan, 0.0], [1.0, 0.0, 1e39, 0.0]]];
        let found = vec![vec![[nan, nan, nan, 0.0], [1.0, 0.0, f64::INFINITY, 0.0]]];
        let numbers = compare(readings("levels"), &truth, &found, [0.1, 2.0]);
        let value = of(&numbers, Quantity::Value);
        assert_eq!((value.error.max, value.apart), (0.0, 0.0));
        let numbers = compare(
            readings("levels"),
            &truth,
            &vec![vec![[0.0, 0.0, 1.0, 0.0]; 2]],
            [0.1, 2.0],
        );
        assert_eq!(of(&numbers, Quantity::Value).apart, 1.0);
    }

    #[test]
    fn light_is_judged_by_its_worst_component() {
        let truth = vec![vec![[0.5, 2.0, 0.25, 0.0]]];
        let found = vec![vec![[0.5, 1.75, 0.375, 0.0]]];
        let numbers = compare(readings("glow"), &truth, &found, [0.0; 2]);
        assert_eq!(of(&numbers, Quantity::Radiance).error.max, 0.25);
    }
}
