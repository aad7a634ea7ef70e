//! Tone nesting.

use super::{CellFinding, Constraint, Finding, Limit, Subject};
use crate::measure;

/// Share of texels of each cell that are lighter than in the column before.
pub(super) fn check(subject: &Subject) -> Finding {
    if subject.grid.columns() < 2 {
        return Finding::not_judged(Constraint::ToneNesting, "there is only one column");
    }
    let mut cells = Vec::new();
    for (i, level) in subject.grid.levels.iter().enumerate() {
        for (column, pair) in level.cells.windows(2).enumerate() {
            let share = measure::tone_nesting(&pair[0], &pair[1]).any;
            let cell = CellFinding::new(i, column + 1, share, Limit::AtMost(0.0));
            cells.push(cell.marked(|| measure::lighter_than_before(&pair[0], &pair[1])));
        }
    }
    Finding::of_cells(Constraint::ToneNesting, "of texels", cells, |worst| {
        let cells = &subject.grid.levels[worst.level].cells;
        let nesting = measure::tone_nesting(&cells[worst.column - 1], &cells[worst.column]);
        if nesting.worst == 0 {
            return "no texel grows lighter".into();
        }
        format!(
            "{}: {} texels lighter than in column {}, by up to {}/255; {:.2} % by more than 16/255",
            subject.place(worst.level, worst.column),
            worst.texels.len(),
            worst.column - 1,
            nesting.worst,
            100.0 * nesting.visible,
        )
    })
}
