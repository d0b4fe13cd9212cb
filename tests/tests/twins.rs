//! The programs that are written by hand draw the pictures of the scenes.

use pullback_compiler::lower::Precision;
use pullback_runtime::difference::Bitmap;
use pullback_runtime::{Pipeline, Size};
use pullback_tests::accuracy::evaluators::suite_gpu;
use pullback_tests::stills::Machine;
use pullback_tests::twins::{Canvas, Off, TWINS};

/// The greatest mean of FLIP at this size is 0.048, of `levels`, whose lines are as near as three pixels here.
const MOST: f64 = 0.06;

#[test]
fn twins_draw_what_the_scenes_draw() {
    let Some(gpu) = suite_gpu() else { return };
    let size = Size {
        width: 160,
        height: 90,
    };
    let machine = Machine::Adapter(gpu.clone());
    for twin in TWINS {
        let still = twin.still(size, Precision::Accurate);
        let ours = still.draw(&machine, Pipeline::Compute).unwrap();
        let settings = still.scene.pack_settings(&still.settings);
        let frame = still.frame(&settings, Pipeline::Compute);
        let canvas = Canvas::new(&gpu, &frame).unwrap();
        let (module, info) = twin.module().unwrap();
        let theirs = canvas
            .picture(&canvas.stage(&module, &info).unwrap())
            .unwrap();
        let bitmap = |rows: &[u8]| Bitmap::from_rgba(size, rows).unwrap();
        let off = Off::new(&bitmap(&ours), &bitmap(&theirs)).unwrap();
        println!("{}: {off}", twin.scene);
        assert!(off.flip < MOST, "{}: {off}", twin.scene);
    }
}
