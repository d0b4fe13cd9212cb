//! `pullback diff` as a user meets it.

mod shared;

use std::path::Path;

use pullback_runtime::{Error, Metadata, Size, image_file};
use shared::pullback;

/// Writes a picture whose pixels have these colours.
fn write(path: &Path, size: Size, colour: impl Fn(u32, u32) -> [u8; 3]) {
    image_file::write_png(path, size, &Metadata::default(), |sink| {
        for y in 0..size.height {
            let row: Vec<u8> = (0..size.width)
                .flat_map(|x| {
                    let [r, g, b] = colour(x, y);
                    [r, g, b, 255]
                })
                .collect();
            sink.rows(&row)?;
        }
        Ok::<(), Error>(())
    })
    .unwrap();
}

const SIZE: Size = Size {
    width: 40,
    height: 30,
};

#[test]
fn two_files() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    write(&path("a.png"), SIZE, |_, _| [100; 3]);
    write(&path("b.png"), SIZE, |x, y| {
        if (x, y) == (7, 9) {
            [255, 100, 100]
        } else {
            [100; 3]
        }
    });
    let (code, table, errors) =
        pullback(folder.path(), &["diff", "a.png", "b.png", "-o", "heat.png"]);
    assert_eq!(code, 0, "{errors}");
    for expected in [
        "40x30 pixels",
        "pixels that differ  0.0833 %",
        "at pixel 7,9",
        // 1 - ((100/255 + 0.055)/1.055)^2.4
        "greatest           0.872562   0.000000   0.000000",
    ] {
        assert!(table.contains(expected), "{expected}:\n{table}");
    }
    let heat = pullback_runtime::difference::Bitmap::read_png(&path("heat.png")).unwrap();
    assert_eq!(heat.size(), SIZE);
    assert_eq!(heat.pixels()[0], [0, 0, 4], "magma begins black");
    let light = |[r, g, b]: &[u8; 3]| u32::from(*r) + u32::from(*g) + u32::from(*b);
    let brightest = heat.pixels().iter().map(light).max().unwrap();
    assert_eq!(light(&heat.pixels()[9 * 40 + 7]), brightest);
    assert!(brightest > 100);
    let (_, json, _) = pullback(
        folder.path(),
        &["diff", "a.png", "a.png", "--format", "json"],
    );
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["flip"]["max"], 0.0);
    assert_eq!(json["differing"], 0.0);
    assert!(json["psnr"].is_null(), "infinite");
}

#[test]
fn what_is_wrong_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    write(&path("a.png"), SIZE, |_, _| [100; 3]);
    write(&path("b.png"), SIZE, |x, _| [x as u8; 3]);
    let large = Size {
        width: 41,
        height: 30,
    };
    write(&path("large.png"), large, |_, _| [0; 3]);
    std::fs::write(path("text.png"), "no picture").unwrap();
    let whole = std::fs::read(path("b.png")).unwrap();
    std::fs::write(path("half.png"), &whole[..whole.len() / 2]).unwrap();
    let check = |arguments: &str, code: i32, message: &str| {
        let arguments: Vec<&str> = std::iter::once("diff")
            .chain(arguments.split(' '))
            .collect();
        let (found, _, errors) = pullback(folder.path(), &arguments);
        assert_eq!(found, code, "{arguments:?}: {errors}");
        assert!(errors.contains(message), "{arguments:?}: {errors}");
    };
    check("a.png b.png --threshold flip=1", 0, "");
    check("a.png b.png --threshold flip=0.001", 1, "flip is 0.");
    check("a.png b.png --threshold psnr=90", 1, "may be at least 90");
    check("a.png a.png --threshold psnr=90 --threshold max=0", 0, "");
    check("a.png large.png", 2, "40x30 and 41x30");
    check("a.png text.png", 4, "text.png: not a readable PNG");
    check("a.png half.png", 4, "half.png: ");
    check("a.png none.png", 4, "none.png: no such file");
    check("a.png b.png -o none/heat.png", 4, "none/heat.png");
    check("a.png b.png --a gpu", 2, "--a");
    check("x --a gpu:acurate", 2, "did you mean `accurate`");
    check("x --threshold flop=1", 2, "did you mean `flip`");
    check("foo(x) --a ieee32", 1, "foo");
    assert!(!path("none").exists());
}

/// Of this formula, every operation is rounded the same way by the functions of the library; the pictures differ where a
/// rounding crosses a step of 8 bits, and nobody sees it.
#[test]
fn a_formula_drawn_twice() {
    let folder = tempfile::tempdir().unwrap();
    let arguments =
        "diff x^2-y --a ieee32 --b reference --size 64x48 --format json --threshold flip=0.01";
    let arguments: Vec<&str> = arguments.split(' ').collect();
    let (code, json, errors) = pullback(folder.path(), &arguments);
    assert_eq!(code, 0, "{errors}");
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(
        json["a"],
        "accurate on the processor, in exact single precision"
    );
    assert_eq!(json["b"], "double on the processor, in f64");
    assert_eq!(json["thresholds"][0]["holds"], true);
    let worst = json["linear"]["red"]["max"].as_f64().unwrap();
    assert!(worst < 0.02, "{worst}");
}
