//! Signed distance functions to meshes of a wanted size.

use glam::Vec3;
use rayon::prelude::*;

use super::super::RawMesh;
use super::decimate::decimate;
use super::nets::{self, Net, Solid};
use super::place_in_box;

/// Spacing of the grid that finds out how much surface there is, as a fraction of the longest half extent.
const SURVEY_CELL: f32 = 1.0 / 36.0;
/// Rounds of evening out; more no longer move the worst percentile of angles.
const RELAXATIONS: usize = 4;
/// Rounds after contraction, which has already placed vertices well.
const RELAXATIONS_AFTER: usize = 2;

/// The solid's surface in about `triangles` triangles, its box normalised.
///
/// `coarsest` is the grid spacing that still tells all its parts apart; meshes smaller than that grid yields are made
/// by contracting edges.
pub(super) fn mesh(solid: &Solid, coarsest: f32, triangles: usize) -> RawMesh {
    let survey_cell = coarsest.min(SURVEY_CELL * solid.half_extent.max_element());
    let survey = nets::extract(solid, survey_cell);
    // Grid edges that a surface crosses grow with the square of the resolution; twice as many triangles.
    let wanted_cell = survey_cell * (survey.quads.len() as f32 * 2.0 / triangles as f32).sqrt();
    let cell = wanted_cell.min(coarsest);
    let net = if cell == survey_cell { survey } else { nets::extract(solid, cell) };
    let Net { mut positions, quads } = net;
    nets::relax(solid, &mut positions, &quads, cell, RELAXATIONS);
    let mut faces = split(&positions, &quads);
    if faces.len() > triangles + triangles / 8 {
        decimate(&mut positions, &mut faces, triangles);
        nets::relax(solid, &mut positions, &faces, cell, RELAXATIONS_AFTER);
    }
    let normals = normals(&positions, &faces);
    let mut mesh = RawMesh { positions, normals, triangles: faces, ..RawMesh::default() };
    place_in_box(&mut mesh);
    mesh
}

/// Means of the faces' normals by area. The function's own gradient would show details that the triangles do not have.
fn normals(positions: &[Vec3], faces: &[[u32; 3]]) -> Vec<Vec3> {
    let mut sums = vec![Vec3::ZERO; positions.len()];
    for &face in faces {
        let [a, b, c] = face.map(|i| positions[i as usize]);
        let double_area = (b - a).cross(c - a);
        for corner in face {
            sums[corner as usize] += double_area;
        }
    }
    sums.iter().map(|sum| sum.normalize_or(Vec3::Y)).collect()
}

/// Cuts quads along the diagonal that leaves the larger smallest angle.
fn split(positions: &[Vec3], quads: &[[u32; 4]]) -> Vec<[u32; 3]> {
    quads
        .par_iter()
        .flat_map_iter(|&[a, b, c, d]| {
            let worst = |faces: [[u32; 3]; 2]| shape(positions, faces[0]).min(shape(positions, faces[1]));
            let cuts = [[[a, b, c], [a, c, d]], [[b, c, d], [b, d, a]]];
            if worst(cuts[0]) >= worst(cuts[1]) { cuts[0] } else { cuts[1] }
        })
        .collect()
}

/// Area over the sum of squared edges: 0 for a degenerate triangle, largest for an equilateral one.
pub(super) fn shape(positions: &[Vec3], face: [u32; 3]) -> f32 {
    let [a, b, c] = face.map(|i| positions[i as usize]);
    (b - a).cross(c - a).length() / (a.distance_squared(b) + b.distance_squared(c) + c.distance_squared(a)).max(1e-30)
}
