//! `pullback functions`

use std::io::{self, BufWriter, Write};

use clap::Args;
use pullback_compiler::table::{Bounds, Typing};
use pullback_compiler::{check, table};

use super::failure::Failure;

mod bounds;
mod declared;
mod json;

/// Arguments of `pullback functions`.
#[derive(Debug, Args)]
pub(super) struct FunctionsArguments {
    /// Write a Markdown table
    #[arg(long, conflicts_with_all = ["bounds", "json"])]
    markdown: bool,
    /// List how large the errors of each function may be, in each tier
    #[arg(long, conflicts_with = "json")]
    bounds: bool,
    /// Write JSON, with the bounds
    #[arg(long)]
    json: bool,
}

/// Lists every function and operator.
pub(super) fn run(arguments: &FunctionsArguments) -> Result<(), Failure> {
    let mut output = BufWriter::new(io::stdout().lock());
    let entries = entries();
    let written = if arguments.json {
        json::write(&mut output, &entries)
    } else if arguments.bounds {
        bounds::write(&mut output, &entries)
    } else if arguments.markdown {
        markdown(&mut output, entries)
    } else {
        list(&mut output, entries)
    };
    written
        .and_then(|()| output.flush())
        .map_err(Failure::stdout)
}

/// A function or operator as people look it up.
struct Entry {
    usage: String,
    types: &'static str,
    also: Vec<&'static str>,
    doc: String,
    /// What is declared about its errors; of an operation that makes a family about some members.
    bounds: Vec<&'static Bounds>,
}

/// The operator table, what the compiler builds from it, the calculus, and what is written in the language itself.
fn entries() -> Vec<Entry> {
    let also = |names: &'static [&'static str]| names.iter().skip(1).copied().collect();
    let table = table::rows().iter().filter(|row| row.is_written());
    let table = table.map(|row| Entry {
        usage: row.usage.to_owned(),
        types: types(row),
        also: also(row.names),
        doc: row.doc.to_owned(),
        bounds: row.bounds().collect(),
    });
    let built = check::builtins().iter().map(|builtin| Entry {
        usage: builtin.usage.to_owned(),
        types: "vectors",
        also: also(builtin.names),
        doc: builtin.doc.to_owned(),
        bounds: Vec::new(),
    });
    let library = check::library_functions().map(|function| Entry {
        usage: function.usage.clone(),
        types: if function.is_generic() {
            "numbers, vectors by components"
        } else {
            "as written"
        },
        also: Vec::new(),
        doc: function.doc.to_owned(),
        bounds: Vec::new(),
    });
    let calculus = check::operators().iter().map(|operator| Entry {
        usage: operator.usage.to_owned(),
        types: operator.takes,
        also: Vec::new(),
        doc: operator.doc.to_owned(),
        bounds: Vec::new(),
    });
    table.chain(built).chain(calculus).chain(library).collect()
}

/// What an operation takes, in words.
fn types(row: &table::Row) -> &'static str {
    match row.typing {
        Typing::Arithmetic(_) | Typing::Analytic(_) => "real, complex",
        Typing::Complex(_) => "real, complex → complex",
        Typing::Real(_) => "real",
        Typing::Part => "real, complex → real",
        Typing::MakeComplex => "real → complex",
        Typing::Order => "real → bool",
        Typing::Equality => "real, complex → bool",
        Typing::Logic(_) => "bool",
        Typing::Select => "bool, then any",
    }
}

fn markdown(output: &mut dyn Write, entries: Vec<Entry>) -> io::Result<()> {
    writeln!(
        output,
        "| written | also | takes | meaning |\n| --- | --- | --- | --- |"
    )?;
    for Entry {
        usage,
        types,
        also,
        doc,
        ..
    } in entries
    {
        let also: Vec<_> = also.iter().map(|name| format!("`{name}`")).collect();
        writeln!(
            output,
            "| `{}` | {} | {types} | {} |",
            usage.replace('|', "\\|"),
            also.join(", "),
            doc.replace('|', "\\|")
        )?;
    }
    declared::write(output)
}

fn list(output: &mut dyn Write, entries: Vec<Entry>) -> io::Result<()> {
    let lengths = entries.iter().map(|entry| entry.usage.chars().count());
    let width = lengths.max().unwrap_or(0);
    for Entry {
        usage, also, doc, ..
    } in entries
    {
        write!(output, "{usage:width$}  {doc}")?;
        if !also.is_empty() {
            write!(output, " (also {})", also.join(", "))?;
        }
        writeln!(output)?;
    }
    Ok(())
}
