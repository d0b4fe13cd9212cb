//! `pullback bench --tables`: the tables of the documentation for one adapter, each in a file of its own, with its chart.

use std::cell::RefCell;
use std::path::Path;
use std::time::{Duration, Instant};

use clap::ValueEnum;
use pullback_runtime::bench::gradients::formulas::GRADIENTS;
use pullback_runtime::bench::growth::TERMS;
use pullback_runtime::bench::marches::densities::DENSITIES;
use pullback_runtime::bench::twins::TWINS;
use pullback_runtime::executor::Arithmetic;
use pullback_runtime::{Gpu, atomic_file};

use super::large::{self, Large};
use super::parts::Part;
use super::programs::markdown;
use super::{BenchArguments, compared, peers, report, tiers, timed};
use crate::cli::failure::Failure;
use crate::cli::gallery::{self, compare};
use crate::cli::measure::{self, summary};
use crate::cli::place::Computer;
use crate::cli::render::name;
use crate::cli::subject::Subject;
use crate::cli::{Console, Numbers, Tier};

/// Turns of all programs at least, in a table.
const FEWEST: usize = 3;
/// Seconds that a line has at least, when the time is over.
const SHORTEST: f64 = 0.1;

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

/// Writes all tables that are wanted, within the budget as far as single pictures allow. What is there by then is kept. A line with
/// which the adapter is lost, as by a shader that its driver takes too long for, is passed over, and the adapter opened again.
pub(super) fn run(
    arguments: &BenchArguments,
    folder: &Path,
    console: &Console,
) -> Result<(), Failure> {
    std::fs::create_dir_all(folder).map_err(|error| Failure::Io {
        what: name(folder),
        error,
    })?;
    let mut gpu = super::super::open(&arguments.device.adapter, console)?;
    let wanted: Vec<Part> = match arguments.only.as_slice() {
        [] => Part::value_variants().to_vec(),
        some => some.to_vec(),
    };
    let limit = Duration::try_from_secs_f64(arguments.budget).unwrap_or(Duration::MAX / 4);
    let end = Instant::now() + limit;
    let mut missing = 0;
    for (k, &part) in wanted.iter().enumerate() {
        let weights: f64 = wanted[k..].iter().map(|part| part.weight()).sum();
        let left = end.saturating_duration_since(Instant::now());
        let until = Instant::now() + left.mul_f64(part.weight() / weights);
        let mut passed = Vec::new();
        missing += loop {
            let clerk = Clerk {
                arguments,
                folder,
                gpu: &gpu,
                until,
                passed: &passed,
                lost: RefCell::new(None),
                console,
            };
            let result = clerk.write(part);
            match (result, clerk.lost.into_inner()) {
                (Err(failure), Some(label)) => {
                    failure.report(console);
                    console.warning(&format!("{label} is left out; the adapter is opened again"));
                    passed.push(label);
                    gpu = super::super::open(&arguments.device.adapter, console)?;
                }
                (result, _) => break result? + passed.len(),
            }
        };
        report::write(folder)?;
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
    /// Lines with which the adapter was lost.
    passed: &'a [String],
    /// The line with which it is lost now.
    lost: RefCell<Option<String>>,
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
            Part::Derivatives => {
                let text = compared::derivatives(&self.subjects(part)?)?;
                self.put(&path, &text)?;
                (text, 0)
            }
            Part::Peers => {
                let text = peers::table(self.arguments, Some(self.gpu), self.console)?;
                self.put(&path, &text)?;
                (text, 0)
            }
            Part::Growth => self.lines(
                &path,
                compared::growth_head(),
                TERMS.map(|terms| ((5 * terms).to_string(), terms)),
                |&terms, _| compared::growth_line(terms),
            )?,
            Part::Gradients => self.lines(
                &path,
                compared::gradients_head(&adapter),
                GRADIENTS.map(|gradient| (gradient.name.to_owned(), gradient)),
                |gradient, _| compared::gradients_line(gradient, self.gpu),
            )?,
            Part::Twins => self.lines(
                &path,
                compared::twins_head(&adapter, size),
                TWINS.map(|twin| (twin.scene.to_owned(), twin)),
                |twin, seconds| compared::twins_line(twin, self.gpu, size, seconds, self.console),
            )?,
            Part::Marches => self.lines(
                &path,
                compared::marches_head(&adapter, self.gpu),
                DENSITIES.map(|density| (density.name.to_owned(), density)),
                |density, _| compared::marches_line(density, self.gpu),
            )?,
            Part::Large => self.lines(
                &path,
                large::head(&adapter),
                Large::all().map(|large| (large.label(), large)),
                |large, _| large.line(self.gpu, self.console),
            )?,
            Part::Tiers => self.lines(
                &path,
                tiers::head(&adapter, size),
                self.labelled(part)?,
                |subject, seconds| tiers::line(subject, self.gpu, seconds, self.console),
            )?,
            Part::Choices => self.lines(
                &path,
                summary::head(&adapter, size),
                self.labelled(part)?,
                |subject, seconds| {
                    let source = &subject.source;
                    measure::line(
                        &source.stem,
                        &source.text,
                        size,
                        seconds,
                        self.gpu,
                        self.console,
                    )
                },
            )?,
            Part::Accurate => self.differences(part, Tier::Accurate)?,
            Part::Double => self.differences(part, Tier::Double)?,
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
    fn subjects(&self, part: Part) -> Result<Vec<Subject>, Failure> {
        let BenchArguments { inputs, size, .. } = self.arguments;
        let mut subjects = gallery::subjects(inputs, *size, self.console)?;
        if inputs.is_empty() && part == Part::Choices {
            subjects.retain(|subject| ONE_OF_EACH.contains(&subject.source.stem.as_str()));
        }
        Ok(subjects)
    }

    /// The same, with what their lines begin with.
    fn labelled(&self, part: Part) -> Result<Vec<(String, Subject)>, Failure> {
        let subjects = self.subjects(part)?.into_iter();
        Ok(subjects.map(|s| (s.source.stem.clone(), s)).collect())
    }

    /// A table with a line for each item, which goes on where its file ends; with how many are missing at last.
    fn lines<T>(
        &self,
        path: &Path,
        head: String,
        items: impl IntoIterator<Item = (String, T)>,
        line: impl Fn(&T, f64) -> Result<String, Failure>,
    ) -> Result<(String, usize), Failure> {
        let mut table = summary::Table::open(head, Some(path))?;
        let mut items: Vec<(String, T)> = items.into_iter().collect();
        items.retain(|(label, _)| !table.has(label) && !self.passed.contains(label));
        let total = items.len();
        for (k, (label, item)) in items.iter().enumerate() {
            let now = Instant::now();
            // one at least, so that it ends some day
            if k > 0 && now > self.until {
                return Ok((table.text().to_owned(), total - k));
            }
            let left = self.until.saturating_duration_since(now).as_secs_f64();
            match line(item, (left / (total - k) as f64).max(SHORTEST)) {
                Ok(line) => table.add(&line)?,
                // what is found so far is in the file
                Err(failure) if self.gpu.is_lost() => {
                    self.lost.replace(Some(label.clone()));
                    return Err(failure);
                }
                Err(failure) => {
                    failure.report(self.console);
                    self.console.warning(&format!("{label} is left out"));
                }
            }
        }
        Ok((table.text().to_owned(), 0))
    }

    /// How far pictures are from the same module in f64.
    fn differences(&self, part: Part, tier: Tier) -> Result<(String, usize), Failure> {
        let with = |tier| Numbers {
            precision: Some(tier),
        };
        let here = (Computer::Adapter(self.gpu.clone()), with(tier));
        let there = (Computer::Processor(Arithmetic::Reference), with(tier));
        let names = [compare::told(&here), compare::told(&there)];
        let head = compare::head(&names, self.arguments.size);
        let path = self.folder.join(part.file());
        self.lines(&path, head, self.labelled(part)?, |subject, _| {
            Ok(compare::Row::new(subject, [&here, &there], self.console)?.line())
        })
    }

    /// All programs in turns: a table that is there is not made anew.
    fn programs(&self, path: &Path) -> Result<(String, usize), Failure> {
        if let Ok(text) = std::fs::read_to_string(path) {
            return Ok((text, 0));
        }
        let subjects = self.subjects(Part::Programs)?;
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
