//! What is seen of an error of a value that is a medium, a cloud or a distance.

use pullback_compiler::SettingValue;

use super::sight::Sight;
use super::space::setting;

/// What a value looks like where it is the density or the light of a volume.
#[derive(Clone, Copy, Debug)]
pub struct Matter {
    scale: f64,
    power: f64,
    /// Optical depth across the shortest side of the box where |f| = scale, or f = 1.
    depth: f64,
    signs: u32,
    lighting: f64,
    exposure: f64,
    reinhard: bool,
    gamma: f64,
    /// Of `glow`: width of the surface, factor of the light, whether it falls off by the square, and whether f is a
    /// distance as it is.
    epsilon: f64,
    gain: f64,
    square: bool,
    as_it_is: bool,
}

/// Ratios of a value to the scale above this count as this.
const DENSEST: f64 = 1e6;

impl Matter {
    pub fn new(settings: &[SettingValue]) -> Self {
        let vector = |name| setting(settings, name).unwrap_or_default();
        let number = |name: &str, missing: f64| setting(settings, name).map_or(missing, |v| v[0]);
        let half = vector("box");
        let shortest = half.into_iter().fold(f64::INFINITY, f64::min);
        let (absorbed, scattered) = (vector("absorption"), vector("scattering"));
        let of_cloud = (0..3)
            .map(|k| absorbed[k] + scattered[k])
            .fold(0.0, f64::max);
        let scale = number("color_scale", 0.0);
        Self {
            scale: if scale > 0.0 { scale } else { 1.0 },
            power: number("power", 1.0),
            depth: 2.0 * number("density", of_cloud),
            signs: number("signs", 0.0) as u32,
            lighting: number("lighting", 0.0),
            exposure: number("exposure", 1.0),
            reinhard: number("tone", 0.0) == 0.0,
            gamma: number("gamma", 1.0),
            epsilon: number("epsilon", 0.01) * shortest,
            gain: number("gain", 1.0),
            square: number("falloff", 0.0) == 0.0,
            as_it_is: number("estimate", 0.0) == 1.0,
        }
    }

    /// Light and opacity of the box's shortest side, were it all of this value.
    fn shown(&self, value: f64) -> (f64, f64) {
        let hidden = (self.signs == 1 && value < 0.0) || (self.signs == 2 && value >= 0.0);
        if hidden || value.is_nan() {
            return (0.0, 0.0);
        }
        let x = (value.abs() / self.scale).min(DENSEST);
        let opacity = -(-self.depth * x.powf(self.power)).exp_m1();
        let light = self.exposure * opacity * 2.0 * x / (1.0 + x);
        let curved = if self.reinhard {
            light / (1.0 + light)
        } else {
            light.min(1.0)
        };
        (curved.powf(1.0 / self.gamma), opacity)
    }

    /// Of a gas that emits and absorbs: the change of its light, of what comes through it, and of its shading.
    pub fn gas(&self, truth: &[f64], found: &[f64]) -> Sight {
        let (&value, &got) = match (truth.first(), found.first()) {
            (Some(value), Some(got)) => (value, got),
            _ => return Sight::default(),
        };
        let ((light, opacity), (got_light, got_opacity)) = (self.shown(value), self.shown(got));
        let other_sign = (value < 0.0) != (got < 0.0);
        let change = if other_sign {
            light + got_light
        } else {
            (light - got_light).abs()
        };
        let shading = self.lighting * turn(&truth[1..], &found[1..]) * light;
        Sight {
            colour: change.max((opacity - got_opacity).abs()).max(shading),
            displacement: 0.0,
        }
    }

    /// Of a cloud: the change of what comes through it.
    pub fn cloud(&self, truth: &[f64], found: &[f64]) -> Sight {
        let through = |row: &[f64]| {
            let density = row.first().copied().unwrap_or(0.0).max(0.0);
            (-self.depth * density).exp()
        };
        Sight {
            colour: (through(truth) - through(found)).abs(),
            displacement: 0.0,
        }
    }

    /// Of light around a surface: the change of the light that comes from as far along the ray as the point is from the
    /// surface.
    pub fn glow(&self, truth: &[f64], found: &[f64]) -> Sight {
        let near = |row: &[f64]| {
            let slope = if self.as_it_is {
                1.0
            } else {
                length(&row[1..])
            };
            let value = row.first().copied().unwrap_or(f64::NAN);
            // what has no distance emits nothing
            Some(self.epsilon + value.abs() / slope.max(1e-37)).filter(|near| near.is_finite())
        };
        let light = |near: Option<f64>| {
            near.map_or(0.0, |near| {
                let falloff = if self.square {
                    self.epsilon / near
                } else {
                    1.0
                };
                self.gain * falloff / near
            })
        };
        let (near, got) = (near(truth), near(found));
        // over a length of the nearer distance both are about as bright as here
        let reach = near
            .unwrap_or(f64::INFINITY)
            .min(got.unwrap_or(f64::INFINITY));
        let change = (light(near) - light(got)).abs();
        Sight {
            colour: if change > 0.0 {
                (change * reach).min(1.0)
            } else {
                0.0
            },
            displacement: 0.0,
        }
    }
}

/// Distance of the directions of two gradients, as far as both have one.
fn turn(a: &[f64], b: &[f64]) -> f64 {
    let (size, other) = (length(a), length(b));
    if !(size > 0.0 && other > 0.0 && size.is_finite() && other.is_finite()) {
        return 0.0;
    }
    let parts = a.iter().zip(b);
    parts
        .map(|(a, b)| (a / size - b / other).powi(2))
        .sum::<f64>()
        .sqrt()
}

fn length(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |sum: f64, x| sum.hypot(*x))
}
