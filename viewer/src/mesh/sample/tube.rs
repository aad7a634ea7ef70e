//! Tubes around closed curves: torus and torus knot.

use std::f32::consts::TAU;

use glam::{Quat, Vec3, vec2, vec3};

use super::super::RawMesh;
use super::sheet::{Sheet, Vertex, density_for, repeats, segments};

/// Points in the table of a curve's length and frames.
const TABLE: usize = 4096;

/// A ring of radius 0.7 and thickness 0.3 that faces +z. u runs around the tube in 4 repeats of 0.47, v along the ring
/// in 9 of 0.49 (0.28 at the hole, 0.70 outside). At least 24 triangles.
pub(super) fn torus(triangles: usize) -> RawMesh {
    tube(|t| vec3(0.7 * (TAU * t).cos(), 0.7 * (TAU * t).sin(), 0.0), 0.3, 4, triangles)
}

/// The (2, 3) torus knot, facing +z, of thickness 0.17. u runs around the tube in 2 repeats of 0.53, v along the knot
/// in a whole number of about the same length. At least 144 triangles.
pub(super) fn torus_knot(triangles: usize) -> RawMesh {
    let curve = |t: f32| {
        let (around, swing) = (2.0 * TAU * t, 3.0 * TAU * t);
        let radius = 0.56 + 0.27 * swing.cos();
        vec3(radius * around.sin(), radius * around.cos(), 0.27 * swing.sin())
    };
    tube(curve, 0.17, 24, triangles)
}

/// The surface at distance `radius` around the closed `curve`, whose parameter runs from 0 to 1.
fn tube(curve: impl Fn(f32) -> Vec3 + Sync, radius: f32, least_rows: usize, triangles: usize) -> RawMesh {
    let path = Path::new(&curve);
    let (around, along) = (repeats(TAU * radius), (path.length() / (TAU * radius) * repeats(TAU * radius)).round());
    let sheet = |density| Sheet::open(segments(TAU * radius, density, 3), segments(path.length(), density, least_rows));
    let sheet = sheet(density_for(triangles, |density| sheet(density).triangles()));
    let mut mesh = RawMesh::default();
    sheet.add_to(&mut mesh, |column, row| {
        // The last column and row are the first to the bit.
        let angle = TAU * (column % sheet.columns as f32) / sheet.columns as f32;
        let (t, tangent, side) = path.at((row % sheet.rows) as f32 / sheet.rows as f32, &curve);
        let normal = side * angle.cos() + tangent.cross(side) * angle.sin();
        Vertex {
            position: curve(t) + normal * radius,
            normal,
            uv: vec2(around * column / sheet.columns as f32, along * row as f32 / sheet.rows as f32),
        }
    });
    mesh
}

/// A closed curve's length and a frame along it that turns as little as it can and closes.
struct Path {
    lengths: Vec<f32>,
    /// Unit vectors across the curve.
    sides: Vec<Vec3>,
}

impl Path {
    fn new(curve: &impl Fn(f32) -> Vec3) -> Self {
        let mut lengths = vec![0.0];
        let start = tangent(curve, 0.0);
        let mut sides = vec![start.any_orthonormal_vector()];
        for k in 1..=TABLE {
            let (before, now) = ((k - 1) as f32 / TABLE as f32, k as f32 / TABLE as f32);
            lengths.push(lengths[k - 1] + curve(before).distance(curve(now)));
            let turn = Quat::from_rotation_arc(tangent(curve, before), tangent(curve, now));
            sides.push(turn * sides[k - 1]);
        }
        // What is left of the turn when the curve closes is spread over its length.
        let twist = sides[TABLE].angle_between(sides[0]) * sides[TABLE].cross(sides[0]).dot(start).signum();
        let total = lengths[TABLE];
        for (k, side) in sides.iter_mut().enumerate() {
            let axis = tangent(curve, k as f32 / TABLE as f32);
            *side = Quat::from_axis_angle(axis, twist * lengths[k] / total) * *side;
        }
        Self { lengths, sides }
    }

    fn length(&self) -> f32 {
        self.lengths[TABLE]
    }

    /// Parameter, tangent and side at a fraction of the length.
    fn at(&self, fraction: f32, curve: &impl Fn(f32) -> Vec3) -> (f32, Vec3, Vec3) {
        let length = fraction * self.length();
        let next = self.lengths.partition_point(|&l| l <= length).clamp(1, TABLE);
        let part = (length - self.lengths[next - 1]) / (self.lengths[next] - self.lengths[next - 1]);
        let t = (next as f32 - 1.0 + part) / TABLE as f32;
        let tangent = tangent(curve, t);
        let side = self.sides[next - 1].lerp(self.sides[next], part);
        (t, tangent, side.reject_from_normalized(tangent).normalize())
    }
}

fn tangent(curve: &impl Fn(f32) -> Vec3, t: f32) -> Vec3 {
    const STEP: f32 = 1e-3;
    (curve(t + STEP) - curve(t - STEP)).normalize()
}
