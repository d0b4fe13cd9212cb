//! `pullback render`

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use pullback_compiler::scene::{SettingKind, SettingSpec};
use pullback_compiler::{Picture, SceneModule};
use pullback_runtime::render::{MAX_SAMPLES, MAX_SIDE};
use pullback_runtime::{Frame, Gpu, Metadata, Pipeline, Renderer, Size, image_file};

use super::failure::Failure;
use super::progress::{Counted, Progress};
use super::source::Source;
use super::{Console, Device, Input, Output, Settings, overrides};

/// Arguments of `pullback render`.
#[derive(Debug, Args)]
pub(super) struct RenderArguments {
    #[command(flatten)]
    pub(super) input: Input,
    #[command(flatten)]
    output: Output,
    /// Width and height of the picture in pixels
    #[arg(long, default_value = "1200x900", value_name = "WxH", value_parser = size)]
    size: Size,
    /// Supersamples per axis of a pixel
    #[arg(long, default_value_t = 2, value_name = "N",
          value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_SAMPLES)))]
    samples: u32,
    /// World coordinates of the centre
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true)]
    center: Option<[f64; 2]>,
    /// Height of the view in world units
    #[arg(long, value_name = "H", value_parser = positive)]
    height: Option<f64>,
    #[command(flatten)]
    settings: Settings,
    #[command(flatten)]
    device: Device,
    /// The shader stage that computes the pixels
    #[arg(long, value_enum, default_value_t = Stage::Compute)]
    pipeline: Stage,
    /// Which `show` of the program to draw, from 1
    #[arg(long, value_name = "N")]
    show: Option<usize>,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Stage {
    Compute,
    Fragment,
}

/// Draws the picture and writes it.
pub(super) fn run(arguments: &RenderArguments, console: &Console) -> Result<(), Failure> {
    let source = Source::open(&arguments.input, console)?;
    let index = picture(arguments.show, &source, console)?;
    let scene = source.expect(source.program.scene_module(index), console)?;
    let picture = &source.program.pictures()[index];
    let (params, mut situation) =
        overrides::for_picture(&arguments.settings.set, &source.program, picture, &scene)?;
    situation.view.center = arguments.center.unwrap_or(situation.view.center);
    situation.view.height = arguments.height.unwrap_or(situation.view.height);
    let frame = Frame {
        view: situation.view,
        params: &params,
        settings: &situation.settings,
        size: arguments.size,
        samples: arguments.samples,
        time: arguments.settings.time,
        pipeline: match arguments.pipeline {
            Stage::Compute => Pipeline::Compute,
            Stage::Fragment => Pipeline::Fragment,
        },
    };
    let gpu = Gpu::open(&arguments.device.adapter)?;
    console.note(&format!("adapter: {}", gpu.adapter()));
    let metadata = metadata(&source, picture, &scene, &frame, &gpu);
    let path = arguments
        .output
        .output
        .clone()
        .unwrap_or_else(|| PathBuf::from(format!("{}.png", source.stem)));
    let shown = name(&path);
    let mut progress = Progress::new(console);
    let mut renderer = Renderer::new(&gpu, &scene)?;
    image_file::write_png(&path, frame.size, &metadata, |sink| {
        renderer.render(
            &frame,
            &mut Counted {
                sink,
                progress: &mut progress,
            },
        )
    })
    .map_err(Failure::writing(&shown))?;
    progress.finish();
    let Size { width, height } = frame.size;
    console.note(&format!(
        "{shown}: {width}x{height}, {:.2} s",
        progress.elapsed().as_secs_f64()
    ));
    Ok(())
}

/// Index of the picture to draw.
fn picture(show: Option<usize>, source: &Source, console: &Console) -> Result<usize, Failure> {
    let count = source.program.pictures().len();
    if count == 0 {
        return Err(Failure::usage_hint(
            "this program has no picture",
            "add `show SCENE(f)`; `pullback scenes` lists the scenes",
        ));
    }
    match show {
        None => {
            if count > 1 {
                console.note(&format!(
                    "drawing the first of {count} pictures; choose with --show"
                ));
            }
            Ok(0)
        }
        Some(n) if (1..=count).contains(&n) => Ok(n - 1),
        Some(n) => Err(Failure::usage(format!(
            "--show {n}: this program has {count} picture{}",
            if count == 1 { "" } else { "s" }
        ))),
    }
}

/// How the picture came about, without names of files.
fn metadata(
    source: &Source,
    picture: &Picture,
    scene: &SceneModule,
    frame: &Frame,
    gpu: &Gpu,
) -> Metadata {
    let [x, y] = frame.view.center;
    let Size { width, height } = frame.size;
    let params: Vec<String> = source
        .program
        .params()
        .iter()
        .zip(frame.params)
        .map(|(param, value)| format!("{} = {value}", param.name))
        .collect();
    let settings: Vec<String> = pullback_runtime::settings::slots(&scene.module)
        .iter()
        .filter_map(|slot| {
            // The shader's structure may have members that only fill it up.
            let spec = picture.scene.setting(&slot.name)?;
            let values = slot.read(frame.settings)?;
            Some(format!("{} = {}", slot.name, setting(spec, &values)))
        })
        .collect();
    Metadata(vec![
        (
            "Software",
            format!("pullback {}", env!("CARGO_PKG_VERSION")),
        ),
        ("Formula", source.text.trim_end().to_owned()),
        ("Scene", picture.scene.name.to_owned()),
        (
            "View",
            format!(
                "center = {x}, {y}; height = {}; size = {width}x{height}; samples = {}; time = {}",
                frame.view.height, frame.samples, frame.time
            ),
        ),
        ("Parameters", params.join("; ")),
        ("Settings", settings.join("; ")),
        ("Adapter", gpu.adapter().to_string()),
    ])
}

/// A setting's value as one writes it.
fn setting(spec: &SettingSpec, values: &[f64]) -> String {
    if let SettingKind::Choice(words) = spec.kind
        && let Some(word) = values.first().and_then(|&place| words.get(place as usize))
    {
        return (*word).to_owned();
    }
    let values: Vec<String> = values.iter().map(f64::to_string).collect();
    match &values[..] {
        [one] => one.clone(),
        _ => format!("({})", values.join(", ")),
    }
}

/// What to call an output in messages.
pub(super) fn name(path: &Path) -> String {
    if path == Path::new("-") {
        "standard output".into()
    } else {
        path.display().to_string()
    }
}

/// `WxH`
fn size(text: &str) -> Result<Size, String> {
    let side = |part: &str| part.trim().parse::<u32>().ok();
    let (width, height) = text
        .split_once(['x', 'X', '×'])
        .and_then(|(width, height)| Some((side(width)?, side(height)?)))
        .ok_or("write WxH, such as 1920x1080")?;
    if !(1..=MAX_SIDE).contains(&width) || !(1..=MAX_SIDE).contains(&height) {
        return Err(format!("each side must be 1 to {MAX_SIDE}"));
    }
    Ok(Size { width, height })
}

/// `x,y`
fn point(text: &str) -> Result<[f64; 2], String> {
    text.split_once(',')
        .and_then(|(x, y)| Some([x.trim().parse().ok()?, y.trim().parse().ok()?]))
        .filter(|point: &[f64; 2]| point.iter().all(|c| c.is_finite()))
        .ok_or_else(|| "write X,Y, such as -0.5,0".into())
}

fn positive(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|&value: &f64| value > 0.0 && value.is_finite())
        .ok_or_else(|| "must be a positive number".into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes() {
        let side = |text| size(text).map(|size| (size.width, size.height)).ok();
        assert_eq!(side("1920x1080"), Some((1920, 1080)));
        assert_eq!(side("16384×1"), Some((16384, 1)));
        for bad in [
            "",
            "1920",
            "0x1",
            "1x16385",
            "-1x1",
            "1x1x1",
            "99999999999x1",
        ] {
            assert_eq!(side(bad), None, "{bad}");
        }
    }

    #[test]
    fn points() {
        assert_eq!(point("-0.5, 2"), Ok([-0.5, 2.0]));
        for bad in ["", "1", "1,", "1,2,3", "nan,0", "inf,0"] {
            assert!(point(bad).is_err(), "{bad}");
        }
    }
}
