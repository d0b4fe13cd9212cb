//! Animations, deep pictures and sheets, from the command line. The processor draws: no adapter is needed.

use std::io::BufReader;
use std::path::Path;
use std::process::Command;

/// Exit code and standard error of `pullback` in `folder`.
fn pullback(folder: &Path, arguments: &[&str]) -> (i32, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_pullback"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap();
    let errors = String::from_utf8(output.stderr).unwrap();
    (output.status.code().unwrap(), errors)
}

/// `pullback render` of a small picture on the processor.
fn render(folder: &Path, formula: &str, more: &[&str]) -> (i32, String) {
    let small = [
        "render",
        formula,
        "--adapter",
        "reference",
        "--size",
        "24x16",
    ];
    pullback(folder, &[&small, more].concat())
}

/// Width, height, bits of a number, and bytes of each frame.
fn read(path: &Path) -> (u32, u32, png::BitDepth, Vec<Vec<u8>>) {
    let file = BufReader::new(std::fs::File::open(path).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let count = reader
        .info()
        .animation_control()
        .map_or(1, |a| a.num_frames);
    let mut frames = Vec::new();
    for _ in 0..count {
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        frames.push(pixels);
    }
    let info = reader.info();
    (info.width, info.height, info.bit_depth, frames)
}

#[test]
fn a_sweep_draws_what_its_values_draw_alone() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let formula = "param k = 5 in 0..9\nsin(k x) + y";
    let swept = render(
        at,
        formula,
        &["--frames", "3", "--sweep", "k=1..2", "-o", "a.png"],
    );
    assert_eq!(swept.0, 0, "{}", swept.1);
    let apng = render(
        at,
        formula,
        &["--frames", "3", "--sweep", "k=1..2", "-o", "a.apng"],
    );
    assert_eq!(apng.0, 0, "{}", apng.1);
    let (.., animated) = read(&at.join("a.apng"));
    assert_eq!(animated.len(), 3);
    for (n, (k, frame)) in ["k=1", "k=1.5", "k=2"].iter().zip(animated).enumerate() {
        let alone = render(at, formula, &["--set", k, "-o", "b.png"]);
        assert_eq!(alone.0, 0, "{}", alone.1);
        let (.., still) = read(&at.join("b.png"));
        let (.., numbered) = read(&at.join(format!("a-{}.png", n + 1)));
        assert_eq!(still, numbered);
        let opaque: Vec<u8> = frame.chunks(4).flat_map(|p| p[..3].to_vec()).collect();
        assert_eq!(still[0], opaque);
    }
}

#[test]
fn the_clock_runs_where_nothing_else_does_and_a_loop_leaves_out_its_end() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let clock = render(
        at,
        "x + time",
        &["--frames", "2", "--rate", "4", "-o", "a.png"],
    );
    assert_eq!(clock.0, 0, "{}", clock.1);
    let alone = render(at, "x + time", &["--time", "0.25", "-o", "b.png"]);
    assert_eq!(alone.0, 0, "{}", alone.1);
    assert_eq!(read(&at.join("a-2.png")), read(&at.join("b.png")));
    let sweep = [
        "--frames",
        "4",
        "--sweep",
        "time=0..1",
        "--loop",
        "-o",
        "c.png",
    ];
    assert_eq!(render(at, "x + time", &sweep).0, 0);
    assert_eq!(read(&at.join("c-2.png")), read(&at.join("b.png")));
}

#[test]
fn sixteen_bits_are_finer_than_eight() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    for (name, depth) in [
        ("a.png", "8"),
        ("b.png", "16"),
        ("c.exr", "16"),
        ("d.exr", "32"),
    ] {
        let drawn = render(at, "x y", &["--depth", depth, "-o", name]);
        assert_eq!(drawn.0, 0, "{}", drawn.1);
    }
    let (.., eight, coarse) = read(&at.join("a.png"));
    let (.., sixteen, fine) = read(&at.join("b.png"));
    assert_eq!(
        (eight, sixteen),
        (png::BitDepth::Eight, png::BitDepth::Sixteen)
    );
    for (coarse, fine) in coarse[0].iter().zip(fine[0].as_chunks::<2>().0) {
        let fine = f64::from(u16::from_be_bytes(*fine)) / 257.0;
        // half a step of rounding and half a step of dither
        assert!((fine - f64::from(*coarse)).abs() <= 1.01, "{fine} {coarse}");
    }
}

#[test]
fn what_a_file_cannot_hold_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let check = |more: &[&str], message: &str| {
        let (code, errors) = render(folder.path(), "x y", more);
        assert_eq!(code, 2, "{more:?}: {errors}");
        assert!(errors.contains(message), "{more:?}: {errors}");
    };
    check(&["-o", "a.gif"], "--frames is not given");
    check(&["--depth", "32"], "8 or 16 bits, not 32");
    check(&["--depth", "8", "-o", "a.exr"], "16 or 32 bits, not 8");
    check(
        &["--depth", "16", "--pipeline", "fragment"],
        "8 bits of sRGB",
    );
    check(
        &["--depth", "16", "--frames", "2", "-o", "a.gif"],
        "holds 8 bits",
    );
    check(&["--frames", "2", "--sweep", "q=1..2"], "`q`");
    check(
        &["--frames", "2", "--sweep", "line_width=1..99"],
        "between 0 and 20",
    );
    check(&["--frames", "2", "--sweep", "height=1"], "NAME=FROM..TO");
    check(&["--sweep", "height=1..2"], "--frames");
    check(
        &["--frames", "3", "--sweep", "major=1..2"],
        "whole number, not 1.5",
    );
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn a_sheet_holds_every_picture_at_its_place() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    for (name, text) in [("a", "x + y"), ("b", "x y"), ("c", "x -")] {
        std::fs::write(at.join(format!("{name}.pull")), text).unwrap();
    }
    let sheet = [
        "gallery",
        ".",
        "--adapter",
        "reference",
        "--tile",
        "24x16",
        "--columns",
        "2",
    ];
    let (code, errors) = pullback(at, &[&sheet[..], &["-o", "sheet.png"]].concat());
    assert_eq!(code, 1, "{errors}");
    assert!(errors.contains("c.pull"), "{errors}");
    let (width, height, _, pixels) = read(&at.join("sheet.png"));
    assert_eq!((width, height), (2 * 24 + 3 * 6, 16 + 2 * 6));
    for (left, name) in [(6, "a.pull"), (36, "b.pull")] {
        assert_eq!(render(at, name, &["-o", "alone.png"]).0, 0);
        let (.., alone) = read(&at.join("alone.png"));
        for (row, line) in alone[0].chunks(24 * 3).enumerate() {
            let start = ((row + 6) * width as usize + left) * 3;
            assert_eq!(&pixels[0][start..start + line.len()], line, "{name}");
        }
    }
}
