//! The settings of `nested`.

use super::{Scene, SettingSpec, Space, space};

/// A family of level sets in space, one opaque, the others translucent.
pub const SCENE: Scene = Scene {
    name: "nested",
    doc: "a family of surfaces f = level + k spacing in a box: one opaque, the others translucent, lines of all on the walls",
    space: Space::Space,
    template: include_str!("../../shaders/scenes/nested.wgsl"),
    settings: &[
        space::BOX,
        space::CENTER,
        space::LEVEL,
        space::LEVEL_SPACING,
        space::COUNT,
        space::HIGHLIGHT,
        space::HIGHLIGHT_OPACITY,
        space::GHOST_OPACITY,
        space::COLOR_SCALE,
        space::STEPS,
        space::ISOLINE_WIDTH,
        space::WALL_OPACITY,
        space::LIGHTING,
        space::YAW,
        space::PITCH,
        space::DISTANCE,
        space::FOV,
        space::LIGHT_YAW,
        space::LIGHT_PITCH,
        space::BACKDROP,
        space::BACKGROUND,
        space::EDGE_WIDTH,
        SettingSpec::precision(),
    ],
};
