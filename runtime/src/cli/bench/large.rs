//! Large pictures: how long they take, and how much memory.

use std::io;
use std::time::Instant;

use pullback_compiler::lower::Precision;
use pullback_runtime::{Capabilities, Gpu, Renderer, RowSink, Size};

use super::{mebibytes, peak_memory};
use crate::cli::Console;
use crate::cli::failure::Failure;
use crate::cli::gallery;

/// The pictures, one of the plane and one of space, with the greatest number of their pixels.
const PICTURES: [(&str, u64); 2] = [("chladni", 1 << 28), ("cayley", 1 << 26)];
/// Widths and heights.
const SIZES: [[u32; 2]; 5] = [
    [640, 480],
    [1920, 1080],
    [3840, 2160],
    [8192, 8192],
    [16384, 16384],
];

/// A picture of a size.
#[derive(Clone, Copy)]
pub(super) struct Large {
    name: &'static str,
    size: Size,
}

impl Large {
    /// All of them, small ones first.
    pub(super) fn all() -> impl Iterator<Item = Self> {
        PICTURES.into_iter().flat_map(|(name, most)| {
            SIZES.into_iter().filter_map(move |[width, height]| {
                let size = Size { width, height };
                (u64::from(width) * u64::from(height) <= most).then_some(Self { name, size })
            })
        })
    }

    pub(super) fn label(self) -> String {
        format!("{} {}x{}", self.name, self.size.width, self.size.height)
    }

    /// Its line of the table.
    pub(super) fn line(self, gpu: &Gpu, console: &Console) -> Result<String, Failure> {
        let subjects = gallery::subjects(&[], self.size, console)?;
        let Some(subject) = subjects.iter().find(|s| s.source.stem == self.name) else {
            return Err(Failure::usage(format!("there is no {}", self.name)));
        };
        let scene = subject.scene(Capabilities::tier(gpu, Precision::Accurate)?, console)?;
        let settings = scene.pack_settings(&subject.settings);
        let mut renderer = Renderer::for_settings(gpu, &scene, &subject.settings, 1)?;
        let frame = subject.single(&settings);
        // drivers compile with the first submission
        let first = pullback_runtime::Frame {
            size: Size {
                width: 64,
                height: 64,
            },
            ..frame
        };
        renderer.render(&first, &mut Nowhere)?;
        let whole = forget_peak();
        let start = Instant::now();
        renderer.render(&frame, &mut Nowhere)?;
        let seconds = start.elapsed().as_secs_f64();
        let host = peak_memory().map(|bytes| format!("{:.0}", mebibytes(bytes)));
        let report = gpu.device().generate_allocator_report();
        let device = report.map(|report| format!("{:.0}", mebibytes(report.total_reserved_bytes)));
        let pixels = f64::from(self.size.width) * f64::from(self.size.height);
        let shown = |text: Option<String>| text.unwrap_or_else(|| "-".to_owned());
        Ok(format!(
            "| {} | {:.1} | {:.2} | {}{} | {} |\n",
            self.label(),
            1e3 * seconds,
            1e9 * seconds / pixels,
            shown(host),
            if whole { "" } else { " or less" },
            shown(device)
        ))
    }
}

/// The head of the table.
pub(super) fn head(adapter: &str) -> String {
    format!(
        "{adapter}; one sample a pixel, by our clock, from the call until all rows are here. Memory in MiB: the most that the \
         process has had while it was drawn, and what is reserved on the device\n\n\
         | picture | ms | ns a pixel | host | device |\n| --- | ---: | ---: | ---: | ---: |\n"
    )
}

/// Rows that nobody keeps.
struct Nowhere;

impl RowSink for Nowhere {
    fn rows(&mut self, _: &[u8]) -> io::Result<()> {
        Ok(())
    }
}

/// Begins anew with the most memory that the process has had, where the system allows that.
fn forget_peak() -> bool {
    std::fs::write("/proc/self/clear_refs", "5").is_ok()
}
