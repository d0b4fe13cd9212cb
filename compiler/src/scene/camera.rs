//! Settings of cameras and lights, which scenes of space share. Those of the camera are the template's `Camera`.

use super::SettingSpec;

pub(super) const CAMERA: SettingSpec = SettingSpec::choice(
    "camera",
    &["orbit", "look_at"],
    0.0,
    "where the camera is: around the box's centre by yaw and pitch, or at `eye`",
);
pub(super) const PROJECTION: SettingSpec = SettingSpec::choice(
    "projection",
    &["perspective", "orthographic"],
    0.0,
    "rays through the eye, or parallel ones",
);
pub(super) const YAW: SettingSpec = SettingSpec::real(
    "yaw",
    32.0,
    (-3600.0, 3600.0),
    "degrees, of the orbiting camera about z, from +x towards +y",
);
pub(super) const PITCH: SettingSpec = SettingSpec::real(
    "pitch",
    24.0,
    (-89.0, 89.0),
    "degrees, of the orbiting camera above the ground",
);
pub(super) const DISTANCE: SettingSpec = SettingSpec::real(
    "distance",
    0.0,
    (0.0, 1e6),
    "from the orbiting camera to the centre, in perspective; 0: the box fills the view",
);
pub(super) const FOV: SettingSpec = SettingSpec::real(
    "fov",
    28.0,
    (1.0, 120.0),
    "degrees, across the shorter side of the picture, in perspective",
);
pub(super) const EXTENT: SettingSpec = SettingSpec::real(
    "extent",
    0.0,
    (0.0, 1e6),
    "world units across the shorter side of an orthographic picture; 0: the box fills the view",
);
pub(super) const EYE: SettingSpec = SettingSpec::vec3(
    "eye",
    [8.0, 5.0, 4.0],
    (-1e6, 1e6),
    "where the look-at camera is; orthographic rays begin on the plane through it",
);
pub(super) const AIM: SettingSpec = SettingSpec::vec3(
    "aim",
    [0.0; 3],
    (-1e6, 1e6),
    "the point that the look-at camera looks at",
);
pub(super) const UP: SettingSpec = SettingSpec::vec3(
    "up",
    [0.0, 0.0, 1.0],
    (-1e6, 1e6),
    "the direction that the look-at camera shows upwards; its length does not count",
);

pub(super) const LIGHT_YAW: SettingSpec = SettingSpec::real(
    "light_yaw",
    -50.0,
    (-3600.0, 3600.0),
    "degrees, of the light about z, from where `light_from` says",
);
pub(super) const LIGHT_PITCH: SettingSpec = SettingSpec::real(
    "light_pitch",
    52.0,
    (-90.0, 90.0),
    "degrees, of the light above the ground",
);
pub(super) const LIGHT_FROM: SettingSpec = SettingSpec::choice(
    "light_from",
    &["camera", "world"],
    0.0,
    "where light_yaw is counted from: the camera's own yaw, or +x",
);
pub(super) const LIGHT_STRENGTH: SettingSpec =
    SettingSpec::real("light_strength", 1.0, (0.0, 100.0), "of the light");
pub(super) const AMBIENT: SettingSpec = SettingSpec::real(
    "ambient",
    1.0,
    (0.0, 100.0),
    "strength of the light from sky and ground",
);
