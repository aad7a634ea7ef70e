//! Stroke width.

use super::{CellFinding, Constraint, Finding, Limit, Subject};
use crate::measure::{self, StrokeWidth};

/// Largest change of the width from the finest level.
const CHANGE: f64 = 0.1;
/// The same in texels, for thin strokes: the accuracy of the measure.
const CHANGE_PX: f64 = 0.15;
/// Fewest texels worth judging.
const SAMPLES: usize = 60;
/// Fewest texels per texel of width, so that wide strokes are several too.
const SAMPLES_PER_WIDTH: f64 = 80.0;

/// Width of each level's strokes against the finest, in the lightest column that has enough inked texels at the coarsest
/// judged level.
///
/// Finer levels are measured only where that level is inked: on the same strokes, as far as possible, so that strokes of
/// unlike widths do not count.
pub(super) fn check(subject: &Subject) -> Finding {
    let constraint = Constraint::StrokeWidth;
    let Some((coarsest, column)) = coarsest_judged(subject) else {
        return Finding::not_judged(constraint, "no level but the finest has strokes enough, and room between them");
    };
    let coarse = &subject.grid.levels[coarsest];
    let half = subject.half_ink(coarsest);
    let widths: Vec<StrokeWidth> = (0..=coarsest)
        .map(|level| {
            let ink = &subject.grid.levels[level].cells[column];
            let on_coarse = |x: u32, y: u32| {
                coarse.cells[column][((y >> (coarsest - level)) * coarse.size + (x >> (coarsest - level))) as usize]
                    >= half
            };
            measure::stroke_width(ink, subject.grid.levels[level].size, full_ink(subject), on_coarse)
        })
        .collect();
    let finest = widths[0].width_px.max(1e-6);
    let change = |level: usize| (widths[level].width_px / finest - 1.0).abs();
    let cells = (1..=coarsest)
        .filter(|&level| widths[level].samples >= SAMPLES)
        .map(|level| CellFinding::new(level, column, change(level), Limit::AtMost(CHANGE.max(CHANGE_PX / finest))))
        .collect();
    Finding::of_cells(constraint, "change", cells, |worst| {
        let px = widths[worst.level].width_px;
        format!(
            "{}: strokes of {px:.2} px, in the finest level {finest:.2} px",
            subject.place(worst.level, worst.column)
        )
    })
}

/// Full ink, from the finest level, where most strokes show it.
fn full_ink(subject: &Subject) -> u8 {
    measure::full_ink(&subject.grid.levels[0].cells[0])
}

/// The coarsest level, and its lightest column, with enough inked texels and strokes no wider than a quarter of its size.
fn coarsest_judged(subject: &Subject) -> Option<(usize, usize)> {
    let light = subject.grid.columns().div_ceil(2);
    (1..subject.grid.hand_built).rev().find_map(|level| {
        let image = &subject.grid.levels[level];
        let inked = |column: usize| measure::share_at_least(&image.cells[column], subject.half_ink(level));
        (0..light).find_map(|column| {
            let texels = inked(column) * image.cells[column].len() as f64;
            if texels < SAMPLES as f64 {
                return None;
            }
            let width =
                measure::stroke_width(&image.cells[column], image.size, full_ink(subject), |_, _| true).width_px;
            let several = texels >= SAMPLES_PER_WIDTH * width;
            (several && width <= 0.25 * f64::from(image.size)).then_some((level, column))
        })
    })
}
