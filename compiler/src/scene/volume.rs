//! The settings of `volume`.

use super::{Scene, SettingSpec, Space, camera, space};

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
        camera::CAMERA,
        camera::PROJECTION,
        camera::YAW,
        camera::PITCH,
        camera::DISTANCE,
        camera::FOV,
        camera::EXTENT,
        camera::EYE,
        camera::AIM,
        camera::UP,
        camera::LIGHT_YAW,
        camera::LIGHT_PITCH,
        camera::LIGHT_FROM,
        space::DARK,
        space::EDGE_WIDTH,
        SettingSpec::precision(),
    ],
};
