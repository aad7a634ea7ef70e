//! A plain line: exact area coverage by scanning along it.

use super::{Footprint, Nib, Part};
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
    let (along_stride, across_stride) = match stroke.axis {
        Axis::X => (1, size),
        Axis::Y => (size, 1),
    };
    let begin = stroke.start_uv * side;
    let length = stroke.along_uv * side;
    let end = begin + length;
    let t_per_px = 1.0 / length;

    let mut column = begin.floor();
    while column < end {
        let (from, to) = (column.max(begin), (column + 1.0).min(end));
        let filled = to - from;
        let t = (0.5 * (from + to) - begin) * t_per_px;
        let slope = stroke.slope_at(t);
        let (narrowed, lightened) = nib.pressed(part, t);
        let half = 0.5 * stroke.width_px * narrowed * (1.0 + slope * slope).sqrt();
        let middle = stroke.across_at(t) * side;
        let ink_of_area = 255.0 * nib.opacity * lightened * filled;

        out.begin_column();
        let along_offset = ((column as i32) & mask) as u32 * along_stride;
        let band = Band::new(middle - half, middle + half, slope.abs());
        let (first, last) = band.rows();
        for row in first..=last {
            let ink = (band.area(row as f32) * ink_of_area + 0.5) as u8;
            if ink > 0 {
                out.push(along_offset + (row & mask) as u32 * across_stride, ink);
            }
        }
        column += 1.0;
    }
}

/// The part of a stroke inside one scan column: between two parallel edges.
struct Band {
    low: f32,
    high: f32,
    slope: f32,
    per_slope: f32,
}

impl Band {
    fn new(low: f32, high: f32, slope: f32) -> Self {
        let slope = if slope < LEVEL_SLOPE { 0.0 } else { slope };
        Self { low, high, slope, per_slope: if slope > 0.0 { 1.0 / slope } else { 0.0 } }
    }

    /// First and last row that the band can touch.
    fn rows(&self) -> (i32, i32) {
        let reach = 0.5 * self.slope;
        ((self.low - reach).floor() as i32, (self.high + reach).ceil() as i32 - 1)
    }

    /// Area of the band within the texel `row ..= row + 1`.
    #[inline]
    fn area(&self, row: f32) -> f32 {
        self.below(self.high - row) - self.below(self.low - row)
    }

    /// Part of a texel below an edge that crosses the column's middle at height `x` over the texel's lower side: the mean
    /// of `clamp(x + slope · s, 0, 1)` over `s` in `-½ ..= ½`.
    #[inline]
    fn below(&self, x: f32) -> f32 {
        if self.slope == 0.0 {
            return x.clamp(0.0, 1.0);
        }
        let reach = 0.5 * self.slope;
        (antiderivative(x + reach) - antiderivative(x - reach)) * self.per_slope
    }
}

/// Integral of `clamp(x, 0, 1)` from below 0.
#[inline]
fn antiderivative(x: f32) -> f32 {
    let inside = x.clamp(0.0, 1.0);
    0.5 * inside * inside + (x - 1.0).max(0.0)
}
