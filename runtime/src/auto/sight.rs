//! What the eye sees of an error of the formula's value.

use std::fmt;

use pullback_compiler::SettingValue;
use pullback_compiler::scene::Space;

use super::Scenery;
use super::matter::Matter;
use super::points::{Sample, Subject};
use super::space::scale_and_spacing;

/// Change of a colour, of 1, below which it is not seen: half a step of 8 bits.
pub const COLOUR: f64 = 1.0 / 512.0;
/// Displacement of a line in pixels below which it is not seen.
pub const DISPLACEMENT: f64 = 0.25;
/// How far a line may pass from a sample and still be in sight of it, in pixels.
const IN_SIGHT: f64 = 2.0;
/// The greatest slope of a colour component along the hue circle, per turn: HSV rises by 1 in a sixth of a turn.
const HUE_SLOPE: f64 = 6.0;

/// What is seen at a sample.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sight {
    /// Change of the colour, of 1.
    pub colour: f64,
    /// Displacement of the lines in sight, or of the surface, in pixels.
    pub displacement: f64,
}

impl Sight {
    /// One is a number and the other is not: nothing in common.
    const OTHER: Self = Self {
        colour: 1.0,
        displacement: 0.0,
    };

    /// The greater of both colours and of both displacements.
    pub(super) fn max(self, other: Self) -> Self {
        Self {
            colour: self.colour.max(other.colour),
            displacement: self.displacement.max(other.displacement),
        }
    }

    /// Whether it can be seen.
    #[must_use]
    pub fn is_visible(self) -> bool {
        self.rank() >= 1.0
    }

    /// How many times the least that can be seen.
    #[must_use]
    pub fn rank(self) -> f64 {
        (self.colour / COLOUR).max(self.displacement / DISPLACEMENT)
    }
}

impl fmt::Display for Sight {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{:.2e} of a colour and {:.2e} pixels",
            self.colour, self.displacement
        )
    }
}

/// Where the lines of a pattern are.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Lines {
    /// At the multiples of a value.
    Every(f64),
    /// At zero.
    AtZero,
    /// As fine as fits on the screen: there is always one in sight.
    Everywhere,
}

/// A pattern over the range of a function: where its lines are, and how its colours change.
#[derive(Clone, Copy, Debug)]
struct Pattern {
    lines: Lines,
    /// Change of the value over which a colour component changes by 1, at the least.
    colour: f64,
}

/// Knows how a scene turns values into colours and lines.
#[derive(Clone, Copy, Debug)]
pub struct Eye {
    space: Space,
    value: Pattern,
    /// Of the levels of a family, on walls.
    levels: Pattern,
    matter: Matter,
    /// Whether lines and colours of a real function are of log |f|.
    logarithmic: bool,
}

impl Eye {
    pub fn new(scenery: &Scenery) -> Self {
        let space = scenery.program.pictures()[scenery.picture].scene.space;
        let setting = |name: &str, missing: f64| number(scenery.settings, name).unwrap_or(missing);
        let has = |name: &str| number(scenery.settings, name).is_some();
        // scenes whose lines are as fine as fits say how far apart they may be, in octaves
        let adaptive = has("octaves");
        let value = match space {
            Space::Complex => Pattern {
                lines: if adaptive || has("unit") {
                    Lines::Everywhere
                } else {
                    // rings are at equal distances of log |f|
                    Lines::Every(setting("ring_octaves", 1.0) * std::f64::consts::LN_2)
                },
                colour: std::f64::consts::TAU / HUE_SLOPE,
            },
            Space::Plane if adaptive => Pattern {
                lines: Lines::Everywhere,
                colour: setting("fade_octaves", 1.0) * std::f64::consts::LN_2,
            },
            Space::Plane if has("period") => Pattern {
                lines: Lines::Every(positive(setting("period", 0.0)).unwrap_or(1.0)),
                colour: f64::INFINITY,
            },
            Space::Plane if !has("color_scale") => Pattern {
                lines: Lines::AtZero,
                colour: f64::INFINITY,
            },
            Space::Plane | Space::Space => {
                let scale = positive(setting("color_scale", 1.0)).unwrap_or(1.0);
                // `spacing` of a family is between levels: its contour lines have their own
                let own = if has("contour_spacing") {
                    "contour_spacing"
                } else {
                    "spacing"
                };
                let spacing = positive(setting(own, 0.0));
                Pattern {
                    lines: Lines::Every(spacing.unwrap_or(0.25 * scale)),
                    colour: scale,
                }
            }
        };
        let (_, between) = scale_and_spacing(scenery.settings);
        Self {
            space,
            value,
            levels: Pattern {
                lines: Lines::Every(between),
                colour: f64::INFINITY,
            },
            matter: Matter::new(scenery.settings),
            logarithmic: adaptive,
        }
    }

    /// What is seen of the difference between the true value with its derivatives and that of a tier.
    pub fn difference(&self, sample: &Sample, truth: &[f64], found: &[f64]) -> Sight {
        match sample.subject {
            Subject::Picture if self.space == Space::Complex => self.phase(sample, truth, found),
            Subject::Picture => self.level(sample, truth, found, self.value),
            Subject::Surface => surface(sample, truth, found),
            Subject::Drawn(normal) => self.on_plane(sample, normal, truth, found, self.value),
            Subject::Lined(normal) => self.on_plane(sample, normal, truth, found, self.levels),
            Subject::Matter => self.matter.gas(truth, found),
            Subject::Cloud => self.matter.cloud(truth, found),
            Subject::Light => self.matter.glow(truth, found),
        }
    }

    /// Of a function of space on a plane: of its gradient what lies in the plane counts.
    fn on_plane(
        &self,
        sample: &Sample,
        normal: [f64; 3],
        truth: &[f64],
        found: &[f64],
        pattern: Pattern,
    ) -> Sight {
        let across: f64 = truth[1..].iter().zip(normal).map(|(g, n)| g * n).sum();
        let mut flat = truth.to_vec();
        for (slot, n) in flat[1..].iter_mut().zip(normal) {
            *slot -= across * n;
        }
        self.level(sample, &flat, found, pattern)
    }

    /// Of a real function of the plane, or on one.
    fn level(&self, sample: &Sample, truth: &[f64], found: &[f64], pattern: Pattern) -> Sight {
        let (&value, &got) = match (truth.first(), found.first()) {
            (Some(value), Some(got)) => (value, got),
            _ => return Sight::default(),
        };
        // the picture has the value in single precision, and draws what overflows like an infinity
        let (narrow, got) = (single(value), single(got));
        if !(narrow.is_finite() && got.is_finite()) {
            return if same(narrow, got) {
                Sight::default()
            } else {
                Sight::OTHER
            };
        }
        let rate = length(&truth[1..]) * sample.footprint;
        let size = if self.logarithmic && value != 0.0 {
            value.abs()
        } else {
            1.0
        };
        pattern.seen(value / size, (got - value).abs() / size, rate / size)
    }

    /// Of a complex function.
    fn phase(&self, sample: &Sample, truth: &[f64], found: &[f64]) -> Sight {
        let (&[re, im, ..], &[got_re, got_im, ..]) = (truth, found) else {
            return Sight::default();
        };
        let size = re.hypot(im);
        let parts = [(single(re), single(got_re)), (single(im), single(got_im))];
        if parts.iter().any(|(a, b)| !(a.is_finite() && b.is_finite())) || size == 0.0 {
            let alike = parts.iter().all(|&(a, b)| same(a, b));
            return if alike {
                Sight::default()
            } else {
                Sight::OTHER
            };
        }
        let error = (parts[0].1 - re).hypot(parts[1].1 - im) / size;
        let derivatives = truth[2..].chunks_exact(2).map(length);
        let rate = derivatives.sum::<f64>() / size * sample.footprint;
        self.value.seen(size.ln(), error, rate)
    }
}

impl Pattern {
    /// What is seen where a value that changes by `rate` from pixel to pixel has an error.
    fn seen(self, value: f64, error: f64, rate: f64) -> Sight {
        let (period, nearest) = match self.lines {
            Lines::Every(period) => (period, (value / period).round() * period),
            Lines::AtZero => (f64::INFINITY, 0.0),
            Lines::Everywhere => (f64::INFINITY, value),
        };
        // what is finer than a pixel is drawn as its mean
        if rate.is_nan() || rate >= period {
            return Sight::default();
        }
        let colour = error / self.colour;
        let in_sight = (value - nearest).abs() <= error + IN_SIGHT * rate;
        let displacement = if in_sight && error > 0.0 {
            error / rate
        } else {
            0.0
        };
        Sight {
            colour,
            displacement,
        }
    }
}

/// Of a surface: the displacement of the point along the gradient, and the turn of the normal as a colour.
fn surface(sample: &Sample, truth: &[f64], found: &[f64]) -> Sight {
    if truth.iter().any(|x| !x.is_finite()) {
        return Sight::default();
    }
    if found.iter().any(|x| !x.is_finite()) {
        return Sight::OTHER;
    }
    let (slope, got) = (length(&truth[1..]), length(&found[1..]));
    if slope == 0.0 || got == 0.0 {
        return Sight::default();
    }
    let turns = truth[1..].iter().zip(&found[1..]);
    let turn = turns
        .map(|(a, b)| (a / slope - b / got).powi(2))
        .sum::<f64>();
    Sight {
        colour: turn.sqrt(),
        // of what float32 makes of f - level
        displacement: (found[0] - truth[0]).abs() / (slope * sample.footprint),
    }
}

fn number(settings: &[SettingValue], name: &str) -> Option<f64> {
    settings
        .iter()
        .find(|s| s.spec.name == name)
        .map(|s| s.value.x)
}

fn positive(x: f64) -> Option<f64> {
    Some(x).filter(|x| *x > 0.0)
}

fn single(x: f64) -> f64 {
    f64::from(x as f32)
}

/// Whether two numbers are drawn alike, one of which is not finite.
fn same(a: f64, b: f64) -> bool {
    a == b || (a.is_nan() && b.is_nan())
}

fn length(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |sum: f64, x| sum.hypot(*x))
}

#[cfg(test)]
mod tests {
    use super::*;

    const PATTERN: Pattern = Pattern {
        lines: Lines::Every(1.0),
        colour: 4.0,
    };

    #[test]
    fn an_error_displaces_lines_in_sight() {
        // half a pixel off, a line one pixel away
        let seen = PATTERN.seen(3.001, 5e-4, 1e-3);
        assert!((seen.displacement - 0.5).abs() < 1e-12 && seen.is_visible());
        // no line near
        let seen = PATTERN.seen(3.4, 5e-4, 1e-3);
        assert_eq!(seen.displacement, 0.0);
        assert!(!seen.is_visible());
    }

    #[test]
    fn an_error_displaces_the_zero_line_or_lines_that_are_everywhere() {
        let with = |lines| Pattern { lines, ..PATTERN };
        let seen = with(Lines::AtZero).seen(1.0, 5e-4, 1e-3);
        assert_eq!(seen.displacement, 0.0);
        let seen = with(Lines::AtZero).seen(1e-3, 5e-4, 1e-3);
        assert!((seen.displacement - 0.5).abs() < 1e-12);
        let seen = with(Lines::Everywhere).seen(0.37, 5e-4, 1e-3);
        assert!((seen.displacement - 0.5).abs() < 1e-12);
    }

    #[test]
    fn an_error_changes_colours() {
        assert!(PATTERN.seen(3.4, 0.01, 0.1).is_visible());
        assert!(!PATTERN.seen(3.4, 0.005, 0.1).is_visible());
    }

    #[test]
    fn what_is_finer_than_a_pixel_is_not_seen() {
        assert_eq!(PATTERN.seen(3.0, 5.0, 1.5), Sight::default());
        assert_eq!(PATTERN.seen(3.0, 5.0, f64::NAN), Sight::default());
    }
}
