//! Which buffers and textures the passes bind: group 0 the frame's records (view and placement, material, line style), 1 the
//! mesh where it stands, for passes that look at faces, 2 the map or the lines, 3 how patches turn.

use std::sync::OnceLock;

use super::Gpu;

/// The bind group layouts of all passes.
pub(crate) struct Layouts {
    device: wgpu::Device,
    pub frame: wgpu::BindGroupLayout,
    pub map: wgpu::BindGroupLayout,
    pub surface: wgpu::BindGroupLayout,
    storage: OnceLock<StorageLayouts>,
}

/// Those with storage buffers, which not every device has: of passes that look at faces, and of lines.
pub(crate) struct StorageLayouts {
    pub mesh: wgpu::BindGroupLayout,
    pub face_geometry: wgpu::BindGroupLayout,
    pub face_frames: wgpu::BindGroupLayout,
    /// Of the mesh, what lines are found and drawn by.
    pub line_mesh: wgpu::BindGroupLayout,
    pub line_edges: wgpu::BindGroupLayout,
    pub lines: wgpu::BindGroupLayout,
}

const VERTEX: wgpu::ShaderStages = wgpu::ShaderStages::VERTEX;
const FRAGMENT: wgpu::ShaderStages = wgpu::ShaderStages::FRAGMENT;
const BOTH: wgpu::ShaderStages = wgpu::ShaderStages::VERTEX_FRAGMENT;
const COMPUTE: wgpu::ShaderStages = wgpu::ShaderStages::COMPUTE;

impl Layouts {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        let layout = |label, entries: &[wgpu::BindGroupLayoutEntry]| layout(&gpu.device, label, entries);
        let texture = |binding, dimension, filterable| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: FRAGMENT,
            ty: wgpu::BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Float { filterable },
                view_dimension: dimension,
                multisampled: false,
            },
            count: None,
        };
        let sampler = wgpu::BindGroupLayoutEntry {
            binding: 1,
            visibility: FRAGMENT,
            ty: wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
            count: None,
        };
        let maps = wgpu::TextureViewDimension::D2Array;
        let tables = wgpu::TextureViewDimension::D2;
        let frame_stages = if gpu.has_storage() { BOTH | COMPUTE } else { BOTH };
        Self {
            frame: layout("frame", &[uniform(0, frame_stages), uniform(1, BOTH), uniform(2, frame_stages)]),
            map: layout("map", &[texture(0, maps, true), sampler, texture(2, tables, false)]),
            surface: layout("surface", &[texture(2, tables, false)]),
            device: gpu.device.clone(),
            storage: OnceLock::new(),
        }
    }

    /// Those with storage buffers, made when first asked for.
    pub(crate) fn storage(&self) -> &StorageLayouts {
        self.storage.get_or_init(|| StorageLayouts::new(&self.device))
    }
}

impl StorageLayouts {
    fn new(device: &wgpu::Device) -> Self {
        let layout = |label, entries: &[wgpu::BindGroupLayoutEntry]| layout(device, label, entries);
        // At most eight storage buffers a stage, which every WebGPU adapter binds.
        let mesh = [
            storage(0, VERTEX),
            storage(2, VERTEX),
            storage(3, BOTH),
            storage(4, FRAGMENT),
            storage(5, FRAGMENT),
            storage(6, BOTH),
        ];
        Self {
            mesh: layout("mesh", &mesh),
            face_geometry: layout("face_geometry", &[storage(0, COMPUTE), storage(2, COMPUTE), written(3), written(4)]),
            face_frames: layout("face_frames", &[storage(0, COMPUTE), storage(2, COMPUTE), written(3), written(5)]),
            line_mesh: layout("line_mesh", &[storage(0, VERTEX | COMPUTE), storage(4, VERTEX | COMPUTE)]),
            line_edges: layout("line_edges", &[storage(0, COMPUTE), written(1), written(2), written(3), written(4)]),
            lines: layout("lines", &[storage(0, VERTEX), storage(1, VERTEX)]),
        }
    }
}

fn layout(device: &wgpu::Device, label: &str, entries: &[wgpu::BindGroupLayoutEntry]) -> wgpu::BindGroupLayout {
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries })
}

fn buffer(binding: u32, visibility: wgpu::ShaderStages, ty: wgpu::BufferBindingType) -> wgpu::BindGroupLayoutEntry {
    let ty = wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None };
    wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None }
}

fn storage(binding: u32, visibility: wgpu::ShaderStages) -> wgpu::BindGroupLayoutEntry {
    buffer(binding, visibility, wgpu::BufferBindingType::Storage { read_only: true })
}

fn written(binding: u32) -> wgpu::BindGroupLayoutEntry {
    buffer(binding, COMPUTE, wgpu::BufferBindingType::Storage { read_only: false })
}

/// A record, bound with an offset.
fn uniform(binding: u32, visibility: wgpu::ShaderStages) -> wgpu::BindGroupLayoutEntry {
    let ty = wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Uniform,
        has_dynamic_offset: true,
        min_binding_size: None,
    };
    wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None }
}
