//! Numbers of the choices, judged by those of the truth.

use std::sync::atomic::AtomicBool;
use std::time::Instant;

use pullback_compiler::SettingValue;
use pullback_compiler::lower::Precision;
use pullback_compiler::scene::Space;

use super::layout::Layout;
use super::numbers::{Number, Pictures, compare};
use super::readings::{Reading, readings};
use super::truth::Truth;
use super::{Choice, Job, Trouble, frame};
use crate::executor::{Arithmetic, Window};
use crate::trace::{GpuWatcher, watch_on_cpu};
use crate::{Capabilities, Error};

/// Parts whose numbers are compared at most: 65,536 pixels.
const MOST: usize = 64;

/// Knows the true numbers, and compares those of choices with them.
pub(super) struct Referee<'j> {
    job: &'j Job<'j>,
    readings: &'static [Reading],
    layout: Layout,
    truth: Pictures,
    /// What makes pictures of numbers in a tier, for any settings; nothing where the adapter does not take it.
    watchers: Vec<(Precision, Option<Vec<GpuWatcher>>)>,
    /// Numbers of a tier with settings: samples do not change them.
    known: Vec<(Precision, Vec<u8>, Vec<Number>)>,
}

impl<'j> Referee<'j> {
    /// The true numbers at as many parts of the picture as are done in half of the time that there is, one at least;
    /// nothing where the scene has none that are judged by themselves.
    pub(super) fn new(
        job: &'j Job<'j>,
        truth: &Truth,
        deadline: Instant,
    ) -> Result<Option<Self>, Error> {
        let readings = readings(job.picture.scene.name);
        if readings.is_empty() {
            return Ok(None);
        }
        let now = Instant::now();
        let half = now + deadline.saturating_duration_since(now) / 2;
        let settings = truth.settings();
        let mut known: Vec<Vec<Vec<[f64; 4]>>> = vec![Vec::new(); readings.len()];
        let all = &truth.layout.windows;
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let mut done = 0;
        for group in all[..all.len().min(MOST)].chunks(cores) {
            if done > 0 && Instant::now() > half {
                break;
            }
            for (reading, known) in readings.iter().zip(&mut known) {
                known.extend(true_numbers(job, settings, reading, group)?);
            }
            done += group.len();
        }
        Ok(Some(Self {
            job,
            readings,
            layout: Layout::new(all[..done].to_vec(), job.frame.size),
            truth: known.into_iter().map(|parts| parts.concat()).collect(),
            watchers: Vec::new(),
            known: Vec::new(),
        }))
    }

    /// How far a choice's numbers are from the true ones.
    pub(super) fn judge(&mut self, choice: &Choice) -> Result<Vec<Number>, Trouble> {
        let job = self.job;
        let tier = Capabilities::tier(job.gpu, choice.precision)?;
        let scene = (job.scene)(&choice.settings, tier).map_err(Trouble::Choice)?;
        let bytes = scene.pack_settings(&choice.settings);
        let same = |(precision, settings, _): &&(Precision, Vec<u8>, Vec<Number>)| {
            *precision == choice.precision && *settings == bytes
        };
        if let Some((_, _, numbers)) = self.known.iter().find(same) {
            return Ok(numbers.clone());
        }
        if !self.watchers.iter().any(|w| w.0 == choice.precision) {
            let made = self
                .readings
                .iter()
                .map(|r| GpuWatcher::new(job.gpu, &scene, r.kept));
            let made: Result<Vec<GpuWatcher>, Error> = made.collect();
            self.watchers.push((choice.precision, made.ok()));
        }
        let watchers = self.watchers.iter_mut().find(|w| w.0 == choice.precision);
        let Some((_, Some(watchers))) = watchers else {
            return Err(Trouble::Choice(
                "the adapter does not tell the numbers of this tier".to_owned(),
            ));
        };
        let frame = frame(&job.frame, &bytes, 1);
        let mut found = Pictures::new();
        for watcher in watchers {
            let parts = self.layout.cut(&watcher.rows(&frame)?, frame.size.width);
            found.push(parts.concat().iter().map(|n| n.map(f64::from)).collect());
        }
        let numbers = compare(self.readings, &self.truth, &found, self.plane());
        self.known.push((choice.precision, bytes, numbers.clone()));
        Ok(numbers)
    }

    /// Side of a pixel and height of the view in world units, of a picture of the plane.
    fn plane(&self) -> [f64; 2] {
        match self.job.picture.scene.space {
            Space::Space => [0.0; 2],
            Space::Plane | Space::Complex => [self.job.frame.pixel(), self.job.frame.view.height],
        }
    }
}

/// The true numbers of a reading at parts of the picture.
fn true_numbers(
    job: &Job,
    settings: &[SettingValue],
    reading: &Reading,
    windows: &[Window],
) -> Result<Vec<Vec<[f64; 4]>>, Error> {
    let scene = (job.scene)(settings, Precision::Double.into())
        .map_err(|reason| Error::Invalid { reason })?;
    watch_on_cpu(
        Arithmetic::Reference,
        &scene,
        &job.frame,
        settings,
        reading.kept,
        windows,
        &AtomicBool::new(false),
    )
}
