//! What is known of each surface of docs/surfaces, from its literature.

use crate::coordinates::{
    BARTH_DECIC, ENDRASS_OCTIC, LABS_SEPTIC, SARTI_DODECIC, TOGLIATTI, boy, chmutov_nodes, cyclide,
    fresnel_nodes, kummer_nodes,
};
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
