//! What the corners of triangles carry, as vertex buffers.

use std::ops::Range;

use glam::{DVec3, Vec3};
use rayon::prelude::*;
use tam_shaders::Feed;
use tam_shaders::cpu::lib::octahedral::{oct_decode, oct_encode};
use tam_shaders::types::Vertex;

use super::feeds::Fed;
use super::{Gpu, GpuError};
use crate::surface::Corners;
use crate::surface::corners::Stand;

/// The corners of a mesh's triangles.
pub(crate) struct CornerBuffers {
    place: wgpu::Buffer,
    patches: Option<wgpu::Buffer>,
    over: Option<wgpu::Buffer>,
    seeds: Option<wgpu::Buffer>,
    lines: Option<wgpu::Buffer>,
    rows: Option<wgpu::Buffer>,
    indices: wgpu::Buffer,
    parts: Vec<Range<u32>>,
    stands: Vec<Stand>,
    bytes: u64,
}

/// The mesh whose corners they are: its vertices, triangles and parts.
#[derive(Clone, Copy)]
pub(crate) struct CornersOf<'a> {
    pub vertices: &'a [Vertex],
    pub triangles: &'a [[u32; 3]],
    pub parts: &'a [Range<u32>],
}

impl CornerBuffers {
    /// Uploads what corners carry.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`] if the adapter has no such buffer.
    pub(crate) fn new(gpu: &Gpu, mesh: CornersOf<'_>, corners: Corners) -> Result<Self, GpuError> {
        let bytes = corners.bytes();
        gpu.fits("what the corners of the mesh carry", bytes)?;
        let vertex = wgpu::BufferUsages::VERTEX;
        let buffer = |label: &str, contents: &[u8], usage| {
            gpu.buffer_of(&wgpu::util::BufferInitDescriptor { label: Some(label), contents, usage })
        };
        let carried = |label: &str, contents: &[u8]| (!contents.is_empty()).then(|| buffer(label, contents, vertex));
        let places = places(mesh, &corners.stands);
        Ok(Self {
            place: buffer("corners", bytemuck::cast_slice(&places), vertex | wgpu::BufferUsages::COPY_DST),
            patches: carried("patches of corners", bytemuck::cast_slice(&corners.patches)),
            over: carried("lapped textures of corners", bytemuck::cast_slice(&corners.over)),
            seeds: carried("seeds of corners", bytemuck::cast_slice(&corners.seeds)),
            lines: carried("lines of corners", bytemuck::cast_slice(&corners.lines)),
            rows: carried("rows of corners", bytemuck::cast_slice(&corners.rows)),
            indices: buffer("corner indices", bytemuck::cast_slice(&corners.indices), wgpu::BufferUsages::INDEX),
            parts: mesh.parts.iter().map(|part| corners.range_of(part.clone())).collect(),
            stands: corners.stands,
            bytes,
        })
    }

    /// Moves the corners with the mesh's vertices.
    pub(crate) fn update(&self, gpu: &Gpu, mesh: CornersOf<'_>) {
        gpu.queue.write_buffer(&self.place, 0, bytemuck::cast_slice(&places(mesh, &self.stands)));
    }

    /// What a feed is drawn with; none where the corners do not carry it.
    pub(crate) fn fed(&self, feed: Feed) -> Option<Fed<'_>> {
        let Self { place, patches, over, seeds, lines, rows, .. } = self;
        let carried = match feed {
            Feed::Corners => [Some(patches), None, None, None],
            Feed::Turning => [Some(patches), Some(seeds), None, None],
            Feed::Lapped => [Some(patches), Some(over), None, None],
            Feed::Lines => [Some(lines), None, None, None],
            Feed::Strokes => [Some(lines), Some(patches), Some(seeds), Some(rows)],
            Feed::Vertices | Feed::Uvs | Feed::Faces | Feed::Faced => return None,
        };
        let mut buffers = vec![place];
        for buffer in carried.into_iter().flatten() {
            buffers.push(buffer.as_ref()?);
        }
        Some(Fed { buffers, indices: Some(&self.indices), parts: self.parts.clone() })
    }

    /// Whether strokes can be drawn of them.
    pub(crate) fn has_rows(&self) -> bool {
        self.rows.is_some()
    }

    /// Bytes of all buffers.
    pub(crate) fn bytes(&self) -> u64 {
        self.bytes
    }
}

fn places(mesh: CornersOf<'_>, stands: &[Stand]) -> Vec<Vertex> {
    let place = |stand: &Stand| match *stand {
        Stand::Vertex(vertex) => mesh.vertices[vertex as usize],
        Stand::Middle(face) => middle(mesh.triangles[face as usize].map(|vertex| mesh.vertices[vertex as usize])),
    };
    stands.par_iter().map(place).collect()
}

fn middle(corners: [Vertex; 3]) -> Vertex {
    let place: Vec3 = corners.iter().map(|corner| Vec3::from(corner.position)).sum();
    let normal: DVec3 = corners.iter().map(|corner| oct_decode(corner.normal_oct)).sum();
    Vertex { position: (place / 3.0).into(), normal_oct: oct_encode(normal.normalize_or(DVec3::Y)) }
}
