//! The tables that there are.

use clap::ValueEnum;

use super::dots::Chart;

/// A table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Part {
    /// What each program takes from text to picture (docs/performance.md)
    Programs,
    /// How that grows with the size of a formula (docs/performance.md)
    Growth,
    /// Operations of derivatives (docs/performance.md)
    Derivatives,
    /// Gradients beside those by hand and finite differences (docs/performance.md)
    Gradients,
    /// Frames beside programs written by hand, one of each scene (docs/twins.md)
    Twins,
    /// What each picture takes in each tier (docs/numerics.md)
    Tiers,
    /// What a picture's choices cost and give, one of each scene (docs/measure.md)
    Choices,
    /// Closed forms of integrals beside marches at equal error (docs/integrals.md)
    Marches,
    /// Large pictures, with the memory that they take (docs/performance.md)
    Large,
    /// How far pictures in `accurate` are from f64 (docs/gallery-differences.md)
    Accurate,
    /// How far pictures in `double` are from f64 (docs/gallery-differences.md)
    Double,
    /// Other programs at the same formulas (docs/performance.md)
    Peers,
}

impl Part {
    pub(super) fn file(self) -> &'static str {
        match self {
            Self::Programs => "programs.md",
            Self::Growth => "growth.md",
            Self::Derivatives => "derivatives.md",
            Self::Gradients => "gradients.md",
            Self::Twins => "twins.md",
            Self::Tiers => "tiers.md",
            Self::Choices => "choices.md",
            Self::Marches => "marches.md",
            Self::Large => "large.md",
            Self::Accurate => "accurate.md",
            Self::Double => "double.md",
            Self::Peers => "peers.md",
        }
    }

    pub(super) fn title(self) -> &'static str {
        match self {
            Self::Programs => "From text to picture",
            Self::Growth => "Growth with the size of a formula",
            Self::Derivatives => "Operations of derivatives",
            Self::Gradients => "Gradients",
            Self::Twins => "Beside programs written by hand",
            Self::Tiers => "Tiers",
            Self::Choices => "Choices between speed and accuracy",
            Self::Marches => "Closed forms of integrals beside marches",
            Self::Large => "Large pictures",
            Self::Accurate => "Pictures in accurate beside f64",
            Self::Double => "Pictures in double beside f64",
            Self::Peers => "Other programs",
        }
    }

    /// Its part of the time, by weight.
    pub(super) fn weight(self) -> f64 {
        match self {
            Self::Growth | Self::Derivatives => 0.5,
            Self::Programs | Self::Peers | Self::Gradients | Self::Large => 1.0,
            Self::Accurate | Self::Double | Self::Twins | Self::Marches => 2.0,
            Self::Tiers => 3.0,
            Self::Choices => 4.0,
        }
    }

    pub(super) fn chart(self) -> Option<Chart<'static>> {
        let chart = |title, axis, columns| {
            Some(Chart {
                title,
                axis,
                columns,
            })
        };
        match self {
            Self::Programs => chart(
                self.title(),
                "milliseconds",
                &[(6, "compiled"), (7, "picture")],
            ),
            Self::Growth => chart(
                self.title(),
                "microseconds a node",
                &[(2, "check"), (3, "module"), (5, "spirv"), (6, "total")],
            ),
            Self::Derivatives => chart(
                "Operations relative to those of the value",
                "ratio",
                &[(3, "with first derivatives"), (5, "with second ones, too")],
            ),
            Self::Gradients => chart(
                "Time of value and gradient, relative to the value's",
                "ratio",
                &[
                    (2, "exact"),
                    (3, "by hand"),
                    (4, "forward differences"),
                    (5, "central ones"),
                ],
            ),
            Self::Twins => chart(
                "Time of a frame, relative to the twin's",
                "ratio",
                &[(3, "fast"), (4, "accurate")],
            ),
            Self::Tiers => chart(
                "Time of a picture relative to fast",
                "ratio",
                &[(2, "accurate"), (3, "extended"), (4, "double")],
            ),
            Self::Choices => chart(
                "Mean error of a picture",
                "FLIP",
                &[
                    (2, "default"),
                    (5, "not to be told from the truth"),
                    (8, "at most half the time"),
                ],
            ),
            Self::Marches => chart(
                "Time relative to that of the closed form",
                "ratio",
                &[(6, "march"), (9, "Gauss and Legendre")],
            ),
            Self::Accurate | Self::Double => chart(
                "Greatest difference from f64",
                "linear light",
                &[(4, "greatest"), (3, "99.9 % below")],
            ),
            Self::Large | Self::Peers => None,
        }
    }
}
