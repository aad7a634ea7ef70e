//! A stroke: a curve on the unit torus.

use serde::{Deserialize, Serialize};

use crate::preset::StrokeOptions;
use crate::rounding::floor;

/// The axis of the tile along which a stroke is scanned: the one nearer to its direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Axis {
    /// Along a row of texels.
    X,
    /// Along a column of texels.
    Y,
}

/// One stroke of a family: where it lies and how wide it is. What it shares with its family (taper, opacity, tip) is in
/// the family's options.
///
/// The curve runs over `t` in `0 ..= 1`: along the scan axis at `start_uv + t * along_uv`, across it at
/// `across_uv[0] + across_uv[1] t + across_uv[2] t² + across_uv[3] t³`, both modulo 1. Sizes of levels are powers of
/// two, so going from uv to texels loses nothing.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Stroke {
    /// Index of its family in [`crate::StrokeList::families`].
    pub family: u16,
    /// The axis along which it is scanned.
    pub axis: Axis,
    /// Where it begins along the axis, `0.0 .. 1.0`.
    pub start_uv: f32,
    /// How far it runs along the axis, `0.0 ..= 1.0`; 0 is a dot.
    pub along_uv: f32,
    /// Its offset across the axis as a cubic in `t`.
    pub across_uv: [f32; 4],
    /// Width where the pressure is full, in texels of every level.
    pub width_px: f32,
}

impl Stroke {
    /// Offset across the scan axis at `t`, in uv, not wrapped.
    #[inline]
    pub fn across_at(&self, t: f32) -> f32 {
        let [c0, c1, c2, c3] = self.across_uv;
        c0 + t * (c1 + t * (c2 + t * c3))
    }

    /// Slope of the curve at `t`: change across per change along. 0 for a dot.
    #[inline]
    pub fn slope_at(&self, t: f32) -> f32 {
        if self.along_uv == 0.0 {
            return 0.0;
        }
        let [_, c1, c2, c3] = self.across_uv;
        (c1 + t * (2.0 * c2 + t * 3.0 * c3)) / self.along_uv
    }

    /// The point at `t` as `(u, v)`, wrapped into `0.0 .. 1.0`.
    pub fn point_uv(&self, t: f32) -> (f32, f32) {
        let along = wrap_unit(self.start_uv + t * self.along_uv);
        let across = wrap_unit(self.across_at(t));
        match self.axis {
            Axis::X => (along, across),
            Axis::Y => (across, along),
        }
    }

    /// Length of the curve in tiles, within a thousandth of itself.
    pub fn length_uv(&self) -> f32 {
        const PARTS: u16 = 16;
        (0..PARTS)
            .map(|part| {
                let slope = self.slope_at((f32::from(part) + 0.5) / f32::from(PARTS));
                self.along_uv * (1.0 + slope * slope).sqrt() / f32::from(PARTS)
            })
            .sum()
    }
}

/// How the pressure rises and falls along the strokes of a family.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Taper {
    /// Part of the stroke over which the pressure falls, `0.0 ..= 1.0`.
    pub fall: f32,
    /// One over the part over which it rises; infinite where it does not.
    per_rise: f32,
    per_fall: f32,
}

impl Taper {
    /// Full pressure throughout.
    pub const NONE: Taper = Taper { fall: 0.0, per_rise: f32::INFINITY, per_fall: f32::INFINITY };

    /// The taper of a family; `reversed` families run against their scan axis, so that their ends change places.
    pub fn new(options: &StrokeOptions, reversed: bool) -> Self {
        let (mut rise, mut fall) = (options.taper_in as f32, options.taper_out as f32);
        if reversed {
            std::mem::swap(&mut rise, &mut fall);
        }
        Self { fall, per_rise: 1.0 / rise, per_fall: 1.0 / fall }
    }

    /// Pressure at `t` of the stroke, `0.0 ..= 1.0`: a parabola over each end, as a pen lands and lifts.
    #[inline]
    pub fn pressure(self, t: f32) -> f32 {
        // Where there is no taper the ratio is infinite, or at the very end of the stroke NaN; both count as full pressure.
        let (in_rise, in_fall) = (t * self.per_rise, (1.0 - t) * self.per_fall);
        let least = if in_rise < in_fall { in_rise } else { in_fall };
        if least < 1.0 { least * (2.0 - least) } else { 1.0 }
    }
}

/// The part of a number above its floor, `0.0 .. 1.0`.
#[inline]
pub fn wrap_unit(x: f32) -> f32 {
    let fraction = x - floor(x) as f32;
    // A tiny negative number rounds up to 1.
    if fraction >= 1.0 { 0.0 } else { fraction }
}
