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

use crate::preset::StrokeOptions;
use crate::stroke::Stroke;

/// What draws the strokes of one family: the options they share, ready for the inner loops.
#[derive(Debug, Clone)]
pub struct Nib {
    /// Part of the stroke over which the pressure rises.
    pub taper_in: f32,
    /// Part of the stroke over which the pressure falls.
    pub taper_out: f32,
    /// 0: pressure narrows the stroke, 1: pressure lightens it.
    pub taper_fade: f32,
    /// Ink of a fully covered texel, `0.0 ..= 1.0`.
    pub opacity: f32,
    /// What is stamped along the stroke in place of a plain line.
    pub tip: Option<TipMask>,
    /// Distance between stamps in stroke widths.
    pub tip_spacing: f32,
}

impl Nib {
    /// The nib of a family. `reversed` families run against their scan axis, so that their tapers change places.
    ///
    /// # Errors
    /// When the tip's path or picture cannot be read.
    pub fn new(stroke: &StrokeOptions, reversed: bool) -> Result<Self, TipError> {
        let (mut taper_in, mut taper_out) = (stroke.taper_in as f32, stroke.taper_out as f32);
        if reversed {
            std::mem::swap(&mut taper_in, &mut taper_out);
        }
        Ok(Self {
            taper_in,
            taper_out,
            taper_fade: stroke.taper_fade as f32,
            opacity: stroke.opacity as f32,
            tip: stroke.tip.as_ref().map(TipMask::new).transpose()?,
            tip_spacing: stroke.tip.as_ref().map_or(1.0, |tip| tip.spacing as f32),
        })
    }

    /// Pressure at `t` of the stroke, `0.0 ..= 1.0`: a parabola over each taper, as a pen lands and lifts.
    #[inline]
    pub fn pressure(&self, t: f32) -> f32 {
        let ease = |part: f32, taper: f32| if part < taper { (part / taper) * (2.0 - part / taper) } else { 1.0 };
        ease(t, self.taper_in).min(ease(1.0 - t, self.taper_out))
    }

    /// The ink that the stroke lays on an empty level, texel by texel, in order along its scan axis.
    ///
    /// `size` is the side of the level, a power of two. Everything wraps around the tile's edges. The same bytes come out
    /// on every machine: only IEEE-exact operations are used.
    pub fn footprint(&self, stroke: &Stroke, size: u32, grain: &Grain, out: &mut Footprint) {
        out.clear();
        match &self.tip {
            Some(tip) => tip::stamp(self, tip, stroke, size, out),
            None if stroke.along_uv == 0.0 => dab::disc(self, stroke, size, out),
            None => line::scan(self, stroke, size, out),
        }
        grain.withhold(out);
    }
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
