//! `--threshold name=limit`

use std::str::FromStr;

use pullback_runtime::difference::Difference;

use crate::cli::spelling;

/// A number that two pictures are judged by.
#[derive(Debug)]
pub(in crate::cli) struct Metric {
    pub(in crate::cli) name: &'static str,
    /// Whether pictures are the closer the greater it is.
    falling: bool,
    value: fn(&Difference) -> f64,
}

/// All of them.
pub(in crate::cli) const METRICS: [Metric; 11] = [
    rising("flip", |d| d.perceptual.mean),
    rising("flip-p999", |d| d.perceptual.p999),
    rising("flip-max", |d| d.perceptual.max),
    rising("max", |d| d.numeric.worst().max),
    rising("mean", |d| d.numeric.worst().mean),
    rising("rms", |d| d.numeric.worst().rms),
    rising("p999", |d| d.numeric.worst().p999),
    rising("differing", |d| d.numeric.differing),
    rising("over-255", |d| d.numeric.shares[0]),
    rising("over-512", |d| d.numeric.shares[1]),
    Metric {
        name: "psnr",
        falling: true,
        value: |d| d.numeric.psnr,
    },
];

const fn rising(name: &'static str, value: fn(&Difference) -> f64) -> Metric {
    Metric {
        name,
        falling: false,
        value,
    }
}

/// `flip=0.01`
#[derive(Clone, Copy, Debug)]
pub(in crate::cli) struct Threshold {
    pub(in crate::cli) metric: &'static Metric,
    pub(in crate::cli) limit: f64,
}

impl Threshold {
    /// The number that is limited.
    pub(in crate::cli) fn value(&self, found: &Difference) -> f64 {
        (self.metric.value)(found)
    }

    /// Whether the limit is kept. A value that is no number keeps none.
    pub(in crate::cli) fn holds(&self, found: &Difference) -> bool {
        let value = self.value(found);
        if self.metric.falling {
            value >= self.limit
        } else {
            value <= self.limit
        }
    }

    /// What is wrong where it does not hold.
    pub(in crate::cli) fn message(&self, found: &Difference) -> String {
        let word = if self.metric.falling {
            "at least"
        } else {
            "at most"
        };
        format!(
            "{} is {:.6}, and may be {word} {}",
            self.metric.name,
            self.value(found),
            self.limit
        )
    }
}

impl FromStr for Threshold {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let (name, limit) = text
            .split_once('=')
            .ok_or("write NAME=LIMIT, such as flip=0.01")?;
        let (name, limit) = (name.trim(), limit.trim());
        let metric = METRICS.iter().find(|metric| metric.name == name);
        let metric = metric.ok_or_else(|| {
            let names = || METRICS.iter().map(|metric| metric.name);
            match spelling::nearest(name, names()) {
                Some(known) => format!("there is no `{name}`; did you mean `{known}`?"),
                None => {
                    let names: Vec<&str> = names().collect();
                    format!("there is no `{name}`; there are {}", names.join(", "))
                }
            }
        })?;
        let limit = limit
            .parse()
            .ok()
            .filter(|l: &f64| l.is_finite() && *l >= 0.0);
        let limit = limit.ok_or("the limit must be a number from 0")?;
        Ok(Self { metric, limit })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thresholds() {
        let read = |text: &str| text.parse::<Threshold>().map(|t| (t.metric.name, t.limit));
        assert_eq!(read("flip=0.01"), Ok(("flip", 0.01)));
        assert_eq!(read(" psnr = 40 "), Ok(("psnr", 40.0)));
        for (bad, expected) in [
            ("flip", "NAME=LIMIT"),
            ("flp=1", "did you mean `flip`"),
            ("what=1", "there are flip, "),
            ("flip=x", "number"),
            ("flip=-1", "number"),
            ("flip=nan", "number"),
        ] {
            let message = read(bad).unwrap_err();
            assert!(message.contains(expected), "{bad}: {message}");
        }
    }
}
