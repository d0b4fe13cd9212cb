//! Groups of rotations and reflections, by generators, and the orbits of points.

pub type Vec3 = [f64; 3];
pub type Matrix = [Vec3; 3];

pub fn apply(m: &Matrix, p: Vec3) -> Vec3 {
    m.map(|row| (0..3).map(|k| row[k] * p[k]).sum())
}

const MIRROR_X: Matrix = [[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
const MIRROR_Y: Matrix = [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]];
const MIRROR_Z: Matrix = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]];
const SWAP: Matrix = [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
const SWAP_TURNED: Matrix = [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]];
const CYCLE: Matrix = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]];
const TURN_Z: Matrix = [[-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]];

/// The rotation by a part of a turn about an axis (Rodrigues' formula).
fn rotation(axis: Vec3, parts: f64) -> Matrix {
    let length = axis.iter().map(|a| a * a).sum::<f64>().sqrt();
    let n = axis.map(|a| a / length);
    let (s, c) = (std::f64::consts::TAU / parts).sin_cos();
    let cross = [[0.0, -n[2], n[1]], [n[2], 0.0, -n[0]], [-n[1], n[0], 0.0]];
    let one = |j: usize, k: usize| if j == k { c } else { 0.0 };
    [0, 1, 2].map(|j| [0, 1, 2].map(|k| one(j, k) + (1.0 - c) * n[j] * n[k] + s * cross[j][k]))
}

/// What maps a surface to itself.
#[derive(Clone, Copy, Debug)]
pub enum Symmetry {
    /// The icosahedron's 120.
    Icosahedron,
    /// The cube's 48.
    Cube,
    /// The tetrahedron's 24, with two-fold axes x, y and z.
    Tetrahedron,
    /// The tetrahedron's 24, with a two-fold axis z and three-fold axes (±√2, 0, 1) and (0, ±√2, -1).
    TurnedTetrahedron,
    /// The six permutations.
    Permutations,
    /// Rotations by a turn's n-th part about z, and mirrors that hold z and x: 2n.
    Pyramid(u32),
    /// Those and the mirror z → -z: 4n.
    Prism(u32),
    /// Rotations by a turn's n-th part about z.
    Rotations(u32),
    /// All rotations about an axis, 0 … 2, and the mirrors that hold it.
    Revolution(usize),
    /// All rotations about an axis, and the mirror that turns it around.
    RevolutionBoth(usize),
    /// The reflections of these axes.
    Mirrors(&'static [usize]),
    /// A half turn about an axis.
    HalfTurn(usize),
    /// Mirrors x and y, and (x, y, z) → (y, x, -z): 8.
    Disphenoid,
}

impl Symmetry {
    pub fn name(self) -> String {
        const AXES: [&str; 3] = ["x", "y", "z"];
        match self {
            Self::Icosahedron => "icosahedron, 120".into(),
            Self::Cube => "cube, 48".into(),
            Self::Tetrahedron | Self::TurnedTetrahedron => "tetrahedron, 24".into(),
            Self::Permutations => "permutations, 6".into(),
            Self::Pyramid(n) => format!("{n}-sided pyramid, {}", 2 * n),
            Self::Prism(n) => format!("{n}-sided prism, {}", 4 * n),
            Self::Rotations(n) => format!("rotations, {n}"),
            Self::Revolution(axis) => format!("revolution about {}", AXES[axis]),
            Self::RevolutionBoth(axis) => {
                format!("revolution about {}, and a mirror across", AXES[axis])
            }
            Self::Mirrors(axes) => {
                let names: Vec<&str> = axes.iter().map(|&k| AXES[k]).collect();
                format!("mirrors {}, {}", names.join(", "), 1 << axes.len())
            }
            Self::HalfTurn(axis) => format!("half turn about {}, 2", AXES[axis]),
            Self::Disphenoid => "disphenoid, 8".into(),
        }
    }

    pub fn generators(self) -> Vec<Matrix> {
        let mirror = |k: usize| [MIRROR_X, MIRROR_Y, MIRROR_Z][k];
        let z = [0.0, 0.0, 1.0];
        let axis = |k: usize| [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], z][k];
        match self {
            Self::Icosahedron => {
                let phi = 0.5 + 1.25f64.sqrt();
                vec![CYCLE, MIRROR_X, rotation([phi, 1.0, 0.0], 5.0)]
            }
            Self::Cube => vec![CYCLE, SWAP, MIRROR_X],
            Self::Tetrahedron => vec![CYCLE, SWAP, TURN_Z],
            Self::TurnedTetrahedron => {
                vec![MIRROR_X, MIRROR_Y, rotation([2f64.sqrt(), 0.0, 1.0], 3.0)]
            }
            Self::Permutations => vec![CYCLE, SWAP],
            Self::Pyramid(n) => vec![rotation(z, n.into()), MIRROR_Y],
            Self::Prism(n) => vec![rotation(z, n.into()), MIRROR_Y, MIRROR_Z],
            Self::Rotations(n) => vec![rotation(z, n.into())],
            Self::Revolution(k) => vec![rotation(axis(k), 6.1), mirror((k + 1) % 3)],
            Self::RevolutionBoth(k) => {
                vec![rotation(axis(k), 6.1), mirror((k + 1) % 3), mirror(k)]
            }
            Self::Mirrors(axes) => axes.iter().map(|&k| mirror(k)).collect(),
            Self::HalfTurn(k) => vec![rotation(axis(k), 2.0)],
            Self::Disphenoid => vec![MIRROR_X, MIRROR_Y, SWAP_TURNED],
        }
    }

    /// All images of a point. The group has to be finite.
    pub fn orbit(self, p: Vec3) -> Vec<Vec3> {
        let generators = self.generators();
        let mut found = vec![p];
        let mut next = 0;
        while next < found.len() {
            for m in &generators {
                let image = apply(m, found[next]);
                let near = |q: &Vec3| (0..3).all(|k| (q[k] - image[k]).abs() < 1e-7);
                if !found.iter().any(near) {
                    found.push(image);
                }
            }
            next += 1;
            assert!(found.len() <= 120, "no finite group");
        }
        found
    }
}
