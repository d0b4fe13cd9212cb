//! The pictures of docs/special.md: their programs, and that each picture is what its program draws.

use pullback_compiler::compile;
use pullback_runtime::difference::Bitmap;
use pullback_runtime::executor::Arithmetic;
use pullback_runtime::{Pipeline, Size};
use pullback_tests::corpus::{files, read, root, special};
use pullback_tests::stills::{Machine, Still};

const SMALL: Size = Size {
    width: 24,
    height: 15,
};

/// Linear light of blocks of a picture, `SMALL.width` times `SMALL.height` of them.
fn blocks(picture: &Bitmap) -> Vec<[f64; 3]> {
    let size = picture.size();
    let side = size.width / SMALL.width;
    assert_eq!(
        (side * SMALL.width, side * SMALL.height),
        (size.width, size.height)
    );
    let mut sums = vec![[0.0; 3]; (SMALL.width * SMALL.height) as usize];
    for (k, pixel) in (0..).zip(picture.pixels()) {
        let (x, y) = (k % size.width / side, k / size.width / side);
        let sum = &mut sums[(y * SMALL.width + x) as usize];
        for channel in 0..3 {
            sum[channel] += light(f64::from(pixel[channel]) / 255.0) / f64::from(side * side);
        }
    }
    sums
}

/// IEC 61966-2-1.
fn light(encoded: f64) -> f64 {
    match encoded {
        low if low <= 0.04045 => low / 12.92,
        high => ((high + 0.055) / 1.055).powf(2.4),
    }
}

/// The same blocks, drawn by the processor in exact binary32.
fn drawn(source: &str) -> Vec<[f64; 3]> {
    let still = Still::new(source, SMALL, 1);
    let machine = Machine::Processor(Arithmetic::Ieee32);
    let bytes = still.draw(&machine, Pipeline::Linear).expect(source);
    let words = bytes.as_chunks::<4>().0.iter();
    let values: Vec<f64> = words.map(|w| f64::from(f32::from_le_bytes(*w))).collect();
    let pixels = values.as_chunks::<4>().0.iter();
    pixels
        .map(|&[r, g, b, _]| [r, g, b].map(|c| c.clamp(0.0, 1.0)))
        .collect()
}

/// Mean of the distances of blocks.
fn apart(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    let distance = |(a, b): (&[f64; 3], &[f64; 3])| {
        let squares = (0..3).map(|k| (a[k] - b[k]).powi(2));
        squares.sum::<f64>().sqrt()
    };
    let sum: f64 = a.iter().zip(b).map(distance).sum();
    sum / f64::from(SMALL.width * SMALL.height)
}

#[test]
fn programs_are_clean_and_on_the_page() {
    let page = read(&root().join("docs/special.md"));
    for source in special() {
        let answer = compile(&source.text);
        assert!(
            answer.program.is_some() && answer.diagnostics.is_empty(),
            "{}",
            source.name
        );
        for extension in ["pull", "png"] {
            let name = format!("special/{}.{extension}", source.name);
            assert!(page.contains(&name), "{name}");
        }
    }
    let links = page.matches("](special/").count();
    assert_eq!(links, 2 * files("docs/special", "pull").len());
}

/// Of all pictures the one of a program is the nearest to what the program draws, by far.
#[test]
fn each_picture_is_what_its_program_draws() {
    let sources = special();
    let pictures: Vec<_> = sources
        .iter()
        .map(|source| {
            let path = root().join(format!("docs/special/{}.png", source.name));
            blocks(&Bitmap::read_png(&path).expect("a picture"))
        })
        .collect();
    for (k, source) in sources.iter().enumerate() {
        let drawn = drawn(&source.text);
        let distances: Vec<f64> = pictures.iter().map(|p| apart(p, &drawn)).collect();
        let others = distances.iter().enumerate().filter(|(j, _)| *j != k);
        let nearest = others.map(|(_, d)| *d).fold(f64::INFINITY, f64::min);
        println!(
            "{}: {:.4}, the nearest other {nearest:.4}",
            source.name, distances[k]
        );
        assert!(
            2.0 * distances[k] < nearest,
            "{}: {distances:?}",
            source.name
        );
    }
}
