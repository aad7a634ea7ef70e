//! What is known of each pixel of a view without drawing it: the surface seen there, its wanted darkness and the wanted
//! direction of strokes (arbitrary output variables, in the words of renderers).

use std::f64::consts::PI;

use glam::{DMat4, DQuat, DVec2, DVec3};
use rayon::prelude::*;
use tam_shaders::cpu::lib::light::{Reflectance, darkness};
use tam_shaders::cpu::lib::scene as twin;

use crate::mesh::Mesh;
use crate::reference::ReferenceError;
use crate::reference::raster::{self, Triangle};
use crate::scene::Scene;
use crate::surface::{Field, Graph};

/// The surface at the middle of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// Triangle of the mesh.
    pub face: u32,
    /// Barycentric weights of its corners, true in space; they sum to 1.
    pub weights: DVec3,
    /// Place in the world.
    pub p_world: DVec3,
    /// Unit: the smooth normal in the world, towards the side that is seen.
    pub normal: DVec3,
    /// n·v of the smooth normal and the direction to the camera: 1 seen flat on, 0 on the silhouette, less where the
    /// smooth normal turns away before the triangle does.
    pub facing: f64,
    /// Side of a pixel at this depth, in world units.
    pub px_world: f64,
    /// Wanted darkness, 0 paper ..= 1 ink.
    pub darkness: f64,
    /// Wanted direction of strokes on the screen, 0 .. π, from the right (x) towards the bottom (y) of the picture.
    /// None without a field, near its singularities, and where the direction is seen end-on.
    pub stroke_rad: Option<f64>,
}

/// All pixels of a view, by rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Aov {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// The surface seen at each pixel's middle.
    pub pixels: Vec<Option<Surface>>,
}

/// Wanted directions: a field on the graph of the mesh.
#[derive(Clone, Copy, Debug)]
pub struct Strokes<'a> {
    /// The graph of the same mesh.
    pub graph: &'a Graph,
    /// Directions at its nodes.
    pub field: &'a Field,
}

/// Directions of the three corners that nearly cancel are no direction: length of the mean of e^(2iθ).
const LEAST_AGREEMENT: f64 = 0.1;

/// Part of the length of a direction that must be left on the screen.
const LEAST_SHOWN: f64 = 0.02;

/// Neighbouring pixels further apart than so many times their footprint do not belong to one surface.
const FARTHEST: f64 = 4.0;

/// Slant beyond which footprints are not believed to grow.
const LEAST_FACING: f64 = 0.1;

/// Cosine between the smooth normals of neighbouring pixels below which an edge lies between them.
const EDGE_COSINE: f64 = 0.7;

impl Aov {
    /// A view of a mesh, as the renderer draws it with one sample per pixel. The same for any number of threads.
    ///
    /// The wanted direction is interpolated in double-angle form in the tangent plane of the smooth normal, each corner's
    /// direction carried there by the least rotation, dropped onto the triangle (strokes lie on triangles), and taken to
    /// the screen by the derivative of the projection.
    ///
    /// # Errors
    /// [`ReferenceError::Size`] for a picture without pixels, or with more than 65536 in one direction.
    pub fn new(
        mesh: &Mesh,
        scene: &Scene,
        size: [u32; 2],
        strokes: Option<Strokes<'_>>,
    ) -> Result<Self, ReferenceError> {
        if size.contains(&0) || size.iter().any(|side| *side > 1 << 16) {
            return Err(ReferenceError::Size { size: size.map(|side| side as f32), samples: 1 });
        }
        let view = View::new(mesh, scene, size);
        let grid = size.map(|side| side as usize);
        let clips: Vec<_> = view.p_world.par_iter().map(|p| view.scene.clip_from_world * p.extend(1.0)).collect();
        let triangle = |(face, corners): (usize, &[u32; 3])| {
            Triangle::new(corners.map(|vertex| clips[vertex as usize]), grid).map(|triangle| (face as u32, triangle))
        };
        let (faces, triangles): (Vec<u32>, Vec<Triangle>) =
            mesh.triangles.par_iter().enumerate().filter_map(triangle).collect::<Vec<_>>().into_iter().unzip();
        let rows = raster::visible(&triangles.iter().collect::<Vec<_>>(), grid);
        let surface = |(i, hit): (usize, &Option<raster::Hit>)| {
            let triangle = hit.as_ref()?.triangle as usize;
            let middle = DVec2::new((i % grid[0]) as f64, (i / grid[0]) as f64) + 0.5;
            let weights = triangles[triangle].weights(middle);
            Some(view.surface(faces[triangle], weights, triangles[triangle].front, strokes))
        };
        let hits: Vec<Option<raster::Hit>> = rows.into_iter().flatten().collect();
        Ok(Self { size, pixels: hits.par_iter().enumerate().map(surface).collect() })
    }

    /// The surface at a place in pixels; the first pixel reaches from 0 to 1.
    pub fn at(&self, place_px: DVec2) -> Option<&Surface> {
        self.pixels[self.index(place_px)?].as_ref()
    }

    /// Index of the pixel that holds a place.
    pub fn index(&self, place_px: DVec2) -> Option<usize> {
        let [width, height] = self.size.map(f64::from);
        let held = place_px.x >= 0.0 && place_px.y >= 0.0 && place_px.x < width && place_px.y < height;
        held.then(|| place_px.y as usize * self.size[0] as usize + place_px.x as usize)
    }

    /// Pixels that show the mesh.
    pub fn covered(&self) -> Vec<bool> {
        self.pixels.iter().map(Option::is_some).collect()
    }

    /// Whether two neighbouring pixels show one piece of surface, without a contour or a hard edge between them.
    pub fn joined(&self, i: usize, j: usize) -> bool {
        let (Some(a), Some(b)) = (&self.pixels[i], &self.pixels[j]) else { return false };
        let reach = FARTHEST * a.px_world.max(b.px_world) / a.facing.min(b.facing).max(LEAST_FACING);
        a.p_world.distance_squared(b.p_world) < reach * reach && a.normal.dot(b.normal) > EDGE_COSINE
    }

    /// Pixels that are at least so many pixels from every contour, border, hard edge and edge of the picture.
    pub fn interior(&self, depth_px: usize) -> Vec<bool> {
        let [width, height] = self.size.map(|side| side as usize);
        let mut inside = self.covered();
        for round in 0..depth_px {
            let before = inside.clone();
            inside.par_iter_mut().enumerate().filter(|(_, inside)| **inside).for_each(|(i, inside)| {
                let (x, y) = (i % width, i / width);
                if x == 0 || y == 0 || x + 1 == width || y + 1 == height {
                    *inside = false;
                    return;
                }
                let around =
                    [i - width - 1, i - width, i - width + 1, i - 1, i + 1, i + width - 1, i + width, i + width + 1];
                *inside = around.iter().all(|j| before[*j] && (round > 0 || self.joined(i, *j)));
            });
        }
        inside
    }
}

/// A mesh in the world, before a camera.
struct View<'a> {
    mesh: &'a Mesh,
    scene: twin::Scene,
    world_from_mesh: DMat4,
    p_world: Vec<DVec3>,
    /// By part.
    reflectances: Vec<Reflectance>,
}

impl<'a> View<'a> {
    fn new(mesh: &'a Mesh, scene: &Scene, size: [u32; 2]) -> Self {
        let radius = mesh.positions.iter().map(|p| f64::from(p.length())).fold(0.0, f64::max);
        // Through the records of the GPU, so that both see the same roundings.
        let shared = twin::Scene::from(&scene.shared(size, radius));
        let placed = |p: &glam::Vec3| shared.world_from_mesh.transform_point3(p.as_dvec3());
        let p_world = mesh.positions.par_iter().map(placed).collect();
        let reflectance = |part: usize| {
            let material = scene.material(part);
            Reflectance {
                ambient: material.ambient,
                diffuse: material.diffuse,
                specular: material.specular,
                shininess: material.shininess,
            }
        };
        let reflectances = (0..mesh.parts.len().max(1)).map(reflectance).collect();
        Self { mesh, world_from_mesh: shared.world_from_mesh, scene: shared, p_world, reflectances }
    }

    fn surface(&self, face: u32, weights: DVec3, front: bool, strokes: Option<Strokes<'_>>) -> Surface {
        let corners = self.mesh.triangles[face as usize].map(|vertex| vertex as usize);
        let mix = |values: [DVec3; 3]| values[0] * weights.x + values[1] * weights.y + values[2] * weights.z;
        let p_world = mix(corners.map(|vertex| self.p_world[vertex]));
        let normal = mix(corners.map(|vertex| self.mesh.normals[vertex].as_dvec3()));
        let normal = self.scene.world_from_mesh_normal.transform_vector3(normal).normalize_or_zero();
        let normal = if front { normal } else { -normal };
        let to_camera = self.scene.to_camera(p_world);
        let view = to_camera.normalize_or_zero();
        let reflectance = self.reflectances[self.mesh.part_of(face).min(self.reflectances.len() - 1)];
        let direction = strokes.and_then(|strokes| direction(strokes, face, weights));
        Surface {
            face,
            weights,
            p_world,
            normal,
            facing: normal.dot(view),
            px_world: self.scene.pixel_world_at_1 * (-to_camera.dot(self.scene.camera_forward)).max(1e-6),
            darkness: darkness(&self.scene, reflectance, p_world, normal, view),
            stroke_rad: direction.and_then(|direction| self.shown(p_world, direction)),
        }
    }

    /// Angle on the screen of a direction in mesh space.
    fn shown(&self, p_world: DVec3, direction: DVec3) -> Option<f64> {
        let direction = self.world_from_mesh.transform_vector3(direction).try_normalize()?;
        let at = self.scene.clip_from_world * p_world.extend(1.0);
        let change = self.scene.clip_from_world * direction.extend(0.0);
        // d(x / w) = (dx w - x dw) / w², from clip space, where y is up, to pixels, where it is down.
        let slope = |at_side: f64, change_side: f64| (change_side * at.w - at_side * change.w) / (at.w * at.w);
        let half = 0.5 * self.scene.viewport_px;
        let moved_px = DVec2::new(half.x * slope(at.x, change.x), -half.y * slope(at.y, change.y));
        let depth = -self.scene.to_camera(p_world).dot(self.scene.camera_forward);
        let px_per_world = 1.0 / (self.scene.pixel_world_at_1 * depth.max(1e-6));
        (moved_px.length() > LEAST_SHOWN * px_per_world).then(|| line_angle(moved_px))
    }
}

/// Direction of the field inside a triangle, in mesh space, in the triangle's plane.
fn direction(Strokes { graph, field }: Strokes<'_>, face: u32, weights: DVec3) -> Option<DVec3> {
    let nodes = graph.triangles[face as usize].map(|node| node as usize);
    let normals = nodes.map(|node| graph.normals[node]);
    let normal = (normals[0] * weights.x + normals[1] * weights.y + normals[2] * weights.z).try_normalize()?;
    let tangent = normal.any_orthonormal_vector();
    let bitangent = normal.cross(tangent);
    let mut mean = DVec2::ZERO;
    for k in 0..3 {
        let carried = DQuat::from_rotation_arc(normals[k], normal) * field.direction(graph, nodes[k]);
        let doubled = 2.0 * carried.dot(bitangent).atan2(carried.dot(tangent));
        mean += DVec2::from_angle(doubled) * weights[k];
    }
    if mean.length() < LEAST_AGREEMENT {
        return None;
    }
    let (sin, cos) = (0.5 * mean.to_angle()).sin_cos();
    let smooth = tangent * cos + bitangent * sin;
    let p = nodes.map(|node| graph.positions[node]);
    let flat = (p[1] - p[0]).cross(p[2] - p[0]).try_normalize()?;
    (smooth - flat * smooth.dot(flat)).try_normalize()
}

/// Angle of a line, 0 .. π.
pub(super) fn line_angle(along: DVec2) -> f64 {
    let angle = along.to_angle().rem_euclid(PI);
    if angle < PI { angle } else { 0.0 }
}

/// Angle between two lines, 0 ..= π / 2.
pub(super) fn line_distance(a_rad: f64, b_rad: f64) -> f64 {
    let apart = (a_rad - b_rad).rem_euclid(PI);
    apart.min(PI - apart)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::prepare;
    use crate::mesh::sample::Sample;
    use crate::surface::{FieldOptions, FieldSource, curvatures, field};
    use crate::{Camera, Light, Lights};

    const SIZE: [u32; 2] = [160, 120];

    fn sphere(triangles: usize) -> (Mesh, Scene) {
        let mesh = prepare(Sample::Sphere.build(triangles)).expect("a sphere").mesh;
        let lights = Lights { ambient: 0.1, lights: vec![Light::from_angles(30.0, 40.0)] };
        let camera = Camera { azimuth_deg: 20.0, elevation_deg: 25.0, ..Camera::default() };
        (mesh, Scene { camera, lights, ..Scene::default() })
    }

    #[test]
    fn places_normals_and_darkness_are_those_of_the_sphere() {
        let (mesh, scene) = sphere(60_000);
        let aov = Aov::new(&mesh, &scene, SIZE, None).expect("a view");
        let to_light = match scene.lights.lights[0].kind {
            crate::LightKind::Directional { direction } => -direction.normalize(),
            _ => unreachable!("the light is directional"),
        };
        let clip_from_world = scene.camera.clip_from_world(SIZE, 1.0);
        let mut seen = 0;
        for (i, surface) in aov.pixels.iter().enumerate() {
            let Some(surface) = surface else { continue };
            seen += 1;
            // Triangles lie within 1e-3 of the sphere.
            assert!((surface.p_world.length() - 1.0).abs() < 1e-3, "{surface:?}");
            assert!((surface.normal - surface.p_world.normalize()).length() < 3e-3, "{surface:?}");
            let view = (scene.camera.place() - surface.p_world).normalize();
            assert!((surface.facing - surface.p_world.normalize().dot(view)).abs() < 3e-3, "{surface:?}");
            let wanted = 1.0 - (0.1 + surface.p_world.normalize().dot(to_light).max(0.0)).min(1.0);
            assert!((surface.darkness - wanted).abs() < 5e-3, "{surface:?}, wanted {wanted}");
            let at = clip_from_world.project_point3(surface.p_world);
            let place = DVec2::new(0.5 + 0.5 * at.x, 0.5 - 0.5 * at.y) * DVec2::new(160.0, 120.0);
            let middle = DVec2::new((i % 160) as f64, (i / 160) as f64) + 0.5;
            assert!(place.distance(middle) < 1e-3, "{place} for {middle}");
        }
        // The circle of a sphere seen from 4.6 radii.
        let radius_px = 60.0 / (15.0_f64.to_radians().tan() * (4.6_f64 * 4.6 - 1.0).sqrt());
        let disc = PI * radius_px * radius_px;
        assert!((f64::from(seen) / disc - 1.0).abs() < 0.01, "{seen} of {disc:.0}");
    }

    /// Mean and greatest angle between the wanted direction and that of parallels on the sphere, in degrees.
    fn off_deg(triangles: usize, source: FieldSource) -> (f64, f64) {
        let (mesh, scene) = sphere(triangles);
        let graph = Graph::new(&mesh);
        let options = FieldOptions { source, smoothing: 0.1, ..FieldOptions::default() };
        let field = field(&graph, &mesh, &curvatures(&graph), &options).expect("a field");
        let aov = Aov::new(&mesh, &scene, SIZE, Some(Strokes { graph: &graph, field: &field })).expect("a view");
        let clip_from_world = scene.camera.clip_from_world(SIZE, 1.0);
        let place = |p: DVec3| {
            let at = clip_from_world.project_point3(p);
            DVec2::new(80.0 * at.x, -60.0 * at.y)
        };
        let error = |surface: &Surface| {
            let round = DVec3::Y.cross(surface.p_world).normalize();
            let clear = surface.p_world.y.abs() < 0.7 && surface.facing > 0.2;
            // By a difference, not by the derivative.
            let shown = place(surface.p_world + 1e-4 * round) - place(surface.p_world - 1e-4 * round);
            clear.then(|| surface.stroke_rad.map(|found| line_distance(found, line_angle(shown)).to_degrees()))
        };
        let errors: Vec<Option<f64>> = aov.pixels.iter().flatten().filter_map(error).collect();
        assert!(errors.len() > 2000 && errors.iter().all(Option::is_some), "{}", errors.len());
        let errors: Vec<f64> = errors.into_iter().flatten().collect();
        (errors.iter().sum::<f64>() / errors.len() as f64, errors.iter().copied().fold(0.0, f64::max))
    }

    #[test]
    fn directions_on_the_screen_are_those_of_the_parallels() {
        // Faces are up to 1.1° off the sphere, which a slant of n·v = 0.2 makes up to five times as much on the screen.
        let (mean, worst) = off_deg(20_000, FieldSource::Light(DVec3::Y));
        assert!(mean < 0.4 && worst < 5.5, "{mean} {worst}");
        // Faces of 14°: strokes lie in the faces.
        let (mean, worst) = off_deg(500, FieldSource::Light(DVec3::Y));
        assert!(mean < 3.0 && worst < 35.0, "{mean} {worst}");
        // The control: meridians.
        let (mean, _) = off_deg(20_000, FieldSource::Constant(DVec3::Y));
        assert!(mean > 60.0, "{mean}");
    }

    #[test]
    fn contours_and_hard_edges_are_no_interior() {
        let mesh = prepare(Sample::Cube.build(12)).expect("a cube").mesh;
        let aov = Aov::new(&mesh, &Scene::default(), SIZE, None).expect("a view");
        let (covered, interior) = (aov.covered(), aov.interior(2));
        let shown = |i: usize| aov.pixels[i].as_ref().map(|surface| surface.normal);
        let mut edges = 0;
        for i in 2 * 160..118 * 160 {
            let across = [i - 2, i + 2, i - 320, i + 320]
                .iter()
                .any(|j| shown(i).zip(shown(*j)).is_some_and(|(a, b)| a.dot(b) < 0.5) || covered[i] && !covered[*j]);
            edges += usize::from(across);
            assert!(!(across && interior[i]), "{i}");
        }
        let inside = interior.iter().filter(|inside| **inside).count();
        let all = covered.iter().filter(|covered| **covered).count();
        assert!(edges > 200 && inside > all / 2, "{edges} {inside} {all}");
    }

    #[test]
    fn pictures_without_pixels_are_told() {
        let (mesh, scene) = sphere(100);
        assert!(matches!(Aov::new(&mesh, &scene, [0, 9], None), Err(ReferenceError::Size { .. })));
    }
}
