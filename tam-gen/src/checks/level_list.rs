//! Level nesting by the stroke list.

use super::{CellFinding, Constraint, Finding, Limit, Subject};
use crate::map::StrokeList;

/// Slack for summed fractions of closing strokes.
const SLACK: f64 = 1e-5;

/// Violations per cell: strokes that the next coarser level draws whole and this one does not, and families whose count,
/// closing strokes by their fraction, falls from the lighter column or from the coarser level.
pub(super) fn check(subject: &Subject) -> Finding {
    let strokes = match subject.strokes() {
        Ok(strokes) => strokes,
        Err(why) => return Finding::not_judged(Constraint::LevelNestingList, why),
    };
    let columns = subject.grid.columns();
    let counts: Vec<_> = (0..subject.grid.hand_built).map(|level| counts(strokes, level, columns)).collect();
    let mut cells = Vec::new();
    for level in 0..subject.grid.hand_built {
        let mut violations = vec![0_usize; columns];
        if let Some(coarser) = strokes.first_column.get(level + 1) {
            for (&finer, &coarser) in strokes.first_column[level].iter().zip(coarser) {
                if finer > coarser {
                    violations[usize::from(coarser).min(columns - 1)] += 1;
                }
            }
        }
        for (column, violations) in violations.iter_mut().enumerate() {
            for (family, count) in counts[level][column].iter().enumerate() {
                let falls_from = |other: f64| usize::from(*count < other - SLACK);
                *violations += if column > 0 { falls_from(counts[level][column - 1][family]) } else { 0 };
                *violations += counts.get(level + 1).map_or(0, |coarser| falls_from(coarser[column][family]));
            }
            cells.push(CellFinding::new(level, column, *violations as f64, Limit::AtMost(0.0)));
        }
    }
    Finding::of_cells(Constraint::LevelNestingList, "violations", cells, |worst| {
        if worst.measured == 0.0 {
            return format!("{} strokes, none missing from a finer level or darker column", strokes.strokes.len());
        }
        let place = subject.place(worst.level, worst.column);
        format!("{place} lacks strokes of the coarser level or the lighter column")
    })
}

/// For each column and family the strokes drawn, whole or in part.
fn counts(strokes: &StrokeList, level: usize, columns: usize) -> Vec<Vec<f64>> {
    let mut counts = vec![vec![0.0; strokes.families.len()]; columns];
    for (stroke, &first) in strokes.strokes.iter().zip(&strokes.first_column[level]) {
        for column in counts.iter_mut().skip(usize::from(first)) {
            column[usize::from(stroke.family)] += 1.0;
        }
    }
    for (column, closing) in counts.iter_mut().zip(&strokes.closing[level]) {
        for closing in closing {
            column[usize::from(strokes.strokes[closing.stroke as usize].family)] += f64::from(closing.fraction);
        }
    }
    counts
}
