//! What is known of each surface of docs/surfaces, from its literature.

use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

use crate::group::{Symmetry, Vec3};

/// Nodes, by one of each orbit under the symmetry.
#[derive(Clone, Copy, Debug)]
pub enum Nodes {
    /// Coordinates in closed form.
    Exact(fn() -> Vec<Vec3>),
    /// Coordinates to five digits, to be improved by Newton's method.
    Near(&'static [Vec3]),
    /// None is claimed.
    Unclaimed,
}

/// A surface.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// Its file.
    pub name: &'static str,
    pub title: &'static str,
    pub degree: u32,
    pub symmetry: Symmetry,
    pub nodes: Nodes,
    /// How many of them there are.
    pub count: usize,
    /// Parameters at which they are nodes, where those are not the defaults.
    pub params: &'static [f64],
    /// All singularities, in words.
    pub singular: &'static str,
    /// Where the equation is published.
    pub source: &'static str,
    /// Points that lie on it: a parametrisation, or lines.
    pub points: Option<fn(f64, f64) -> Vec3>,
}

const fn surface(
    name: &'static str,
    title: &'static str,
    degree: u32,
    symmetry: Symmetry,
    singular: &'static str,
    source: &'static str,
) -> Surface {
    Surface {
        name,
        title,
        degree,
        symmetry,
        nodes: Nodes::Unclaimed,
        count: 0,
        params: &[],
        singular,
        source,
        points: None,
    }
}

impl Surface {
    const fn exact(mut self, count: usize, nodes: fn() -> Vec<Vec3>) -> Self {
        self.nodes = Nodes::Exact(nodes);
        self.count = count;
        self
    }

    const fn near(mut self, count: usize, nodes: &'static [Vec3]) -> Self {
        self.nodes = Nodes::Near(nodes);
        self.count = count;
        self
    }

    const fn with(mut self, params: &'static [f64]) -> Self {
        self.params = params;
        self
    }

    const fn holds(mut self, points: fn(f64, f64) -> Vec3) -> Self {
        self.points = Some(points);
        self
    }
}

const ORIGIN: fn() -> Vec<Vec3> = || vec![[0.0; 3]];
const ENDRASS: &str = "Endraß 1995, \"Flächen mit vielen Doppelpunkten\"";
/// As MathWorld reports them.
const NORDSTRAND: &str = "Nordstrand, in MathWorld";
const HAUSER: &str = "\"Herwig Hauser Classic\", imaginary.org";
const FISCHER: &str = "Fischer (ed.) 1986, \"Mathematical Models\"";

/// The surfaces, by name.
pub const SURFACES: &[Surface] = &[
    surface(
        "barth-decic",
        "Barth's decic",
        10,
        Symmetry::Icosahedron,
        "345 nodes, 45 of them at infinity",
        "Barth 1996, \"Two projective surfaces with many nodes\"",
    )
    .near(300, BARTH_DECIC),
    surface(
        "barth-sextic",
        "Barth's sextic",
        6,
        Symmetry::Icosahedron,
        "65 nodes, 15 of them at infinity",
        "Barth 1996, \"Two projective surfaces with many nodes\"",
    )
    .exact(50, || vec![[1.0, 0.0, 0.0], [1.0; 3]]),
    surface(
        "bohemian-dome",
        "Bohemian dome",
        4,
        Symmetry::Mirrors(&[0, 1, 2]),
        "double curves",
        FISCHER,
    )
    .holds(|u, v| [0.5 * u.cos(), v.cos() + 0.5 * u.sin(), v.sin()]),
    surface(
        "boy",
        "Boy's surface",
        6,
        Symmetry::Rotations(3),
        "a double curve, a triple point",
        "Apéry 1986, \"La surface de Boy\"",
    )
    .holds(boy),
    surface(
        "calyx",
        "Calyx",
        5,
        Symmetry::Mirrors(&[0, 1]),
        "a singular line",
        HAUSER,
    ),
    surface(
        "cassini",
        "Cassini's ovals, turned",
        4,
        Symmetry::RevolutionBoth(0),
        "a node at b = 1; conjugate points at infinity",
        "Cassini's ovals, turned about their axis",
    )
    .exact(1, ORIGIN),
    surface(
        "cayley",
        "Cayley's cubic",
        3,
        Symmetry::Tetrahedron,
        "4 nodes",
        "Cayley 1869, \"A memoir on cubic surfaces\"",
    )
    .exact(4, || vec![[1.0, 1.0, -1.0]])
    .holds(|u, v| [u.cos(), v.cos(), -(u + v).cos()]),
    surface(
        "chmutov",
        "Chmutov's octic",
        8,
        Symmetry::Cube,
        "144 nodes",
        "Chmutov 1992, \"Examples of projective surfaces with many singularities\"",
    )
    .exact(144, chmutov_nodes),
    surface(
        "citrus",
        "Citrus",
        6,
        Symmetry::Revolution(1),
        "2 cusps",
        HAUSER,
    )
    .holds(|u, v| {
        let y = 0.5 + 0.5 * v.cos();
        let r = (y * (1.0 - y)).powf(1.5);
        [r * u.cos(), y, r * u.sin()]
    }),
    surface(
        "clebsch",
        "Clebsch's diagonal cubic",
        3,
        Symmetry::Permutations,
        "smooth; 27 real lines",
        "Clebsch 1871, \"Über die Anwendung der quadratischen Substitution\"",
    )
    .holds(|t, _| [t, -t, -1.0]),
    surface(
        "cross-cap",
        "Cross-cap",
        4,
        Symmetry::Mirrors(&[0, 1]),
        "a double line, 2 pinch points",
        FISCHER,
    ),
    surface(
        "daisy",
        "Daisy",
        6,
        Symmetry::Mirrors(&[0, 2]),
        "curves of cusps",
        HAUSER,
    ),
    surface(
        "ding-dong",
        "Ding-dong",
        3,
        Symmetry::Revolution(2),
        "1 node",
        HAUSER,
    )
    .exact(1, ORIGIN),
    surface(
        "dupin-cyclide",
        "Dupin's cyclide",
        4,
        Symmetry::Mirrors(&[1, 2]),
        "a conic at infinity",
        "Forsyth 1912, \"Lectures on the differential geometry of curves and surfaces\"",
    )
    .holds(cyclide),
    surface(
        "endrass-octic",
        "Endraß' octic",
        8,
        Symmetry::Prism(8),
        "168 nodes",
        "Endraß 1997, \"A projective surface of degree eight with 168 nodes\"",
    )
    .near(144, ENDRASS_OCTIC),
    surface(
        "enneper",
        "Enneper's surface",
        9,
        Symmetry::Disphenoid,
        "double curves",
        "Enneper 1864, \"Analytisch-geometrische Untersuchungen\"",
    )
    .holds(|u, v| {
        [
            u - u.powi(3) / 3.0 + u * v * v,
            v - v.powi(3) / 3.0 + v * u * u,
            u * u - v * v,
        ]
    }),
    surface(
        "fermat",
        "Fermat's surface, n = 4",
        4,
        Symmetry::Cube,
        "smooth",
        FISCHER,
    ),
    surface(
        "fresnel",
        "Fresnel's wave surface",
        4,
        Symmetry::Mirrors(&[0, 1, 2]),
        "16 nodes, 4 of them real",
        "Born and Wolf, \"Principles of Optics\", 15.3",
    )
    .exact(4, fresnel_nodes),
    surface(
        "heart",
        "Taubin's heart",
        6,
        Symmetry::Mirrors(&[0, 1]),
        "a singular curve in the plane z = 0",
        "Weisstein, MathWorld, \"Heart Surface\"",
    ),
    surface(
        "hunt",
        "Hunt's surface",
        6,
        Symmetry::Mirrors(&[0, 1, 2]),
        "a curve of cusps",
        NORDSTRAND,
    ),
    surface(
        "klein-bottle",
        "Klein's bottle",
        6,
        Symmetry::HalfTurn(1),
        "double curves",
        "Weisstein, MathWorld, \"Klein Bottle\"",
    ),
    surface(
        "kummer",
        "Kummer's quartic",
        4,
        Symmetry::TurnedTetrahedron,
        "16 nodes",
        "Hudson 1905, \"Kummer's Quartic Surface\"",
    )
    .exact(16, || kummer_nodes(1.75)),
    surface(
        "labs-septic",
        "Labs' septic",
        7,
        Symmetry::Pyramid(7),
        "99 nodes",
        "Labs 2004, \"A septic with 99 real nodes\"",
    )
    .near(99, LABS_SEPTIC),
    surface(
        "moebius",
        "Möbius' strip",
        3,
        Symmetry::HalfTurn(0),
        "not claimed",
        FISCHER,
    )
    .holds(|u, v| {
        let r = 1.0 + v * (0.5 * u).cos();
        [r * u.cos(), r * u.sin(), v * (0.5 * u).sin()]
    }),
    surface(
        "monkey-saddle",
        "Monkey saddle",
        3,
        Symmetry::Pyramid(3),
        "smooth; a flat point",
        "Hilbert and Cohn-Vossen 1932, \"Anschauliche Geometrie\"",
    )
    .holds(|u, v| [u, v, u.powi(3) - 3.0 * u * v * v]),
    surface(
        "piriform",
        "Piriform",
        4,
        Symmetry::Revolution(0),
        "a cusp",
        NORDSTRAND,
    ),
    surface(
        "plucker-conoid",
        "Plücker's conoid",
        3,
        Symmetry::Disphenoid,
        "a double line, 2 pinch points",
        "Plücker 1868, \"Neue Geometrie des Raumes\"",
    )
    .holds(|u, v| [u * v.cos(), u * v.sin(), (2.0 * v).cos()]),
    surface(
        "sarti-dodecic",
        "Sarti's dodecic",
        12,
        Symmetry::Icosahedron,
        "600 nodes",
        "Sarti 2001, \"Pencils of symmetric surfaces in P³\"",
    )
    .near(560, SARTI_DODECIC),
    surface(
        "steiner",
        "Steiner's Roman surface",
        4,
        Symmetry::Tetrahedron,
        "3 double lines, a triple point, 6 pinch points",
        FISCHER,
    )
    .holds(|u, v| {
        let p = [u.cos() * v.cos(), u.cos() * v.sin(), u.sin()];
        [p[1] * p[2], p[2] * p[0], p[0] * p[1]]
    }),
    surface(
        "tanglecube",
        "Tanglecube",
        4,
        Symmetry::Cube,
        "12 nodes at c = 12.5",
        "Weisstein, MathWorld, \"Tanglecube\"",
    )
    .with(&[12.5])
    .exact(12, || vec![[2.5f64.sqrt(), 2.5f64.sqrt(), 0.0]]),
    surface(
        "thistle",
        "Thistle",
        6,
        Symmetry::Cube,
        "not claimed",
        HAUSER,
    ),
    surface(
        "togliatti",
        "Togliatti's quintic",
        5,
        Symmetry::Pyramid(5),
        "31 nodes",
        ENDRASS,
    )
    .near(31, TOGLIATTI),
    surface(
        "tooth",
        "Tooth",
        4,
        Symmetry::Cube,
        "1 node, isolated",
        NORDSTRAND,
    )
    .exact(1, ORIGIN),
    surface(
        "torus",
        "Torus",
        4,
        Symmetry::RevolutionBoth(2),
        "a conic at infinity",
        FISCHER,
    )
    .holds(|u, v| {
        let r = 1.0 + 0.4 * v.cos();
        [r * u.cos(), r * u.sin(), 0.4 * v.sin()]
    }),
    surface(
        "whitney",
        "Whitney's umbrella",
        3,
        Symmetry::Mirrors(&[0, 1]),
        "a double line, a pinch point",
        "Whitney 1943, \"The general type of singularity\"",
    )
    .holds(|u, v| [u * v, v, u * u]),
];

const BARTH_DECIC: &[Vec3] = &[
    [1.85123, 0.43702, 0.0],
    [1.0, 0.0, 0.0],
    [0.92561, 0.35355, 0.13505],
    [FRAC_1_SQRT_2, 0.16693, 0.0],
    [0.61803, 0.0, 0.0],
    [0.57206, 0.21851, 0.08346],
];

const SARTI_DODECIC: &[Vec3] = &[
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

const TOGLIATTI: &[Vec3] = &[
    [0.0, 0.0, -0.37175],
    [-1.23607, 0.0, -1.85874],
    [-1.23607, 0.0, 1.85874],
    [-1.09911, -0.79855, 1.26261],
    [-2.61803, -1.90211, -3.52125],
    [-2.61803, -1.90211, 3.52125],
    [6.8541, 4.9798, -3.52125],
];

const ENDRASS_OCTIC: &[Vec3] = &[
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

const LABS_SEPTIC: &[Vec3] = &[
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
fn chmutov_nodes() -> Vec<Vec3> {
    let at = |k: u32| (f64::from(k) * std::f64::consts::PI / 8.0).cos();
    let low = [1, 3, 5, 7].map(at);
    let high = [2, 4, 6].map(at);
    let pairs = low.iter().flat_map(|&x| low.map(|y| [x, y]));
    pairs.flat_map(|[x, y]| high.map(|z| [x, y, z])).collect()
}

/// Where two of the four planes meet on the sphere of radius √m, and on the axes through the corners, where the squared and
/// the quartic term touch.
fn kummer_nodes(m: f64) -> Vec<Vec3> {
    let s = 0.5 * (1.0 - m);
    vec![[0.0, (m - 1.0).sqrt(), 1.0], [SQRT_2 * s, 0.0, s]]
}

/// Born and Wolf: the conical points lie in the plane of the largest and the smallest principal value.
fn fresnel_nodes() -> Vec<Vec3> {
    let [a, b, c] = [1.6f64, 1.2, 0.8].map(|v| v * v);
    let x = (c * (a - b) / (a - c)).sqrt();
    vec![[x, 0.0, (a * (b - c) / (a - c)).sqrt()]]
}

/// Apéry's parametrisation.
fn boy(u: f64, v: f64) -> Vec3 {
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
fn cyclide(u: f64, v: f64) -> Vec3 {
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
