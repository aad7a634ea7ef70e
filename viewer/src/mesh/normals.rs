//! Smooth normals of a mesh, at rest or deformed.

use glam::{DVec3, Vec3};
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
            .map(|(&group, &rest)| sums[group as usize].as_dvec3().try_normalize().map_or(rest, DVec3::as_vec3))
            .collect_into_vec(out);
    }
}

/// The face's unit normal, weighted for each corner; zero if the face has no area.
fn corner_normals(corners: [Vec3; 3]) -> [Vec3; 3] {
    // In f64: the square of a needle's area is below what f32 can hold.
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    let edges = [b - a, c - b, a - c];
    let longest_squared = edges.iter().map(|edge| edge.length_squared()).fold(0.0, f64::max);
    let cross = edges[0].cross(-edges[2]);
    let doubled = cross.length();
    let Some(normal) = cross.try_normalize().map(DVec3::as_vec3) else { return [Vec3::ZERO; 3] };
    let sliver = doubled / 2.0 < f64::from(SLIVER) * longest_squared;
    let weight = if sliver { SLIVER_WEIGHT } else { 1.0 };
    let angle = |next: DVec3, previous: DVec3| {
        // The cross product of any two edges is the same, twice the area. Only the ratio counts for the angle, and f32
        // is exact enough for it.
        let (sine, cosine) = (doubled / longest_squared, -next.dot(previous) / longest_squared);
        normal * (weight * (sine as f32).atan2(cosine as f32))
    };
    [angle(edges[0], edges[2]), angle(edges[1], edges[0]), angle(edges[2], edges[1])]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_count_by_their_angles_and_needles_next_to_nothing() {
        let right = corner_normals([Vec3::ZERO, Vec3::X, Vec3::Y]).map(|normal| normal.z);
        for (weight, angle) in right.into_iter().zip([90.0_f32, 45.0, 45.0]) {
            assert!((weight - angle.to_radians()).abs() < 1e-6);
        }
        let needle = corner_normals([Vec3::ZERO, Vec3::X * 2e-6, Vec3::new(1e-6, 1e-21, 0.0)]);
        // The angle at the third corner is nearly 180°.
        assert!(needle[2].z > 3e-6 && needle[2].z < 4e-6, "{}", needle[2]);
        assert_eq!(corner_normals([Vec3::ZERO, Vec3::X, Vec3::X * 2.0]), [Vec3::ZERO; 3]);
    }
}
