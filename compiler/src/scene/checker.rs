//! The settings of `checker`.

use super::{Scene, SettingSpec, Space};

const ANY: f64 = f64::INFINITY;

/// A complex function by the board of the integers, pulled back.
pub const SCENE: Scene = Scene {
    name: "checker",
    doc: "a complex function: the board of whole re f and im f pulled back, subdivided, dark lines at integers",
    space: Space::Complex,
    template: include_str!("../../shaders/scenes/checker.wgsl"),
    settings: &[
        SettingSpec::center(),
        SettingSpec::height(6.0),
        SettingSpec::real("unit", 1.0, (1e-30, ANY), "value, side of a square"),
        SettingSpec::integer(
            "subdivision",
            5.0,
            (1.0, 16.0),
            "small squares along the side of a square; 1: none",
        ),
        SettingSpec::real(
            "contrast",
            0.72,
            (0.0, 1.0),
            "of light and dark squares; what `fine_contrast` adds beyond 1 is cut off",
        ),
        SettingSpec::real(
            "fine_contrast",
            0.22,
            (0.0, 1.0),
            "of light and dark small squares",
        ),
        SettingSpec::real(
            "line_width",
            1.6,
            (0.0, 20.0),
            "pixels, of the lines around squares; those around small ones have 0.7 of it",
        ),
        SettingSpec::real(
            "line_opacity",
            0.95,
            (0.0, 1.0),
            "of the lines around squares",
        ),
        SettingSpec::real(
            "fine_opacity",
            0.16,
            (0.0, 1.0),
            "of the lines around small squares",
        ),
        SettingSpec::real(
            "hue",
            0.0,
            (0.0, 1.0),
            "how far squares have the colour of arg f",
        ),
        SettingSpec::wheel("colours of the argument, where `hue` is not 0"),
        SettingSpec::colour(
            "light",
            [0.88, 0.85, 0.78],
            "colour of light squares, linear rgb",
        ),
        SettingSpec::colour(
            "dark",
            [0.105, 0.155, 0.225],
            "colour of dark squares, linear rgb",
        ),
        SettingSpec::colour(
            "ink",
            [0.010, 0.012, 0.02],
            "colour of all lines, linear rgb",
        ),
        SettingSpec::key(
            "height of the colour key as a part of the picture's shorter side; f(z) = z up to 2 units on both axes; 0: none",
        ),
        SettingSpec::precision(),
    ],
};
