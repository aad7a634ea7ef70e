//! Width of the strokes on the screen, and whether it stays when the view comes nearer or turns away.

use std::f64::consts::FRAC_PI_2;
use std::fmt;

use glam::DVec2;
use rayon::prelude::*;

use super::aov::Aov;
use super::direction::{INKED, LEAST_FACING};
use super::fit::log_slope;
use super::plane::Plane;
use super::structure::structure;

/// Step along a chord.
const STEP_PX: f64 = 0.25;
/// Chords at most measured; more are thinned evenly.
const SAMPLES: usize = 8192;
/// Longest half of a chord.
const REACH_PX: f64 = 64.0;
/// A chord ends at ink below this: paper.
const PAPER: f64 = 0.02;
/// A chord ends in the valley before ink that rises by this again: the next stroke.
const RISE: f64 = 0.1;

/// Widths of the strokes of a picture, across them.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Width {
    /// Median over the inked pixels, in pixels; none where no stroke is.
    pub median_px: Option<f64>,
    /// d log width / d log (n·v): 0 where strokes are as wide on slanted surfaces, 1 where they are drawn on them. Means
    /// something where the tone is even, and n·v is not.
    pub slope_over_facing: Option<f64>,
    /// Chords measured.
    pub samples: usize,
}

/// The ink along the chord across the stroke (by the structure tensor of window `sigma_px`) through each inked pixel
/// where n·v ≥ 0.2. That is the width of a straight stroke wherever the pixel lies in it, as anti-aliasing keeps the ink;
/// strokes that touch count as one. Accuracy 0.15 px.
pub fn stroke_width(ink: &Plane, aov: &Aov, sigma_px: f64) -> Width {
    let drawn = structure(ink, aov, sigma_px);
    let counts = |i: &usize| {
        let facing = aov.pixels[*i].as_ref().map_or(0.0, |surface| surface.facing);
        drawn[*i].is_some() && ink.pixels[*i] >= INKED && facing >= LEAST_FACING
    };
    let inked: Vec<usize> = (0..aov.pixels.len()).filter(counts).collect();
    let thinned: Vec<usize> = inked.iter().copied().step_by(inked.len().div_ceil(SAMPLES).max(1)).collect();
    let measured = |i: &usize| {
        let across = DVec2::from_angle(drawn[*i]? + FRAC_PI_2);
        let width_px = half_chord(ink, aov, *i, across)? + half_chord(ink, aov, *i, -across)?;
        Some((aov.pixels[*i].as_ref()?.facing, width_px))
    };
    let chords: Vec<(f64, f64)> = thinned.par_iter().filter_map(measured).collect();
    let mut widths: Vec<f64> = chords.iter().map(|chord| chord.1).collect();
    widths.sort_by(f64::total_cmp);
    Width {
        median_px: widths.get(widths.len() / 2).copied(),
        slope_over_facing: log_slope(chords.iter().copied()),
        samples: chords.len(),
    }
}

/// Width constancy, d log width / d log zoom, from pairs of zoom (any unit) and median width: 0 is constant on the screen,
/// 1 fixed to the object. None with fewer than two zooms.
pub fn width_constancy(widths: &[(f64, f64)]) -> Option<f64> {
    log_slope(widths.iter().copied())
}

/// Ink from a pixel's middle to the end of the stroke, in pixels of full ink. None where the surface ends before.
fn half_chord(ink: &Plane, aov: &Aov, from: usize, direction: DVec2) -> Option<f64> {
    let width = aov.size[0] as usize;
    let start = DVec2::new((from % width) as f64, (from / width) as f64) + 0.5;
    let (mut at, mut before) = (from, ink.pixels[from]);
    let (mut sum, mut least, mut sum_at_least) = (0.0, before, 0.0);
    for step in 1..=(REACH_PX / STEP_PX) as u32 {
        let place = start + direction * (STEP_PX * f64::from(step));
        let next = aov.index(place)?;
        if next != at && !aov.joined(at, next) {
            return None;
        }
        let here = ink.at(place);
        sum += 0.5 * STEP_PX * (before + here);
        if here < PAPER {
            return Some(sum);
        }
        if here > least + RISE && least < INKED {
            return Some(sum_at_least);
        }
        if here < least {
            (least, sum_at_least) = (here, sum);
        }
        (at, before) = (next, here);
    }
    None
}

impl fmt::Display for Width {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.median_px, self.slope_over_facing) {
            (Some(width), Some(slope)) => write!(f, "strokes {width:.2} px wide, as (n·v)^{slope:.2}"),
            (Some(width), None) => write!(f, "strokes {width:.2} px wide"),
            _ => write!(f, "no strokes to measure the width of"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{Dashes, flat_aov};
    use super::*;

    fn width_of(width_px: f64, angle_rad: f64) -> f64 {
        let aov = flat_aov([160, 160], angle_rad, 0.3);
        let dashes = Dashes { angle_rad, length_px: 60.0, gap_px: 20.0, period_px: 12.0, width_px };
        stroke_width(&dashes.drawn(aov.size), &aov, 2.0).median_px.expect("strokes")
    }

    #[test]
    fn widths_are_met_at_any_angle() {
        for width_px in [1.5, 2.0, 3.0, 5.0] {
            for angle_rad in [0.0, 0.3, 0.8, 2.2] {
                let found = width_of(width_px, angle_rad);
                assert!((found - width_px).abs() < 0.15, "{width_px} px at {angle_rad}: {found}");
            }
        }
    }

    #[test]
    fn strokes_fixed_to_the_object_grow_with_the_zoom_and_constant_ones_do_not() {
        let zooms = [1.0, 1.5, 2.0];
        let fixed = width_constancy(&zooms.map(|zoom| (zoom, width_of(2.0 * zoom, 0.3))));
        assert!((fixed.expect("three zooms") - 1.0).abs() < 0.1, "{fixed:?}");
        let constant = width_constancy(&zooms.map(|zoom| (zoom, width_of(2.0, 0.3 + 0.1 * zoom))));
        assert!(constant.expect("three zooms").abs() < 0.1, "{constant:?}");
    }
}
