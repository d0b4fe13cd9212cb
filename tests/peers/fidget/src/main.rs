//! Times fidget at the formulas of `pullback bench --peer`: lines of peer, version, what is timed, name and seconds, between
//! tabs. Text is no part of it, as fidget builds formulas of its own operators.

use std::time::Instant;

use fidget::context::Tree;
use fidget::jit::JitShape;
use fidget::shape::EzShape;
use fidget::types::Grad;
use fidget::vm::VmShape;

const TURNS: usize = 9;
const POINTS: usize = 1 << 14;

fn formulas() -> Vec<(&'static str, Tree)> {
    let (x, y, z) = (Tree::x(), Tree::y(), Tree::z());
    let square = |t: &Tree| t.clone().square();
    let cube = |t: &Tree| t.clone().square() * t.clone();
    let peaks = {
        let bump = |a: Tree, b: Tree| (-(a.square()) - b.square()).exp();
        3.0 * (1.0 - x.clone()).square() * bump(x.clone(), y.clone() + 1.0)
            - 10.0
                * (x.clone() / 5.0 - cube(&x) - cube(&y) * square(&y))
                * bump(x.clone(), y.clone())
            - bump(x.clone() + 1.0, y.clone()) / 3.0
    };
    let gyroid = x.clone().sin() * y.clone().cos()
        + y.clone().sin() * z.clone().cos()
        + z.clone().sin() * x.clone().cos();
    let heart = cube(&(square(&x) + 2.25 * square(&y) + square(&z) - 1.0))
        - square(&x) * cube(&z)
        - 0.1125 * square(&y) * cube(&z);
    let radius = square(&x) + square(&y) + square(&z);
    vec![
        ("peaks", peaks),
        ("gyroid", gyroid),
        ("heart", heart),
        ("sphere", radius.clone().sqrt() - 1.0),
        ("gaussian", (-radius.clone()).exp()),
        ("airlight", 1.0 / (radius + 1.0)),
    ]
}

fn median(mut work: impl FnMut()) -> f64 {
    let mut times: Vec<f64> = (0..=TURNS)
        .map(|_| {
            let start = Instant::now();
            work();
            start.elapsed().as_secs_f64()
        })
        .collect();
    // the first one warms up
    times.remove(0);
    times.sort_by(f64::total_cmp);
    times[TURNS / 2]
}

/// A coordinate of places like those of `pullback bench --peer`, with its own derivative by it.
fn places(of: usize) -> Vec<Grad> {
    let [dx, dy, dz] = [0, 1, 2].map(|k| f32::from(u8::from(k == of)));
    (0..POINTS)
        .map(|k| (((3 * k + of) as f64 * 0.618_033_988).fract() - 0.5) as f32)
        .map(|x| Grad::new(x, dx, dy, dz))
        .collect()
}

macro_rules! time {
    ($kind:ty, $peer:literal) => {
        for (name, tree) in formulas() {
            let made = median(|| {
                let shape = <$kind>::from(tree.clone());
                std::hint::black_box(shape.ez_grad_slice_tape());
            });
            println!("{}\t0.5\tgradient, made\t{name}\t{made}", $peer);
            let shape = <$kind>::from(tree);
            let tape = shape.ez_grad_slice_tape();
            let mut evaluator = <$kind>::new_grad_slice_eval();
            let [x, y, z] = [0, 1, 2].map(places);
            let all = median(|| {
                let found = evaluator.eval(&tape, &x, &y, &z);
                std::hint::black_box(found.map(<[_]>::len).unwrap_or(0));
            });
            let each = all / POINTS as f64;
            println!("{}\t0.5\tvalue and gradient, a point\t{name}\t{each}", $peer);
        }
    };
}

fn main() {
    time!(VmShape, "fidget VM");
    time!(JitShape, "fidget JIT");
}
