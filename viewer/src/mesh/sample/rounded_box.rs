//! Boards: boxes with rounded edges, then bent.

use std::f32::consts::FRAC_PI_4;

use glam::{Vec2, Vec3, vec2};

use super::super::RawMesh;
use super::sheet::{Sheet, Vertex, repeats, segments};

/// A box whose edges and corners are rounded, bent by a smooth map. u runs around the x axis in whole repeats, v along
/// it; the faces at the two ends of x have uv of their own.
pub(super) struct RoundedBox {
    pub(super) half: Vec3,
    pub(super) radius: f32,
    pub(super) bend: fn(Vec3) -> Vec3,
}

/// A box's side, cut: where on the outer box the cuts are, and how far along the rounded surface.
struct Cuts {
    places: Vec<f32>,
    lengths: Vec<f32>,
}

impl RoundedBox {
    fn inner(&self) -> Vec3 {
        self.half - self.radius
    }

    /// Segments of each half edge's round and of the flat between, per axis.
    fn counts(&self, density: f64) -> [(usize, usize); 3] {
        (self.inner() * 2.0)
            .to_array()
            .map(|flat| (segments(self.radius * FRAC_PI_4, density, 1), segments(flat, density, 1)))
    }

    pub(super) fn triangles(&self, density: f64) -> usize {
        let [x, y, z] = self.counts(density).map(|(round, flat)| 2 * round + flat);
        4 * (x * y + y * z + z * x)
    }

    fn cuts(&self, axis: usize, density: f64) -> Cuts {
        let (round, flat) = self.counts(density)[axis];
        let inner = self.inner()[axis];
        let arc = self.radius * FRAC_PI_4;
        let mut cuts = Cuts { places: Vec::new(), lengths: Vec::new() };
        for k in 0..=2 * round + flat {
            let (place, length) = if k < round {
                let left = (round - k) as f32 / round as f32;
                (-inner - self.radius * (left * FRAC_PI_4).tan(), arc * (1.0 - left))
            } else if k <= round + flat {
                let t = (k - round) as f32 / flat as f32;
                (inner * (2.0 * t - 1.0), arc + 2.0 * inner * t)
            } else {
                let done = (k - round - flat) as f32 / round as f32;
                (inner + self.radius * (done * FRAC_PI_4).tan(), arc * (1.0 + done) + 2.0 * inner)
            };
            // Both faces at an edge must see the box's very edge.
            let last = 2 * round + flat;
            let place = if k == 0 {
                -self.half[axis]
            } else if k == last {
                self.half[axis]
            } else {
                place
            };
            cuts.places.push(place);
            cuts.lengths.push(length);
        }
        cuts
    }

    pub(super) fn add_to(&self, mesh: &mut RawMesh, density: f64) {
        let cuts = [0, 1, 2].map(|axis| self.cuts(axis, density));
        let length = |axis: usize| cuts[axis].lengths[cuts[axis].lengths.len() - 1];
        let around = 2.0 * (length(1) + length(2));
        let repeats = repeats(around);
        let unit = around / repeats;
        // Front, bottom, back, top: u on around the x axis, v to +x, so that u across v points outwards.
        let walls = [(2, 1.0, 1, -1.0), (1, -1.0, 2, -1.0), (2, -1.0, 1, 1.0), (1, 1.0, 2, 1.0)];
        let mut start = 0.0;
        for (axis, side, u_axis, u_sign) in walls {
            let start_u = start;
            let columns = cuts[u_axis].places.len() - 1;
            Sheet::open(columns, cuts[0].places.len() - 1).add_to(mesh, |column, row| {
                let column = column as usize;
                let across = if u_sign > 0.0 { column } else { columns - column };
                let mut outer = Vec3::ZERO;
                outer[axis] = side * self.half[axis];
                outer[u_axis] = cuts[u_axis].places[across];
                outer[0] = cuts[0].places[row];
                let on_u = cuts[u_axis].lengths[column];
                self.vertex(outer, vec2((start_u + on_u) / unit, cuts[0].lengths[row] / unit))
            });
            start += length(u_axis);
        }
        for side in [1.0, -1.0] {
            let columns = cuts[2].places.len() - 1;
            Sheet::open(columns, cuts[1].places.len() - 1).add_to(mesh, |column, row| {
                let column = column as usize;
                let across = if side > 0.0 { columns - column } else { column };
                let outer = Vec3::new(side * self.half.x, cuts[1].places[row], cuts[2].places[across]);
                self.vertex(outer, vec2(cuts[2].lengths[column] / unit, cuts[1].lengths[row] / unit))
            });
        }
    }

    /// From a point of the outer box to the rounded, bent surface.
    fn vertex(&self, outer: Vec3, uv: Vec2) -> Vertex {
        let core = outer.clamp(-self.inner(), self.inner());
        let normal = (outer - core).normalize();
        let flat = core + normal * self.radius;
        // Normals go by the inverse transpose of the bend's derivative: two tangents, bent, span the new plane.
        let step = 1e-3;
        let (right, up) = normal.any_orthonormal_pair();
        let slope = |along: Vec3| (self.bend)(flat + along * step) - (self.bend)(flat - along * step);
        let bent = slope(right).cross(slope(up)).normalize();
        let upright = right.cross(up).dot(normal).signum();
        Vertex { position: (self.bend)(flat), normal: bent * upright, uv }
    }
}
