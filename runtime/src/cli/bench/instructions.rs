//! Instructions of the compiler, counted by the machine where it offers that, else by valgrind.

use std::path::Path;
use std::process::Command;

use crate::cli::failure::Failure;

/// A program that costs little: what it takes is what the process takes by itself, with tables that are made once.
const NOTHING: &str = "show levels(x)\n";
/// Counts differ by less from one run to another, as a part.
pub(super) const NOISE: f64 = 0.01;

/// Counts the instructions of processes.
pub(super) struct Counter {
    kind: Kind,
    folder: tempfile::TempDir,
    /// Of the program that costs little.
    own: u64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    /// The counters of the processor, by `perf`.
    Perf,
    /// A simulated one, by `valgrind`.
    Valgrind,
}

impl Kind {
    /// The command that counts.
    fn command(self) -> Command {
        match self {
            Self::Perf => {
                let mut perf = Command::new("perf");
                perf.args(["stat", "-x", ",", "-e", "instructions:u", "--"]);
                perf
            }
            Self::Valgrind => {
                let mut valgrind = Command::new("valgrind");
                let no_caches = ["--tool=cachegrind", "--cache-sim=no"];
                valgrind.args(no_caches);
                valgrind.arg("--cachegrind-out-file=/dev/null");
                valgrind
            }
        }
    }

    /// The count in what the command tells on its standard error.
    fn found(self, told: &str) -> Option<u64> {
        match self {
            Self::Perf => {
                let line = told.lines().find(|line| line.contains("instructions"))?;
                line.split(',').next()?.parse().ok()
            }
            Self::Valgrind => {
                let line = told.lines().find(|line| line.contains("refs:"))?;
                let (_, number) = line.split_once("refs:")?;
                number.trim().replace(',', "").parse().ok()
            }
        }
    }
}

impl Counter {
    /// The first that counts here.
    pub(super) fn new() -> Result<Self, Failure> {
        let folder = tempfile::tempdir().map_err(|error| Failure::Io {
            what: "counting".to_owned(),
            error,
        })?;
        for kind in [Kind::Perf, Kind::Valgrind] {
            if let Some(own) = counted(kind, folder.path(), NOTHING) {
                return Ok(Self { kind, folder, own });
            }
        }
        Err(Failure::usage_hint(
            "instructions cannot be counted here",
            "perf counts them where the processor's counters are open to users, valgrind everywhere else where it is installed",
        ))
    }

    /// What counts, in words.
    pub(super) fn name(&self) -> &'static str {
        match self.kind {
            Kind::Perf => "perf",
            Kind::Valgrind => "valgrind",
        }
    }

    /// Instructions from a text to SPIR-V, without those of the process.
    pub(super) fn count(&self, text: &str) -> Option<u64> {
        let all = counted(self.kind, self.folder.path(), text)?;
        Some(all.saturating_sub(self.own))
    }
}

/// Instructions of a process of this program that makes the shader of a text.
fn counted(kind: Kind, folder: &Path, text: &str) -> Option<u64> {
    let source = folder.join("counted.pull");
    std::fs::write(&source, text).ok()?;
    let done = kind
        .command()
        .arg(std::env::current_exe().ok()?)
        .arg("emit")
        .arg(&source)
        .args(["--what", "scene", "--target", "spirv", "-o"])
        .arg(folder.join("counted.spv"))
        .output()
        .ok()?;
    if !done.status.success() {
        return None;
    }
    kind.found(&String::from_utf8_lossy(&done.stderr))
}

#[cfg(test)]
mod tests {
    use super::Kind;

    #[test]
    fn counts_are_found_in_what_is_told() {
        let perf = "1234567,,instructions:u,100000,100.00,,\n";
        assert_eq!(Kind::Perf.found(perf), Some(1_234_567));
        let none = "<not supported>,,instructions:u,0,100.00,,\n";
        assert_eq!(Kind::Perf.found(none), None);
        let valgrind = "==1== warning: cache\n==1== \n==1== I   refs:      504,493,186\n";
        assert_eq!(Kind::Valgrind.found(valgrind), Some(504_493_186));
        assert_eq!(Kind::Valgrind.found(""), None);
    }
}
