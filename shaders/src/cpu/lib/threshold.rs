//! Twin of `lib/threshold.wgsl`: thresholds of a stroke map. Freudenberg, "Real-Time Stroke Textures", SIGGRAPH 2001
//! sketch.

use glam::DVec2;

use super::material::Material;

/// Steepest slope: where the map is level, strokes that share a threshold still come over a range of tones.
pub const MAX_SLOPE: f64 = 24.0;
/// Rows of the distribution table from one level of detail to the next.
pub const ROWS_PER_LEVEL: usize = 8;

/// Share and rate of entry `i` of a row of the distribution table.
pub fn distribution_entry(distribution: &[Vec<DVec2>], row: usize, i: usize) -> DVec2 {
    distribution[row][i]
}

/// A threshold as a share of the samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Equalised {
    /// Share of the tile that is inked before.
    pub share: f64,
    /// Change of the share with the threshold, without jumps.
    pub rate: f64,
}

/// Share of the tile that is inked before a filtered threshold `theta` at this level is.
pub fn equalised(material: &Material, distribution: &[Vec<DVec2>], theta: f64, level: f64) -> Equalised {
    if material.distribution_entries < 2.0 {
        return Equalised { share: theta, rate: 1.0 };
    }
    let x = theta.clamp(0.0, 1.0) * (material.distribution_entries - 1.0);
    let i = (x as usize).min(material.distribution_entries as usize - 2);
    let row = ROWS_PER_LEVEL as f64 * level;
    let r = row as usize;
    let last = distribution.len() - 1;
    let at = |row: usize, i: usize| distribution_entry(distribution, row.min(last), i);
    let [here, next] = [r, r + 1].map(|row| at(row, i).lerp(at(row, i + 1), fract_of(x, i)));
    let found = here.lerp(next, row - r as f64);
    Equalised { share: found.x, rate: found.y }
}

/// How far `x` is beyond `i`.
pub fn fract_of(x: f64, i: usize) -> f64 {
    x - i as f64
}

/// Share of a pixel above 0, where `x` changes from middle to edge by `half`.
pub fn share_above(x: f64, half: f64) -> f64 {
    (0.5 + 0.5 * x / half).clamp(0.0, 1.0)
}

/// Share of a pixel whose thresholds, `theta` in the middle and changing by `per_px` across, are below `d`. No threshold
/// leaves 0 ..= 1: there it turns back.
pub fn threshold_centred(d: f64, theta: f64, per_px: f64) -> f64 {
    let half = 0.5 * per_px.clamp(1.0 / MAX_SLOPE, 1.0);
    let below = share_above(d - theta, half);
    let turned_at_0 = share_above(-d - theta, half);
    let turned_at_1 = share_above(theta + d - 2.0, half);
    below - turned_at_0 + turned_at_1
}

/// As the sketch prints it: too light by half a ramp in mid-tones.
pub fn threshold_one_sided(d: f64, theta: f64, slope: f64) -> f64 {
    (slope * (d - theta)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Places in the middle of equal parts of 0..1.
    fn evenly(parts: usize) -> impl Iterator<Item = f64> {
        (0..parts).map(move |i| (i as f64 + 0.5) / parts as f64)
    }

    #[test]
    fn thresholds_spread_evenly_ink_the_wanted_share() {
        for per_px in [0.0, 0.1, 0.5, 1.0, 30.0] {
            for d in [0.0, 1e-3, 0.01, 0.3, 0.5, 0.98, 1.0] {
                let mean = evenly(4096).map(|theta| threshold_centred(d, theta, per_px)).sum::<f64>() / 4096.0;
                assert!((mean - d).abs() < 1e-4, "{mean} for {d} at {per_px}");
            }
        }
    }

    #[test]
    fn paper_and_ink_are_whole_and_no_stroke_comes_at_once() {
        const STEP: f64 = 1e-3;
        for per_px in [0.0, 0.2, 1.0] {
            for theta in [0.0, 1e-6, 0.003].into_iter().chain(evenly(50)).chain([1.0]) {
                let [paper, solid] = [0.0, 1.0].map(|d| threshold_centred(d, theta, per_px));
                assert!(paper.abs() < 1e-12 && (solid - 1.0).abs() < 1e-12, "{paper} {solid} at {theta}, {per_px}");
                let mut before = 0.0;
                for i in 1..=1000 {
                    let ink = threshold_centred(f64::from(i) * STEP, theta, per_px);
                    // At both ends two halves of a ramp come together.
                    assert!((-1e-12..=2.0 * MAX_SLOPE * STEP + 1e-12).contains(&(ink - before)), "{theta} {per_px}");
                    before = ink;
                }
            }
        }
    }
}
