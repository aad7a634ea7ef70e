//! A family's direction: from an angle to curves that are functions across(along).

use super::Draw;
use crate::preset::StrokeOptions;
use crate::stroke::{Axis, Stroke};

/// Makes a unit s-curve, `t (1 - t) (1 - 2 t)`, reach 1 at its extremes.
const S_CURVE_SCALE: f64 = 10.392_304_845_413_264;

/// The direction of a family, as a slope against the nearer axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Direction {
    pub(super) axis: Axis,
    /// Change across per change along, `-1 ..= 1`.
    slope: f64,
    /// Whether strokes run against their axis.
    pub(crate) reversed: bool,
}

impl Direction {
    /// The direction of an angle in degrees; 0 runs along rows, 90 down columns.
    pub(crate) fn new(angle_deg: f64) -> Self {
        // libm: the same last bit on every machine.
        let (sin, cos) = (libm::sin(angle_deg.to_radians()), libm::cos(angle_deg.to_radians()));
        if cos.abs() >= sin.abs() {
            Self { axis: Axis::X, slope: sin / cos, reversed: cos < 0.0 }
        } else {
            Self { axis: Axis::Y, slope: cos / sin, reversed: sin < 0.0 }
        }
    }

    /// A stroke of no length at the tile's corner.
    pub(super) fn blank(&self) -> Stroke {
        Stroke { family: 0, axis: self.axis, start_uv: 0.0, along_uv: 0.0, across_uv: [0.0; 4], width_px: 0.0 }
    }

    /// A stroke of this direction with the character the options ask for, its middle-to-middle offset across still 0.
    ///
    /// Takes four numbers: start, angle, bow, s-curve. `length` is in tiles along the stroke.
    pub(super) fn shape(&self, options: &StrokeOptions, length: f32, draw: &mut Draw) -> Stroke {
        let start_uv = draw.unit() as f32;
        // The tangent of a small spread is spread evenly enough; the sum of angles goes by tangents.
        let turn = draw.signed() * libm::tan(options.angle_jitter_deg.to_radians());
        let slope = match self.axis {
            Axis::X => (self.slope + turn) / (1.0 - self.slope * turn),
            Axis::Y => (self.slope - turn) / (1.0 + self.slope * turn),
        };
        let (bow, s_curve) = (draw.signed() * options.bow, draw.signed() * options.s_curve);

        let stretch = (1.0 + slope * slope).sqrt();
        let length = f64::from(length);
        let along = length / stretch;
        // Offsets are meant perpendicular to the chord; across the axis they are longer by the stretch.
        let bow = 4.0 * bow * length * stretch;
        let s = S_CURVE_SCALE * s_curve * length * stretch;
        let across = [0.0, slope * along + bow + s, -bow - 3.0 * s, 2.0 * s];
        Stroke { start_uv, along_uv: along as f32, across_uv: across.map(|c| c as f32), ..self.blank() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_angle_scans_along_the_nearer_axis_with_a_slope_up_to_one() {
        for degrees in -180..=180 {
            let direction = Direction::new(f64::from(degrees));
            assert!(direction.slope.abs() <= 1.0 + 1e-12, "{degrees}°");
            let turned = (degrees + 360) % 180;
            if turned != 45 && turned != 135 {
                assert_eq!(direction.axis == Axis::X, !(45..=135).contains(&turned), "{degrees}°");
            }
        }
    }

    #[test]
    fn strokes_have_the_length_asked_for_at_any_angle() {
        let mut draw = Draw::new(3, "h");
        for degrees in [0.0, 17.0, 45.0, 62.0, 90.0, -35.0] {
            let stroke = Direction::new(degrees).shape(&StrokeOptions::default(), 0.5, &mut draw);
            assert!((stroke.length_uv() - 0.5).abs() < 1e-3, "{degrees}°: {}", stroke.length_uv());
        }
    }
}
