//! Level nesting by pixels alone.

use rayon::prelude::*;

use super::{CellFinding, Constraint, Finding, Limit, Subject, Verdict};
use crate::map::Level;
use crate::measure::{self, LevelNesting};

/// Largest share of lost texels, in parts of what unrelated images lose.
const PART_OF_CONTROL: f64 = 0.05;
/// Control below which a pair of images says nothing: they are so dark that any texel finds ink.
const LEAST_CONTROL: f64 = 0.02;
/// Fewest texels that unrelated images must lose: one lost by bad luck is then half the limit.
const LEAST_LOST: f64 = 40.0;

/// For each level but the finest, lost texels over those lost by chance, pooled over the lighter half of the columns as far
/// as their control says something. Half ink is half of the coarser level's typical full ink.
pub(super) fn check(subject: &Subject) -> Finding {
    let constraint = Constraint::LevelNestingPixels;
    if subject.grid.hand_built < 2 {
        return Finding::not_judged(constraint, "there is only one level");
    }
    let pairs = subject.drawn().par_windows(2).enumerate();
    let cells: Vec<CellFinding> =
        pairs.flat_map_iter(|(level, pair)| judge_pair(subject, level + 1, &pair[1], &pair[0])).collect();
    if cells.is_empty() {
        return Finding::not_judged(
            constraint,
            "strokes are too dense or too few: unrelated images would nest as well",
        );
    }
    Finding::of_cells(constraint, "of control", cells, |worst| {
        if worst.measured == 0.0 {
            return "every inked texel has its stroke in the next finer level".into();
        }
        let place = subject.place(worst.level, worst.column);
        format!("{place}: inked texels without a stroke in level {}", worst.level - 1)
    })
}

fn judge_pair(subject: &Subject, level: usize, coarse: &Level, fine: &Level) -> Vec<CellFinding> {
    let half_ink = subject.half_ink(level);
    let width = measure::stroke_width(&fine.cells[0], fine.size, measure::full_ink(&fine.cells[0]), |_, _| true);
    // Grain and fading tapers make strokes look thinner than the broadest ones are; a list knows.
    let listed_px = subject
        .strokes()
        .map_or(0.0, |strokes| strokes.strokes.iter().map(|stroke| f64::from(stroke.width_px)).fold(0.0, f64::max));
    let reach = measure::level_nesting_reach(width.median_px.max(listed_px));
    let of = |column: usize| {
        measure::level_nesting(&coarse.cells[column], coarse.size, &fine.cells[column], half_ink, reach)
    };
    let light = subject.grid.columns().div_ceil(2);
    let judged: Vec<(usize, LevelNesting)> = (0..light)
        .into_par_iter()
        .map(|column| (column, of(column)))
        .filter(|(_, nesting)| nesting.control() >= LEAST_CONTROL)
        .collect();
    let sum = |part: fn(&LevelNesting) -> usize| judged.iter().map(|(_, nesting)| part(nesting)).sum::<usize>() as f64;
    if sum(|nesting| nesting.lost_by_chance) < LEAST_LOST {
        return Vec::new();
    }
    let pooled = sum(|nesting| nesting.lost) / sum(|nesting| nesting.lost_by_chance);
    let limit = Limit::AtMost(PART_OF_CONTROL);
    let cell = |(column, nesting): &(usize, LevelNesting)| {
        let part = nesting.lost as f64 / nesting.lost_by_chance.max(1) as f64;
        // A few texels of one column are chance; all light columns together are not.
        let measured = if limit.allows(pooled) { part.min(pooled) } else { part };
        let mut cell = CellFinding::new(level, *column, measured, limit).marked(|| {
            measure::lost_texels(&coarse.cells[*column], coarse.size, &fine.cells[*column], half_ink, reach)
        });
        if nesting.lost == 0 {
            cell.verdict = Verdict::Pass;
        }
        cell
    };
    judged.iter().map(cell).collect()
}
