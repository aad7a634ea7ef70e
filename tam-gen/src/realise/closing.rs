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
    /// `whole` is the footprint of the whole stroke, which would gain `gain` and leave the ink `most` at its texels; `shown`
    /// is what a lighter column showed of it; `piece` is scratch.
    pub(super) fn draw(
        &self,
        canvas: &mut Canvas,
        whole: &Footprint,
        most: &[u8],
        piece: &mut Footprint,
        (limit, gain): (u64, u64),
        shown: Option<&[u8]>,
    ) -> Vec<u8> {
        let before = canvas.sum();
        let opacity = self.nib.opacity;
        let mut gain_of = |part: Part| {
            self.nib.footprint_of_part(self.stroke, part, self.size, self.grain, piece);
            canvas.draw(piece, opacity, self.measure);
            let gain = canvas.sum() - before;
            canvas.undo(piece, before);
            gain
        };
        let in_steps = |step: usize| step as f32 / STEPS as f32;
        let end =
            in_steps(largest_within(limit, (STEPS, gain), |step| gain_of(Part { end: in_steps(step), strength: 1.0 })));
        let length_px = self.stroke.length_uv() * self.size as f32;
        let stub = if length_px > 0.0 { (STUB_WIDTHS * self.stroke.width_px / length_px).min(1.0) } else { 1.0 };
        let part = if end >= stub {
            Part { end, strength: 1.0 }
        } else {
            let stub_gain = gain_of(Part { end: stub, strength: 1.0 });
            let strength = if stub_gain <= limit {
                STEPS
            } else {
                largest_within(limit, (STEPS, stub_gain), |step| gain_of(Part { end: stub, strength: in_steps(step) }))
            };
            Part { end: stub, strength: in_steps(strength) }
        };
        self.nib.footprint_of_part(self.stroke, part, self.size, self.grain, piece);
        canvas.draw(piece, opacity, self.measure);
        let wanted = canvas.ink_under(whole);
        canvas.undo(piece, before);

        // What lighter columns showed comes first; then the piece, as far as the limit goes; then the rest texel by texel.
        if let Some(shown) = shown {
            for (texel, ink) in whole.texel.iter().zip(shown) {
                canvas.raise(*texel, *ink, self.measure);
            }
        }
        for aim in [&wanted[..], most] {
            for ((texel, aim), most) in whole.texel.iter().zip(aim).zip(most) {
                let room = (before + limit).saturating_sub(canvas.sum());
                if room == 0 {
                    break;
                }
                let ink = canvas.ink_at(*texel);
                let aim = (*aim).min(*most).max(ink);
                let weight = self.measure.weight(ink);
                let highest = (ink..=aim).rev().find(|ink| u64::from(self.measure.weight(*ink) - weight) <= room);
                canvas.raise(*texel, highest.unwrap_or(ink), self.measure);
            }
        }
        canvas.ink_under(whole)
    }
}

/// The largest step below `beyond` whose gain is within the limit, given that gains never fall; step 0 gains nothing.
///
/// `beyond` is a step and its gain, which is over the limit or the last. Gains rise almost evenly, so the next step to be
/// tried is where a straight line between those known meets the limit: three tries instead of the eight of halving.
fn largest_within(limit: u64, beyond: (usize, u64), mut gain_of: impl FnMut(usize) -> u64) -> usize {
    let (mut low, mut high) = ((0, 0), beyond);
    let mut turn = 0;
    while low.0 + 1 < high.0 {
        let between = high.0 - low.0;
        let rise = high.1.saturating_sub(low.1).max(1) as f64;
        // Where the line errs to one side again and again, halving ends it.
        let ahead = if turn % 3 == 2 { between / 2 } else { ((limit - low.1) as f64 / rise * between as f64) as usize };
        turn += 1;
        let step = low.0 + ahead.clamp(1, between - 1);
        let gain = gain_of(step);
        if gain <= limit { low = (step, gain) } else { high = (step, gain) }
    }
    low.0
}
