//! Twin of `lib/stripes.wgsl`: lines along a field over the whole surface. Knöppel and others, "Stripe patterns on
//! surfaces", 2015, section 4.

use glam::{DVec2, DVec3};

use super::halftone::line_ink;
use crate::cpu::builtin::{mix, smoothstep};
use crate::types::StripePhases;

/// Lines closer than this many to the pixel turn grey, from here on.
pub const FADE_FROM: f64 = 0.35_f32 as f64;
/// To here.
pub const FADE_TO: f64 = 0.5;

/// The side, from corner k to the next, of the third of the triangle that the fragment is in.
pub fn nearest_side(w: DVec3) -> u32 {
    if w.z <= w.x && w.z <= w.y {
        return 0;
    }
    if w.x <= w.y { 1 } else { 2 }
}

/// Corners between which the phase is linear where the fragment is. Beyond the fold they count the other way.
pub fn unfolded_corners(s: &StripePhases, w: DVec3) -> DVec3 {
    let [a, b, c] = s.corners.map(f64::from);
    if s.code & 1 == 0 {
        return DVec3::new(a, b, c);
    }
    let sum = f64::from(s.code >> 1);
    let middle = 1.5 * sum;
    match nearest_side(w) {
        0 => DVec3::new(a, b, middle - a - b),
        1 => DVec3::new(middle - b - c, b, c),
        _ => DVec3::new(sum - a, middle - (sum - a) - c, c),
    }
}

/// How often the phase winds around the middle.
pub fn windings(s: &StripePhases) -> f64 {
    if s.code & 1 == 0 { f64::from(s.code >> 1) } else { 0.0 }
}

/// Weights of the side's two corners, without what the middle has of them.
pub fn side_weights(w: DVec3) -> DVec2 {
    match nearest_side(w) {
        0 => DVec2::new(w.x - w.z, w.y - w.z),
        1 => DVec2::new(w.y - w.x, w.z - w.x),
        _ => DVec2::new(w.z - w.y, w.x - w.y),
    }
}

/// The share of the way round from corner 0, linear along the sides.
pub fn round_share(w: DVec3) -> f64 {
    let ends = side_weights(w);
    (f64::from(nearest_side(w)) + ends.y / (ends.x + ends.y).max(1e-6)) / 3.0
}

/// Its change with the weights.
pub fn round_slope(w: DVec3, dw: DVec3) -> f64 {
    let ends = side_weights(w);
    let d = match nearest_side(w) {
        0 => DVec2::new(dw.x - dw.z, dw.y - dw.z),
        1 => DVec2::new(dw.y - dw.x, dw.z - dw.x),
        _ => DVec2::new(dw.z - dw.y, dw.x - dw.y),
    };
    let sum = (ends.x + ends.y).max(1e-3);
    (ends.x * d.y - ends.y * d.x) / (3.0 * sum * sum)
}

/// Phase at a fragment, in lines.
pub fn stripe_phase(s: &StripePhases, w: DVec3) -> f64 {
    let turns = windings(s);
    let linear = unfolded_corners(s, w).dot(w);
    if turns == 0.0 { linear } else { linear + turns * round_share(w) }
}

/// Change of the phase where the weights change by `dw`.
pub fn stripe_slope(s: &StripePhases, w: DVec3, dw: DVec3) -> f64 {
    let turns = windings(s);
    let linear = unfolded_corners(s, w).dot(dw);
    if turns == 0.0 { linear } else { linear + turns * round_slope(w, dw) }
}

/// Lines at the phase, doubled until they stand between `line_period_px` and twice that on the screen, but never
/// halved: where they are too close for pixels they turn grey.
pub fn doubled_ink(phase: f64, phase_per_px: f64, line_period_px: f64, d: f64) -> f64 {
    let wanted = 1.0 / (phase_per_px * line_period_px).max(1e-6);
    let octave = wanted.log2().floor().max(0.0);
    let f = (wanted / octave.exp2() - 1.0).clamp(0.0, 1.0);
    let lines = octave.exp2();
    let ink = line_ink(phase * lines, phase_per_px * lines, d, f);
    mix(ink, d, smoothstep(FADE_FROM, FADE_TO, phase_per_px * lines))
}

/// Darkness of the lines and of those that cross them, so that both together have `d` where they are independent.
pub fn crossed_darkness(d: f64, cross_from: f64) -> DVec2 {
    if d <= cross_from {
        return DVec2::new(d, 0.0);
    }
    let rest = ((1.0 - d).max(0.0) / (1.0 - cross_from).max(1e-6)).sqrt();
    DVec2::new(1.0 - (1.0 - cross_from) * rest, 1.0 - rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kinds() -> [StripePhases; 4] {
        let corners = [0.25, 1.5, -0.75];
        [(0, false), (1, false), (-2, false), (3, true)].map(|(number, folds)| match folds {
            true => StripePhases::folded(corners, number),
            false => StripePhases::wound(corners, number),
        })
    }

    #[test]
    fn lines_stay_where_they_are_while_others_come() {
        for octave in [0, 1, 3, 6] {
            let per_px = 1.0 / (6.0 * f64::from(1 << octave));
            for i in 0..200 {
                let (phase, d) = (f64::from(i) / 200.0, 0.1 + 0.8 * f64::from(i % 7) / 7.0);
                let [before, after] = [1.0 + 1e-9, 1.0 - 1e-9].map(|near| doubled_ink(phase, near * per_px, 6.0, d));
                assert!((before - after).abs() < 1e-6, "{before} to {after} at {phase}, doubled {octave} times");
            }
        }
        // In the middle of an old line there is ink at any level.
        for zoom in 0..60 {
            let per_px = 0.05 * (-0.1 * f64::from(zoom)).exp2();
            assert!(doubled_ink(3.0, per_px, 6.0, 0.3) > 0.99, "{zoom}");
        }
    }

    #[test]
    fn lines_too_dense_for_pixels_are_grey() {
        for i in 0..50 {
            assert_eq!(doubled_ink(f64::from(i) * 0.37, 0.6, 6.0, 0.42), 0.42);
        }
    }

    #[test]
    fn both_fields_together_have_the_darkness_asked_for() {
        for cross_from in [0.0, 0.3, 0.55, 1.0] {
            for d in [0.0, 0.2, 0.55, 0.56, 0.8, 1.0] {
                let shares = crossed_darkness(d, cross_from);
                assert!(((1.0 - shares.x) * (1.0 - shares.y) - (1.0 - d)).abs() < 1e-12, "{d} from {cross_from}");
                assert!(d > cross_from || shares.y == 0.0);
            }
        }
    }

    #[test]
    fn the_slope_is_the_change_of_the_phase() {
        let weights = [DVec3::new(0.6, 0.3, 0.1), DVec3::new(0.1, 0.5, 0.4), DVec3::new(0.3, 0.1, 0.6)];
        for (s, w) in kinds().into_iter().flat_map(|s| weights.map(|w| (s, w))) {
            let dw = DVec3::new(1e-6, 2e-6, -3e-6);
            let change = stripe_phase(&s, w + dw) - stripe_phase(&s, w);
            assert!((change - stripe_slope(&s, w, dw)).abs() < 1e-9, "{s:?} at {w}");
        }
    }

    #[test]
    fn inside_a_triangle_phases_jump_by_whole_lines_only() {
        for s in kinds() {
            let mut greatest = 0.0_f64;
            for step in 0..3000 {
                // Once around the middle.
                let at = |step: i32| {
                    let angle = std::f64::consts::TAU * f64::from(step) / 3000.0;
                    let shift = |third: f64| (angle + third * std::f64::consts::TAU / 3.0).cos() * 0.2;
                    DVec3::new(1.0 / 3.0 + shift(0.0), 1.0 / 3.0 + shift(1.0), 1.0 / 3.0 + shift(2.0))
                };
                let [here, next] = [step, step + 1].map(|step| {
                    let phase = stripe_phase(&s, at(step));
                    (phase - phase.round()).abs()
                });
                greatest = greatest.max((here - next).abs());
            }
            // A circle of 3000 steps, on which no phase changes by more than a dozen lines.
            assert!(greatest < 12.0 / 1000.0, "{s:?}: {greatest}");
        }
    }
}
