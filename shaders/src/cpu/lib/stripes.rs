//! Twin of `lib/stripes.wgsl`: lines along a field over the whole surface. Knöppel and others, "Stripe patterns on
//! surfaces", 2015, section 4.

use glam::DVec2;

use super::halftone::line_ink;
use crate::cpu::builtin::{mix, smoothstep};

/// Lines closer than this many to the pixel turn grey, from here on.
pub const FADE_FROM: f64 = 0.35_f32 as f64;
/// To here.
pub const FADE_TO: f64 = 0.5;

/// The share of the way round a triangle in which lines end, from the first of a side's two corners to the second; `ends`
/// are their weights.
pub fn round_share(ends: DVec2) -> f64 {
    ends.y / (3.0 * (ends.x + ends.y).max(1e-6))
}

/// Its change with the weights.
pub fn round_slope(ends: DVec2, change: DVec2) -> f64 {
    let sum = (ends.x + ends.y).max(1e-3);
    (ends.x * change.y - ends.y * change.x) / (3.0 * sum * sum)
}

/// The phase that is `phase` but for its winding, which goes round so many times.
pub fn wound_phase(phase: f64, ends: DVec2, turns: f64) -> f64 {
    if turns == 0.0 { phase } else { phase + turns * round_share(ends) }
}

/// Its change, likewise.
pub fn wound_slope(slope: f64, ends: DVec2, change: DVec2, turns: f64) -> f64 {
    if turns == 0.0 { slope } else { slope + turns * round_slope(ends, change) }
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
    fn the_slope_of_a_winding_is_its_change() {
        for ends in [DVec2::new(0.6, 0.3), DVec2::new(0.1, 0.7), DVec2::new(0.2, 0.2)] {
            let change = DVec2::new(1e-6, -2e-6);
            let grown = wound_phase(3.0, ends + change, -2.0) - wound_phase(3.0, ends, -2.0);
            assert!((grown - wound_slope(0.0, ends, change, -2.0)).abs() < 1e-9, "{ends}");
        }
    }
}
