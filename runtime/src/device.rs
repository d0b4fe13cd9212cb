//! Adapters and devices: choice, limits, and errors as data.

use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use pullback_compiler::lower::{Format, Precision};

use crate::Error;

/// Longest wait for one submission. Submissions are sized to take a fraction of a second.
const PATIENCE: Duration = Duration::from_secs(120);

/// Features that are turned on where the adapter has them.
const WELCOME_FEATURES: wgpu::Features = DOUBLE_FEATURES
    .union(wgpu::Features::PASSTHROUGH_SHADERS)
    .union(wgpu::Features::TIMESTAMP_QUERY);

/// What the tier `double` needs.
const DOUBLE_FEATURES: wgpu::Features =
    wgpu::Features::SHADER_F64.union(wgpu::Features::SHADER_INT64);

/// Which adapter to use.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum AdapterChoice {
    /// The best there is: hardware if any, else software.
    #[default]
    Auto,
    /// The best hardware adapter.
    Gpu,
    /// A software adapter, such as lavapipe.
    Software,
    /// The best adapter whose name or driver contains this text, whatever its case.
    Named(String),
}

impl std::str::FromStr for AdapterChoice {
    type Err = std::convert::Infallible;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Ok(match text {
            "auto" => Self::Auto,
            "gpu" => Self::Gpu,
            "software" => Self::Software,
            name => Self::Named(name.to_owned()),
        })
    }
}

/// What to tell people about an adapter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AdapterSummary {
    /// The adapter's name.
    pub name: String,
    /// Hardware or not, and of what sort.
    pub kind: wgpu::DeviceType,
    /// The interface it is driven through.
    pub backend: wgpu::Backend,
    /// Driver name and version; may be empty.
    pub driver: String,
}

impl AdapterSummary {
    fn new(info: &wgpu::AdapterInfo) -> Self {
        Self {
            name: info.name.clone(),
            kind: info.device_type,
            backend: info.backend,
            driver: format!("{} {}", info.driver, info.driver_info)
                .trim()
                .to_owned(),
        }
    }

    /// Whether pictures are computed on the CPU.
    #[must_use]
    pub fn is_software(&self) -> bool {
        self.kind == wgpu::DeviceType::Cpu
    }

    /// The kind of device in words.
    #[must_use]
    pub fn kind_words(&self) -> &'static str {
        match self.kind {
            wgpu::DeviceType::DiscreteGpu => "discrete GPU",
            wgpu::DeviceType::IntegratedGpu => "integrated GPU",
            wgpu::DeviceType::VirtualGpu => "virtual GPU",
            wgpu::DeviceType::Cpu => "software",
            wgpu::DeviceType::Other => "GPU of unknown kind",
        }
    }

    fn rank(&self) -> u32 {
        match self.kind {
            wgpu::DeviceType::DiscreteGpu => 0,
            wgpu::DeviceType::IntegratedGpu => 1,
            wgpu::DeviceType::VirtualGpu => 2,
            wgpu::DeviceType::Other => 3,
            wgpu::DeviceType::Cpu => 4,
        }
    }

    fn fits(&self, choice: &AdapterChoice) -> bool {
        match choice {
            AdapterChoice::Auto => true,
            AdapterChoice::Gpu => !self.is_software(),
            AdapterChoice::Software => self.is_software(),
            AdapterChoice::Named(part) => {
                let part = part.to_lowercase();
                self.name.to_lowercase().contains(&part)
                    || self.driver.to_lowercase().contains(&part)
            }
        }
    }
}

impl fmt::Display for AdapterSummary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({}, {}", self.name, self.kind_words(), self.backend)?;
        if !self.driver.is_empty() {
            write!(f, ", {}", self.driver)?;
        }
        f.write_str(")")
    }
}

/// Every adapter of this machine, best first.
#[must_use]
pub fn adapters() -> Vec<wgpu::Adapter> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let mut all = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::all()));
    all.retain(|adapter| adapter.get_info().backend != wgpu::Backend::Noop);
    // Stable: the driver's own order decides between equals.
    all.sort_by_key(|adapter| AdapterSummary::new(&adapter.get_info()).rank());
    all
}

/// What to tell people about `adapter`.
#[must_use]
pub fn summary(adapter: &wgpu::Adapter) -> AdapterSummary {
    AdapterSummary::new(&adapter.get_info())
}

/// Positions in `found` (best first) that fit `choice`, in the order in which to try them.
fn candidates(found: &[AdapterSummary], choice: &AdapterChoice) -> Vec<usize> {
    (0..found.len())
        .filter(|&i| found[i].fits(choice))
        .collect()
}

/// What a device reported outside of any error scope.
#[derive(Debug, Default)]
struct Faults {
    /// Reason of the loss, once the device is lost.
    lost: Option<String>,
    /// First error that no scope caught.
    stray: Option<String>,
}

/// An open device and its queue. Clones share the device.
#[derive(Clone, Debug)]
pub struct Gpu {
    device: wgpu::Device,
    queue: wgpu::Queue,
    adapter: AdapterSummary,
    faults: Arc<Mutex<Faults>>,
}

impl Gpu {
    /// Opens the best adapter that fits `choice` and works.
    ///
    /// # Errors
    /// [`Error::NoAdapter`] if none fits, [`Error::NoDevice`] if none of those gave a device.
    pub fn open(choice: &AdapterChoice) -> Result<Self, Error> {
        let adapters = adapters();
        let found: Vec<_> = adapters.iter().map(summary).collect();
        let mut refusal = None;
        for i in candidates(&found, choice) {
            match Self::from_adapter(&adapters[i]) {
                Ok(gpu) => return Ok(gpu),
                Err(error) => refusal = refusal.or(Some(error)),
            }
        }
        Err(refusal.unwrap_or(Error::NoAdapter {
            wanted: choice.clone(),
            found,
        }))
    }

    /// Opens `adapter` with all its limits.
    ///
    /// # Errors
    /// [`Error::NoDevice`] if the driver gives none.
    pub fn from_adapter(adapter: &wgpu::Adapter) -> Result<Self, Error> {
        let summary = summary(adapter);
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("pullback"),
            required_features: adapter.features() & WELCOME_FEATURES,
            required_limits: adapter.limits(),
            memory_hints: wgpu::MemoryHints::MemoryUsage,
            ..Default::default()
        };
        let (device, queue) =
            pollster::block_on(adapter.request_device(&descriptor)).map_err(|error| {
                Error::NoDevice {
                    adapter: summary.name.clone(),
                    reason: error.to_string(),
                }
            })?;
        Ok(Self::watch(device, queue, summary))
    }

    fn watch(device: wgpu::Device, queue: wgpu::Queue, adapter: AdapterSummary) -> Self {
        let faults = Arc::<Mutex<Faults>>::default();
        let stray = Arc::clone(&faults);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            lock(&stray).stray.get_or_insert(error.to_string());
        }));
        let lost = Arc::clone(&faults);
        device.set_device_lost_callback(move |reason, message| {
            // Dropping the last handle reports a loss too.
            if reason != wgpu::DeviceLostReason::Destroyed {
                lock(&lost).lost.get_or_insert(message);
            }
        });
        Self {
            device,
            queue,
            adapter,
            faults,
        }
    }

    /// What to tell people about the adapter.
    #[must_use]
    pub fn adapter(&self) -> &AdapterSummary {
        &self.adapter
    }

    /// Whether shaders of a tier can run on it.
    #[must_use]
    pub fn has(&self, precision: Precision) -> bool {
        precision.format() != Format::Double || self.device.features().contains(DOUBLE_FEATURES)
    }

    /// The wgpu device.
    #[must_use]
    pub fn device(&self) -> &wgpu::Device {
        &self.device
    }

    /// The wgpu queue.
    #[must_use]
    pub fn queue(&self) -> &wgpu::Queue {
        &self.queue
    }

    /// Runs `work`, which creates resources or records commands, and returns what it made unless the device
    /// reported an error meanwhile.
    ///
    /// # Errors
    /// [`Error::Device`] or [`Error::Lost`].
    pub fn guarded<T>(&self, during: &'static str, work: impl FnOnce() -> T) -> Result<T, Error> {
        let internal = self.device.push_error_scope(wgpu::ErrorFilter::Internal);
        let memory = self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let validation = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let made = work();
        let errors = [
            pollster::block_on(validation.pop()),
            pollster::block_on(memory.pop()),
            pollster::block_on(internal.pop()),
        ];
        self.healthy(during)?;
        match errors.into_iter().flatten().next() {
            None => Ok(made),
            Some(error) => Err(Error::Device {
                during,
                reason: error.to_string(),
            }),
        }
    }

    /// Waits until the submission is done.
    ///
    /// # Errors
    /// [`Error::Timeout`], [`Error::Device`] or [`Error::Lost`].
    pub fn wait(
        &self,
        during: &'static str,
        submission: wgpu::SubmissionIndex,
    ) -> Result<(), Error> {
        let poll = wgpu::PollType::Wait {
            submission_index: Some(submission),
            timeout: Some(PATIENCE),
        };
        // wgpu panics in here when the device is lost; it holds no state of ours.
        let polled = catch_unwind(AssertUnwindSafe(|| self.device.poll(poll)));
        self.healthy(during)?;
        match polled {
            Ok(Ok(_)) => Ok(()),
            Ok(Err(wgpu::PollError::Timeout)) => Err(Error::Timeout {
                during,
                seconds: PATIENCE.as_secs(),
            }),
            Ok(Err(error)) => Err(Error::Device {
                during,
                reason: error.to_string(),
            }),
            Err(_) => Err(Error::Lost {
                during,
                reason: String::new(),
            }),
        }
    }

    /// Whether the device is gone, and everything that is asked of it fails.
    #[must_use]
    pub fn is_lost(&self) -> bool {
        lock(&self.faults).lost.is_some()
    }

    /// Reports, once, an error that came outside of any scope, and, always, the loss of the device.
    fn healthy(&self, during: &'static str) -> Result<(), Error> {
        let mut faults = lock(&self.faults);
        if let Some(reason) = &faults.lost {
            return Err(Error::Lost {
                during,
                reason: reason.clone(),
            });
        }
        match faults.stray.take() {
            None => Ok(()),
            Some(reason) => Err(Error::Device { during, reason }),
        }
    }
}

fn lock(faults: &Mutex<Faults>) -> MutexGuard<'_, Faults> {
    faults.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn adapter(name: &str, kind: wgpu::DeviceType) -> AdapterSummary {
        AdapterSummary {
            name: name.into(),
            kind,
            backend: wgpu::Backend::Vulkan,
            driver: "Mesa 22".into(),
        }
    }

    #[test]
    fn choice_filters_and_keeps_the_order() {
        let found = [
            adapter("NVIDIA H100", wgpu::DeviceType::DiscreteGpu),
            adapter("Intel UHD", wgpu::DeviceType::IntegratedGpu),
            adapter("llvmpipe", wgpu::DeviceType::Cpu),
        ];
        let check = |text: &str, expected: &[usize]| {
            let choice = text.parse().unwrap();
            assert_eq!(candidates(&found, &choice), expected, "{text}");
        };
        check("auto", &[0, 1, 2]);
        check("gpu", &[0, 1]);
        check("software", &[2]);
        check("intel", &[1]);
        check("mesa", &[0, 1, 2]);
        check("radeon", &[]);
    }

    #[test]
    fn a_missing_adapter_is_named_with_what_there_is() {
        let error = Error::NoAdapter {
            wanted: AdapterChoice::Named("radeon".into()),
            found: vec![adapter("llvmpipe", wgpu::DeviceType::Cpu)],
        };
        assert_eq!(
            error.to_string(),
            "no graphics adapter called `radeon`; there is llvmpipe (software, vulkan, Mesa 22)"
        );
    }

    #[test]
    fn errors_are_caught_and_the_device_lives_on() {
        let Ok(gpu) = Gpu::open(&AdapterChoice::Auto) else {
            return;
        };
        let bad = |size| wgpu::BufferDescriptor {
            label: None,
            size,
            usage: wgpu::BufferUsages::UNIFORM,
            mapped_at_creation: false,
        };
        let caught = gpu.guarded("a test", || gpu.device().create_buffer(&bad(u64::MAX / 2)));
        assert!(matches!(caught, Err(Error::Device { .. })), "{caught:?}");
        let _stray = gpu.device().create_buffer(&bad(u64::MAX / 2));
        assert!(matches!(
            gpu.guarded("a test", || ()),
            Err(Error::Device { .. })
        ));
        assert!(
            gpu.guarded("a test", || gpu.device().create_buffer(&bad(64)))
                .is_ok()
        );
    }
}
