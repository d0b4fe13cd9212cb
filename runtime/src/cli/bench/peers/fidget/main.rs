//! Times fidget at the formulas of `pullback bench --peer`: lines of peer, version, what is timed, name and seconds, between
//! tabs. Text is no part of it, as fidget builds formulas of its own operators. With the name of a folder it draws pictures
//! into it, of the model `model.vm` there and of a gyroid.

use std::path::Path;
use std::time::Instant;

use fidget::context::{Context, Tree};
use fidget::jit::JitShape;
use fidget::raster::{pixel, voxel};
use fidget::shape::{BoundShape, EzShape};
use fidget::types::Grad;
use fidget::vm::VmShape;

const TURNS: usize = 9;
const POINTS: usize = 1 << 14;
/// Pixels of a side of a picture.
const SIDE: u32 = 1024;

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
    let begin = Instant::now();
    let mut times = Vec::new();
    // the first one warms up; of what is slow there are fewer
    while times.len() < 2 || times.len() <= TURNS && begin.elapsed().as_secs() < 5 {
        let start = Instant::now();
        work();
        times.push(start.elapsed().as_secs_f64());
    }
    times.remove(0);
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
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

/// A picture of a model of the plane: a byte a pixel, 255 inside.
fn plane(folder: &Path) -> Option<()> {
    let text = std::fs::read(folder.join("model.vm")).ok()?;
    let (context, root) = Context::from_text(text.as_slice()).ok()?;
    let config = pixel::RenderConfig::from_size(SIDE.into());
    let draw = || {
        let shape = BoundShape::try_from(JitShape::new(&context, root).ok()?).ok()?;
        Some(config.run(shape))
    };
    let image = draw()?;
    let seconds = median(|| {
        std::hint::black_box(draw());
    });
    println!("fidget JIT\t0.5\tpicture\tmodel\t{seconds}");
    let bytes: Vec<u8> = image.iter().map(|p| u8::from(p.inside()) * 255).collect();
    written(&folder.join("model.pgm"), "P5", &bytes)
}

/// A picture of the part of a gyroid in a ball, coloured by its normals.
fn space(folder: &Path) -> Option<()> {
    let (x, y, z) = (Tree::x(), Tree::y(), Tree::z());
    let wave = |a: &Tree, b: &Tree| (a.clone() * 8.0).sin() * (b.clone() * 8.0).cos();
    let gyroid = wave(&x, &y) + wave(&y, &z) + wave(&z, &x);
    let ball = x.square() + y.square() + z.square() - 0.81;
    let tree = gyroid.max(ball);
    let config = voxel::RenderConfig::from_size(SIDE.into());
    let draw = || {
        let shape = BoundShape::try_from(JitShape::from(tree.clone())).ok()?;
        Some(config.run(shape))
    };
    let image = draw()?;
    let seconds = median(|| {
        std::hint::black_box(draw());
    });
    println!("fidget JIT\t0.5\tpicture\tgyroid\t{seconds}");
    let bytes: Vec<u8> = image.iter().flat_map(|p| p.to_color()).collect();
    written(&folder.join("gyroid.ppm"), "P6", &bytes)
}

fn written(path: &Path, kind: &str, bytes: &[u8]) -> Option<()> {
    let mut all = format!("{kind}\n{SIDE} {SIDE}\n255\n").into_bytes();
    all.extend(bytes);
    std::fs::write(path, all).ok()
}

fn main() {
    if let Some(folder) = std::env::args().nth(1) {
        let folder = Path::new(&folder);
        if plane(folder).is_none() || space(folder).is_none() {
            std::process::exit(1);
        }
        return;
    }
    time!(VmShape, "fidget VM");
    time!(JitShape, "fidget JIT");
}
