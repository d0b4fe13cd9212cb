//! Buffers on the device, and how their bytes come back.

use std::sync::mpsc;
use std::time::Duration;

use crate::{Error, Gpu};

/// A buffer that is made anew when more room is needed than it has.
#[derive(Debug)]
pub(crate) struct Growing {
    label: &'static str,
    usage: wgpu::BufferUsages,
    buffer: Option<wgpu::Buffer>,
}

impl Growing {
    /// Shaders write it, and it is copied from.
    pub(crate) fn results() -> Self {
        Self::new(
            "results",
            wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        )
    }

    /// Shaders add to what is in it, and it is cleared and copied from.
    pub(crate) fn sums() -> Self {
        Self::new(
            "sums",
            wgpu::BufferUsages::STORAGE
                | wgpu::BufferUsages::COPY_SRC
                | wgpu::BufferUsages::COPY_DST,
        )
    }

    /// Shaders read it, and it is written from here.
    pub(crate) fn inputs() -> Self {
        Self::new(
            "inputs",
            wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
        )
    }

    /// Copied to, and read from here.
    pub(crate) fn readable() -> Self {
        Self::new(
            "readable",
            wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        )
    }

    fn new(label: &'static str, usage: wgpu::BufferUsages) -> Self {
        Self {
            label,
            usage,
            buffer: None,
        }
    }

    /// The buffer, with room for `bytes`; `true` if it is new.
    pub(crate) fn at_least(
        &mut self,
        gpu: &Gpu,
        bytes: u64,
    ) -> Result<(wgpu::Buffer, bool), Error> {
        if let Some(buffer) = &self.buffer
            && buffer.size() >= bytes
        {
            return Ok((buffer.clone(), false));
        }
        self.buffer = None;
        let buffer = gpu.guarded("allocation", || {
            gpu.device().create_buffer(&wgpu::BufferDescriptor {
                label: Some(self.label),
                size: bytes,
                usage: self.usage,
                mapped_at_creation: false,
            })
        })?;
        self.buffer = Some(buffer.clone());
        Ok((buffer, true))
    }
}

/// A place of a compute shader's bindings for a buffer of any size.
pub(crate) const fn binding(
    binding: u32,
    ty: wgpu::BufferBindingType,
) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer {
            ty,
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    }
}

/// A uniform buffer of `bytes` bytes.
pub(crate) fn uniform(gpu: &Gpu, label: &'static str, bytes: usize) -> Result<wgpu::Buffer, Error> {
    fixed(gpu, label, bytes, wgpu::BufferUsages::UNIFORM)
}

/// The buffer of [`WideWords`](crate::uniforms::WideWords), which shaders read as storage.
pub(crate) fn wide(gpu: &Gpu) -> Result<wgpu::Buffer, Error> {
    let bytes = size_of::<crate::uniforms::WideWords>();
    fixed(gpu, "wide", bytes, wgpu::BufferUsages::STORAGE)
}

/// The words of a mesh, which shaders read as storage; room for a header where there is none.
pub(crate) fn mesh(gpu: &Gpu, words: &[[u32; 4]]) -> Result<wgpu::Buffer, Error> {
    let bytes = size_of_val(words).max(16);
    let buffer = fixed(gpu, "mesh", bytes, wgpu::BufferUsages::STORAGE)?;
    gpu.guarded("upload", || {
        gpu.queue()
            .write_buffer(&buffer, 0, bytemuck::cast_slice(words));
    })?;
    Ok(buffer)
}

fn fixed(
    gpu: &Gpu,
    label: &'static str,
    bytes: usize,
    usage: wgpu::BufferUsages,
) -> Result<wgpu::Buffer, Error> {
    gpu.guarded("allocation", || {
        gpu.device().create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: bytes as u64,
            usage: usage | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        })
    })
}

/// Longest time from the end of the device's work to the news of it.
const TELLING: Duration = Duration::from_secs(10);

/// Submits `encoder`, waits, and shows `bytes` bytes of `readable` to `look`.
pub(crate) fn submit_and_read<T>(
    gpu: &Gpu,
    during: &'static str,
    encoder: wgpu::CommandEncoder,
    readable: &wgpu::Buffer,
    bytes: u64,
    look: impl FnOnce(&[u8]) -> T,
) -> Result<T, Error> {
    let slice = readable.slice(..bytes);
    let (sender, receiver) = mpsc::channel();
    let submission = gpu.guarded(during, || {
        let submission = gpu.queue().submit([encoder.finish()]);
        slice.map_async(wgpu::MapMode::Read, move |mapped| {
            // The receiver is gone only if waiting failed, and that error is the one to report.
            let _ = sender.send(mapped);
        });
        submission
    })?;
    gpu.wait(during, submission)?;
    let failed = |reason: String| Error::Device { during, reason };
    // Another thread that waits on the same device may be the one that is about to tell it.
    match receiver.recv_timeout(TELLING) {
        Ok(Ok(())) => {}
        Ok(Err(error)) => return Err(failed(error.to_string())),
        Err(_) => return Err(failed("the results never came back".into())),
    }
    let seen = {
        let view = slice
            .get_mapped_range()
            .map_err(|error| failed(error.to_string()))?;
        look(&view)
    };
    readable.unmap();
    Ok(seen)
}
