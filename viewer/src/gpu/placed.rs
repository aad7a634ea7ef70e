//! A mesh where an object stands: what compute passes find there of its faces and edges, and its buffers as passes bind
//! them. Objects of one mesh share its upload; each has one of these.

use std::sync::Mutex;

use tam_shaders::types;

use super::mesh::Buffers;
use super::{Gpu, Layouts};
use crate::params::{FaceFrameForm, Mapping, Method, RenderParams};

/// What belongs to a mesh at one place.
pub(crate) struct PlacedMesh {
    /// What there is of the faces.
    pub faces: FaceData,
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

/// What is known of the faces beside their normals, which lines are found by: only what some way to draw reads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub(crate) struct FaceData {
    /// Where in its face a fragment is.
    pub planes: bool,
    /// Frames of the light.
    pub frames: bool,
}

impl FaceData {
    /// What the strokes of a look read.
    pub(crate) fn of(params: &RenderParams) -> Self {
        let RenderParams { method, mapping, .. } = *params;
        let made = params.frames_made();
        match method {
            Method::FaceFrame => Self { planes: made == FaceFrameForm::Fetched, frames: made != FaceFrameForm::Vertex },
            method if method.takes_mapping() => Self { planes: false, frames: mapping == Mapping::Frames },
            _ => Self::default(),
        }
    }

    /// What is in either.
    pub(crate) fn and(self, other: Self) -> Self {
        Self { planes: self.planes || other.planes, frames: self.frames || other.frames }
    }

    /// Bytes for so many triangles, each with its normal, two planes, and a frame; the least that can be bound stands for
    /// what is not there.
    fn bytes(self, triangles: u64) -> [u64; 3] {
        [16 * triangles, if self.planes { 32 * triangles } else { 16 }, if self.frames { 32 * triangles } else { 32 }]
    }
}

impl PlacedMesh {
    /// Bytes of its buffers where they are made for this, for a mesh of so many triangles and edges.
    pub(crate) fn bytes(faces: FaceData, mesh: &Buffers) -> u64 {
        let Buffers { triangle_count, edge_count, blocks, .. } = *mesh;
        let faces: u64 = faces.bytes(triangle_count.into()).iter().sum();
        faces + u64::from(edge_count) * 4 + u64::from(blocks) * 8 + size_of::<[u32; 4]>() as u64
    }

    pub(crate) fn new(gpu: &Gpu, layouts: &Layouts, mesh: &Buffers, faces: FaceData) -> Self {
        let Buffers { vertices, indices, neighbours, edges, triangle_count, edge_count, blocks, .. } = mesh;
        let [normals, planes, frames] = faces.bytes((*triangle_count).into());
        let computed = |label, bytes| computed(gpu, label, bytes, wgpu::BufferUsages::COPY_SRC);
        let face_normals = computed("face_normals", normals);
        let face_planes = computed("face_planes", planes);
        let face_frames = computed("face_frames", frames);
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
                &layouts.storage().mesh,
                &[
                    (0, vertices),
                    (2, indices),
                    (3, neighbours),
                    (4, &face_normals),
                    (5, &face_planes),
                    (6, &face_frames),
                ],
            ),
            geometry: group(
                "face_geometry",
                &layouts.storage().face_geometry,
                &[(0, vertices), (2, indices), (3, &face_normals), (4, &face_planes)],
            ),
            frames: group(
                "face_frames",
                &layouts.storage().face_frames,
                &[(0, vertices), (2, indices), (3, &face_normals), (5, &face_frames)],
            ),
            line_mesh: group("line_mesh", &layouts.storage().line_mesh, &[(0, vertices), (4, &face_normals)]),
            line_edges: group(
                "line_edges",
                &layouts.storage().line_edges,
                &[(0, edges), (1, &listed), (2, &marks), (3, &before), (4, &line_arguments)],
            ),
            lines: group("lines", &layouts.storage().lines, &[(0, edges), (1, &listed)]),
        };
        Self { faces, line_arguments, computed: Mutex::default(), groups }
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
