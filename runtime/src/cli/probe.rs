//! `pullback probe`

mod findings;
mod json;
mod nan;
mod number;
mod table;

use clap::{ArgGroup, Args, ValueEnum};
use pullback_compiler::What;
use pullback_compiler::scene::Space;
use pullback_runtime::evaluate::Surroundings;
use pullback_runtime::render::MAX_SAMPLES;
use pullback_runtime::trace::{self, GpuTracer, Inputs, Recorders, Trace, Traced};
use pullback_runtime::{Gpu, Size};

use super::failure::Failure;
use super::render::{point, positive, size};
use super::subject::{Subject, Wanted};
use super::{Console, Device, Input, Numbers, Rules, Settings, Which};
use findings::Findings;

/// Arguments of `pullback probe`.
#[derive(Debug, Args)]
#[command(group = ArgGroup::new("place").required(true))]
pub(super) struct ProbeArguments {
    #[command(flatten)]
    input: Input,
    /// The pixel, column and row from the top left, from 0
    #[arg(long, group = "place", value_name = "X,Y", value_parser = pixel)]
    pixel: Option<[u32; 2]>,
    /// World coordinates instead of a pixel: of the scene only the formula is computed, with its derivatives
    #[arg(long, group = "place", value_name = "X,Y[,Z]", value_parser = coordinates,
          allow_hyphen_values = true)]
    at: Option<Coordinates>,
    /// Look for pixels at which the formula is NaN or infinite, and say which operation made it so
    #[arg(long, group = "place")]
    nan: bool,
    /// Width and height of the picture in pixels
    #[arg(long, default_value = "1200x900", value_name = "WxH", value_parser = size)]
    size: Size,
    /// Supersamples per axis of a pixel
    #[arg(long, default_value_t = 1, value_name = "N",
          value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_SAMPLES)))]
    samples: u32,
    /// World coordinates of the centre
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true)]
    center: Option<[f64; 2]>,
    /// Height of the view in world units
    #[arg(long, value_name = "H", value_parser = positive, allow_hyphen_values = true)]
    height: Option<f64>,
    #[command(flatten)]
    settings: Settings,
    #[command(flatten)]
    which: Which,
    #[command(flatten)]
    device: Device,
    #[command(flatten)]
    numbers: Numbers,
    #[command(flatten)]
    rules: Rules,
    /// Units in the last place by which values may differ before machines count as parted
    #[arg(long, default_value_t = 16.0, value_name = "N", value_parser = positive)]
    ulps: f64,
    /// Show every operation of the formula, not only what has a name
    #[arg(long)]
    all: bool,
    /// How many values are shown of what is computed again and again: so many first ones, and so many last ones
    #[arg(long, default_value_t = 1, value_name = "N")]
    steps: usize,
    /// How it is told
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// For people
    Text,
    /// For programs: one object
    Json,
}

/// What one machine computed.
struct Column {
    /// `gpu`, `ieee32` or `reference`.
    name: &'static str,
    trace: Trace,
}

/// Traces a pixel or a point, or looks for odd pixels.
pub(super) fn run(arguments: &ProbeArguments, console: &Console) -> Result<(), Failure> {
    let wanted = Wanted {
        input: &arguments.input,
        which: arguments.which,
        rules: arguments.rules,
        settings: &arguments.settings,
        center: arguments.center,
        height: arguments.height,
        size: arguments.size,
        samples: arguments.samples,
    };
    let subject = Subject::open(&wanted, console)?;
    let gpu = super::open(&arguments.device, console)?;
    if arguments.nan {
        return nan::run(arguments, &subject, &gpu, console);
    }
    let precision = subject.precision(arguments.numbers, &gpu, console)?;
    let tier = super::tier(&gpu, precision)?;
    let (traced, inputs, place) = match (&arguments.at, arguments.pixel) {
        (Some(at), _) => {
            let (traced, inputs) = at_point(&subject, &at.0, tier, console)?;
            (traced, inputs, at.to_string())
        }
        (None, pixel) => {
            let [x, y] = pixel.unwrap_or_default();
            let (traced, inputs) = at_pixel(&subject, [x, y], tier, console)?;
            (traced, inputs, format!("pixel {x},{y}"))
        }
    };
    let columns = columns(&gpu, &traced, &inputs)?;
    let findings = Findings {
        subject: &subject,
        sites: &traced.sites,
        columns: &columns,
        place,
        precision,
        adapter: gpu.adapter().to_string(),
        arguments,
    };
    match arguments.format {
        Format::Text => table::tell(&findings, console),
        Format::Json => json::write(&findings),
    }
    .map_err(Failure::stdout)
}

/// The same invocation on every machine.
fn columns(gpu: &Gpu, traced: &Traced, inputs: &Inputs) -> Result<Vec<Column>, Failure> {
    Ok(vec![Column {
        name: "gpu",
        trace: GpuTracer::new(gpu, traced, inputs)?.trace(inputs)?,
    }])
}

fn at_pixel(
    subject: &Subject,
    pixel: [u32; 2],
    tier: pullback_compiler::lower::Tier,
    console: &Console,
) -> Result<(Traced, Inputs), Failure> {
    let scene = subject.scene(tier, console)?;
    let bytes = scene.pack_settings(&subject.settings);
    let inputs = Inputs::pixel(&subject.frame(&bytes), tier, pixel)?;
    let text = &subject.source.text;
    Ok((trace::traced_scene(subject.picture(), &scene, text, Recorders::Writing)?, inputs))
}

fn at_point(
    subject: &Subject,
    point: &[f64],
    tier: pullback_compiler::lower::Tier,
    console: &Console,
) -> Result<(Traced, Inputs), Failure> {
    let what = match subject.picture().scene.space {
        Space::Complex => What::Derivative,
        Space::Plane | Space::Space => What::Gradient,
    };
    let source = &subject.source;
    let module = source.program.eval_module(subject.index, what, tier);
    let module = source.expect(module, console)?;
    if point.len() != module.inputs.len() {
        let columns = module.inputs.join(",");
        return Err(Failure::usage_hint(
            format!("--at has {} numbers, and this formula takes {columns}", point.len()),
            format!("give --at {columns}"),
        ));
    }
    let frame = subject.frame(&[]);
    let around = Surroundings {
        params: frame.params,
        time: frame.time,
        pixel: frame.pixel(),
    };
    let inputs = Inputs::row(&module, around, point)?;
    Ok((trace::traced_evaluation(&module, &source.text, Recorders::Writing)?, inputs))
}

/// A point of the plane or of space.
#[derive(Clone, Debug, PartialEq)]
struct Coordinates(Vec<f64>);

impl std::fmt::Display for Coordinates {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let all: Vec<String> = self.0.iter().map(f64::to_string).collect();
        write!(f, "point {}", all.join(","))
    }
}

/// `x,y` or `x,y,z`
fn coordinates(text: &str) -> Result<Coordinates, String> {
    let all: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    all.ok()
        .filter(|all| (1..=4).contains(&all.len()) && all.iter().all(|c| c.is_finite()))
        .map(Coordinates)
        .ok_or_else(|| "write X,Y or X,Y,Z, such as -0.5,0".into())
}

/// `x,y`
fn pixel(text: &str) -> Result<[u32; 2], String> {
    text.split_once(',')
        .and_then(|(x, y)| Some([x.trim().parse().ok()?, y.trim().parse().ok()?]))
        .ok_or_else(|| "write X,Y in whole numbers from 0, such as 600,450".into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places() {
        assert_eq!(pixel("3, 4"), Ok([3, 4]));
        for bad in ["", "3", "3,", "-1,2", "1.5,2", "1,2,3"] {
            assert!(pixel(bad).is_err(), "{bad}");
        }
        assert_eq!(coordinates("1,-2e-3, 4"), Ok(Coordinates(vec![1.0, -2e-3, 4.0])));
        for bad in ["", "x", "1,nan", "1,,2", "1,2,3,4,5"] {
            assert!(coordinates(bad).is_err(), "{bad}");
        }
    }
}
