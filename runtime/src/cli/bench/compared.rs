//! Lines of the tables that set the compiler beside other ways: operations, growth, gradients, integrals, and programs that
//! are written by hand.

use std::sync::atomic::AtomicBool;

use pullback_compiler::SceneModule;
use pullback_compiler::lower::Precision;
use pullback_runtime::bench::canvas::Canvas;
use pullback_runtime::bench::gradients::{self, formulas::Gradient};
use pullback_runtime::bench::growth::grown;
use pullback_runtime::bench::marches::{self, FLOOR, FRAME, Rival, densities::Density};
use pullback_runtime::bench::twins::{Off, Twin, times, twin_stages};
use pullback_runtime::bench::{STAGES, median, operations};
use pullback_runtime::difference::Bitmap;
use pullback_runtime::executor::{Arithmetic, Painter};
use pullback_runtime::{Error, Gpu, Pipeline, Size};

use crate::cli::Console;
use crate::cli::failure::Failure;
use crate::cli::source::{Source, Text};
use crate::cli::subject::Subject;

/// Turns of frames at most, and at least.
const MOST: u32 = 15;
const FEWEST: u32 = 3;
/// The largest picture that is compared with f64.
const SMALL: Size = Size {
    width: 320,
    height: 180,
};

/// Operations of the derivatives of each program's formula.
pub(super) fn derivatives(subjects: &[Subject]) -> Result<String, Failure> {
    let mut text = "Operations of value and derivatives together over those of the value alone, after common subexpressions; \
         weighted: by the weights of the operator table, an addition of reals is 1\n\n\
         | formula | value | with first | ratio | with second | ratio | value, weighted | with first | ratio | with second | ratio |\n\
         | --- |"
        .to_owned()
        + &" ---: |".repeat(10)
        + "\n";
    let mut ratios: [Vec<f64>; 4] = Default::default();
    for subject in subjects {
        let [value, first, second] = operations::costs(&subject.picture().formula)?;
        let over = |a: u32, b: u32| f64::from(a) / f64::from(b.max(1));
        let found = [
            over(first.operations, value.operations),
            over(second.operations, value.operations),
            over(first.weighted, value.weighted),
            over(second.weighted, value.weighted),
        ];
        for (all, &ratio) in ratios.iter_mut().zip(&found) {
            all.push(ratio);
        }
        text += &format!(
            "| {} | {} | {} | {:.2} | {} | {:.2} | {} | {} | {:.2} | {} | {:.2} |\n",
            subject.source.stem,
            value.operations,
            first.operations,
            found[0],
            second.operations,
            found[1],
            value.weighted,
            first.weighted,
            found[2],
            second.weighted,
            found[3]
        );
    }
    let [plain, plain2, heavy, heavy2] = ratios.map(|all| median(&all));
    text += &format!(
        "| **median** | | | {plain:.2} | | {plain2:.2} | | | {heavy:.2} | | {heavy2:.2} |\n"
    );
    Ok(text)
}

/// The head of the table of growth.
pub(super) fn growth_head() -> String {
    format!(
        "Sums of distinct terms, microseconds a syntax node; the last column is constant for n log n\n\n\
         | nodes | {} | total | total / (n log2 n), ns |\n| ---: |{}\n",
        STAGES.join(" | "),
        " ---: |".repeat(STAGES.len() + 2)
    )
}

/// The line of a sum of so many terms.
pub(super) fn growth_line(terms: u32) -> Result<String, Failure> {
    let found = grown(terms)?;
    let nodes = found.nodes;
    let each = found
        .seconds
        .map(|seconds| format!("{:.3}", 1e6 * seconds / nodes));
    Ok(format!(
        "| {nodes} | {} | {:.3} | {:.0} |\n",
        each.join(" | "),
        1e6 * found.total() / nodes,
        1e9 * found.total() / (nodes * nodes.log2())
    ))
}

/// The head of the table of gradients.
pub(super) fn gradients_head(adapter: &str) -> String {
    format!(
        "{adapter}; the functions of `fast` for all. Times of a point's value with its gradient relative to that of the value \
         alone, medians of turns; errors of gradients relative to their lengths, which 99.9 % do not exceed\n\n\
         | formula | value, ns | exact | by hand | forward differences | central ones | error: exact | by hand | forward \
         differences | central ones |\n| --- |{}\n",
        " ---: |".repeat(9)
    )
}

/// The line of a gradient.
pub(super) fn gradients_line(gradient: &Gradient, gpu: &Gpu) -> Result<String, Failure> {
    let found = gradients::measure(gradient, gpu, MOST)?;
    let ratios = found.ratios.map(|ratio| format!("{ratio:.2}"));
    let errors = found.errors.map(|error| format!("{error:.1e}"));
    Ok(format!(
        "| {} | {:.3} | {} | {} |\n",
        gradient.name,
        1e9 * found.value,
        ratios.join(" | "),
        errors.join(" | ")
    ))
}

/// The head of the table of closed forms.
pub(super) fn marches_head(adapter: &str, gpu: &Gpu) -> String {
    let fine = marches::fineness(gpu);
    format!(
        "{adapter}; {}x{} rays. Errors are parts of the integral of |f|, which 99.9 % of the rays do not exceed; march and Gauss \
         quadrature are as right, or right to 1e-6, and their times relative to that of the closed form\n\n\
         | density | formula | error | time, ms | steps | error | march | nodes | error | Gauss |\n\
         | --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n",
        fine * FRAME.width,
        fine * FRAME.height
    )
}

/// The line of a density.
pub(super) fn marches_line(density: &Density, gpu: &Gpu) -> Result<String, Failure> {
    let plan = marches::Plan {
        stride: 10,
        floor: FLOOR,
        seconds: 2.0,
    };
    let found = marches::measure(density, gpu, &plan)?;
    // a bar would end the cell; lower bounds where the error was not reached
    let formula = density.formula.replace('|', "\\|");
    let told = |rival: &Rival| {
        let over = if rival.reached { "" } else { "> " };
        let digits = usize::from(rival.ratio < 10.0);
        format!(
            "{over}{} | {:.0e} | {:.*}{}",
            rival.order,
            rival.error,
            digits,
            rival.ratio,
            if rival.reached { "" } else { " at least" }
        )
    };
    Ok(format!(
        "| {} | `{formula}` | {:.0e} | {:.3} | {} | {} |\n",
        density.name,
        found.error,
        1e3 * found.seconds,
        told(&found.march),
        told(&found.gauss)
    ))
}

/// The head of the table of twins.
pub(super) fn twins_head(adapter: &str, size: Size) -> String {
    let small = small(size);
    format!(
        "{adapter}; {}x{} pixels of one sample. Errors are those of pictures of {}x{} pixels against f64: mean of FLIP, root of the \
         mean square of a channel of 255, share of pixels that are off by more than 8 of 255\n\n\
         | scene | formula | twin, ms | fast / twin | accurate / twin | fast / unchecked | error: accurate | fast | twin |\n\
         | --- | --- | ---: | ---: | ---: | ---: | --- | --- | --- |\n",
        size.width, size.height, small.width, small.height
    )
}

fn small(size: Size) -> Size {
    Size {
        width: size.width.min(SMALL.width),
        height: size.height.min(SMALL.height),
    }
}

/// The line of a scene's twin, from turns of about so much time.
pub(super) fn twins_line(
    twin: &Twin,
    gpu: &Gpu,
    size: Size,
    seconds: f64,
    console: &Console,
) -> Result<String, Failure> {
    let large = Pair::new(twin, size, console)?;
    let (canvas, stages) = large.staged(twin, gpu)?;
    let first = times(&canvas, &stages, 1)?;
    let once: f64 = first.seconds.iter().sum();
    let turns = (0.5 * seconds / once.max(1e-6)).clamp(f64::from(FEWEST), f64::from(MOST));
    let found = times(&canvas, &stages, turns as u32)?;
    let small = Pair::new(twin, small(size), console)?;
    let off = small.off(twin, gpu)?.map(|off| off.to_string());
    let [accurate, fast, unchecked] = found.ratios;
    Ok(format!(
        "| {} | {} | {:.3} | {fast:.2} | {accurate:.2} | {unchecked:.2} | {} |\n",
        twin.scene,
        twin.formula,
        1e3 * found.seconds[2],
        off.join(" | ")
    ))
}

/// Our pictures of a twin's program, in `accurate` and in `fast`.
struct Pair {
    subject: Subject,
    scenes: [SceneModule; 2],
}

impl Pair {
    fn new(twin: &Twin, size: Size, console: &Console) -> Result<Self, Failure> {
        let text = Text {
            name: twin.formula.to_owned(),
            stem: twin.formula.to_owned(),
            bytes: twin.program.as_bytes().to_vec(),
        };
        let mut subject = Subject::small(Source::compiled(text, console)?, size)?;
        twin.fill_in(&mut subject.settings);
        let scenes = [
            subject.scene(Precision::Accurate.into(), console)?,
            subject.scene(Precision::Fast.into(), console)?,
        ];
        Ok(Self { subject, scenes })
    }

    /// Both as shaders for their settings, and the twin.
    fn staged(
        &self,
        twin: &Twin,
        gpu: &Gpu,
    ) -> Result<(Canvas, [pullback_runtime::bench::canvas::Stage; 4]), Failure> {
        let settings = self.scenes[0].pack_settings(&self.subject.settings);
        let canvas = Canvas::new(gpu, &self.subject.single(&settings))?;
        let stage = |scene: &SceneModule| {
            let made = scene
                .specialised(&self.subject.settings, 1)
                .map_err(|error| Error::Invalid {
                    reason: format!("{error:?}"),
                })?;
            canvas.stage(&made.module, &made.info)
        };
        let [accurate, fast] = [stage(&self.scenes[0])?, stage(&self.scenes[1])?];
        let [checked, unchecked] = twin_stages(&canvas, twin)?;
        Ok((canvas, [accurate, fast, checked, unchecked]))
    }

    /// How far the three pictures are from f64.
    fn off(&self, twin: &Twin, gpu: &Gpu) -> Result<[Off; 3], Failure> {
        let (canvas, stages) = self.staged(twin, gpu)?;
        let settings = self.scenes[0].pack_settings(&self.subject.settings);
        let frame = self.subject.single(&settings);
        let painter = Painter::new(&self.scenes[0], Arithmetic::Reference, Pipeline::Compute)?;
        let never = AtomicBool::new(false);
        let mut rows = Vec::new();
        painter.render(&frame, &self.subject.settings, &never, &mut rows)?;
        let truth = Bitmap::from_rgba(frame.size, &rows)?;
        let off = |stage| {
            let drawn = Bitmap::from_rgba(frame.size, &canvas.picture(stage)?)?;
            Off::new(&truth, &drawn)
        };
        Ok([off(&stages[0])?, off(&stages[1])?, off(&stages[2])?])
    }
}
