//! Seams.

use super::{CellFinding, Constraint, Finding, Limit, Subject};
use crate::measure::{self, Seam};
use crate::stroke::Axis;

/// Ratio of the wrap edge to interior lines, whatever these do.
const RATIO: (f64, f64) = (0.8, 1.25);
/// Coarsest level judged, px: below, an edge is too few texels.
const LEAST_SIZE: u32 = 32;
/// Tone from which on a column is dense enough to judge.
const DENSE: f64 = 0.35;

/// The wrap edge against the interior lines, for each dense column averaged over the hand-built levels of at least 32 px; the
/// worst column and axis.
///
/// The edge is one line: in a horizontally hatched image a row is all stroke or all gap, so the ratio of a sound edge
/// scatters as the interior lines do. The limit therefore widens to where nearly all interior lines lie.
pub(super) fn check(subject: &Subject) -> Finding {
    let tones: Vec<f64> = subject.drawn()[0].cells.iter().map(|ink| subject.options.measure.tone(ink)).collect();
    let last = tones.len() - 1;
    let levels: Vec<usize> =
        (0..subject.grid.hand_built).filter(|&level| subject.grid.levels[level].size >= LEAST_SIZE).collect();
    if levels.is_empty() {
        return Finding::not_judged(Constraint::Seams, format!("no level has {LEAST_SIZE} px"));
    }
    let dense = (0..=last).filter(|&column| tones[column] >= DENSE || column == last);
    let edges = dense.flat_map(|column| [(column, Axis::X), (column, Axis::Y)]);
    let findings = edges.map(|(column, axis)| edge_finding(subject, &levels, column, axis));
    let excess = |finding: &Finding| finding.limit.excess(finding.measured);
    let worst = findings.reduce(|worst, next| if excess(&next) > excess(&worst) { next } else { worst });
    worst.unwrap_or_else(|| Finding::not_judged(Constraint::Seams, "no column is dense"))
}

fn edge_finding(subject: &Subject, levels: &[usize], column: usize, axis: Axis) -> Finding {
    let image = |level: usize| &subject.grid.levels[level];
    let seams: Vec<Seam> =
        levels.iter().map(|&level| measure::seam(&[&image(level).cells[column]], image(level).size, axis)).collect();
    let mean = |part: fn(&Seam) -> f64| seams.iter().map(part).sum::<f64>() / seams.len() as f64;
    let limits = limit(mean(|seam| seam.low), mean(|seam| seam.high));
    let mut finding = Finding::new(Constraint::Seams, mean(|seam| seam.ratio), limits, "of a line inside");
    finding.cells = seams
        .iter()
        .zip(levels)
        .map(|(seam, &level)| {
            let cell = CellFinding::new(level, column, seam.ratio, limit(seam.low, seam.high));
            cell.marked(|| edge(&image(level).cells[column], image(level).size, axis))
        })
        .collect();
    let sides = match axis {
        Axis::X => "left and right",
        Axis::Y => "top and bottom",
    };
    finding.detail = format!("{sides} edges of column {column}, over all levels of at least {LEAST_SIZE} px");
    finding
}

fn limit(low: f64, high: f64) -> Limit {
    Limit::Between(low.min(RATIO.0).max(0.0), high.max(RATIO.1))
}

/// The texels on both sides of the wrap edge that differ by more than a quarter of the ink.
fn edge(ink: &[u8], size: u32, axis: Axis) -> Vec<bool> {
    let size = size as usize;
    let mut edge = vec![false; ink.len()];
    for i in 0..size {
        let (first, last) = match axis {
            Axis::X => (i * size, i * size + size - 1),
            Axis::Y => (i, (size - 1) * size + i),
        };
        if ink[first].abs_diff(ink[last]) > 64 {
            (edge[first], edge[last]) = (true, true);
        }
    }
    edge
}
