//! Which buffers and textures the passes bind: group 0 the scene, 1 the mesh, 2 material and map, 3 the surface.

use super::Gpu;

/// The bind group layouts of all passes.
pub(crate) struct Layouts {
    pub scene: wgpu::BindGroupLayout,
    pub mesh: wgpu::BindGroupLayout,
    pub material: wgpu::BindGroupLayout,
    pub surface: wgpu::BindGroupLayout,
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
        let layout = |label, entries: &[wgpu::BindGroupLayoutEntry]| {
            gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries })
        };
        // At most eight storage buffers a stage, which every WebGPU adapter binds.
        let mesh = [
            storage(0, VERTEX),
            storage(1, VERTEX),
            storage(2, VERTEX),
            storage(3, BOTH),
            storage(4, BOTH),
            storage(5, FRAGMENT),
            storage(6, BOTH),
            storage(7, VERTEX),
        ];
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
            binding: 2,
            visibility: FRAGMENT,
            ty: wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
            count: None,
        };
        let maps = wgpu::TextureViewDimension::D2Array;
        let tables = wgpu::TextureViewDimension::D2;
        Self {
            scene: layout("scene", &[uniform(0, BOTH | COMPUTE, false)]),
            mesh: layout("mesh", &mesh),
            material: layout(
                "material",
                &[uniform(0, BOTH, true), texture(1, maps, true), sampler, texture(3, tables, false)],
            ),
            surface: layout(
                "surface",
                &[
                    storage(0, FRAGMENT),
                    storage(1, FRAGMENT),
                    texture(2, tables, false),
                    storage(4, FRAGMENT),
                    storage(5, FRAGMENT),
                ],
            ),
            face_geometry: layout("face_geometry", &[storage(0, COMPUTE), storage(2, COMPUTE), written(3), written(4)]),
            face_frames: layout("face_frames", &[storage(0, COMPUTE), storage(2, COMPUTE), written(3), written(5)]),
            line_mesh: layout("line_mesh", &[storage(0, VERTEX | COMPUTE), storage(4, VERTEX | COMPUTE)]),
            line_edges: layout(
                "line_edges",
                &[uniform(0, COMPUTE, false), storage(1, COMPUTE), written(2), written(3), written(4), written(5)],
            ),
            lines: layout("lines", &[uniform(0, BOTH, false), storage(1, VERTEX), storage(2, VERTEX)]),
        }
    }
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

fn uniform(binding: u32, visibility: wgpu::ShaderStages, has_dynamic_offset: bool) -> wgpu::BindGroupLayoutEntry {
    let ty =
        wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Uniform, has_dynamic_offset, min_binding_size: None };
    wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None }
}
