//! Which corners share a normal.

use glam::Vec3;
use rayon::prelude::*;

use crate::mesh::normals::{CREASE_DEGREES, SLIVER};
use crate::mesh::table::{Table, join};
use crate::mesh::{MeshReport, NONE, RawMesh};

use super::clean::{Faces, doubled_area};
use super::weld::Surface;

/// Steps per unit in which normals of the file are compared.
const NORMAL_STEPS: f32 = 1024.0;

/// The triangles' normals and which of them say nothing.
pub(super) struct Shape {
    normals: Vec<Vec3>,
    slivers: Vec<bool>,
}

impl Shape {
    /// Counts the slivers.
    pub(super) fn new(surface: &Surface, report: &mut MeshReport) -> Self {
        let shape = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|point| surface.points[point as usize].as_dvec3());
            let (doubled, longest_squared) = doubled_area([a, b, c]);
            let normal = (b - a).cross(c - a).normalize_or_zero().as_vec3();
            (normal, doubled / 2.0 < f64::from(SLIVER) * longest_squared)
        };
        let (normals, slivers): (Vec<_>, Vec<_>) = surface.triangles.par_iter().map(shape).unzip();
        report.slivers = slivers.iter().filter(|sliver| **sliver).count();
        Self { normals, slivers }
    }
}

/// Normal groups of the corners.
pub(super) struct Groups {
    /// Per triangle and corner.
    pub(super) corners: Vec<[u32; 3]>,
    /// Per group the file's normal, of unit length, or that of a face of it.
    pub(super) normals: Vec<Vec3>,
    /// Per group whether the normal is the file's.
    pub(super) given: Vec<bool>,
}

/// Corners at one point share a group if the file gives them the same usable normal; those without one, if no crease,
/// boundary or non-manifold edge comes between them.
///
/// A normal is usable if it is finite, not zero and not on the other side of the face. If a face was turned around,
/// normals that went with its old orientation are turned around too.
pub(super) fn groups(
    raw: &RawMesh,
    surface: &Surface,
    faces: &Faces,
    neighbours: &[[u32; 3]],
    shape: &Shape,
    flipped: &[bool],
    report: &mut MeshReport,
) -> Groups {
    let (smooth, smooth_normals) = smooth_groups(surface, neighbours, shape);
    if raw.normals.is_empty() {
        return Groups { corners: smooth, given: vec![false; smooth_normals.len()], normals: smooth_normals };
    }
    let mut groups = Groups { corners: smooth, normals: Vec::new(), given: Vec::new() };
    let mut table = Table::new(surface.points.len() * 2);
    let mut keys: Vec<[u32; 4]> = Vec::new();
    // Per vertex of the source the group of its own normal: saves the search for all but the first corner.
    let mut known = vec![NONE; raw.positions.len()];
    for (face, corners) in faces.corners.iter().enumerate() {
        for (k, &source) in corners.iter().enumerate() {
            let source = source as usize;
            let normal = usable_normal(raw.normals[source], face, shape, flipped[face]);
            let own = normal.is_some_and(|normal| normal.dot(raw.normals[source]) > 0.0);
            if own && known[source] != NONE {
                groups.corners[face][k] = known[source];
                continue;
            }
            let key = match normal {
                Some(normal) => {
                    let [x, y, z] = (normal * NORMAL_STEPS).round().to_array().map(|step| step as i32 as u32);
                    [surface.triangles[face][k], x, y, z]
                }
                // No normal has three equal steps as far out as this.
                None => [groups.corners[face][k], NONE, NONE, NONE / 2],
            };
            report.normals_refused += usize::from(normal.is_none());
            let (group, new) = table.find_or_insert(join(&key), |other| keys[other as usize] == key);
            if new {
                keys.push(key);
                groups.normals.push(normal.unwrap_or(shape.normals[face]));
                groups.given.push(normal.is_some());
            }
            if own {
                known[source] = group;
            }
            groups.corners[face][k] = group;
        }
    }
    groups
}

/// The file's normal at a corner of a face, of unit length, on the face's side.
fn usable_normal(normal: Vec3, face: usize, shape: &Shape, flipped: bool) -> Option<Vec3> {
    let normal = normal.as_dvec3().try_normalize()?.as_vec3();
    let opposed = !shape.slivers[face] && normal.dot(shape.normals[face]) < 0.0;
    match (opposed, flipped) {
        (false, _) => Some(normal),
        (true, true) => Some(-normal),
        (true, false) => None,
    }
}

/// Groups by creases alone, and per group the normal of one of its faces.
fn smooth_groups(surface: &Surface, neighbours: &[[u32; 3]], shape: &Shape) -> (Vec<[u32; 3]>, Vec<Vec3>) {
    let least_cosine = CREASE_DEGREES.to_radians().cos();
    let smooth = |face: u32, other: u32| {
        let (face, other) = (face as usize, other as usize);
        shape.slivers[face] || shape.slivers[other] || shape.normals[face].dot(shape.normals[other]) >= least_cosine
    };
    let mut corners = vec![[NONE; 3]; surface.triangles.len()];
    let mut normals = Vec::new();
    for seed in 0..surface.triangles.len() {
        for seed_corner in 0..3 {
            if corners[seed][seed_corner] != NONE {
                continue;
            }
            let group = normals.len() as u32;
            normals.push(shape.normals[seed]);
            corners[seed][seed_corner] = group;
            let point = surface.triangles[seed][seed_corner];
            // Around the point both ways: across the edge that leaves it, and the one that comes to it.
            for step in [0, 2] {
                let (mut face, mut corner) = (seed as u32, seed_corner);
                loop {
                    let other = neighbours[face as usize][(corner + step) % 3];
                    if other == NONE || !smooth(face, other) {
                        break;
                    }
                    let ring = surface.triangles[other as usize];
                    let Some(there) = ring.iter().position(|&at| at == point) else { break };
                    if corners[other as usize][there] != NONE {
                        break;
                    }
                    corners[other as usize][there] = group;
                    (face, corner) = (other, there);
                }
            }
        }
    }
    (corners, normals)
}
