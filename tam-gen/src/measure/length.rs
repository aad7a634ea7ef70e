//! Whether strokes are as long as their options ask.

use crate::map::StrokeList;

/// Lengths of the strokes of a map against what was asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LengthBias {
    /// Mean length of the strokes, in tiles.
    pub mean_uv: f64,
    /// Mean of the middle of the range that each stroke's family asks for, in tiles.
    pub asked_uv: f64,
}

impl LengthBias {
    /// Mean length over the length asked for; 1 is unbiased. Dots, of no length, are unbiased.
    pub fn ratio(&self) -> f64 {
        if self.asked_uv == 0.0 { 1.0 } else { self.mean_uv / self.asked_uv }
    }
}

/// Mean stroke length against the middle of the range in the options; `None` without strokes.
///
/// A search that keeps the best of several candidates of different lengths favours short ones: it shows here.
pub fn length_bias(strokes: &StrokeList) -> Option<LengthBias> {
    let count = strokes.strokes.len();
    if count == 0 {
        return None;
    }
    let (mut length, mut asked) = (0.0, 0.0);
    for stroke in &strokes.strokes {
        let options = &strokes.families[usize::from(stroke.family)].stroke;
        length += f64::from(stroke.length_uv());
        asked += 0.5 * (options.length_min + options.length_max);
    }
    Some(LengthBias { mean_uv: length / count as f64, asked_uv: asked / count as f64 })
}
