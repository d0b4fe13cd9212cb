//! The settings of `volume`.

use super::{Scene, SettingSpec, Space, space};

/// A function of space as a luminous gas.
pub const SCENE: Scene = Scene {
    name: "volume",
    doc: "a function of space as a gas that emits and absorbs light, in two colours by sign",
    space: Space::Space,
    template: include_str!("../../shaders/scenes/volume.wgsl"),
    settings: &[
        space::BOX,
        space::CENTER,
        space::EXTINCTION_SCALE,
        space::POWER,
        space::DENSITY,
        space::SIGNS,
        space::POSITIVE,
        space::NEGATIVE,
        space::CORE,
        space::EMISSION_LIGHTING,
        space::EXPOSURE,
        space::TONE,
        space::GAMMA,
        space::JITTER,
        space::STRETCHES,
        space::YAW,
        space::PITCH,
        space::DISTANCE,
        space::FOV,
        space::LIGHT_YAW,
        space::LIGHT_PITCH,
        space::DARK,
        space::EDGE_WIDTH,
        SettingSpec::precision(),
    ],
};
