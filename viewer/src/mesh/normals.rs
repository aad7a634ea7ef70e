//! Smooth normals of a mesh, at rest or deformed.

use glam::Vec3;
use rayon::prelude::*;

use super::Mesh;

/// Angle between two faces above which their common edge is a crease: their normals there are not shared.
pub const CREASE_DEGREES: f32 = 40.0;

/// Area, relative to the square of the longest edge, below which a triangle is a sliver: its normal is noise.
pub const SLIVER: f32 = 1e-6;

/// What a sliver's normal counts for, so that it decides only where nothing else does.
const SLIVER_WEIGHT: f32 = 1e-6;

/// Items per task, below which threads cost more than they save.
const GRAIN: usize = 8192;

impl Mesh {
    /// Smooth normals for other positions of the same vertices, into `out`: per normal group the mean of its faces'
    /// normals, weighted by the angle at the corner. Where there is none (all faces collapsed) the normal at rest.
    ///
    /// The same bits for any number of threads. `positions` are per vertex, as [`Mesh::positions`]; fewer are a
    /// programming error and panic.
    ///
    /// Thürmer and Wüthrich, "Computing vertex normals from polygonal facets", 1998.
    pub fn normals_of(&self, positions: &[Vec3], out: &mut Vec<Vec3>) {
        assert_eq!(positions.len(), self.positions.len(), "one position per vertex");
        let at_corners = |triangle: &[u32; 3]| corner_normals(triangle.map(|vertex| positions[vertex as usize]));
        let corners: Vec<[Vec3; 3]> = self.triangles.par_iter().with_min_len(GRAIN).map(at_corners).collect();
        // Summed in the order of the triangles, whoever computed them.
        let groups = self.normal_groups.iter().max().map_or(0, |&group| group as usize + 1);
        let mut sums = vec![Vec3::ZERO; groups];
        for (triangle, normals) in self.triangles.iter().zip(&corners) {
            for (&vertex, &normal) in triangle.iter().zip(normals) {
                sums[self.normal_groups[vertex as usize] as usize] += normal;
            }
        }
        let groups = self.normal_groups.par_iter().with_min_len(GRAIN);
        groups
            .zip(&self.normals)
            .map(|(&group, &rest)| sums[group as usize].try_normalize().unwrap_or(rest))
            .collect_into_vec(out);
    }
}

/// The face's unit normal, weighted for each corner; zero if the face has no area.
fn corner_normals([a, b, c]: [Vec3; 3]) -> [Vec3; 3] {
    let edges = [b - a, c - b, a - c];
    let longest_squared = edges.iter().map(|edge| edge.length_squared()).fold(0.0, f32::max);
    let cross = edges[0].cross(-edges[2]);
    let doubled = cross.length();
    let Some(normal) = cross.try_normalize() else { return [Vec3::ZERO; 3] };
    let weight = if doubled / 2.0 < SLIVER * longest_squared { SLIVER_WEIGHT } else { 1.0 };
    // The cross product of any two edges is the same, twice the area.
    let angle = |next: Vec3, previous: Vec3| doubled.atan2(-next.dot(previous));
    [
        normal * (weight * angle(edges[0], edges[2])),
        normal * (weight * angle(edges[1], edges[0])),
        normal * (weight * angle(edges[2], edges[1])),
    ]
}
