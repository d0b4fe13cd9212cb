//! `pullback bench --tables`: the tables of the documentation for one adapter, each in a file of its own, with its chart.

use std::path::Path;
use std::time::{Duration, Instant};

use clap::ValueEnum;
use pullback_runtime::bench::{STAGES, median};
use pullback_runtime::executor::Arithmetic;
use pullback_runtime::{Gpu, atomic_file};

use super::base::Run;
use super::dots::Chart;
use super::{BenchArguments, peers, tiers, timed};
use crate::cli::failure::Failure;
use crate::cli::gallery::{self, compare};
use crate::cli::measure::{self, summary};
use crate::cli::place::Computer;
use crate::cli::render::name;
use crate::cli::subject::Subject;
use crate::cli::{Console, Numbers, Tier};

/// Turns of all programs at least, in a table.
const FEWEST: usize = 3;

/// A picture of each scene.
const ONE_OF_EACH: [&str; 17] = [
    "chladni",
    "charges",
    "zone-plate",
    "folium",
    "blaschke",
    "confocal",
    "lambert",
    "doyle-mcmullen",
    "multipole",
    "cayley",
    "schwarz-family",
    "neovius",
    "orbital",
    "resonance",
    "cloud",
    "hologram",
    "ember",
];

/// A table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Part {
    /// What each program takes from text to picture (docs/performance.md)
    Programs,
    /// What each picture takes in each tier (docs/numerics.md)
    Tiers,
    /// What a picture's choices cost and give, one of each scene (docs/measure.md)
    Choices,
    /// How far pictures in `accurate` are from f64 (docs/gallery-differences.md)
    Accurate,
    /// How far pictures in `double` are from f64 (docs/gallery-differences.md)
    Double,
    /// Other programs at the same formulas (docs/performance.md)
    Peers,
}

impl Part {
    fn file(self) -> &'static str {
        match self {
            Self::Programs => "programs.md",
            Self::Tiers => "tiers.md",
            Self::Choices => "choices.md",
            Self::Accurate => "accurate.md",
            Self::Double => "double.md",
            Self::Peers => "peers.md",
        }
    }

    /// Its part of the time, by weight.
    fn weight(self) -> f64 {
        match self {
            Self::Programs | Self::Peers => 1.0,
            Self::Accurate | Self::Double => 2.0,
            Self::Tiers => 3.0,
            Self::Choices => 4.0,
        }
    }

    fn chart(self) -> Option<Chart<'static>> {
        match self {
            Self::Programs => Some(Chart {
                title: "From text to picture",
                axis: "milliseconds",
                columns: &[(6, "compiled"), (7, "picture")],
            }),
            Self::Tiers => Some(Chart {
                title: "Time of a picture relative to fast",
                axis: "ratio",
                columns: &[(2, "accurate"), (3, "extended"), (4, "double")],
            }),
            Self::Choices => Some(Chart {
                title: "Mean error of a picture",
                axis: "FLIP",
                columns: &[
                    (2, "default"),
                    (5, "not to be told from the truth"),
                    (8, "at most half the time"),
                ],
            }),
            Self::Accurate | Self::Double | Self::Peers => None,
        }
    }
}

/// Writes all tables that are wanted, within the budget as far as single pictures allow. What is there by then is kept.
pub(super) fn run(
    arguments: &BenchArguments,
    folder: &Path,
    console: &Console,
) -> Result<(), Failure> {
    std::fs::create_dir_all(folder).map_err(|error| Failure::Io {
        what: name(folder),
        error,
    })?;
    let gpu = super::super::open(&arguments.device.adapter, console)?;
    let wanted: Vec<Part> = match arguments.only.as_slice() {
        [] => Part::value_variants()
            .iter()
            .copied()
            .filter(|&part| part != Part::Peers)
            .collect(),
        some => some.to_vec(),
    };
    let limit = Duration::try_from_secs_f64(arguments.budget).unwrap_or(Duration::MAX / 4);
    let end = Instant::now() + limit;
    let mut missing = 0;
    for (k, &part) in wanted.iter().enumerate() {
        let weights: f64 = wanted[k..].iter().map(|part| part.weight()).sum();
        let left = end.saturating_duration_since(Instant::now());
        let until = Instant::now() + left.mul_f64(part.weight() / weights);
        let clerk = Clerk {
            arguments,
            folder,
            gpu: &gpu,
            until,
            console,
        };
        missing += clerk.write(part)?;
    }
    if missing > 0 {
        console.warning(&format!(
            "{missing} lines are missing: run it again, and it goes on where it ended"
        ));
    }
    Ok(())
}

/// Writes tables until a time.
struct Clerk<'a> {
    arguments: &'a BenchArguments,
    folder: &'a Path,
    gpu: &'a Gpu,
    until: Instant,
    console: &'a Console,
}

impl Clerk<'_> {
    /// Writes one table and its chart; how many lines are missing at last.
    fn write(&self, part: Part) -> Result<usize, Failure> {
        let path = self.folder.join(part.file());
        let adapter = self.gpu.adapter().to_string();
        let size = self.arguments.size;
        let (text, missing) = match part {
            Part::Programs => self.programs(&path)?,
            Part::Peers => {
                let text = peers::table(self.console)?;
                self.put(&path, &text)?;
                (text, 0)
            }
            Part::Tiers => self.lines(&path, tiers::head(&adapter, size), |subject, seconds| {
                tiers::line(subject, self.gpu, seconds, self.console)
            })?,
            Part::Choices => {
                self.lines(&path, summary::head(&adapter, size), |subject, seconds| {
                    let source = &subject.source;
                    measure::line(
                        &source.stem,
                        &source.text,
                        size,
                        seconds,
                        self.gpu,
                        self.console,
                    )
                })?
            }
            Part::Accurate => self.differences(&path, Tier::Accurate)?,
            Part::Double => self.differences(&path, Tier::Double)?,
        };
        if let Some(svg) = part.chart().and_then(|chart| chart.svg(&text)) {
            self.put(&path.with_extension("svg"), &svg)?;
        }
        Ok(missing)
    }

    fn put(&self, path: &Path, text: &str) -> Result<(), Failure> {
        atomic_file::write_text(path, text).map_err(|error| Failure::Io {
            what: name(path),
            error,
        })
    }

    /// The programs that are wanted; without any, those that this program carries.
    fn subjects(&self, part: &Path) -> Result<Vec<Subject>, Failure> {
        let BenchArguments { inputs, size, .. } = self.arguments;
        let mut subjects = gallery::subjects(inputs, *size, self.console)?;
        if inputs.is_empty() && part.ends_with(Part::Choices.file()) {
            subjects.retain(|subject| ONE_OF_EACH.contains(&subject.source.stem.as_str()));
        }
        Ok(subjects)
    }

    /// A table with a line for each program, which goes on where its file ends.
    fn lines(
        &self,
        path: &Path,
        head: String,
        line: impl Fn(&Subject, f64) -> Result<String, Failure>,
    ) -> Result<(String, usize), Failure> {
        let mut table = summary::Table::open(head, Some(path))?;
        let mut subjects = self.subjects(path)?;
        subjects.retain(|subject| !table.has(&subject.source.stem));
        let total = subjects.len();
        for (k, subject) in subjects.iter().enumerate() {
            let now = Instant::now();
            // one at least, so that it ends some day
            if k > 0 && now > self.until {
                return Ok((table.text().to_owned(), total - k));
            }
            let left = self.until.saturating_duration_since(now).as_secs_f64();
            match line(subject, left / (total - k) as f64) {
                Ok(line) => table.add(&line)?,
                // what is found so far is in the file
                Err(failure) if self.gpu.is_lost() => return Err(failure),
                Err(failure) => {
                    failure.report(self.console);
                    self.console
                        .warning(&format!("{} is left out", subject.source.name));
                }
            }
        }
        Ok((table.text().to_owned(), 0))
    }

    /// How far pictures are from the same module in f64.
    fn differences(&self, path: &Path, tier: Tier) -> Result<(String, usize), Failure> {
        let with = |tier| Numbers {
            precision: Some(tier),
        };
        let here = (Computer::Adapter(self.gpu.clone()), with(tier));
        let there = (Computer::Processor(Arithmetic::Reference), with(tier));
        let names = [compare::told(&here), compare::told(&there)];
        let head = compare::head(&names, self.arguments.size);
        self.lines(path, head, |subject, _| {
            Ok(compare::Row::new(subject, [&here, &there], self.console)?.line())
        })
    }

    /// All programs in turns: a table that is there is not made anew.
    fn programs(&self, path: &Path) -> Result<(String, usize), Failure> {
        if let Ok(text) = std::fs::read_to_string(path) {
            return Ok((text, 0));
        }
        let subjects = self.subjects(path)?;
        let budget = self.until.saturating_duration_since(Instant::now());
        let run = timed(
            subjects,
            Some(self.gpu),
            self.arguments.size,
            (budget, FEWEST),
            self.console,
        )?;
        let text = markdown(&run);
        self.put(path, &text)?;
        Ok((text, 0))
    }
}

/// The times of a run: milliseconds of every stage and picture.
fn markdown(run: &Run) -> String {
    let stages = STAGES.len();
    let mut text = format!(
        "{}; {}x{} pixels of one sample; milliseconds, medians of {} turns\n\n| program | {} | compiled | picture |\n\
         | --- |{}\n",
        run.adapter.as_deref().unwrap_or("the compiler alone"),
        run.width,
        run.height,
        run.calibration.len(),
        STAGES.join(" | "),
        " ---: |".repeat(stages + 2)
    );
    for program in &run.pictures {
        let times: Vec<f64> = program
            .times
            .iter()
            .map(|case| 1e3 * median(&case.seconds))
            .collect();
        let compiled: f64 = times.iter().take(stages).sum();
        text += &format!("| {} |", program.name);
        for time in &times[..stages.min(times.len())] {
            text += &format!(" {time:.3} |");
        }
        let picture = times
            .get(stages)
            .map_or_else(|| "-".to_owned(), |time| format!("{time:.4}"));
        text += &format!(" {compiled:.3} | {picture} |\n");
    }
    text
}
