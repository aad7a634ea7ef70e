//! The phase of lines inside a triangle. Knöppel and others, "Stripe patterns on surfaces", 2015, section 4.

use bytemuck::{Pod, Zeroable};
use glam::{DVec2, DVec3};

/// The stripes of one line field in one triangle. The phase counts lines: it is whole in the middle of each, and known up
/// to sign and whole numbers.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct StripePhases {
    /// Of the corners, in lines.
    pub corners: [f32; 3],
    /// Low bit: 0 where the phase winds around the middle of the triangle, 1 where the field is singular and the phase
    /// folds there. Above: how often it winds (0 nearly everywhere: it is linear), or the sum of corner 0's phase and
    /// the same after a way round.
    pub code: i32,
}

impl StripePhases {
    /// A phase that grows by `turns` on the way round, beside what the corners say; 0: it is linear.
    pub fn wound(corners: [f32; 3], turns: i32) -> Self {
        Self { corners, code: turns << 1 }
    }

    /// A phase that comes back from the way round as `sum - corners[0]`.
    pub fn folded(corners: [f32; 3], sum: i32) -> Self {
        Self { corners, code: sum << 1 | 1 }
    }

    /// Whether it is linear all over the triangle.
    pub fn is_linear(&self) -> bool {
        self.code == 0
    }

    /// How often it winds around the middle.
    pub fn windings(&self) -> i32 {
        if self.code & 1 == 0 { self.code >> 1 } else { 0 }
    }

    /// The phase at a side's two corners, from corner `side` to the next, and in the middle, between which it is linear but
    /// for its winding there; and how often it winds.
    pub(crate) fn at_side(&self, side: usize) -> ([f32; 3], i8) {
        let turns = self.windings();
        let [a, b, c] = self.corners.map(f64::from);
        let (ends, middle) = if self.code & 1 == 0 {
            // The way round from corner 0 to this side.
            let before = f64::from(turns) * side as f64 / 3.0;
            let ends = [[a, b], [b, c], [c, a]][side];
            (ends.map(|end| end + before), (a + b + c) / 3.0 + before)
        } else {
            // Beyond the fold corner 0 is counted the other way; the middle is its own mirror image.
            let sum = f64::from(self.code >> 1);
            ([[a, b], [b, c], [c, sum - a]][side], 0.5 * sum)
        };
        ([ends[0], ends[1], middle].map(|phase| phase as f32), turns.clamp(-127, 127) as i8)
    }

    /// The same phase counted with another sign and from another line: `sign * phase + number`.
    #[must_use]
    pub fn recounted(&self, turned: bool, number: i32) -> Self {
        let sign = if turned { -1 } else { 1 };
        let corners = self.corners.map(|corner| sign as f32 * corner + number as f32);
        let code = match self.code & 1 {
            0 => (sign * (self.code >> 1)) << 1,
            _ => (sign * (self.code >> 1) + 2 * number) << 1 | 1,
        };
        Self { corners, code }
    }
}

/// The side, from corner k to the next, of the third of the triangle that the fragment is in.
fn nearest_side(w: DVec3) -> u32 {
    if w.z <= w.x && w.z <= w.y {
        return 0;
    }
    if w.x <= w.y { 1 } else { 2 }
}

/// Corners between which the phase is linear where the fragment is. Beyond the fold they count the other way.
fn unfolded_corners(s: &StripePhases, w: DVec3) -> DVec3 {
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

/// Weights of the side's two corners, without what the middle has of them.
fn side_weights(w: DVec3) -> DVec2 {
    match nearest_side(w) {
        0 => DVec2::new(w.x - w.z, w.y - w.z),
        1 => DVec2::new(w.y - w.x, w.z - w.x),
        _ => DVec2::new(w.z - w.y, w.x - w.y),
    }
}

/// The share of the way round from corner 0, linear along the sides.
fn round_share(w: DVec3) -> f64 {
    let ends = side_weights(w);
    (f64::from(nearest_side(w)) + ends.y / (ends.x + ends.y).max(1e-6)) / 3.0
}

/// Its change with the weights.
#[cfg(test)]
fn round_slope(w: DVec3, dw: DVec3) -> f64 {
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
pub(crate) fn stripe_phase(s: &StripePhases, w: DVec3) -> f64 {
    let turns = f64::from(s.windings());
    let linear = unfolded_corners(s, w).dot(w);
    if turns == 0.0 { linear } else { linear + turns * round_share(w) }
}

/// Change of the phase where the weights change by `dw`.
#[cfg(test)]
fn stripe_slope(s: &StripePhases, w: DVec3, dw: DVec3) -> f64 {
    let turns = f64::from(s.windings());
    let linear = unfolded_corners(s, w).dot(dw);
    if turns == 0.0 { linear } else { linear + turns * round_slope(w, dw) }
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

    #[test]
    fn a_phase_counted_otherwise_is_the_same_up_to_sign_and_whole_numbers() {
        for s in kinds() {
            for (turned, number) in [(false, 3), (true, -2), (true, 0)] {
                let other = s.recounted(turned, number);
                for w in [DVec3::new(0.6, 0.3, 0.1), DVec3::new(0.1, 0.5, 0.4), DVec3::new(0.3, 0.1, 0.6)] {
                    let sign = if turned { -1.0 } else { 1.0 };
                    let expected = sign * stripe_phase(&s, w) + f64::from(number);
                    assert!((stripe_phase(&other, w) - expected).abs() < 1e-9, "{s:?} {turned} {number}");
                }
            }
        }
    }
}
