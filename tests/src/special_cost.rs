//! What functions that are defined in the language cost: a file of measurements that grows, and the tables of a page that are made
//! from it.

use std::collections::BTreeMap;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use pullback_runtime::Error;

/// What is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Cost {
    /// Text to WGSL, in seconds.
    Compiled,
    /// A frame on a device that is one, in seconds.
    Frame,
    /// A frame on a software adapter, in seconds.
    SoftwareFrame,
}

impl Cost {
    const ALL: [Self; 3] = [Self::Compiled, Self::Frame, Self::SoftwareFrame];

    fn name(self) -> &'static str {
        match self {
            Self::Compiled => "compiled",
            Self::Frame => "frame",
            Self::SoftwareFrame => "software frame",
        }
    }
}

/// Measurements by function: seconds, or why there are none.
#[derive(Debug, Default)]
pub struct Costs {
    path: Option<PathBuf>,
    found: BTreeMap<(String, Cost), Result<f64, String>>,
}

impl Costs {
    /// Reads a file of measurements, of the same one the last. Without a path, or where there is no file, there are none yet.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn read(path: Option<&Path>) -> Result<Self, Error> {
        let mut costs = Self {
            path: path.map(Path::to_owned),
            found: BTreeMap::new(),
        };
        let Some(path) = path.filter(|path| path.exists()) else {
            return Ok(costs);
        };
        for line in std::fs::read_to_string(path)?.lines() {
            let cells: Vec<&str> = line.split('\t').collect();
            if let [function, what, seconds] = cells.as_slice()
                && let Some(cost) = Cost::ALL.iter().find(|cost| cost.name() == *what)
            {
                let value = seconds.parse().map_err(|_| (*seconds).to_owned());
                costs.found.insert(((*function).to_owned(), *cost), value);
            }
        }
        Ok(costs)
    }

    /// What is known of a function.
    #[must_use]
    pub fn of(&self, function: &str, cost: Cost) -> Option<&Result<f64, String>> {
        self.found.get(&(function.to_owned(), cost))
    }

    /// Adds a measurement, and writes it at the end of the file.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn add(
        &mut self,
        function: &str,
        cost: Cost,
        seconds: Result<f64, String>,
    ) -> Result<(), Error> {
        if let Some(path) = &self.path {
            let shown = match &seconds {
                Ok(seconds) => format!("{seconds:.6}"),
                Err(reason) => reason.replace(['\t', '\n'], " "),
            };
            let line = format!("{function}\t{}\t{shown}\n", cost.name());
            let mut options = std::fs::OpenOptions::new();
            let mut file = options.append(true).create(true).open(path)?;
            file.write_all(line.as_bytes())?;
        }
        self.found.insert((function.to_owned(), cost), seconds);
        Ok(())
    }
}

/// The part of a page between two marks.
///
/// # Errors
/// The marks are not there.
pub fn between<'a>(page: &'a str, [begin, end]: [&str; 2]) -> Result<[&'a str; 3], Error> {
    let split = page.split_once(begin).and_then(|(before, rest)| {
        let (inside, after) = rest.split_once(end)?;
        Some([before, inside, after])
    });
    split.ok_or_else(|| Error::Invalid {
        reason: format!("no `{}` in the page", begin.trim()),
    })
}

/// The cells of a Markdown table by the first one, without its quotes.
#[must_use]
pub fn rows(table: &str) -> BTreeMap<String, Vec<String>> {
    let cells = |line: &str| -> Vec<String> {
        let inner = line.trim().trim_start_matches('|').trim_end_matches('|');
        inner
            .split('|')
            .map(|cell| cell.trim().to_owned())
            .collect()
    };
    let lines = table.lines().filter(|line| line.starts_with("| `"));
    lines
        .map(cells)
        .filter_map(|row| Some((row.first()?.trim_matches('`').to_owned(), row)))
        .collect()
}

/// A time in milliseconds, of small ones with two digits behind the point.
#[must_use]
pub fn milliseconds(seconds: f64) -> String {
    let ms = seconds * 1e3;
    format!("{ms:.*}", if ms < 10.0 { 2 } else { 0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_keeps_what_was_measured_and_the_last_counts() {
        let folder = std::env::temp_dir().join(format!("special-cost-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        let path = folder.join("costs.tsv");
        let mut costs = Costs::read(Some(&path)).expect("no file yet");
        for (seconds, function) in [(2.0, "zeta"), (0.5, "erf"), (1.0, "zeta")] {
            costs
                .add(function, Cost::Frame, Ok(seconds))
                .expect("a line");
        }
        let reason = Err("not within 120 s".to_owned());
        costs
            .add("zeta", Cost::SoftwareFrame, reason.clone())
            .expect("a line");
        let again = Costs::read(Some(&path)).expect("the file");
        std::fs::remove_dir_all(&folder).expect("the folder");
        assert_eq!(again.of("zeta", Cost::Frame), Some(&Ok(1.0)));
        assert_eq!(again.of("erf", Cost::Frame), Some(&Ok(0.5)));
        assert_eq!(again.of("zeta", Cost::SoftwareFrame), Some(&reason));
        assert_eq!(again.of("zeta", Cost::Compiled), None);
    }

    #[test]
    fn rows_of_a_table_are_found_by_their_function() {
        let page = "a\n<!-- b -->\n| f | n |\n| --- | --- |\n| `erf` | 2 |\n<!-- e -->\nz";
        let [_, table, after] = between(page, ["<!-- b -->\n", "<!-- e -->\n"]).expect("marks");
        assert_eq!(after, "z");
        let found = rows(table);
        assert_eq!(found.get("erf").map(|row| row[1].as_str()), Some("2"));
        assert_eq!(found.len(), 1);
        assert!(between(page, ["<!-- x -->\n", "<!-- e -->\n"]).is_err());
    }
}
