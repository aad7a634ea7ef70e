//! The room that a mesh needs when it is seen from all around.

use glam::DVec3;

/// Slices that the mesh is cut into from bottom to top.
const SLICES: usize = 256;

/// Corners of the ring around a slice.
const CORNERS: u32 = 48;

/// Corners of rings that hold `points` wherever they are turned to about the vertical axis through `centre`: a camera that
/// has all of them in its picture has the points in it at every phase of [`Path::Orbit`](super::Path::Orbit).
///
/// The rings are too wide by 0.3 % of their radius at most, and too high or low by 1/256 of the whole height.
pub fn swept(points: impl Iterator<Item = DVec3> + Clone, centre: DVec3) -> Vec<DVec3> {
    let heights = points.clone().map(|point| point.y);
    let (low, high) = heights.fold((f64::MAX, f64::MIN), |(low, high), y| (low.min(y), high.max(y)));
    let height = ((high - low) / SLICES as f64).max(f64::MIN_POSITIVE);
    let mut radii = vec![None; SLICES];
    for point in points {
        // The topmost point lies on the end of the last slice.
        let slice = (((point.y - low) / height) as usize).min(SLICES - 1);
        let radius = (point.x - centre.x).hypot(point.z - centre.z);
        let widest: &mut Option<f64> = &mut radii[slice];
        *widest = Some(widest.map_or(radius, |widest| widest.max(radius)));
    }
    // The sides of a ring, not only its corners, are to lie outside of the circle.
    let outside = 1.0 / (std::f64::consts::PI / f64::from(CORNERS)).cos();
    let rings = radii.into_iter().enumerate().filter_map(|(slice, radius)| Some((slice, radius?)));
    rings
        .flat_map(|(slice, radius)| [slice, slice + 1].map(|end| (low + height * end as f64, radius * outside)))
        .flat_map(|(y, radius)| {
            (0..CORNERS).map(move |corner| {
                let (sin, cos) = (std::f64::consts::TAU * f64::from(corner) / f64::from(CORNERS)).sin_cos();
                DVec3::new(centre.x + radius * sin, y, centre.z + radius * cos)
            })
        })
        .collect()
}
