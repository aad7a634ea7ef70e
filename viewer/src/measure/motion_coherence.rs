//! Motion coherence: whether strokes move with the surface.

use std::fmt;

use super::aov::Aov;
use super::blur::MaskedBlur;
use super::plane::Plane;
use super::track::Track;

/// Change of the strokes on the surface from one frame to another.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct MotionCoherence {
    /// 0: strokes are fixed to the surface; 1: as if the frames had nothing to do with each other.
    pub change: f64,
    /// Surface points that were compared.
    pub pixels: usize,
}

/// Σ |H(x) - H'(x + u)| / Σ 2 p (1 - p) over the points seen in both frames, H and H' their ink, u the motion of the
/// surface, p the local coverage of the first frame, a Gaussian mean of `sigma_px` (two stroke periods or more).
///
/// The other frame is read bilinearly: strokes that move by parts of a pixel read as about 0.1 to 0.3 where they are 2 px wide,
/// which is the figure of a pattern baked on the surface; measure it beside. Grey pictures read lower than crisp ones. None
/// where nothing is inked.
pub fn motion_coherence(before: &Plane, after: &Plane, track: &Track, sigma_px: f64) -> Option<MotionCoherence> {
    let mask = track.mask();
    let brought = track.bring(after, before.size);
    let coverage = MaskedBlur::new(before.size, &mask, sigma_px).apply(&before.pixels);
    let (mut changed, mut unrelated) = (0.0, 0.0);
    for i in (0..mask.len()).filter(|i| mask[*i]) {
        changed += (before.pixels[i] - brought.pixels[i]).abs();
        unrelated += differing(coverage[i], coverage[i]);
    }
    let pixels = mask.iter().filter(|followed| **followed).count();
    (unrelated > 0.0).then(|| MotionCoherence { change: changed / unrelated, pixels })
}

/// Mean difference of two crisp patterns of these coverages that have nothing to do with each other.
pub(super) fn differing(p: f64, q: f64) -> f64 {
    let [p, q] = [p, q].map(|coverage| coverage.clamp(0.0, 1.0));
    p * (1.0 - q) + q * (1.0 - p)
}

impl fmt::Display for MotionCoherence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "strokes change by {:.3} over {} px of surface (0 rigid, 1 unrelated)", self.change, self.pixels)
    }
}

/// Change of the strokes under a light step.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct LightSwimming {
    /// What is left of the change less that of the tone: 0, strokes only appear and vanish; 1, they are others.
    pub swimming: f64,
    /// The change in all, as [`MotionCoherence::change`].
    pub change: f64,
    /// What of it goes the way that the tone goes, less what goes the other way.
    pub tone_change: f64,
}

/// The motion-coherence figure between two frames that differ by their lights only, less what the tone itself changes:
/// Σ (|H' - H| - s (H' - H)) / Σ (p (1 - p') + p' (1 - p)), s the sign of the wanted change of darkness at the pixel, p and
/// p' the local coverages, means over `sigma_px`.
///
/// Strokes that stay and nest, each darker pattern holding the lighter one, have 0: ink comes only where it should grow
/// darker, and goes only where lighter. Of strokes that move, as much ink changes the wrong way as they have moved. Both
/// surfaces are of the same view. None where nothing is inked.
pub fn light_swimming(before: &Plane, after: &Plane, aovs: [&Aov; 2], sigma_px: f64) -> Option<LightSwimming> {
    let mask = aovs[0].covered();
    let blur = MaskedBlur::new(before.size, &mask, sigma_px);
    let (p, q) = (blur.apply(&before.pixels), blur.apply(&after.pixels));
    let darkness = |aov: &Aov, i: usize| aov.pixels[i].as_ref().map_or(0.0, |surface| surface.darkness);
    let (mut changed, mut tone, mut unrelated) = (0.0, 0.0, 0.0);
    for i in (0..mask.len()).filter(|i| mask[*i]) {
        let change = after.pixels[i] - before.pixels[i];
        let wanted = darkness(aovs[1], i) - darkness(aovs[0], i);
        changed += change.abs();
        if wanted != 0.0 {
            tone += wanted.signum() * change;
        }
        unrelated += differing(p[i], q[i]);
    }
    let swimming = (changed - tone) / unrelated;
    let figures = LightSwimming { swimming, change: changed / unrelated, tone_change: tone / unrelated };
    (unrelated > 0.0).then_some(figures)
}

impl fmt::Display for LightSwimming {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "strokes swim by {:.3} ({:.3} less {:.3} of tone)", self.swimming, self.change, self.tone_change)
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::super::testing::{Grating, flat_aov, noise, ramp_aov};
    use super::*;

    const SIZE: [u32; 2] = [200, 200];

    /// The surface moves by so much.
    fn moved(by_px: DVec2) -> Track {
        let mut track = Track::still(&flat_aov(SIZE, 0.0, 0.4));
        for place in &mut track.places_px {
            *place = place.map(|place| place + by_px).filter(|place| place.max_element() < 198.0);
        }
        track
    }

    fn change(before: &Plane, after: &Plane, by_px: DVec2) -> f64 {
        motion_coherence(before, after, &moved(by_px), 12.0).expect("something is inked").change
    }

    #[test]
    fn baked_strokes_are_rigid_and_screen_space_ones_are_not() {
        let aov = flat_aov(SIZE, 0.0, 0.4);
        let by_px = DVec2::new(5.0, 2.0);
        let grating = Grating { angle_rad: 0.7, period_px: 6.0, shift: 0.0 };
        let across = DVec2::from_angle(0.7).perp();
        let before = grating.drawn_on(&aov);
        let baked = Grating { shift: -by_px.dot(across) / 6.0, ..grating }.drawn_on(&aov);
        assert!(change(&before, &baked, by_px) < 0.02, "{}", change(&before, &baked, by_px));
        // Parts of a pixel: what the bilinear reading blurs.
        let part_px = by_px + DVec2::new(0.5, 0.37);
        let baked = Grating { shift: -part_px.dot(across) / 6.0, ..grating }.drawn_on(&aov);
        assert!(change(&before, &baked, part_px) < 0.3, "{}", change(&before, &baked, part_px));
        // The shower door: the picture stays while the surface moves by half a period across the strokes.
        let half = across * 3.0;
        assert!(change(&before, &before, half) > 1.2, "{}", change(&before, &before, half));
    }

    #[test]
    fn unrelated_patterns_have_one() {
        let before = noise(SIZE, 1.5);
        let shifted = change(&before, &before, DVec2::new(50.0, 31.0));
        assert!((shifted - 1.0).abs() < 0.05, "{shifted}");
    }

    #[test]
    fn strokes_that_widen_do_not_swim_and_strokes_that_move_do() {
        let (lit, darker) = (ramp_aov(SIZE, 0.2, 0.4), ramp_aov(SIZE, 0.3, 0.6));
        let grating = Grating { angle_rad: 0.7, period_px: 6.0, shift: 0.0 };
        let before = grating.drawn_on(&lit);
        let still = light_swimming(&before, &grating.drawn_on(&darker), [&lit, &darker], 12.0).expect("inked");
        assert!(still.swimming.abs() < 1e-9 && still.tone_change > 0.2, "{still}");
        let moving = Grating { shift: 0.4, ..grating }.drawn_on(&darker);
        let swimming = light_swimming(&before, &moving, [&lit, &darker], 12.0).expect("inked");
        assert!(swimming.swimming > 0.5, "{swimming}");
    }
}
