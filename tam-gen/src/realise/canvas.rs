//! The image of one level while strokes go over it, with its exact tone and one step of undo.

use crate::preset::ToneMeasure;
use crate::raster::{Footprint, over};

/// Ink of one level, and the sum of its weights.
#[derive(Debug, Clone, Default)]
pub(crate) struct Canvas {
    ink: Vec<u8>,
    sum: u64,
    /// Ink under the last stroke drawn, texel by texel of its footprint.
    under: Vec<u8>,
}

impl Canvas {
    /// White paper of the given side.
    pub(crate) fn reset(&mut self, size: u32) {
        self.ink.clear();
        self.ink.resize(size as usize * size as usize, 0);
        self.sum = 0;
    }

    /// Ink by rows.
    pub(crate) fn ink(&self) -> &[u8] {
        &self.ink
    }

    /// Sum of the weights of all texels: `SOLID` times texels times tone.
    pub(crate) fn sum(&self) -> u64 {
        self.sum
    }

    /// Draws a stroke over the image and remembers what was under it.
    pub(crate) fn draw(&mut self, footprint: &Footprint, measure: &ToneMeasure) {
        self.under.resize(footprint.len(), 0);
        let mut gain = 0_u64;
        for ((texel, above), under) in footprint.iter().zip(&mut self.under) {
            let ink = &mut self.ink[texel];
            *under = *ink;
            *ink = over(*under, above);
            gain += u64::from(measure.weight(*ink) - measure.weight(*under));
        }
        self.sum += gain;
    }

    /// Takes the stroke drawn last away again; `sum` is what the sum was before.
    pub(crate) fn undo(&mut self, footprint: &Footprint, sum: u64) {
        let under = std::mem::take(&mut self.under);
        self.restore(footprint, &under, sum);
        self.under = under;
    }

    /// Puts back the ink that was under a stroke.
    pub(crate) fn restore(&mut self, footprint: &Footprint, under: &[u8], sum: u64) {
        // Backwards: where a stroke meets itself, what was there first was noted first.
        for (texel, below) in footprint.texel.iter().zip(under).rev() {
            self.ink[*texel as usize] = *below;
        }
        self.sum = sum;
    }

    /// Ink under the stroke drawn last.
    pub(crate) fn under(&self) -> &[u8] {
        &self.under
    }

    /// Ink at a texel.
    pub(crate) fn at(&self, texel: u32) -> u8 {
        self.ink[texel as usize]
    }

    /// Raises the ink of a texel.
    pub(crate) fn raise(&mut self, texel: u32, ink: u8, measure: &ToneMeasure) {
        let slot = &mut self.ink[texel as usize];
        if ink > *slot {
            self.sum += u64::from(measure.weight(ink) - measure.weight(*slot));
            *slot = ink;
        }
    }
}
