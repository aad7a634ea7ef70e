//! A mesh where an object stands: what compute passes find there of its faces and edges, and its buffers as passes bind
//! them. Objects of one mesh share its upload; each has one of these.

use std::sync::Mutex;

use tam_shaders::types;

use super::mesh::Buffers;
use super::{Gpu, Layouts};

/// What belongs to a mesh at one place.
pub(crate) struct PlacedMesh {
    /// How the edges that are lines are drawn: written by the pass that lists them.
    pub line_arguments: wgpu::Buffer,
    /// What the face buffers hold.
    pub computed: Mutex<Computed>,
    /// Bind group 1 of the drawing passes and of the compute passes of faces, groups 1 and 2 of the lines.
    pub groups: PlacedGroups,
}

/// Its buffers as passes bind them.
pub(crate) struct PlacedGroups {
    pub drawn: wgpu::BindGroup,
    pub geometry: wgpu::BindGroup,
    pub frames: wgpu::BindGroup,
    pub line_mesh: wgpu::BindGroup,
    pub line_edges: wgpu::BindGroup,
    pub lines: wgpu::BindGroup,
}

/// For which mesh, placement and lights the face buffers were computed.
#[derive(Default)]
pub(crate) struct Computed {
    pub geometry: Option<GeometryKey>,
    pub frames: Option<FramesKey>,
}

/// What decides normals and planes of the faces.
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct GeometryKey {
    pub version: u64,
    pub literal: bool,
    pub world_from_mesh: [[f32; 4]; 4],
}

/// What decides the frames of the faces.
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct FramesKey {
    pub geometry: GeometryKey,
    pub lights: [types::Light; types::MAX_LIGHTS],
    pub light_count: u32,
}

/// Bytes that each triangle takes: normal, plane and frame.
const FACE_BYTES: u64 = 16 + 32 + 32;

impl PlacedMesh {
    /// Bytes of its buffers, for a mesh of so many triangles and edges.
    pub(crate) fn bytes(triangles: u64, edges: u64, blocks: u64) -> u64 {
        triangles * FACE_BYTES + edges * 4 + blocks * 8 + size_of::<[u32; 4]>() as u64
    }

    pub(crate) fn new(gpu: &Gpu, layouts: &Layouts, mesh: &Buffers) -> Self {
        let Buffers {
            vertices, uvs, indices, neighbours, provoking, edges, triangle_count, edge_count, blocks, ..
        } = mesh;
        let triangles = u64::from(*triangle_count);
        let computed = |label, bytes| computed(gpu, label, bytes, wgpu::BufferUsages::COPY_SRC);
        let face_normals = computed("face_normals", triangles * 16);
        let face_planes = computed("face_planes", triangles * 32);
        let face_frames = computed("face_frames", triangles * 32);
        let listed = computed("listed", u64::from(*edge_count) * 4);
        // Which edges of a block are lines, and how many before it.
        let [marks, before] = ["marks", "before"].map(|label| computed(label, u64::from(*blocks) * 4));
        let line_arguments = self::computed(gpu, "arguments", 16, wgpu::BufferUsages::INDIRECT);
        let group = |label, layout: &wgpu::BindGroupLayout, bound: &[(u32, &wgpu::Buffer)]| {
            let entries: Vec<_> = bound
                .iter()
                .map(|(binding, buffer)| wgpu::BindGroupEntry {
                    binding: *binding,
                    resource: buffer.as_entire_binding(),
                })
                .collect();
            gpu.bind_group(&wgpu::BindGroupDescriptor { label: Some(label), layout, entries: &entries })
        };
        let groups = PlacedGroups {
            drawn: group(
                "mesh",
                &layouts.mesh,
                &[
                    (0, vertices),
                    (1, uvs),
                    (2, indices),
                    (3, neighbours),
                    (4, &face_normals),
                    (5, &face_planes),
                    (6, &face_frames),
                    (7, provoking),
                ],
            ),
            geometry: group(
                "face_geometry",
                &layouts.face_geometry,
                &[(0, vertices), (2, indices), (3, &face_normals), (4, &face_planes)],
            ),
            frames: group(
                "face_frames",
                &layouts.face_frames,
                &[(0, vertices), (2, indices), (3, &face_normals), (5, &face_frames)],
            ),
            line_mesh: group("line_mesh", &layouts.line_mesh, &[(0, vertices), (4, &face_normals)]),
            line_edges: group(
                "line_edges",
                &layouts.line_edges,
                &[(0, edges), (1, &listed), (2, &marks), (3, &before), (4, &line_arguments)],
            ),
            lines: group("lines", &layouts.lines, &[(0, edges), (1, &listed)]),
        };
        Self { line_arguments, computed: Mutex::default(), groups }
    }
}

fn computed(gpu: &Gpu, label: &str, size: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
    gpu.buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size,
        usage: wgpu::BufferUsages::STORAGE | usage,
        mapped_at_creation: false,
    })
}
