//! The stroke map of one level: the darkness at which each texel becomes inked (Freudenberg 2001, figure 2).
//!
//! Built from the strokes that fill the level's cells, in the same order and beyond the darkest column. A texel counts as
//! inked once strokes, taken at full opacity, cover half of it. All new texels of a stroke get one threshold: the share of
//! inked texels when half of them are in, so that thresholding shows whole strokes and keeps the tone within half a stroke.

use super::Canvas;
use super::canvas::HALF;
use crate::map::ThresholdLevel;

/// Share of inked texels at which strokes end and the remaining gaps close from their edges.
const DENSE: f64 = 0.92;
/// Strokes without a new texel after which no more are tried.
const IDLE_STROKES: u32 = 64;
/// Mark of texels without a threshold while gaps close.
const OPEN: u8 = 255;

/// Thresholds of one level while strokes are added.
#[derive(Debug, Clone, Default)]
pub(crate) struct ThresholdCanvas {
    size: u32,
    threshold: Vec<u8>,
    inked: u32,
    idle: u32,
}

impl ThresholdCanvas {
    /// White paper of the given side.
    pub(crate) fn reset(&mut self, size: u32) {
        self.size = size;
        self.threshold.clear();
        self.threshold.resize(size as usize * size as usize, OPEN);
        (self.inked, self.idle) = (0, 0);
    }

    /// Adds a stroke, given by the texels that it has covered by half. Returns whether more strokes are worth trying.
    pub(crate) fn add(&mut self, fresh: &[u32]) -> bool {
        let threshold = self.threshold_at(f64::from(self.inked) + 0.5 * fresh.len() as f64);
        for texel in fresh {
            self.threshold[*texel as usize] = threshold;
        }
        self.inked += fresh.len() as u32;
        self.idle = if fresh.is_empty() { self.idle + 1 } else { 0 };
        self.idle < IDLE_STROKES
    }

    /// Whether so little paper is left that gaps should close.
    pub(crate) fn dense_enough(&self) -> bool {
        f64::from(self.inked) >= DENSE * self.threshold.len() as f64
    }

    /// Gives the texels still open their thresholds: rings of texels from the edges of the gaps inwards, those with more
    /// cover first.
    pub(crate) fn close_gaps(&mut self, canvas: &mut Canvas) {
        let mask = self.size - 1;
        let shift = self.size.ilog2();
        let neighbours = |texel: u32| {
            let (x, y) = (texel & mask, texel >> shift);
            let at = |x: u32, y: u32| (y & mask) << shift | (x & mask);
            [at(x.wrapping_sub(1), y), at(x + 1, y), at(x, y.wrapping_sub(1)), at(x, y + 1)]
        };
        let mut open = canvas.open();
        while !open.is_empty() {
            let (mut ring, inner): (Vec<u32>, Vec<u32>) = open
                .iter()
                .partition(|texel| neighbours(**texel).iter().any(|neighbour| canvas.cover_at(*neighbour) >= HALF));
            if ring.is_empty() {
                // White paper all over: no stroke at all.
                ring.clone_from(&open);
                open.clear();
            } else {
                open = inner;
            }
            ring.sort_by_key(|texel| (std::cmp::Reverse(canvas.cover_at(*texel)), *texel));
            for same in ring.chunk_by(|a, b| canvas.cover_at(*a) == canvas.cover_at(*b)) {
                let threshold = self.threshold_at(f64::from(self.inked) + 0.5 * same.len() as f64);
                for texel in same {
                    self.threshold[*texel as usize] = threshold;
                }
                self.inked += same.len() as u32;
            }
            for texel in ring {
                canvas.cover(texel);
            }
        }
    }

    fn threshold_at(&self, inked: f64) -> u8 {
        // 255 is left to solid ink.
        (255.0 * inked / self.threshold.len() as f64).round().min(254.0) as u8
    }

    /// The finished level, in the buffers of an older one.
    pub(crate) fn copy_to(&self, level: &mut ThresholdLevel) {
        level.size = self.size;
        level.threshold.clone_from(&self.threshold);
    }
}

/// Entries of each row of the distribution table.
const ENTRIES: usize = 65;

/// What bilinear filtering and blending of levels leave of the distribution of thresholds: a row for each level, and one
/// for each half way between two levels. See [`crate::StrokeMap::distribution`].
pub(crate) fn distribution(levels: &[ThresholdLevel]) -> Vec<Vec<f32>> {
    let mut rows = Vec::new();
    for (i, level) in levels.iter().enumerate() {
        let coarser = levels.get(i + 1);
        let (mut own, mut half_way) = ([0; 256], [0; 256]);
        // Some ten thousand samples settle the table to a few thousandths; an odd step visits all columns.
        let step = (level.threshold.len() >> 13).max(1) | 1;
        for texel in (0..level.threshold.len()).step_by(step) {
            let (x, y) = (texel as u32 & (level.size - 1), texel as u32 >> level.size.ilog2());
            // A quarter texel off its middle is where a bilinear sample falls on average, to all four sides alike: strokes
            // are not the same on both.
            let side = |odd: u32| if odd & 1 == 0 { 2 } else { -2 };
            let (x, y) = (8 * x as i32 + side(x ^ (y >> 1)), 8 * y as i32 + side(y ^ (x >> 1)));
            let sample = bilinear(level, x, y);
            own[(sample / 64) as usize] += 1;
            if let Some(coarser) = coarser {
                // Texels of the coarser level are twice as wide, and their middles half a fine texel further in.
                half_way[((sample + bilinear(coarser, (x - 4) / 2, (y - 4) / 2)) / 128) as usize] += 1;
            }
        }
        rows.push(cumulative(&own));
        if coarser.is_some() {
            rows.push(cumulative(&half_way));
        }
    }
    rows
}

/// Cumulative distribution of samples, counted by their whole part, at [`ENTRIES`] even steps.
fn cumulative(histogram: &[u32; 256]) -> Vec<f32> {
    let taken: u32 = histogram.iter().sum();
    let mut at_most = 0;
    let mut cumulative = [0.0; 257];
    for (i, samples) in histogram.iter().enumerate() {
        at_most += samples;
        cumulative[i + 1] = at_most as f32 / taken as f32;
    }
    (0..ENTRIES).map(|i| cumulative[i * 256 / (ENTRIES - 1)]).collect()
}

/// Bilinear sample, in 64ths, at a position in eighths of a texel whose whole numbers are texel middles. Exact.
fn bilinear(level: &ThresholdLevel, x: i32, y: i32) -> u32 {
    let (mask, shift) = (level.size - 1, level.size.ilog2());
    let (left, top) = ((x >> 3) as u32, (y >> 3) as u32);
    let (fx, fy) = ((x & 7) as u32, (y & 7) as u32);
    let at = |x: u32, y: u32| u32::from(level.threshold[((y & mask) << shift | (x & mask)) as usize]);
    let (right, below) = (left.wrapping_add(1), top.wrapping_add(1));
    (8 - fy) * ((8 - fx) * at(left, top) + fx * at(right, top))
        + fy * ((8 - fx) * at(left, below) + fx * at(right, below))
}
