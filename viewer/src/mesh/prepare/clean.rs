//! Dropping triangles that no renderer can use.

use glam::{DVec3, Vec3};

use crate::mesh::{MeshReport, RawMesh};

use super::weld::Welded;

/// Twice the area, relative to the square of the longest edge, up to which a triangle has no area. Corners on a line
/// come out of rounded coordinates a little off it; what is below this is noise even in double precision.
const NO_AREA: f64 = 1e-12;

/// The triangles kept so far.
pub(super) struct Faces {
    /// Indices into the source's vertices.
    pub(super) corners: Vec<[u32; 3]>,
    /// Indices of the source's triangles, ascending.
    pub(super) origins: Vec<u32>,
}

impl Faces {
    /// Keeps those for which `keep` holds, in order.
    fn retain(&mut self, mut keep: impl FnMut([u32; 3]) -> bool) {
        let mut kept = 0;
        for face in 0..self.corners.len() {
            if keep(self.corners[face]) {
                self.corners[kept] = self.corners[face];
                self.origins[kept] = self.origins[face];
                kept += 1;
            }
        }
        self.corners.truncate(kept);
        self.origins.truncate(kept);
    }
}

/// Triangles with indices in range, finite coordinates and an area.
pub(super) fn usable(raw: &RawMesh, report: &mut MeshReport) -> Faces {
    let mut faces = Faces { corners: raw.triangles.clone(), origins: (0..raw.triangles.len() as u32).collect() };
    faces.retain(|corners| {
        let [Some(a), Some(b), Some(c)] = corners.map(|corner| raw.positions.get(corner as usize)) else {
            report.dropped_out_of_range += 1;
            return false;
        };
        if !(a.is_finite() && b.is_finite() && c.is_finite()) {
            report.dropped_non_finite += 1;
            return false;
        }
        // Before welding, since one stray needle would stretch the bounding box that the tolerance is relative to.
        let area = has_area([*a, *b, *c]);
        report.dropped_degenerate += usize::from(!area);
        area
    });
    faces
}

/// Drops triangles that welding left without area, and those with the points of an earlier one.
pub(super) fn drop_collapsed(raw: &RawMesh, welded: &Welded, faces: &mut Faces, report: &mut MeshReport) {
    let points_of = |corners: [u32; 3]| corners.map(|corner| welded.points[corner as usize]);
    faces.retain(|corners| {
        let points = points_of(corners);
        let area = has_area(points.map(|point| raw.positions[welded.leaders[point as usize] as usize]));
        report.dropped_degenerate += usize::from(!area);
        area
    });

    // Bucketed by their least point, as half-edges are for adjacency: cheaper than a hash table.
    let sorted = |corners: [u32; 3]| {
        let mut points = points_of(corners);
        points.sort_unstable();
        points
    };
    let mut starts = vec![0_u32; welded.leaders.len() + 1];
    faces.corners.iter().for_each(|&corners| starts[sorted(corners)[0] as usize + 1] += 1);
    for point in 0..welded.leaders.len() {
        starts[point + 1] += starts[point];
    }
    let mut filled = starts.clone();
    let mut buckets = vec![([0; 2], 0); faces.corners.len()];
    for (face, &corners) in faces.corners.iter().enumerate() {
        let [least, middle, greatest] = sorted(corners);
        let place = &mut filled[least as usize];
        buckets[*place as usize] = ([middle, greatest], face as u32);
        *place += 1;
    }
    let mut doubled = vec![false; faces.corners.len()];
    for ends in starts.windows(2) {
        let bucket = &mut buckets[ends[0] as usize..ends[1] as usize];
        bucket.sort_unstable();
        for pair in bucket.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
            doubled[pair[1].1 as usize] = true;
        }
    }
    let mut doubled = doubled.into_iter();
    faces.retain(|_| {
        let again = doubled.next() == Some(true);
        report.dropped_doubled += usize::from(again);
        !again
    });
}

/// Twice the area and the square of the longest edge.
pub(super) fn doubled_area(corners: [DVec3; 3]) -> (f64, f64) {
    let [ab, bc, ca] = [corners[1] - corners[0], corners[2] - corners[1], corners[0] - corners[2]];
    // Coordinates are those of f32 at most, so that fourth powers stay far inside the range of f64.
    (ab.cross(ca).length(), ab.length_squared().max(bc.length_squared()).max(ca.length_squared()))
}

fn has_area(corners: [Vec3; 3]) -> bool {
    let (doubled, longest_squared) = doubled_area(corners.map(Vec3::as_dvec3));
    doubled > NO_AREA * longest_squared
}
