//! What the doctor finds, as data.

use std::sync::Arc;

use pullback_compiler::lower::Exactness;
use pullback_runtime::device::{self, AdapterSummary};
use pullback_runtime::{Capabilities, Error};
use serde::Serialize;

use crate::cli::failure::INSTALL_SOFTWARE;

/// Grows when a program that reads the older schema would misread the newer.
const VERSION: u32 = 1;

/// Features that make a difference to us, and what they are good for.
const FEATURES: [(&str, wgpu::Features, &str); 5] = [
    (
        "SHADER_F64",
        wgpu::Features::SHADER_F64,
        "native double precision",
    ),
    (
        "SHADER_INT64",
        wgpu::Features::SHADER_INT64,
        "bits of double precision",
    ),
    (
        "PASSTHROUGH_SHADERS",
        wgpu::Features::PASSTHROUGH_SHADERS,
        "shaders decorated by us",
    ),
    (
        "TIMESTAMP_QUERY",
        wgpu::Features::TIMESTAMP_QUERY,
        "timing on the device",
    ),
    ("SUBGROUP", wgpu::Features::SUBGROUP, "subgroup operations"),
];

/// All that is found.
#[derive(Debug, Serialize)]
pub(super) struct Report {
    version: u32,
    pub(super) pullback: &'static str,
    pub(super) system: String,
    pub(super) adapters: Vec<AdapterReport>,
    /// What to do, and what pictures are drawn by.
    pub(super) advice: Vec<String>,
}

/// An adapter.
#[derive(Debug, Serialize)]
pub(super) struct AdapterReport {
    pub(super) name: String,
    pub(super) kind: &'static str,
    pub(super) interface: String,
    pub(super) driver: String,
    pub(super) limits: Limits,
    pub(super) features: Vec<Feature>,
    /// What it did when it was tried.
    pub(super) trial: Option<Trial>,
    /// Why it could not be tried.
    pub(super) error: Option<String>,
    pub(super) tiers: Option<Tiers>,
    #[serde(skip)]
    summary: AdapterSummary,
}

#[derive(Debug, Serialize)]
pub(super) struct Limits {
    pub(super) buffer_bytes: u64,
    pub(super) storage_binding_bytes: u64,
    pub(super) texture_side: u32,
    pub(super) workgroups: u32,
}

#[derive(Debug, Serialize)]
pub(super) struct Feature {
    pub(super) name: &'static str,
    pub(super) offered: bool,
    #[serde(skip)]
    pub(super) meaning: &'static str,
}

/// What an adapter did.
#[derive(Debug, Serialize)]
pub(super) struct Trial {
    pub(super) rows: usize,
    pub(super) ready_ms: f64,
    pub(super) rows_ms: f64,
    pub(super) probe_ms: f64,
    #[serde(serialize_with = "plain")]
    pub(super) capabilities: Arc<Capabilities>,
}

fn plain<S: serde::Serializer>(found: &Arc<Capabilities>, to: S) -> Result<S::Ok, S::Error> {
    found.as_ref().serialize(to)
}

/// What follows for the wide tiers.
#[derive(Debug, Serialize)]
pub(super) struct Tiers {
    pub(super) extended: Tier,
    pub(super) double: Tier,
}

#[derive(Debug, Serialize)]
pub(super) struct Tier {
    pub(super) available: bool,
    /// By what means, or why not.
    pub(super) how: String,
}

impl From<Result<String, String>> for Tier {
    fn from(found: Result<String, String>) -> Self {
        Self {
            available: found.is_ok(),
            how: found.unwrap_or_else(|reason| reason),
        }
    }
}

impl Tiers {
    fn new(found: &Capabilities) -> Self {
        let steps = |form: Exactness| format!("exact steps {}", form.name());
        Self {
            extended: found.extended().map(steps).into(),
            double: found.double().map(|()| "native".to_owned()).into(),
        }
    }
}

impl AdapterReport {
    pub(super) fn new(adapter: &wgpu::Adapter, trial: Result<Trial, Error>) -> Self {
        let summary = device::summary(adapter);
        let limits = adapter.limits();
        let feature =
            |&(name, feature, meaning): &(&'static str, wgpu::Features, &'static str)| Feature {
                name,
                offered: adapter.features().contains(feature),
                meaning,
            };
        let (trial, error) = match trial {
            Ok(trial) => (Some(trial), None),
            Err(error) => (None, Some(error.to_string())),
        };
        Self {
            name: summary.name.clone(),
            kind: summary.kind_words(),
            interface: summary.backend.to_string(),
            driver: summary.driver.clone(),
            limits: Limits {
                buffer_bytes: limits.max_buffer_size,
                storage_binding_bytes: limits.max_storage_buffer_binding_size,
                texture_side: limits.max_texture_dimension_2d,
                workgroups: limits.max_compute_workgroups_per_dimension,
            },
            features: FEATURES.iter().map(feature).collect(),
            tiers: trial.as_ref().map(|trial| Tiers::new(&trial.capabilities)),
            trial,
            error,
            summary,
        }
    }
}

impl Report {
    pub(super) fn new(adapters: Vec<AdapterReport>) -> Self {
        Self {
            version: VERSION,
            pullback: env!("CARGO_PKG_VERSION"),
            system: format!("{} {}", std::env::consts::OS, std::env::consts::ARCH),
            advice: advice(&adapters),
            adapters,
        }
    }

    /// Whether an adapter does what it should.
    pub(super) fn works(&self) -> bool {
        self.adapters.iter().any(|adapter| adapter.trial.is_some())
    }

    /// The report for programs.
    pub(super) fn json(&self) -> String {
        // Numbers and texts alone: nothing in it can fail to be written.
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }
}

fn advice(adapters: &[AdapterReport]) -> Vec<String> {
    let working: Vec<_> = adapters
        .iter()
        .filter(|adapter| adapter.trial.is_some())
        .map(|adapter| &adapter.summary)
        .collect();
    let mut advice = vec![match working.first() {
        Some(best) => format!("pictures are drawn by {best}"),
        None if adapters.is_empty() => "there is no graphics adapter".to_owned(),
        None => "no graphics adapter works".to_owned(),
    }];
    if working.iter().all(|adapter| adapter.is_software()) {
        let mut text = "no hardware adapter: if this machine has a GPU, install its vendor's driver with Vulkan".to_owned();
        if cfg!(target_os = "linux") {
            text += "\n  (NVIDIA in a container: the graphics capability, and libvulkan1; AMD and Intel: mesa-vulkan-drivers)";
        }
        advice.push(text);
    }
    if !working.iter().any(|adapter| adapter.is_software()) {
        advice.push(format!("no software adapter: {INSTALL_SOFTWARE}"));
    }
    advice
}
