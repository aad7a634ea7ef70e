//! A mesh on the GPU: storage buffers that the shaders pull from.

use std::ops::Range;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use glam::Vec3;
use rayon::prelude::*;
use tam_shaders::cpu::lib::octahedral::oct_encode;
use tam_shaders::cpu::line_edges::BLOCK_EDGES;
use tam_shaders::types::{self, NO_FACE};

use super::placed::{FaceData, PlacedMesh};
use super::surface::SurfaceBuffers;
use super::{Gpu, GpuError, Layouts};
use crate::mesh::{self, Mesh};
use crate::params::RenderParams;

/// A mesh's buffers, uploaded once for all objects that show it. Topology is fixed; positions may change by
/// [`GpuMesh::update`].
pub struct GpuMesh {
    pub(crate) buffers: Buffers,
    pub(crate) parts: Vec<Range<u32>>,
    /// Every edge has two faces, so back faces are never seen from outside.
    pub(crate) closed: bool,
    pub(crate) radius: f64,
    pub(crate) uv_density: Option<f64>,
    /// Grows with every change of positions.
    pub(crate) version: u64,
    /// Where objects stand, made for as many as a frame ever had of it.
    placed: Mutex<Vec<Arc<PlacedMesh>>>,
    /// Kept for surfaces that are attached later.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// Bind group 3.
    pub(crate) surface: SurfaceBuffers,
    staging: Vec<types::Vertex>,
    bytes: u64,
}

/// What all objects of a mesh share.
pub(crate) struct Buffers {
    pub vertices: wgpu::Buffer,
    pub uvs: wgpu::Buffer,
    /// Pulled by vertices and fragments.
    pub indices: wgpu::Buffer,
    /// Drawn with.
    pub index_buffer: wgpu::Buffer,
    pub neighbours: wgpu::Buffer,
    pub provoking: wgpu::Buffer,
    pub edges: wgpu::Buffer,
    pub triangle_count: u32,
    pub edge_count: u32,
    /// Of edges that are marked together.
    pub blocks: u32,
}

impl GpuMesh {
    /// Uploads a mesh.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`] if a buffer exceeds what the adapter binds.
    pub(crate) fn new(gpu: &Gpu, layouts: &Layouts, mesh: &Mesh) -> Result<Self, GpuError> {
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
            gpu.buffer_of(&wgpu::util::BufferInitDescriptor { label: Some(label), contents, usage })
        };
        let storage = wgpu::BufferUsages::STORAGE;
        let index_usage = storage | wgpu::BufferUsages::INDEX;
        let pulled = buffer("indices", bytemuck::cast_slice(indices), index_usage);
        let buffers = Buffers {
            vertices: buffer("vertices", bytemuck::cast_slice(&staging), storage | wgpu::BufferUsages::COPY_DST),
            uvs: buffer("uvs", bytemuck::cast_slice(&uvs), storage),
            neighbours: buffer("neighbours", bytemuck::cast_slice(&mesh.neighbours), storage),
            provoking: buffer("provoking", bytemuck::cast_slice(&provoking), storage),
            edges: buffer("edges", bytemuck::cast_slice(&edges), storage),
            index_buffer: match index_list {
                Some(list) => buffer("provoking indices", bytemuck::cast_slice(&list), wgpu::BufferUsages::INDEX),
                None => pulled.clone(),
            },
            indices: pulled,
            triangle_count: triangles as u32,
            edge_count: edges.len() as u32,
            blocks: edges.len().div_ceil(BLOCK_EDGES) as u32,
        };
        let first = PlacedMesh::new(gpu, layouts, &buffers, FaceData::default());
        Ok(Self {
            buffers,
            surface: SurfaceBuffers::new(gpu, layouts, &[], None)?,
            triangles: mesh.triangles.clone(),
            parts: mesh.parts.iter().map(|part| part.triangles.clone()).collect(),
            closed: mesh.neighbours.as_flattened().iter().all(|neighbour| *neighbour != NO_FACE),
            radius: radius(&mesh.positions),
            uv_density: mesh.uv_density(),
            version: 0,
            placed: Mutex::new(vec![Arc::new(first)]),
            staging,
            bytes,
        })
    }

    /// Where the `nth` object of a frame stands that shows this mesh, with room for this of its faces.
    pub(crate) fn placed(&self, gpu: &Gpu, layouts: &Layouts, nth: usize, faces: FaceData) -> Arc<PlacedMesh> {
        let mut placed = self.places();
        while placed.len() <= nth {
            placed.push(Arc::new(PlacedMesh::new(gpu, layouts, &self.buffers, faces)));
        }
        let all = placed[nth].faces.and(faces);
        if placed[nth].faces != all {
            placed[nth] = Arc::new(PlacedMesh::new(gpu, layouts, &self.buffers, all));
        }
        Arc::clone(&placed[nth])
    }

    fn places(&self) -> MutexGuard<'_, Vec<Arc<PlacedMesh>>> {
        self.placed.lock().unwrap_or_else(PoisonError::into_inner)
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
        gpu.queue.write_buffer(&self.buffers.vertices, 0, bytemuck::cast_slice(&self.staging));
        self.radius = radius(positions);
        self.version += 1;
    }

    /// Triangles.
    pub fn triangle_count(&self) -> u32 {
        self.buffers.triangle_count
    }

    /// Radius about the origin that holds all vertices.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Bytes of all its buffers on the GPU: the upload, the surface, and what is computed where its objects stand.
    pub fn bytes(&self) -> u64 {
        let places: u64 = self.places().iter().map(|placed| PlacedMesh::bytes(placed.faces, &self.buffers)).sum();
        self.bytes + places + self.surface.bytes()
    }

    /// Bytes of the buffers that a way to draw reads: the mesh with its faces, and of the surface what its strokes lie by.
    pub fn bytes_for(&self, params: &RenderParams) -> u64 {
        self.bytes + PlacedMesh::bytes(FaceData::of(params), &self.buffers) + self.surface.bytes_for(params)
    }
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
