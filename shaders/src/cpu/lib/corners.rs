//! Twin of `lib/corners.wgsl`: the corners of a face, in the space of the frames: the world, or in the literal form the
//! mesh's own.

use glam::DVec3;

use super::mesh_types::Vertex;
use super::scene::Scene;
use crate::cpu::Form;

/// The corners of a face.
pub fn face_corners(form: Form, scene: &Scene, vertices: &[Vertex], indices: &[u32], face: usize) -> [DVec3; 3] {
    std::array::from_fn(|k| {
        let p = vertices[indices[3 * face + k] as usize].position;
        match form {
            Form::Literal => p,
            Form::Hardened => (scene.world_from_mesh * p.extend(1.0)).truncate(),
        }
    })
}

/// Twice the area, along the normal.
pub fn area_vector(corners: &[DVec3; 3]) -> DVec3 {
    (corners[1] - corners[0]).cross(corners[2] - corners[0])
}
