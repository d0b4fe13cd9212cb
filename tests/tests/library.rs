//! Shapes and noise of the language's library: what their definitions promise, beyond the tables of references.

use pullback_compiler::What;
use pullback_compiler::derive::forward;
use pullback_compiler::eval::{Leaves, Tape};
use pullback_compiler::formula::Formula;
use pullback_compiler::ir::{Id, Ty};
use pullback_compiler::lower::Precision;
use pullback_compiler::table::Number;
use pullback_tests::accuracy::evaluators::{Machine, Point, suite_gpu};
use pullback_tests::accuracy::subjects::formula;

/// Weyl's sequence: the same evenly spread numbers in [0, 1) on every run.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((mixed ^ (mixed >> 31)) >> 11) as f64 / 2f64.powi(53)
    }

    fn within(&mut self, size: f64) -> f64 {
        size * (2.0 * self.next() - 1.0)
    }
}

fn at(args: impl IntoIterator<Item = f64>) -> Point {
    Point {
        args: args.into_iter().collect(),
        params: Vec::new(),
    }
}

fn random(count: usize, arity: usize, size: f64) -> Vec<Point> {
    let mut numbers = Numbers(1);
    (0..count)
        .map(|_| at((0..arity).map(|_| numbers.within(size)).collect::<Vec<_>>()))
        .collect()
}

fn run(source: &str, what: What, points: &[Point]) -> Vec<Vec<f64>> {
    let results = Machine::Reference.run(&formula(source), what, points);
    results.unwrap_or_else(|reason| panic!("{source}: {reason}"))
}

/// Formulas whose gradients have the length 1 almost everywhere.
const DISTANCES: [&str; 20] = [
    "f(p: vec3) = sphere(p, 1)",
    "f(p: vec3) = box(p, (1, 0.5, 0.75))",
    "f(p: vec3) = box(p, 0.75)",
    "f(p: vec3) = round_box(p, (1, 0.5, 0.75), 0.25)",
    "f(p: vec3) = torus(p, 1, 0.25)",
    "f(p: vec3) = cylinder(p, 0.75, 1)",
    "f(p: vec3) = plane(p, (2/3, -1/3, 2/3), 0.5)",
    "f(p: vec3) = segment(p, (-1, 0, 0), (0.5, 1, -1))",
    "f(p: vec3) = capsule(p, (-1, 0, 0), (0.5, 1, -1), 0.5)",
    "f(p: vec3) = cone(p, 1, 1.5)",
    "f(p: vec3) = octahedron(p, 1)",
    "f(p: vec2) = box(p, (1, 0.5))",
    "f(p: vec2) = box(p, 0.75)",
    "f(p: vec2) = round_box(p, (1, 0.5), 0.25)",
    "f(p: vec2) = segment(p, (-1, 0), (0.5, 1))",
    "f(p: vec2) = capsule(p, (-1, 0), (0.5, 1), 0.5)",
    "f(p: vec2) = circle(p, 1)",
    "f(p: vec2) = ring(p, 1, 0.25)",
    "f(p: vec2) = plane(p, (0.6, 0.8), 0.5)",
    "f(p: vec3) = max(-sphere(p, 0.5), box(p, 1))",
];

fn arity(source: &str) -> usize {
    if source.contains("vec3") { 3 } else { 2 }
}

fn slope(row: &[f64]) -> f64 {
    row[1..].iter().fold(0.0, |sum: f64, d| sum.hypot(*d))
}

#[test]
fn distances_grow_by_one_for_one() {
    for source in DISTANCES {
        let points = random(1000, arity(source), 2.0);
        for (row, point) in run(source, What::Gradient, &points).iter().zip(&points) {
            let slope = slope(row);
            assert!(
                (slope - 1.0).abs() < 1e-12,
                "{source} at {point:?}: {row:?}"
            );
        }
    }
}

/// Where coordinates are equal or zero, and on faces, edges and corners, a gradient is finite and no longer than 1.
#[test]
fn distances_have_finite_slopes_at_their_kinks() {
    let places = [-1.0, -0.75, -0.5, 0.0, 0.25, 0.5, 0.75, 1.0, 1.5];
    let digit = |k: usize, axis: u32| places[k / 9_usize.pow(axis) % 9];
    for source in DISTANCES {
        let arity = arity(source) as u32;
        let points: Vec<Point> = (0..9_usize.pow(arity))
            .map(|k| at((0..arity).map(|axis| digit(k, axis)).collect::<Vec<_>>()))
            .collect();
        for (row, point) in run(source, What::Gradient, &points).iter().zip(&points) {
            let slope = slope(row);
            assert!(
                row[0].is_finite() && slope < 1.0 + 1e-12,
                "{source} at {point:?}: {row:?}"
            );
        }
    }
}

#[test]
fn the_hash_is_the_same_on_the_gpu() {
    let Some(gpu) = suite_gpu() else { return };
    let formula = formula("f(x, y, z) = hash(x, y, z, -x)");
    let mut numbers = Numbers(7);
    let sizes = [
        1.0,
        8.0,
        1e3,
        2f64.powi(20),
        2f64.powi(31),
        2f64.powi(33),
        1e20,
        3e38,
    ];
    let mut points: Vec<Point> = (0..100_000)
        .map(|k| {
            let mut coordinate = || f64::from(numbers.within(sizes[k % sizes.len()]) as f32);
            at([coordinate(), coordinate(), coordinate()])
        })
        .collect();
    let edge = 2f64.powi(31);
    let special = [
        0.0,
        -0.0,
        -1e-30,
        -1e-41,
        1e-41,
        edge,
        -edge,
        edge - 128.0,
        128.0 - edge,
        0.5,
        -0.5,
    ];
    for a in special {
        for b in special {
            points.push(at([a, b, a + b].map(|x| f64::from(x as f32))));
        }
    }
    for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        points.extend((0..3).map(|k| at((0..3).map(|j| if j == k { wrong } else { 1.0 }))));
    }
    let wanted = Machine::Reference
        .run(&formula, What::Value, &points)
        .unwrap();
    for precision in [Precision::Accurate, Precision::Fast] {
        let gpu = Machine::Gpu(Box::new(suite_gpu().unwrap()), precision);
        let found = gpu.run(&formula, What::Value, &points).unwrap();
        let different = wanted.iter().zip(&found).zip(&points);
        let different: Vec<_> = different
            .filter(|((a, b), _)| a[0] != b[0] && !(a[0].is_nan() && b[0].is_nan()))
            .collect();
        assert!(
            different.is_empty(),
            "{}: {:?}",
            different.len(),
            different[0]
        );
    }
    drop(gpu);
}

/// Far from the origin as near it: the absolute error of value and gradient in float32 up to 2^20, against the reference
/// at the same float32 arguments. Octaves are not among these: each doubles the error of its coordinates.
#[test]
fn noise_is_as_good_far_away() {
    let Some(gpu) = suite_gpu() else { return };
    let gpu = Machine::Gpu(Box::new(gpu), Precision::Accurate);
    for (source, arity, value, gradient) in [
        ("f(x: real) = noise(x)", 1, 4e-7, 1.5e-6),
        ("f(p: vec2) = noise(p)", 2, 4e-7, 1.5e-6),
        ("f(p: vec3) = noise(p)", 3, 4e-7, 1.5e-6),
        ("f(p: vec3) = value_noise(p)", 3, 4e-7, 1.5e-6),
        ("f(p: vec2) = cellular(p)", 2, 4e-7, 1.5e-6),
        ("f(p: vec3) = cellular(p)", 3, 4e-7, 1.5e-6),
    ] {
        let count = if source.contains("cellular") {
            1500
        } else {
            6000
        };
        let mut numbers = Numbers(5);
        let mut coordinate = |k: i32| f64::from(numbers.within(2f64.powi(k % 21)) as f32);
        let points: Vec<Point> = (0..count)
            .map(|k| at((0..arity).map(|_| coordinate(k)).collect::<Vec<_>>()))
            .collect();
        let wanted = run(source, What::Gradient, &points);
        let found = gpu.run(&formula(source), What::Gradient, &points).unwrap();
        let (mut worst, mut steepest, mut sides) = (0.0_f64, 0.0_f64, 0);
        for (a, b) in wanted.iter().zip(&found) {
            let slopes = a[1..].iter().zip(&b[1..]).map(|(a, b)| (a - b).abs());
            let slopes = slopes.fold(0.0, |m: f64, d| if d.is_nan() { d } else { m.max(d) });
            worst = worst.max((a[0] - b[0]).abs());
            // beside the border of two regions float32 may see the other one
            if source.contains("cellular") && slopes > 1e-3 {
                sides += 1;
                continue;
            }
            assert!(slopes.is_finite(), "{source}: {a:?}, {b:?}");
            steepest = steepest.max(slopes);
        }
        println!("{source}: {worst:e}, {steepest:e}, {sides} on another side");
        assert!(
            worst <= value && steepest <= gradient,
            "{source}: {worst:e}, {steepest:e}"
        );
        assert!(sides <= 4, "{source}: {sides}");
    }
}

#[test]
fn noise_keeps_its_range() {
    // what no point may leave, and what some point has to reach
    let cases = [
        ("f(x: real) = noise(x)", 1, -1.0, 1.0, 0.9),
        ("f(p: vec2) = noise(p)", 2, -1.0, 1.0, 0.8),
        ("f(p: vec3) = noise(p)", 3, -1.0, 1.0, 0.75),
        (
            "f(p: vec3) = noise(vec4(p, p.x/3 - p.z))",
            3,
            -1.0,
            1.0,
            0.6,
        ),
        ("f(p: vec3) = value_noise(p)", 3, 0.0, 1.0, 0.9),
        ("f(p: vec3) = fbm(p)", 3, -1.0, 1.0, 0.5),
        ("f(p: vec2) = turbulence(p, 4, 2, 0.75)", 2, 0.0, 1.0, 0.5),
        ("f(p: vec2) = cellular(p)", 2, 0.0, 1.42, 1.0),
        ("f(p: vec3) = cellular(p)", 3, 0.0, 1.74, 1.0),
    ];
    for (source, arity, least, most, reached) in cases {
        let rows = run(source, What::Value, &random(10_000, arity, 1000.0));
        let values = || rows.iter().map(|row| row[0]);
        let (lo, hi) = (values().fold(9.0, f64::min), values().fold(-9.0, f64::max));
        assert!(least <= lo && hi <= most, "{source}: {lo}..{hi}");
        assert!(hi > reached, "{source}: no more than {hi}");
    }
    let lattice: Vec<Point> = (-20..20)
        .map(|k| at([f64::from(k), f64::from(3 * k), 7.0]))
        .collect();
    for row in run("f(p: vec3) = noise(p)", What::Value, &lattice) {
        assert_eq!(row[0], 0.0);
    }
}

#[test]
fn octaves_change_steadily() {
    let points = random(200, 3, 50.0);
    let of = |octaves: &str| {
        run(
            &format!("f(p: vec3) = fbm(p, {octaves})"),
            What::Value,
            &points,
        )
    };
    let far = |a: &[Vec<f64>], b: &[Vec<f64>]| {
        a.iter()
            .zip(b)
            .map(|(a, b)| (a[0] - b[0]).abs())
            .fold(0.0, f64::max)
    };
    assert!(far(&of("3"), &of("3.000000001")) < 1e-8);
    assert!(far(&of("3"), &of("2.999999999")) < 1e-8);
    assert!(far(&of("3"), &of("4")) > 0.01);
    assert_eq!(far(&of("16"), &of("40")), 0.0);
    assert_eq!(
        far(
            &of("1"),
            &run("f(p: vec3) = noise(p)", What::Value, &points)
        ),
        0.0
    );
    assert!(of("0").iter().chain(&of("-2")).all(|row| row[0] == 0.0));
}

/// Value, first and second derivatives of a formula as one tape.
fn second_order(formula: &Formula) -> Tape {
    let mut graph = formula.graph.clone();
    let leaves: Vec<Id> = (0..formula.scalars().len())
        .map(|k| Formula::leaf(&mut graph, k, Ty::Real))
        .collect();
    let (zero, one) = (graph.real(0.0), graph.real(1.0));
    let mut roots = vec![formula.value[0]];
    for (k, &leaf) in leaves.iter().enumerate() {
        let first =
            forward(&mut graph, &[formula.value[0]], &[(leaf, one)]).unwrap()[0].unwrap_or(zero);
        roots.push(first);
        for &other in &leaves[..=k] {
            roots.push(forward(&mut graph, &[first], &[(other, one)]).unwrap()[0].unwrap_or(zero));
        }
    }
    Tape::new(&graph, &roots)
}

/// The greatest jump of value, first and second derivatives at borders of cells.
fn jump(source: &str) -> f64 {
    let formula = formula(source);
    let arity = formula.scalars().len();
    let mut tape = second_order(&formula);
    let mut numbers = Numbers(3);
    let mut greatest: f64 = 0.0;
    for k in 0..600 {
        let mut point: Vec<f64> = (0..arity).map(|_| numbers.within(20.0)).collect();
        point[k % arity] = point[k % arity].round();
        if k % 7 == 0 {
            // an edge or a corner
            point[(k + 1) % arity] = point[(k + 1) % arity].round();
        }
        let mut side = |step: f64| {
            let inputs: Vec<Number> = point.iter().map(|x| Number::Real(x + step)).collect();
            let leaves = Leaves {
                inputs: &inputs,
                params: &[],
                time: 0.0,
                pixel: 0.0,
            };
            let mut out = Vec::new();
            tape.run(&leaves, |value| {
                out.push(if let Number::Real(x) = value {
                    x
                } else {
                    f64::NAN
                });
            });
            out
        };
        for (a, b) in side(-1e-10).iter().zip(side(1e-10)) {
            assert!(a.is_finite() && b.is_finite(), "{source} at {point:?}");
            greatest = greatest.max((a - b).abs());
        }
    }
    greatest
}

#[test]
fn noise_has_continuous_second_derivatives() {
    for source in [
        "f(x: real) = noise(x)",
        "f(p: vec2) = noise(p)",
        "f(p: vec3) = noise(p)",
        "f(p: vec3) = noise(vec4(p, p.y))",
        "f(x: real) = value_noise(x)",
        "f(p: vec2) = value_noise(p)",
        "f(p: vec3) = value_noise(p)",
    ] {
        let jump = jump(source);
        assert!(jump < 1e-6, "{source}: {jump}");
    }
    // a cubic is not enough, and this test sees it
    assert!(
        jump("f(x: real) = mix(hash(k), hash(k + 1), smoothstep(0, 1, x - k)) where k = floor(x)")
            > 1.0
    );
}

/// How large the graphs of noise are; a growth would be paid by every shader that has it.
#[test]
fn noise_stays_small() {
    for (source, value, second) in [
        ("f(p: vec2) = noise(p)", 120, 165),
        ("f(p: vec3) = noise(p)", 230, 405),
        ("f(p: vec3) = fbm(p)", 315, 750),
        ("f(p: vec3) = cellular(p)", 130, 205),
    ] {
        let formula = formula(source);
        let (graph, _) = formula.graph.compacted(&formula.value);
        println!("{source}: {} nodes", graph.nodes().len());
        assert!(
            graph.nodes().len() <= value,
            "{source}: {} nodes",
            graph.nodes().len()
        );
        let mut graph = formula.graph.clone();
        let one = graph.real(1.0);
        let mut roots = formula.value.to_vec();
        for k in 0..formula.scalars().len() {
            let leaf = Formula::leaf(&mut graph, k, Ty::Real);
            roots.extend(forward(&mut graph, &formula.value, &[(leaf, one)]).unwrap()[0]);
        }
        let nodes = graph.compacted(&roots).0.nodes().len();
        println!("{source}: {nodes} nodes with the gradient");
        assert!(nodes <= second, "{source}: {nodes} nodes with the gradient");
    }
}
