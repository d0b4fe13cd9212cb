//! Rows of the price list: in a file, one by one, and as Markdown.

use std::fmt::Write as _;
use std::fs::{File, OpenOptions};
use std::io::{ErrorKind, Write as _};
use std::path::Path;

use crate::times::median;

/// What a scene costs.
#[derive(Clone)]
pub struct Row {
    pub name: String,
    /// The picture that was timed.
    pub size: [u32; 2],
    /// Seconds of a frame in `fast`, then the other tiers relative to it.
    pub times: Vec<Option<f64>>,
    /// Seconds in which the driver made each pipeline.
    pub built: Vec<Option<f64>>,
}

/// All rows; those of this run are appended to the file.
pub struct Table {
    rows: Vec<Row>,
    file: Option<File>,
}

impl Table {
    /// The rows of a file of the same adapter, which need not exist.
    pub fn open(path: Option<&Path>, adapter: &str) -> Result<Self, String> {
        let mut out = Self {
            rows: Vec::new(),
            file: None,
        };
        let Some(path) = path else { return Ok(out) };
        let wrong = |e: std::io::Error| format!("{}: {e}", path.display());
        let text = match std::fs::read_to_string(path) {
            Ok(text) => text,
            Err(e) if e.kind() == ErrorKind::NotFound => String::new(),
            Err(e) => return Err(wrong(e)),
        };
        let head = format!("# {adapter}");
        if text.lines().next().is_some_and(|first| first != head) {
            return Err(format!("{} is of another adapter", path.display()));
        }
        let mut file = OpenOptions::new()
            .create(true)
            .append(true)
            .open(path)
            .map_err(wrong)?;
        if text.is_empty() {
            let columns = "# scene\tsize\tfast, s\taccurate / fast\textended / fast\tdouble / fast\tpipelines, s";
            writeln!(file, "{head}\n{columns}").map_err(wrong)?;
        }
        out.rows = text.lines().filter_map(Row::parse).collect();
        out.file = Some(file);
        Ok(out)
    }

    pub fn has(&self, name: &str) -> bool {
        self.rows.iter().any(|row| row.name == name)
    }

    pub fn add(&mut self, row: Row) -> Result<(), String> {
        if let Some(file) = &mut self.file {
            writeln!(file, "{}", row.tabs()).map_err(|e| e.to_string())?;
        }
        self.rows.push(row);
        Ok(())
    }

    /// The rows whose name contains a text, in order, with medians.
    pub fn markdown(mut self, only: &str) -> String {
        self.rows.retain(|row| row.name.contains(only));
        self.rows.sort_by(|a, b| a.name.cmp(&b.name));
        let mut out = String::from(
            "| scene | picture | fast, ms | accurate / fast | extended / fast | double / fast | pipelines, s |\n\
             | --- | --- | --- | --- | --- | --- | --- |\n",
        );
        for row in &self.rows {
            let fast = cell(row.times[0].map(|t| t * 1e3));
            let ratios = joined(&row.times[1..], " | ");
            let [w, h] = row.size;
            let built = joined(&row.built, ", ");
            let _ = writeln!(
                out,
                "| {} | {w}x{h} | {fast} | {ratios} | {built} |",
                row.name
            );
        }
        let medians: Vec<Option<f64>> = (1..4)
            .map(|k| {
                let list: Vec<f64> = self.rows.iter().filter_map(|r| r.times[k]).collect();
                (!list.is_empty()).then(|| median(list))
            })
            .collect();
        let _ = writeln!(
            out,
            "| **median of {}** | | | {} | |",
            self.rows.len(),
            joined(&medians, " | ")
        );
        out
    }
}

impl Row {
    /// The row with tabs.
    pub fn tabs(&self) -> String {
        let [w, h] = self.size;
        let number = |x: &Option<f64>| x.map_or("-".to_owned(), |x| x.to_string());
        let times: Vec<String> = self.times.iter().map(number).collect();
        let built = joined(&self.built, ", ");
        format!("{}\t{w}x{h}\t{}\t{built}", self.name, times.join("\t"))
    }

    fn parse(line: &str) -> Option<Self> {
        if line.starts_with('#') {
            return None;
        }
        let words: Vec<&str> = line.split('\t').collect();
        let &[name, size, ref times @ .., built] = words.as_slice() else {
            return None;
        };
        let (w, h) = size.split_once('x')?;
        let list = |words: &[&str]| words.iter().map(|w| w.parse().ok()).collect::<Vec<_>>();
        let times = list(times);
        (times.len() == 4).then_some(Self {
            name: name.to_owned(),
            size: [w.parse().ok()?, h.parse().ok()?],
            times,
            built: list(&built.split(", ").collect::<Vec<_>>()),
        })
    }
}

fn joined(list: &[Option<f64>], between: &str) -> String {
    let cells: Vec<String> = list.iter().map(|&x| cell(x)).collect();
    cells.join(between)
}

fn cell(x: Option<f64>) -> String {
    x.map_or("-".to_owned(), |x| format!("{x:.3}"))
}
