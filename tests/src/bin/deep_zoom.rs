//! Where each tier stops being true in a zoom, and the pictures.
//!
//!     cargo run --release -p pullback-tests --bin deep_zoom -- [--adapter NAME] [--sheet FILE.png]
//!
//! Prints for each field and width which tiers give a picture that cannot be told from the true one (colour within 1/512,
//! lines within a quarter of a pixel; true values of 60 digits). With `--sheet`, draws a sheet of pictures: for the
//! first two fields a row for every fourth width, and a column for each tier.

use std::process::ExitCode;

use pullback_compiler::lower::Precision;
use pullback_runtime::{
    AdapterChoice, Capabilities, Frame, Gpu, Metadata, Pipeline, Renderer, Size, View, image_file,
};
use pullback_tests::deep_zoom::{FIELDS, Field, Zoom, program, table, zooms};

/// One picture of the sheet.
const TILE: Size = Size {
    width: 240,
    height: 180,
};
/// Between pictures, pixels.
const GAP: u32 = 4;

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let (mut adapter, mut sheet) = ("auto".to_owned(), None);
    while let Some(name) = arguments.next() {
        match (name.as_str(), arguments.next()) {
            ("--adapter", Some(value)) => adapter = value,
            ("--sheet", Some(value)) => sheet = Some(value),
            _ => {
                eprintln!("deep_zoom [--adapter NAME] [--sheet FILE.png]");
                return ExitCode::from(2);
            }
        }
    }
    let choice: AdapterChoice = adapter.parse().unwrap_or_default();
    let gpu = match Gpu::open(&choice) {
        Ok(gpu) => gpu,
        Err(error) => {
            eprintln!("{error}");
            return ExitCode::from(3);
        }
    };
    println!("{}\n\n{}", gpu.adapter(), table(&gpu));
    if let Some(path) = sheet {
        draw(&gpu, &path);
    }
    ExitCode::SUCCESS
}

fn draw(gpu: &Gpu, path: &str) {
    // the third has no detail at depth
    let rows: Vec<(&Field, Zoom)> = FIELDS[..2]
        .iter()
        .flat_map(|field| zooms(field).into_iter().step_by(4).map(move |z| (field, z)))
        .collect();
    let width = 4 * TILE.width + 3 * GAP;
    let height = rows.len() as u32 * (TILE.height + GAP) - GAP;
    let mut pixels = vec![255; width as usize * height as usize * 4];
    for (row, (field, zoom)) in (0..).zip(&rows) {
        for (column, precision) in (0..).zip(Precision::ALL) {
            if !gpu.has(precision) {
                continue;
            }
            let picture = picture(gpu, field, zoom, precision);
            let (left, top) = (column * (TILE.width + GAP), row * (TILE.height + GAP));
            for (y, line) in (top..).zip(picture.chunks_exact(TILE.width as usize * 4)) {
                let at = (y as usize * width as usize + left as usize) * 4;
                pixels[at..at + line.len()].copy_from_slice(line);
            }
        }
    }
    let size = Size { width, height };
    let written = image_file::write_png(path.as_ref(), size, &Metadata(Vec::new()), |sink| {
        sink.rows(&pixels).map_err(Into::into)
    });
    if let Err(error) = written {
        eprintln!("{path}: {error}");
    }
}

fn picture(gpu: &Gpu, field: &Field, zoom: &Zoom, precision: Precision) -> Vec<u8> {
    let program = program(field);
    let tier = Capabilities::tier(gpu, precision).expect("a tier");
    let scene = program.scene_module(0, tier).expect("a scene");
    let settings = scene.pack_settings(&program.pictures()[0].settings);
    let frame = Frame {
        view: View {
            center: field.center,
            height: zoom.height(),
        },
        params: &[],
        settings: &settings,
        size: TILE,
        samples: 2,
        time: 0.0,
        pipeline: Pipeline::Compute,
    };
    let mut pixels = Vec::new();
    let mut renderer = Renderer::new(gpu, &scene).expect("a renderer");
    renderer.render(&frame, &mut pixels).expect("a picture");
    pixels
}
