//! `pullback probe --nan`

use std::collections::BTreeMap;
use std::io::{self, Write};

use pullback_compiler::SceneModule;
use pullback_grammar::Diagnostic;
use pullback_runtime::trace::{self, GpuTracer, Inputs, Oddities, Recorders, Site, first_fault};
use pullback_runtime::{Gpu, Size};
use serde::Serialize;

use super::json::{Number, Told, put, told};
use super::place::limit;
use super::table::described;
use super::{Format, ProbeArguments, number};
use crate::cli::Console;
use crate::cli::failure::Failure;
use crate::cli::json::Places;
use crate::cli::progress::Progress;
use crate::cli::subject::Subject;

/// Version of the report: the number grows when a program that reads the older one would misread the newer.
const VERSION: u32 = 1;
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

/// Looks at every pixel, and traces some of those that are odd.
pub(super) fn run(
    arguments: &ProbeArguments,
    subject: &Subject,
    gpu: &Gpu,
    console: &Console,
) -> Result<(), Failure> {
    let precision = subject.precision(arguments.numbers, gpu, console)?;
    let scene = subject.scene(crate::cli::tier(gpu, precision)?, console)?;
    let bytes = scene.pack_settings(&subject.settings);
    let frame = subject.frame(&bytes);
    let mut progress = Progress::new(console);
    let found = trace::scan(gpu, &scene, &frame, &mut |done, total| {
        progress.update(done, total);
    })?;
    progress.finish();
    let (sites, kinds) = kinds(subject, gpu, &scene, &bytes, &found)?;
    match arguments.format {
        Format::Text => tell(subject, &sites, &kinds, found.size, console),
        Format::Json => write_json(subject, &sites, &kinds, found.size),
    }
    .map_err(Failure::stdout)
}

fn kinds(
    subject: &Subject,
    gpu: &Gpu,
    scene: &SceneModule,
    settings: &[u8],
    found: &Oddities,
) -> Result<(Vec<Site>, [Kind; 2]), Failure> {
    let traced = trace::traced_scene(
        subject.picture(),
        scene,
        &subject.source.text,
        Recorders::Writing,
        limit(Some(gpu)),
    )?;
    let mut tracer = None;
    let mut kinds = [
        ("NaN", found.nans().collect::<Vec<_>>()),
        ("infinite", found.infinities().collect()),
    ]
    .map(|(name, pixels)| Kind {
        name,
        pixels,
        traced: 0,
        culprits: BTreeMap::new(),
    });
    for kind in &mut kinds {
        let step = kind.pixels.len().div_ceil(TRACED).max(1);
        for &pixel in kind.pixels.iter().step_by(step) {
            let frame = pullback_runtime::Frame {
                samples: 1,
                ..subject.frame(settings)
            };
            let inputs = Inputs::pixel(&frame, scene.tier, pixel)?;
            let tracer = match &mut tracer {
                Some(tracer) => tracer,
                empty => empty.insert(GpuTracer::new(gpu, &traced, &inputs)?),
            };
            let trace = tracer.trace(&inputs)?;
            kind.traced += 1;
            let Some(fault) = first_fault(&traced.sites, &trace) else {
                continue;
            };
            let culprit = kind.culprits.entry(fault.site).or_insert_with(|| Culprit {
                count: 0,
                pixel,
                operands: fault.operands,
                result: fault.value.numbers().to_vec(),
            });
            culprit.count += 1;
        }
    }
    drop(tracer);
    Ok((traced.sites, kinds))
}

impl Kind {
    /// The operations, those that are the first at most pixels in front.
    fn ranked(&self) -> Vec<(usize, &Culprit)> {
        let mut all: Vec<_> = self.culprits.iter().map(|(&site, c)| (site, c)).collect();
        all.sort_by_key(|(_, culprit)| std::cmp::Reverse(culprit.count));
        all
    }
}

fn tell(
    subject: &Subject,
    sites: &[Site],
    kinds: &[Kind],
    size: Size,
    console: &Console,
) -> io::Result<()> {
    let mut out = io::BufWriter::new(io::stdout().lock());
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
            told_culprit(&mut out, subject, &sites[site], kind, culprit, console)?;
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
    out.flush()
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

fn write_json(subject: &Subject, sites: &[Site], kinds: &[Kind; 2], size: Size) -> io::Result<()> {
    let places = Places::new(&subject.source.text);
    let numbers = |all: &[f64]| all.iter().map(|&x| x.into()).collect();
    let [nan, infinite] = kinds.each_ref().map(|kind| JsonKind {
        pixels: kind.pixels.len(),
        first: kind.pixels.first().copied(),
        traced: kind.traced,
        operations: kind
            .ranked()
            .into_iter()
            .map(|(site, culprit)| JsonCulprit {
                site: told(&sites[site], &places),
                pixels: culprit.count,
                pixel: culprit.pixel,
                operands: numbers(&culprit.operands),
                result: numbers(&culprit.result),
            })
            .collect(),
    });
    put(&Report {
        version: VERSION,
        file: &subject.source.name,
        scene: subject.picture().scene.name,
        width: size.width,
        height: size.height,
        nan,
        infinite,
    })
}
