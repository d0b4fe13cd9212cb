//! Coordinates of nodes, one of each orbit under the symmetry, and parametrisations. Where they are not in closed form they were
//! found by Newton's method for ∇f = 0 from random points.

use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

use crate::group::Vec3;

pub const BARTH_DECIC: &[Vec3] = &[
    [1.85123, 0.43702, 0.0],
    [1.0, 0.0, 0.0],
    [0.92561, 0.35355, 0.13505],
    [FRAC_1_SQRT_2, 0.16693, 0.0],
    [0.61803, 0.0, 0.0],
    [0.57206, 0.21851, 0.08346],
];

pub const SARTI_DODECIC: &[Vec3] = &[
    [8.47214, 2.61803, 1.61803],
    [5.23607, 0.61803, 1.61803],
    [3.23607, 0.61803, 0.38197],
    [2.61803, 0.0, 0.0],
    [1.8541, 0.38197, 0.0],
    [1.30902, 0.5, 0.19098],
    [1.17082, 0.17082, 0.0],
    [0.8541, 0.0, 0.1459],
    [0.53934, 0.0, 0.20601],
    [0.38197, 0.0, 0.0],
];

pub const TOGLIATTI: &[Vec3] = &[
    [0.0, 0.0, -0.37175],
    [-1.23607, 0.0, -1.85874],
    [-1.23607, 0.0, 1.85874],
    [-1.09911, -0.79855, 1.26261],
    [-2.61803, -1.90211, -3.52125],
    [-2.61803, -1.90211, 3.52125],
    [6.8541, 4.9798, -3.52125],
];

pub const ENDRASS_OCTIC: &[Vec3] = &[
    [FRAC_1_SQRT_2, 0.0, 0.0],
    [FRAC_1_SQRT_2, 0.29289, 0.20711],
    [0.91018, 0.0, 0.5],
    [1.0, 0.41421, 0.91421],
    [1.0, 0.41421, 0.5],
    [1.20711, 0.5, 0.0],
    [SQRT_2, 0.0, 1.5],
    [SQRT_2, 0.0, 0.5],
    [2.41421, 1.0, 2.91421],
    [2.41421, 1.0, 1.5],
];

pub const LABS_SEPTIC: &[Vec3] = &[
    [0.0, 0.0, -1.0],
    [-0.37913, -0.18258, -0.5873],
    [-0.49823, 0.0, -0.55975],
    [-0.4788, -0.23058, -0.4788],
    [-0.59111, 0.0, -0.36855],
    [-0.5957, -0.28687, -0.5957],
    [-0.74877, -0.36059, -0.18493],
    [-1.18803, 0.0, -0.74073],
    [-1.51262, 0.0, 0.33659],
    [-2.5219, -1.21448, 1.74521],
    [2.99395, 0.0, 0.83076],
    [-4.00876, 0.0, 3.61177],
    [-3.84184, -1.85013, -0.94886],
    [-4.93055, -2.37443, -2.1943],
    [-10.58667, -5.09827, 10.5241],
];

/// Two of the three terms are -1 and one is 1, inside of the interval.
pub fn chmutov_nodes() -> Vec<Vec3> {
    let at = |k: u32| (f64::from(k) * std::f64::consts::PI / 8.0).cos();
    let low = [1, 3, 5, 7].map(at);
    let high = [2, 4, 6].map(at);
    let pairs = low.iter().flat_map(|&x| low.map(|y| [x, y]));
    pairs.flat_map(|[x, y]| high.map(|z| [x, y, z])).collect()
}

/// Where two of the four planes meet on the sphere of radius √m, and on the axes through the corners, where the squared and
/// the quartic term touch.
pub fn kummer_nodes(m: f64) -> Vec<Vec3> {
    let s = 0.5 * (1.0 - m);
    vec![[0.0, (m - 1.0).sqrt(), 1.0], [SQRT_2 * s, 0.0, s]]
}

/// Born and Wolf: the conical points lie in the plane of the largest and the smallest principal value.
pub fn fresnel_nodes() -> Vec<Vec3> {
    let [a, b, c] = [1.6f64, 1.2, 0.8].map(|v| v * v);
    let x = (c * (a - b) / (a - c)).sqrt();
    vec![[x, 0.0, (a * (b - c) / (a - c)).sqrt()]]
}

/// Apéry's parametrisation.
pub fn boy(u: f64, v: f64) -> Vec3 {
    let below = 2.0 - SQRT_2 * (3.0 * u).sin() * (2.0 * v).sin();
    let (s, c) = ((2.0 * v).sin(), v.cos() * v.cos());
    [
        SQRT_2 * c * (2.0 * u).cos() + u.cos() * s,
        SQRT_2 * c * (2.0 * u).sin() - u.sin() * s,
        3.0 * c,
    ]
    .map(|part| 2.0 / 3.0 * part / below)
}

/// Forsyth's parametrisation with the radii of the file: a = 1, c = 1/2, d = 3/4.
pub fn cyclide(u: f64, v: f64) -> Vec3 {
    let (a, c, d) = (1.0f64, 0.5, 0.75);
    let b = (a * a - c * c).sqrt();
    let below = a - c * u.cos() * v.cos();
    [
        d * (c - a * u.cos() * v.cos()) + b * b * u.cos(),
        b * u.sin() * (a - d * v.cos()),
        b * v.sin() * (c * u.cos() - d),
    ]
    .map(|part| part / below)
}
