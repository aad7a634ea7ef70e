//! Who shares an edge with whom.

use crate::mesh::{MeshReport, NONE};

/// Per triangle the one across each edge (corner k to k + 1), however the two are oriented.
///
/// An edge of more than two triangles is a boundary to all of them. Reports edges by kind, and Euler's characteristic.
/// No two triangles have the same three points, so that two triangles share at most one edge.
pub(in crate::mesh) fn neighbours(triangles: &[[u32; 3]], points: usize, report: &mut MeshReport) -> Vec<[u32; 3]> {
    // Half-edges, bucketed by their lesser point: linear, where sorting all would not be.
    let mut starts = vec![0_u32; points + 1];
    for triangle in triangles {
        (0..3).for_each(|k| starts[triangle[k].min(triangle[(k + 1) % 3]) as usize + 1] += 1);
    }
    for point in 0..points {
        starts[point + 1] += starts[point];
    }
    let mut filled = starts.clone();
    let mut half_edges = vec![(0_u32, 0_u32); triangles.len() * 3];
    for (face, triangle) in triangles.iter().enumerate() {
        for k in 0..3 {
            let (from, to) = (triangle[k], triangle[(k + 1) % 3]);
            let place = &mut filled[from.min(to) as usize];
            half_edges[*place as usize] = (from.max(to), (face * 3 + k) as u32);
            *place += 1;
        }
    }

    let mut neighbours = vec![[NONE; 3]; triangles.len()];
    let mut edges = 0;
    for point in 0..points {
        let bucket = &mut half_edges[starts[point] as usize..starts[point + 1] as usize];
        bucket.sort_unstable();
        for edge in bucket.chunk_by(|a, b| a.0 == b.0) {
            edges += 1;
            match *edge {
                [_] => report.boundary_edges += 1,
                [(_, a), (_, b)] => {
                    neighbours[a as usize / 3][a as usize % 3] = b / 3;
                    neighbours[b as usize / 3][b as usize % 3] = a / 3;
                }
                _ => report.non_manifold_edges += 1,
            }
        }
    }
    report.euler = points as i64 - edges + triangles.len() as i64;
    neighbours
}
