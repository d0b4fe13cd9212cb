//! The settings of `logcontours`.

use super::colour_map::value_palette;
use super::{Scene, SettingSpec, Space};

const ANY: f64 = f64::INFINITY;
const POSITIVE: f64 = 1e-30;

/// A real function of the plane by contour lines of its logarithm.
pub const SCENE: Scene = Scene {
    name: "logcontours",
    doc: "a real function of the plane: lines of log |f| as fine as fits everywhere, colour by sign",
    space: Space::Plane,
    template: include_str!("../../shaders/scenes/logcontours.wgsl"),
    settings: &[
        SettingSpec::center(),
        SettingSpec::height(8.0),
        SettingSpec::real(
            "spacing",
            10.0,
            (3.0, 1000.0),
            "pixels between the finest lines, where they fade in",
        ),
        SettingSpec::integer(
            "divisions",
            2.0,
            (2.0, 10.0),
            "parts that the space between two lines has at the next finer octave",
        ),
        SettingSpec::integer(
            "octaves",
            3.0,
            (2.0, 8.0),
            "over how many of them lines grow to full strength",
        ),
        SettingSpec::real("line_width", 1.2, (0.0, 20.0), "pixels, of all lines"),
        SettingSpec::real("line_opacity", 0.75, (0.0, 1.0), "of the strongest lines"),
        SettingSpec::real(
            "modulus",
            1.0,
            (POSITIVE, ANY),
            "|f| where the colour is half way to its end",
        ),
        SettingSpec::real(
            "fade_octaves",
            4.0,
            (POSITIVE, ANY),
            "octaves of |f| from there to where it is three quarters of the way",
        ),
        SettingSpec::choice(
            "palette",
            value_palette!["diverging", "paper"],
            0.0,
            "colours of both signs",
        ),
        SettingSpec::colour(
            "ink",
            [0.010, 0.012, 0.02],
            "colour of all lines, linear rgb",
        ),
        SettingSpec::key(
            "height of the colour key as a part of the picture's shorter side; twelve octaves to both sides of 1, f > 0 above; 0: none",
        ),
        SettingSpec::precision(),
    ],
};
