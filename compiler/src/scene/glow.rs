//! The settings of `glow`.

use super::{Scene, SettingSpec, Space, camera, space};

/// Light that is emitted around the zeros of a distance-like field.
pub const SCENE: Scene = Scene {
    name: "glow",
    doc: "light around the surface f = 0, added up along each ray: fractals and distance fields as embers",
    space: Space::Space,
    template: include_str!("../../shaders/scenes/glow.wgsl"),
    settings: &[
        space::BOX,
        space::CENTER,
        SettingSpec::choice(
            "estimate",
            &["distance", "value"],
            0.0,
            "distance d from the surface: f divided by the length of its gradient, or f as it is",
        ),
        SettingSpec::real(
            "epsilon",
            0.01,
            (1e-6, 10.0),
            "width ε of the surface, in parts of the box's shortest half side",
        ),
        SettingSpec::choice(
            "falloff",
            &["square", "inverse"],
            0.0,
            "emission per length: ε/(|d| + ε)², or 1/(|d| + ε)",
        ),
        SettingSpec::real("gain", 0.15, (0.0, 1e6), "factor of the emission"),
        SettingSpec::colour(
            "hot",
            [1.0, 0.62, 0.25],
            "colour at the surface, linear rgb",
        ),
        SettingSpec::colour("body", [0.92, 0.30, 0.03], "colour near it, linear rgb"),
        SettingSpec::colour(
            "halo",
            [0.45, 0.05, 0.015],
            "colour far from it, linear rgb",
        ),
        SettingSpec::function(
            "color",
            "name of a function of the point that colours the light instead: a place from `hot` (0) over `body` to `halo` (1), or linear rgb as a vec3",
        ),
        SettingSpec::real(
            "understep",
            0.45,
            (0.01, 1.0),
            "length of a step as a part of the distance from the surface",
        ),
        SettingSpec::integer(
            "steps",
            400.0,
            (8.0, 8192.0),
            "shortest steps that the diagonal of the box is divided into",
        )
        .trading(),
        SettingSpec::real(
            "fade",
            0.3,
            (0.0, 1.0),
            "part of the box within which the light fades towards its walls; 0: none",
        ),
        space::JITTER,
        SettingSpec::real(
            "vignette",
            0.55,
            (0.0, 4.0),
            "darkening, times the square of the distance from the middle in picture heights",
        ),
        SettingSpec::real(
            "grain",
            0.0,
            (0.0, 1.0),
            "height of noise that is added, linear",
        ),
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
        space::DARK,
        space::PLAIN_BACKDROP,
        SettingSpec::precision(),
    ],
};
