//! Stroke width.

use std::sync::LazyLock;

use rayon::prelude::*;

use super::{CellFinding, Constraint, Finding, Limit, Subject};
use crate::map::{Level, StrokeList};
use crate::measure::{self, StrokeWidth};
use crate::stroke::{Axis, Stroke};

/// Largest change of the width from the finest level.
const CHANGE: f64 = 0.1;
/// The same in texels, for thin strokes: the accuracy of the measure.
const CHANGE_PX: f64 = 0.15;
/// Fewest places worth judging, and most that are measured.
const SAMPLES: usize = 40;
const SAMPLES_MAX: usize = 256;
/// Neighbouring chords that cross the same grain, and so tell the same.
const CHORDS_ALIKE: f64 = 4.0;
/// Standard errors of a width that have to fit into [`CHANGE`].
const ERRORS: f64 = 3.0;
/// Fewest texels per texel of width, where only pixels are known, so that wide strokes are several too.
const SAMPLES_PER_WIDTH: f64 = 60.0;

/// Part of a stroke left out at either end. Tapers are the same part of a stroke at every level, so they need not be.
const ENDS: f32 = 0.15;

/// Width of each level's strokes against the finest, in the lightest columns that show enough of them.
///
/// Widths may differ from stroke to stroke and along it, so the same places are measured in both levels. With a stroke
/// list: on the centre lines of strokes that the coarser level draws whole, where no other comes near in either. Without:
/// where the coarsest level that has enough ink is inked; crowded strokes touch more often at coarse levels, which widens
/// the median, so the change is that of the median or of the lower quartile, whichever changed less. Thicker strokes
/// widen both.
pub(super) fn check(subject: &Subject) -> Finding {
    // Dots have no more than a point of a centre line.
    let lined = subject.strokes().ok().filter(|strokes| strokes.strokes.iter().any(|stroke| stroke.along_uv > 0.0));
    let judged = match lined {
        Some(strokes) => changes_on_lines(subject, strokes),
        None => changes_on_ink(subject),
    };
    if judged.is_empty() {
        let why = "no level but the finest has strokes enough, and room between them";
        return Finding::not_judged(Constraint::StrokeWidth, why);
    }
    let cells = judged.iter().map(|change| CellFinding::new(change.level, change.column, change.part, change.limit));
    Finding::of_cells(Constraint::StrokeWidth, "change", cells.collect(), |worst| {
        let place = subject.place(worst.level, worst.column);
        let change = judged.iter().find(|change| change.level == worst.level);
        let (px, finest_px) = change.map_or((0.0, 0.0), |change| (change.px, change.finest_px));
        format!("{place}: strokes of {px:.2} px, in the finest level {finest_px:.2} px")
    })
}

/// How the width of a level differs from the finest's.
struct Change {
    level: usize,
    column: usize,
    part: f64,
    limit: Limit,
    px: f64,
    finest_px: f64,
}

impl Change {
    fn new(level: usize, column: usize, part: f64, px: f64, finest_px: f64) -> Self {
        let limit = Limit::AtMost(CHANGE.max(CHANGE_PX / finest_px.max(1e-6)));
        Self { level, column, part, limit, px, finest_px }
    }
}

/// Whether the median of `samples` numbers is certain enough to be held against the limit, given its distance to the lower
/// quartile as a part of it: grain and jitter spread them, and the median of few is a matter of chance.
fn tells(samples: usize, to_quartile: f64) -> bool {
    // Of a normal distribution the lower quartile lies 0.674 deviations below the median, whose standard error is 1.25
    // deviations over the root of the count.
    let standard_error = 1.25 * to_quartile / 0.674 / (samples as f64 / CHORDS_ALIKE).sqrt();
    samples >= SAMPLES && ERRORS * standard_error <= CHANGE
}

/// Changes where strokes are known.
fn changes_on_lines(subject: &Subject, strokes: &StrokeList) -> Vec<Change> {
    let light = subject.grid.columns().div_ceil(2);
    let crowded_finest: Vec<LazyLock<Vec<bool>, _>> =
        (0..light).map(|column| LazyLock::new(move || crowded(subject, strokes, 0, column))).collect();
    // From the finest level, where most strokes show it.
    let full_ink = measure::full_ink(&subject.grid.levels[0].cells[0]);
    let change = |level| {
        (0..light)
            .find_map(|column| change_on_lines(subject, strokes, (level, column), || &crowded_finest[column], full_ink))
    };
    (1..subject.grid.hand_built).into_par_iter().filter_map(change).collect()
}

/// The change of a level in a column; `None` if too few places tell. `crowded_finest` is asked for only if enough are left.
fn change_on_lines<'a>(
    subject: &Subject,
    strokes: &StrokeList,
    (level, column): (usize, usize),
    crowded_finest: impl FnOnce() -> &'a [bool],
    full_ink: u8,
) -> Option<Change> {
    let (coarse, finest) = (&subject.grid.levels[level], &subject.grid.levels[0]);
    let crowded_coarse = crowded(subject, strokes, level, column);
    let texel = |size: u32, (u, v): (f32, f32)| {
        let at = |x: f32| ((x * size as f32) as u32).min(size - 1);
        (at(v) * size + at(u)) as usize
    };
    let drawn = strokes.strokes.iter().zip(&strokes.first_column[level]);
    let mut places: Vec<(f32, f32)> = drawn
        .filter(|(stroke, first)| usize::from(**first) <= column && stroke.along_uv > 0.0)
        .flat_map(|(stroke, _)| {
            let steps = (stroke.along_uv * coarse.size as f32).ceil() as u32;
            let within = (1..steps).map(move |step| step as f32 / steps as f32);
            within.filter(|t| (ENDS..=1.0 - ENDS).contains(t)).map(|t| stroke.point_uv(t))
        })
        .filter(|&at| !crowded_coarse[texel(coarse.size, at)])
        .collect();
    if places.len() < SAMPLES {
        return None;
    }
    let crowded_finest = crowded_finest();
    places.retain(|&at| !crowded_finest[texel(finest.size, at)]);

    let mut pairs: Vec<(f64, f64)> = places
        .iter()
        .step_by(places.len().div_ceil(SAMPLES_MAX).max(1))
        .filter_map(|&(u, v)| {
            let at = (f64::from(u), f64::from(v));
            let width = |level: &Level| measure::stroke_width_at(&level.cells[column], level.size, full_ink, at);
            Some((width(coarse)?, width(finest)?))
        })
        .collect();
    pairs.sort_by(|a, b| (a.0 / a.1).total_cmp(&(b.0 / b.1)));
    let (px, finest_px) = *pairs.get(pairs.len() / 2)?;
    let lower = pairs[pairs.len() / 4];
    let ratio = px / finest_px;
    let room = px <= 0.25 * f64::from(coarse.size);
    (room && tells(pairs.len(), 1.0 - lower.0 / lower.1 / ratio))
        .then(|| Change::new(level, column, (ratio - 1.0).abs(), px, finest_px))
}

/// Changes where only pixels are known.
fn changes_on_ink(subject: &Subject) -> Vec<Change> {
    let light = subject.grid.columns().div_ceil(2);
    let judged = (1..subject.grid.hand_built).rev().find_map(|coarsest| {
        (0..light).find_map(|column| widths_on_ink(subject, coarsest, column).map(|widths| (column, widths)))
    });
    let Some((column, widths)) = judged else { return Vec::new() };
    let finest = widths[0];
    let change = |of: fn(&StrokeWidth) -> f64, level: usize| (of(&widths[level]) / of(&finest).max(1e-6) - 1.0).abs();
    (1..widths.len())
        .filter(|&level| enough(&widths[level]))
        .map(|level| {
            let part = change(|width| width.median_px, level).min(change(|width| width.lower_px, level));
            Change::new(level, column, part, widths[level].median_px, finest.median_px)
        })
        .collect()
}

fn enough(width: &StrokeWidth) -> bool {
    tells(width.samples, 1.0 - width.lower_px / width.median_px.max(1e-6))
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

/// The texels of a cell that lie near more than one of its strokes.
fn crowded(subject: &Subject, strokes: &StrokeList, level: usize, column: usize) -> Vec<bool> {
    const NEAR: u8 = 1;
    const CROWDED: u8 = 2;
    let size = subject.grid.levels[level].size;
    let mut marks = vec![0_u8; size as usize * size as usize];
    let closing = &strokes.closing[level][column];
    for (i, stroke) in strokes.strokes.iter().enumerate() {
        let drawn = usize::from(strokes.first_column[level][i]) <= column;
        if !drawn && closing.iter().all(|closing| closing.stroke as usize != i) {
            continue;
        }
        // First what strokes before left near it, then itself, so that a stroke does not crowd itself.
        change_near(&mut marks, size, stroke, |mark| mark | ((mark & NEAR) * CROWDED));
        change_near(&mut marks, size, stroke, |mark| mark | NEAR);
    }
    marks.into_iter().map(|mark| mark & CROWDED != 0).collect()
}

/// Changes the marks of the texels near a stroke, some of them more than once.
fn change_near(marks: &mut [u8], size: u32, stroke: &Stroke, change: impl Fn(u8) -> u8) {
    // A stroke ends half its width from its line, and so does its neighbour; a texel and more is paper between.
    let reach = ((stroke.width_px + 1.0).ceil() as usize).min(size as usize / 2);
    let (side, texels) = (size as usize, marks.len());
    measure::visit_centre_line(stroke, size, 0.0, |texel, _| {
        // Across the stroke is enough: its samples follow each other along it.
        let x = texel % side;
        let (mut at, step, end) = match stroke.axis {
            Axis::X => ((texel + texels - reach * side) % texels, side, texels),
            Axis::Y => (texel - x + (x + side - reach) % side, 1, texel - x + side),
        };
        for _ in 0..=2 * reach {
            marks[at] = change(marks[at]);
            at += step;
            at -= if at < end { 0 } else { step * side };
        }
    });
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
    (enough(&coarse) && coarse.median_px <= widest)
        .then(|| subject.grid.levels[..coarsest].iter().map(measured).chain([coarse]).collect())
}
