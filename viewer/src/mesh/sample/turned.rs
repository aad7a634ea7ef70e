//! Surfaces of revolution about y: sphere, cylinder, and turned wood.

use std::f32::consts::{PI, TAU};

use glam::{Affine3A, Vec2, Vec3, vec2, vec3};

use super::super::RawMesh;
use super::sheet::{Sheet, UV_UNIT, Vertex, density_for, repeats, segments};

/// The direction at a fraction of a turn to the east, from +z. The last of `columns` falls on the first to the bit.
fn east(column: f32, columns: usize) -> Vec3 {
    let angle = TAU * (column % columns as f32) / columns as f32;
    vec3(angle.sin(), 0.0, angle.cos())
}

/// The unit sphere in meridians and parallels. u runs east in 12 repeats, v north in 6: a unit is 0.52 long in both
/// directions at the equator, and shorter eastwards by the cosine of the latitude. Seam at +z, from pole to pole. At
/// least 12 triangles.
pub(super) fn sphere(triangles: usize) -> RawMesh {
    let sheet = |density| Sheet::between_poles(segments(TAU, density, 4), segments(PI, density, 2));
    let sheet = sheet(density_for(triangles, |density| sheet(density).triangles()));
    let mut mesh = RawMesh::default();
    sheet.add_to(&mut mesh, |column, row| {
        let latitude = PI * (row as f32 / sheet.rows as f32 - 0.5);
        let normal = if row == 0 {
            Vec3::NEG_Y
        } else if row == sheet.rows {
            Vec3::Y
        } else {
            east(column, sheet.columns) * latitude.cos() + Vec3::Y * latitude.sin()
        };
        let uv = vec2(12.0 * column / sheet.columns as f32, 6.0 * row as f32 / sheet.rows as f32);
        Vertex { position: normal, normal, uv }
    });
    mesh
}

/// A closed cylinder of height 2 and radius 0.6 with hard rims. u runs around in 8 repeats of 0.47, v upwards; the caps
/// have planar uv of the same unit. At least 32 triangles.
pub(super) fn cylinder(triangles: usize) -> RawMesh {
    const RADIUS: f32 = 0.6;
    let unit = TAU * RADIUS / repeats(TAU * RADIUS);
    // The caps are grids of quarter by quarter turn.
    let quarter = |density| segments(TAU * RADIUS / 4.0, density, 1);
    let side = |density| Sheet::open(4 * quarter(density), segments(2.0, density, 1));
    let density = density_for(triangles, |density| side(density).triangles() + 4 * quarter(density).pow(2));
    let (quarter, side) = (quarter(density), side(density));
    let mut mesh = RawMesh::default();
    side.add_to(&mut mesh, |column, row| {
        let normal = east(column, side.columns);
        let height = 2.0 * row as f32 / side.rows as f32 - 1.0;
        let uv = vec2(repeats(TAU * RADIUS) * column / side.columns as f32, (height + 1.0) / unit);
        Vertex { position: normal * RADIUS + Vec3::Y * height, normal, uv }
    });
    for up in [1.0, -1.0] {
        Sheet::open(quarter, quarter).add_to(&mut mesh, |column, row| {
            let (ring, along) = square_ring(column as i64, row as i64, quarter as i64);
            // Seen from above the grid is turned over.
            let along = if up > 0.0 { (side.columns as f32 - along) % side.columns as f32 } else { along };
            let position = east(along, side.columns) * RADIUS * ring + Vec3::Y * up;
            Vertex { position, normal: Vec3::Y * up, uv: vec2(-up * position.x, position.z) / unit }
        });
    }
    mesh
}

/// A point of a grid of `count` by `count` on a disc: concentric squares become concentric circles, evenly divided.
/// Its radius, and its place around, 0..4·`count`; whole on the rim.
///
/// Source: P. Shirley and K. Chiu, "A low distortion map between disk and square", JGT 2(3), 1997.
fn square_ring(column: i64, row: i64, count: i64) -> (f32, f32) {
    // Twice the distance from the centre, so that odd counts are whole.
    let (x, y) = (2 * column - count, 2 * row - count);
    let ring = x.abs().max(y.abs());
    if ring == 0 {
        return (0.0, 0.0);
    }
    let eighths = if y == ring && y != -x {
        x
    } else if x == ring {
        2 * ring - y
    } else if y == -ring {
        4 * ring - x
    } else {
        6 * ring + y
    };
    // Counted from a corner, every place on the rim is whole.
    let around = ((eighths + ring).rem_euclid(8 * ring) * count) as f64 / (2 * ring) as f64;
    (ring as f32 / count as f32, around as f32)
}

/// A profile turned about y, closed at both ends.
pub(super) struct Turned {
    /// Radius and height, sampled finely from the lower end on the axis to the upper end on the axis.
    line: Vec<Vec2>,
    /// Length of the line up to each point.
    lengths: Vec<f32>,
    repeats: f32,
    unit: f32,
}

impl Turned {
    /// The Catmull-Rom curve through (radius, height) `points`; the first and the last are on the axis.
    pub(super) fn new(points: &[Vec2]) -> Self {
        const STEPS: usize = 24;
        let mut line = Vec::with_capacity((points.len() - 1) * STEPS + 1);
        let at = |i: isize| points[i.clamp(0, points.len() as isize - 1) as usize];
        for i in 0..points.len() as isize - 1 {
            let [a, b, c, d] = [at(i - 1), at(i), at(i + 1), at(i + 2)];
            for step in 0..STEPS {
                let t = step as f32 / STEPS as f32;
                let p = b * 2.0
                    + (c - a) * t
                    + (a * 2.0 - b * 5.0 + c * 4.0 - d) * (t * t)
                    + (b * 3.0 - a - c * 3.0 + d) * (t * t * t);
                line.push(vec2((p.x * 0.5).max(0.0), p.y * 0.5));
            }
        }
        line.push(at(points.len() as isize - 1));
        let mut lengths = vec![0.0];
        let mut moment = 0.0;
        for pair in line.windows(2) {
            let length = pair[0].distance(pair[1]);
            moment += (pair[0].x + pair[1].x) * 0.5 * length;
            lengths.push(lengths[lengths.len() - 1] + length);
        }
        let circumference = TAU * moment / lengths[lengths.len() - 1];
        let repeats = repeats(circumference);
        // Thin rods have one repeat around, which is shorter than the unit; v then keeps to a length in between.
        Self { line, lengths, repeats, unit: (circumference / repeats).max(0.5 * UV_UNIT) }
    }

    pub(super) fn sheet(&self, density: f64) -> Sheet {
        let length = self.lengths[self.lengths.len() - 1];
        Sheet::between_poles(segments(self.unit * self.repeats, density, 5), segments(length, density, 4))
    }

    /// Adds the surface, moved by `place`, a rotation and a translation.
    pub(super) fn add_to(&self, mesh: &mut RawMesh, density: f64, place: Affine3A) {
        let sheet = self.sheet(density);
        sheet.add_to(mesh, |column, row| {
            let length = self.lengths[self.lengths.len() - 1] * row as f32 / sheet.rows as f32;
            let (at, slope) = self.at(length);
            let around = east(column, sheet.columns);
            let pole = row == 0 || row == sheet.rows;
            let position = if pole { Vec3::Y * at.y } else { around * at.x + Vec3::Y * at.y };
            let normal = if pole {
                Vec3::Y * if row == 0 { -1.0 } else { 1.0 }
            } else {
                (around * slope.y - Vec3::Y * slope.x).normalize()
            };
            Vertex {
                position: place.transform_point3(position),
                normal: place.transform_vector3(normal),
                uv: vec2(self.repeats * column / sheet.columns as f32, length / self.unit),
            }
        });
    }

    /// The profile's point and direction after `length`.
    fn at(&self, length: f32) -> (Vec2, Vec2) {
        let next = self.lengths.partition_point(|&l| l <= length).clamp(1, self.line.len() - 1);
        let (a, b) = (self.line[next - 1], self.line[next]);
        let t = (length - self.lengths[next - 1]) / (self.lengths[next] - self.lengths[next - 1]);
        // The direction turns evenly from the middle of one step to that of the next.
        let before = b - self.line[next.max(2) - 2];
        let after = self.line[(next + 1).min(self.line.len() - 1)] - a;
        (a.lerp(b, t), before.normalize_or_zero().lerp(after.normalize_or_zero(), t))
    }
}
