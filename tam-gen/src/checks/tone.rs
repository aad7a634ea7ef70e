//! Tone average and tone spread.

use super::{CellFinding, Constraint, Finding, Limit, Subject};
use crate::measure;

/// Largest tone error of images made anywhere.
const ERROR: f64 = 1e-3;
/// Tone error that each tail level may add: averaging rounds each texel by up to half a unit, all the same way at worst.
const TAIL_ERROR: f64 = 0.5 / 255.0;

/// |tone - wanted tone| of every cell.
pub(super) fn average(subject: &Subject) -> Finding {
    let constraint = Constraint::ToneAverage;
    if subject.options.tone_spread_only {
        return Finding::not_judged(constraint, "the wanted tones are not known");
    }
    let tones = measure::tones(subject.grid, &subject.options.measure);
    let mut cells = Vec::new();
    for (level, tones) in tones.iter().enumerate() {
        for (column, (tone, wanted)) in tones.iter().zip(&subject.grid.tones).enumerate() {
            cells.push(CellFinding::new(level, column, (tone - wanted).abs(), Limit::AtMost(most(subject, level))));
        }
    }
    Finding::of_cells(constraint, "", cells, |worst| {
        let (tone, wanted) = (tones[worst.level][worst.column], subject.grid.tones[worst.column]);
        format!("{}: tone {tone:.5}, wanted {wanted:.5}", subject.place(worst.level, worst.column))
    })
}

/// Largest difference of tone between the hand-built levels of a column.
pub(super) fn spread(subject: &Subject) -> Finding {
    let tones = measure::tones(subject.grid, &subject.options.measure);
    let drawn = subject.grid.hand_built;
    if drawn < 2 {
        return Finding::not_judged(Constraint::ToneSpread, "there is only one level");
    }
    let mut cells = Vec::new();
    for column in 0..subject.grid.columns() {
        let tone = |level: &usize| tones[*level][column];
        let by_tone = |a: &usize, b: &usize| tone(a).total_cmp(&tone(b));
        let (lightest, darkest) = ((0..drawn).min_by(by_tone).unwrap_or(0), (0..drawn).max_by(by_tone).unwrap_or(0));
        // Two cells, each within its own limit.
        let most = if subject.options.own { most(subject, lightest) + most(subject, darkest) } else { ERROR };
        // Named by the one that is further from the others' mean.
        let mean = (0..drawn).map(|level| tones[level][column]).sum::<f64>() / drawn as f64;
        let odd = if mean - tone(&lightest) > tone(&darkest) - mean { lightest } else { darkest };
        cells.push(CellFinding::new(odd, column, tone(&darkest) - tone(&lightest), Limit::AtMost(most)));
    }
    Finding::of_cells(Constraint::ToneSpread, "", cells, |worst| {
        let place = subject.place(worst.level, worst.column);
        format!("{place} stands out with tone {:.5}", tones[worst.level][worst.column])
    })
}

fn most(subject: &Subject, level: usize) -> f64 {
    let size = subject.grid.levels[level].size;
    if level >= subject.grid.hand_built {
        let depth = level + 1 - subject.grid.hand_built;
        return ERROR + TAIL_ERROR * depth as f64;
    }
    let most = if subject.options.own { crate::tone_tolerance(size) } else { ERROR };
    most.max(quantum(subject) / (f64::from(size) * f64::from(size)))
}

/// What the least change of one texel can add to the sum of a cell's tones: a measure that counts texels as paper or ink
/// cannot come nearer.
fn quantum(subject: &Subject) -> f64 {
    let measure = &subject.options.measure;
    let step = |ink: u8| measure.weight(ink) - measure.weight(ink - 1);
    f64::from((1..=255).map(step).max().unwrap_or(0)) / f64::from(crate::preset::ToneMeasure::SOLID)
}
