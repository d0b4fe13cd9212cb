//! What an adapter was found to make of special functions, in a file that grows with each table.

use std::collections::BTreeSet;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use pullback_compiler::lower::Precision;
use pullback_runtime::Error;

use crate::special_batches::Judged;

/// Of those names the wanted ones: each word is one of them, or part of all that are meant. No words mean all.
#[must_use]
pub fn wanted<'a>(names: &[&'a str], words: &[String]) -> BTreeSet<&'a str> {
    let chosen = |name: &&&'a str| {
        words.is_empty()
            || words.iter().any(|word| {
                word == **name || !names.contains(&word.as_str()) && name.contains(word.as_str())
            })
    };
    names.iter().filter(chosen).copied().collect()
}

/// The file, and which tables it has from an adapter.
#[derive(Debug)]
pub struct Record {
    path: Option<PathBuf>,
    adapter: String,
    known: BTreeSet<(String, String)>,
}

const HEAD: [&str; 10] = [
    "adapter",
    "table",
    "tier",
    "value",
    "derivative",
    "declared",
    "rows",
    "seconds",
    "problem",
    "worst",
];

impl Record {
    /// Reads what the file has from this adapter; without a path there is nothing to read and nothing is written.
    ///
    /// # Errors
    /// The file cannot be read, or written.
    pub fn read(path: Option<&Path>, adapter: &str) -> Result<Self, Error> {
        let mut record = Self {
            path: path.map(Path::to_owned),
            adapter: plain(adapter),
            known: BTreeSet::new(),
        };
        let Some(path) = path else { return Ok(record) };
        if !path.exists() {
            std::fs::write(path, HEAD.join("\t") + "\n")?;
        }
        for line in std::fs::read_to_string(path)?.lines() {
            let cells: Vec<&str> = line.split('\t').collect();
            if let [adapter, table, tier, ..] = cells.as_slice()
                && *adapter == record.adapter
            {
                let table = ((*table).to_owned(), (*tier).to_owned());
                record.known.insert(table);
            }
        }
        Ok(record)
    }

    /// Whether the file had this table in this tier.
    #[must_use]
    pub fn has(&self, table: &str, tier: Precision) -> bool {
        let table = (table.to_owned(), tier.name().to_owned());
        self.known.contains(&table)
    }

    /// Writes what was judged at the end of the file.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn add(&self, judged: &[Judged]) -> Result<(), Error> {
        let Some(path) = &self.path else {
            return Ok(());
        };
        let lines: String = judged.iter().map(|j| self.line(j)).collect();
        let mut file = std::fs::OpenOptions::new().append(true).open(path)?;
        Ok(file.write_all(lines.as_bytes())?)
    }

    fn line(&self, j: &Judged) -> String {
        let cells = [
            self.adapter.clone(),
            j.name.to_owned(),
            j.precision.name().to_owned(),
            j.factors.value.to_string(),
            j.factors.derivative.to_string(),
            j.most.to_string(),
            j.factors.rows.to_string(),
            format!("{:.2}", j.seconds),
            plain(j.problem.as_deref().unwrap_or("")),
            plain(&j.factors.worst),
        ];
        cells.join("\t") + "\n"
    }
}

/// Without what parts cells and lines.
fn plain(words: &str) -> String {
    words.replace(['\t', '\n'], " ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_means_its_table_and_a_part_all_that_have_it() {
        let names = ["weierstrass_p", "weierstrass_p_prime", "zeta_real"];
        let check = |words: &[&str], expected: &[&str]| {
            let words: Vec<String> = words.iter().map(|&w| w.to_owned()).collect();
            let found = wanted(&names, &words);
            assert_eq!(found, expected.iter().copied().collect(), "{words:?}");
        };
        check(&[], &names);
        check(&["weierstrass_p"], &["weierstrass_p"]);
        check(&["weierstrass"], &["weierstrass_p", "weierstrass_p_prime"]);
        check(&["zeta", "weierstrass_p"], &["weierstrass_p", "zeta_real"]);
    }
}
