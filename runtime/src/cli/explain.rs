//! `pullback explain`

mod integral;
mod proof;

use std::io::{self, Write};

use clap::{Args, ValueEnum};
use pullback_compiler::stable::{self, Explanation, RULES, Rule, Step};
use pullback_compiler::{Picture, What};
use serde::Serialize;

use super::failure::Failure;
use super::source::Source;
use super::{Console, Input, Rules, Which};

/// Version of the report: the number grows when a program that reads the older one would misread the newer.
const VERSION: u32 = 1;

/// Arguments of `pullback explain`.
#[derive(Debug, Args)]
pub(super) struct ExplainArguments {
    #[command(flatten)]
    input: Input,
    /// What is computed
    #[arg(long, value_enum, default_value_t = Part::Value)]
    what: Part,
    #[command(flatten)]
    which: Which,
    #[command(flatten)]
    rules: Rules,
    /// How to tell it
    #[arg(long, value_enum, default_value_t = Format::Human)]
    format: Format,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Part {
    /// The value
    Value,
    /// The value, then the gradient
    Gradient,
    /// The value, then the complex derivative
    Derivative,
    /// The integral of a function of space along a ray
    Integral,
    /// Whether that integral is one: its derivatives by its ends are the function, and its parts add up
    Proof,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// For people
    Human,
    /// For programs: one object
    Json,
}

#[derive(Serialize)]
struct Report<'a> {
    version: u32,
    file: &'a str,
    name: &'a str,
    inputs: Vec<Typed<'a>>,
    result: &'a str,
    scene: &'a str,
    written: &'a str,
    compiled: &'a str,
    rewrites: Vec<Rewrite<'a>>,
    off: Vec<Rewrite<'a>>,
}

#[derive(Serialize)]
struct Typed<'a> {
    name: &'a str,
    #[serde(rename = "type")]
    ty: &'a str,
}

#[derive(Serialize)]
struct Rewrite<'a> {
    before: &'a str,
    after: &'a str,
    rules: Vec<Used>,
}

#[derive(Serialize)]
struct Used {
    name: &'static str,
    equation: &'static str,
    domain: &'static str,
}

/// Explains a formula.
pub(super) fn run(arguments: &ExplainArguments, console: &Console) -> Result<(), Failure> {
    let source = Source::open(&arguments.input, console)?.with_rewrites(arguments.rules);
    let index = source.picture(arguments.which, console)?;
    let picture = &source.program.pictures()[index];
    let params: Vec<String> = source
        .program
        .params()
        .iter()
        .map(|p| p.name.clone())
        .collect();
    let what = match arguments.what {
        Part::Value => What::Value,
        Part::Gradient => What::Gradient,
        Part::Derivative => What::Derivative,
        Part::Integral => {
            return integral::run(&source, picture, &params, arguments.format, console);
        }
        Part::Proof => return proof::run(&source, picture, arguments.format, console),
    };
    let made = stable::explain(&picture.formula, &params, what);
    let made = made.map_err(|error| vec![error.diagnostic(&picture.formula)]);
    let found = source.expect(made, console)?;
    let mut output = io::BufWriter::new(io::stdout().lock());
    match arguments.format {
        Format::Human => tell(&mut output, picture, &found),
        Format::Json => write_json(&mut output, &source.name, picture, &found),
    }
    .and_then(|()| output.flush())
    .map_err(Failure::stdout)
}

fn tell(out: &mut impl Write, picture: &Picture, found: &Explanation) -> io::Result<()> {
    let formula = &picture.formula;
    let inputs: Vec<String> = formula
        .inputs
        .iter()
        .map(|input| format!("{}: {}", input.name, input.ty.in_words()))
        .collect();
    let (name, result) = (&formula.name, formula.ty.in_words());
    writeln!(
        out,
        "{name}({}) gives {result}, shown by `{}`",
        inputs.join(", "),
        picture.scene.name
    )?;
    writeln!(out, "\nwritten\n{}", indented(&found.written))?;
    writeln!(out, "\ncompiled\n{}", indented(&found.compiled))?;
    if found.applied.is_empty() {
        writeln!(out, "\nno rewrites")?;
    } else {
        writeln!(out, "\nrewrites")?;
        steps(out, &found.applied)?;
    }
    if !found.off.is_empty() {
        writeln!(out, "\npossible, but off")?;
        steps(out, &found.off)?;
    }
    Ok(())
}

fn steps(out: &mut impl Write, steps: &[Step]) -> io::Result<()> {
    let mut told: Vec<Rule> = Vec::new();
    for step in steps {
        writeln!(
            out,
            "{}\n  becomes\n{}",
            indented(&step.before),
            indented(&step.after)
        )?;
        for &rule in &step.rules {
            let record = rule.record();
            if told.contains(&rule) {
                writeln!(out, "      by {}", record.name)?;
            } else {
                writeln!(out, "      by {}: {}", record.name, record.equation)?;
                writeln!(out, "        {}", record.domain)?;
                told.push(rule);
            }
        }
    }
    Ok(())
}

fn indented(text: &str) -> String {
    format!("    {}", text.replace('\n', "\n    "))
}

fn write_json(
    out: &mut impl Write,
    file: &str,
    picture: &Picture,
    found: &Explanation,
) -> io::Result<()> {
    let formula = &picture.formula;
    let report = Report {
        version: VERSION,
        file,
        name: &formula.name,
        inputs: formula
            .inputs
            .iter()
            .map(|input| Typed {
                name: &input.name,
                ty: input.ty.in_words(),
            })
            .collect(),
        result: formula.ty.in_words(),
        scene: picture.scene.name,
        written: &found.written,
        compiled: &found.compiled,
        rewrites: found.applied.iter().map(rewrite).collect(),
        off: found.off.iter().map(rewrite).collect(),
    };
    serde_json::to_writer_pretty(&mut *out, &report)?;
    writeln!(out)
}

fn rewrite(step: &Step) -> Rewrite<'_> {
    let used = |rule: &Rule| {
        let record = &RULES[*rule as usize];
        Used {
            name: record.name,
            equation: record.equation,
            domain: record.domain,
        }
    };
    Rewrite {
        before: &step.before,
        after: &step.after,
        rules: step.rules.iter().map(used).collect(),
    }
}
