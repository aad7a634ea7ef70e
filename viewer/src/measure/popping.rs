//! Popping and flicker: whether strokes come and go by degrees.

use std::fmt;

use super::blur::MaskedBlur;
use super::fit::log_slope;
use super::plane::Plane;
use super::track::Track;

/// Greatest change of the ink in a window, 0 ..= 1, on the surface: the maximum over the picture of G * |H - H'|, G a
/// Gaussian of `window_px` (a few stroke widths: a stroke fills it, a line of single pixels does not). What is not seen in
/// both frames counts as unchanged.
pub fn largest_change(before: &Plane, after: &Plane, track: &Track, window_px: f64) -> f64 {
    let brought = track.bring(after, before.size);
    let followed = track.mask();
    let change = |i: usize| if followed[i] { (before.pixels[i] - brought.pixels[i]).abs() } else { 0.0 };
    let changes: Vec<f64> = (0..followed.len()).map(change).collect();
    let everywhere = vec![true; changes.len()];
    MaskedBlur::new(before.size, &everywhere, window_px).apply(&changes).into_iter().fold(0.0, f64::max)
}

/// How changes shrink with the step.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Popping {
    /// d log change / d log step: 1 where all changes are continuous, 0 where some pop.
    pub slope: f64,
    /// The greatest change at the smallest step: the size of a pop, where the slope is small.
    pub remainder: f64,
}

/// The slope of the greatest change against the step, from pairs of them.
///
/// A pop happens at one moment, which a small step may miss: take the maximum of [`largest_change`] over all steps that
/// make up the same span of time, 4 of Δt, 8 of Δt / 2 and so on. Steps must be short enough to see a continuous change
/// as one: a stroke that fades in within one column of the map looks like a pop to steps longer than that. Nor may they
/// be too short: samplers weigh texels in steps of 1/256, so that a pattern that moves jumps by some thousandths however
/// short the step. Under a camera move the bilinear reading adds changes that shrink only once the surface moves by less
/// than a pixel a step. None with fewer than two steps, or without any change.
pub fn popping(steps: &[(f64, f64)]) -> Option<Popping> {
    let slope = log_slope(steps.iter().copied())?;
    let smallest = steps.iter().min_by(|a, b| a.0.total_cmp(&b.0))?;
    Some(Popping { slope, remainder: smallest.1 })
}

impl fmt::Display for Popping {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "changes shrink as the step to the power {:.2}, down to {:.3}", self.slope, self.remainder)
    }
}

/// Flicker: mean |H(t + 1) - 2 H(t) + H(t - 1)| in surface coordinates, 0 ..= 2, over the points of the middle frame seen
/// in all three; `back` and `forth` lead from the middle frame. 0 where none is. Strokes that grow steadily have none.
pub fn flicker(frames: [&Plane; 3], back: &Track, forth: &Track) -> f64 {
    let [before, now, after] = frames;
    let (before, after) = (back.bring(before, now.size), forth.bring(after, now.size));
    let followed: Vec<usize> =
        (0..now.pixels.len()).filter(|i| back.places_px[*i].is_some() && forth.places_px[*i].is_some()).collect();
    let second = |i: &usize| (after.pixels[*i] - 2.0 * now.pixels[*i] + before.pixels[*i]).abs();
    followed.iter().map(second).sum::<f64>() / followed.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::super::testing::{Grating, flat_aov};
    use super::*;

    const SIZE: [u32; 2] = [120, 80];

    fn lines(darkness: f64) -> Plane {
        Grating { angle_rad: 0.2, period_px: 8.0, shift: 0.0 }.drawn_on(&flat_aov(SIZE, 0.2, darkness))
    }

    /// Greatest change over a span of time in so many steps.
    fn change(steps: u32, frame: impl Fn(f64) -> Plane) -> (f64, f64) {
        let track = Track::still(&flat_aov(SIZE, 0.0, 0.5));
        let step = 1.0 / f64::from(steps);
        let change = |i: u32| {
            let (from, to) = (frame(f64::from(i) * step), frame(f64::from(i + 1) * step));
            largest_change(&from, &to, &track, 4.0)
        };
        (step, (0..steps).map(change).fold(0.0, f64::max))
    }

    #[test]
    fn lines_that_widen_are_continuous_and_lines_that_jump_pop() {
        let steps = [2, 4, 8, 16];
        let smooth = popping(&steps.map(|steps| change(steps, |t| lines(0.3 + 0.2 * t)))).expect("changes");
        assert!(smooth.slope > 0.85, "{smooth}");
        // The nearest of six columns instead of two that are mixed.
        let rounded = |t: f64| lines((6.0 * (0.3 + 0.2 * t)).round() / 6.0);
        let pops = popping(&steps.map(|steps| change(steps, rounded))).expect("changes");
        assert!(pops.slope.abs() < 0.1 && pops.remainder > 0.1, "{pops}");
        // One that pops among smooth ones.
        let mixed = |t: f64| {
            let (smooth, whole) = (lines(0.3 + 0.2 * t), lines(if t < 0.43 { 0.3 } else { 0.7 }));
            Plane::from_fn(SIZE, |x, y| if x < 90 { &smooth } else { &whole }.pixels[(y * SIZE[0] + x) as usize])
        };
        let mixed = popping(&steps.map(|steps| change(steps, mixed))).expect("changes");
        assert!(mixed.slope < 0.2, "{mixed}");
    }

    #[test]
    fn steady_growth_does_not_flicker_and_blinking_does() {
        let track = Track::still(&flat_aov(SIZE, 0.0, 0.5));
        let grey = |ink: f64| Plane::from_fn(SIZE, |_, _| ink);
        let steady = flicker([&grey(0.2), &grey(0.3), &grey(0.4)], &track, &track);
        assert!(steady < 1e-12, "{steady}");
        let blinking = flicker([&lines(0.5), &lines(0.2), &lines(0.5)], &track, &track);
        assert!((blinking - 0.6).abs() < 0.01, "{blinking}");
    }
}
