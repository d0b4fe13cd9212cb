//! The settings of `implicit`.

use super::{Scene, SettingSpec, Space};

/// The zero curve of a real function of the plane.
pub const SCENE: Scene = Scene {
    name: "implicit",
    doc: "the curve f = 0 of a real function of the plane, of constant width at multiple roots too; doubt is shown",
    space: Space::Plane,
    template: include_str!("../../shaders/scenes/implicit.wgsl"),
    settings: &[
        SettingSpec::center(),
        SettingSpec::height(8.0),
        SettingSpec::real("line_width", 2.4, (0.0, 40.0), "pixels, of the curve"),
        SettingSpec::real(
            "fill",
            1.0,
            (0.0, 1.0),
            "strength of the colours of both sides",
        ),
        SettingSpec::colour(
            "above",
            [0.90, 0.60, 0.42],
            "colour where f > 0, linear rgb",
        ),
        SettingSpec::colour(
            "below",
            [0.40, 0.61, 0.80],
            "colour where f < 0, linear rgb",
        ),
        SettingSpec::colour(
            "ink",
            [0.010, 0.012, 0.02],
            "colour of the curve, linear rgb",
        ),
        SettingSpec::colour(
            "touch",
            [0.36, 0.015, 0.10],
            "colour of the curve where f does not change its sign, linear rgb",
        ),
        SettingSpec::colour(
            "doubt",
            [0.95, 0.62, 0.02],
            "colour of the hatch where the curve may be or not, linear rgb",
        ),
        SettingSpec::choice(
            "backdrop",
            &["plain", "transparent"],
            0.0,
            "what is behind, and shows where `fill` is less than 1: paper, or nothing",
        ),
        SettingSpec::precision(),
    ],
};
