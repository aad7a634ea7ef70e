//! Meshes and scenes of cases.

use glam::{DVec3, Vec3, vec3};

use super::case::StabilityError;
use crate::mesh::sample::Sample;
use crate::mesh::{Mesh, MeshError, NONE, Part, Placement, RawMesh, prepare};
use crate::scene::{Camera, Light, LightKind, Lights, Scene};

/// Corners and triangles.
pub(super) type Shape = (Vec<Vec3>, Vec<[u32; 3]>);

/// A square of two triangles that faces +z.
pub(super) fn square() -> Shape {
    let corners = vec![vec3(-1.0, -1.0, 0.0), vec3(1.0, -1.0, 0.0), vec3(1.0, 1.0, 0.0), vec3(-1.0, 1.0, 0.0)];
    (corners, vec![[0, 1, 2], [0, 2, 3]])
}

/// A sample of about so many triangles.
pub(super) fn sample(sample: Sample, triangles: usize) -> Result<Mesh, StabilityError> {
    Ok(prepare(sample.build(triangles))?.mesh)
}

/// A mesh from corners and triangles, loaded as any file is.
///
/// # Errors
/// Nothing is left of it.
pub fn loaded(positions: &[Vec3], triangles: &[[u32; 3]]) -> Result<Mesh, MeshError> {
    let raw = RawMesh { positions: positions.to_vec(), triangles: triangles.to_vec(), ..RawMesh::default() };
    Ok(prepare(raw)?.mesh)
}

/// A mesh as it is, without what loading mends: no welding, no orientation, no scaling. Neighbours are found by equal
/// vertex indices, as an implementation without those steps would.
pub fn unmended(positions: &[Vec3], triangles: &[[u32; 3]]) -> Mesh {
    let neighbour = |face: usize, a: u32, b: u32| {
        let shares = |corners: &[u32; 3]| corners.contains(&a) && corners.contains(&b);
        let found = triangles.iter().enumerate().find(|(other, corners)| *other != face && shares(corners));
        found.map_or(NONE, |(other, _)| other as u32)
    };
    let normals = positions.iter().map(|p| p.normalize_or(Vec3::Z)).collect();
    let count = positions.len() as u32;
    Mesh {
        name: "unmended".into(),
        normals,
        positions: positions.to_vec(),
        uvs: Vec::new(),
        points: (0..count).collect(),
        point_count: positions.len(),
        normal_groups: (0..count).collect(),
        midpoints: Vec::new(),
        sources: (0..count).collect(),
        neighbours: triangles
            .iter()
            .enumerate()
            .map(|(face, c)| [neighbour(face, c[0], c[1]), neighbour(face, c[1], c[2]), neighbour(face, c[2], c[0])])
            .collect(),
        parts: vec![Part { name: String::new(), colour: [1.0; 3], triangles: 0..triangles.len() as u32 }],
        triangles: triangles.to_vec(),
        placement: Placement { centre: DVec3::ZERO, scale: 1.0 },
        animation: None,
    }
}

/// A directional light from this side.
pub fn light_from(direction: DVec3) -> Light {
    Light { kind: LightKind::Directional { direction: -direction }, intensity: 1.0 }
}

/// A scene with one light, seen from the front.
pub(super) fn scene_with(light: Light) -> Scene {
    let camera = Camera { azimuth_deg: 0.0, elevation_deg: 0.0, distance: 4.0, ..Camera::default() };
    Scene { camera, lights: Lights { ambient: 0.0, lights: vec![light] }, ..Scene::default() }
}

/// The same on a material that is inked even where the light falls straight on it.
pub(super) fn dim(light: Light) -> Scene {
    let mut scene = scene_with(light);
    scene.materials[0].diffuse = 0.6;
    scene
}

/// A light in front, a little from the side and from above.
pub(super) fn slanting() -> Light {
    light_from(DVec3::new(0.5, 0.3, 1.0))
}

/// The same darkness everywhere, seen from the front.
pub(super) fn even(darkness: f64) -> Scene {
    let mut scene = scene_with(slanting());
    scene.lights = Lights { ambient: 1.0 - darkness, lights: Vec::new() };
    scene
}
