//! How far the tone of cells is from what their columns ask for.

use rayon::prelude::*;

use crate::map::Grid;
use crate::preset::ToneMeasure;

/// Tone errors of the hand-built levels of a grid.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ToneErrors {
    /// Largest |tone - wanted tone| of a cell.
    pub max: f64,
    /// Root mean square of the same over all cells.
    pub rms: f64,
    /// Largest difference between two levels of one column.
    pub spread: f64,
}

/// The tone of every cell, `[level][column]`, `0.0 ..= 1.0`; all levels, tail included.
pub fn tones(grid: &Grid, measure: &ToneMeasure) -> Vec<Vec<f64>> {
    grid.levels.iter().map(|level| level.cells.par_iter().map(|ink| measure.tone(ink)).collect()).collect()
}

/// Tone errors over the hand-built levels. Exact to a few ulp; an empty grid has none.
pub fn tone_errors(grid: &Grid, measure: &ToneMeasure) -> ToneErrors {
    let tones = tones(grid, measure);
    let drawn = &tones[..grid.hand_built.min(tones.len())];
    let mut errors = ToneErrors::default();
    let mut squares = 0.0;
    for (column, wanted) in grid.tones.iter().enumerate() {
        let (mut lightest, mut darkest) = (f64::INFINITY, f64::NEG_INFINITY);
        for level in drawn {
            let tone = level[column];
            let error = (tone - wanted).abs();
            errors.max = errors.max.max(error);
            squares += error * error;
            lightest = lightest.min(tone);
            darkest = darkest.max(tone);
        }
        errors.spread = errors.spread.max(darkest - lightest);
    }
    errors.rms = (squares / (drawn.len() * grid.columns()).max(1) as f64).sqrt();
    errors
}
