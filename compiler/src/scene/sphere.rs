//! The settings of `sphere`.

use super::{Scene, SettingSpec, Space, space};

const ANY: f64 = f64::INFINITY;
const POSITIVE: f64 = 1e-30;

/// A complex function on the Riemann sphere.
pub const SCENE: Scene = Scene {
    name: "sphere",
    doc: "a complex function on the Riemann sphere: north pole 0, south pole ∞, equator |z| = 1; colours as of `domain`",
    space: Space::Complex,
    template: include_str!("../../shaders/scenes/sphere.wgsl"),
    settings: &[
        SettingSpec::center(),
        SettingSpec::height(2.3),
        SettingSpec::real(
            "yaw",
            -20.0,
            (-3600.0, 3600.0),
            "degrees, of the viewer about the axis, from +1 towards +i",
        ),
        SettingSpec::real(
            "pitch",
            34.0,
            (-90.0, 90.0),
            "degrees, of the viewer above the equator",
        ),
        SettingSpec::vec3(
            "rotation",
            [0.0; 3],
            (-3600.0, 3600.0),
            "degrees, of the sphere about the axes through 1, i and 0, in this order",
        ),
        SettingSpec::real(
            "spin",
            0.0,
            (-3600.0, 3600.0),
            "degrees per second, further rotation about the last axis",
        ),
        SettingSpec::real(
            "modulus",
            1.0,
            (POSITIVE, ANY),
            "|f| that is neither darkened nor lightened",
        ),
        SettingSpec::wheel("colours of the argument"),
        SettingSpec::choice(
            "rings",
            &["none", "waves", "steps"],
            2.0,
            "pattern in log |f|",
        ),
        SettingSpec::real("ring_depth", 0.35, (0.0, 1.0), "contrast of the rings"),
        SettingSpec::real(
            "ring_octaves",
            1.0,
            (POSITIVE, ANY),
            "octaves from ring to ring",
        ),
        SettingSpec::real(
            "fade_octaves",
            6.0,
            (POSITIVE, ANY),
            "octaves from `modulus` to where the colour is half black or white",
        ),
        SettingSpec::integer(
            "phase_lines",
            0.0,
            (0.0, 360.0),
            "contour lines of the argument in a turn; 0: none",
        ),
        SettingSpec::integer(
            "phase_steps",
            0.0,
            (0.0, 360.0),
            "steps of brightness in a turn; 0: none",
        ),
        SettingSpec::integer(
            "graticule",
            24.0,
            (0.0, 360.0),
            "meridians and parallels in a whole circle; 0: none",
        ),
        SettingSpec::real(
            "graticule_opacity",
            0.3,
            (0.0, 1.0),
            "of meridians and parallels",
        ),
        SettingSpec::real("line_width", 1.2, (0.0, 20.0), "pixels, of all lines"),
        SettingSpec::colour(
            "ink",
            [0.010, 0.012, 0.02],
            "colour of all lines, linear rgb",
        ),
        SettingSpec::real(
            "light",
            1.0,
            (0.0, 1.0),
            "strength of the light; 0: colours as in `domain`",
        ),
        SettingSpec::real(
            "light_yaw",
            -38.0,
            (-180.0, 180.0),
            "degrees, of the light to the right of the viewer",
        ),
        SettingSpec::real(
            "light_pitch",
            42.0,
            (-90.0, 90.0),
            "degrees, of the light above the viewer",
        ),
        SettingSpec::real("shine", 0.35, (0.0, 1.0), "strength of the highlight"),
        SettingSpec::colour(
            "background",
            [0.80, 0.82, 0.85],
            "colour behind the sphere, linear rgb",
        ),
        space::PLAIN_BACKDROP,
        SettingSpec::key(
            "height of the colour key as a part of the picture's shorter side; f(z) = z up to 2 on both axes; 0: none",
        ),
        SettingSpec::precision(),
    ],
};
