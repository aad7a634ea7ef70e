//! Twin of `lib/barycentric.wgsl`: where in its face a fragment is.

use glam::DVec3;

use super::mesh::Mesh;

/// Weights of the corners at a place, which is in the space of the frames.
pub fn corner_weights(mesh: &Mesh<'_>, face: usize, p: DVec3) -> DVec3 {
    let [first, second] = [0, 1].map(|k| mesh.face_planes[2 * face + k].dot(p.extend(1.0)));
    DVec3::new(first, second, 1.0 - first - second)
}

/// Their change along a vector.
pub fn corner_slopes(mesh: &Mesh<'_>, face: usize, v: DVec3) -> DVec3 {
    let [first, second] = [0, 1].map(|k| mesh.face_planes[2 * face + k].truncate().dot(v));
    DVec3::new(first, second, -first - second)
}

/// Where a fragment is in its face, and how that changes to the next pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Weights of the corners.
    pub weights: DVec3,
    /// Their change to the pixel on the right.
    pub dx: DVec3,
    /// Their change to the pixel below.
    pub dy: DVec3,
}

/// The place of a point, given its change across a pixel.
pub fn place_in_face(mesh: &Mesh<'_>, face: usize, p: DVec3, dx: DVec3, dy: DVec3) -> Place {
    Place {
        weights: corner_weights(mesh, face, p),
        dx: corner_slopes(mesh, face, dx),
        dy: corner_slopes(mesh, face, dy),
    }
}
