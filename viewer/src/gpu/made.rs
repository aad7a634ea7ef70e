//! Making things on a device, counted: a frame in which only the camera moved makes nothing.

use std::sync::atomic::{AtomicU64, Ordering};

use wgpu::util::DeviceExt as _;

use super::Gpu;

/// How much was made on a device so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Made {
    /// Buffers.
    pub buffers: u64,
    /// Textures.
    pub textures: u64,
    /// Bind groups.
    pub bind_groups: u64,
    /// Pipelines, of drawing and of computing.
    pub pipelines: u64,
}

/// The same, while it is counted.
#[derive(Default)]
pub(super) struct Counts {
    buffers: AtomicU64,
    textures: AtomicU64,
    bind_groups: AtomicU64,
    pipelines: AtomicU64,
}

fn count(of: &AtomicU64) {
    of.fetch_add(1, Ordering::Relaxed);
}

#[expect(clippy::disallowed_methods, reason = "this is where all that is made is counted")]
impl Gpu {
    /// What was made on the device since it was opened or shared, all renderers and targets on it together.
    pub fn made(&self) -> Made {
        let of = |count: &AtomicU64| count.load(Ordering::Relaxed);
        let Counts { buffers, textures, bind_groups, pipelines } = &*self.counts;
        Made { buffers: of(buffers), textures: of(textures), bind_groups: of(bind_groups), pipelines: of(pipelines) }
    }

    pub(crate) fn buffer(&self, descriptor: &wgpu::BufferDescriptor<'_>) -> wgpu::Buffer {
        count(&self.counts.buffers);
        self.device.create_buffer(descriptor)
    }

    pub(crate) fn buffer_of(&self, descriptor: &wgpu::util::BufferInitDescriptor<'_>) -> wgpu::Buffer {
        count(&self.counts.buffers);
        self.device.create_buffer_init(descriptor)
    }

    pub(crate) fn texture(&self, descriptor: &wgpu::TextureDescriptor<'_>) -> wgpu::Texture {
        count(&self.counts.textures);
        self.device.create_texture(descriptor)
    }

    pub(crate) fn bind_group(&self, descriptor: &wgpu::BindGroupDescriptor<'_>) -> wgpu::BindGroup {
        count(&self.counts.bind_groups);
        self.device.create_bind_group(descriptor)
    }

    pub(crate) fn render_pipeline(&self, descriptor: &wgpu::RenderPipelineDescriptor<'_>) -> wgpu::RenderPipeline {
        count(&self.counts.pipelines);
        self.device.create_render_pipeline(descriptor)
    }

    pub(crate) fn compute_pipeline(&self, descriptor: &wgpu::ComputePipelineDescriptor<'_>) -> wgpu::ComputePipeline {
        count(&self.counts.pipelines);
        self.device.create_compute_pipeline(descriptor)
    }
}
