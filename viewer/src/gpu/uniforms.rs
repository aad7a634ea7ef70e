//! What passes are told of views, objects, materials and lines: bind group 0, records behind each other in buffers that
//! grow, bound with offsets.

use tam_shaders::types;

use super::{Gpu, Layouts};

/// Offsets of uniform records are multiples of this on any adapter.
const ALIGNMENT: usize = 256;

/// Records there is room for at first.
const ROOM: usize = 16;

/// The records of a frame on the GPU.
pub(crate) struct Uniforms {
    scenes: Records,
    materials: Records,
    styles: Records,
    group: wgpu::BindGroup,
}

/// Where the records of a draw stand in the buffers, in bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Offsets {
    /// Of the view and the placement.
    pub scene: u32,
    /// Of the material.
    pub material: u32,
    /// Of the line style.
    pub style: u32,
}

impl Offsets {
    /// As the group takes them.
    pub(crate) fn of_group(self) -> [u32; 3] {
        [self.scene, self.material, self.style]
    }
}

impl Uniforms {
    pub(crate) fn new(gpu: &Gpu, layouts: &Layouts) -> Self {
        let scenes = Records::new(gpu, "scenes", size_of::<types::Scene>());
        let materials = Records::new(gpu, "materials", size_of::<types::Material>());
        let styles = Records::new(gpu, "line styles", size_of::<types::LineStyle>());
        let group = group(gpu, layouts, [&scenes, &materials, &styles]);
        Self { scenes, materials, styles, group }
    }

    /// Forgets the records of the frame before.
    pub(crate) fn clear(&mut self) {
        for records in [&mut self.scenes, &mut self.materials, &mut self.styles] {
            records.staging.clear();
        }
    }

    /// Adds a view of an object; its offset.
    pub(crate) fn scene(&mut self, scene: &types::Scene) -> u32 {
        self.scenes.push(bytemuck::bytes_of(scene))
    }

    /// Adds a material; its offset.
    pub(crate) fn material(&mut self, material: &types::Material) -> u32 {
        self.materials.push(bytemuck::bytes_of(material))
    }

    /// Adds a line style; its offset.
    pub(crate) fn style(&mut self, style: &types::LineStyle) -> u32 {
        self.styles.push(bytemuck::bytes_of(style))
    }

    /// Writes all records, in larger buffers where there are more than ever before.
    pub(crate) fn write(&mut self, gpu: &Gpu, layouts: &Layouts) {
        let mut grown = false;
        for records in [&mut self.scenes, &mut self.materials, &mut self.styles] {
            grown |= records.write(gpu);
        }
        if grown {
            self.group = group(gpu, layouts, [&self.scenes, &self.materials, &self.styles]);
        }
    }

    pub(crate) fn group(&self) -> &wgpu::BindGroup {
        &self.group
    }
}

/// Records of one kind.
struct Records {
    label: &'static str,
    buffer: wgpu::Buffer,
    record_bytes: usize,
    staging: Vec<u8>,
}

impl Records {
    fn new(gpu: &Gpu, label: &'static str, record_bytes: usize) -> Self {
        let buffer = buffer(gpu, label, ROOM * record_bytes.next_multiple_of(ALIGNMENT));
        Self { label, buffer, record_bytes, staging: Vec::new() }
    }

    fn push(&mut self, record: &[u8]) -> u32 {
        let offset = self.staging.len();
        self.staging.extend_from_slice(record);
        self.staging.resize(offset + self.record_bytes.next_multiple_of(ALIGNMENT), 0);
        offset as u32
    }

    /// Whether the buffer had to grow.
    fn write(&mut self, gpu: &Gpu) -> bool {
        let grows = self.staging.len() as u64 > self.buffer.size();
        if grows {
            self.buffer = buffer(gpu, self.label, self.staging.len().next_power_of_two());
        }
        if !self.staging.is_empty() {
            gpu.queue.write_buffer(&self.buffer, 0, &self.staging);
        }
        grows
    }

    fn binding(&self) -> wgpu::BindingResource<'_> {
        wgpu::BindingResource::Buffer(wgpu::BufferBinding {
            buffer: &self.buffer,
            offset: 0,
            size: std::num::NonZeroU64::new(self.record_bytes as u64),
        })
    }
}

fn buffer(gpu: &Gpu, label: &'static str, bytes: usize) -> wgpu::Buffer {
    gpu.buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size: bytes as u64,
        usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

fn group(gpu: &Gpu, layouts: &Layouts, records: [&Records; 3]) -> wgpu::BindGroup {
    let numbered = (0..).zip(records);
    let entries: Vec<_> =
        numbered.map(|(binding, records)| wgpu::BindGroupEntry { binding, resource: records.binding() }).collect();
    gpu.bind_group(&wgpu::BindGroupDescriptor { label: Some("frame"), layout: &layouts.frame, entries: &entries })
}
