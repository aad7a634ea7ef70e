//! Twin of `lib/mesh_types.wgsl`: records of a mesh's buffers.

use glam::{DVec3, Vec3};

use crate::types;
pub use crate::types::{NO_FACE, NO_NORMAL};

/// A vertex.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vertex {
    /// In the mesh's space.
    pub position: DVec3,
    /// Octahedral, two 16-bit snorm.
    pub normal_oct: u32,
}

/// The light-aligned frame of a face: see [`super::face_frame`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FaceFrame {
    /// Along the strokes.
    pub tangent: DVec3,
    /// Across them, towards the light.
    pub bitangent: DVec3,
    /// Shares of the frame, of its half turn and of the fixed frame: three 10-bit unorm, low bits first.
    pub shares: u32,
    /// Normal of the face, octahedral, or [`NO_NORMAL`] where it has no area.
    pub normal_oct: u32,
}

impl From<&types::Vertex> for Vertex {
    fn from(vertex: &types::Vertex) -> Self {
        Self { position: Vec3::from(vertex.position).as_dvec3(), normal_oct: vertex.normal_oct }
    }
}

impl From<&types::FaceFrame> for FaceFrame {
    fn from(frame: &types::FaceFrame) -> Self {
        let [y, z] = frame.bitangent_yz;
        Self {
            tangent: Vec3::from(frame.tangent).as_dvec3(),
            bitangent: Vec3::new(frame.bitangent_x, y, z).as_dvec3(),
            shares: frame.shares,
            normal_oct: frame.normal_oct,
        }
    }
}
