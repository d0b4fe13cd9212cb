//! The settings of `levels`.

use super::colour_map::value_palette;
use super::{Scene, SettingSpec, Space};

const ANY: f64 = f64::INFINITY;

/// A real function of the plane by colour and level lines.
pub const SCENE: Scene = Scene {
    name: "levels",
    doc: "a real function of the plane: colour by value, level lines of constant width, the zero line thick",
    space: Space::Plane,
    template: include_str!("../../shaders/scenes/levels.wgsl"),
    settings: &[
        SettingSpec::center(),
        SettingSpec::height(8.0),
        SettingSpec::real(
            "spacing",
            0.0,
            (0.0, ANY),
            "value between level lines; 0: a quarter of color_scale",
        ),
        SettingSpec::real(
            "color_scale",
            0.0,
            (0.0, ANY),
            "value at which the colour is 71 % of the way to its end; 0: from the values in the view",
        ),
        SettingSpec::real("line_width", 1.2, (0.0, 20.0), "pixels, of level lines"),
        SettingSpec::real(
            "zero_width",
            2.6,
            (0.0, 20.0),
            "pixels, of the line f = 0; 0: none",
        ),
        SettingSpec::real("line_opacity", 0.5, (0.0, 1.0), "of level lines"),
        SettingSpec::integer(
            "major",
            5.0,
            (0.0, 100.0),
            "every how many lines one is stronger; 0: none",
        ),
        SettingSpec::choice(
            "palette",
            value_palette!["diverging", "sequential", "paper"],
            0.0,
            "colours of values",
        ),
        SettingSpec::colour(
            "ink",
            [0.010, 0.012, 0.02],
            "colour of all lines, linear rgb",
        ),
        SettingSpec::key(
            "height of the colour key as a part of the picture's shorter side; values from -4 to 4 color_scale; 0: none",
        ),
        SettingSpec::precision(),
    ],
};
