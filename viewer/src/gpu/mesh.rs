//! A mesh on the GPU: storage buffers that the shaders pull from.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use glam::Vec3;
use rayon::prelude::*;
use tam_shaders::Feed;
use tam_shaders::cpu::lib::octahedral::oct_encode;
use tam_shaders::cpu::line_edges::BLOCK_EDGES;
use tam_shaders::types::{self, NO_FACE};

use super::corners::CornersOf;
use super::feeds::Fed;
use super::placed::{FaceData, PlacedMesh};
use super::surface::SurfaceBuffers;
use super::{Gpu, GpuError, Layouts};
use crate::mesh::{self, Mesh};
use crate::params::{Mapping, RenderParams};
use crate::surface::Surface;

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
    /// Where objects stand whose faces are looked at, by their number among those of a frame that show this mesh.
    placed: Mutex<BTreeMap<usize, Arc<PlacedMesh>>>,
    /// Kept for surfaces that are attached later.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// What of a surface is attached.
    pub(crate) surface: SurfaceBuffers,
    staging: Vec<types::Vertex>,
    bytes: u64,
}

/// What all objects of a mesh share.
pub(crate) struct Buffers {
    pub vertices: wgpu::Buffer,
    pub uvs: wgpu::Buffer,
    /// Drawn with, and pulled by passes that look at faces.
    pub indices: wgpu::Buffer,
    pub neighbours: wgpu::Buffer,
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
        let uvs: Vec<[f32; 2]> = mesh.uvs.iter().map(|uv| (*uv).into()).collect();
        let edges = edges(mesh);
        gpu.fits("the mesh's edges", edges.len() as u64 * 16)?;

        let mut bytes = 0;
        let mut buffer = |label: &str, contents: &[u8], usage: wgpu::BufferUsages| {
            bytes += contents.len() as u64;
            gpu.buffer_of(&wgpu::util::BufferInitDescriptor { label: Some(label), contents, usage })
        };
        let (storage, vertex) = (wgpu::BufferUsages::STORAGE, wgpu::BufferUsages::VERTEX);
        let vertex_usage = storage | vertex | wgpu::BufferUsages::COPY_DST;
        let buffers = Buffers {
            vertices: buffer("vertices", bytemuck::cast_slice(&staging), vertex_usage),
            uvs: buffer("uvs", bytemuck::cast_slice(&uvs), vertex),
            indices: buffer("indices", bytemuck::cast_slice(indices), storage | wgpu::BufferUsages::INDEX),
            neighbours: buffer("neighbours", bytemuck::cast_slice(&mesh.neighbours), storage),
            edges: buffer("edges", bytemuck::cast_slice(&edges), storage),
            triangle_count: triangles as u32,
            edge_count: edges.len() as u32,
            blocks: edges.len().div_ceil(BLOCK_EDGES) as u32,
        };
        Ok(Self {
            buffers,
            surface: SurfaceBuffers::none(gpu, layouts),
            triangles: mesh.triangles.clone(),
            parts: mesh.parts.iter().map(|part| part.triangles.clone()).collect(),
            closed: mesh.neighbours.as_flattened().iter().all(|neighbour| *neighbour != NO_FACE),
            radius: radius(&mesh.positions),
            uv_density: mesh.uv_density(),
            version: 0,
            placed: Mutex::default(),
            staging,
            bytes,
        })
    }

    /// Where the `nth` object of a frame stands that shows this mesh, with room for this of its faces.
    pub(crate) fn placed(&self, gpu: &Gpu, layouts: &Layouts, nth: usize, faces: FaceData) -> Arc<PlacedMesh> {
        let mut places = self.places();
        let known = places.get(&nth).map(|placed| placed.faces);
        let all = known.unwrap_or_default().and(faces);
        if known != Some(all) {
            places.insert(nth, Arc::new(PlacedMesh::new(gpu, layouts, &self.buffers, all)));
        }
        Arc::clone(&places[&nth])
    }

    fn places(&self) -> MutexGuard<'_, BTreeMap<usize, Arc<PlacedMesh>>> {
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
        self.surface.update(gpu, self.corners_of());
        self.radius = radius(positions);
        self.version += 1;
    }

    fn corners_of(&self) -> CornersOf<'_> {
        CornersOf { vertices: &self.staging, triangles: &self.triangles, parts: &self.parts }
    }

    /// Attaches a surface in place of the one before.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`] if it exceeds what the adapter has.
    pub(crate) fn attach(&mut self, gpu: &Gpu, layouts: &Layouts, surface: &Surface) -> Result<(), GpuError> {
        self.surface = SurfaceBuffers::new(gpu, layouts, self.corners_of(), surface)?;
        Ok(())
    }

    /// What a feed is drawn with in a mapping; none where the surface lacks what it carries.
    pub(crate) fn fed(&self, feed: Feed, mapping: Mapping) -> Option<Fed<'_>> {
        let Buffers { vertices, uvs, indices, .. } = &self.buffers;
        let parts = || self.parts.iter().map(|part| 3 * part.start..3 * part.end).collect();
        match feed {
            Feed::Vertices => Some(Fed { buffers: vec![vertices], indices: Some(indices), parts: parts() }),
            Feed::Uvs => Some(Fed { buffers: vec![vertices, uvs], indices: Some(indices), parts: parts() }),
            // Vertices are counted from the first face of the part, which the material tells.
            Feed::Faces | Feed::Faced => {
                let parts = self.parts.iter().map(|part| 0..3 * (part.end - part.start)).collect();
                Some(Fed { buffers: Vec::new(), indices: None, parts })
            }
            Feed::Corners | Feed::Turning | Feed::Lapped | Feed::Lines | Feed::Strokes => {
                self.surface.fed(feed, mapping)
            }
        }
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
        let places: u64 = self.places().values().map(|placed| PlacedMesh::bytes(placed.faces, &self.buffers)).sum();
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
