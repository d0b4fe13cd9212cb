//! Small pictures of every scene are as they were. `BLESS=1` draws them anew; `PULLBACK_ADAPTER` names another adapter.

use pullback_runtime::difference::Bitmap;
use pullback_tests::accuracy::evaluators::suite_gpu;
use pullback_tests::goldens::{self, CAP, Golden};
use pullback_tests::pictures::encoded;
use pullback_tests::stills::{Machine, Still};

/// All pictures together, in bytes.
const MOST: u64 = 1 << 20;

fn mean(golden: &Golden, picture: &Bitmap) -> f64 {
    match golden.difference(picture) {
        Ok(difference) => difference.perceptual.mean,
        Err(error) => panic!("{}: {error}; BLESS=1 draws it", golden.name),
    }
}

#[test]
fn pictures_are_as_they_were() {
    let Some(gpu) = suite_gpu() else { return };
    let machine = Machine::Adapter(gpu);
    let bless = std::env::var_os("BLESS").is_some();
    let mut bytes = 0;
    for golden in goldens::all() {
        let picture = golden.draw(&golden.stills(|_| ()), &machine).unwrap();
        if bless {
            golden.keep(&picture).unwrap();
        }
        let mean = mean(&golden, &picture);
        println!("{}: {mean:.6}", golden.name);
        assert!(mean <= CAP, "{}: {mean}, above {CAP}", golden.name);
        bytes += std::fs::metadata(golden.path()).unwrap().len();
    }
    assert!(bytes < MOST, "{bytes} bytes of pictures");
}

/// Pictures of the gallery whose scenes draw lines, without those whose only lines are the thin edges of a box.
const LINES: [&str; 11] = [
    "levels",
    "logcontours",
    "implicit",
    "checker",
    "grid",
    "sphere",
    "surface",
    "slices",
    "nested",
    "cutaway",
    "volumecut",
];

/// A picture whose light is 2 % more.
fn brighter(picture: &Bitmap) -> Bitmap {
    let light = |byte: u8| match f64::from(byte) / 255.0 {
        // IEC 61966-2-1
        low if low <= 0.04045 => low / 12.92,
        high => ((high + 0.055) / 1.055).powf(2.4),
    };
    let changed = |byte: u8| (encoded((1.02 * light(byte)).min(1.0)) * 255.0).round() as u8;
    let rgba: Vec<u8> = picture
        .pixels()
        .iter()
        .flat_map(|&[r, g, b]| [changed(r), changed(g), changed(b), u8::MAX])
        .collect();
    Bitmap::from_rgba(picture.size(), &rgba).unwrap()
}

/// Every width of a line is 10 % more.
fn widen(still: &mut Still) {
    for setting in &mut still.settings {
        if setting.spec.name.ends_with("width") {
            setting.value *= 1.1;
        }
    }
}

#[test]
fn small_changes_are_caught() {
    let Some(gpu) = suite_gpu() else { return };
    let machine = Machine::Adapter(gpu);
    for golden in goldens::all() {
        // constants have no place where they glow: there is only a background that is nearly black
        if golden.name != "glow-special" {
            let kept = Bitmap::read_png(&golden.path()).unwrap();
            let change = mean(&golden, &brighter(&kept));
            println!("{}: 2 % more light {change:.5}", golden.name);
            assert!(change > CAP, "{}: {change}", golden.name);
        }
        if LINES.contains(&golden.name.as_str()) {
            let picture = golden.draw(&golden.stills(widen), &machine).unwrap();
            let change = mean(&golden, &picture);
            println!("{}: lines 10 % wider {change:.5}", golden.name);
            assert!(change > CAP, "{}: {change}", golden.name);
        }
    }
}
