//! Level nesting along centre lines.

use super::{CellFinding, Constraint, Finding, Limit, Subject};
use crate::measure;

/// Share of the centre-line samples of each level that lack ink, by column.
pub(super) fn check(subject: &Subject) -> Finding {
    let constraint = Constraint::LevelNestingCentreLines;
    let strokes = match subject.strokes() {
        Ok(strokes) => strokes,
        Err(why) => return Finding::not_judged(constraint, why),
    };
    let (mut cells, mut samples, mut skipped) = (Vec::new(), 0, 0);
    for level in 0..subject.grid.hand_built {
        let found = measure::centre_lines(subject.grid, strokes, level);
        samples += found.samples;
        skipped += found.skipped;
        for (column, &missing) in found.missing_of_column.iter().enumerate() {
            let cell = CellFinding::new(level, column, missing as f64, Limit::AtMost(0.0));
            cells.push(cell.marked(|| measure::missing_centre_lines(subject.grid, strokes, level, column)));
        }
    }
    if samples == 0 {
        let why = match skipped {
            0 => "strokes are too short, or taper all along, to have a middle",
            _ => "strokes are drawn with a tip, whose shape is free",
        };
        return Finding::not_judged(constraint, why);
    }
    Finding::of_cells(constraint, "samples", cells, |worst| {
        let skipped = match skipped {
            0 => String::new(),
            skipped => format!("; {skipped} drawn with a tip were not judged"),
        };
        if worst.measured == 0.0 {
            return format!("{samples} samples, all inked{skipped}");
        }
        let place = subject.place(worst.level, worst.column);
        format!("{place}: {} of the map's {samples} samples lack ink{skipped}", worst.measured)
    })
}
