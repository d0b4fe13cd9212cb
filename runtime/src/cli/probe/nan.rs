//! `pullback probe --nan`

use std::collections::BTreeMap;
use std::io::{self, Write};

use pullback_compiler::SceneModule;
use pullback_compiler::lower::{Precision, Tier};
use pullback_grammar::Diagnostic;
use pullback_runtime::executor::Arithmetic;
use pullback_runtime::trace::{
    self, Fault, GpuTracer, Inputs, Oddities, Recorders, Site, first_fault,
};
use pullback_runtime::{Frame, Gpu, Size};
use serde::Serialize;

use super::json::{Number, Told, put, told};
use super::place::limit;
use super::table::described;
use super::{Format, Machine, ProbeArguments, number};
use crate::cli::Console;
use crate::cli::failure::Failure;
use crate::cli::json::Places;
use crate::cli::place::Computer;
use crate::cli::progress::Progress;
use crate::cli::subject::Subject;

/// Version of the report: the number grows when a program that reads the older one would misread the newer.
const VERSION: u32 = 2;
/// Odd pixels of each kind that are traced for the operation, evenly over all that were found.
const TRACED: usize = 64;

/// An operation that makes something else than a number.
struct Culprit {
    /// Traced pixels at which it is the first.
    count: usize,
    /// The first of these, what the operation was given there, and what it gave.
    pixel: [u32; 2],
    operands: Vec<f64>,
    result: Vec<f64>,
}

/// Pixels of one kind.
struct Kind {
    name: &'static str,
    pixels: Vec<[u32; 2]>,
    traced: usize,
    /// By site.
    culprits: BTreeMap<usize, Culprit>,
}

/// What one machine found.
struct Found {
    machine: &'static str,
    precision: Precision,
    size: Size,
    sites: Vec<Site>,
    kinds: [Kind; 2],
}

/// Who looks.
#[derive(Clone, Copy)]
enum Eye<'g> {
    Device(&'g Gpu),
    Processor(Arithmetic),
}

/// The machines that look: those that are asked for, else the adapter, else the processor in both ways.
fn eyes<'g>(arguments: &ProbeArguments, gpu: Option<&'g Gpu>) -> Vec<Eye<'g>> {
    let all = Machine::ALL.into_iter().filter(|machine| {
        let is_default = arguments.on.is_empty();
        arguments.computes(*machine) && !(is_default && gpu.is_some() && *machine != Machine::Gpu)
    });
    all.filter_map(|machine| match machine {
        Machine::Gpu => gpu.map(Eye::Device),
        Machine::Ieee32 => Some(Eye::Processor(Arithmetic::Ieee32)),
        Machine::Reference => Some(Eye::Processor(Arithmetic::Reference)),
    })
    .collect()
}

/// Looks at every pixel, and traces some of those that are odd.
pub(super) fn run(
    arguments: &ProbeArguments,
    subject: &Subject,
    gpu: Option<&Gpu>,
    console: &Console,
) -> Result<(), Failure> {
    let mut all = Vec::new();
    for eye in eyes(arguments, gpu) {
        let found = eye.looks(arguments, subject, console);
        all.push(found.map_err(|failure| subject.source.blamed(failure, console))?);
    }
    match arguments.format {
        Format::Text => tell(subject, &all, console),
        Format::Json => write_json(subject, &all),
    }
    .map_err(Failure::stdout)
}

impl Eye<'_> {
    fn name(self) -> &'static str {
        match self {
            Self::Device(_) => Machine::Gpu.name(),
            Self::Processor(arithmetic) => arithmetic.name(),
        }
    }

    fn tier(
        self,
        arguments: &ProbeArguments,
        subject: &Subject,
        console: &Console,
    ) -> Result<Tier, Failure> {
        let numbers = arguments.numbers;
        match self {
            Self::Device(gpu) => {
                crate::cli::tier(gpu, subject.precision(numbers, gpu.into(), console)?)
            }
            Self::Processor(arithmetic) => {
                subject.tier(numbers, &Computer::Processor(arithmetic), console)
            }
        }
    }

    fn looks(
        self,
        arguments: &ProbeArguments,
        subject: &Subject,
        console: &Console,
    ) -> Result<Found, Failure> {
        let tier = self.tier(arguments, subject, console)?;
        let scene = subject.scene(tier, console)?;
        let bytes = scene.pack_settings(&subject.settings);
        let frame = subject.frame(&bytes);
        let mut progress = Progress::new(console);
        let mut told = |done, total| progress.update(done, total);
        let found = match self {
            Self::Device(gpu) => trace::scan(gpu, &scene, &frame, &mut told)?,
            Self::Processor(arithmetic) => {
                trace::scan_on_cpu(arithmetic, &scene, &frame, &subject.settings, &mut told)?
            }
        };
        progress.finish();
        let (sites, kinds) = self.kinds(subject, &scene, &frame, &found)?;
        Ok(Found {
            machine: self.name(),
            precision: tier.precision,
            size: found.size,
            sites,
            kinds,
        })
    }

    /// Traces odd pixels of each kind.
    fn kinds(
        self,
        subject: &Subject,
        scene: &SceneModule,
        frame: &Frame,
        found: &Oddities,
    ) -> Result<(Vec<Site>, [Kind; 2]), Failure> {
        let (recorders, limit) = match self {
            Self::Device(gpu) => (Recorders::Writing, limit(Some(gpu))),
            Self::Processor(_) => (Recorders::Silent, None),
        };
        let (picture, text) = (subject.picture(), &subject.source.text);
        let traced = trace::traced_scene(picture, scene, text, recorders, limit)?;
        let mut kinds = [
            Kind::new("NaN", found.nans().collect()),
            Kind::new("infinite", found.infinities().collect()),
        ];
        let mut tracer = None;
        for kind in &mut kinds {
            let step = kind.pixels.len().div_ceil(TRACED).max(1);
            let some: Vec<[u32; 2]> = kind.pixels.iter().copied().step_by(step).collect();
            for pixel in some {
                let trace = match self {
                    Self::Processor(arithmetic) => {
                        let settings = &subject.settings;
                        trace::pixel_on_cpu(arithmetic, scene, &traced, frame, settings, pixel)?
                    }
                    Self::Device(gpu) => {
                        let inputs = Inputs::pixel(frame, scene.tier, pixel)?;
                        let tracer = match &mut tracer {
                            Some(tracer) => tracer,
                            empty => empty.insert(GpuTracer::new(gpu, &traced, &inputs)?),
                        };
                        tracer.trace(&inputs)?
                    }
                };
                kind.add(pixel, first_fault(&traced.sites, &trace));
            }
        }
        drop(tracer);
        Ok((traced.sites, kinds))
    }
}

impl Kind {
    fn new(name: &'static str, pixels: Vec<[u32; 2]>) -> Self {
        Self {
            name,
            pixels,
            traced: 0,
            culprits: BTreeMap::new(),
        }
    }

    /// Takes note of a traced pixel, and of the operation that is to blame there.
    fn add(&mut self, pixel: [u32; 2], fault: Option<Fault>) {
        self.traced += 1;
        let Some(fault) = fault else {
            return;
        };
        let culprit = self.culprits.entry(fault.site).or_insert_with(|| Culprit {
            count: 0,
            pixel,
            operands: fault.operands,
            result: fault.value.numbers().to_vec(),
        });
        culprit.count += 1;
    }

    /// The operations, those that are the first at most pixels in front.
    fn ranked(&self) -> Vec<(usize, &Culprit)> {
        let mut all: Vec<_> = self.culprits.iter().map(|(&site, c)| (site, c)).collect();
        all.sort_by_key(|(_, culprit)| std::cmp::Reverse(culprit.count));
        all
    }
}

fn tell(subject: &Subject, all: &[Found], console: &Console) -> io::Result<()> {
    let mut out = io::BufWriter::new(io::stdout().lock());
    for (k, found) in all.iter().enumerate() {
        if k > 0 {
            writeln!(out)?;
        }
        if all.len() > 1 {
            writeln!(out, "{}, {}", found.machine, found.precision.name())?;
        }
        tell_one(&mut out, subject, found, console)?;
    }
    out.flush()
}

fn tell_one(
    out: &mut impl Write,
    subject: &Subject,
    found: &Found,
    console: &Console,
) -> io::Result<()> {
    let Found {
        size, sites, kinds, ..
    } = found;
    let total = f64::from(size.width) * f64::from(size.height);
    for kind in kinds {
        let count = kind.pixels.len();
        write!(
            out,
            "{:<9} {count} of {}x{} pixels ({:.4} %)",
            kind.name,
            size.width,
            size.height,
            100.0 * count as f64 / total
        )?;
        if let Some([x, y]) = kind.pixels.first() {
            write!(out, ", the first at {x},{y}")?;
        }
        writeln!(out)?;
    }
    for kind in kinds {
        for (site, culprit) in kind.ranked() {
            writeln!(out)?;
            told_culprit(out, subject, &sites[site], kind, culprit, console)?;
        }
        let explained: usize = kind.culprits.values().map(|culprit| culprit.count).sum();
        if explained < kind.traced {
            let count = kind.traced - explained;
            writeln!(
                out,
                "\nat {count} of {} traced pixels that are {} no single operation is to blame",
                kind.traced, kind.name
            )?;
        }
    }
    Ok(())
}

fn told_culprit(
    out: &mut impl Write,
    subject: &Subject,
    site: &Site,
    kind: &Kind,
    culprit: &Culprit,
    console: &Console,
) -> io::Result<()> {
    let list = |numbers: &[f64]| {
        let all: Vec<String> = numbers.iter().map(|&x| number::real(x)).collect();
        all.join(", ")
    };
    let message = format!(
        "{} is the first to be no number at {} of {} traced pixels that are {}",
        described(site),
        culprit.count,
        kind.traced,
        kind.name
    );
    let [x, y] = culprit.pixel;
    let label = format!(
        "of {} it makes {} at pixel {x},{y}",
        list(&culprit.operands),
        list(&culprit.result)
    );
    let Some(span) = site.span else {
        return writeln!(out, "{message}\n  {label}");
    };
    let found = Diagnostic::warning("not-a-number", span, message).with_label(label);
    let source = &subject.source;
    let text = pullback_grammar::render(&[found], &source.name, &source.text, console.color);
    writeln!(out, "{}", text.trim_end_matches('\n'))
}

#[derive(Serialize)]
struct Report<'a> {
    version: u32,
    file: &'a str,
    scene: &'a str,
    width: u32,
    height: u32,
    machines: Vec<JsonMachine<'a>>,
}

#[derive(Serialize)]
struct JsonMachine<'a> {
    name: &'a str,
    precision: &'a str,
    nan: JsonKind<'a>,
    infinite: JsonKind<'a>,
}

#[derive(Serialize)]
struct JsonKind<'a> {
    pixels: usize,
    first: Option<[u32; 2]>,
    traced: usize,
    operations: Vec<JsonCulprit<'a>>,
}

#[derive(Serialize)]
struct JsonCulprit<'a> {
    #[serde(flatten)]
    site: Told<'a>,
    pixels: usize,
    pixel: [u32; 2],
    operands: Vec<Number>,
    result: Vec<Number>,
}

fn write_json(subject: &Subject, all: &[Found]) -> io::Result<()> {
    let places = Places::new(&subject.source.text);
    let size = subject.frame(&[]).size;
    put(&Report {
        version: VERSION,
        file: &subject.source.name,
        scene: subject.picture().scene.name,
        width: size.width,
        height: size.height,
        machines: all.iter().map(|found| machine(found, &places)).collect(),
    })
}

fn machine<'a>(found: &'a Found, places: &Places) -> JsonMachine<'a> {
    let numbers = |all: &[f64]| all.iter().map(|&x| x.into()).collect();
    let [nan, infinite] = found.kinds.each_ref().map(|kind| JsonKind {
        pixels: kind.pixels.len(),
        first: kind.pixels.first().copied(),
        traced: kind.traced,
        operations: kind
            .ranked()
            .into_iter()
            .map(|(site, culprit)| JsonCulprit {
                site: told(&found.sites[site], places),
                pixels: culprit.count,
                pixel: culprit.pixel,
                operands: numbers(&culprit.operands),
                result: numbers(&culprit.result),
            })
            .collect(),
    });
    JsonMachine {
        name: found.machine,
        precision: found.precision.name(),
        nan,
        infinite,
    }
}
