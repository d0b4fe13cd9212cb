//! What was measured, kept in a file, so that a run which was stopped goes on, and one after a change computes only what the
//! change has changed: a result's key is a digest of the compiled module, the points and the adapter.

use std::collections::HashMap;
use std::fs::{File, OpenOptions};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::{ErrorKind, Write as _};
use std::path::Path;
use std::sync::Mutex;

use pullback_compiler::EvalModule;

use super::data::Sample;
use super::measure::Loss;

/// Results by key; those of a file, and those of this run, which are appended to it.
#[derive(Debug, Default)]
pub struct Store {
    known: Mutex<HashMap<u64, Loss>>,
    file: Option<Mutex<File>>,
}

impl Store {
    /// The results that a file holds, which need not exist yet. A line that is none, such as the last one of a run that was
    /// stopped, is passed over.
    ///
    /// # Errors
    /// The file cannot be read or written; in words.
    pub fn open(path: &Path) -> Result<Self, String> {
        let wrong = |e: std::io::Error| format!("{}: {e}", path.display());
        let text = match std::fs::read_to_string(path) {
            Ok(text) => text,
            Err(e) if e.kind() == ErrorKind::NotFound => String::new(),
            Err(e) => return Err(wrong(e)),
        };
        let mut file = OpenOptions::new()
            .create(true)
            .append(true)
            .open(path)
            .map_err(wrong)?;
        if !text.is_empty() && !text.ends_with('\n') {
            writeln!(file).map_err(wrong)?;
        }
        Ok(Self {
            known: Mutex::new(text.lines().filter_map(entry).collect()),
            file: Some(Mutex::new(file)),
        })
    }

    /// What is known of a key.
    #[must_use]
    pub fn get(&self, key: u64) -> Option<Loss> {
        let known = self.known.lock().ok()?;
        known.get(&key).copied()
    }

    /// Keeps a result.
    ///
    /// # Errors
    /// The file cannot be written; in words.
    pub fn put(&self, key: u64, loss: Loss) -> Result<(), String> {
        if let Ok(mut known) = self.known.lock() {
            known.insert(key, loss);
        }
        let Some(Ok(mut file)) = self.file.as_ref().map(Mutex::lock) else {
            return Ok(());
        };
        // one write a line: a run that is stopped leaves whole ones
        let line = format!("{key:016x}\t{}\t{}\n", loss.single, loss.own);
        file.write_all(line.as_bytes()).map_err(|e| e.to_string())
    }
}

/// `KEY SINGLE OWN` with tabs.
fn entry(line: &str) -> Option<(u64, Loss)> {
    let mut words = line.split('\t');
    let key = u64::from_str_radix(words.next()?, 16).ok()?;
    let single = words.next()?.parse().ok()?;
    let own = words.next()?.parse().ok()?;
    words
        .next()
        .is_none()
        .then_some((key, Loss { single, own }))
}

/// A digest of everything that a result depends on.
#[must_use]
pub fn key(adapter: &str, module: &EvalModule, points: &[Sample]) -> u64 {
    let mut digest = DefaultHasher::new();
    adapter.hash(&mut digest);
    format!("{:?}", module.module).hash(&mut digest);
    module.tier.hash(&mut digest);
    for point in points {
        for x in &point.args {
            x.to_bits().hash(&mut digest);
        }
        point.exact.hi.to_bits().hash(&mut digest);
        point.exact.lo.to_bits().hash(&mut digest);
    }
    digest.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stopped_run_goes_on() {
        let path = std::env::temp_dir().join(format!("store-{}.tsv", std::process::id()));
        let first = Loss {
            single: 0.1,
            own: 1.0 / 3.0,
        };
        let second = Loss {
            single: 32.0,
            own: 48.0,
        };
        Store::open(&path).unwrap().put(7, first).unwrap();
        // the next line is cut short
        let mut file = OpenOptions::new().append(true).open(&path).unwrap();
        file.write_all(b"0000000000000009\t1.").unwrap();
        let again = Store::open(&path).unwrap();
        assert_eq!(again.get(7), Some(first));
        assert_eq!(again.get(9), None);
        again.put(u64::MAX, second).unwrap();
        let last = Store::open(&path).unwrap();
        assert_eq!(last.get(7), Some(first));
        assert_eq!(last.get(u64::MAX), Some(second));
        std::fs::remove_file(&path).unwrap();
    }
}
