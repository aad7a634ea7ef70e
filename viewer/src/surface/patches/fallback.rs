//! A patch for one triangle alone: its own plane, along the field. Triangles far larger than a patch, and those that
//! no patch covers without a fold, are drawn so; nothing is left unpainted.

use glam::DVec2;

use crate::surface::field::Field;
use crate::surface::graph::Graph;

/// Places of the corners in the triangle's plane, in mesh units.
pub(super) fn planar(graph: &Graph, field: &Field, triangle: [u32; 3]) -> [DVec2; 3] {
    let [a, b, c] = triangle.map(|node| graph.positions[node as usize]);
    let first = triangle[0] as usize;
    let normal = (b - a).cross(c - a).try_normalize().unwrap_or(graph.normals[first]);
    let along = field.direction(graph, first);
    let along = (along - normal * along.dot(normal)).try_normalize().unwrap_or(graph.tangents[first]);
    let across = normal.cross(along);
    // From the origin, so that neighbours in one plane agree.
    [a, b, c].map(|p| DVec2::new(p.dot(along), p.dot(across)))
}
