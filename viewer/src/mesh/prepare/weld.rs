//! Uniting vertices that lie in one place.

use glam::{DVec3, Vec3};

use crate::mesh::table::{Table, join};
use crate::mesh::{MeshReport, NONE, RawMesh};

use super::clean::Faces;

/// Distance up to which vertices are one point, relative to the diagonal of the bounding box.
const TOLERANCE: f64 = 1e-6;

/// Side of a grid cell in tolerances: most vertices then have to look into one or two cells.
const CELL: f64 = 8.0;

/// Which vertices are one point.
pub(super) struct Welded {
    /// Per vertex of the source, or `NONE` where no face uses it.
    pub(super) points: Vec<u32>,
    /// Per point its first vertex in the source.
    pub(super) leaders: Vec<u32>,
}

/// Gives each used vertex a point: the first earlier one's within the tolerance that is itself the first of its point.
///
/// So points are more than the tolerance apart, and chains of close vertices do not run together.
pub(super) fn weld(positions: &[Vec3], faces: &Faces) -> Welded {
    let mut used = vec![false; positions.len()];
    faces.corners.iter().flatten().for_each(|&corner| used[corner as usize] = true);
    let (low, high) = bounds(positions.iter().zip(&used).filter(|(_, used)| **used).map(|(position, _)| *position));
    let tolerance = TOLERANCE * (high - low).length();
    let grid = Grid { low, inverse_cell: 1.0 / (CELL * tolerance), reach: 1.0 / CELL };

    let mut welded = Welded { points: vec![NONE; positions.len()], leaders: Vec::new() };
    // Equal positions first: cheaper, and nearly all there is to weld.
    let mut equal = Table::new(positions.len());
    let mut distinct: Vec<u32> = Vec::new();
    let mut cells = Table::new(positions.len());
    let mut cell_of_leader: Vec<[u32; 3]> = Vec::new();
    for vertex in (0..positions.len()).filter(|&vertex| used[vertex]) {
        // Adding zero turns -0.0 into 0.0, whose bits differ.
        let bits = (positions[vertex] + Vec3::ZERO).to_array().map(f32::to_bits);
        let same = |other: u32| positions[distinct[other as usize] as usize] == positions[vertex];
        let (item, new) = equal.find_or_insert(join(&bits), same);
        if !new {
            welded.points[vertex] = welded.points[distinct[item as usize] as usize];
            continue;
        }
        distinct.push(vertex as u32);
        let position = positions[vertex].as_dvec3();
        let near = |other: u32, cell: [u32; 3]| {
            let leader = welded.leaders[other as usize] as usize;
            cell_of_leader[other as usize] == cell
                && positions[leader].as_dvec3().distance_squared(position) <= tolerance * tolerance
        };
        let found = grid.around(position).filter_map(|cell| cells.find(join(&cell), |other| near(other, cell))).min();
        welded.points[vertex] = found.unwrap_or_else(|| {
            let cell = grid.cell(position);
            cell_of_leader.push(cell);
            welded.leaders.push(vertex as u32);
            cells.insert(join(&cell))
        });
    }
    welded
}

struct Grid {
    low: DVec3,
    inverse_cell: f64,
    /// The tolerance in cells.
    reach: f64,
}

impl Grid {
    fn cell(&self, position: DVec3) -> [u32; 3] {
        ((position - self.low) * self.inverse_cell).as_uvec3().to_array()
    }

    /// The cells within the tolerance of a position: one, or up to eight.
    fn around(&self, position: DVec3) -> impl Iterator<Item = [u32; 3]> {
        let place = (position - self.low) * self.inverse_cell;
        // Conversion cuts off the fraction, and takes what is below zero to it.
        let (from, to) = ((place - self.reach).as_uvec3(), (place + self.reach).as_uvec3());
        (from.z..=to.z).flat_map(move |z| (from.y..=to.y).flat_map(move |y| (from.x..=to.x).map(move |x| [x, y, z])))
    }
}

/// Least and greatest coordinates.
pub(super) fn bounds(positions: impl Iterator<Item = Vec3>) -> (DVec3, DVec3) {
    let (low, high) = positions
        .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), position| (low.min(position), high.max(position)));
    (low.as_dvec3(), high.as_dvec3())
}

/// The welded surface.
pub(super) struct Surface {
    /// Positions of the points, in the source's units, in the source's order.
    pub(super) points: Vec<Vec3>,
    /// Points of the faces' corners.
    pub(super) triangles: Vec<[u32; 3]>,
    /// Per vertex of the source its point, or `NONE` where no face uses it.
    pub(super) point_of: Vec<u32>,
}

impl Surface {
    /// Numbers the points that are still used; reports what was welded and what fell out of use.
    pub(super) fn new(raw: &RawMesh, welded: &Welded, faces: &mut Faces, report: &mut MeshReport) -> Self {
        let mut used = vec![false; raw.positions.len()];
        faces.corners.iter().flatten().for_each(|&corner| used[corner as usize] = true);
        let mut number = vec![NONE; welded.leaders.len()];
        for vertex in (0..used.len()).filter(|&vertex| used[vertex]) {
            number[welded.points[vertex] as usize] = 0;
        }
        let mut points = Vec::new();
        for (number, &leader) in number.iter_mut().zip(&welded.leaders).filter(|(number, _)| **number == 0) {
            *number = points.len() as u32;
            points.push(raw.positions[leader as usize]);
        }
        let point = |vertex: usize| if used[vertex] { number[welded.points[vertex] as usize] } else { NONE };
        let point_of: Vec<u32> = (0..used.len()).map(point).collect();
        let triangles = faces.corners.iter().map(|corners| corners.map(|corner| point_of[corner as usize]));
        let triangles = triangles.collect();

        let vertices = used.iter().filter(|used| **used).count();
        report.dropped_vertices = used.len() - vertices;
        report.welded = vertices - points.len();
        Self { points, triangles, point_of }
    }
}
