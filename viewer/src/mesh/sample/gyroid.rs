//! A ball cut from the gyroid, a sheet that divides space in two labyrinths.

use std::f32::consts::TAU;

use glam::Vec3;

use super::super::RawMesh;
use super::nets::Solid;
use super::sdf::intersect;
use super::solid;

/// Periods of the gyroid per unit; the ball's radius is 1.
const PERIODS: f32 = 0.85;
const HALF_THICKNESS: f32 = 0.085;
const COARSEST_CELL: f32 = 0.035;

/// The thickened gyroid within the unit ball, its edges rounded.
///
/// Source: A. Schoen, "Infinite periodic minimal surfaces without self-intersections", NASA TN D-5541, 1970, by its
/// trigonometric approximation.
pub(super) fn gyroid(triangles: usize) -> RawMesh {
    solid::mesh(&Solid { distance: &distance, half_extent: Vec3::ONE }, COARSEST_CELL, triangles)
}

fn distance(p: Vec3) -> f32 {
    let scale = TAU * PERIODS;
    let q = p * scale;
    let (sin, cos) = (Vec3::new(q.x.sin(), q.y.sin(), q.z.sin()), Vec3::new(q.x.cos(), q.y.cos(), q.z.cos()));
    let level = sin.x * cos.y + sin.y * cos.z + sin.z * cos.x;
    // The level's gradient has a length of about 1.5 on the sheet.
    let sheet = level.abs() / (1.5 * scale) - HALF_THICKNESS;
    intersect(sheet, p.length() - 1.0, 0.14)
}
