//! What was found, as a table or for programs.

use std::io::{self, Write};

use pullback_runtime::difference::{Channel, Difference, PIXELS_PER_DEGREE};
use serde::Serialize;

use super::threshold::Threshold;

/// Version of the report: the number grows when a program that reads the older one would misread the newer.
const VERSION: u32 = 1;

/// Everything about one comparison.
pub(super) struct Report<'a> {
    a: &'a str,
    b: &'a str,
    found: &'a Difference,
    thresholds: &'a [Threshold],
}

impl<'a> Report<'a> {
    pub(super) fn new(
        a: &'a str,
        b: &'a str,
        found: &'a Difference,
        thresholds: &'a [Threshold],
    ) -> Self {
        Self {
            a,
            b,
            found,
            thresholds,
        }
    }

    /// What is wrong with each limit that is not kept.
    pub(super) fn exceeded(&self) -> Vec<String> {
        let broken = self.thresholds.iter().filter(|t| !t.holds(self.found));
        broken.map(|t| t.message(self.found)).collect()
    }

    /// Writes a table to the standard output.
    pub(super) fn tell(&self) -> io::Result<()> {
        let mut out = io::BufWriter::new(io::stdout().lock());
        let Difference {
            size,
            numeric,
            perceptual,
        } = self.found;
        writeln!(out, "a  {}\nb  {}", self.a, self.b)?;
        writeln!(out, "   {}x{} pixels\n", size.width, size.height)?;
        writeln!(out, "linear light, of 1      red      green       blue")?;
        let row = |out: &mut dyn Write, title: &str, value: fn(&Channel) -> f64| {
            let [r, g, b] = numeric.channels.each_ref().map(value);
            writeln!(out, "{title:<17}{r:>10.6} {g:>10.6} {b:>10.6}")
        };
        row(&mut out, "greatest", |c| c.max)?;
        row(&mut out, "mean", |c| c.mean)?;
        row(&mut out, "root mean square", |c| c.rms)?;
        row(&mut out, "99.9 % are below", |c| c.p999)?;
        let percent = |share: f64| format!("{:.4} %", 100.0 * share);
        let [coarse, fine] = numeric.shares.map(percent);
        writeln!(out, "\npixels that differ  {}", percent(numeric.differing))?;
        writeln!(out, "by more than 1/255  {coarse}")?;
        writeln!(out, "by more than 1/512  {fine}")?;
        if numeric.psnr.is_finite() {
            writeln!(out, "PSNR of sRGB        {:.2} dB", numeric.psnr)?;
        } else {
            writeln!(out, "PSNR of sRGB        infinite: the pictures are equal")?;
        }
        let [x, y] = perceptual.worst;
        writeln!(out, "\nseen (FLIP), of 1")?;
        writeln!(out, "mean              {:>9.6}", perceptual.mean)?;
        writeln!(out, "99.9 % are below  {:>9.6}", perceptual.p999)?;
        write!(out, "greatest          {:>9.6}", perceptual.max)?;
        if perceptual.max > 0.0 {
            write!(out, "  at pixel {x},{y}")?;
        }
        writeln!(out)?;
        out.flush()
    }

    /// Writes one object to the standard output.
    pub(super) fn write_json(&self) -> io::Result<()> {
        let mut out = io::BufWriter::new(io::stdout().lock());
        serde_json::to_writer_pretty(&mut out, &self.as_json())?;
        writeln!(out)?;
        out.flush()
    }

    fn as_json(&self) -> Json<'a> {
        let Difference {
            size,
            numeric,
            perceptual,
        } = self.found;
        let [red, green, blue] = numeric.channels.each_ref().map(JsonChannel::new);
        let limit = |t: &Threshold| JsonThreshold {
            name: t.metric.name,
            limit: t.limit,
            value: Some(t.value(self.found)).filter(|v| v.is_finite()),
            holds: t.holds(self.found),
        };
        Json {
            version: VERSION,
            a: self.a,
            b: self.b,
            width: size.width,
            height: size.height,
            linear: JsonLinear { red, green, blue },
            differing: numeric.differing,
            over_255: numeric.shares[0],
            over_512: numeric.shares[1],
            psnr: Some(numeric.psnr).filter(|p| p.is_finite()),
            flip: JsonFlip {
                mean: perceptual.mean,
                p999: perceptual.p999,
                max: perceptual.max,
                worst_pixel: perceptual.worst,
                pixels_per_degree: PIXELS_PER_DEGREE.into(),
            },
            thresholds: self.thresholds.iter().map(limit).collect(),
        }
    }
}

#[derive(Serialize)]
struct Json<'a> {
    version: u32,
    a: &'a str,
    b: &'a str,
    width: u32,
    height: u32,
    linear: JsonLinear,
    differing: f64,
    over_255: f64,
    over_512: f64,
    /// None for equal pictures.
    psnr: Option<f64>,
    flip: JsonFlip,
    thresholds: Vec<JsonThreshold>,
}

#[derive(Serialize)]
struct JsonLinear {
    red: JsonChannel,
    green: JsonChannel,
    blue: JsonChannel,
}

#[derive(Serialize)]
struct JsonChannel {
    max: f64,
    mean: f64,
    rms: f64,
    p999: f64,
}

impl JsonChannel {
    fn new(channel: &Channel) -> Self {
        let Channel {
            max,
            mean,
            rms,
            p999,
        } = *channel;
        Self {
            max,
            mean,
            rms,
            p999,
        }
    }
}

#[derive(Serialize)]
struct JsonFlip {
    mean: f64,
    p999: f64,
    max: f64,
    worst_pixel: [u32; 2],
    pixels_per_degree: f64,
}

#[derive(Serialize)]
struct JsonThreshold {
    name: &'static str,
    limit: f64,
    value: Option<f64>,
    holds: bool,
}
