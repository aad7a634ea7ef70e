//! Direction error: whether strokes run the way they should.

use std::fmt;

use super::aov::{Aov, line_distance};
use super::plane::Plane;
use super::structure::{MARGIN_PX, structure};

/// Ink from which on a pixel is inked.
pub(super) const INKED: f64 = 0.5;

/// Surfaces seen at a smaller n·v are left out: strokes are drawn together there until they have no direction.
pub(super) const LEAST_FACING: f64 = 0.2;

/// Angles between the drawn strokes and the wanted ones.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Direction {
    /// Mean angle over the counted pixels in degrees, 0 ..= 90; strokes of any direction have 45. None where no pixel
    /// counts.
    pub mean_deg: Option<f64>,
    /// Median of the same.
    pub median_deg: Option<f64>,
    /// Counted pixels: inked, with a wanted and a drawn direction.
    pub pixels: usize,
    /// Share of the inked pixels with a wanted direction, 0 ..= 1, whose drawn one is not clear: solid ink, crossings,
    /// dots, and tone without strokes.
    pub unclear_share: f64,
}

/// Compares the direction of the ink, by its structure tensor (see [`structure`]), with the wanted one of the view.
///
/// Inked pixels only (≥ 0.5), where n·v ≥ 0.2 and no contour or hard edge is nearer than 4 px. `sigma_px`: window of the
/// tensor, about a stroke's width; 2 px serve strokes of 1 to 4 px. For maps of one family of strokes: crossing ones are
/// either unclear or wrong. Bias on straight strokes below 0.25°.
pub fn direction(ink: &Plane, aov: &Aov, sigma_px: f64) -> Direction {
    let drawn = structure(ink, aov, sigma_px);
    let inside = aov.interior(MARGIN_PX);
    let (mut errors, mut unclear) = (Vec::new(), 0_usize);
    for (i, surface) in aov.pixels.iter().enumerate() {
        let Some(surface) = surface else { continue };
        let Some(wanted) = surface.stroke_rad else { continue };
        if !inside[i] || ink.pixels[i] < INKED || surface.facing < LEAST_FACING {
            continue;
        }
        match drawn[i] {
            Some(drawn) => errors.push(line_distance(drawn, wanted).to_degrees()),
            None => unclear += 1,
        }
    }
    let pixels = errors.len();
    let mean_deg = (pixels > 0).then(|| errors.iter().sum::<f64>() / pixels as f64);
    errors.sort_by(f64::total_cmp);
    let median_deg = errors.get(pixels / 2).copied();
    Direction { mean_deg, median_deg, pixels, unclear_share: unclear as f64 / (pixels + unclear).max(1) as f64 }
}

impl fmt::Display for Direction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let unclear = 100.0 * self.unclear_share;
        match (self.mean_deg, self.median_deg) {
            (Some(mean), Some(median)) => {
                write!(
                    f,
                    "direction off by {mean:.1}° (median {median:.1}°) over {} px, {unclear:.0} % unclear",
                    self.pixels
                )
            }
            _ => write!(f, "no direction, {unclear:.0} % unclear"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{Dashes, Grating, flat_aov, noise};
    use super::*;

    #[test]
    fn the_angle_between_drawn_and_wanted_is_found() {
        for turned_deg in [0.0_f64, 1.0, 12.0, 90.0] {
            let aov = flat_aov([120, 120], 1.1, 0.4);
            let angle_rad = 1.1 - turned_deg.to_radians();
            let ink = Grating { angle_rad, period_px: 5.0, ..Grating::default() }.drawn_on(&aov);
            let found = direction(&ink, &aov, 2.0);
            let mean = found.mean_deg.expect("strokes are seen");
            assert!((mean - turned_deg).abs() < 0.3 && found.unclear_share < 0.01, "{turned_deg}: {found}");
        }
    }

    #[test]
    fn ends_of_strokes_disturb_little() {
        let aov = flat_aov([240, 240], 0.5, 0.3);
        let ink =
            Dashes { angle_rad: 0.5, length_px: 30.0, gap_px: 10.0, period_px: 7.0, width_px: 2.0 }.drawn(aov.size);
        let found = direction(&ink, &aov, 2.0);
        assert!(found.mean_deg.expect("strokes are seen") < 1.0 && found.unclear_share < 0.1, "{found}");
    }

    #[test]
    fn noise_has_any_direction_and_grey_none() {
        let aov = flat_aov([240, 240], 0.5, 0.3);
        let found = direction(&noise(aov.size, 2.0), &aov, 2.0);
        let mean = found.mean_deg.expect("something is clear");
        assert!((mean - 45.0).abs() < 3.0, "{found}");
        let grey = Plane::from_fn(aov.size, |x, y| 0.55 + 0.3 * f64::from(x + y) / 480.0);
        let found = direction(&grey, &aov, 2.0);
        assert!(found.mean_deg.is_none() && found.unclear_share == 1.0, "{found}");
    }

    #[test]
    fn surfaces_that_turn_away_are_left_out() {
        let mut aov = flat_aov([60, 60], 0.0, 0.4);
        aov.pixels.iter_mut().flatten().for_each(|surface| surface.facing = 0.19);
        let ink = Grating { angle_rad: 0.0, period_px: 5.0, ..Grating::default() }.drawn_on(&aov);
        assert_eq!(direction(&ink, &aov, 2.0).pixels, 0);
    }
}
