//! The Utah teapot: its 32 bicubic Bézier patches, evaluated at any fineness.
//!
//! Source: M. Newell, 1975, with the bottom that F. Crow added; control points as published in F. Crow, "The origins
//! of the teapot", IEEE CG&A 7(1), 1987. Height is not squashed. The patches repeat by symmetry: 20 of 24 control rings
//! of body and lid are circles' approximations, so rings are stored here by radius.

use glam::{Vec2, Vec3, vec2};

use super::super::RawMesh;
use super::place_in_box;
use super::sheet::{Sheet, UV_UNIT, Vertex, add_part, density_for, segments};

/// Teapot units per uv unit before rounding: the teapot is 6.5 units long, its mesh 2.
const UNIT: f32 = UV_UNIT * 6.4 / 2.0;

/// A control ring of body or lid: radius, reach of the inner control points of each quarter, height.
type Ring = (f32, f32, f32);

/// From the middle of the bottom to the inner edge of the rim.
const BODY: [Ring; 13] = [
    (0.0, 0.0, 0.0),
    (1.425, 0.798, 0.0),
    (1.5, 0.84, 0.075),
    (1.5, 0.84, 0.15),
    (1.5, 0.84, 0.225),
    (2.0, 1.12, 0.45),
    (2.0, 1.12, 0.9),
    (2.0, 1.12, 1.35),
    (1.75, 0.98, 1.875),
    (1.5, 0.84, 2.4),
    (1.4375, 0.805, 2.53125),
    (1.3375, 0.749, 2.53125),
    (1.4, 0.784, 2.4),
];

/// From the edge to the top of the knob.
const LID: [Ring; 7] = [
    (1.3, 0.728, 2.4),
    (1.3, 0.728, 2.55),
    (0.4, 0.224, 2.55),
    (0.2, 0.112, 2.7),
    (0.0, 0.0, 2.85),
    (0.8, 0.45, 3.15),
    (0.0, 0.0, 3.15),
];

/// A control ring of handle or spout: two points in the middle plane, (along, height), and half the breadth.
type Loop = (Vec2, Vec2, f32);

/// From the upper end to the lower.
const HANDLE: [Loop; 7] = [
    (vec2(-1.6, 2.025), vec2(-1.5, 2.25), 0.3),
    (vec2(-2.3, 2.025), vec2(-2.5, 2.25), 0.3),
    (vec2(-2.7, 2.025), vec2(-3.0, 2.25), 0.3),
    (vec2(-2.7, 1.8), vec2(-3.0, 1.8), 0.3),
    (vec2(-2.7, 1.575), vec2(-3.0, 1.35), 0.3),
    (vec2(-2.5, 1.125), vec2(-2.65, 0.9375), 0.3),
    (vec2(-2.0, 0.9), vec2(-1.9, 0.6), 0.3),
];

/// From the body to the mouth.
const SPOUT: [Loop; 7] = [
    (vec2(1.7, 1.425), vec2(1.7, 0.6), 0.66),
    (vec2(2.6, 1.425), vec2(3.1, 0.825), 0.66),
    (vec2(2.3, 2.1), vec2(2.4, 2.025), 0.25),
    (vec2(2.7, 2.4), vec2(3.3, 2.4), 0.25),
    (vec2(2.8, 2.475), vec2(3.525, 2.49375), 0.25),
    (vec2(2.9, 2.475), vec2(3.45, 2.5125), 0.15),
    (vec2(2.8, 2.4), vec2(3.2, 2.4), 0.15),
];

/// The teapot, its spout to +x. Parts body, lid, handle and spout; as in the original the handle's ends and the spout's
/// root are open inside the body, and so are rim, lid and mouth. u runs around each part in whole repeats, v along it.
/// At least 250 triangles.
pub(super) fn teapot(triangles: usize) -> RawMesh {
    let parts = [
        ("body", Loft::turned(&BODY)),
        ("lid", Loft::turned(&LID)),
        ("handle", Loft::bent(&HANDLE)),
        ("spout", Loft::bent(&SPOUT)),
    ];
    let density = density_for(triangles, |density| parts.iter().map(|(_, loft)| loft.sheet(density).triangles()).sum());
    let mut mesh = RawMesh::default();
    for (name, loft) in &parts {
        add_part(&mut mesh, name, None, |mesh| loft.add_to(mesh, density));
    }
    place_in_box(&mut mesh);
    mesh
}

/// Bicubic patches around and along a tube: closed control rings of three points per arc, three per patch and one.
struct Loft {
    rings: Vec<Vec<Vec3>>,
    arcs: usize,
    /// Length of each patch along its first line.
    patch_lengths: Vec<f32>,
    /// Mean length around.
    girth: f32,
    repeats: f32,
}

impl Loft {
    fn turned(rings: &[Ring]) -> Self {
        let directions = [Vec3::Z, Vec3::X, Vec3::NEG_Z, Vec3::NEG_X];
        let ring = |&(radius, reach, height): &Ring| {
            (0..4)
                .flat_map(|k| {
                    let (from, to) = (directions[k], directions[(k + 1) % 4]);
                    [from * radius, from * radius + to * reach, to * radius + from * reach]
                })
                .map(|p| p + Vec3::Y * height)
                .collect()
        };
        Self::new(rings.iter().map(ring).collect(), 4)
    }

    fn bent(loops: &[Loop]) -> Self {
        let ring = |&(near, far, half): &Loop| {
            let (near, far) = (near.extend(0.0), far.extend(0.0));
            vec![near, near + Vec3::Z * half, far + Vec3::Z * half, far, far - Vec3::Z * half, near - Vec3::Z * half]
        };
        Self::new(loops.iter().map(ring).collect(), 2)
    }

    fn new(rings: Vec<Vec<Vec3>>, arcs: usize) -> Self {
        const STEPS: usize = 32;
        let mut loft = Self { rings, arcs, patch_lengths: Vec::new(), girth: 0.0, repeats: 0.0 };
        let along = |patch: usize, step: usize| loft.at(0, 0.0, patch, step as f32 / STEPS as f32).0;
        loft.patch_lengths = (0..loft.patches())
            .map(|patch| (0..STEPS).map(|k| along(patch, k).distance(along(patch, k + 1))).sum())
            .collect();
        let girth = |patch: usize, step: usize| {
            let point = |k: usize| loft.at(k / STEPS, (k % STEPS) as f32 / STEPS as f32, patch, step as f32 / 8.0).0;
            (0..arcs * STEPS).map(|k| point(k).distance(point((k + 1) % (arcs * STEPS)))).sum::<f32>()
        };
        let weighted: f32 =
            (0..loft.patches()).map(|p| loft.patch_lengths[p] * (0..8).map(|s| girth(p, s)).sum::<f32>() / 8.0).sum();
        loft.girth = weighted / loft.patch_lengths.iter().sum::<f32>();
        loft.repeats = (loft.girth / UNIT).round().max(1.0);
        loft
    }

    fn patches(&self) -> usize {
        self.rings.len() / 3
    }

    fn rows_of(&self, patch: usize, density: f64) -> usize {
        segments(self.patch_lengths[patch], density, 1)
    }

    fn sheet(&self, density: f64) -> Sheet {
        let is_point = |ring: &Vec<Vec3>| ring.iter().all(|&p| p == ring[0]);
        Sheet {
            columns: self.arcs * segments(self.girth / self.arcs as f32, density, 2),
            rows: (0..self.patches()).map(|patch| self.rows_of(patch, density)).sum(),
            first_row_is_pole: is_point(&self.rings[0]),
            last_row_is_pole: is_point(&self.rings[self.rings.len() - 1]),
        }
    }

    fn add_to(&self, mesh: &mut RawMesh, density: f64) {
        let sheet = self.sheet(density);
        let per_arc = sheet.columns / self.arcs;
        // Per row: patch, parameter in it, length so far.
        let mut rows = vec![(0, 0.0, 0.0)];
        let mut length = 0.0;
        for patch in 0..self.patches() {
            let count = self.rows_of(patch, density);
            for row in 1..=count {
                let t = row as f32 / count as f32;
                rows.push((patch, t, length + self.patch_lengths[patch] * t));
            }
            length += self.patch_lengths[patch];
        }
        let unit = self.girth / self.repeats;
        sheet.add_to(mesh, |column, row| {
            let around = column % sheet.columns as f32;
            let arc = around as usize / per_arc;
            let (patch, v, length) = rows[row];
            let (position, across, along) = self.at(arc, around / per_arc as f32 - arc as f32, patch, v);
            let pole = row == 0 && sheet.first_row_is_pole || row == sheet.rows && sheet.last_row_is_pole;
            let (position, normal) = match row {
                // Rounding would scatter the one point of a pole.
                0 if pole => (self.rings[0][0], Vec3::NEG_Y),
                _ if pole => (self.rings[self.rings.len() - 1][0], Vec3::Y),
                _ => (position, across.cross(along)),
            };
            let uv = vec2(self.repeats * column / sheet.columns as f32, length / unit);
            Vertex { position, normal: normal.normalize(), uv }
        });
    }

    /// The point at `u` of an arc and `v` of a patch, and its derivatives.
    fn at(&self, arc: usize, u: f32, patch: usize, v: f32) -> (Vec3, Vec3, Vec3) {
        let (along, along_slope) = (bernstein(v), bernstein_slope(v));
        let (around, around_slope) = (bernstein(u), bernstein_slope(u));
        let mut sums = [Vec3::ZERO; 3];
        for j in 0..4 {
            let ring = &self.rings[3 * patch + j];
            for i in 0..4 {
                let point = ring[(3 * arc + i) % ring.len()];
                sums[0] += point * (around[i] * along[j]);
                sums[1] += point * (around_slope[i] * along[j]);
                sums[2] += point * (around[i] * along_slope[j]);
            }
        }
        (sums[0], sums[1], sums[2])
    }
}

fn bernstein(t: f32) -> [f32; 4] {
    let s = 1.0 - t;
    [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t]
}

fn bernstein_slope(t: f32) -> [f32; 4] {
    let s = 1.0 - t;
    [-3.0 * s * s, 3.0 * s * (s - 2.0 * t), 3.0 * t * (2.0 * s - t), 3.0 * t * t]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patches_are_the_published_thirty_two() {
        let patches = |loft: &Loft| loft.arcs * loft.patches();
        let lofts = [Loft::turned(&BODY), Loft::turned(&LID), Loft::bent(&HANDLE), Loft::bent(&SPOUT)];
        assert_eq!(lofts.iter().map(patches).sum::<usize>(), 32);
        // Where patches of body and lid join, the published surface is smooth: rings on either side are in line.
        for join in [3, 6, 9] {
            let [a, b, c] = [-1isize, 0, 1].map(|k| BODY[(join as isize + k) as usize]);
            let cross = vec2(b.0 - a.0, b.2 - a.2).perp_dot(vec2(c.0 - b.0, c.2 - b.2));
            assert!(cross.abs() < 1e-5, "{join}: {cross}");
        }
    }

    #[test]
    fn the_pot_is_as_large_as_published() {
        let mesh = teapot(20_000);
        let (low, high) = mesh.positions.iter().fold((Vec3::MAX, Vec3::MIN), |(l, h), &p| (l.min(p), h.max(p)));
        let size = high - low;
        // 3.15 high, 4 deep (the Bézier circle bulges by a hair), and about 6.43 long.
        assert!((size.z / size.y - 4.0 / 3.15).abs() < 0.01, "{size}");
        assert!((size.x / size.y - 6.43 / 3.15).abs() < 0.02, "{size}");
        assert_eq!(
            mesh.parts.iter().map(|part| part.name.as_str()).collect::<Vec<_>>(),
            ["body", "lid", "handle", "spout"]
        );
        assert_eq!(size.x, 2.0);
    }
}
