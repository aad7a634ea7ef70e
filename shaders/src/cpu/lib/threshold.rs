//! Twin of `lib/threshold.wgsl`: thresholds of a stroke map. Freudenberg, "Real-Time Stroke Textures", SIGGRAPH 2001
//! sketch.

use super::material::Material;
use crate::cpu::builtin::{mix, step};

/// Steepest slope: where the map is level, strokes that share a threshold still come over a range of tones.
pub const MAX_SLOPE: f64 = 24.0;
/// Rows of the distribution table from one level of detail to the next.
pub const ROWS_PER_LEVEL: usize = 8;

/// Entry `i` of a row of the distribution table.
pub fn distribution_entry(distribution: &[Vec<f64>], row: usize, i: usize) -> f64 {
    distribution[row][i]
}

/// A threshold as a share of the samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Equalised {
    /// Share of the tile that is inked before.
    pub share: f64,
    /// Change of the share with the threshold.
    pub rate: f64,
}

/// Share of the tile that is inked before a filtered threshold `theta` at this level is.
pub fn equalised(material: &Material, distribution: &[Vec<f64>], theta: f64, level: f64) -> Equalised {
    if material.distribution_entries < 2.0 {
        return Equalised { share: theta, rate: 1.0 };
    }
    let steps = material.distribution_entries - 1.0;
    let x = theta.clamp(0.0, 1.0) * steps;
    let i = (x as usize).min(material.distribution_entries as usize - 2);
    let row = ROWS_PER_LEVEL as f64 * level;
    let r = row as usize;
    let last = distribution.len() - 1;
    let at = |row: usize, i: usize| distribution_entry(distribution, row.min(last), i);
    let [low, high] = [i, i + 1].map(|i| mix(at(r, i), at(r + 1, i), row - r as f64));
    Equalised { share: mix(low, high, fract_of(x, i)), rate: (high - low) * steps }
}

/// How far `x` is beyond `i`.
pub fn fract_of(x: f64, i: usize) -> f64 {
    x - i as f64
}

/// Half ink where darkness and threshold meet; `per_px` is how much the threshold changes across a pixel.
pub fn threshold_centred(d: f64, theta: f64, per_px: f64) -> f64 {
    let slope = (1.0 / per_px.max(1e-4)).min(MAX_SLOPE);
    let ramp = (0.5 / slope).min(d.min(1.0 - d));
    if ramp < 1e-4 {
        return step(0.5, d);
    }
    (0.5 + 0.5 * (d - theta) / ramp).clamp(0.0, 1.0)
}

/// As the sketch prints it: too light by half a ramp in mid-tones.
pub fn threshold_one_sided(d: f64, theta: f64, slope: f64) -> f64 {
    (slope * (d - theta)).clamp(0.0, 1.0)
}
