//! A patch laid flat so that its axes follow the field, as Praun and others 2000 optimise theirs.
//!
//! Over each triangle the gradients of s and t should be the field's direction and the one across it. Their squared
//! differences, weighted by area so that the cut into triangles does not matter, are least where L s = div along and
//! L t = div across, with L the cotangent Laplacian of the patch: one matrix for both.

use faer::sparse::Triplet;
use glam::DVec2;

use super::faces::Face;
use crate::surface::solve::{Factor, SolveError};

/// How much, of the mean diagonal, nodes hold on to where they were: the patch must not drift, and a node that only
/// triangles without area have stays somewhere.
const HOLD: f64 = 1e-8;

/// A triangle of a patch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Member {
    pub(super) face: u32,
    /// Corners, as indices into the places of the patch.
    pub(super) nodes: [u32; 3],
    /// 1, or -1 where the patch runs against the direction of the triangle's plane.
    pub(super) sign: f64,
}

/// The places of a patch's nodes, in tiles, moved to where they follow the field best.
pub(super) fn flatten(
    faces: &[Face],
    members: &[Member],
    tiles_per_unit: f64,
    places: &mut [DVec2],
) -> Result<(), SolveError> {
    let mut lower: Vec<Triplet<usize, usize, f64>> = Vec::with_capacity(6 * members.len() + places.len());
    let mut right = vec![DVec2::ZERO; places.len()];
    let mut trace = 0.0;
    for member in members {
        let face = &faces[member.face as usize];
        // An edge turned by a quarter: twice the area times the gradient of the corner opposite to it.
        let turned = [0, 1, 2].map(|k| (face.corners[(k + 2) % 3] - face.corners[(k + 1) % 3]).perp());
        let floor = 1e-6 * face.longest_edge().powi(2);
        if floor == 0.0 {
            continue;
        }
        let doubled_area = face.doubled_area().max(floor);
        for (k, i) in member.nodes.into_iter().enumerate() {
            // The wanted gradients are the axes of the plane.
            right[i as usize] += turned[k] * (0.5 * member.sign * tiles_per_unit);
            for (l, j) in member.nodes.into_iter().enumerate().filter(|(_, j)| *j <= i) {
                let entry = turned[k].dot(turned[l]) / (2.0 * doubled_area);
                lower.push(Triplet::new(i as usize, j as usize, entry));
                trace += if k == l { entry } else { 0.0 };
            }
        }
    }
    // No triangle has an area: nothing says where they belong.
    if trace.is_nan() || trace <= 0.0 {
        return Ok(());
    }
    let hold = HOLD * trace / places.len() as f64;
    lower.extend((0..places.len()).map(|node| Triplet::new(node, node, hold)));
    let factor = Factor::new(places.len(), &lower)?;
    let s = factor.solve(|node| right[node].x + hold * places[node].x);
    let t = factor.solve(|node| right[node].y + hold * places[node].y);
    for (place, (s, t)) in places.iter_mut().zip(s.into_iter().zip(t)) {
        *place = DVec2::new(s, t);
    }
    Ok(())
}
