//! `pullback probe`

mod findings;
mod json;
mod nan;
mod number;
mod place;
mod table;

use clap::{ArgGroup, Args, ValueEnum};
use pullback_runtime::auto::Trier;
use pullback_runtime::executor::Arithmetic;
use pullback_runtime::trace::Trace;
use pullback_runtime::{AdapterChoice, Error, Gpu, Size};

use super::failure::Failure;
use super::render::{point, positive, size};
use super::subject::{Subject, Wanted};
use super::{Adapter, Console, Input, Numbers, Rules, Settings, Which};
use findings::Findings;
use place::Place;

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
    /// Which machines compute: the graphics adapter, the processor in exact binary32, and in f64 [default: all; for --nan
    /// the adapter, or the processor where there is none]
    #[arg(long, value_enum, value_delimiter = ',', value_name = "NAME,…")]
    on: Vec<Machine>,
    #[command(flatten)]
    device: Adapter,
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

/// Who computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Machine {
    /// The graphics adapter
    Gpu,
    /// The processor, exactly as IEEE 754 has single precision
    Ieee32,
    /// The processor, in double precision
    Reference,
}

impl Machine {
    /// All of them, in the order in which each is compared with the next.
    const ALL: [Self; 3] = [Self::Gpu, Self::Ieee32, Self::Reference];

    fn name(self) -> &'static str {
        match self {
            Self::Gpu => "gpu",
            Self::Ieee32 => Arithmetic::Ieee32.name(),
            Self::Reference => Arithmetic::Reference.name(),
        }
    }
}

impl ProbeArguments {
    /// Whether a machine is asked for.
    fn computes(&self, machine: Machine) -> bool {
        self.on.is_empty() || self.on.contains(&machine)
    }
}

/// What one machine computed.
struct Column {
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
        samples: 1,
    };
    let subject = Subject::open(&wanted, console)?;
    let gpu = adapter(arguments, console)?;
    if arguments.nan {
        return nan::run(arguments, &subject, gpu.as_ref(), console);
    }
    let on = gpu.as_ref().map_or(Trier::Exact, Trier::Device);
    let precision = subject.precision(arguments.numbers, on, console)?;
    let tier = match &gpu {
        Some(gpu) => super::tier(gpu, precision)?,
        None => precision.into(),
    };
    let place = match &arguments.at {
        Some(at) => Place::Point(&at.0),
        None => Place::Pixel(arguments.pixel.unwrap_or_default()),
    };
    let (sites, columns) = place
        .columns(arguments, &subject, gpu.as_ref(), tier, console)
        .map_err(|failure| subject.source.blamed(failure, console))?;
    let findings = Findings {
        subject: &subject,
        sites: &sites,
        columns: &columns,
        place: place.to_string(),
        precision,
        adapter: gpu.map(|gpu| gpu.adapter().to_string()),
        arguments,
    };
    match arguments.format {
        Format::Text => table::tell(&findings, console),
        Format::Json => json::write(&findings),
    }
    .map_err(Failure::stdout)
}

/// The graphics adapter, if one is asked for and there is one; it is no mistake to have none.
fn adapter(arguments: &ProbeArguments, console: &Console) -> Result<Option<Gpu>, Failure> {
    if !arguments.computes(Machine::Gpu) {
        return Ok(None);
    }
    match Gpu::open(&arguments.device.adapter) {
        Ok(gpu) => Ok(Some(gpu)),
        Err(error @ Error::NoAdapter { .. })
            if arguments.device.adapter == AdapterChoice::Auto && arguments.on.len() != 1 =>
        {
            console.warning(&format!("{error}; only the processor computes"));
            Ok(None)
        }
        Err(error) => Err(error.into()),
    }
}

/// A point of the plane or of space.
#[derive(Clone, Debug, PartialEq)]
struct Coordinates(Vec<f64>);

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
        assert_eq!(
            coordinates("1,-2e-3, 4"),
            Ok(Coordinates(vec![1.0, -2e-3, 4.0]))
        );
        for bad in ["", "x", "1,nan", "1,,2", "1,2,3,4,5"] {
            assert!(coordinates(bad).is_err(), "{bad}");
        }
    }
}
