//! A progress bar for what takes longer than a second.

use std::io;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use pullback_runtime::RowSink;

use super::Console;

const PATIENCE: Duration = Duration::from_secs(1);

/// Shows how far a long piece of work is; vanishes when dropped.
pub(super) struct Progress {
    start: Instant,
    bar: Option<ProgressBar>,
    wanted: bool,
}

impl Progress {
    pub(super) fn new(console: &Console) -> Self {
        Self {
            start: Instant::now(),
            bar: None,
            wanted: console.progress,
        }
    }

    /// `done` of `total`; a total of zero is unknown.
    pub(super) fn update(&mut self, done: u64, total: u64) {
        if !self.wanted || self.start.elapsed() < PATIENCE {
            return;
        }
        let bar = self.bar.get_or_insert_with(|| {
            if total == 0 {
                let style = ProgressStyle::with_template("{spinner} {human_pos} rows, {elapsed}");
                ProgressBar::new_spinner()
                    .with_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()))
            } else {
                let style =
                    ProgressStyle::with_template("{wide_bar} {percent:>3} %  {elapsed} + {eta}");
                ProgressBar::new(total)
                    .with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
            }
            .with_elapsed(self.start.elapsed())
        });
        bar.set_position(done);
    }

    pub(super) fn elapsed(&self) -> Duration {
        self.start.elapsed()
    }

    /// Takes the bar off the terminal.
    pub(super) fn finish(&mut self) {
        if let Some(bar) = self.bar.take() {
            bar.finish_and_clear();
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.finish();
    }
}

/// Rows that are counted on their way.
pub(super) struct Counted<'a> {
    pub(super) sink: &'a mut dyn RowSink,
    pub(super) progress: &'a mut Progress,
}

impl RowSink for Counted<'_> {
    fn rows(&mut self, rgba: &[u8]) -> io::Result<()> {
        self.sink.rows(rgba)
    }

    fn progress(&mut self, done: u64, total: u64) {
        self.progress.update(done, total);
    }
}
