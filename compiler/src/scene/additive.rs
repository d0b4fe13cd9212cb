//! The settings of `additive`.

use super::{Scene, SettingSpec, Space, camera, space};

/// Light of a function of space inside solids, by integrals along rays.
pub const SCENE: Scene = Scene {
    name: "additive",
    doc: "the light that a function of space gives off in solids, by its integral along each ray",
    space: Space::Space,
    template: include_str!("../../shaders/scenes/additive.wgsl"),
    settings: &[
        SettingSpec::choice(
            "shape",
            &["box", "ball", "cylinder", "cone", "mesh"],
            0.0,
            "of the solids; cylinder and cone stand along z, `mesh` is the file of --mesh",
        ),
        SettingSpec::vec3(
            "box",
            [1.0; 3],
            (1e-6, 1e6),
            "half size of a solid, world units; a mesh is scaled evenly to fit",
        ),
        SettingSpec::vec3(
            "center",
            [0.0; 3],
            (-1e6, 1e6),
            "middle of all solids, world units",
        ),
        SettingSpec::integer("copies", 1.0, (1.0, 64.0), "number of solids"),
        SettingSpec::vec3(
            "step",
            [0.0; 3],
            (-1e6, 1e6),
            "from one solid to the next, world units",
        ),
        SettingSpec::real(
            "turn",
            0.0,
            (-360.0, 360.0),
            "degrees about z, from one solid to the next",
        ),
        SettingSpec::choice(
            "density",
            &["world", "model"],
            0.0,
            "whose coordinates f is of: the world's, or those of the solid that turn and move with it",
        ),
        SettingSpec::colour(
            "color",
            [1.0, 0.55, 0.18],
            "of the light of f = 1 along one world unit, linear rgb",
        ),
        SettingSpec::real("intensity", 1.0, (0.0, 1e6), "factor of that light"),
        SettingSpec::vec3(
            "shift",
            [0.0; 3],
            (-1e6, 1e6),
            "f is taken this far ahead for blue and this far behind for red, world units",
        ),
        SettingSpec::choice(
            "ground",
            &["none", "plane"],
            0.0,
            "a plane beneath the solids, which hides light behind it",
        ),
        SettingSpec::real(
            "ball",
            0.0,
            (0.0, 1e6),
            "radius of a ball that hides light behind it, world units; 0: none",
        ),
        SettingSpec::vec3(
            "ball_at",
            [0.0; 3],
            (-1e6, 1e6),
            "centre of that ball, world units",
        ),
        space::EXPOSURE,
        space::TONE,
        space::GAMMA,
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
        space::PLAIN_BACKDROP,
        SettingSpec::precision(),
    ],
};
