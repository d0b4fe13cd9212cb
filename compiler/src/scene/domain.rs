//! The settings of `domain`.

use super::{Scene, SettingSpec, Space};

const ANY: f64 = f64::INFINITY;
const POSITIVE: f64 = 1e-30;

/// A complex function by domain colouring.
pub const SCENE: Scene = Scene {
    name: "domain",
    doc: "a complex function: hue by argument, rings by modulus in octaves, zeros black and poles white",
    space: Space::Complex,
    template: include_str!("../../shaders/scenes/domain.wgsl"),
    settings: &[
        SettingSpec::center(),
        SettingSpec::height(6.0),
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
        SettingSpec::real("line_width", 1.2, (0.0, 20.0), "pixels, of the phase lines"),
        SettingSpec::colour(
            "ink",
            [0.010, 0.012, 0.02],
            "colour of the phase lines, linear rgb",
        ),
        SettingSpec::key(
            "height of the colour key as a part of the picture's shorter side; f(z) = z up to 2 on both axes; 0: none",
        ),
        SettingSpec::precision(),
    ],
};
