//! Run length: how far a stroke goes on before the ink breaks.

use std::fmt;

use glam::DVec2;
use rayon::prelude::*;

use super::aov::{Aov, Surface};
use super::direction::{INKED, LEAST_FACING};
use super::plane::Plane;

/// Ink below which a run ends.
const PAPER: f64 = 0.3;
/// Step of the traces.
const STEP_PX: f64 = 0.5;
/// Runs at most traced; more are thinned evenly.
const SAMPLES: usize = 8192;
/// Wanted darkness beyond which strokes touch, so that their ends cannot be seen.
const DARKEST: f64 = 0.5;
/// Tangent of the angle by which a stroke may leave the wanted direction and still be followed: 15°.
const STEERING: f64 = 0.268;
/// How hard a trace is steered: slope for a difference of the ink at 1 px to either side.
const GAIN: f64 = 0.5;
/// Length at which a trace is given up, as a multiple of the picture's longer side: closed strokes have no end.
const LONGEST: f64 = 4.0;

/// Lengths of unbroken ink.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct RunLength {
    /// Mean length in pixels of the strokes through the inked pixels, followed along their own middle up to 15° from the
    /// wanted direction. None where nothing is inked.
    pub mean_px: Option<f64>,
    /// The same along the wanted direction itself, to where it leaves the ink: short for strokes that lie askew.
    pub strict_px: Option<f64>,
    /// As `mean_px`, but through dark places too, where strokes that touch count as one.
    pub merged_px: Option<f64>,
    /// Pixels that runs were traced from.
    pub samples: usize,
}

/// Traces from inked pixels (≥ 0.5) both ways along the wanted direction of the view, in steps of half a pixel, until
/// the ink falls below 0.3, the surface ends, or the wanted darkness passes 0.5, where strokes touch.
///
/// The mean is over inked pixels, each with the run through it, so that specks count little: strokes of lengths L have
/// E\[L²\] / E\[L\], 1.06 times their mean length where it is spread evenly over 0.25 ..= 0.6. A mean over runs would favour
/// specks. Traces are steered to the middle of the stroke, as maps slant their strokes by some degrees for the hand's
/// sake: along the wanted direction alone a stroke 2 px wide that lies 4° askew is left after 30 px.
///
/// Straight strokes alone are met within 1 px. On the same map lengths grow with the tone, as strokes come to touch, so
/// compare with the map on a flat quad at the same scale and tone.
pub fn run_length(ink: &Plane, aov: &Aov) -> RunLength {
    let starts = |darkest: f64| -> Vec<usize> {
        let inked = |i: &usize| {
            let shown = aov.pixels[*i].as_ref().is_some_and(|surface| surface.facing >= LEAST_FACING);
            shown && ink.pixels[*i] >= INKED && wanted(aov.pixels[*i].as_ref(), darkest).is_some()
        };
        let inked: Vec<usize> = (0..aov.pixels.len()).filter(inked).collect();
        inked.iter().copied().step_by(inked.len().div_ceil(SAMPLES).max(1)).collect()
    };
    let mean_px = |starts: &[usize], follow: Follow| {
        let run = |start: &usize| [1.0, -1.0].map(|way| trace(ink, aov, *start, way, follow)).iter().sum();
        let runs: Vec<f64> = starts.par_iter().map(run).collect();
        (!runs.is_empty()).then(|| runs.iter().sum::<f64>() / runs.len() as f64)
    };
    let light = starts(DARKEST);
    RunLength {
        mean_px: mean_px(&light, Follow { steering: STEERING, darkest: DARKEST }),
        strict_px: mean_px(&light, Follow { steering: 0.0, darkest: DARKEST }),
        merged_px: mean_px(&starts(1.0), Follow { steering: STEERING, darkest: 1.0 }),
        samples: light.len(),
    }
}

/// How strokes are followed.
#[derive(Clone, Copy)]
struct Follow {
    /// Tangent of the angle by which the trace may leave the wanted direction.
    steering: f64,
    /// Wanted darkness beyond which it ends.
    darkest: f64,
}

/// Direction in which a run goes on, where one does.
fn wanted(surface: Option<&Surface>, darkest: f64) -> Option<DVec2> {
    surface.filter(|surface| surface.darkness <= darkest).and_then(|surface| surface.stroke_rad).map(DVec2::from_angle)
}

/// Length of unbroken ink to one side of a pixel.
fn trace(ink: &Plane, aov: &Aov, start: usize, way: f64, Follow { steering, darkest }: Follow) -> f64 {
    let width = aov.size[0] as usize;
    let limit_px = LONGEST * f64::from(aov.size[0].max(aov.size[1]));
    let mut place = DVec2::new((start % width) as f64, (start / width) as f64) + 0.5;
    let (mut pixel, mut before) = (start, ink.pixels[start]);
    let Some(mut heading) = wanted(aov.pixels[start].as_ref(), darkest).map(|along| along * way) else { return 0.0 };
    let mut length_px = 0.0;
    while length_px < limit_px {
        let side = heading.perp();
        let off = ink.at(place + side) - ink.at(place - side);
        let next = place + (heading + side * (GAIN * off).clamp(-steering, steering)).normalize() * STEP_PX;
        let Some(entered) = aov.index(next) else { break };
        let Some(along) = wanted(aov.pixels[entered].as_ref(), darkest) else { break };
        if entered != pixel && !aov.joined(pixel, entered) {
            break;
        }
        let here = ink.at(next);
        if here < PAPER {
            return length_px + STEP_PX * (before - PAPER) / (before - here);
        }
        // Lines have no sense: go on, never back.
        heading = if along.dot(heading) < 0.0 { -along } else { along };
        (place, pixel, before) = (next, entered, here);
        length_px += STEP_PX;
    }
    length_px
}

impl fmt::Display for RunLength {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.mean_px, self.strict_px) {
            (Some(mean), Some(strict)) => write!(f, "strokes run {mean:.0} px ({strict:.0} px of the wanted way)"),
            _ => write!(f, "no strokes to follow"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{Dashes, flat_aov, noise};
    use super::*;

    const SIZE: [u32; 2] = [240, 240];

    fn dashes(angle_rad: f64, length_px: f64) -> Plane {
        Dashes { angle_rad, length_px, gap_px: 8.0, period_px: 8.0, width_px: 2.0 }.drawn(SIZE)
    }

    fn lengths(ink: &Plane, wanted_rad: f64) -> [f64; 2] {
        let found = run_length(ink, &flat_aov(SIZE, wanted_rad, 0.3));
        [found.mean_px, found.strict_px].map(|length| length.expect("strokes"))
    }

    #[test]
    fn lengths_of_dashes_are_met_at_any_angle() {
        for (angle_rad, length_px) in [(0.0, 20.0), (0.4, 50.0), (1.9, 12.0)] {
            // The edges of the picture cut about L / 240 of the strokes in two.
            let cut = 0.5 * length_px * length_px / 240.0;
            let [mean, strict] = lengths(&dashes(angle_rad, length_px), angle_rad);
            assert!((mean - length_px).abs() < 1.0 + cut, "{length_px} px at {angle_rad}: {mean}");
            assert!((strict - length_px).abs() < 1.0 + cut, "{length_px} px at {angle_rad}: {strict} strictly");
        }
    }

    #[test]
    fn strokes_a_little_askew_are_followed_and_strokes_far_askew_are_not() {
        let ink = dashes(0.9, 50.0);
        let [mean, strict] = lengths(&ink, 0.9 + 6.0_f64.to_radians());
        // 2 px over sin 6° is 19 px.
        assert!(mean > 45.0 && strict < 25.0, "{mean} {strict}");
        let [mean, strict] = lengths(&ink, 0.9 + 40.0_f64.to_radians());
        assert!(mean < 10.0 && strict < 6.0, "{mean} {strict}");
    }

    #[test]
    fn blots_are_short_and_their_mean_is_that_over_ink() {
        let [mean, strict] = lengths(&noise(SIZE, 1.5), 0.3);
        assert!(mean < 20.0 && strict < 12.0, "{mean} {strict}");
        // Strokes of 60 px above, specks of 4 px below.
        let (long, short) = (dashes(0.0, 60.0), dashes(0.0, 4.0));
        let half = Plane::from_fn(SIZE, |x, y| if y < 80 { &long } else { &short }.pixels[(y * 240 + x) as usize]);
        let inked = |rows: std::ops::Range<usize>| {
            rows.flat_map(|y| &half.pixels[y * 240..][..240]).filter(|ink| **ink >= INKED).count() as f64
        };
        let (of_long, of_short) = (inked(0..80), inked(80..240));
        let [mean, _] = lengths(&half, 0.0);
        let expected = (60.0 * of_long + 4.0 * of_short) / (of_long + of_short);
        assert!((mean - expected).abs() < 0.1 * expected, "{mean}, not {expected}");
    }

    #[test]
    fn dark_places_and_surfaces_without_directions_have_no_runs() {
        let ink = dashes(0.0, 20.0);
        let dark = run_length(&ink, &flat_aov(SIZE, 0.0, 0.7));
        assert_eq!(dark.mean_px, None);
        assert!((dark.merged_px.expect("ink") - 20.0).abs() < 2.0);
        let mut aov = flat_aov(SIZE, 0.0, 0.3);
        aov.pixels.iter_mut().flatten().for_each(|surface| surface.stroke_rad = None);
        assert_eq!(run_length(&ink, &aov).samples, 0);
    }
}
