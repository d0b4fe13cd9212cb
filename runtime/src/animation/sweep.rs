//! Numbers that run from one value to another.

use std::str::FromStr;

/// A number of a picture, by its name, with the values that it runs between.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    /// A parameter, a setting of one number, or `time`.
    pub name: String,
    /// Value in the first frame.
    pub from: f64,
    /// Value in the last frame; of a loop, in the one that would come next.
    pub to: f64,
}

impl Sweep {
    /// The value when `part` of the way is done: in equal steps, or in equal factors for the height of a view, which is
    /// how a zoom looks steady.
    #[must_use]
    pub fn value(&self, part: f64) -> f64 {
        let Self { from, to, .. } = *self;
        if part <= 0.0 {
            from
        } else if part >= 1.0 {
            to
        } else if self.name == "height" && from > 0.0 && to > 0.0 {
            (from.ln() * (1.0 - part) + to.ln() * part).exp()
        } else {
            from * (1.0 - part) + to * part
        }
    }
}

impl FromStr for Sweep {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let wrong = || "write NAME=FROM..TO, such as k=0..2.5".to_owned();
        let (name, range) = text.split_once('=').ok_or_else(wrong)?;
        let (from, to) = range.split_once("..").ok_or_else(wrong)?;
        let number = |text: &str| {
            let value: Option<f64> = text.trim().parse().ok();
            value
                .filter(|value| value.is_finite())
                .ok_or_else(|| format!("`{}` is not a finite number", text.trim()))
        };
        let name = name.trim();
        if name.is_empty() {
            return Err(wrong());
        }
        Ok(Self {
            name: name.to_owned(),
            from: number(from)?,
            to: number(to)?,
        })
    }
}

/// How much of the way is done at a frame, from 0 to 1. A closed animation ends one step before its beginning.
#[must_use]
pub fn part(frame: u32, frames: u32, is_closed: bool) -> f64 {
    let steps = if is_closed { frames } else { frames - 1 };
    f64::from(frame) / f64::from(steps.max(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sweeps_are_read() {
        let sweep: Sweep = " k = -1..2.5e0".parse().unwrap();
        assert_eq!(
            (sweep.name.as_str(), sweep.from, sweep.to),
            ("k", -1.0, 2.5)
        );
        for bad in [
            "k", "k=1", "=1..2", "k=1..", "k=..2", "k=a..2", "k=0..inf", "k=nan..1",
        ] {
            assert!(bad.parse::<Sweep>().is_err(), "{bad}");
        }
    }

    #[test]
    fn ends_are_met_exactly() {
        let sweep: Sweep = "k=0.1..0.7".parse().unwrap();
        assert_eq!(sweep.value(part(0, 7, false)), 0.1);
        assert_eq!(sweep.value(part(6, 7, false)), 0.7);
        assert_eq!(part(6, 7, true), 6.0 / 7.0);
        assert_eq!(part(0, 1, false), 0.0);
    }

    #[test]
    fn a_zoom_goes_in_equal_factors() {
        let sweep: Sweep = "height=8..0.08".parse().unwrap();
        assert!((sweep.value(0.5) - 0.8).abs() < 1e-15);
        let sweep: Sweep = "k=8..0.08".parse().unwrap();
        assert!((sweep.value(0.5) - 4.04).abs() < 1e-15);
    }
}
