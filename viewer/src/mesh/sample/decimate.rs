//! Fewer triangles on the same surface: edges contracted in order of the error that it makes.
//!
//! Source: M. Garland and P. Heckbert, "Surface simplification using quadric error metrics", SIGGRAPH 1997; the link
//! condition after T. Dey et al., "Topology preserving edge contraction", 1999.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::ops::{Add, AddAssign};

use glam::{DMat3, DVec3, Vec3};

use super::solid::shape;

/// Weight of a vertex's own place against the planes around it: evens out triangles where the surface is flat.
const EVENNESS: f64 = 5e-4;
/// Triangles made must have at least this [`shape`]; 0.29 is the best.
const WORST_SHAPE: f32 = 0.08;
/// Cosine between a triangle's normals before and after.
const LARGEST_TURN: f32 = 0.3;

/// Sum of squared distances to planes and points: pᵀ A p - 2 bᵀ p + c.
#[derive(Clone, Copy)]
struct Quadric {
    a: DMat3,
    b: DVec3,
    c: f64,
}

impl Add for Quadric {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { a: self.a + other.a, b: self.b + other.b, c: self.c + other.c }
    }
}

impl AddAssign for Quadric {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Quadric {
    const ZERO: Self = Self { a: DMat3::ZERO, b: DVec3::ZERO, c: 0.0 };

    fn plane(normal: DVec3, through: DVec3, weight: f64) -> Self {
        let scaled = normal * weight;
        let offset = normal.dot(through);
        let a = DMat3::from_cols(scaled * normal.x, scaled * normal.y, scaled * normal.z);
        Self { a, b: scaled * offset, c: weight * offset * offset }
    }

    fn point(place: DVec3, weight: f64) -> Self {
        Self { a: DMat3::from_diagonal(DVec3::splat(weight)), b: place * weight, c: weight * place.length_squared() }
    }

    fn error(&self, p: DVec3) -> f64 {
        (p.dot(self.a * p) - 2.0 * self.b.dot(p) + self.c).max(0.0)
    }

    /// The place of least error; the points' share makes the matrix regular.
    fn best(&self) -> DVec3 {
        self.a.inverse() * self.b
    }
}

struct Decimation<'a> {
    positions: &'a mut [Vec3],
    faces: &'a mut [[u32; 3]],
    /// Faces around each vertex; empty once it is contracted.
    around: Vec<Vec<u32>>,
    quadrics: Vec<Quadric>,
    /// Counts changes, so that outdated candidates are seen.
    versions: Vec<u32>,
    candidates: BinaryHeap<Reverse<(u64, u32, u32, u32)>>,
}

/// Contracts edges of a closed manifold mesh until `wanted` triangles are left or none can go. Keeps the topology.
pub(super) fn decimate(positions: &mut Vec<Vec3>, faces: &mut Vec<[u32; 3]>, wanted: usize) {
    let mut decimation = Decimation::new(positions, faces);
    let mut count = decimation.faces.len();
    while count > wanted
        && let Some(Reverse((_, u, v, stamp))) = decimation.candidates.pop()
    {
        if decimation.stamp(u, v) == stamp && decimation.contract(u, v) {
            count -= 2;
        }
    }
    let Decimation { around, .. } = decimation;
    compact(positions, faces, &around);
}

impl<'a> Decimation<'a> {
    fn new(positions: &'a mut [Vec3], faces: &'a mut [[u32; 3]]) -> Self {
        let count = positions.len();
        let mut around = vec![Vec::new(); count];
        let mut quadrics = vec![Quadric::ZERO; count];
        for (index, face) in faces.iter().enumerate() {
            let [a, b, c] = face.map(|i| positions[i as usize].as_dvec3());
            let double_area = (b - a).cross(c - a);
            let area = double_area.length() / 2.0;
            let plane = Quadric::plane(double_area.normalize_or_zero(), a, area);
            for &corner in face {
                around[corner as usize].push(index as u32);
                quadrics[corner as usize] += plane;
                quadrics[corner as usize] += Quadric::point(positions[corner as usize].as_dvec3(), area * EVENNESS);
            }
        }
        let mut decimation =
            Self { positions, faces, around, quadrics, versions: vec![0; count], candidates: BinaryHeap::new() };
        for index in 0..decimation.faces.len() {
            let [a, b, c] = decimation.faces[index];
            for (u, v) in [(a, b), (b, c), (c, a)] {
                // Each edge comes twice, once from either side.
                if u < v {
                    decimation.push(u, v);
                }
            }
        }
        decimation
    }

    fn stamp(&self, u: u32, v: u32) -> u32 {
        self.versions[u as usize] + self.versions[v as usize]
    }

    fn push(&mut self, u: u32, v: u32) {
        let sum = self.quadrics[u as usize] + self.quadrics[v as usize];
        // Bits of floats that are not negative are in the order of the floats.
        let cost = sum.error(sum.best()).to_bits();
        self.candidates.push(Reverse((cost, u, v, self.stamp(u, v))));
    }

    fn neighbours(&self, v: u32) -> Vec<u32> {
        let mut all: Vec<u32> =
            self.around[v as usize].iter().flat_map(|&f| self.faces[f as usize]).filter(|&w| w != v).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// Moves `v` into `u` unless that folds or pinches the surface.
    fn contract(&mut self, u: u32, v: u32) -> bool {
        let (near_u, near_v) = (self.neighbours(u), self.neighbours(v));
        let common = near_v.iter().filter(|w| near_u.binary_search(w).is_ok()).count();
        if common != 2 || near_u.len() + near_v.len() < 8 || near_u.len() + near_v.len() > 15 {
            return false;
        }
        let sum = self.quadrics[u as usize] + self.quadrics[v as usize];
        let place = sum.best().as_vec3();
        if !place.is_finite() || !self.stays_well_shaped(u, v, place) || !self.stays_well_shaped(v, u, place) {
            return false;
        }
        self.positions[u as usize] = place;
        self.quadrics[u as usize] = sum;
        for face in std::mem::take(&mut self.around[v as usize]) {
            let corners = &mut self.faces[face as usize];
            if corners.contains(&u) {
                for &w in corners.iter().filter(|&&w| w != v) {
                    self.around[w as usize].retain(|&other| other != face);
                }
            } else {
                for corner in corners.iter_mut().filter(|corner| **corner == v) {
                    *corner = u;
                }
                self.around[u as usize].push(face);
            }
        }
        self.versions[u as usize] += 1;
        self.versions[v as usize] += 1;
        for w in self.neighbours(u) {
            self.push(u.min(w), u.max(w));
        }
        true
    }

    /// Whether the faces around `moving` that do not vanish with `other` keep their side and a fair shape.
    fn stays_well_shaped(&self, moving: u32, other: u32, place: Vec3) -> bool {
        self.around[moving as usize].iter().all(|&face| {
            let corners = self.faces[face as usize];
            if corners.contains(&other) {
                return true;
            }
            let before = corners.map(|i| self.positions[i as usize]);
            let after = corners.map(|i| if i == moving { place } else { self.positions[i as usize] });
            let normal = |[a, b, c]: [Vec3; 3]| (b - a).cross(c - a).normalize_or_zero();
            normal(before).dot(normal(after)) > LARGEST_TURN && shape(&after, [0, 1, 2]) > WORST_SHAPE
        })
    }
}

/// Drops vertices without faces, and faces that are no longer around their vertices.
fn compact(positions: &mut Vec<Vec3>, faces: &mut Vec<[u32; 3]>, around: &[Vec<u32>]) {
    let mut renumbered = vec![u32::MAX; positions.len()];
    let mut kept = 0u32;
    for (v, faces) in around.iter().enumerate() {
        if !faces.is_empty() {
            renumbered[v] = kept;
            positions[kept as usize] = positions[v];
            kept += 1;
        }
    }
    positions.truncate(kept as usize);
    let mut index = 0;
    faces.retain(|face| {
        index += 1;
        face.iter().all(|&corner| around[corner as usize].contains(&(index - 1)))
    });
    for face in faces {
        *face = face.map(|corner| renumbered[corner as usize]);
    }
}
