//! Where the mouse points on a mesh.

use glam::{DMat4, DVec2, DVec3, Vec3};
use rayon::prelude::*;

use crate::Camera;
use crate::mesh::Mesh;

/// A line of sight, in the world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ray {
    /// Where it starts.
    pub from: DVec3,
    /// Unit.
    pub along: DVec3,
}

impl Ray {
    /// Through a place of the picture, -1..=1 from left to right and from bottom to top; `aspect` is width over height.
    pub(crate) fn through(camera: &Camera, at: DVec2, aspect: f64) -> Self {
        let (from, along) = camera.ray(at, aspect);
        Self { from, along }
    }
}

/// The nearest point, in the world, of a mesh at rest that stands somewhere, and how far it is.
pub(crate) fn pick_placed(mesh: &Mesh, world_from_mesh: DMat4, ray: &Ray) -> Option<(DVec3, f64)> {
    let mesh_from_world = world_from_mesh.inverse();
    let along = mesh_from_world.transform_vector3(ray.along);
    let in_mesh = Ray { from: mesh_from_world.transform_point3(ray.from), along: along.normalize() };
    let point = world_from_mesh.transform_point3(pick(mesh, &in_mesh)?);
    Some((point, point.distance(ray.from)))
}

/// The nearest point of a mesh at rest on a ray.
pub(crate) fn pick(mesh: &Mesh, ray: &Ray) -> Option<DVec3> {
    let (from, along) = (ray.from.as_vec3(), ray.along.as_vec3());
    let hit = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|vertex| mesh.positions[vertex as usize]);
        distance(from, along, a, b, c)
    };
    let nearest = mesh.triangles.par_iter().filter_map(hit).reduce_with(f32::min)?;
    Some(ray.from + ray.along * f64::from(nearest))
}

/// Where the ray meets a triangle, seen from either side (Möller and Trumbore 1997).
fn distance(from: Vec3, along: Vec3, a: Vec3, b: Vec3, c: Vec3) -> Option<f32> {
    let (ab, ac) = (b - a, c - a);
    let across = along.cross(ac);
    let volume = ab.dot(across);
    if volume == 0.0 {
        return None;
    }
    let to_start = from - a;
    let u = to_start.dot(across) / volume;
    let turned = to_start.cross(ab);
    let v = along.dot(turned) / volume;
    let distance = ac.dot(turned) / volume;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0).then_some(distance)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::prepare;
    use crate::mesh::sample::Sample;

    #[test]
    fn a_mesh_that_stands_elsewhere_is_picked_there() {
        let mesh = prepare(Sample::Sphere.build(20_000)).expect("a sphere").mesh;
        let camera = Camera::default();
        let middle = DVec3::new(0.5, 0.3, -0.4);
        let world =
            DMat4::from_translation(middle) * DMat4::from_rotation_y(1.0) * DMat4::from_scale(DVec3::splat(0.4));
        let at = camera.clip_from_world([300, 200], 2.0).project_point3(middle).truncate();
        let (point, distance) = pick_placed(&mesh, world, &Ray::through(&camera, at, 1.5)).expect("it is hit");
        assert!((point.distance(middle) - 0.4).abs() < 2e-3, "{point}");
        assert!((distance - point.distance(camera.place())).abs() < 1e-9);
        assert!(pick_placed(&mesh, world, &Ray::through(&camera, -at, 1.5)).is_none());
    }

    #[test]
    fn what_is_picked_is_under_the_mouse_and_on_the_near_side() {
        let mesh = prepare(Sample::Sphere.build(20_000)).expect("a sphere").mesh;
        let camera = Camera::default();
        for at in [DVec2::ZERO, DVec2::new(0.3, -0.2), DVec2::new(-0.4, 0.4)] {
            let ray = Ray::through(&camera, at, 1.5);
            let point = pick(&mesh, &ray).expect("the sphere is hit");
            assert!((point.length() - 1.0).abs() < 2e-3, "{point}");
            let placed = camera.clip_from_world([300, 200], 2.0).project_point3(point);
            assert!(placed.truncate().distance(at) < 1e-5, "{placed}");
            assert!(point.dot(camera.forward()) < 0.0);
        }
        assert!(pick(&mesh, &Ray::through(&camera, DVec2::new(0.99, 0.99), 1.5)).is_none());
    }
}
