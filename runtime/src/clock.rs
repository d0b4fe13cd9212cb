//! The time that a pass takes on the device, by its own clock.

use std::sync::mpsc;

use crate::{Error, Gpu};

/// Two timestamps of the device, around a pass.
#[derive(Debug)]
pub(crate) struct Clock {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    readable: wgpu::Buffer,
    seconds: f64,
}

impl Clock {
    /// `None` where the device has none. Software adapters have one that says little; they are timed from outside.
    pub(crate) fn new(gpu: &Gpu) -> Result<Option<Self>, Error> {
        let device = gpu.device();
        if gpu.adapter().is_software()
            || !device.features().contains(wgpu::Features::TIMESTAMP_QUERY)
        {
            return Ok(None);
        }
        let buffer = |usage| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("timestamps"),
                size: 16,
                usage: usage | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        gpu.guarded("allocation", || Self {
            queries: device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("timestamps"),
                ty: wgpu::QueryType::Timestamp,
                count: 2,
            }),
            resolved: buffer(wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC),
            readable: buffer(wgpu::BufferUsages::MAP_READ),
            seconds: f64::from(gpu.queue().get_timestamp_period()) * 1e-9,
        })
        .map(Some)
    }

    /// Has both timestamps written, at the beginning and at the end of a pass.
    pub(crate) fn around(&self) -> wgpu::ComputePassTimestampWrites<'_> {
        wgpu::ComputePassTimestampWrites {
            query_set: &self.queries,
            beginning_of_pass_write_index: Some(0),
            end_of_pass_write_index: Some(1),
        }
    }

    /// Makes them readable, after the pass.
    pub(crate) fn resolve(&self, encoder: &mut wgpu::CommandEncoder) {
        encoder.resolve_query_set(&self.queries, 0..2, &self.resolved, 0);
        encoder.copy_buffer_to_buffer(&self.resolved, 0, &self.readable, 0, 16);
    }

    /// Seconds between the two timestamps of the last submission.
    pub(crate) fn read(&self, gpu: &Gpu) -> Result<f64, Error> {
        let during = "reading timestamps";
        let failed = |reason: String| Error::Device { during, reason };
        let (sender, receiver) = mpsc::channel();
        let submission = gpu.guarded(during, || {
            let report = move |mapped| {
                let _ = sender.send(mapped);
            };
            self.readable.map_async(wgpu::MapMode::Read, .., report);
            gpu.queue().submit([])
        })?;
        gpu.wait(during, submission)?;
        receiver
            .try_recv()
            .map_err(|error| failed(error.to_string()))?
            .map_err(|error| failed(error.to_string()))?;
        let ticks = {
            let view = self
                .readable
                .slice(..)
                .get_mapped_range()
                .map_err(|error| failed(error.to_string()))?;
            let word = |k: usize| bytemuck::pod_read_unaligned::<u64>(&view[8 * k..8 * k + 8]);
            word(1).saturating_sub(word(0))
        };
        self.readable.unmap();
        Ok(ticks as f64 * self.seconds)
    }
}
