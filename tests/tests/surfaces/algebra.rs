//! Degrees, symmetries, nodes and points of the surfaces.

use pullback_tests::mutate::Random;

use crate::facts::{Nodes, SURFACES, Surface};
use crate::group::{Matrix, Vec3, apply};
use crate::polynomial::{Jet, Polynomial};
use crate::program::Subject;

/// What is lost of a value, in units of the sum of its terms' absolute values.
const ROUNDING: f64 = 1e-13;

fn random_point(random: &mut Random) -> Vec3 {
    [(); 3].map(|()| random.below(4_000_001) as f64 / 1e6 - 2.0)
}

fn polynomial(surface: &Surface) -> Polynomial {
    Subject::of(surface.name).polynomial(surface.params)
}

#[test]
fn every_surface_has_its_degree() {
    for surface in SURFACES {
        assert_eq!(
            polynomial(surface).degree(),
            surface.degree,
            "{}",
            surface.name
        );
    }
}

#[test]
fn every_program_has_facts() {
    let names: Vec<&str> = SURFACES.iter().map(|s| s.name).collect();
    let files = pullback_tests::corpus::surfaces();
    let found: Vec<&str> = files.iter().map(|s| s.name.as_str()).collect();
    assert_eq!(names, found);
}

/// The expansion, against the evaluator of formulas.
#[test]
fn expanded_polynomials_are_the_formulas() {
    for surface in SURFACES {
        let mut subject = Subject::of(surface.name);
        let expanded = subject.polynomial(&[]);
        let mut random = Random::new(5);
        for _ in 0..20 {
            let p = random_point(&mut random);
            let (value, there) = (subject.value(p), expanded.at(p));
            let off = (value - there.value).abs();
            assert!(
                off <= ROUNDING * there.size,
                "{} at {p:?}: {value}, not {}",
                surface.name,
                there.value
            );
        }
    }
}

/// f(σ p) = f(p), or -f(p) for all p.
fn holds(f: &Polynomial, m: &Matrix) -> bool {
    let mut random = Random::new(3);
    let mut signs = [true; 2];
    for _ in 0..20 {
        let p = random_point(&mut random);
        let (a, b) = (f.at(p), f.at(apply(m, p)));
        let most = ROUNDING * (a.size + b.size);
        signs[0] &= (a.value - b.value).abs() <= most;
        signs[1] &= (a.value + b.value).abs() <= most;
    }
    signs[0] || signs[1]
}

#[test]
fn every_symmetry_holds() {
    for surface in SURFACES {
        let f = polynomial(surface);
        for m in surface.symmetry.generators() {
            assert!(holds(&f, &m), "{}: {m:?}", surface.name);
        }
    }
}

/// A rotation by another angle, and a mirror that is none, are told.
#[test]
fn a_symmetry_that_does_not_hold_is_told() {
    let f = polynomial(SURFACES.iter().find(|s| s.name == "togliatti").expect("it"));
    assert!(
        !crate::group::Symmetry::Prism(5)
            .generators()
            .iter()
            .all(|m| holds(&f, m))
    );
    assert!(
        !crate::group::Symmetry::Pyramid(6)
            .generators()
            .iter()
            .all(|m| holds(&f, m))
    );
}

fn determinant(m: &Matrix) -> f64 {
    let minor = |j: usize, k: usize| m[1][j] * m[2][k] - m[1][k] * m[2][j];
    m[0][0] * minor(1, 2) - m[0][1] * minor(0, 2) + m[0][2] * minor(0, 1)
}

/// Solves m x = b by Cramer's rule.
fn solved(m: &Matrix, b: Vec3) -> Vec3 {
    let whole = determinant(m);
    [0, 1, 2].map(|k| {
        let mut changed = *m;
        for (row, b) in changed.iter_mut().zip(b) {
            row[k] = b;
        }
        determinant(&changed) / whole
    })
}

/// Newton's method for ∇f = 0 from a point of five digits.
fn improved(jet: &Jet, near: Vec3) -> Vec3 {
    let mut p = near;
    for _ in 0..8 {
        let gradient = [0, 1, 2].map(|k| jet.gradient[k].at(p).value);
        let step = solved(&jet.hessian_at(p), gradient);
        p = [0, 1, 2].map(|k| p[k] - step[k]);
    }
    let off = (0..3).map(|k| (p[k] - near[k]).abs()).fold(0.0, f64::max);
    assert!(
        off < 2e-4,
        "{near:?} is {off} from the critical point {p:?}"
    );
    p
}

/// f = 0 and ∇f = 0 to rounding, and the Hessian is regular: |det H| against the product of the lengths of its rows.
fn check_node(name: &str, jet: &Jet, p: Vec3) {
    let f = jet.value.at(p);
    let hessian = jet.hessian_at(p);
    let lengths = hessian.map(|row| row.iter().map(|h| h * h).sum::<f64>().sqrt());
    let stiffest = lengths.iter().copied().fold(0.0, f64::max);
    assert!(
        f.value.abs() <= ROUNDING * f.size + 1e-24 * stiffest,
        "{name}: f is {} at {p:?}, of {}",
        f.value,
        f.size
    );
    let far = p.iter().fold(1.0f64, |far, x| far.max(x.abs()));
    for part in &jet.gradient {
        let slope = part.at(p);
        assert!(
            slope.value.abs() <= ROUNDING * slope.size + 1e-15 * far * stiffest,
            "{name}: {} at {p:?}, of {}",
            slope.value,
            slope.size
        );
    }
    let regular = determinant(&hessian).abs() / lengths.iter().product::<f64>();
    assert!(
        regular > 1e-6,
        "{name}: det H at {p:?} is {regular} of what it could be"
    );
}

#[test]
fn every_node_is_one() {
    for surface in SURFACES {
        let jet = Jet::new(polynomial(surface));
        let starts = match surface.nodes {
            Nodes::Exact(nodes) => nodes(),
            Nodes::Near(nodes) => nodes.iter().map(|&p| improved(&jet, p)).collect(),
            Nodes::Unclaimed => continue,
        };
        let mut found: Vec<Vec3> = Vec::new();
        for start in starts {
            for p in surface.symmetry.orbit(start) {
                let near = |q: &Vec3| (0..3).all(|k| (q[k] - p[k]).abs() < 1e-6);
                if !found.iter().any(near) {
                    check_node(surface.name, &jet, p);
                    found.push(p);
                }
            }
        }
        assert_eq!(found.len(), surface.count, "{}", surface.name);
    }
}

/// A parametrisation, or a line, of the literature lies on the surface.
#[test]
fn known_points_lie_on_their_surfaces() {
    for surface in SURFACES {
        let Some(points) = surface.points else {
            continue;
        };
        let f = Subject::of(surface.name).polynomial(&[]);
        let mut random = Random::new(11);
        for _ in 0..40 {
            let [u, v, _] = random_point(&mut random);
            let there = f.at(points(u, v));
            assert!(
                there.value.abs() <= ROUNDING * there.size,
                "{} at ({u}, {v}): {} of {}",
                surface.name,
                there.value,
                there.size
            );
        }
    }
}
