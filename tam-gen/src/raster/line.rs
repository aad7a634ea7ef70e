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
    let (begin, end) = (stroke.start_uv * side, (stroke.start_uv + stroke.along_uv) * side);
    // Beyond the end of a part there is no ink; a column more, lest rounding matters.
    let last_column = ceil(end).min(ceil(begin + part.end * (end - begin)) + 1);

    let mut first_column = floor(begin);
    while first_column < last_column {
        let bands = Bands::new(nib, stroke, part, side, (begin, end), first_column as f32);
        for lane in 0..COLUMNS.min((last_column - first_column) as usize) {
            let along_offset = (((first_column + lane as i32) & mask) as u32) << along_shift;
            let band = bands.band(lane);
            let last = ceil(band.high + band.reach) - 1;
            let mut row = floor(band.low - band.reach);
            while row <= last {
                let texels =
                    std::array::from_fn(|lane| along_offset + ((((row + lane as i32) & mask) as u32) << across_shift));
                let ink = band.areas(row as f32).map(|area| to_ink(area * bands.ink_of_area[lane]));
                out.extend(&texels, &ink, (last - row + 1).min(LANES as i32) as usize);
                row += LANES as i32;
            }
        }
        first_column += COLUMNS as i32;
    }
}

/// Scan columns prepared at once, for whole vector registers.
const COLUMNS: usize = 8;

/// Where the stroke's edges cross consecutive scan columns.
struct Bands {
    low: [f32; COLUMNS],
    high: [f32; COLUMNS],
    slope: [f32; COLUMNS],
    per_slope: [f32; COLUMNS],
    /// Ink of a texel that lies inside the stroke.
    ink_of_area: [f32; COLUMNS],
}

impl Bands {
    /// The columns from `first` on of the stroke that runs from `begin` to `end`, in texels. Those beyond it hold nothing of
    /// use. Without branches, so that the compiler takes several columns at a time.
    #[inline]
    fn new(nib: &Nib, stroke: &Stroke, part: Part, side: f32, (begin, end): (f32, f32), first: f32) -> Self {
        let mut bands = Self {
            low: [0.0; COLUMNS],
            high: [0.0; COLUMNS],
            slope: [0.0; COLUMNS],
            per_slope: [0.0; COLUMNS],
            ink_of_area: [0.0; COLUMNS],
        };
        let t_per_px = 1.0 / (end - begin);
        let per_along = 1.0 / stroke.along_uv;
        let [c0, c1, c2, c3] = stroke.across_uv;
        let ink = 255.0 * nib.opacity;
        for lane in 0..COLUMNS {
            let column = first + lane as f32;
            let from = if column > begin { column } else { begin };
            let to = if column + 1.0 < end { column + 1.0 } else { end };
            let t = (0.5 * (from + to) - begin) * t_per_px;
            let slope = (c1 + t * (2.0 * c2 + t * 3.0 * c3)) * per_along;
            let (narrowed, lightened) = nib.pressed(part, t);
            let half = 0.5 * stroke.width_px * narrowed * (1.0 + slope * slope).sqrt();
            let middle = (c0 + t * (c1 + t * (c2 + t * c3))) * side;
            let slope = if slope < 0.0 { -slope } else { slope };
            bands.low[lane] = middle - half;
            bands.high[lane] = middle + half;
            bands.slope[lane] = slope;
            bands.per_slope[lane] = 1.0 / slope;
            bands.ink_of_area[lane] = ink * lightened * (to - from);
        }
        bands
    }

    #[inline]
    fn band(&self, lane: usize) -> Band {
        Band {
            low: self.low[lane],
            high: self.high[lane],
            reach: 0.5 * self.slope[lane],
            per_slope: self.per_slope[lane],
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
    /// How far the edges rise or fall from the column's middle to its sides: half their slope.
    reach: f32,
    per_slope: f32,
}

impl Band {
    /// Area of the band within the texels of consecutive rows.
    ///
    /// Below an edge that crosses the column's middle at height `x` over a texel's lower side lies the mean of
    /// `clamp(x + slope · s, 0, 1)` over `s` in `-½ ..= ½` of the texel.
    #[inline]
    fn areas(&self, row: f32) -> [f32; LANES] {
        let (high, low) = (self.high - row, self.low - row);
        if self.reach < 0.5 * LEVEL_SLOPE {
            return std::array::from_fn(|lane| {
                let lane = lane as f32;
                clamp_unit(high - lane) - clamp_unit(low - lane)
            });
        }
        let (reach, per_slope) = (self.reach, self.per_slope);
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
