//! What numbers may be, in one table for command line and sliders.

use std::fmt;

/// Numbers that make sense for an option, both ends included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Least.
    pub min: f64,
    /// Greatest.
    pub max: f64,
    /// What is counted; empty for plain numbers.
    pub unit: &'static str,
}

impl Range {
    const fn new(min: f64, max: f64, unit: &'static str) -> Self {
        Self { min, max, unit }
    }

    /// Whether a number is in the range; one that is none is not.
    pub fn contains(&self, number: f64) -> bool {
        (self.min..=self.max).contains(&number)
    }
}

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} to {}", self.min, self.max)?;
        if self.unit.is_empty() { Ok(()) } else { write!(f, " {}", self.unit) }
    }
}

/// Angles around.
pub const AZIMUTH_DEG: Range = Range::new(-36_000.0, 36_000.0, "degrees");
/// Angles above the horizon.
pub const ELEVATION_DEG: Range = Range::new(-90.0, 90.0, "degrees");
/// Distances of the camera as multiples of its own.
pub const FIT_DISTANCE: Range = Range::new(0.05, 100.0, "");
/// Turns of cameras and lights from where they are.
pub const FIT_TURN_DEG: Range = Range::new(-360.0, 360.0, "degrees");
/// Errors of tone, in linear ink.
pub const FIT_ERROR: Range = Range::new(1e-4, 0.9, "");
/// Distance of the camera from its target.
pub const DISTANCE: Range = Range::new(0.01, 1000.0, "units");
/// Coordinates.
pub const COORDINATE: Range = Range::new(-1000.0, 1000.0, "units");
/// Vertical opening of the camera.
pub const FIELD_OF_VIEW_DEG: Range = Range::new(1.0, 150.0, "degrees");
/// Luminance of a light.
pub const INTENSITY: Range = Range::new(0.0, 100.0, "");
/// Cut-off of a spot light.
pub const CUTOFF_DEG: Range = Range::new(0.0, 90.0, "degrees");
/// Exponent of a spot light.
pub const SPOT_EXPONENT: Range = Range::new(0.0, 1000.0, "");
/// Shares: ambient light, strength of a highlight.
pub const SHARE: Range = Range::new(0.0, 1.0, "");
/// Exponent of a highlight.
pub const SHININESS: Range = Range::new(1.0, 1000.0, "");
/// Repeats of the tile per world unit.
pub const TILES_PER_UNIT: Range = Range::new(0.01, 100.0, "tiles per unit");
/// Scale of strokes, and of the mesh along an axis.
pub const SCALE: Range = Range::new(0.01, 100.0, "");
/// Stripes per unit at their coarsest.
pub const LINES_PER_UNIT: Range = Range::new(0.25, 64.0, "lines per unit");
/// Triangles of a sample.
pub const SAMPLE_TRIANGLES: Range = Range::new(2.0, 20_000_000.0, "triangles");
/// How much the strokes of stripes differ.
pub const VARIETY: Range = Range::new(0.0, 1.0, "");
/// How far directions spread.
pub const SMOOTHING: Range = Range::new(0.1, 10.0, "");
/// Shift of the tile.
pub const SHIFT: Range = Range::new(-1000.0, 1000.0, "tiles");
/// Added to the level of detail.
pub const LEVEL_BIAS: Range = Range::new(-4.0, 4.0, "levels");
/// Slope of the literal threshold.
pub const SLOPE: Range = Range::new(1.01, 1000.0, "");
/// Least distance of halftone lines and stripes.
pub const LINE_PERIOD_PX: Range = Range::new(2.0, 256.0, "px");
/// Width of contours, borders and creases.
pub const LINE_WIDTH_PX: Range = Range::new(0.25, 64.0, "px");
/// Width of the wireframe's lines.
pub const WIREFRAME_PX: Range = Range::new(0.25, 16.0, "px");
/// Angle above which an edge is a crease.
pub const CREASE_DEG: Range = Range::new(0.0, 180.0, "degrees");
/// Time of an animation.
pub const TIME_S: Range = Range::new(-1e6, 1e6, "s");
/// Phase of a deformation.
pub const PHASE: Range = Range::new(-1e6, 1e6, "periods");

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_number_is_in_no_range() {
        assert!(LINE_WIDTH_PX.contains(0.25) && LINE_WIDTH_PX.contains(64.0));
        assert!(!LINE_WIDTH_PX.contains(64.1) && !LINE_WIDTH_PX.contains(f64::NAN));
        assert_eq!(LINE_WIDTH_PX.to_string(), "0.25 to 64 px");
    }
}
