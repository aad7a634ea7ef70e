//! Twin of `lib/strokes.wgsl`: lines cut by a burin, each a row of strokes that swell and taper, with gaps between them.
//! What a stroke looks like is drawn by lot from seed, row and cell; the mean darkness is kept.

use std::f64::consts::TAU;

use super::halftone::line_coverage;
use glam::DVec3;

use super::material::Material;
use super::patches::{NO_SEED, OVERLAPS, Overlap, overlap_weights};
use crate::cpu::builtin::mix;

/// Length of a stroke of the coarsest lines, in tiles.
pub const STROKE_TILES: f64 = 1.6_f32 as f64;
/// Share of a cell that is a gap, at variety 1.
pub const GREATEST_GAP: f64 = 0.2_f32 as f64;
/// How much strokes differ in strength, at variety 1.
pub const GREATEST_DIFFERENCE: f64 = 0.3_f32 as f64;
/// Mean of a stroke's profile.
pub const PROFILE_MEAN: f64 = 0.75;
/// Share of the free space beside a line that it wavers through, at variety 1.
pub const GREATEST_WAVER: f64 = 0.5;

/// A stroke at a place of its line.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stroke {
    /// Its darkness over the mean, minus 1; 0 in the mean.
    pub swell: f64,
    /// Its shift across, -1..=1.
    pub waver: f64,
}

/// The finaliser of Wellons, "Prospecting for hash functions", 2018.
pub fn mixed_bits(bits: u32) -> u32 {
    let x = (bits ^ bits >> 16).wrapping_mul(0x7feb_352d);
    let x = (x ^ x >> 15).wrapping_mul(0x846c_a68b);
    x ^ x >> 16
}

/// A number 0..1 by lot.
pub fn lot(key: u32, counter: u32) -> f64 {
    f64::from(mixed_bits(key.wrapping_add(counter.wrapping_mul(0x9e37_79b9))) >> 8) / 16_777_216.0
}

/// How often lines were doubled when the one in this row came, rows being counted after `octave` doublings.
pub fn row_octave(row: i32, octave: u32) -> u32 {
    octave - row.trailing_zeros().min(octave)
}

/// The lot of the line in a row, counted when it came.
pub fn row_key(seed: u32, row: i32, born: u32) -> u32 {
    let of_line = mixed_bits((row as u32).wrapping_add(0x68e3_1da4_u32.wrapping_mul(born)));
    mixed_bits(of_line.wrapping_add(seed))
}

/// Shift of a line's cells, 0..1, so that no two strokes side by side swell together.
pub fn row_shift(row: i32) -> f64 {
    f64::from((row as u32).wrapping_mul(0x4f1b_bcdc) >> 8) / 16_777_216.0
}

/// Counter of a cell's own lots.
fn counter(c: i32, which: u32) -> u32 {
    (c as u32).wrapping_mul(4).wrapping_add(which)
}

/// Where cell `c` of a line starts; cells are 0.5 to 1.5 long.
pub fn cell_start(key: u32, c: i32) -> f64 {
    f64::from(c) + 0.5 * lot(key, counter(c, 4))
}

/// Share of a cell that is a gap.
pub fn stroke_gap(variety: f64) -> f64 {
    GREATEST_GAP * variety * variety
}

/// The greatest swell of any stroke.
pub fn greatest_swell(variety: f64) -> f64 {
    (1.0 + GREATEST_DIFFERENCE * variety) / (PROFILE_MEAN * (1.0 - stroke_gap(variety))) - 1.0
}

/// Thickness of a stroke from its one end to the other, `t` in 0..=1, thickest at `peak`; its mean is [`PROFILE_MEAN`].
pub fn stroke_profile(t: f64, peak: f64) -> f64 {
    let off = if t < peak { (peak - t) / peak } else { (t - peak) / (1.0 - peak) };
    1.0 - off.clamp(0.0, 1.0).powi(3)
}

/// The stroke of a line at a place along it, in tiles; `row` is counted when the line came.
pub fn stroke_at(key: u32, row: i32, born: u32, along: f64, variety: f64) -> Stroke {
    let x = along * (0.5 * f64::from(born)).exp2() / STROKE_TILES + row_shift(row);
    let mut c = x.floor() as i32;
    if x < cell_start(key, c) {
        c -= 1;
    }
    let start = cell_start(key, c);
    let gap = stroke_gap(variety);
    let t = (x - start) / ((cell_start(key, c + 1) - start) * (1.0 - gap));
    let strength = 1.0 + GREATEST_DIFFERENCE * variety * (2.0 * lot(key, counter(c, 5)) - 1.0);
    let profile = stroke_profile(t, mix(0.3, 0.7, lot(key, counter(c, 6))));
    let waver = (TAU * (0.8 * x + lot(key, 1)).rem_euclid(1.0)).sin();
    Stroke { swell: strength * profile / (PROFILE_MEAN * (1.0 - gap)) - 1.0, waver }
}

/// Darkness of a stroke where all together have `d`: in 0..=1, and `d` in the mean.
pub fn stroke_darkness(d: f64, swell: f64, variety: f64) -> f64 {
    let most = d.min((1.0 - d) / greatest_swell(variety));
    d + (1.6 * variety).min(1.0) * most * swell
}

/// How far from the middle of its strip any stroke has ink.
pub fn stroke_reach(strip: f64, d: f64, variety: f64) -> f64 {
    let most = stroke_darkness(d, greatest_swell(variety), variety);
    0.5 * strip * (most + GREATEST_WAVER * variety * (1.0 - most))
}

/// Ink of one line: `x` from its middle, in a strip of its own as wide as `strip`, in units of `line_ink`.
pub fn stroke_ink(stroke: Stroke, x: f64, strip: f64, k: f64, d: f64, variety: f64) -> f64 {
    let own = stroke_darkness(d, stroke.swell, variety);
    let shift = 0.5 * GREATEST_WAVER * variety * stroke.waver * (1.0 - own) * strip;
    line_coverage((x - shift).abs(), own * strip, k)
}

/// Sign and number that make a row of a patch out of a phase, from what a corner carries of it; field 0 along, 1 across.
pub fn patch_row(code: u32, field: u32) -> [i32; 2] {
    let half = ((code << (16 - 16 * field)) as i32) >> 16;
    [1 - 2 * (half & 1), half >> 1]
}

/// A line of a field: its row, counted from the triangle's own phase 0 after some doublings, and their number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Line {
    /// 0 along, 1 across.
    pub field: u32,
    /// After the doublings.
    pub row: i32,
    /// Doublings.
    pub octave: u32,
}

/// What one patch gives to the stroke of a line: swell and waver by its weight, and the weight of the swell. `along` is its
/// place, in tiles.
pub fn patch_stroke(weight: f64, [seed, code]: [u32; 2], along: f64, line: Line, variety: f64) -> DVec3 {
    let Line { field, row, octave } = line;
    if weight == 0.0 {
        return DVec3::ZERO;
    }
    if seed == NO_SEED {
        return DVec3::new(0.0, 0.0, 0.25 * weight * weight);
    }
    let [sign, number] = patch_row(code, field);
    let own_row = sign * row + (number << octave);
    let born = row_octave(own_row, octave);
    let line = own_row >> (octave - born);
    let key = row_key(2 * seed + field, line, born);
    let pull = weight * (0.1 + 0.9 * lot(key, 2));
    let share = pull * pull;
    let stroke = stroke_at(key, line, born, along, variety);
    DVec3::new(share * stroke.swell, weight * f64::from(sign) * stroke.waver, share)
}

/// The stroke of a line at a fragment.
pub fn patched_stroke(
    material: &Material,
    overlap: &Overlap,
    rows: [u32; OVERLAPS],
    line: Line,
    variety: f64,
) -> Stroke {
    let tiles = material.tile_from_surface.truncate().truncate().length();
    let weights = overlap_weights(overlap.behind).to_array();
    let of_patch = |i: usize| {
        let along = tiles * overlap.places[i][line.field as usize];
        patch_stroke(weights[i], [overlap.seeds[i], rows[i]], along, line, variety)
    };
    let sum: DVec3 = (0..OVERLAPS).map(of_patch).sum();
    Stroke { swell: sum.x / sum.z.max(1e-12), waver: sum.y }
}
