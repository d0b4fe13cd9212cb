//! The settings of `surface`.

use super::{Scene, SettingSpec, Space, camera, space};

/// A level set in space, lit, in a box on the ground.
pub const SCENE: Scene = Scene {
    name: "surface",
    doc: "the surface f = level inside of a box on the ground, lit, with isolines on the walls",
    space: Space::Space,
    template: include_str!("../../shaders/scenes/surface.wgsl"),
    settings: &[
        space::BOX,
        space::CENTER,
        SettingSpec::real(
            "level",
            0.0,
            (-space::ANY, space::ANY),
            "value of f on the surface",
        ),
        SettingSpec::integer(
            "steps",
            160.0,
            (8.0, 4096.0),
            "samples along the diagonal of the box",
        )
        .trading(),
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
        camera::LIGHT_STRENGTH,
        camera::AMBIENT,
        SettingSpec::colour(
            "outside",
            [0.66, 0.23, 0.085],
            "colour of the side where f > level, linear rgb",
        ),
        SettingSpec::colour(
            "inside",
            [0.06, 0.22, 0.45],
            "colour of the side where f < level, linear rgb",
        ),
        space::BACKGROUND,
        space::BACKDROP,
        SettingSpec::real(
            "isoline_spacing",
            0.5,
            (0.0, space::ANY),
            "value between lines on the walls; 0: only the surface's",
        ),
        SettingSpec::real(
            "isoline_width",
            1.1,
            (0.0, 20.0),
            "pixels, of the lines on the walls",
        ),
        space::EDGE_WIDTH,
        SettingSpec::real(
            "wall_opacity",
            1.0,
            (0.0, 1.0),
            "of what is drawn on the walls",
        ),
        SettingSpec::real(
            "occlusion",
            0.7,
            (0.0, 1.0),
            "darkening of hollows and of the ground",
        ),
        SettingSpec::real(
            "shadow",
            0.6,
            (0.0, 1.0),
            "darkness of the shadow on the ground; 0: not computed",
        ),
        SettingSpec::precision(),
    ],
};
