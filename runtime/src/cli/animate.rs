//! `pullback render --frames`: many pictures of one scene, by changing its numbers.

use std::path::Path;

use clap::Args;
use pullback_compiler::{Picture, Program, SceneModule, SettingValue};
use pullback_runtime::animation::{self, Clip, Container, MAX_FRAMES, Sweep};
use pullback_runtime::image_file::{Alpha, Format};
use pullback_runtime::{Error, Frame, Metadata, RowSink, Size, View, image_file};

use super::failure::Failure;
use super::overrides::{self, Assignment};
use super::progress::Progress;
use super::render::Artist;

/// Most frames in a second.
const MAX_RATE: f64 = 1000.0;

/// How a picture moves.
#[derive(Clone, Debug, Args)]
pub(super) struct Animation {
    /// Draw this many pictures: into one file if its name ends in .gif or .apng, else into numbered ones
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_FRAMES)))]
    frames: Option<u32>,
    /// What runs: a parameter, a setting of one number, or `time`; without it the clock does
    #[arg(
        long,
        value_name = "NAME=FROM..TO",
        requires = "frames",
        allow_hyphen_values = true
    )]
    sweep: Vec<Sweep>,
    /// Frames in a second
    #[arg(long, value_name = "R", default_value_t = 25.0, value_parser = rate)]
    rate: f64,
    /// Leave out the last picture of the sweeps, which is the first of the next round
    #[arg(long = "loop", requires = "frames")]
    is_closed: bool,
}

/// What all frames have in common.
pub(super) struct Reel<'a> {
    pub(super) program: &'a Program,
    pub(super) scene: &'a SceneModule,
    pub(super) settings: &'a [SettingValue],
    /// The picture that is drawn where nothing moves.
    pub(super) still: Frame<'a>,
}

/// The numbers of one frame.
pub(super) struct Moment {
    pub(super) params: Vec<f64>,
    pub(super) settings: Vec<SettingValue>,
    pub(super) view: View,
    pub(super) time: f64,
}

impl Animation {
    /// How many frames are wanted; none for a still picture.
    pub(super) fn frames(&self, path: &Path) -> Result<Option<u32>, Failure> {
        if self.frames.is_none() && Container::of(path).is_some() {
            return Err(Failure::usage_hint(
                format!(
                    "{} holds an animation, and --frames is not given",
                    super::render::name(path)
                ),
                "give --frames 60, or a name that ends in .png",
            ));
        }
        Ok(self.frames)
    }

    /// Whether all frames have the settings of the first.
    pub(super) fn keeps_settings(&self, picture: &Picture) -> bool {
        let mut sweeps = self.sweep.iter();
        sweeps.all(|sweep| picture.scene.setting(&sweep.name).is_none())
    }

    /// The numbers of a frame.
    pub(super) fn moment(&self, reel: &Reel, frame: u32, frames: u32) -> Result<Moment, Failure> {
        let mut moment = Moment {
            params: reel.still.params.to_vec(),
            settings: reel.settings.to_vec(),
            view: reel.still.view,
            time: reel.still.time,
        };
        if self.sweep.is_empty() {
            moment.time += f64::from(frame) / self.rate;
        }
        let part = animation::part(frame, frames, self.is_closed);
        for sweep in &self.sweep {
            let value = sweep.value(part);
            if sweep.name == "time" {
                moment.time = value;
                continue;
            }
            let assignment = Assignment::number(&sweep.name, value);
            overrides::assign(
                &assignment,
                reel.program,
                &mut moment.params,
                &mut moment.settings,
            )?;
            if sweep.name == "height" {
                moment.view.height = value;
            }
        }
        Ok(moment)
    }

    /// Draws all frames into the file or files of this name.
    pub(super) fn write(
        &self,
        reel: &Reel,
        frames: u32,
        artist: &mut Artist,
        output: (&Path, (Format, Alpha), &Metadata),
        progress: &mut Progress,
    ) -> Result<(), Failure> {
        let (path, format, metadata) = output;
        // every number is looked at before the first picture is drawn
        for frame in 0..frames {
            self.moment(reel, frame, frames)?;
        }
        let mut refused = None;
        let mut draw = |number: u32, sink: &mut dyn RowSink| {
            let moment = match self.moment(reel, number, frames) {
                Ok(moment) => moment,
                Err(failure) => {
                    refused = Some(failure);
                    return Err(Error::Invalid {
                        reason: "a number of the animation".into(),
                    });
                }
            };
            let bytes = reel.scene.pack_settings(&moment.settings);
            let frame = Frame {
                view: moment.view,
                params: &moment.params,
                settings: &bytes,
                time: moment.time,
                ..reel.still.clone()
            };
            artist.render(&frame, &moment.settings, sink)?;
            progress.update(u64::from(number) + 1, u64::from(frames));
            Ok(())
        };
        let written = match Container::of(path) {
            Some(container) => {
                let clip = Clip {
                    size: reel.still.size,
                    frames,
                    rate: self.rate,
                };
                animation::write(path, container, clip, &mut |number| {
                    let mut pixels = Vec::with_capacity(bytes_of(clip.size));
                    draw(number, &mut pixels)?;
                    Ok(pixels)
                })
            }
            None => (0..frames).try_for_each(|number| {
                let file = animation::frame_path(path, number, frames);
                let size = reel.still.size;
                image_file::write(&file, format, size, metadata, |sink| draw(number, sink))
            }),
        };
        match refused {
            Some(failure) => Err(failure),
            None => written.map_err(Failure::writing(&super::render::name(path))),
        }
    }
}

/// Bytes of a frame.
fn bytes_of(size: Size) -> usize {
    size.width as usize * size.height as usize * 4
}

/// Frames in a second.
fn rate(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|rate| (0.01..=MAX_RATE).contains(rate))
        .ok_or_else(|| format!("must be a number from 0.01 to {MAX_RATE}"))
}
