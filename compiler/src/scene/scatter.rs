//! The settings of `scatter`.

use super::{Scene, SettingSpec, Space, camera, space};

/// A function of space as the density of a cloud.
pub const SCENE: Scene = Scene {
    name: "scatter",
    doc: "a function of space as the density of a cloud that scatters and absorbs the light of a distant source",
    space: Space::Space,
    template: include_str!("../../shaders/scenes/scatter.wgsl"),
    settings: &[
        space::BOX,
        space::CENTER,
        SettingSpec::vec3(
            "absorption",
            [0.0; 3],
            (0.0, 1e6),
            "optical depth, by absorption alone, of half the shortest side of the box where f = 1, rgb",
        ),
        SettingSpec::vec3(
            "scattering",
            [4.0; 3],
            (0.0, 1e6),
            "the same by scattering: what is taken from a ray and sent on in other directions, rgb",
        ),
        SettingSpec::real(
            "g",
            0.3,
            (-0.999, 0.999),
            "mean cosine of the angle of scattering: 0 all ways alike, towards 1 forwards, towards -1 back",
        ),
        SettingSpec::vec3(
            "light",
            [14.0, 12.6, 10.6],
            (0.0, 1e6),
            "irradiance of the light, linear rgb; 4π scattered all ways alike has radiance 1",
        ),
        SettingSpec::vec3(
            "ambient",
            [0.22, 0.29, 0.40],
            (0.0, 1e6),
            "radiance from all around, linear rgb; it comes to every point as it is",
        ),
        space::EXPOSURE,
        space::TONE,
        space::GAMMA,
        space::JITTER,
        SettingSpec::integer(
            "steps",
            128.0,
            (4.0, 4096.0),
            "stretches that the diagonal of the box is divided into, on the way to the eye",
        )
        .trading(),
        SettingSpec::integer(
            "light_steps",
            40.0,
            (1.0, 4096.0),
            "the same on the way from the light, for each of those stretches",
        )
        .trading(),
        space::STEPS_BY,
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
        SettingSpec::colour(
            "background",
            [0.30, 0.45, 0.68],
            "colour of the horizon, linear rgb",
        ),
        SettingSpec::choice(
            "backdrop",
            &["sky", "plain", "transparent"],
            0.0,
            "what is behind the box: the sky, darker above, one colour, or nothing",
        ),
        space::EDGE_WIDTH,
        SettingSpec::precision(),
    ],
};
