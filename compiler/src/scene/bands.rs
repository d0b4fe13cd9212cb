//! The settings of `bands`.

use super::colour_map::value_palette;
use super::{Scene, SettingSpec, Space};

const ANY: f64 = f64::INFINITY;

/// A real function of the plane by stripes of flat colours.
pub const SCENE: Scene = Scene {
    name: "bands",
    doc: "a real function of the plane: stripes of flat colours, filtered exactly",
    space: Space::Plane,
    template: include_str!("../../shaders/scenes/bands.wgsl"),
    settings: &[
        SettingSpec::center(),
        SettingSpec::height(8.0),
        SettingSpec::real(
            "period",
            0.0,
            (0.0, ANY),
            "value from one edge of a stripe to the other; 0: from the values in the view",
        ),
        SettingSpec::real(
            "start",
            0.0,
            (-ANY, ANY),
            "value at which a stripe of the first colour begins",
        ),
        SettingSpec::integer(
            "count",
            4.0,
            (2.0, 8.0),
            "colours that follow one another; of `own` at most four differ",
        ),
        SettingSpec::choice(
            "palette",
            value_palette!["own", "sequential", "diverging", "wheel"],
            0.0,
            "where the colours come from",
        ),
        SettingSpec::real(
            "footprint",
            0.5,
            (0.05, 8.0),
            "pixels, standard deviation of the Gaussian filter, however many samples a pixel has",
        ),
        SettingSpec::colour("color_1", [0.012, 0.036, 0.095], "of `own`, linear rgb"),
        SettingSpec::colour("color_2", [0.055, 0.235, 0.330], "of `own`, linear rgb"),
        SettingSpec::colour("color_3", [0.885, 0.780, 0.545], "of `own`, linear rgb"),
        SettingSpec::colour("color_4", [0.745, 0.170, 0.080], "of `own`, linear rgb"),
        SettingSpec::key(
            "height of the colour key as a part of the picture's shorter side; one stripe of each colour from `start` up; 0: none",
        ),
        SettingSpec::precision(),
    ],
};
