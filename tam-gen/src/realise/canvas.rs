//! The image of one level while strokes go over it, with its exact tone and one step of undo.

use crate::preset::ToneMeasure;
use crate::raster::Footprint;

/// Cover from which on a texel counts as inked in the stroke map.
pub(crate) const HALF: u8 = 128;

/// What strokes have left at a texel: ink, and cover, the ink that the same strokes at full opacity would have left. Side
/// by side, since every stroke changes both.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Texel(u16);

impl Texel {
    #[inline]
    fn new(ink: u8, cover: u8) -> Self {
        Self(u16::from(cover) << 8 | u16::from(ink))
    }

    /// This texel after a stroke of the given ink, which `to_full`, in 256ths, takes to full opacity.
    #[inline]
    fn over(self, above: u8, to_full: u16) -> Self {
        let above = u16::from(above);
        let full = ((u32::from(above << 8) * u32::from(to_full)) >> 16) as u16;
        Self(over(self.0 >> 8, if full < 255 { full } else { 255 }) << 8 | over(self.0 & 255, above))
    }

    #[inline]
    pub(crate) fn ink(self) -> u8 {
        self.0 as u8
    }

    #[inline]
    fn cover(self) -> u8 {
        (self.0 >> 8) as u8
    }
}

/// [`over`](crate::raster::over) in numbers that the compiler can keep side by side.
#[inline]
fn over(below: u16, above: u16) -> u16 {
    let product = (255 - below) * above + 128;
    below + ((product + (product >> 8)) >> 8)
}

/// Texels of a stroke that are read, drawn over and written together.
const AT_ONCE: usize = 256;

/// The texels of one level, and the sum of the weights of their ink.
#[derive(Debug, Clone, Default)]
pub(crate) struct Canvas {
    texels: Vec<Texel>,
    sum: u64,
    /// What was under the last stroke drawn, texel by texel of its footprint.
    under: Vec<Texel>,
    /// The texels that the last stroke drawn has covered by half; the first `fresh_count` of them.
    fresh: Vec<u32>,
    fresh_count: usize,
}

impl Canvas {
    /// White paper of the given side.
    pub(crate) fn reset(&mut self, size: u32) {
        self.texels.clear();
        self.texels.resize(size as usize * size as usize, Texel::default());
        self.sum = 0;
    }

    /// Ink by rows, into the buffer of an older image.
    pub(crate) fn copy_ink_to(&self, ink: &mut Vec<u8>) {
        ink.resize(self.texels.len(), 0);
        for (ink, texel) in ink.iter_mut().zip(&self.texels) {
            *ink = texel.ink();
        }
    }

    /// Sum of the weights of all texels: `SOLID` times texels times tone.
    pub(crate) fn sum(&self) -> u64 {
        self.sum
    }

    /// Draws a stroke whose ink has the given opacity over the image, and remembers what was under it.
    pub(crate) fn draw(&mut self, footprint: &Footprint, opacity: f32, measure: &ToneMeasure) {
        let to_full = (256.0 / opacity + 0.5) as u16;
        self.under.resize(footprint.len(), Texel::default());
        if self.fresh.len() < footprint.len() {
            self.fresh.resize(footprint.len(), 0);
        }
        self.fresh_count = 0;
        let inks = footprint.ink.chunks(AT_ONCE);
        for ((places, inks), under) in footprint.texel.chunks(AT_ONCE).zip(inks).zip(self.under.chunks_mut(AT_ONCE)) {
            for (under, place) in under.iter_mut().zip(places) {
                *under = self.texels[*place as usize];
            }
            let mut drawn = [Texel::default(); AT_ONCE];
            for ((drawn, under), ink) in drawn.iter_mut().zip(under.iter()).zip(inks) {
                *drawn = under.over(*ink, to_full);
            }
            self.sum += measure.gain(under.iter().map(|texel| texel.ink()).zip(drawn.iter().map(|texel| texel.ink())));
            let mut fresh = self.fresh_count;
            for (((place, under), drawn), ink) in places.iter().zip(under).zip(drawn).zip(inks) {
                let slot = &mut self.texels[*place as usize];
                let mut drawn = drawn;
                if *slot != *under {
                    // The stroke has met itself here: it goes over what it left.
                    self.sum -= u64::from(measure.weight(drawn.ink()) - measure.weight(under.ink()));
                    *under = *slot;
                    drawn = under.over(*ink, to_full);
                    self.sum += u64::from(measure.weight(drawn.ink()) - measure.weight(under.ink()));
                }
                *slot = drawn;
                // Whether a texel is fresh is as good as chance, so nothing branches on it: each is noted, and kept if it is.
                self.fresh[fresh] = *place;
                fresh += usize::from((drawn.0 & !under.0) >> 15);
            }
            self.fresh_count = fresh;
        }
    }

    /// Takes the stroke drawn last away again; `sum` is what the sum was before.
    pub(crate) fn undo(&mut self, footprint: &Footprint, sum: u64) {
        let under = std::mem::take(&mut self.under);
        self.restore(footprint, &under, sum);
        self.under = under;
    }

    /// Puts back what was under a stroke.
    pub(crate) fn restore(&mut self, footprint: &Footprint, under: &[Texel], sum: u64) {
        // Backwards: where a stroke meets itself, what was there first was noted first.
        for (texel, below) in footprint.texel.iter().zip(under).rev() {
            self.texels[*texel as usize] = *below;
        }
        self.sum = sum;
    }

    /// What was under the stroke drawn last, texel by texel of its footprint.
    pub(crate) fn under(&self) -> &[Texel] {
        &self.under
    }

    /// The texels that the stroke drawn last has covered by half.
    pub(crate) fn fresh(&self) -> &[u32] {
        &self.fresh[..self.fresh_count]
    }

    /// Ink at a texel.
    pub(crate) fn ink_at(&self, texel: u32) -> u8 {
        self.texels[texel as usize].ink()
    }

    /// Ink at the texels of a footprint.
    pub(crate) fn ink_under(&self, footprint: &Footprint) -> Vec<u8> {
        footprint.texel.iter().map(|texel| self.ink_at(*texel)).collect()
    }

    /// Cover at a texel.
    pub(crate) fn cover_at(&self, texel: u32) -> u8 {
        self.texels[texel as usize].cover()
    }

    /// The texels that are not covered by half.
    pub(crate) fn open(&self) -> Vec<u32> {
        (0..).zip(&self.texels).filter(|(_, texel)| texel.cover() < HALF).map(|(texel, _)| texel).collect()
    }

    /// Counts a texel as covered.
    pub(crate) fn cover(&mut self, texel: u32) {
        let slot = &mut self.texels[texel as usize];
        *slot = Texel::new(slot.ink(), HALF);
    }

    /// Raises the ink of a texel.
    pub(crate) fn raise(&mut self, texel: u32, ink: u8, measure: &ToneMeasure) {
        let slot = &mut self.texels[texel as usize];
        if ink > slot.ink() {
            self.sum += u64::from(measure.weight(ink) - measure.weight(slot.ink()));
            *slot = Texel::new(ink, slot.cover());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::preset::MeasureName;

    /// Strokes that meet themselves within a few texels and further on, on a level that they fill.
    #[test]
    fn a_stroke_goes_over_its_texels_one_by_one_and_is_taken_away_again() {
        let (size, opacity) = (16, 0.4);
        let mut state = 1_u32;
        let mut random = |below: u32| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) % below
        };
        for name in [MeasureName::MeanCoverage, MeasureName::NonPaper] {
            let measure = ToneMeasure::named(name);
            let (mut canvas, mut ink, mut cover) = (Canvas::default(), vec![0_u8; 256], vec![0_u8; 256]);
            canvas.reset(size);
            for stroke in 0..40 {
                let mut footprint = Footprint::default();
                let spread = if stroke % 2 == 0 { 256 } else { 5 };
                for _ in 0..random(700) {
                    footprint.texel.push(random(spread));
                    footprint.ink.push(random(103) as u8);
                }
                let before: Vec<u8> = canvas.ink_under(&footprint);
                let sum = canvas.sum();
                canvas.draw(&footprint, opacity, &measure);
                canvas.undo(&footprint, sum);
                assert_eq!((canvas.ink_under(&footprint), canvas.sum()), (before, sum));

                canvas.draw(&footprint, opacity, &measure);
                let mut fresh = Vec::new();
                for (texel, above) in footprint.iter() {
                    ink[texel] = crate::raster::over(ink[texel], above);
                    let open = cover[texel] < HALF;
                    let full = (u32::from(above) * (256.0 / opacity + 0.5) as u32) >> 8;
                    cover[texel] = crate::raster::over(cover[texel], full.min(255) as u8);
                    if open && cover[texel] >= HALF {
                        fresh.push(texel as u32);
                    }
                }
                let mut drawn = Vec::new();
                canvas.copy_ink_to(&mut drawn);
                assert_eq!(drawn, ink);
                assert_eq!(canvas.fresh(), fresh);
                let weights: u64 = ink.iter().map(|ink| u64::from(measure.weight(*ink))).sum();
                assert_eq!(canvas.sum(), weights);
            }
        }
    }
}
