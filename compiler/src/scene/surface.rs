//! The settings of `surface`.

use super::{Scene, SettingSpec, Space};

const ANY: f64 = f64::INFINITY;

/// A level set in space, lit, in a box on the ground.
pub const SCENE: Scene = Scene {
    name: "surface",
    doc: "the surface f = level inside of a box on the ground, lit, with isolines on the walls",
    space: Space::Space,
    template: include_str!("../../shaders/scenes/surface.wgsl"),
    settings: &[
        SettingSpec::vec3(
            "box",
            [2.0; 3],
            (1e-6, 1e6),
            "half size of the box, world units",
        ),
        SettingSpec::vec3(
            "center",
            [0.0; 3],
            (-1e6, 1e6),
            "centre of the box, world units",
        ),
        SettingSpec::real("level", 0.0, (-ANY, ANY), "value of f on the surface"),
        SettingSpec::integer(
            "steps",
            160.0,
            (8.0, 4096.0),
            "samples along the diagonal of the box",
        ),
        SettingSpec::real(
            "yaw",
            32.0,
            (-3600.0, 3600.0),
            "degrees, of the camera about z, from +x towards +y",
        ),
        SettingSpec::real(
            "pitch",
            24.0,
            (-89.0, 89.0),
            "degrees, of the camera above the ground",
        ),
        SettingSpec::real(
            "distance",
            0.0,
            (0.0, 1e6),
            "from the camera to the centre; 0: the box fills the view",
        ),
        SettingSpec::real(
            "fov",
            28.0,
            (1.0, 120.0),
            "degrees, across the shorter side of the picture",
        ),
        SettingSpec::real(
            "light_yaw",
            -50.0,
            (-3600.0, 3600.0),
            "degrees, of the light about z, from the camera's yaw",
        ),
        SettingSpec::real(
            "light_pitch",
            52.0,
            (-90.0, 90.0),
            "degrees, of the light above the ground",
        ),
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
        SettingSpec::colour(
            "background",
            [0.80, 0.82, 0.85],
            "colour of the horizon, linear rgb",
        ),
        SettingSpec::real(
            "isoline_spacing",
            0.5,
            (0.0, ANY),
            "value between lines on the walls; 0: only the surface's",
        ),
        SettingSpec::real(
            "isoline_width",
            1.1,
            (0.0, 20.0),
            "pixels, of the lines on the walls",
        ),
        SettingSpec::real(
            "edge_width",
            1.4,
            (0.0, 20.0),
            "pixels, of the box's edges; 0: none",
        ),
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
