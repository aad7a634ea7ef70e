//! The stroke map of one level: the darkness at which each texel becomes inked (Freudenberg 2001, figure 2).
//!
//! Built from the strokes that fill the level's cells, in the same order and beyond the darkest column. A texel counts as
//! inked once strokes, taken at full opacity, cover half of it. All new texels of a stroke get one threshold: the share of
//! inked texels when half of them are in, so that thresholding shows whole strokes and keeps the tone within half a stroke.

use crate::map::ThresholdLevel;
use crate::raster::{Footprint, over};
use crate::rounding::floor;

/// Share of inked texels at which strokes end and the remaining gaps close from their edges.
const DENSE: f64 = 0.92;
/// Ink at which a texel counts as covered.
const HALF: u8 = 128;
/// Strokes without a new texel after which no more are tried.
const IDLE_STROKES: u32 = 64;
/// Mark of texels without a threshold while gaps close.
const OPEN: u8 = 255;

/// Thresholds of one level while strokes are added.
#[derive(Debug, Clone, Default)]
pub(crate) struct ThresholdCanvas {
    size: u32,
    cover: Vec<u8>,
    threshold: Vec<u8>,
    inked: u32,
    fresh: Vec<u32>,
    idle: u32,
}

impl ThresholdCanvas {
    /// White paper of the given side.
    pub(crate) fn reset(&mut self, size: u32) {
        let texels = size as usize * size as usize;
        self.size = size;
        self.cover.clear();
        self.cover.resize(texels, 0);
        self.threshold.clear();
        self.threshold.resize(texels, OPEN);
        (self.inked, self.idle) = (0, 0);
    }

    /// Adds a stroke whose ink has the given opacity. Returns whether more strokes are worth trying.
    pub(crate) fn add(&mut self, footprint: &Footprint, opacity: f32) -> bool {
        let scale = (256.0 / opacity + 0.5) as u32;
        self.fresh.clear();
        for (texel, ink) in footprint.iter() {
            let cover = &mut self.cover[texel];
            if *cover < HALF {
                *cover = over(*cover, ((u32::from(ink) * scale) >> 8).min(255) as u8);
                if *cover >= HALF {
                    self.fresh.push(texel as u32);
                }
            }
        }
        let threshold = self.threshold_at(f64::from(self.inked) + 0.5 * self.fresh.len() as f64);
        for texel in &self.fresh {
            self.threshold[*texel as usize] = threshold;
        }
        self.inked += self.fresh.len() as u32;
        self.idle = if self.fresh.is_empty() { self.idle + 1 } else { 0 };
        self.idle < IDLE_STROKES
    }

    /// Whether so little paper is left that gaps should close.
    pub(crate) fn dense_enough(&self) -> bool {
        f64::from(self.inked) >= DENSE * self.threshold.len() as f64
    }

    /// Gives the texels still open their thresholds: rings of texels from the edges of the gaps inwards, those with more
    /// ink first.
    pub(crate) fn close_gaps(&mut self) {
        let mask = self.size - 1;
        let shift = self.size.ilog2();
        let neighbours = |texel: u32| {
            let (x, y) = (texel & mask, texel >> shift);
            let at = |x: u32, y: u32| ((y & mask) << shift | (x & mask)) as usize;
            [at(x.wrapping_sub(1), y), at(x + 1, y), at(x, y.wrapping_sub(1)), at(x, y + 1)]
        };
        let mut open: Vec<u32> =
            (0..self.threshold.len() as u32).filter(|texel| self.cover[*texel as usize] < HALF).collect();
        while !open.is_empty() {
            let (mut ring, inner): (Vec<u32>, Vec<u32>) = open
                .iter()
                .partition(|texel| neighbours(**texel).iter().any(|neighbour| self.cover[*neighbour] >= HALF));
            if ring.is_empty() {
                // White paper all over: no stroke at all.
                ring.clone_from(&open);
                open.clear();
            } else {
                open = inner;
            }
            ring.sort_by_key(|texel| (std::cmp::Reverse(self.cover[*texel as usize]), *texel));
            for same in ring.chunk_by(|a, b| self.cover[*a as usize] == self.cover[*b as usize]) {
                let threshold = self.threshold_at(f64::from(self.inked) + 0.5 * same.len() as f64);
                for texel in same {
                    self.threshold[*texel as usize] = threshold;
                }
                self.inked += same.len() as u32;
            }
            for texel in ring {
                self.cover[texel as usize] = HALF;
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
        let place = |texel: usize| {
            let (x, y) = (texel % level.size as usize, texel / level.size as usize);
            // A quarter texel off its middle is where a bilinear sample falls on average, to all four sides alike: strokes
            // are not the same on both.
            let side = |odd: usize| if odd & 1 == 0 { 0.25 } else { -0.25 };
            (x as f32 + side(x ^ (y >> 1)), y as f32 + side(y ^ (x >> 1)))
        };
        rows.push(cumulative(level.threshold.len(), |texel| {
            let (x, y) = place(texel);
            bilinear(level, x, y)
        }));
        if let Some(coarser) = levels.get(i + 1) {
            rows.push(cumulative(level.threshold.len(), |texel| {
                let (x, y) = place(texel);
                let at_coarser = bilinear(coarser, 0.5 * (x + 0.5) - 0.5, 0.5 * (y + 0.5) - 0.5);
                0.5 * (bilinear(level, x, y) + at_coarser)
            }));
        }
    }
    rows
}

/// Cumulative distribution of samples in `0.0 ..= 255.0` at [`ENTRIES`] even steps.
fn cumulative(count: usize, sample: impl Fn(usize) -> f32) -> Vec<f32> {
    let mut histogram = vec![0_u32; 256];
    // Some ten thousand samples settle the table to a few thousandths; an odd step visits all columns.
    let step = (count >> 13).max(1) | 1;
    for i in (0..count).step_by(step) {
        histogram[(sample(i) as usize).min(255)] += 1;
    }
    let taken: u32 = histogram.iter().sum();
    let mut at_most = 0;
    let mut cumulative = vec![0.0; 257];
    for (i, samples) in histogram.iter().enumerate() {
        at_most += samples;
        cumulative[i + 1] = at_most as f32 / taken as f32;
    }
    (0..ENTRIES).map(|i| cumulative[i * 256 / (ENTRIES - 1)]).collect()
}

/// Bilinear sample at a position whose whole numbers are texel middles.
fn bilinear(level: &ThresholdLevel, x: f32, y: f32) -> f32 {
    let mask = level.size as i32 - 1;
    let (left, top) = (floor(x), floor(y));
    let (fx, fy) = (x - left as f32, y - top as f32);
    let at = |dx: i32, dy: i32| {
        let (x, y) = ((left + dx) & mask, (top + dy) & mask);
        f32::from(level.threshold[(y * level.size as i32 + x) as usize])
    };
    (1.0 - fy) * ((1.0 - fx) * at(0, 0) + fx * at(1, 0)) + fy * ((1.0 - fx) * at(0, 1) + fx * at(1, 1))
}
