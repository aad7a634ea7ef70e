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

/// The wrap edge against the interior lines, on dense columns, averaged over the hand-built levels of at least 32 px; the
/// worse axis.
///
/// The edge is one line: in a horizontally hatched image a row is all stroke or all gap, so the ratio of a sound edge
/// scatters as the interior lines do. The limit therefore widens to where nearly all interior lines lie.
pub(super) fn check(subject: &Subject) -> Finding {
    let constraint = Constraint::Seams;
    let tones: Vec<f64> = subject.drawn()[0].cells.iter().map(|ink| subject.options.measure.tone(ink)).collect();
    let last = tones.len() - 1;
    let dense: Vec<usize> = (0..=last).filter(|&column| tones[column] >= DENSE || column == last).collect();
    let levels: Vec<usize> =
        (0..subject.grid.hand_built).filter(|&level| subject.grid.levels[level].size >= LEAST_SIZE).collect();
    if levels.is_empty() {
        return Finding::not_judged(constraint, format!("no level has {LEAST_SIZE} px"));
    }
    let [across, down] = [Axis::X, Axis::Y].map(|axis| {
        let seams: Vec<Seam> = levels
            .iter()
            .map(|&level| {
                let level = &subject.grid.levels[level];
                let images: Vec<&[u8]> = dense.iter().map(|&column| level.cells[column].as_slice()).collect();
                measure::seam(&images, level.size, axis)
            })
            .collect();
        let mean = |part: fn(&Seam) -> f64| seams.iter().map(part).sum::<f64>() / seams.len() as f64;
        let ratio = mean(|seam| seam.ratio);
        let mut finding = Finding::new(constraint, ratio, limit(mean(|seam| seam.low), mean(|seam| seam.high)), "");
        finding.cells = seams
            .iter()
            .zip(&levels)
            .map(|(seam, &level)| {
                let cell = CellFinding::new(level, last, seam.ratio, limit(seam.low, seam.high));
                cell.marked(|| edge(&subject.grid.levels[level].cells[last], subject.grid.levels[level].size, axis))
            })
            .collect();
        finding
    });
    let (ratio_x, ratio_y) = (across.measured, down.measured);
    let excess = |finding: &Finding| finding.limit.excess(finding.measured);
    let (mut worse, edge) = if excess(&across) >= excess(&down) {
        (across, "left and right edges")
    } else {
        (down, "top and bottom edges")
    };
    worse.detail = format!("{edge}; left-right {ratio_x:.2}, top-bottom {ratio_y:.2} of an interior line");
    worse
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
