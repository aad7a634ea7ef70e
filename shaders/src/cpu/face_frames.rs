//! Twin of `face_frames.wgsl`: light-aligned frames of all faces. Suarez and others, "GPU real time hatching", 2013,
//! algorithm 1.

use glam::DVec4;

use super::Form;
use super::lib::corners::face_corners;
use super::lib::face_frame::{light_frame, pack_shares};
use super::lib::mesh_types::{FaceFrame, NO_NORMAL, Vertex};
use super::lib::octahedral::oct_encode;
use super::lib::scene::Scene;

/// Fills one frame per face of `indices`.
///
/// # Panics
/// If a slice is shorter than the faces ask for.
pub fn main(
    form: Form,
    scene: &Scene,
    vertices: &[Vertex],
    indices: &[u32],
    face_normals: &[DVec4],
    face_frames: &mut [FaceFrame],
) {
    for face in 0..indices.len() / 3 {
        let corners = face_corners(form, scene, vertices, indices, face);
        let centre = (corners[0] + corners[1] + corners[2]) / 3.0;
        let normal = face_normals[face];
        let frame = light_frame(form, scene, normal.truncate(), centre);
        face_frames[face] = FaceFrame {
            tangent: frame.tangent,
            bitangent: frame.bitangent,
            shares: pack_shares(frame.shares),
            normal_oct: if normal.w > 0.0 { oct_encode(normal.truncate()) } else { NO_NORMAL },
        };
    }
}
