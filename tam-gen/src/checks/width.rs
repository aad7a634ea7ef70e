//! Stroke width.

use super::{CellFinding, Constraint, Finding, Limit, Subject};
use crate::map::{Level, StrokeList};
use crate::measure::{self, StrokeWidth};

/// Largest change of the width from the finest level.
const CHANGE: f64 = 0.1;
/// The same in texels, for thin strokes: the accuracy of the measure.
const CHANGE_PX: f64 = 0.15;
/// Fewest texels worth judging.
const SAMPLES: usize = 40;
/// Fewest texels per texel of width, where only pixels are known, so that wide strokes are several too.
const SAMPLES_PER_WIDTH: f64 = 60.0;

/// Part of a stroke left out at either end. Tapers are the same part of a stroke at every level, so they need not be.
const ENDS: f64 = 0.15;

/// Width of each level's strokes against the finest, in the lightest column that has enough inked texels at the coarsest
/// judged level.
///
/// Widths may differ from stroke to stroke, so all levels are measured on the same ones. With a stroke list: on the centre
/// lines of strokes that the coarsest judged level draws whole, where no other comes near. Without: where that level is
/// inked; crowded strokes touch more often at coarse levels, which widens the median, so the change is that of the median
/// or of the lower quartile, whichever changed less. Thicker strokes widen both.
pub(super) fn check(subject: &Subject) -> Finding {
    let constraint = Constraint::StrokeWidth;
    // Dots have no more than a point of a centre line.
    let lined = subject.strokes().ok().filter(|strokes| strokes.strokes.iter().any(|stroke| stroke.along_uv > 0.0));
    let judged = (1..subject.grid.hand_built).rev().find_map(|coarsest| {
        let light = subject.grid.columns().div_ceil(2);
        (0..light).find_map(|column| {
            let widths = match lined {
                Some(strokes) => widths_on_lines(subject, strokes, coarsest, column),
                None => widths_on_ink(subject, coarsest, column),
            };
            widths.map(|widths| (column, widths))
        })
    });
    let Some((column, widths)) = judged else {
        return Finding::not_judged(constraint, "no level but the finest has strokes enough, and room between them");
    };
    let finest = widths[0];
    let limit = Limit::AtMost(CHANGE.max(CHANGE_PX / finest.median_px.max(1e-6)));
    let change = |of: fn(&StrokeWidth) -> f64, level: usize| (of(&widths[level]) / of(&finest).max(1e-6) - 1.0).abs();
    let cells = (1..widths.len())
        .filter(|&level| widths[level].samples >= SAMPLES)
        .map(|level| (level, change(|width| width.median_px, level).min(change(|width| width.lower_px, level))))
        .map(|(level, change)| CellFinding::new(level, column, change, limit))
        .collect();
    Finding::of_cells(constraint, "change", cells, |worst| {
        let (px, finest_px) = (widths[worst.level].median_px, finest.median_px);
        let place = subject.place(worst.level, worst.column);
        format!("{place}: strokes of {px:.2} px, in the finest level {finest_px:.2} px")
    })
}

/// Widths of the levels from the finest to `coarsest` in a column, where the coarsest is inked; `None` if that has too few
/// strokes, or too wide ones.
fn widths_on_ink(subject: &Subject, coarsest: usize, column: usize) -> Option<Vec<StrokeWidth>> {
    let coarse = &subject.grid.levels[coarsest];
    let half_ink = subject.half_ink(coarsest);
    let inked = |i: usize| coarse.cells[column][i] >= half_ink;
    let texels = (0..coarse.cells[column].len()).filter(|&i| inked(i)).count() as f64;
    let widths = widths_where(subject, coarsest, column, |level| {
        let size = level.size as usize;
        let finer = size / coarse.size as usize;
        (0..size * size).map(|i| inked(i / size / finer * coarse.size as usize + i % size / finer)).collect()
    })?;
    (texels >= SAMPLES_PER_WIDTH * widths[coarsest].median_px).then_some(widths)
}

/// The same on the centre lines of strokes that the coarsest level draws whole, away from all others.
fn widths_on_lines(
    subject: &Subject,
    strokes: &StrokeList,
    coarsest: usize,
    column: usize,
) -> Option<Vec<StrokeWidth>> {
    let drawn = |stroke: usize| usize::from(strokes.first_column[coarsest][stroke]) <= column;
    let crowded = crowded(subject, strokes, coarsest, column);
    let coarse_size = subject.grid.levels[coarsest].size as usize;
    widths_where(subject, coarsest, column, |level| {
        let size = level.size as usize;
        let finer = size / coarse_size;
        let alone = |i: usize| !crowded[i / size / finer * coarse_size + i % size / finer];
        let mut mask = vec![false; size * size];
        for stroke in (0..strokes.strokes.len()).filter(|stroke| drawn(*stroke)) {
            measure::visit_centre_line(&strokes.strokes[stroke], level.size, ENDS, |texel, _| {
                mask[texel] = alone(texel)
            });
        }
        mask
    })
}

/// The texels of a cell that lie near more than one of its strokes.
fn crowded(subject: &Subject, strokes: &StrokeList, level: usize, column: usize) -> Vec<bool> {
    let size = subject.grid.levels[level].size;
    let texels = (size * size) as usize;
    // The last stroke near each texel, from 1 on.
    let (mut near, mut crowded) = (vec![0; texels], vec![false; texels]);
    let closing = &strokes.closing[level][column];
    for (i, stroke) in strokes.strokes.iter().enumerate() {
        let drawn = usize::from(strokes.first_column[level][i]) <= column;
        if !drawn && closing.iter().all(|closing| closing.stroke as usize != i) {
            continue;
        }
        // A stroke ends half its width from its line, and so does its neighbour; a texel and more is paper between.
        let reach = ((stroke.width_px + 1.0).ceil() as usize).min(size as usize / 2);
        let side = size as usize;
        measure::visit_centre_line(stroke, size, 0.0, |texel, _| {
            let (left, top) = (texel % side + side - reach, texel / side + side - reach);
            for y in (top..=top + 2 * reach).map(|y| y % side * side) {
                for x in (left..=left + 2 * reach).map(|x| x % side) {
                    crowded[y + x] |= near[y + x] != 0 && near[y + x] != i + 1;
                    near[y + x] = i + 1;
                }
            }
        });
    }
    crowded
}

/// Widths of the levels from the finest to `coarsest` in a column, on the texels that `mask` gives for each level.
fn widths_where(
    subject: &Subject,
    coarsest: usize,
    column: usize,
    mask: impl Fn(&Level) -> Vec<bool>,
) -> Option<Vec<StrokeWidth>> {
    // From the finest level, where most strokes show it.
    let full_ink = measure::full_ink(&subject.grid.levels[0].cells[0]);
    let measured = |level: &Level| {
        let mask = mask(level);
        let on_mask = |x: u32, y: u32| mask[(y * level.size + x) as usize];
        measure::stroke_width(&level.cells[column], level.size, full_ink, on_mask)
    };
    let coarse = measured(&subject.grid.levels[coarsest]);
    let widest = 0.25 * f64::from(subject.grid.levels[coarsest].size);
    (coarse.samples >= SAMPLES && coarse.median_px <= widest)
        .then(|| subject.grid.levels[..coarsest].iter().map(measured).chain([coarse]).collect())
}
