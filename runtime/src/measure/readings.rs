//! Which numbers of a scene are judged by themselves, and where on the way to a pixel they are found.

use crate::trace::{Kept, What};

/// A number that is judged by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Quantity {
    /// Of the formula, relative to it, or, where that is more, to its change over a pixel.
    Value,
    /// Of the formula, relative to it, or, where that is more, to the slope by which the value would change by itself
    /// over the height of the view; of a function of a complex variable both Wirtinger derivatives.
    Gradient,
    /// Of lines, in pixels: the error of the value over its change from pixel to pixel.
    Position,
    /// Of the first surface on the ray through the middle of a pixel, world units.
    Depth,
    /// Of that ray before exposure and tone mapping, linear; the greatest of three components.
    Radiance,
}

impl Quantity {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::Value,
        Self::Gradient,
        Self::Position,
        Self::Depth,
        Self::Radiance,
    ];

    /// In a word.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Value => "value",
            Self::Gradient => "gradient",
            Self::Position => "position",
            Self::Depth => "depth",
            Self::Radiance => "radiance",
        }
    }

    /// What it is measured in.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Self::Value | Self::Gradient => "1",
            Self::Position => "pixels",
            Self::Depth => "world units",
            Self::Radiance => "linear",
        }
    }
}

/// Where the four numbers of a picture of numbers are found, and what they are.
#[derive(Clone, Copy, Debug)]
pub(super) enum Meaning {
    /// A real value in the last of so many numbers, behind its gradient.
    Jet(usize),
    /// A real value, its gradient, and how much it changes from pixel to pixel, in two pictures.
    Rate,
    /// A complex value, and the power of two that it is by; its derivatives in the next picture are, too.
    Complex,
    /// Its derivatives by z and by its conjugate.
    Derivatives,
    /// The distance to a surface, and whether there is one.
    Distance,
    /// The point of a surface, and whether there is one.
    Point,
    /// Light.
    Light,
}

/// A picture of numbers of a scene.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reading {
    pub(super) meaning: Meaning,
    pub(super) kept: &'static [Kept],
}

const fn result(function: &'static str, name: &'static str, slot: usize, closes: bool) -> Kept {
    Kept {
        function,
        what: What::Result,
        name,
        slot,
        closes,
    }
}

const fn reading(meaning: Meaning, kept: &'static [Kept]) -> Reading {
    Reading { meaning, kept }
}

const PLANE: &[Reading] = &[reading(
    Meaning::Jet(3),
    &[result("field_grad", "", 0, true)],
)];

const IMPLICIT: &[Reading] = &[reading(
    Meaning::Jet(3),
    &[
        result("field_jet2", ".value", 2, false),
        result("field_jet2", ".dx", 0, false),
        result("field_jet2", ".dy", 1, true),
    ],
)];

const MAP: &[Reading] = &[
    reading(
        Meaning::Complex,
        &[
            result("map_jet", ".value", 0, false),
            result("map_jet", ".exponent", 2, true),
        ],
    ),
    reading(
        Meaning::Derivatives,
        &[
            result("map_jet", ".dz", 0, false),
            result("map_jet", ".dzbar", 2, true),
        ],
    ),
];

/// The derivative is that by pixels of the view, in which the picture's is, too.
const SPHERE: &[Reading] = &[
    reading(
        Meaning::Complex,
        &[
            result("seen_jet", ".value", 0, false),
            result("seen_jet", ".exponent", 2, true),
        ],
    ),
    reading(
        Meaning::Derivatives,
        &[
            result("seen_jet", ".dz", 0, false),
            result("seen_jet", ".dzbar", 2, true),
        ],
    ),
];

const SLICES: &[Reading] = &[
    reading(Meaning::Jet(4), &[result("field_grad", "", 0, true)]),
    reading(
        Meaning::Rate,
        &[Kept {
            function: "slice_colour",
            what: What::Named,
            name: "rate",
            slot: 0,
            closes: true,
        }],
    ),
];

const SURFACE: &[Reading] = &[reading(
    Meaning::Distance,
    &[
        result("march", ".t", 0, false),
        result("march", ".found", 1, true),
    ],
)];

/// The gradient is taken at each bound and at each surface that is met, and the colour of a shell right after that.
const SHELLS: &[Reading] = &[reading(
    Meaning::Point,
    &[
        Kept {
            function: "field_grad",
            what: What::Argument,
            name: "p",
            slot: 0,
            closes: false,
        },
        result("shell_layer", ".opacity", 3, true),
    ],
)];

const fn light(kept: &'static [Kept]) -> [Reading; 1] {
    [reading(Meaning::Light, kept)]
}

const VOLUME: &[Reading] = &light(&[result("seen_in_box", ".light", 0, true)]);
const VOLUMECUT: &[Reading] = &light(&[result("met_in_part", ".seen.light", 0, true)]);
const SCATTER: &[Reading] = &light(&[result("scattered_in_box", ".light", 0, true)]);
const ADDITIVE: &[Reading] = &light(&[result("radiance", "", 0, true)]);
const GLOW: &[Reading] = &light(&[result("glow_along", "", 0, true)]);

/// The pictures of numbers of a scene of this name.
pub(super) fn readings(scene: &str) -> &'static [Reading] {
    match scene {
        "levels" | "logcontours" | "bands" => PLANE,
        "implicit" => IMPLICIT,
        "domain" | "checker" | "grid" => MAP,
        "sphere" => SPHERE,
        "slices" => SLICES,
        "surface" => SURFACE,
        "nested" | "cutaway" => SHELLS,
        "volume" => VOLUME,
        "volumecut" => VOLUMECUT,
        "scatter" => SCATTER,
        "additive" => ADDITIVE,
        "glow" => GLOW,
        _ => &[],
    }
}
