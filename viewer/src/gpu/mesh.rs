//! A mesh on the GPU: storage buffers that the shaders pull from.

use std::ops::Range;
use std::sync::Mutex;

use glam::Vec3;
use rayon::prelude::*;
use tam_shaders::cpu::lib::octahedral::oct_encode;
use tam_shaders::cpu::line_edges::BLOCK_EDGES;
use tam_shaders::types::{self, NO_FACE};
use wgpu::util::DeviceExt;

use super::surface::SurfaceBuffers;
use super::{Gpu, GpuError, Layouts};
use crate::mesh::{self, Mesh};
use crate::params::RenderParams;

/// A mesh's buffers. Topology is fixed; positions may change by [`GpuMesh::update`].
pub struct GpuMesh {
    pub(crate) index_buffer: wgpu::Buffer,
    pub(crate) vertex_buffer: wgpu::Buffer,
    pub(crate) edge_count: u32,
    /// How the edges that are lines are drawn: written by the pass that lists them.
    pub(crate) line_arguments: wgpu::Buffer,
    pub(crate) triangle_count: u32,
    pub(crate) parts: Vec<Range<u32>>,
    /// Every edge has two faces, so back faces are never seen from outside.
    pub(crate) closed: bool,
    pub(crate) radius: f64,
    pub(crate) uv_density: Option<f64>,
    /// Grows with every change of positions.
    pub(crate) version: u64,
    /// What the face buffers hold.
    pub(crate) computed: Mutex<Computed>,
    /// Bind group 1 of the drawing passes and of the compute passes of faces, groups 1 and 2 of the lines.
    pub(crate) groups: MeshGroups,
    /// Bind group 3.
    pub(crate) surface: SurfaceBuffers,
    staging: Vec<types::Vertex>,
    bytes: u64,
}

/// Its buffers as passes bind them.
pub(crate) struct MeshGroups {
    pub drawn: wgpu::BindGroup,
    pub geometry: wgpu::BindGroup,
    pub frames: wgpu::BindGroup,
    pub line_mesh: wgpu::BindGroup,
    pub line_edges: wgpu::BindGroup,
    /// By style: silhouettes, wireframe.
    pub lines: [wgpu::BindGroup; 2],
}

/// Buffers of the edges.
struct EdgeBuffers {
    edges: wgpu::Buffer,
    /// Those that are lines.
    listed: wgpu::Buffer,
    /// Which edges of a block are lines, and how many before it.
    blocks: [wgpu::Buffer; 2],
    arguments: wgpu::Buffer,
}

/// Buffers beside the vertices.
struct Buffers {
    uvs: wgpu::Buffer,
    indices: wgpu::Buffer,
    neighbours: wgpu::Buffer,
    face_normals: wgpu::Buffer,
    face_planes: wgpu::Buffer,
    face_frames: wgpu::Buffer,
    provoking: wgpu::Buffer,
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

impl GpuMesh {
    /// Uploads a mesh.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`] if a buffer exceeds what the adapter binds.
    pub(crate) fn new(
        gpu: &Gpu,
        layouts: &Layouts,
        line_styles: &[wgpu::Buffer; 2],
        mesh: &Mesh,
    ) -> Result<Self, GpuError> {
        let triangles = mesh.triangles.len() as u64;
        gpu.fits("the mesh's faces", triangles * 32)?;
        gpu.fits("the mesh's vertices", mesh.positions.len() as u64 * 16)?;
        let staging = vertices(&mesh.positions, &mesh.normals);
        let indices: &[u32] = bytemuck::cast_slice(&mesh.triangles);
        let (index_list, provoking) = if gpu.capabilities.primitive_index {
            (None, vec![0])
        } else {
            let (list, provoking) = provoking_vertices(&mesh.triangles, mesh.positions.len());
            (Some(list), provoking)
        };
        let uvs: Vec<[f32; 2]> =
            if mesh.uvs.is_empty() { vec![[0.0; 2]] } else { mesh.uvs.iter().map(|uv| (*uv).into()).collect() };
        let edges = edges(mesh);
        gpu.fits("the mesh's edges", edges.len() as u64 * 16)?;

        let mut bytes = 0;
        let mut buffer = |label: &str, contents: &[u8], usage: wgpu::BufferUsages| {
            bytes += contents.len() as u64;
            gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some(label), contents, usage })
        };
        let storage = wgpu::BufferUsages::STORAGE;
        let index_usage = storage | wgpu::BufferUsages::INDEX;
        let pulled = buffer("indices", bytemuck::cast_slice(indices), index_usage);
        let buffers = Buffers {
            uvs: buffer("uvs", bytemuck::cast_slice(&uvs), storage),
            neighbours: buffer("neighbours", bytemuck::cast_slice(&mesh.neighbours), storage),
            provoking: buffer("provoking", bytemuck::cast_slice(&provoking), storage),
            indices: pulled.clone(),
            face_normals: computed(gpu, "face_normals", triangles * 16),
            face_planes: computed(gpu, "face_planes", triangles * 32),
            face_frames: computed(gpu, "face_frames", triangles * 32),
        };
        let vertex_buffer = buffer("vertices", bytemuck::cast_slice(&staging), storage | wgpu::BufferUsages::COPY_DST);
        let blocks = edges.len().div_ceil(BLOCK_EDGES) as u64;
        let edge_buffers = EdgeBuffers {
            edges: buffer("edges", bytemuck::cast_slice(&edges), storage),
            listed: computed(gpu, "listed", edges.len() as u64 * 4),
            blocks: ["marks", "before"].map(|label| computed(gpu, label, blocks * 4)),
            arguments: buffer("arguments", &[0; 16], storage | wgpu::BufferUsages::INDIRECT),
        };
        let index_buffer = match index_list {
            Some(list) => buffer("provoking indices", bytemuck::cast_slice(&list), wgpu::BufferUsages::INDEX),
            None => pulled,
        };
        bytes += triangles * 80 + edges.len() as u64 * 4 + blocks * 8;
        let groups = MeshGroups::new(gpu, layouts, &buffers, &vertex_buffer, &edge_buffers, line_styles);
        Ok(Self {
            groups,
            surface: SurfaceBuffers::new(gpu, layouts, None)?,
            index_buffer,
            vertex_buffer,
            edge_count: edges.len() as u32,
            line_arguments: edge_buffers.arguments,
            triangle_count: triangles as u32,
            parts: mesh.parts.iter().map(|part| part.triangles.clone()).collect(),
            closed: mesh.neighbours.as_flattened().iter().all(|neighbour| *neighbour != NO_FACE),
            radius: radius(&mesh.positions),
            uv_density: mesh.uv_density(),
            version: 0,
            computed: Mutex::default(),
            staging,
            bytes,
        })
    }

    /// Moves the vertices; topology and adjacency stay.
    ///
    /// # Panics
    /// If there are not as many positions and normals as the mesh has vertices.
    pub fn update(&mut self, gpu: &Gpu, positions: &[Vec3], normals: &[Vec3]) {
        assert_eq!(positions.len(), self.staging.len());
        assert_eq!(normals.len(), self.staging.len());
        self.staging.par_iter_mut().zip(positions).zip(normals).for_each(|((vertex, position), normal)| {
            *vertex = shared_vertex(*position, *normal);
        });
        gpu.queue.write_buffer(&self.vertex_buffer, 0, bytemuck::cast_slice(&self.staging));
        self.radius = radius(positions);
        self.version += 1;
    }

    /// Triangles.
    pub fn triangle_count(&self) -> u32 {
        self.triangle_count
    }

    /// Radius about the origin that holds all vertices.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Bytes of all its buffers on the GPU.
    pub fn bytes(&self) -> u64 {
        self.bytes + self.surface.bytes()
    }

    /// Bytes of the buffers that a way to draw reads: the mesh with its faces, and of the surface what its strokes lie by.
    pub fn bytes_for(&self, params: &RenderParams) -> u64 {
        self.bytes + self.surface.bytes_for(params)
    }
}

impl MeshGroups {
    fn new(
        gpu: &Gpu,
        layouts: &Layouts,
        buffers: &Buffers,
        vertices: &wgpu::Buffer,
        edges: &EdgeBuffers,
        line_styles: &[wgpu::Buffer; 2],
    ) -> Self {
        let group = |label, layout: &wgpu::BindGroupLayout, bound: &[(u32, &wgpu::Buffer)]| {
            let entries: Vec<_> = bound
                .iter()
                .map(|(binding, buffer)| wgpu::BindGroupEntry {
                    binding: *binding,
                    resource: buffer.as_entire_binding(),
                })
                .collect();
            gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some(label), layout, entries: &entries })
        };
        let EdgeBuffers { edges: all, listed, blocks: [marks, before], arguments } = edges;
        let Buffers { uvs, indices, neighbours, face_normals, face_planes, face_frames, provoking } = buffers;
        Self {
            drawn: group(
                "mesh",
                &layouts.mesh,
                &[
                    (0, vertices),
                    (1, uvs),
                    (2, indices),
                    (3, neighbours),
                    (4, face_normals),
                    (5, face_planes),
                    (6, face_frames),
                    (7, provoking),
                ],
            ),
            geometry: group(
                "face_geometry",
                &layouts.face_geometry,
                &[(0, vertices), (2, indices), (3, face_normals), (4, face_planes)],
            ),
            frames: group(
                "face_frames",
                &layouts.face_frames,
                &[(0, vertices), (2, indices), (3, face_normals), (5, face_frames)],
            ),
            line_mesh: group("line_mesh", &layouts.line_mesh, &[(0, vertices), (4, face_normals)]),
            line_edges: group(
                "line_edges",
                &layouts.line_edges,
                &[(0, &line_styles[0]), (1, all), (2, listed), (3, marks), (4, before), (5, arguments)],
            ),
            lines: line_styles
                .each_ref()
                .map(|style| group("lines", &layouts.lines, &[(0, style), (1, all), (2, listed)])),
        }
    }
}

fn computed(gpu: &Gpu, label: &str, size: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    })
}

fn shared_vertex(position: Vec3, normal: Vec3) -> types::Vertex {
    types::Vertex { position: position.into(), normal_oct: oct_encode(normal.as_dvec3()) }
}

fn vertices(positions: &[Vec3], normals: &[Vec3]) -> Vec<types::Vertex> {
    positions.par_iter().zip(normals).map(|(position, normal)| shared_vertex(*position, *normal)).collect()
}

fn radius(positions: &[Vec3]) -> f64 {
    f64::from(positions.par_iter().map(|p| p.length_squared()).reduce(|| 0.0, f32::max).sqrt())
}

fn edges(mesh: &Mesh) -> Vec<types::Edge> {
    let edge = |edge: mesh::Edge| {
        let ([a, b], [left, right]) = (edge.vertices, edge.triangles);
        types::Edge { a, b, left, right }
    };
    mesh.edges().into_iter().map(edge).collect()
}

/// An index list in which the first corner of triangle `f` has index `f`, so that a flat value carries the face, and
/// the vertex that stands at each index. Other corners reuse an index that already stands for their vertex.
fn provoking_vertices(triangles: &[[u32; 3]], vertex_count: usize) -> (Vec<u32>, Vec<u32>) {
    let mut vertex_of: Vec<u32> = triangles.iter().map(|corners| corners[0]).collect();
    let mut index_of = vec![u32::MAX; vertex_count];
    for (index, vertex) in vertex_of.iter().enumerate() {
        index_of[*vertex as usize] = index as u32;
    }
    let mut list = Vec::with_capacity(triangles.len() * 3);
    for (face, corners) in triangles.iter().enumerate() {
        list.push(face as u32);
        for vertex in &corners[1..] {
            let index = &mut index_of[*vertex as usize];
            if *index == u32::MAX {
                *index = vertex_of.len() as u32;
                vertex_of.push(*vertex);
            }
            list.push(*index);
        }
    }
    (list, vertex_of)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_corner_of_every_triangle_carries_its_face() {
        let triangles = [[0, 1, 2], [2, 1, 3], [2, 3, 4], [5, 0, 2]];
        let (list, vertex_of) = provoking_vertices(&triangles, 6);
        for (face, corners) in triangles.iter().enumerate() {
            assert_eq!(list[3 * face], face as u32);
            for k in 0..3 {
                assert_eq!(vertex_of[list[3 * face + k] as usize], corners[k]);
            }
        }
    }
}
