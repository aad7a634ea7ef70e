//! Centring and scaling.

use glam::Vec3;

use crate::mesh::Placement;

use super::weld::bounds;

/// The placement that centres the points' bounding box and makes its longest side 2; and the points so placed.
pub(super) fn place(points: &[Vec3]) -> (Placement, Vec<Vec3>) {
    let (low, high) = bounds(points.iter().copied());
    // In f64: a small object far from the origin, or of an extreme size, loses nothing.
    let placement = Placement { centre: (low + high) / 2.0, scale: 2.0 / (high - low).max_element() };
    let placed = points.iter().map(|&point| placement.mesh_from_file(point)).collect();
    (placement, placed)
}
