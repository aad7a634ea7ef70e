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
const RELAXATIONS_AFTER: usize = 1;

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
    keep_largest_piece(&mut positions, &mut faces);
    let normals = normals(&positions, &faces);
    let mut mesh = RawMesh { positions, normals, triangles: faces, ..RawMesh::default() };
    place_in_box(&mut mesh);
    mesh
}

/// Drops what is not connected to the largest piece: bubbles of a cell or two where a crease closes over itself.
fn keep_largest_piece(positions: &mut Vec<Vec3>, faces: &mut Vec<[u32; 3]>) {
    let mut parents: Vec<u32> = (0..positions.len() as u32).collect();
    fn root(parents: &mut [u32], mut v: u32) -> u32 {
        while parents[v as usize] != v {
            parents[v as usize] = parents[parents[v as usize] as usize];
            v = parents[v as usize];
        }
        v
    }
    for &[a, b, c] in &*faces {
        for other in [b, c] {
            let (a, other) = (root(&mut parents, a), root(&mut parents, other));
            parents[other as usize] = a;
        }
    }
    let roots: Vec<u32> = (0..positions.len() as u32).map(|v| root(&mut parents, v)).collect();
    let mut sizes = vec![0u32; positions.len()];
    for &root in &roots {
        sizes[root as usize] += 1;
    }
    let Some(largest) = (0..sizes.len()).max_by_key(|&root| sizes[root]) else { return };
    if sizes[largest] as usize == positions.len() {
        return;
    }
    let keeps: Vec<bool> = roots.iter().map(|&root| root as usize == largest).collect();
    faces.retain(|face| keeps[face[0] as usize]);
    let mut numbers = vec![0u32; positions.len()];
    let mut kept = 0;
    for (v, _) in keeps.iter().enumerate().filter(|&(_, &keep)| keep) {
        numbers[v] = kept as u32;
        positions[kept] = positions[v];
        kept += 1;
    }
    positions.truncate(kept);
    for face in faces {
        *face = face.map(|corner| numbers[corner as usize]);
    }
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
