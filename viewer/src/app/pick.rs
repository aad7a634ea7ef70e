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
    // Distances are counted from the place nearest to the mesh's origin: parallel lines of sight start far before it, and
    // single floats have a step of their own there.
    let start = -ray.from.dot(ray.along);
    let middle = ray.from + ray.along * start;
    let (from, along) = (middle.as_vec3(), ray.along.as_vec3());
    let hit = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|vertex| mesh.positions[vertex as usize]);
        distance(from, along, a, b, c).filter(|distance| start + f64::from(*distance) > 0.0)
    };
    let nearest = mesh.triangles.par_iter().filter_map(hit).reduce_with(f32::min)?;
    Some(middle + ray.along * f64::from(nearest))
}

/// Where the line of a ray meets a triangle, seen from either side, before its start or behind (Möller and Trumbore 1997).
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
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0).then_some(distance)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Projection;
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
        for projection in Projection::ALL {
            let camera = Camera { projection, roll_deg: 20.0, ..Camera::default() };
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

    #[test]
    fn parallel_sight_picks_as_finely_as_any_and_nothing_behind_a_camera_is_picked() {
        let mesh = prepare(Sample::Quad.build(2)).expect("a plane").mesh;
        let camera = Camera { projection: Projection::Orthographic, ..Camera::default() };
        for x in [-0.31, 0.07, 0.4] {
            let ray = Ray::through(&camera, DVec2::new(x, 0.1), 1.0);
            let point = pick(&mesh, &ray).expect("the plane is hit");
            let [a, b, c] = mesh.triangles[0].map(|vertex| mesh.positions[vertex as usize].as_dvec3());
            let off = (point - a).dot((b - a).cross(c - a).normalize());
            assert!(off.abs() < 1e-6, "{off}");
        }
        let inside = Ray { from: DVec3::new(0.0, 0.0, 0.1), along: DVec3::Z };
        let sphere = prepare(Sample::Sphere.build(2000)).expect("a sphere").mesh;
        assert!(pick(&sphere, &inside).is_some_and(|point| point.z > 0.5));
        assert!(pick(&sphere, &Ray { from: DVec3::new(0.0, 0.0, 1.5), along: DVec3::Z }).is_none());
    }
}
