//! The choices that a picture offers between speed and accuracy.

use glam::DVec3;
use pullback_compiler::lower::Precision;
use pullback_compiler::scene::{SettingKind, Space};
use pullback_compiler::{Picture, SettingValue};

/// Factors by which a number that trades speed for accuracy is tried, beside itself.
const FACTORS: [f64; 4] = [0.25, 0.5, 2.0, 4.0];
/// Samples of a pixel along each axis that are tried; those of space cost a walk along a ray each.
const PLANE_SAMPLES: &[u32] = &[1, 2, 3, 4];
const SPACE_SAMPLES: &[u32] = &[1, 2, 3];

/// One way to draw the picture.
#[derive(Clone, Debug)]
pub struct Choice {
    /// What it differs in from the default, such as `steps = 80`; empty for the default itself.
    pub changes: Vec<String>,
    /// The tier.
    pub precision: Precision,
    /// All settings of the scene.
    pub settings: Vec<SettingValue>,
    /// Samples along each axis of a pixel.
    pub samples: u32,
}

impl Choice {
    /// In words.
    #[must_use]
    pub fn name(&self) -> String {
        if self.changes.is_empty() {
            "default".to_owned()
        } else {
            self.changes.join(", ")
        }
    }

    /// With another tier.
    #[must_use]
    pub fn with_precision(&self, precision: Precision) -> Self {
        let mut out = self.clone();
        out.changes.push(precision.name().to_owned());
        out.precision = precision;
        out
    }

    /// With other samples.
    #[must_use]
    pub fn with_samples(&self, samples: u32) -> Self {
        let mut out = self.clone();
        out.changes.push(format!("samples = {samples}"));
        out.samples = samples;
        out
    }

    /// With another value of one setting, which `word` tells.
    fn with_setting(&self, k: usize, value: f64, word: &str) -> Self {
        let mut out = self.clone();
        out.changes
            .push(format!("{} = {word}", self.settings[k].spec.name));
        out.settings[k].value = DVec3::splat(value);
        out
    }
}

/// The default, and what can be had instead of it: one change at a time, then those that are cheap together.
#[must_use]
pub fn choices(picture: &Picture, default: &Choice, tiers: &[Precision]) -> Vec<Choice> {
    let mut all = vec![default.clone()];
    let others = tiers.iter().filter(|&&tier| tier != default.precision);
    all.extend(others.map(|&tier| default.with_precision(tier)));
    let samples = match picture.scene.space {
        Space::Space => SPACE_SAMPLES,
        Space::Plane | Space::Complex => PLANE_SAMPLES,
    };
    let other_samples = || samples.iter().filter(|&&n| n != default.samples);
    all.extend(other_samples().map(|&n| default.with_samples(n)));
    let traded = traded(default);
    all.extend(traded.iter().cloned());
    for choice in &traded {
        all.extend(
            other_samples()
                .filter(|&&n| n < 3)
                .map(|&n| choice.with_samples(n)),
        );
    }
    if default.precision != Precision::Fast && tiers.contains(&Precision::Fast) {
        let cheap = default.with_precision(Precision::Fast);
        all.push(cheap.with_samples(1));
        let halves = |choice: Choice| choice.with_samples(1);
        all.extend(lesser(&cheap).map(halves));
    }
    all
}

/// The default with each setting that trades speed for accuracy changed.
fn traded(default: &Choice) -> Vec<Choice> {
    let mut out = Vec::new();
    for (k, setting) in default.settings.iter().enumerate() {
        if !setting.spec.trades {
            continue;
        }
        match setting.spec.kind {
            SettingKind::Choice(words) => {
                let others = words
                    .iter()
                    .zip(0u32..)
                    .filter(|(_, n)| f64::from(*n) != setting.value.x);
                out.extend(others.map(|(word, n)| default.with_setting(k, n.into(), word)));
            }
            _ => {
                let values = FACTORS.map(|factor| scaled(setting, factor));
                for value in values.into_iter().flatten() {
                    out.push(default.with_setting(k, value, &value.to_string()));
                }
            }
        }
    }
    out
}

/// The default with half of everything that is a number of steps.
fn lesser(default: &Choice) -> impl Iterator<Item = Choice> {
    let mut out = default.clone();
    for k in 0..out.settings.len() {
        let setting = &out.settings[k];
        let is_number = !matches!(setting.spec.kind, SettingKind::Choice(_));
        let value = scaled(setting, 0.5).filter(|_| setting.spec.trades && is_number);
        if let Some(value) = value {
            out = out.with_setting(k, value, &value.to_string());
        }
    }
    (out.changes.len() > default.changes.len())
        .then_some(out)
        .into_iter()
}

/// A setting's value by a factor, where it may have that.
fn scaled(setting: &SettingValue, factor: f64) -> Option<f64> {
    let value = (setting.value.x * factor).round();
    let other = value != setting.value.x;
    (other && setting.spec.check(&[value]).is_ok()).then_some(value)
}

/// The best settings that there are: four times the most steps that are tried, or as many as may be.
#[must_use]
pub fn best(settings: &[SettingValue], factor: f64) -> Vec<SettingValue> {
    let mut out = settings.to_vec();
    for setting in &mut out {
        let is_number = !matches!(setting.spec.kind, SettingKind::Choice(_));
        if setting.spec.trades && is_number {
            let (low, high) = setting.spec.range;
            setting.value = DVec3::splat((setting.value.x * factor).round().clamp(low, high));
        }
    }
    out
}
