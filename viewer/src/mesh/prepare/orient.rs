//! Turning triangles around until neighbours agree.

use crate::mesh::{MeshReport, NONE};

use super::clean::Faces;
use super::weld::Surface;

/// Orients every component consistently; tells which triangles were turned around.
///
/// A closed component gets a positive volume; an open one keeps the orientation of most of its triangles. Where the
/// search comes back to a triangle on its wrong side, the edge is cut.
pub(super) fn orient(
    surface: &mut Surface,
    faces: &mut Faces,
    neighbours: &mut [[u32; 3]],
    report: &mut MeshReport,
) -> Vec<bool> {
    let count = surface.triangles.len();
    let mut seen = vec![false; count];
    let mut flipped = vec![false; count];
    // The queue of the breadth-first search: when it is done, a component is a stretch of it.
    let mut queue: Vec<u32> = Vec::with_capacity(count);
    for seed in 0..count {
        if seen[seed] {
            continue;
        }
        report.components += 1;
        seen[seed] = true;
        let begin = queue.len();
        queue.push(seed as u32);
        let mut next = begin;
        while let Some(&face) = queue.get(next) {
            next += 1;
            for k in 0..3 {
                let other = neighbours[face as usize][k];
                if other == NONE {
                    continue;
                }
                let (j, along) = shared_edge(&surface.triangles, face, k, other);
                // Both run along the edge the same way: one of the two is the wrong way round.
                let wanted = flipped[face as usize] ^ along;
                if !seen[other as usize] {
                    seen[other as usize] = true;
                    flipped[other as usize] = wanted;
                    queue.push(other);
                } else if flipped[other as usize] != wanted {
                    neighbours[face as usize][k] = NONE;
                    neighbours[other as usize][j] = NONE;
                    report.cut_edges += 1;
                }
            }
        }
        let component = &queue[begin..];
        if turned_in(surface, neighbours, component, &flipped) {
            component.iter().for_each(|&face| flipped[face as usize] ^= true);
        }
    }
    report.closed = report.boundary_edges + report.non_manifold_edges + report.cut_edges == 0;

    for face in (0..count).filter(|&face| flipped[face]) {
        surface.triangles[face].swap(1, 2);
        faces.corners[face].swap(1, 2);
        // Edges ab, bc, ca have become ac, cb, ba.
        neighbours[face].swap(0, 2);
    }
    report.flipped = flipped.iter().filter(|flipped| **flipped).count();
    flipped
}

/// The edge of `other` that is edge `k` of `face`, and whether both run along it the same way.
fn shared_edge(triangles: &[[u32; 3]], face: u32, k: usize, other: u32) -> (usize, bool) {
    let (from, to) = (triangles[face as usize][k], triangles[face as usize][(k + 1) % 3]);
    let ring = triangles[other as usize];
    let edge = (0..3).find(|&j| {
        let (a, b) = (ring[j], ring[(j + 1) % 3]);
        (a, b) == (from, to) || (b, a) == (from, to)
    });
    let j = edge.expect("neighbours share an edge");
    (j, ring[j] == from)
}

/// Whether a component, consistent as `flipped` says, should be turned around as a whole.
fn turned_in(surface: &Surface, neighbours: &[[u32; 3]], component: &[u32], flipped: &[bool]) -> bool {
    if component.iter().any(|&face| neighbours[face as usize].contains(&NONE)) {
        let turned = component.iter().filter(|&&face| flipped[face as usize]).count();
        return turned * 2 > component.len();
    }
    // Seen from one of its own points, so that a distant origin costs no digits.
    let position = |point: u32| surface.points[point as usize].as_dvec3();
    let origin = position(surface.triangles[component[0] as usize][0]);
    let volume: f64 = component
        .iter()
        .map(|&face| {
            let [a, b, c] = surface.triangles[face as usize].map(|point| position(point) - origin);
            let volume = a.dot(b.cross(c));
            if flipped[face as usize] { -volume } else { volume }
        })
        .sum();
    volume < 0.0
}
