//! Settings that scenes of space share: the box, planes that cut it, and how values are drawn.

use super::SettingSpec;
use super::colour_map::value_palette;

/// No bound.
pub(super) const ANY: f64 = f64::INFINITY;

pub(super) const BOX: SettingSpec = SettingSpec::vec3(
    "box",
    [2.0; 3],
    (1e-6, 1e6),
    "half size of the box, world units",
);
pub(super) const CENTER: SettingSpec = SettingSpec::vec3(
    "center",
    [0.0; 3],
    (-1e6, 1e6),
    "centre of the box, world units",
);
pub(super) const BACKGROUND: SettingSpec = SettingSpec::colour(
    "background",
    [0.80, 0.82, 0.85],
    "colour of the horizon, linear rgb",
);
pub(super) const EDGE_WIDTH: SettingSpec = SettingSpec::real(
    "edge_width",
    1.4,
    (0.0, 20.0),
    "pixels, of the box's edges; 0: none",
);

pub(super) const POSITION: SettingSpec = SettingSpec::real(
    "position",
    0.0,
    (-1.0, 1.0),
    "of the plane along its normal: -1 and 1 where it leaves the box, 0 in the middle",
);
pub(super) const SWEEP: SettingSpec = SettingSpec::real(
    "sweep",
    0.0,
    (0.0, 1.0),
    "how far the plane swings to both sides of `position` as time passes; 0: it stands still",
);
pub(super) const PERIOD: SettingSpec = SettingSpec::real(
    "period",
    8.0,
    (1e-3, 1e6),
    "seconds, of one swing there and back",
);

pub(super) const COLOR_SCALE: SettingSpec = SettingSpec::real(
    "color_scale",
    0.0,
    (0.0, ANY),
    "value at which the colour is 71 % of the way to its end; 0: from the values in the box",
);
pub(super) const PALETTE: SettingSpec = SettingSpec::choice(
    "palette",
    value_palette!["diverging", "sequential", "paper"],
    0.0,
    "colours of values",
);
pub(super) const SPACING: SettingSpec = SettingSpec::real(
    "spacing",
    0.0,
    (0.0, ANY),
    "value between contour lines; 0: a quarter of color_scale",
);
pub(super) const LINE_WIDTH: SettingSpec =
    SettingSpec::real("line_width", 1.2, (0.0, 20.0), "pixels, of contour lines");
pub(super) const ZERO_WIDTH: SettingSpec = SettingSpec::real(
    "zero_width",
    2.6,
    (0.0, 20.0),
    "pixels, of the line f = 0; 0: none",
);
pub(super) const LINE_OPACITY: SettingSpec =
    SettingSpec::real("line_opacity", 0.5, (0.0, 1.0), "of contour lines");
pub(super) const INK: SettingSpec = SettingSpec::colour(
    "ink",
    [0.010, 0.012, 0.02],
    "colour of contour lines, linear rgb",
);

pub(super) const LEVEL: SettingSpec = SettingSpec::real(
    "level",
    0.0,
    (-ANY, ANY),
    "value of f in the middle of the family of levels",
);
pub(super) const LEVEL_SPACING: SettingSpec = SettingSpec::real(
    "spacing",
    0.0,
    (0.0, ANY),
    "value between levels; 0: half of color_scale",
);
pub(super) const COUNT: SettingSpec =
    SettingSpec::integer("count", 5.0, (1.0, 64.0), "number of levels");
pub(super) const HIGHLIGHT: SettingSpec = SettingSpec::integer(
    "highlight",
    0.0,
    (0.0, 64.0),
    "number of the highlighted level, from the lowest; 0: the one in the middle",
);
pub(super) const HIGHLIGHT_OPACITY: SettingSpec = SettingSpec::real(
    "highlight_opacity",
    1.0,
    (0.0, 1.0),
    "of the highlighted level",
);
pub(super) const GHOST_OPACITY: SettingSpec = SettingSpec::real(
    "ghost_opacity",
    0.22,
    (0.0, 1.0),
    "of the other levels where they face the camera; 1: all are opaque",
);
pub(super) const STEPS: SettingSpec = SettingSpec::integer(
    "steps",
    160.0,
    (8.0, 4096.0),
    "samples along the diagonal of the box",
)
.trading();
pub(super) const WALL_OPACITY: SettingSpec = SettingSpec::real(
    "wall_opacity",
    1.0,
    (0.0, 1.0),
    "of what is drawn on the walls",
);
pub(super) const LIGHTING: SettingSpec = SettingSpec::real(
    "lighting",
    1.0,
    (0.0, 1.0),
    "strength of light and shade; 0: flat colours",
);
pub(super) const BACKDROP: SettingSpec = SettingSpec::choice(
    "backdrop",
    &["ground", "plain", "transparent"],
    0.0,
    "what is behind the box: ground and sky, one colour, or nothing",
);
pub(super) const PLAIN_BACKDROP: SettingSpec = SettingSpec::choice(
    "backdrop",
    &["plain", "transparent"],
    0.0,
    "what is behind: one colour, or nothing",
);

pub(super) const NORMAL: SettingSpec = SettingSpec::vec3(
    "normal",
    [1.0, 0.0, 0.0],
    (-1e6, 1e6),
    "of the plane, towards what is cut away; its length does not count",
);
pub(super) const ISOLINE_WIDTH: SettingSpec = SettingSpec::real(
    "isoline_width",
    1.4,
    (0.0, 20.0),
    "pixels, of the lines on the walls",
);
pub(super) const CONTOUR_SPACING: SettingSpec = SettingSpec::real(
    "contour_spacing",
    0.0,
    (0.0, ANY),
    "value between contour lines on the cut; 0: a quarter of color_scale",
);

pub(super) const EXTINCTION_SCALE: SettingSpec = SettingSpec::real(
    "color_scale",
    0.0,
    (0.0, ANY),
    "|f| where the medium has the extinction of `density`; 0: from the values in the box",
);
pub(super) const POWER: SettingSpec = SettingSpec::real(
    "power",
    2.0,
    (0.05, 16.0),
    "extinction is density (|f|/color_scale)^power: above 1, haze vanishes and cores stand out",
);
pub(super) const DENSITY: SettingSpec = SettingSpec::real(
    "density",
    0.4,
    (0.0, 1e6),
    "optical depth of half the shortest side of the box where |f| = color_scale",
);
pub(super) const SIGNS: SettingSpec = SettingSpec::choice(
    "signs",
    &["both", "positive", "negative"],
    0.0,
    "the values that are seen",
);
pub(super) const POSITIVE: SettingSpec = SettingSpec::colour(
    "positive",
    [1.0, 0.22, 0.02],
    "colour that f = color_scale emits, linear rgb; larger values up to twice as much",
);
pub(super) const NEGATIVE: SettingSpec = SettingSpec::colour(
    "negative",
    [0.02, 0.18, 1.0],
    "colour that f = -color_scale emits, linear rgb",
);
pub(super) const CORE: SettingSpec =
    SettingSpec::real("core", 0.12, (0.0, 1.0), "how far large values are white");
pub(super) const EMISSION_LIGHTING: SettingSpec = SettingSpec::real(
    "lighting",
    0.6,
    (0.0, 1.0),
    "how far the direction of the gradient modulates the emission, as if lit; 0: not at all",
);
pub(super) const EXPOSURE: SettingSpec = SettingSpec::real(
    "exposure",
    1.1,
    (0.0, 1e6),
    "factor of the radiance before the tone curve",
);
pub(super) const TONE: SettingSpec = SettingSpec::choice(
    "tone",
    &["reinhard", "none"],
    0.0,
    "tone curve: c/(1 + c), or cut off at 1",
);
pub(super) const GAMMA: SettingSpec = SettingSpec::real(
    "gamma",
    1.0,
    (0.1, 10.0),
    "exponent 1/gamma after the tone curve, before sRGB",
);
pub(super) const JITTER: SettingSpec = SettingSpec::real(
    "jitter",
    1.0,
    (0.0, 1.0),
    "how far the samples of neighbouring pixels are displaced against one another; 0: not at all",
);
pub(super) const STRETCHES: SettingSpec = SettingSpec::integer(
    "steps",
    200.0,
    (4.0, 8192.0),
    "stretches that the diagonal of the box is divided into",
)
.trading();
pub(super) const STEPS_BY: SettingSpec = SettingSpec::choice(
    "steps_by",
    &["auto", "samples", "integral"],
    0.0,
    "optical depths by the density at points, by its closed-form integrals, or by these where that is faster",
)
.trading();
pub(super) const EMISSION: SettingSpec = SettingSpec::choice(
    "emission",
    &["graded", "even"],
    0.0,
    "more where |f| is larger, shaded; or evenly of its sign's colour, so that the light is as much as the opacity",
);
pub(super) const DARK: SettingSpec = SettingSpec::colour(
    "background",
    [0.004, 0.005, 0.008],
    "colour behind the box, linear rgb",
);
