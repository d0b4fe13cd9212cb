//! Looking for pixels at which a formula's value is NaN or infinite.

use std::io;

use pullback_compiler::SceneModule;
use pullback_compiler::module::DEMANDS;

use super::Traced;
use super::instrument::Detail;
use super::recorders::Entry;
use crate::{Error, Frame, Gpu, Pipeline, Renderer, RowSink, Size};

const SCAN: &str = include_str!("scan.wgsl");
const NAN: u8 = 1;
const INFINITE: u8 = 2;

/// Where in a picture the formula, or a derivative that its scene asks for, gave something else than a number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Oddities {
    /// Of the picture.
    pub size: Size,
    flags: Vec<u8>,
}

impl Oddities {
    /// Pixels at which something was NaN, rows from top to bottom.
    pub fn nans(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        self.places(NAN)
    }

    /// Pixels at which something was infinite, and nothing was NaN.
    pub fn infinities(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        self.places(INFINITE)
    }

    fn places(&self, wanted: u8) -> impl Iterator<Item = [u32; 2]> + '_ {
        let width = self.size.width.max(1) as usize;
        let kind = |flags: u8| {
            if flags & NAN == 0 {
                flags & INFINITE
            } else {
                NAN
            }
        };
        let found = self.flags.iter().enumerate();
        let found = found.filter(move |&(_, &flags)| kind(flags) == wanted);
        found.map(move |(at, _)| [(at % width) as u32, (at / width) as u32])
    }
}

/// Computes a picture at the middle of each pixel, and looks at every value of the formula on the way.
///
/// # Errors
/// As [`Renderer::render`].
pub fn scan(
    gpu: &Gpu,
    scene: &SceneModule,
    frame: &Frame,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<Oddities, Error> {
    let traced = Traced::with_recorders(
        &scene.module,
        (SCAN, Entry::Recorders),
        scene.tier,
        "",
        |name| {
            if DEMANDS.contains(&name) {
                Detail::Result
            } else {
                Detail::Nothing
            }
        },
    )?;
    let mut scene = scene.clone();
    (scene.module, scene.info) = (traced.module, traced.info);
    let frame = Frame {
        samples: 1,
        pipeline: Pipeline::Compute,
        ..frame.clone()
    };
    let mut sink = Flags {
        flags: Vec::new(),
        progress,
    };
    Renderer::new(gpu, &scene)?.render(&frame, &mut sink)?;
    Ok(Oddities {
        size: frame.size,
        flags: sink.flags,
    })
}

struct Flags<'a> {
    flags: Vec<u8>,
    progress: &'a mut dyn FnMut(u64, u64),
}

impl RowSink for Flags<'_> {
    fn rows(&mut self, rgba: &[u8]) -> io::Result<()> {
        let words = rgba.as_chunks::<4>().0.iter();
        self.flags.extend(words.map(|&[flags, ..]| flags));
        Ok(())
    }

    fn progress(&mut self, done: u64, total: u64) {
        (self.progress)(done, total);
    }
}
