//! Twin of `lib/mesh.wgsl`: the buffers of a mesh.

use glam::DVec4;

use super::mesh_types::{FaceFrame, Vertex};

/// The buffers of a mesh, as passes read them that look at faces.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mesh<'a> {
    /// One per vertex.
    pub vertices: &'a [Vertex],
    /// Three per face.
    pub indices: &'a [u32],
    /// Three per face: the face across the edge from corner k to corner k + 1, or `NO_FACE`.
    pub neighbours: &'a [u32],
    /// Face normal in xyz, in the space of the frames; w is 1 where the face has an area, else 0.
    pub face_normals: &'a [DVec4],
    /// Two per face: barycentric weight of corner 0 and of corner 1 as `dot(xyz, p) + w`.
    pub face_planes: &'a [DVec4],
    /// One per face.
    pub face_frames: &'a [FaceFrame],
}
