//! Closing a cell: the part of the next stroke that makes its tone exact.
//!
//! The stroke is drawn from its start up to where it must run out, tapering like any other; where that would be a stub, a
//! short piece is drawn lighter. What is left of the tone, less than one scan column of ink, goes into its texels one by
//! one. No texel ever gets more than the whole stroke gives it, nor less than a lighter column showed of it, so cells stay
//! nested.

use super::Canvas;
use crate::preset::ToneMeasure;
use crate::raster::{Footprint, Grain, Nib, Part};
use crate::stroke::Stroke;

/// Shortest piece that is drawn at full strength, in widths of the stroke; anything shorter looks like a speck.
const STUB_WIDTHS: f32 = 4.0;
/// Steps in which ends and strengths are tried; what is left goes in texel by texel.
const STEPS: usize = 256;

/// A stroke that is to be drawn in part.
pub(super) struct Closing<'a> {
    pub(super) stroke: &'a Stroke,
    pub(super) nib: &'a Nib,
    pub(super) grain: &'a Grain,
    pub(super) size: u32,
    pub(super) measure: &'a ToneMeasure,
}

impl Closing<'_> {
    /// Draws the part of the stroke that gains at most `limit`, and as nearly as its texels allow. Returns the ink of the
    /// whole footprint's texels afterwards.
    ///
    /// `whole` is the footprint of the whole stroke; `shown` is what a lighter column showed of it; `piece` is scratch.
    pub(super) fn draw(
        &self,
        canvas: &mut Canvas,
        whole: &Footprint,
        piece: &mut Footprint,
        limit: u64,
        shown: Option<&[u8]>,
    ) -> Vec<u8> {
        let before = canvas.sum();
        let most = self.ink_of(canvas, whole, whole);

        let mut fits = |part: Part| {
            self.nib.footprint_of_part(self.stroke, part, self.size, self.grain, piece);
            canvas.draw(piece, self.measure);
            let gain = canvas.sum() - before;
            canvas.undo(piece, before);
            gain <= limit
        };
        let in_steps = |step: usize| step as f32 / STEPS as f32;
        let end = in_steps(largest(STEPS - 1, |step| fits(Part { end: in_steps(step), strength: 1.0 })));
        let length_px = self.stroke.length_uv() * self.size as f32;
        let stub = if length_px > 0.0 { (STUB_WIDTHS * self.stroke.width_px / length_px).min(1.0) } else { 1.0 };
        let part = if end >= stub {
            Part { end, strength: 1.0 }
        } else {
            let strength = largest(STEPS, |step| fits(Part { end: stub, strength: in_steps(step) }));
            Part { end: stub, strength: in_steps(strength) }
        };
        self.nib.footprint_of_part(self.stroke, part, self.size, self.grain, piece);
        let wanted = self.ink_of(canvas, piece, whole);

        // What lighter columns showed comes first; then the piece, as far as the limit goes; then the rest texel by texel.
        if let Some(shown) = shown {
            for (texel, ink) in whole.texel.iter().zip(shown) {
                canvas.raise(*texel, *ink, self.measure);
            }
        }
        for aim in [&wanted, &most] {
            for ((texel, aim), most) in whole.texel.iter().zip(aim).zip(&most) {
                let room = (before + limit).saturating_sub(canvas.sum());
                if room == 0 {
                    break;
                }
                let ink = canvas.at(*texel);
                let weight = self.measure.weight(ink);
                let more = largest(usize::from((*aim).min(*most).saturating_sub(ink)), |more| {
                    u64::from(self.measure.weight(ink + more as u8) - weight) <= room
                });
                canvas.raise(*texel, ink + more as u8, self.measure);
            }
        }
        whole.texel.iter().map(|texel| canvas.at(*texel)).collect()
    }

    /// Ink of the texels of a footprint once another is drawn. Leaves the canvas as it was.
    fn ink_of(&self, canvas: &mut Canvas, drawn: &Footprint, of: &Footprint) -> Vec<u8> {
        let before = canvas.sum();
        canvas.draw(drawn, self.measure);
        let ink = of.texel.iter().map(|texel| canvas.at(*texel)).collect();
        canvas.undo(drawn, before);
        ink
    }
}

/// The largest number in `0 ..= most` that fits, given that smaller ones fit if a larger one does; 0 is taken to fit.
fn largest(most: usize, mut fits: impl FnMut(usize) -> bool) -> usize {
    let (mut low, mut high) = (0, most);
    while low < high {
        let middle = low + (high - low).div_ceil(2);
        if fits(middle) { low = middle } else { high = middle - 1 }
    }
    low
}
