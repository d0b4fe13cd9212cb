//! The buffers of one invocation.

use pullback_compiler::EvalModule;
use pullback_compiler::lower::Tier;

use crate::evaluate::Surroundings;
use crate::render::view_uniform;
use crate::tiles::Tile;
use crate::uniforms::{self, BatchUniform, WideWords};
use crate::{Error, Frame};

/// Words of a trace: room for some hundred thousand events.
pub(super) const ROOM: u32 = 1 << 20;
/// Words behind them, for what there is no room for.
const SPARE: u32 = 8;
/// Where a traced shader tells its values.
pub(super) const TRACE: u32 = 6;

/// What a buffer is to a shader.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Access {
    /// `var<uniform>`
    Uniform,
    /// `var<storage, read>`
    Read,
    /// `var<storage, read_write>`
    ReadWrite,
}

/// A buffer of group 0, as it is before the shader runs.
#[derive(Clone, Debug)]
pub struct Buffer {
    /// Its number.
    pub binding: u32,
    /// What the shader does with it.
    pub access: Access,
    /// What it holds.
    pub bytes: Vec<u8>,
}

/// Everything that a traced shader reads and writes, numbered from 0 without gaps. The first invocation of the entry
/// point `compute_main` computes something, all others return.
#[derive(Clone, Debug)]
pub struct Inputs {
    /// In the order of their numbers.
    pub buffers: Vec<Buffer>,
    /// What the shader was compiled for.
    pub tier: Tier,
}

impl Inputs {
    /// Those of a scene, for one pixel of a picture: column and row from the top left.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the pixel is not in the picture.
    pub fn pixel(frame: &Frame, tier: Tier, pixel: [u32; 2]) -> Result<Self, Error> {
        check(frame, pixel)?;
        let [x, y] = pixel;
        let tile = Tile {
            x,
            y,
            width: 1,
            height: 1,
        };
        let view = view_uniform(frame, tile);
        let wide = WideWords::new(
            tier.precision.format(),
            frame.view.center,
            frame.time,
            frame.pixel(),
            frame.params,
        );
        let params = uniforms::params(frame.params);
        Ok(Self::new(
            tier,
            [
                (Access::Uniform, bytemuck::bytes_of(&view).to_vec()),
                (Access::Uniform, bytemuck::bytes_of(&params).to_vec()),
                (Access::Uniform, frame.settings.to_vec()),
                (Access::Read, bytemuck::bytes_of(&wide).to_vec()),
                // a scene without a mesh
                (Access::Read, vec![0; 16]),
                (Access::ReadWrite, vec![0; 4]),
            ],
        ))
    }

    /// Those of an evaluation, for one row of numbers.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the row has not as many numbers as the module has inputs.
    pub fn row(module: &EvalModule, around: Surroundings, row: &[f64]) -> Result<Self, Error> {
        let columns = module.inputs.len();
        if row.len() != columns {
            return Err(Error::Invalid {
                reason: format!(
                    "{} numbers for a function of {}",
                    row.len(),
                    module.inputs.join(", ")
                ),
            });
        }
        let format = module.tier.precision.format();
        let width = if format.is_wide() { 2 } else { 1 };
        let words: Vec<u32> = row
            .iter()
            .flat_map(|&x| format.words(x).into_iter().take(width))
            .collect();
        let batch = BatchUniform {
            count: 1,
            zero: 0,
            time: around.time as f32,
            pixel: around.pixel as f32,
            columns: columns as u32,
            results: module.outputs.len() as u32,
        };
        let wide = WideWords::new(format, [0.0; 2], around.time, around.pixel, around.params);
        let params = uniforms::params(around.params);
        let results = module.outputs.len().max(1) * width * 4;
        let mut rows = bytemuck::cast_slice(&words).to_vec();
        // an empty array has a binding, too
        rows.resize(rows.len().max(8), 0);
        Ok(Self::new(
            module.tier,
            [
                (Access::Read, rows),
                (Access::Uniform, bytemuck::bytes_of(&params).to_vec()),
                (Access::ReadWrite, vec![0; results]),
                (Access::Read, bytemuck::bytes_of(&wide).to_vec()),
                (Access::Uniform, bytemuck::bytes_of(&batch).to_vec()),
                // the place of a scene's image
                (Access::ReadWrite, vec![0; 4]),
            ],
        ))
    }

    fn new(tier: Tier, own: [(Access, Vec<u8>); 6]) -> Self {
        let trace = (Access::ReadWrite, vec![0; (ROOM + SPARE) as usize * 4]);
        let all = (0..).zip(own.into_iter().chain([trace]));
        let buffers = all.map(|(binding, (access, bytes))| Buffer {
            binding,
            access,
            bytes,
        });
        Self {
            buffers: buffers.collect(),
            tier,
        }
    }
}

/// Whether a pixel is in the picture.
pub(super) fn check(frame: &Frame, [x, y]: [u32; 2]) -> Result<(), Error> {
    let size = frame.size;
    if x < size.width && y < size.height {
        return Ok(());
    }
    Err(Error::Invalid {
        reason: format!(
            "pixel {x},{y} is not in a picture of {}x{} pixels",
            size.width, size.height
        ),
    })
}
