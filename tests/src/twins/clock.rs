//! Timestamps of a device.

use std::sync::mpsc;

use pullback_runtime::{Error, Gpu};

/// Two timestamps around a pass.
#[derive(Debug)]
pub(super) struct Clock {
    pub queries: wgpu::QuerySet,
    pub resolved: wgpu::Buffer,
    pub readable: wgpu::Buffer,
    seconds: f64,
}

impl Clock {
    /// None where there are none. Those of software adapters say little; they are timed from outside.
    pub(super) fn new(gpu: &Gpu) -> Option<Self> {
        let device = gpu.device();
        let offered = device.features().contains(wgpu::Features::TIMESTAMP_QUERY);
        if gpu.adapter().is_software() || !offered {
            return None;
        }
        let buffer = |usage| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: None,
                size: 16,
                usage: usage | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        Some(Self {
            queries: device.create_query_set(&wgpu::QuerySetDescriptor {
                label: None,
                ty: wgpu::QueryType::Timestamp,
                count: 2,
            }),
            resolved: buffer(wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC),
            readable: buffer(wgpu::BufferUsages::MAP_READ),
            seconds: f64::from(gpu.queue().get_timestamp_period()) * 1e-9,
        })
    }

    /// Seconds between the timestamps of the last submission.
    pub(super) fn read(&self, gpu: &Gpu) -> Result<f64, Error> {
        let bytes = read(gpu, &self.readable)?;
        let ticks = bytes.as_chunks::<8>().0;
        let [start, end] = [0, 1].map(|k| ticks.get(k).map_or(0, |t| u64::from_le_bytes(*t)));
        Ok(end.saturating_sub(start) as f64 * self.seconds)
    }
}

/// Waits for the device, and copies the bytes of a buffer.
pub(super) fn read(gpu: &Gpu, buffer: &wgpu::Buffer) -> Result<Vec<u8>, Error> {
    let during = "reading";
    let failed = |reason: String| Error::Device { during, reason };
    let (sender, receiver) = mpsc::channel();
    buffer.map_async(wgpu::MapMode::Read, .., move |mapped| {
        // nobody waits any more where the device has failed
        let _ = sender.send(mapped);
    });
    let submission = gpu.queue().submit([]);
    gpu.wait(during, submission)?;
    receiver
        .recv()
        .map_err(|error| failed(error.to_string()))?
        .map_err(|error| failed(error.to_string()))?;
    let seen = buffer
        .slice(..)
        .get_mapped_range()
        .map_err(|error| failed(error.to_string()))?
        .to_vec();
    buffer.unmap();
    Ok(seen)
}
