//! From a stroke to the texels it inks.
//!
//! Strokes are thin and many, so this is the hot path of a generation: a scan along the axis nearer to the stroke,
//! with exact area coverage across it. tiny-skia, ten times slower here, is the reference it is tested against, and
//! draws everything else.

mod dab;
mod footprint;
mod grain;
mod line;
#[cfg(test)]
mod reference;
mod tip;

pub use footprint::Footprint;
pub use grain::Grain;
pub use tip::{TipError, TipMask};

use crate::map::Family;
use crate::stroke::{Stroke, Taper};

/// What draws the strokes of one family: the options they share, ready for the inner loops.
#[derive(Debug, Clone)]
pub struct Nib {
    /// How the pressure rises and falls.
    pub taper: Taper,
    /// 0: pressure narrows the stroke, 1: pressure lightens it.
    pub taper_fade: f32,
    /// Ink of a fully covered texel, `0.0 ..= 1.0`.
    pub opacity: f32,
    /// What is stamped along the stroke in place of a plain line.
    pub tip: Option<TipMask>,
    /// Distance between stamps in lengths of the tip.
    pub tip_spacing: f32,
}

impl Nib {
    /// The nib of a family.
    ///
    /// # Errors
    /// When the tip's path or picture cannot be read.
    pub fn new(family: &Family) -> Result<Self, TipError> {
        let stroke = &family.stroke;
        Ok(Self {
            taper: family.taper(),
            taper_fade: stroke.taper_fade as f32,
            opacity: stroke.opacity as f32,
            tip: stroke.tip.as_ref().map(TipMask::new).transpose()?,
            tip_spacing: stroke.tip.as_ref().map_or(1.0, |tip| tip.spacing as f32),
        })
    }

    /// The ink that the stroke lays on an empty level, texel by texel, in order along its scan axis.
    ///
    /// `size` is the side of the level, a power of two. Everything wraps around the tile's edges. The same bytes come out
    /// on every machine: only IEEE-exact operations are used.
    pub fn footprint(&self, stroke: &Stroke, size: u32, grain: &Grain, out: &mut Footprint) {
        self.footprint_of_part(stroke, Part::WHOLE, size, grain, out);
    }

    /// The ink of a part of the stroke; at no texel more than the whole stroke's, rounding aside.
    pub fn footprint_of_part(&self, stroke: &Stroke, part: Part, size: u32, grain: &Grain, out: &mut Footprint) {
        out.clear();
        match &self.tip {
            Some(tip) => tip::stamp(self, tip, stroke, part, size, out),
            None if stroke.along_uv == 0.0 => dab::disc(self, stroke, part, size, out),
            None => line::scan(self, stroke, part, size, out),
        }
        grain.withhold(out);
    }

    /// How pressure shows at `t` of a part of a stroke: the share of the width, and the share of the ink on it. Their
    /// product is the pressure.
    #[inline]
    fn pressed(&self, part: Part, t: f32) -> (f32, f32) {
        let mut pressure = self.taper.pressure(t);
        if part.end < 1.0 {
            let falling = (part.end - t) / part.end.min(PART_FALL.max(self.taper.fall));
            let falling = if falling > 0.0 { falling } else { 0.0 };
            let falling = if falling < 1.0 { falling } else { 1.0 };
            let end_pressure = falling * (2.0 - falling);
            pressure = if end_pressure < pressure { end_pressure } else { pressure };
        }
        let width = pressure + (1.0 - pressure) * self.taper_fade;
        // No pressure leaves no width only where it does not fade, and then no ink either.
        let lightened = pressure / if width > 0.0 { width } else { 1.0 };
        (width, lightened * part.strength)
    }
}

/// Least part of a stroke over which a piece of it runs out.
const PART_FALL: f32 = 0.15;

/// A piece of a stroke, from its start, drawn at some strength.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Part {
    /// Where the piece has run out, as `t` of the stroke, `0.0 ..= 1.0`.
    pub end: f32,
    /// Share of the ink it lays down, `0.0 ..= 1.0`.
    pub strength: f32,
}

impl Part {
    /// All of a stroke.
    pub const WHOLE: Part = Part { end: 1.0, strength: 1.0 };
}

/// Ink of a texel after more ink comes over it: both in `0 ..= 255`, rounded to nearest. Never less than either.
#[inline]
pub fn over(below: u8, above: u8) -> u8 {
    let product = u32::from(255 - below) * u32::from(above) + 128;
    below + ((product + (product >> 8)) >> 8) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn over_is_the_rounded_exact_formula_everywhere() {
        for below in 0..=255_u8 {
            for above in 0..=255_u8 {
                let exact = 255.0 - (255.0 - f64::from(below)) * (255.0 - f64::from(above)) / 255.0;
                assert!((f64::from(over(below, above)) - exact).abs() <= 0.5 + 1e-9, "{below} over {above}");
                assert!(over(below, above) >= below);
            }
        }
    }
}
