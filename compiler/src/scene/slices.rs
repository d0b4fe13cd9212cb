//! The settings of `slices`.

use super::{Scene, SettingSpec, Space, space};

/// A real function of space on planes.
pub const SCENE: Scene = Scene {
    name: "slices",
    doc: "a function of space on planes: three that stand still, and one across any axis that may sweep",
    space: Space::Space,
    template: include_str!("../../shaders/scenes/slices.wgsl"),
    settings: &[
        space::BOX,
        space::CENTER,
        SettingSpec::vec3(
            "axis",
            [0.0, 0.0, 1.0],
            (-1e6, 1e6),
            "normal of the active slice; its length does not count",
        ),
        space::POSITION,
        space::SWEEP,
        space::PERIOD,
        SettingSpec::choice(
            "reference",
            &["walls", "planes", "none"],
            0.0,
            "what stands still: the three far walls of the box, three planes through it, or nothing",
        ),
        SettingSpec::vec3(
            "planes",
            [0.0; 3],
            (-1.0, 1.0),
            "where the three planes are: -1 and 1 at the walls, 0 in the middle",
        ),
        SettingSpec::real(
            "reference_strength",
            0.4,
            (0.0, 1.0),
            "of the colours and lines of what stands still, which has every fourth line",
        ),
        space::COLOR_SCALE,
        space::SPACING,
        space::LINE_WIDTH,
        space::ZERO_WIDTH,
        space::LINE_OPACITY,
        SettingSpec::integer(
            "major",
            4.0,
            (0.0, 100.0),
            "every how many lines one is stronger; 0: none",
        ),
        space::INK,
        SettingSpec::real(
            "grid",
            0.0,
            (0.0, 1e6),
            "world units between the lines of the grid on what stands still; 0: automatic",
        ),
        SettingSpec::real("grid_opacity", 0.16, (0.0, 1.0), "of the grid"),
        SettingSpec::real(
            "axis_width",
            1.6,
            (0.0, 20.0),
            "pixels, of the lines of the grid where a coordinate is 0: red along x, green along y, blue along z",
        ),
        space::EDGE_WIDTH,
        space::YAW,
        space::PITCH,
        space::DISTANCE,
        space::FOV,
        space::BACKGROUND,
        SettingSpec::precision(),
    ],
};
