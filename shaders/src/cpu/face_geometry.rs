//! Twin of `face_geometry.wgsl`: normals and barycentric planes of all faces. Suarez and others, "GPU real time hatching",
//! 2013, algorithm 1, first line.

use glam::{DVec3, DVec4};

use super::Form;
use super::builtin::inverse_sqrt;
use super::lib::corners::{area_vector, face_corners};
use super::lib::mesh_types::Vertex;
use super::lib::scene::Scene;

/// Twice the area, as a vector, below this times the longest edge squared counts as none.
pub const LEAST_AREA: f64 = 1e-6;

/// Fills one normal and two planes per face of `indices`.
///
/// # Panics
/// If a slice is shorter than the faces ask for.
pub fn main(
    form: Form,
    scene: &Scene,
    vertices: &[Vertex],
    indices: &[u32],
    face_normals: &mut [DVec4],
    face_planes: &mut [DVec4],
) {
    for face in 0..indices.len() / 3 {
        let corners = face_corners(form, scene, vertices, indices, face);
        let normal = area_vector(&corners);
        face_normals[face] = face_normal(form, &corners, normal);
        face_planes[2 * face..2 * face + 2].copy_from_slice(&barycentric_planes(&corners, normal));
    }
}

/// Unit normal of a face with the given area vector; w is 1, or 0 where a hardened form finds no area.
pub fn face_normal(form: Form, corners: &[DVec3; 3], normal: DVec3) -> DVec4 {
    if form == Form::Literal {
        return normal.normalize().extend(1.0);
    }
    let a = corners[1] - corners[0];
    let b = corners[2] - corners[1];
    let c = corners[0] - corners[2];
    let longest = a.dot(a).max(b.dot(b).max(c.dot(c)));
    let area2 = normal.dot(normal);
    let has_area = area2 > LEAST_AREA * LEAST_AREA * longest * longest && area2 > 1e-36;
    if has_area { (normal * inverse_sqrt(area2)).extend(1.0) } else { DVec4::Z }
}

/// Barycentric weight of corner 0 and of corner 1, as `dot(xyz, p) + w`.
pub fn barycentric_planes(corners: &[DVec3; 3], normal: DVec3) -> [DVec4; 2] {
    let scale = 1.0 / normal.dot(normal).max(1e-36);
    let first = normal.cross(corners[2] - corners[1]) * scale;
    let second = normal.cross(corners[0] - corners[2]) * scale;
    [first.extend(-first.dot(corners[1])), second.extend(-second.dot(corners[2]))]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planes_are_1_at_their_corner_and_0_at_the_others() {
        let corners = [DVec3::new(1.0, 2.0, 0.5), DVec3::new(-1.0, 0.3, 2.0), DVec3::new(0.2, -1.5, 1.0)];
        let planes = barycentric_planes(&corners, area_vector(&corners));
        for (k, corner) in corners.iter().enumerate() {
            for (plane, weight) in planes.iter().zip([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]) {
                assert!((plane.truncate().dot(*corner) + plane.w - weight[k]).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn only_the_hardened_form_gives_up_on_a_sliver() {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::new(0.5, 1e-9, 0.0)];
        let normal = area_vector(&corners);
        assert_eq!(face_normal(Form::Hardened, &corners, normal), DVec4::Z);
        assert!((face_normal(Form::Literal, &corners, normal) - DVec4::new(0.0, 0.0, 1.0, 1.0)).length() < 1e-12);
    }
}
