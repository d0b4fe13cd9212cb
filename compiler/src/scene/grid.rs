//! The settings of `grid`.

use super::{Scene, SettingSpec, Space};

const ANY: f64 = f64::INFINITY;
const POSITIVE: f64 = 1e-30;

/// A complex function by an adaptive grid in the plane of its values.
pub const SCENE: Scene = Scene {
    name: "grid",
    doc: "a complex function: a rectangular or polar grid of its values as fine as fits everywhere, in six layers",
    space: Space::Complex,
    template: include_str!("../../shaders/scenes/grid.wgsl"),
    settings: &[
        SettingSpec::center(),
        SettingSpec::height(6.0),
        SettingSpec::choice(
            "shape",
            &["rectangular", "polar"],
            0.0,
            "lines of re f and im f, or of |f| and arg f",
        ),
        SettingSpec::real(
            "spacing",
            16.0,
            (3.0, 1000.0),
            "pixels between the finest lines, where they fade in",
        ),
        SettingSpec::integer(
            "divisions",
            4.0,
            (2.0, 10.0),
            "parts that the space between two lines has at the next finer octave",
        ),
        SettingSpec::integer(
            "octaves",
            2.0,
            (2.0, 8.0),
            "over how many of them lines grow to full strength",
        ),
        SettingSpec::real("phase", 0.85, (0.0, 1.0), "strength of the colour of arg f"),
        SettingSpec::real(
            "light",
            0.75,
            (0.0, 1.0),
            "strength of the shading of zeros (black) and poles (white)",
        ),
        SettingSpec::real("checker", 0.4, (0.0, 1.0), "strength of the cells"),
        SettingSpec::real(
            "first_lines",
            0.7,
            (0.0, 1.0),
            "strength of the lines of constant re f or |f|",
        ),
        SettingSpec::real(
            "second_lines",
            0.7,
            (0.0, 1.0),
            "strength of the lines of constant im f or arg f",
        ),
        SettingSpec::real(
            "axes",
            0.9,
            (0.0, 1.0),
            "strength of the lines re f = 0 and im f = 0, or |f| = 1 and arg f = 0",
        ),
        SettingSpec::real(
            "line_width",
            1.1,
            (0.0, 20.0),
            "pixels, of the lines; the axes have twice as much",
        ),
        SettingSpec::real(
            "fade_octaves",
            4.0,
            (POSITIVE, ANY),
            "octaves from |f| = 1 to where the shading is half black or white",
        ),
        SettingSpec::wheel("colours of the argument"),
        SettingSpec::colour(
            "paper",
            [0.80, 0.80, 0.80],
            "colour without `phase`, linear rgb",
        ),
        SettingSpec::colour(
            "ink",
            [0.010, 0.012, 0.02],
            "colour of all lines, linear rgb",
        ),
        SettingSpec::key(
            "height of the colour key as a part of the picture's shorter side; f(z) = z up to 2 on both axes; 0: none",
        ),
        SettingSpec::precision(),
    ],
};
