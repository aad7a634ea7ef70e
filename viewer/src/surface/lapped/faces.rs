//! Triangles laid flat, each in a plane of its own, with the direction of the strokes on it and its neighbours.

use faer::c64;
use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::surface::field::Field;
use crate::surface::graph::Graph;

/// No neighbour: a border, a hard edge, or an edge of more than two triangles.
pub(super) const NONE: u32 = u32::MAX;

/// Area, as a share of the square of the longest edge, below which a triangle has no plane of its own.
const SLIVER: f64 = 1e-4;

/// A triangle in its own plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Face {
    /// In mesh units, counter-clockwise; the first axis runs along the strokes, so that it is the s axis of a patch, or
    /// its opposite.
    pub(super) corners: [DVec2; 3],
    /// Across the edge from corner k to corner k + 1, or [`NONE`].
    pub(super) neighbours: [u32; 3],
}

impl Face {
    /// Twice the area, in mesh units squared.
    pub(super) fn doubled_area(&self) -> f64 {
        let [a, b, c] = self.corners;
        (b - a).perp_dot(c - a)
    }

    /// In mesh units.
    pub(super) fn longest_edge(&self) -> f64 {
        (0..3).map(|k| self.corners[k].distance(self.corners[(k + 1) % 3])).fold(0.0, f64::max)
    }

    /// Whether it is too thin to have a normal.
    pub(super) fn is_sliver(&self) -> bool {
        self.doubled_area() <= 2.0 * SLIVER * self.longest_edge().powi(2)
    }
}

/// All triangles of a surface.
pub(super) fn faces(graph: &Graph, field: &Field) -> Vec<Face> {
    let neighbours = neighbours(&graph.triangles);
    graph
        .triangles
        .par_iter()
        .zip(neighbours)
        .map(|(triangle, neighbours)| Face { corners: laid_flat(graph, field, *triangle), neighbours })
        .collect()
}

fn laid_flat(graph: &Graph, field: &Field, triangle: [u32; 3]) -> [DVec2; 3] {
    let places = triangle.map(|node| graph.positions[node as usize]);
    let [a, b, c] = places;
    let longest_squared = (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared());
    let normal = (b - a).cross(c - a);
    let normal = if normal.length() > 2.0 * SLIVER * longest_squared {
        normal.normalize()
    } else {
        let sum: DVec3 = triangle.iter().map(|node| graph.normals[*node as usize]).sum();
        sum.try_normalize().unwrap_or(graph.normals[triangle[0] as usize])
    };
    let along = mean_direction(graph, field, triangle, normal);
    let across = normal.cross(along);
    // From the first corner, so that far places do not cost digits.
    places.map(|place| DVec2::new((place - a).dot(along), (place - a).dot(across)))
}

/// The field's mean direction in a plane. Opposite directions are the same, so doubled angles are summed.
fn mean_direction(graph: &Graph, field: &Field, triangle: [u32; 3], normal: DVec3) -> DVec3 {
    let x = normal.any_orthonormal_vector();
    let y = normal.cross(x);
    let sum: c64 = triangle
        .iter()
        .map(|node| {
            let direction = field.direction(graph, *node as usize);
            let weight = field.strengths[*node as usize].max(1e-6);
            c64::from_polar(weight, 2.0 * direction.dot(y).atan2(direction.dot(x)))
        })
        .sum();
    let (sin, cos) = (sum.arg() / 2.0).sin_cos();
    x * cos + y * sin
}

/// Per triangle the one across each edge.
fn neighbours(triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    // Per edge: its nodes, the lesser first; whether the triangle runs along it that way; the triangle; the corner.
    let mut edges: Vec<([u32; 2], bool, u32, u32)> = triangles
        .par_iter()
        .enumerate()
        .flat_map_iter(|(face, corners)| {
            (0..3).map(move |k| {
                let (from, to) = (corners[k], corners[(k + 1) % 3]);
                ([from.min(to), from.max(to)], from < to, face as u32, k as u32)
            })
        })
        .collect();
    edges.par_sort_unstable();
    let mut neighbours = vec![[NONE; 3]; triangles.len()];
    for shared in edges.chunk_by(|a, b| a.0 == b.0) {
        // Triangles that run along their edge in the same way lie on different sides of the surface.
        if let [(_, false, a, i), (_, true, b, j)] = *shared {
            neighbours[a as usize][i as usize] = b;
            neighbours[b as usize][j as usize] = a;
        }
    }
    neighbours
}
