//! Which triangle is seen at each sample. Edges are functions of the homogeneous screen place, so triangles that reach
//! behind the camera need no clipping. Olano and Greer, "Triangle scan conversion using 2D homogeneous coordinates",
//! Graphics Hardware 1997.

use glam::{DVec2, DVec3, DVec4};
use rayon::prelude::*;

/// Rows that one task fills.
const BAND_ROWS: usize = 32;

/// A triangle on the grid of samples, whose places are in samples from the top left corner.
pub(crate) struct Triangle {
    /// Edge k is 0 along the edge opposite to corner k, and its share of 1 / w inside, times the determinant.
    edges: [DVec3; 3],
    determinant: f64,
    /// z / w and 1 - z / w are linear in the edges.
    depths: [f64; 3],
    /// Whether its front is seen.
    pub(crate) front: bool,
    /// First and last sample that it may cover, in x and y.
    from: [usize; 2],
    to: [usize; 2],
}

/// What is seen at a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Hit {
    pub(crate) triangle: u32,
    depth: f64,
}

impl Triangle {
    /// The triangle of three clip places; none where it is seen edge-on, behind the camera or beside the picture.
    pub(crate) fn new(clips: [DVec4; 3], grid: [usize; 2]) -> Option<Self> {
        let size = DVec2::new(grid[0] as f64, grid[1] as f64);
        // Homogeneous places in samples, y down.
        let place =
            |clip: DVec4| DVec3::new(0.5 * (clip.w + clip.x) * size.x, 0.5 * (clip.w - clip.y) * size.y, clip.w);
        let [a, b, c] = clips.map(place);
        let edges = [b.cross(c), c.cross(a), a.cross(b)];
        let determinant = a.dot(edges[0]);
        if determinant == 0.0 || !determinant.is_finite() || clips.iter().all(|clip| clip.w <= 0.0) {
            return None;
        }
        let (mut from, mut to) = ([0, 0], [grid[0] - 1, grid[1] - 1]);
        if clips.iter().all(|clip| clip.w > 0.0) {
            let flat = [a, b, c].map(|place| place.truncate() / place.z);
            let low = flat[0].min(flat[1]).min(flat[2]) - 0.5;
            let high = flat[0].max(flat[1]).max(flat[2]) - 0.5;
            if high.x < 0.0 || high.y < 0.0 || low.x > size.x || low.y > size.y {
                return None;
            }
            for i in 0..2 {
                from[i] = low[i].max(0.0).floor() as usize;
                to[i] = to[i].min(high[i].ceil() as usize);
            }
        }
        let depths = clips.map(|clip| clip.z);
        // y is turned over, so a front has a negative determinant.
        Some(Self { edges, determinant, depths, front: determinant < 0.0, from, to })
    }

    /// Barycentric weights at a place, true in space; they sum to 1, also outside of the triangle.
    pub(crate) fn weights(&self, place: DVec2) -> DVec3 {
        let shares = self.shares(place);
        shares / shares.element_sum()
    }

    fn shares(&self, place: DVec2) -> DVec3 {
        let at = place.extend(1.0);
        DVec3::from(self.edges.map(|edge| edge.dot(at)))
    }

    /// Depth, 0 near ..= 1 far, of a place inside and between near and far.
    fn depth_at(&self, place: DVec2) -> Option<f64> {
        let shares = self.shares(place) * self.determinant.signum();
        // Both triangles of an edge compute it from the same products, so no place falls between them.
        if shares.min_element() < 0.0 || shares.element_sum() <= 0.0 {
            return None;
        }
        let depth = shares.dot(DVec3::from(self.depths)) / self.determinant.abs();
        (0.0..=1.0).contains(&depth).then_some(depth)
    }
}

/// For each row of the grid and each sample of it, the nearest triangle; of two at the same depth the one drawn first.
pub(crate) fn visible(triangles: &[&Triangle], grid: [usize; 2]) -> Vec<Vec<Option<Hit>>> {
    let mut rows = vec![vec![None; grid[0]]; grid[1]];
    rows.par_chunks_mut(BAND_ROWS).enumerate().for_each(|(band, rows)| {
        let first = band * BAND_ROWS;
        for (i, triangle) in triangles.iter().enumerate() {
            let from = triangle.from[1].max(first);
            let to = (triangle.to[1] + 1).min(first + rows.len());
            for y in from..to {
                let across = triangle.from[0]..=triangle.to[0];
                for (x, seen) in rows[y - first][across.clone()].iter_mut().enumerate() {
                    let place = DVec2::new((across.start() + x) as f64 + 0.5, y as f64 + 0.5);
                    if let Some(depth) = triangle.depth_at(place)
                        && seen.is_none_or(|hit: Hit| depth < hit.depth)
                    {
                        *seen = Some(Hit { triangle: i as u32, depth });
                    }
                }
            }
        }
    });
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    const GRID: [usize; 2] = [40, 30];

    fn clip(x: f64, y: f64, z: f64, w: f64) -> DVec4 {
        DVec4::new(x * w, y * w, z * w, w)
    }

    fn count(triangles: &[Triangle]) -> usize {
        let triangles: Vec<&Triangle> = triangles.iter().collect();
        visible(&triangles, GRID).iter().flatten().flatten().count()
    }

    #[test]
    fn triangles_that_share_edges_through_samples_leave_no_hole() {
        // A fan around a sample's middle, whose edges run through rows and columns of other middles.
        let middle = clip(1.0 / 40.0, 1.0 / 30.0, 0.5, 1.3);
        let ring = [(2.0, 1.0 / 30.0), (2.0, 2.0), (1.0 / 40.0, 2.0), (-2.0, 1.3), (-2.0, 1.0 / 30.0), (0.3, -2.0)];
        let ring = ring.map(|(x, y)| clip(x * 3.0, y * 3.0, 0.5, 0.7));
        let fan: Vec<Triangle> =
            (0..6).filter_map(|i| Triangle::new([middle, ring[i], ring[(i + 1) % 6]], GRID)).collect();
        assert_eq!(fan.len(), 6);
        assert_eq!(count(&fan), GRID[0] * GRID[1]);
        assert!(count(&fan[1..]) < GRID[0] * GRID[1]);
    }

    #[test]
    fn weights_are_true_in_space_not_on_the_screen() {
        let near = clip(-0.5, -0.5, 0.1, 1.0);
        let far = clip(0.5, 0.5, 0.9, 3.0);
        let side = clip(0.5, -0.5, 0.5, 1.0);
        let triangle = Triangle::new([near, side, far], GRID).unwrap_or_else(|| panic!("it is seen"));
        // Half way on the screen between depths 1 and 3 is a quarter of the way in space.
        let weights = triangle.weights(DVec2::new(20.0, 15.0));
        assert!((weights - DVec3::new(0.75, 0.0, 0.25)).length() < 1e-12, "{weights}");
        assert!(triangle.front);
    }

    #[test]
    fn the_nearer_triangle_is_seen_and_one_behind_the_camera_is_not() {
        let at =
            |z: f64, w: f64| Triangle::new([clip(-9.0, -9.0, z, w), clip(9.0, -9.0, z, w), clip(0.0, 9.0, z, w)], GRID);
        let (Some(far), Some(near)) = (at(0.8, 1.0), at(0.2, 1.0)) else { panic!("they are seen") };
        let rows = visible(&[&far, &near], GRID);
        assert!(rows.iter().flatten().flatten().all(|hit| hit.triangle == 1));
        assert!(at(0.5, -1.0).is_none());
        // Half of it is behind the camera: what is in front is seen.
        let crossing =
            [DVec4::new(-1.0, -1.0, 0.5, 1.0), DVec4::new(1.0, -1.0, 0.5, 1.0), DVec4::new(0.0, 1.0, -0.2, -0.5)];
        let crossing = Triangle::new(crossing, GRID).unwrap_or_else(|| panic!("it is seen"));
        assert!(count(&[crossing]) > 0);
    }
}
