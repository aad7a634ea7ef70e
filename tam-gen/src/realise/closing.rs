//! Closing a cell: the part of the next stroke that makes its tone exact.
//!
//! The stroke is drawn from its start up to a cut, with a short fading end; where that would be a stub, a longer piece is
//! drawn lighter. What is left of the tone, less than one scan column of ink, goes into the texels at the cut one by one.
//! No texel ever gets more than the whole stroke gives it, nor less than a lighter column showed of it, so cells stay
//! nested.

use super::Canvas;
use crate::preset::ToneMeasure;
use crate::raster::Footprint;

/// Length of the fading end, in scan columns.
const FADE: usize = 4;
/// Shortest piece that is drawn at full strength, in scan columns; anything shorter looks like a speck.
const STUB: usize = 8;

/// Draws the part of a stroke that gains at most `limit` and as nearly as its texels allow, and returns the ink of the
/// footprint's texels afterwards.
///
/// The stroke must be the one drawn last and already undone. `shown` is what a lighter column showed of the same stroke.
pub(super) fn close(
    canvas: &mut Canvas,
    footprint: &Footprint,
    measure: &ToneMeasure,
    limit: u64,
    shown: Option<Vec<u8>>,
) -> Vec<u8> {
    let before = canvas.sum();
    let under = canvas.under().to_vec();
    let whole = ink_of_whole(canvas, footprint, measure, before);
    let least = shown.unwrap_or_else(|| under.clone());
    let piece = Piece { footprint, measure, under: &under, whole: &whole, least: &least };

    // Where to cut, or how light a stub to draw.
    let columns = footprint.column_start.len();
    let cut = largest(columns + FADE, |cut| piece.gain(|column| fade(cut, column)) <= limit);
    let stub = STUB.min(columns);
    let strength: Box<dyn Fn(usize) -> u32> = if cut >= stub {
        Box::new(move |column| fade(cut, column))
    } else {
        let light = largest(256, |light| piece.gain(|column| fade(stub, column) * light as u32 / 256) <= limit);
        Box::new(move |column| fade(stub, column) * light as u32 / 256)
    };
    piece.for_each(&strength, |i, ink| canvas.raise(footprint.texel[i], ink, measure));
    if canvas.sum() - before > limit {
        // A stroke that crosses itself gains more than the sum of its columns: fall back to texels one by one.
        canvas.undo(footprint, before);
        for (texel, ink) in footprint.texel.iter().zip(&least) {
            canvas.raise(*texel, *ink, measure);
        }
    }

    // The rest, texel by texel along the stroke.
    for (texel, whole) in footprint.texel.iter().zip(&whole) {
        let room = (before + limit).saturating_sub(canvas.sum());
        if room == 0 {
            break;
        }
        let ink = canvas.at(*texel);
        let weight = measure.weight(ink);
        let more = largest(usize::from(whole.saturating_sub(ink)), |more| {
            u64::from(measure.weight(ink + more as u8) - weight) <= room
        });
        canvas.raise(*texel, ink + more as u8, measure);
    }
    footprint.texel.iter().map(|texel| canvas.at(*texel)).collect()
}

/// Ink of each texel of the footprint once the whole stroke is drawn. Leaves the canvas as it was.
fn ink_of_whole(canvas: &mut Canvas, footprint: &Footprint, measure: &ToneMeasure, before: u64) -> Vec<u8> {
    canvas.draw(footprint, measure);
    let whole = footprint.texel.iter().map(|texel| canvas.at(*texel)).collect();
    canvas.undo(footprint, before);
    whole
}

/// Strength of a scan column, of 256, when the stroke is cut at `cut`.
fn fade(cut: usize, column: usize) -> u32 {
    (256 * cut.saturating_sub(column) / FADE).min(256) as u32
}

/// The largest number in `0 ..= most` that fits, given that smaller ones fit if a larger one does; 0 is taken to fit.
fn largest(most: usize, fits: impl Fn(usize) -> bool) -> usize {
    let (mut low, mut high) = (0, most);
    while low < high {
        let middle = low + (high - low).div_ceil(2);
        if fits(middle) { low = middle } else { high = middle - 1 }
    }
    low
}

struct Piece<'a> {
    footprint: &'a Footprint,
    measure: &'a ToneMeasure,
    under: &'a [u8],
    whole: &'a [u8],
    least: &'a [u8],
}

impl Piece<'_> {
    /// Visits each texel with its ink when columns have the given strengths.
    fn for_each(&self, strength: impl Fn(usize) -> u32, mut visit: impl FnMut(usize, u8)) {
        let starts = &self.footprint.column_start;
        for (column, &start) in starts.iter().enumerate() {
            let end = starts.get(column + 1).map_or(self.footprint.len(), |end| *end as usize);
            let strength = strength(column);
            for i in start as usize..end {
                let (under, whole) = (u32::from(self.under[i]), u32::from(self.whole[i]));
                let ink = under + (whole.saturating_sub(under)) * strength / 256;
                visit(i, (ink as u8).max(self.least[i]));
            }
        }
    }

    fn gain(&self, strength: impl Fn(usize) -> u32) -> u64 {
        let mut gain = 0;
        self.for_each(strength, |i, ink| {
            gain += u64::from(self.measure.weight(ink).saturating_sub(self.measure.weight(self.under[i])));
        });
        gain
    }
}
