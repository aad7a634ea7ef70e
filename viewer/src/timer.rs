//! How long a frame takes: timestamps where the device has them, else wall time around submit and wait.

use std::time::{Duration, Instant};

use crate::gpu::{Gpu, GpuError};
use crate::renderer::Renderer;

/// Measures all passes of frames.
pub struct FrameTimer {
    queries: Option<Queries>,
    period_ns: f64,
}

struct Queries {
    set: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    back: wgpu::Buffer,
}

impl FrameTimer {
    /// A timer for this device.
    pub fn new(gpu: &Gpu) -> Self {
        let queries = gpu.has_timestamps.then(|| Queries {
            set: gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("frame"),
                ty: wgpu::QueryType::Timestamp,
                count: 2,
            }),
            resolved: gpu.buffer(&wgpu::BufferDescriptor {
                label: Some("timestamps"),
                size: 16,
                usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            }),
            back: gpu.buffer(&wgpu::BufferDescriptor {
                label: Some("timestamps back"),
                size: 16,
                usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
                mapped_at_creation: false,
            }),
        });
        Self { queries, period_ns: f64::from(gpu.queue.get_timestamp_period()) }
    }

    /// The frame begins with a compute pass.
    pub(crate) fn begins(&self) -> Option<wgpu::ComputePassTimestampWrites<'_>> {
        self.queries.as_ref().map(|queries| wgpu::ComputePassTimestampWrites {
            query_set: &queries.set,
            beginning_of_pass_write_index: Some(0),
            end_of_pass_write_index: None,
        })
    }

    /// The frame ends with this pass, which is all of it unless it was begun before.
    pub(crate) fn ends(&self, begun: bool) -> Option<wgpu::RenderPassTimestampWrites<'_>> {
        self.queries.as_ref().map(|queries| wgpu::RenderPassTimestampWrites {
            query_set: &queries.set,
            beginning_of_pass_write_index: (!begun).then_some(0),
            end_of_pass_write_index: Some(1),
        })
    }

    pub(crate) fn resolve(&self, encoder: &mut wgpu::CommandEncoder) {
        if let Some(queries) = &self.queries {
            encoder.resolve_query_set(&queries.set, 0..2, &queries.resolved, 0);
            encoder.copy_buffer_to_buffer(&queries.resolved, 0, &queries.back, 0, 16);
        }
    }

    /// Time of the frame that `draw` submits with this timer by `renderer`; waits until it is done. A device without timestamps is
    /// measured from submit to finish.
    ///
    /// # Errors
    /// What `draw` returns, or a failed device.
    pub fn time<E: From<GpuError>>(
        &self,
        renderer: &mut Renderer,
        draw: impl FnOnce(&mut Renderer, &Self) -> Result<(), E>,
    ) -> Result<Duration, E> {
        renderer.gpu.wait()?;
        let start = Instant::now();
        draw(renderer, self)?;
        let gpu = &renderer.gpu;
        let Some(queries) = &self.queries else {
            gpu.wait()?;
            return Ok(start.elapsed());
        };
        queries.back.map_async(wgpu::MapMode::Read, .., |_| ());
        gpu.wait()?;
        let ticks = {
            let mapped = queries.back.get_mapped_range(..).map_err(|error| GpuError::Failed(error.to_string()))?;
            let stamps: &[u64] = bytemuck::cast_slice(&mapped);
            stamps[1].saturating_sub(stamps[0])
        };
        queries.back.unmap();
        Ok(Duration::from_nanos((ticks as f64 * self.period_ns) as u64))
    }
}
