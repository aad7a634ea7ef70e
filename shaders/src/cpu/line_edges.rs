//! Twin of `line_edges.wgsl`: the edges that are lines, in order.

use super::lib::edges::{LineKind, LineStyle, end_world, line_kind};
use super::lib::mesh::Mesh;
use super::lib::scene::Scene;
use crate::types::Edge;

/// Edges that one invocation looks at.
pub const BLOCK_EDGES: usize = 32;
/// Invocations of a group, one for each block.
pub const BLOCK_LANES: usize = 64;
/// Invocations that sum up the blocks.
pub const SUMMING_LANES: usize = 256;

/// Whether an edge is a line.
pub fn is_line(scene: &Scene, mesh: &Mesh<'_>, style: &LineStyle, edge: &Edge) -> bool {
    let middle = 0.5 * (end_world(scene, mesh, edge.a) + end_world(scene, mesh, edge.b));
    line_kind(scene, mesh, style, edge, middle) != LineKind::None
}

/// A bit for each edge that is a line, by block.
pub fn mark(scene: &Scene, mesh: &Mesh<'_>, style: &LineStyle, edges: &[Edge]) -> Vec<u32> {
    let bit = |(k, edge)| u32::from(is_line(scene, mesh, style, edge)) << k;
    edges.chunks(BLOCK_EDGES).map(|block| block.iter().enumerate().map(bit).sum()).collect()
}

/// The lines before each block, and all.
pub fn sum(marks: &[u32]) -> (Vec<u32>, u32) {
    let mut lines = 0;
    let before_this = |marks: &u32| {
        lines += marks.count_ones();
        lines - marks.count_ones()
    };
    let before = marks.iter().map(before_this).collect();
    (before, lines)
}

/// The edges that are marked, given how many are before each block.
///
/// # Panics
/// If `before` is not of these marks.
pub fn list(marks: &[u32], (before, lines): &(Vec<u32>, u32)) -> Vec<u32> {
    let mut listed = vec![0; *lines as usize];
    for (block, (marks, before)) in marks.iter().zip(before).enumerate() {
        let marked = (0..BLOCK_EDGES).filter(|k| marks >> k & 1 == 1);
        for (k, place) in marked.zip(*before as usize..) {
            listed[place] = (block * BLOCK_EDGES + k) as u32;
        }
    }
    listed
}
