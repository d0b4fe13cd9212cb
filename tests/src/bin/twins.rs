//! Frame times of the compiler's scenes against programs written by hand, and how far both are from the f64
//! reference: a table in Markdown. The executable carries all that it needs.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use pullback_compiler::emit::{Target, write};
use pullback_compiler::lower::Precision;
use pullback_runtime::difference::Bitmap;
use pullback_runtime::executor::Kind;
use pullback_runtime::{AdapterChoice, Error, Gpu, Metadata, Size, image_file};
use pullback_tests::twins::{Count, Measured, Plan, TWINS, Twin, count, measure};

/// Frame times and errors of pictures of every scene, and of a twin that was written by hand.
#[derive(Parser)]
struct Options {
    /// `auto`, `gpu`, `software`, or part of an adapter's name
    #[arg(long, default_value = "auto")]
    adapter: String,
    /// Pixels of a timed frame
    #[arg(long, default_value = "1280x720", value_parser = size)]
    size: Size,
    /// Pixels of the pictures that are compared with the f64 reference
    #[arg(long, default_value = "320x180", value_parser = size)]
    small: Size,
    /// How often all draw, one after the other
    #[arg(long, default_value_t = 15)]
    turns: u32,
    /// Only scenes whose name contains this
    #[arg(long, default_value = "")]
    only: String,
    /// Times alone, without the f64 reference
    #[arg(long)]
    times: bool,
    /// Shaders that read their settings, so that these could change, instead of such that are made for them
    #[arg(long)]
    general: bool,
    /// A scene in WGSL, as `pullback emit --what scene` writes it, that is timed in the place of `fast`: to find out
    /// what costs by leaving it out
    #[arg(long)]
    instead: Option<PathBuf>,
    /// Counts instructions a pixel by the executor, instead of measuring times
    #[arg(long)]
    count: bool,
    /// With `--count`, the functions that take the most
    #[arg(long, default_value_t = 0)]
    functions: usize,
    /// Writes our shaders in `fast` as WGSL, to be changed by hand and given to `--instead`
    #[arg(long)]
    text: bool,
    /// Where to write the pictures that are compared
    #[arg(long)]
    pictures: Option<PathBuf>,
}

fn size(text: &str) -> Result<Size, String> {
    let side = |part: &str| part.parse().ok().filter(|side| (1..=8192).contains(side));
    text.split_once('x')
        .and_then(|(w, h)| {
            Some(Size {
                width: side(w)?,
                height: side(h)?,
            })
        })
        .ok_or_else(|| "write WxH, such as 1280x720".to_owned())
}

fn main() -> ExitCode {
    match run(&Options::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn run(options: &Options) -> Result<(), Error> {
    if options.count {
        return counts(options);
    }
    if options.text {
        texts(options);
        return Ok(());
    }
    let gpu = Gpu::open(&options.adapter.parse::<AdapterChoice>().unwrap_or_default())?;
    println!("{}\n", gpu.adapter());
    println!(
        "{}x{}, one sample a pixel, {} turns\n",
        options.size.width, options.size.height, options.turns
    );
    println!(
        "| scene | formula | twin, ms | fast / twin | accurate / twin | fast / unchecked | error: accurate | fast | twin |\n\
         | --- | --- | ---: | ---: | ---: | ---: | --- | --- | --- |"
    );
    let plan = Plan {
        size: options.size,
        small: options.small,
        turns: options.turns,
        reference: !options.times,
        general: options.general,
        instead: options
            .instead
            .as_ref()
            .map(std::fs::read_to_string)
            .transpose()?,
    };
    for twin in TWINS.iter().filter(|t| t.scene.contains(&options.only)) {
        let measured = measure(twin, &gpu, &plan)?;
        println!("{}", row(twin.scene, twin.formula, &measured));
        for (name, picture) in &measured.pictures {
            if let Some(folder) = &options.pictures {
                write_picture(picture, &folder.join(format!("{}-{name}.png", twin.scene)))?;
            }
        }
    }
    Ok(())
}

/// Our shaders.
fn texts(options: &Options) {
    for twin in TWINS.iter().filter(|t| t.scene.contains(&options.only)) {
        let still = twin.still(options.size, Precision::Fast);
        let scene = still.shader(options.general);
        match write(&scene.module, &scene.info, Target::Wgsl, twin.scene) {
            Ok(text) => println!("{}", String::from_utf8_lossy(&text)),
            Err(problem) => eprintln!("{}: {problem}", twin.scene),
        }
    }
}

/// Issue slots of a warp for each pixel, ours in `fast` and the twin's.
fn counts(options: &Options) -> Result<(), Error> {
    println!(
        "| scene | fast / twin | program | slots | arithmetic | quotients | elementary | memory | flow | uniform |\n\
         | --- | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"
    );
    let wanted = |t: &&Twin| t.scene.contains(&options.only);
    for twin in TWINS.iter().filter(wanted) {
        let both = count(twin, options.size, Precision::Fast, options.general)?;
        let ratio = both[0].total() / both[1].total();
        for (name, count) in ["fast", "twin"].iter().zip(&both) {
            println!("{}", count_row(twin.scene, ratio, name, count));
        }
        let [ours, theirs] = [0, 1].map(|k| both[k].functions());
        for k in 0..options.functions {
            let shown = |of: Option<&(String, f64)>| {
                of.map_or(String::new(), |(name, slots)| format!("{slots:8.1} {name}"))
            };
            println!("{:40}{}", shown(ours.get(k)), shown(theirs.get(k)));
        }
    }
    Ok(())
}

fn count_row(scene: &str, ratio: f64, name: &str, count: &Count) -> String {
    let kinds = Kind::ALL.map(|kind| format!("{:.0}", count.of(kind)));
    let total = count.total();
    format!(
        "| {scene} | {ratio:.2} | {name} | {total:.0} | {} |",
        kinds.join(" | ")
    )
}

fn row(scene: &str, formula: &str, measured: &Measured) -> String {
    let [accurate, fast, unchecked] = measured.ratios;
    let off = measured.off.map_or(["", "", ""].map(str::to_owned), |off| {
        off.map(|off| off.to_string())
    });
    format!(
        "| {scene} | {formula} | {:.3} | {fast:.2} | {accurate:.2} | {unchecked:.2} | {} |",
        measured.seconds[2] * 1e3,
        off.join(" | ")
    )
}

fn write_picture(picture: &Bitmap, path: &std::path::Path) -> Result<(), Error> {
    let rgba: Vec<u8> = picture
        .pixels()
        .iter()
        .flat_map(|&[r, g, b]| [r, g, b, u8::MAX])
        .collect();
    image_file::write_png(path, picture.size(), &Metadata(Vec::new()), |sink| {
        Ok(sink.rows(&rgba)?)
    })
}
