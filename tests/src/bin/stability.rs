//! Errors of closed forms of ray integrals in binary32 on thousands of rays of every kind: tables in Markdown.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use pullback_compiler::lower::Precision;
use pullback_runtime::executor::Arithmetic;
use pullback_runtime::{AdapterChoice, Gpu};
use pullback_tests::accuracy::evaluators::Machine;
use pullback_tests::stability::classes::{CLASSES, Class};
use pullback_tests::stability::rays::{Distance, rays};
use pullback_tests::stability::{
    BOUND, Found, closed_form, formula, measure_changed, operations, tables,
};

const BEGIN: &str = "<!-- stability: `cargo run -p pullback-tests --bin stability -- --markdown docs/integrals-stability.md` -->\n";
const END: &str = "<!-- end of the stability -->\n";

/// Errors of closed forms of ray integrals, against adaptive quadrature in f64.
#[derive(Parser)]
struct Options {
    /// Rays of each class
    #[arg(long, default_value_t = 10_000)]
    count: usize,
    /// Only classes whose density or name contains this
    #[arg(long, default_value = "")]
    only: String,
    /// An adapter that computes, `auto`, `gpu`, `software`, or part of its name; without it binary32 on the processor
    #[arg(long)]
    adapter: Option<String>,
    /// A file whose text between the marks of the tables is replaced, beside what is printed
    #[arg(long)]
    markdown: Option<PathBuf>,
    /// How many of the worst rays of a class are printed
    #[arg(long, default_value_t = 3)]
    worst: usize,
    /// How many roundings of the numbers of a ray are allowed to those that are not printed
    #[arg(long, default_value_t = 8.0)]
    roundings: f64,
    /// For each of the worst rays, that many of the operations whose rounding changes the integral most
    #[arg(long, default_value_t = 0)]
    operations: usize,
    /// Take divisions, roots and functions to be off by that many units in the last place, up or down by turns
    #[arg(long, default_value_t = 0.0)]
    loose: f64,
    /// The error beyond which rays are printed with their operations
    #[arg(long, default_value_t = BOUND)]
    above: f64,
    /// Print that many rays of each class for tests/oracle/integrals_stability.py, and nothing else
    #[arg(long)]
    sample: Option<usize>,
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

fn run(options: &Options) -> Result<(), String> {
    if let Some(count) = options.sample {
        sample(count);
        return Ok(());
    }
    let machine = match &options.adapter {
        None => Machine::Processor(Arithmetic::Ieee32, Precision::Accurate),
        Some(name) => {
            let choice = name.parse::<AdapterChoice>().unwrap_or_default();
            let gpu = Gpu::open(&choice).map_err(|e| e.to_string())?;
            Machine::Gpu(Box::new(gpu), Precision::Accurate)
        }
    };
    let rays = rays(options.count, 1);
    let mut all = Vec::new();
    let is_wanted = |text: &str| text.contains(&options.only);
    for class in CLASSES
        .iter()
        .filter(|c| is_wanted(c.formula) || is_wanted(c.name))
    {
        let found = measure_changed(class, &rays, &machine, &|integral| {
            if options.loose == 0.0 {
                integral
            } else {
                operations::loosened(&integral, options.loose)
            }
        })?;
        eprint!(
            "{}",
            tables::unexplained(&found, options.roundings, options.worst)
        );
        if options.operations > 0 {
            operations(class, &found, options);
        }
        all.push(found);
    }
    let text = format!(
        "\n{machine}, {} rays of each class:\n\n{}\n{}\n{}\n",
        options.count,
        tables::by_class(&all),
        tables::by_slant(&all),
        tables::by_textbook(&all)
    );
    print!("{text}");
    options
        .markdown
        .as_ref()
        .map_or(Ok(()), |path| replace(path, &text))
}

/// Tells where the worst rays of a class lose their digits.
fn operations(class: &Class, found: &Found, options: &Options) {
    let integral = closed_form(&formula(class.formula));
    let mut bad: Vec<_> = found
        .at(Distance::Near)
        .filter(|o| o.error > options.above)
        .collect();
    bad.sort_by(|a, b| b.error.total_cmp(&a.error));
    for o in bad.into_iter().take(options.worst) {
        let told = operations::worst(&integral, &o.ray, o.size, options.operations);
        eprint!("    {:.1e} on {:?}:\n{told}", o.error, o.ray.numbers);
    }
}

fn replace(path: &Path, text: &str) -> Result<(), String> {
    let page = std::fs::read_to_string(path).map_err(|e| e.to_string())?;
    let mark = |mark: &str| {
        page.find(mark)
            .ok_or(format!("{} has no mark {mark}", path.display()))
    };
    let (begin, end) = (mark(BEGIN)? + BEGIN.len(), mark(END)?);
    let page = format!("{}{text}{}", &page[..begin], &page[end..]);
    std::fs::write(path, page).map_err(|e| e.to_string())
}

fn sample(count: usize) {
    for (k, class) in (100..).zip(&CLASSES) {
        println!("= {}", class.formula);
        for ray in rays(count, k) {
            let numbers = ray.numbers.map(|x| format!("{x:?}"));
            println!("{}", numbers.join(" "));
        }
    }
}
