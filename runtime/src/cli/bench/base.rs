//! The times of a run as a file: `docs/schema/bench-1.json`.

use std::path::Path;

use pullback_runtime::bench::{Ratio, ratio};
use serde::{Deserialize, Serialize};

use super::instructions::NOISE;
use crate::cli::failure::Failure;
use crate::cli::render::name;

/// Version of the file: the number grows when a program that reads the older one would misread the newer.
pub(super) const VERSION: u32 = 1;
/// Largest file that is read.
const MOST: u64 = 64 << 20;

/// All times of a run.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Run {
    pub(super) version: u32,
    /// What drew, if anything.
    pub(super) adapter: Option<String>,
    pub(super) width: u32,
    pub(super) height: u32,
    /// Seconds of the loop that tells how fast the machine is, in each turn.
    pub(super) calibration: Vec<f64>,
    pub(super) pictures: Vec<Program>,
    pub(super) peak_host_bytes: Option<u64>,
    pub(super) device_bytes: Option<u64>,
}

/// The times of a program.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Program {
    pub(super) name: String,
    pub(super) times: Vec<Case>,
    /// Of the compiler, from the text to SPIR-V, where they were counted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) instructions: Option<u64>,
}

/// One of them, in each turn.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Case {
    pub(super) name: String,
    pub(super) seconds: Vec<f64>,
}

impl Program {
    /// Adds a turn.
    pub(super) fn add(&mut self, times: Vec<f64>) {
        for (case, seconds) in self.times.iter_mut().zip(times) {
            case.seconds.push(seconds);
        }
    }

    pub(super) fn time(&self, name: &str) -> Option<&Case> {
        self.times.iter().find(|case| case.name == name)
    }
}

impl Run {
    pub(super) fn read(path: &Path) -> Result<Self, Failure> {
        let io = |error| Failure::Io {
            what: name(path),
            error,
        };
        if std::fs::metadata(path).map_err(io)?.len() > MOST {
            return Err(Failure::usage(format!(
                "{} is larger than 64 MiB",
                name(path)
            )));
        }
        let text = std::fs::read_to_string(path).map_err(io)?;
        let wrong = |reason: String| {
            Failure::usage_hint(
                format!("{} holds no times: {reason}", name(path)),
                "write one with `pullback bench -o FILE`",
            )
        };
        let run: Self = serde_json::from_str(&text).map_err(|error| wrong(error.to_string()))?;
        if run.version != VERSION {
            return Err(wrong(format!(
                "its version is {}, not {VERSION}",
                run.version
            )));
        }
        Ok(run)
    }

    pub(super) fn to_json(&self) -> String {
        // numbers and names alone: nothing that could not be written
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }

    /// How the times that both runs have compare, with their names.
    pub(super) fn against<'a>(&'a self, base: &'a Self) -> Vec<(String, Ratio)> {
        let mut out = Vec::new();
        for program in &self.pictures {
            let Some(old) = base.pictures.iter().find(|p| p.name == program.name) else {
                continue;
            };
            for case in &program.times {
                let before = old.time(&case.name).map(|old| old.seconds.as_slice());
                let found = before.and_then(|before| {
                    let by = [&base.calibration, &self.calibration].map(Vec::as_slice);
                    ratio([before, by[0]], [&case.seconds, by[1]])
                });
                out.extend(found.map(|ratio| (format!("{} {}", program.name, case.name), ratio)));
            }
            let counts = program.instructions.zip(old.instructions);
            let counts = counts.filter(|&(now, before)| now > 0 && before > 0);
            out.extend(counts.map(|(now, before)| {
                let value = now as f64 / before as f64;
                let range = [value / (1.0 + NOISE), value * (1.0 + NOISE)];
                let name = format!("{} instructions", program.name);
                (name, Ratio { value, range })
            }));
        }
        out
    }
}
