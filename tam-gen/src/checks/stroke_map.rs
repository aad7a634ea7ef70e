//! Stroke map: tone and pattern.

use super::{CellFinding, Constraint, Finding, Limit, Subject};
use crate::measure::{self, PatternMatch};

/// Least limit of the tone of a thresholded stroke map.
const TONE: f64 = 0.01;
/// Limit at 64 px where the strokes, and so their area, are not known; the area of a stroke in tiles halves with each finer
/// level.
const TONE_AT_64_PX: f64 = 0.02;
/// Largest differing share, in parts of what an unrelated pattern differs by.
const PART_OF_CONTROL: f64 = 0.35;
/// Share that an unrelated pattern must differ by; a cell of nearly bare paper or solid ink looks like any other.
const LEAST_CONTROL: f64 = 0.02;

/// |share of texels inked at a column's tone - that tone|, for every hand-built cell.
///
/// Thresholds are constant within a stroke, so the share moves by whole strokes: half the area of the largest is allowed.
/// Of a stroke 1.6 texels wide one row or both under it may count as inked: the width is rounded up.
pub(super) fn tone(subject: &Subject) -> Finding {
    let constraint = Constraint::StrokeMapTone;
    let map = match subject.stroke_map() {
        Ok(map) => map,
        Err(why) => return Finding::not_judged(constraint, why),
    };
    if subject.options.tone_spread_only {
        return Finding::not_judged(constraint, "the wanted tones are not known");
    }
    let mut cells = Vec::new();
    for (level, thresholds) in map.levels.iter().enumerate() {
        let limit = Limit::AtMost(tone_limit(subject, thresholds.size));
        for (column, &tone) in subject.grid.tones.iter().enumerate() {
            let error = (measure::threshold_share(&thresholds.threshold, tone) - tone).abs();
            cells.push(CellFinding::new(level, column, error, limit));
        }
    }
    Finding::of_cells(constraint, "", cells, |worst| {
        let wanted = subject.grid.tones[worst.column];
        let share = measure::threshold_share(&map.levels[worst.level].threshold, wanted);
        format!("{}: inks {share:.4}, wanted {wanted:.4}", subject.place(worst.level, worst.column))
    })
}

fn tone_limit(subject: &Subject, size: u32) -> f64 {
    let size = f64::from(size);
    let unknown = TONE_AT_64_PX * 64.0 / size;
    let half_stroke = subject.strokes().map_or(unknown, |strokes| {
        let area = |stroke: &crate::Stroke| {
            let (length_px, width_px) = (f64::from(stroke.length_uv()) * size, f64::from(stroke.width_px).ceil());
            length_px.max(width_px) * width_px / (size * size)
        };
        0.5 * strokes.strokes.iter().map(area).fold(0.0, f64::max) + 1.0 / 255.0
    });
    half_stroke.max(TONE)
}

/// Share of texels on which a column and the stroke map, cut where it inks as many texels, differ, over the same for the
/// stroke map rolled by half a tile, pooled over the columns of each hand-built level.
pub(super) fn pattern(subject: &Subject) -> Finding {
    let constraint = Constraint::StrokeMapPattern;
    let map = match subject.stroke_map() {
        Ok(map) => map,
        Err(why) => return Finding::not_judged(constraint, why),
    };
    let mut cells = Vec::new();
    for (level, thresholds) in map.levels.iter().enumerate() {
        let half_ink = half_covered(subject, level);
        let images = &subject.grid.levels[level].cells;
        let found = measure::pattern_matches(&thresholds.threshold, images, thresholds.size, half_ink);
        let judged: Vec<(usize, PatternMatch)> =
            found.into_iter().enumerate().filter(|(_, found)| found.differing_by_chance >= LEAST_CONTROL).collect();
        let sum = |part: fn(&PatternMatch) -> f64| judged.iter().map(|(_, found)| part(found)).sum::<f64>();
        let pooled = sum(|found| found.differing) / sum(|found| found.differing_by_chance).max(1e-12);
        let limit = Limit::AtMost(PART_OF_CONTROL);
        for (column, found) in &judged {
            let part = found.differing / found.differing_by_chance;
            // The part that closes a light column may be most of a stroke; over the columns that evens out.
            let measured = if limit.allows(pooled) { part.min(pooled) } else { part };
            let cell = CellFinding::new(level, *column, measured, limit);
            cells.push(cell.marked(|| measure::pattern_mismatch(&thresholds.threshold, &images[*column], half_ink)));
        }
    }
    if cells.is_empty() {
        return Finding::not_judged(constraint, "columns are bare, solid, or like any other pattern");
    }
    Finding::of_cells(constraint, "of control", cells, |worst| {
        format!("{}: texels that differ from the column", subject.place(worst.level, worst.column))
    })
}

/// Ink of a texel that one stroke covers by half, as the stroke map counts: by the strokes' opacity, or, where that is not
/// known, by the ink that covered texels show.
fn half_covered(subject: &Subject, level: usize) -> u8 {
    let Ok(strokes) = subject.strokes() else { return subject.half_ink(level) };
    let opacity: f64 = strokes.families.iter().map(|family| family.stroke.opacity).sum();
    (0.5 * 255.0 * opacity / strokes.families.len().max(1) as f64).round().clamp(1.0, 255.0) as u8
}
