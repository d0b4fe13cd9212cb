//! `pullback render`

use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use clap::{Args, ValueEnum};
use pullback_compiler::lower::Precision;
use pullback_compiler::scene::{SettingKind, Space};
use pullback_compiler::{Picture, SceneModule, SettingValue};
use pullback_runtime::animation::Container;
use pullback_runtime::auto::{self, Scenery, Trier};
use pullback_runtime::executor::Painter;
use pullback_runtime::image_file::{Alpha, Format};
use pullback_runtime::render::MAX_SAMPLES;
pub(super) use pullback_runtime::render::MAX_SIDE;
use pullback_runtime::{
    Error, Frame, Metadata, Pipeline, Renderer, RowSink, Size, View, fill_in_scale, image_file,
};

use super::animate::{Animation, Reel};
use super::failure::Failure;
use super::mesh;
use super::overrides::Assignment;
use super::place::Computer;
use super::progress::{Counted, Progress};
use super::source::Source;
use super::{Console, Device, Input, Numbers, Output, Rules, Settings, Which, overrides};

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
    /// Leave out what is behind the scene, so that the picture can lie on anything: `--set backdrop=transparent`
    #[arg(long)]
    transparent: bool,
    /// Bits of a number: 8 or 16 in a PNG, 16 or 32 in an .exr file, which holds linear light [default: 8, or 32]
    #[arg(long, value_name = "BITS")]
    depth: Option<u32>,
    /// World coordinates of the centre
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true)]
    center: Option<[f64; 2]>,
    /// Height of the view in world units
    #[arg(long, value_name = "H", value_parser = positive, allow_hyphen_values = true)]
    height: Option<f64>,
    #[command(flatten)]
    settings: Settings,
    #[command(flatten)]
    device: Device,
    /// The shader stage that computes the pixels
    #[arg(long, value_enum, default_value_t = Stage::Compute)]
    pipeline: Stage,
    #[command(flatten)]
    which: Which,
    #[command(flatten)]
    numbers: Numbers,
    #[command(flatten)]
    rules: Rules,
    #[command(flatten)]
    animation: Animation,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Stage {
    Compute,
    Fragment,
}

/// Draws the picture and writes it.
pub(super) fn run(arguments: &RenderArguments, console: &Console) -> Result<(), Failure> {
    let source = Source::open(&arguments.input, console)?.with_rewrites(arguments.rules);
    let index = source.picture(arguments.which, console)?;
    let picture = &source.program.pictures()[index];
    let (params, mut settings) =
        overrides::for_picture(&arguments.assignments(picture)?, &source.program, picture)?;
    let view = view(arguments.center, arguments.height, picture, &settings)?;
    fill_in_scale(
        &mut settings,
        picture,
        &view,
        arguments.size,
        &params,
        arguments.settings.time,
    );
    let path = arguments
        .output
        .output
        .clone()
        .unwrap_or_else(|| PathBuf::from(format!("{}.png", source.stem)));
    let shown = name(&path);
    let (frames, format) = kind(arguments, &path)?;
    let alpha = alpha(&settings, &path)?;
    let mut frame = Frame {
        view,
        params: &params,
        settings: &[],
        size: arguments.size,
        samples: arguments.samples,
        time: arguments.settings.time,
        pipeline: match arguments.pipeline {
            _ if format.is_linear() => Pipeline::Linear,
            Stage::Compute => Pipeline::Compute,
            Stage::Fragment => Pipeline::Fragment,
        },
    };
    let computer = Computer::open(&arguments.device.adapter, console)?;
    let wanted = match (computer.trier(), arguments.numbers.wanted(&settings)) {
        (Some(on), None) => {
            let scenery = Scenery {
                program: &source.program,
                picture: index,
                settings: &settings,
                frame: &frame,
            };
            Some(chosen(on, &scenery, &source, console)?)
        }
        (_, wanted) => wanted,
    };
    let tier = computer.tier(arguments.numbers.precision, wanted)?;
    let mut scene = source.expect(
        source.program.scene_module_with(index, &settings, tier),
        console,
    )?;
    mesh::furnish(&mut scene, &settings, arguments.settings.mesh.as_deref())?;
    let bytes = scene.pack_settings(&settings);
    frame.settings = &bytes;
    if let Some(warning) = unresolved(picture, &frame, tier.precision) {
        console.warning(&warning);
    }
    let metadata = metadata(
        &source,
        picture,
        &settings,
        &frame,
        tier.precision,
        &computer,
    );
    let mut progress = Progress::new(console);
    let fixed = arguments.animation.keeps_settings(picture);
    let fixed = fixed.then_some((settings.as_slice(), frame.samples));
    let mut artist = Artist::new(&computer, &scene, frame.pipeline, fixed)?;
    if let Some(frames) = frames {
        let reel = Reel {
            program: &source.program,
            scene: &scene,
            settings: &settings,
            still: frame,
        };
        let output = (path.as_path(), (format, alpha), &metadata);
        arguments
            .animation
            .write(&reel, frames, &mut artist, output, &mut progress)
            .map_err(|failure| source.blamed(failure, console))?;
        progress.finish();
        console.note(&drawn(&shown, arguments.size, Some(frames), &progress));
        return Ok(());
    }
    image_file::write(&path, (format, alpha), frame.size, &metadata, |sink| {
        let mut sink = Counted {
            sink,
            progress: &mut progress,
        };
        artist.render(&frame, &settings, &mut sink)
    })
    .map_err(Failure::writing(&shown))
    .map_err(|failure| source.blamed(failure, console))?;
    progress.finish();
    console.note(&drawn(&shown, frame.size, None, &progress));
    Ok(())
}

impl RenderArguments {
    /// What is set, `--transparent` among it.
    fn assignments(&self, picture: &Picture) -> Result<Vec<Assignment>, Failure> {
        let mut all = self.settings.set.clone();
        if self.transparent {
            if picture.scene.setting("backdrop").is_none() {
                return Err(Failure::usage_hint(
                    format!(
                        "scene `{}` fills the picture: nothing is behind it",
                        picture.scene.name
                    ),
                    "leave --transparent out",
                ));
            }
            all.push(Assignment::word("backdrop", TRANSPARENT));
        }
        Ok(all)
    }
}

/// The word for a backdrop that is not there.
const TRANSPARENT: &str = "transparent";

/// Whether something may shine through the picture, which its file must be able to hold.
fn alpha(settings: &[SettingValue], path: &Path) -> Result<Alpha, Failure> {
    let backdrop = settings.iter().find(|s| s.spec.name == "backdrop");
    if backdrop.and_then(SettingValue::word) != Some(TRANSPARENT) {
        return Ok(Alpha::LeftOut);
    }
    if Container::of(path) == Some(Container::Gif) {
        return Err(Failure::usage_hint(
            "a GIF is opaque or empty at a pixel, and edges that are half of both would be ragged",
            "write .apng, numbered .png or .exr files, or choose another backdrop",
        ));
    }
    Ok(Alpha::Kept)
}

/// How many frames are wanted, none for a still picture, and what the file or files hold.
fn kind(arguments: &RenderArguments, path: &Path) -> Result<(Option<u32>, Format), Failure> {
    let format = Format::of(path, arguments.depth)
        .map_err(|message| Failure::usage_hint(message, "leave --depth out, or change it"))?;
    if format.is_linear() && matches!(arguments.pipeline, Stage::Fragment) {
        return Err(Failure::usage_hint(
            "the fragment stage gives 8 bits of sRGB",
            "leave --pipeline out",
        ));
    }
    if format.is_linear() && Container::of(path).is_some() {
        return Err(Failure::usage_hint(
            format!("{} holds 8 bits of sRGB", name(path)),
            "leave --depth out, or write numbered .png files",
        ));
    }
    Ok((arguments.animation.frames(path)?, format))
}

/// What draws.
pub(super) enum Artist {
    Device(Box<Renderer>),
    Processor(Box<Painter>),
}

impl Artist {
    /// `fixed`: settings and samples of all pictures, if they stay the same.
    pub(super) fn new(
        computer: &Computer,
        scene: &SceneModule,
        pipeline: Pipeline,
        fixed: Option<(&[SettingValue], u32)>,
    ) -> Result<Self, Failure> {
        Ok(match computer {
            Computer::Adapter(gpu) => Self::Device(Box::new(match fixed {
                Some((settings, samples)) => Renderer::for_settings(gpu, scene, settings, samples)?,
                None => Renderer::new(gpu, scene)?,
            })),
            Computer::Processor(arithmetic) => {
                Self::Processor(Box::new(Painter::new(scene, *arithmetic, pipeline)?))
            }
        })
    }

    pub(super) fn render(
        &mut self,
        frame: &Frame,
        settings: &[SettingValue],
        sink: &mut dyn RowSink,
    ) -> Result<(), Error> {
        match self {
            Self::Device(renderer) => renderer.render(frame, sink),
            Self::Processor(painter) => {
                painter.render(frame, settings, &AtomicBool::new(false), sink)
            }
        }
    }
}

/// What has been written, and how long it took.
fn drawn(name: &str, size: Size, frames: Option<u32>, progress: &Progress) -> String {
    let Size { width, height } = size;
    let count = frames.map_or(String::new(), |frames| format!("{frames} pictures of "));
    let seconds = progress.elapsed().as_secs_f64();
    format!("{name}: {count}{width}x{height}, {seconds:.2} s")
}

/// What is seen: of a plane by the options, then by the settings; scenes of space have a camera in their settings.
pub(super) fn view(
    wanted_center: Option<[f64; 2]>,
    wanted_height: Option<f64>,
    picture: &Picture,
    settings: &[SettingValue],
) -> Result<View, Failure> {
    if picture.scene.space == Space::Space {
        if wanted_center.is_some() || wanted_height.is_some() {
            return Err(Failure::usage_hint(
                format!(
                    "scene `{}` has no plane to be looked at",
                    picture.scene.name
                ),
                "move its camera with --set; `pullback scenes` lists its settings",
            ));
        }
        return Ok(View {
            center: [0.0, 0.0],
            height: 2.0,
        });
    }
    let setting = |name| {
        settings
            .iter()
            .find(|s| s.spec.name == name)
            .map(|s| s.value)
    };
    let center = setting("center").unwrap_or_default();
    let height = setting("height").map_or(2.0, |value| value.x);
    Ok(View {
        center: wanted_center.unwrap_or([center.x, center.y]),
        height: wanted_height.unwrap_or(height),
    })
}

/// The tier that `auto` takes; says which and why.
pub(super) fn chosen(
    on: Trier,
    scenery: &Scenery,
    source: &Source,
    console: &Console,
) -> Result<Precision, Failure> {
    let verdict = match auto::choose(on, scenery) {
        Ok(verdict) => verdict,
        Err(auto::Failure::Device(error)) => return Err(error.into()),
        Err(auto::Failure::Program(problems)) => return source.expect(Err(problems), console),
    };
    console.note(&verdict.to_string());
    if !verdict.is_true() {
        console.warning("no precision gives a picture whose errors cannot be seen");
    }
    Ok(verdict.precision)
}

/// What to say where the tier gives neighbouring pixels the same point of the plane.
fn unresolved(picture: &Picture, frame: &Frame, precision: Precision) -> Option<String> {
    if picture.scene.space == Space::Space || frame.is_resolved(precision.format()) {
        return None;
    }
    let advice = Precision::ALL
        .into_iter()
        .find(|finer| frame.is_resolved(finer.format()))
        .map_or_else(
            || "no tier does; move or widen the view".to_owned(),
            |finer| format!("--precision {} does", finer.name()),
        );
    Some(format!(
        "`{}` does not tell the points of neighbouring pixels apart in this view; {advice}",
        precision.name()
    ))
}

/// How the picture came about, without names of files.
fn metadata(
    source: &Source,
    picture: &Picture,
    settings: &[SettingValue],
    frame: &Frame,
    precision: Precision,
    computer: &Computer,
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
    let settings: Vec<String> = settings
        .iter()
        .filter(|setting| !(setting.spec.is_view() && picture.scene.space != Space::Space))
        .map(|setting| format!("{} = {}", setting.spec.name, written(setting)))
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
        ("Precision", precision.name().to_owned()),
        ("Adapter", computer.to_string()),
    ])
}

/// A setting's value as one writes it.
pub(super) fn written(setting: &SettingValue) -> String {
    let [x, y, z] = setting.value.to_array();
    match setting.spec.kind {
        SettingKind::Real | SettingKind::Integer => x.to_string(),
        SettingKind::Vec2 => format!("({x}, {y})"),
        SettingKind::Vec3 => format!("({x}, {y}, {z})"),
        SettingKind::Choice(_) => setting.word().unwrap_or_default().to_owned(),
        SettingKind::Function => "as in the text".to_owned(),
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
pub(super) fn size(text: &str) -> Result<Size, String> {
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
pub(super) fn point(text: &str) -> Result<[f64; 2], String> {
    text.split_once(',')
        .and_then(|(x, y)| Some([x.trim().parse().ok()?, y.trim().parse().ok()?]))
        .filter(|point: &[f64; 2]| point.iter().all(|c| c.is_finite()))
        .ok_or_else(|| "write X,Y, such as -0.5,0".into())
}

pub(super) fn positive(text: &str) -> Result<f64, String> {
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
