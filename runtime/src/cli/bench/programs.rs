//! The times of a run in Markdown.

use pullback_runtime::bench::{STAGES, median};

use super::base::Run;

/// The times of a run: milliseconds of every stage and picture.
pub(super) fn markdown(run: &Run) -> String {
    let stages = STAGES.len();
    let mut text = format!(
        "{}; {}x{} pixels of one sample; milliseconds, medians of {} turns\n\n| program | {} | compiled | picture |\n\
         | --- |{}\n",
        run.adapter.as_deref().unwrap_or("the compiler alone"),
        run.width,
        run.height,
        run.calibration.len(),
        STAGES.join(" | "),
        " ---: |".repeat(stages + 2)
    );
    for program in &run.pictures {
        let times: Vec<f64> = program
            .times
            .iter()
            .map(|case| 1e3 * median(&case.seconds))
            .collect();
        let compiled: f64 = times.iter().take(stages).sum();
        text += &format!("| {} |", program.name);
        for time in &times[..stages.min(times.len())] {
            text += &format!(" {time:.3} |");
        }
        let picture = times
            .get(stages)
            .map_or_else(|| "-".to_owned(), |time| format!("{time:.4}"));
        text += &format!(" {compiled:.3} | {picture} |\n");
    }
    text
}
