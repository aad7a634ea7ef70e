//! Twin of `lib/barycentric.wgsl`: where in its face a fragment is.

use glam::DVec3;

use super::mesh::Mesh;

/// Weights of the corners at a place, which is in the space of the frames.
pub fn corner_weights(mesh: &Mesh<'_>, face: usize, p: DVec3) -> DVec3 {
    let [first, second] = [0, 1].map(|k| mesh.face_planes[2 * face + k].dot(p.extend(1.0)));
    DVec3::new(first, second, 1.0 - first - second)
}
