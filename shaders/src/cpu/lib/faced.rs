//! Twin of `lib/faced.wgsl`: three vertices to a face, pulled from the mesh's buffers.

use glam::DVec2;

use super::material::Material;
use super::mesh_types::Vertex;
use super::surface::{VertexOut, surface_vertex};
use crate::cpu::Bindings;

/// Face of a vertex that counts from the first face of the draw.
pub fn face_of(material: &Material, index: u32) -> u32 {
    index / 3 + material.first_face
}

/// That vertex.
pub fn pulled_vertex(b: &Bindings<'_>, index: u32) -> Vertex {
    b.mesh.vertices[b.mesh.indices[(index + 3 * b.material.first_face) as usize] as usize]
}

/// That vertex on its way to the screen, and its face.
pub fn faced_vertex(b: &Bindings<'_>, index: u32) -> (VertexOut, u32) {
    (surface_vertex(b.scene, &pulled_vertex(b, index), DVec2::ZERO), face_of(b.material, index))
}
