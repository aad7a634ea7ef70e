//! A plain line: exact area coverage by scanning along it.

use super::{Footprint, Nib, Part};
use crate::rounding::{ceil, floor};
use crate::stroke::{Axis, Stroke};

/// Slope under which an edge counts as level within one scan column; the coverage errs by at most an eighth of it.
const LEVEL_SLOPE: f32 = 0.02;

/// Adds the texels of a stroke to the footprint.
///
/// In each scan column the stroke is a band between two parallel slanted edges, whose area over each texel is exact.
/// Width and slope are taken at the column's middle.
pub(super) fn scan(nib: &Nib, stroke: &Stroke, part: Part, size: u32, out: &mut Footprint) {
    let side = size as f32;
    let mask = size as i32 - 1;
    let (along_shift, across_shift) = match stroke.axis {
        Axis::X => (0, size.ilog2()),
        Axis::Y => (size.ilog2(), 0),
    };
    let begin = stroke.start_uv * side;
    let length = stroke.along_uv * side;
    let end = begin + length;
    let t_per_px = 1.0 / length;

    for column in floor(begin)..ceil(end) {
        let (from, to) = ((column as f32).max(begin), ((column + 1) as f32).min(end));
        let filled = to - from;
        let t = (0.5 * (from + to) - begin) * t_per_px;
        let slope = stroke.slope_at(t);
        let (narrowed, lightened) = nib.pressed(part, t);
        let half = 0.5 * stroke.width_px * narrowed * (1.0 + slope * slope).sqrt();
        let middle = stroke.across_at(t) * side;
        let ink_of_area = 255.0 * nib.opacity * lightened * filled;

        out.begin_column();
        let along_offset = ((column & mask) as u32) << along_shift;
        let band = Band::new(middle - half, middle + half, slope.abs());
        let (first, last) = band.rows();
        let mut row = first;
        while row <= last {
            let texels =
                std::array::from_fn(|lane| along_offset + ((((row + lane as i32) & mask) as u32) << across_shift));
            let ink = band.areas(row as f32).map(|area| to_ink(area * ink_of_area));
            let lanes = (last - row + 1).min(LANES as i32) as usize;
            out.extend(&texels, &ink, lanes);
            row += LANES as i32;
        }
    }
}

/// Rows computed at once: one vector register, and most strokes fit into one go.
const LANES: usize = 4;

/// Rounds a number in `0 ..= 255`: its bits stand at the low end of the sum's. Three operations, where a checked conversion
/// takes a dozen.
#[inline]
fn to_ink(x: f32) -> u8 {
    (x + 8_388_608.0).to_bits() as u8
}

/// The part of a stroke inside one scan column: between two parallel edges.
struct Band {
    low: f32,
    high: f32,
    slope: f32,
}

impl Band {
    fn new(low: f32, high: f32, slope: f32) -> Self {
        Self { low, high, slope }
    }

    /// First and last row that the band can touch.
    fn rows(&self) -> (i32, i32) {
        let reach = 0.5 * self.slope;
        (floor(self.low - reach), ceil(self.high + reach) - 1)
    }

    /// Area of the band within the texels of consecutive rows.
    ///
    /// Below an edge that crosses the column's middle at height `x` over a texel's lower side lies the mean of
    /// `clamp(x + slope · s, 0, 1)` over `s` in `-½ ..= ½` of the texel.
    #[inline]
    fn areas(&self, row: f32) -> [f32; LANES] {
        let (high, low) = (self.high - row, self.low - row);
        if self.slope < LEVEL_SLOPE {
            return std::array::from_fn(|lane| {
                let lane = lane as f32;
                clamp_unit(high - lane) - clamp_unit(low - lane)
            });
        }
        let (reach, per_slope) = (0.5 * self.slope, 1.0 / self.slope);
        std::array::from_fn(|lane| {
            let (high, low) = (high - lane as f32, low - lane as f32);
            let below_high = antiderivative(high + reach) - antiderivative(high - reach);
            let below_low = antiderivative(low + reach) - antiderivative(low - reach);
            clamp_unit((below_high - below_low) * per_slope)
        })
    }
}

/// Integral of `clamp(x, 0, 1)` from below 0.
#[inline]
fn antiderivative(x: f32) -> f32 {
    let inside = clamp_unit(x);
    let beyond = x - inside;
    0.5 * inside * inside + if beyond > 0.0 { beyond } else { 0.0 }
}

/// `clamp(x, 0, 1)` without what the standard one does about NaN: two instructions for four lanes.
#[inline]
fn clamp_unit(x: f32) -> f32 {
    let x = if x > 0.0 { x } else { 0.0 };
    if x < 1.0 { x } else { 1.0 }
}
