//! Whether a stroke map, thresholded, gives the columns of the tonal art map it belongs to.

use super::count::{count, count_pairs, histogram};

/// How far a thresholded stroke map differs from a column.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PatternMatch {
    /// The threshold at which as many texels are inked as in the column, `0 ..= 255`.
    pub threshold: u8,
    /// Share of texels that are inked in one and not in the other, `0.0 ..= 1.0`.
    pub differing: f64,
    /// The same against the stroke map rolled by half a tile: what unrelated patterns differ by.
    pub differing_by_chance: f64,
}

/// Share of texels that a stroke map inks at a darkness, `0.0 ..= 1.0`: those with a threshold of at most
/// `255 darkness`, rounded.
pub fn threshold_share(thresholds: &[u8], darkness: f64) -> f64 {
    let limit = 255.0 * darkness + 0.5;
    let inked = if limit >= 0.0 { count(thresholds, |threshold| threshold <= limit as u8) } else { 0 };
    inked as f64 / thresholds.len().max(1) as f64
}

/// Compares a thresholded level of a stroke map with a cell of the same size, of which texels of at least `half_ink` count
/// as inked.
///
/// # Panics
///
/// If the two differ in size.
pub fn pattern_match(thresholds: &[u8], ink: &[u8], size: u32, half_ink: u8) -> PatternMatch {
    pattern_matches(thresholds, &[ink], size, half_ink)[0]
}

/// The same for several cells.
///
/// # Panics
///
/// If one differs in size from the stroke map.
pub fn pattern_matches(thresholds: &[u8], cells: &[impl AsRef<[u8]>], size: u32, half_ink: u8) -> Vec<PatternMatch> {
    let count_of_threshold = histogram(thresholds);
    let size = size as usize;
    let (rows, half) = (thresholds.chunks_exact(size.max(1)), size / 2);
    let of = |ink: &[u8]| {
        let threshold = matching_threshold(&count_of_threshold, thresholds, ink, half_ink);
        let differing = |thresholds: &[u8], ink: &[u8]| {
            count_pairs(thresholds, ink, |at, ink| (at <= threshold) != (ink >= half_ink.max(1)))
        };
        let rolled = rows.clone().cycle().skip(half).zip(ink.chunks_exact(size.max(1)));
        let by_chance: usize = rolled
            .map(|(thresholds, ink)| {
                let (left, right) = thresholds.split_at(half);
                let (ink_left, ink_right) = ink.split_at(size - half);
                differing(right, ink_left) + differing(left, ink_right)
            })
            .sum();
        let share = |texels: usize| texels as f64 / ink.len().max(1) as f64;
        let (differing, differing_by_chance) = (share(differing(thresholds, ink)), share(by_chance));
        PatternMatch { threshold, differing, differing_by_chance }
    };
    cells.iter().map(|ink| of(ink.as_ref())).collect()
}

/// The texels that [`pattern_match`] counts as differing.
pub fn pattern_mismatch(thresholds: &[u8], ink: &[u8], half_ink: u8) -> Vec<bool> {
    let threshold = matching_threshold(&histogram(thresholds), thresholds, ink, half_ink);
    thresholds.iter().zip(ink).map(|(&at, &ink)| (at <= threshold) != (ink >= half_ink.max(1))).collect()
}

/// The threshold whose count of inked texels comes nearest to the cell's.
fn matching_threshold(count_of_threshold: &[usize; 256], thresholds: &[u8], ink: &[u8], half_ink: u8) -> u8 {
    assert_eq!(thresholds.len(), ink.len(), "stroke map and cell must have the same size");
    let wanted = count(ink, |ink| ink >= half_ink.max(1));
    let (mut below, mut best) = (0, (usize::MAX, 0));
    for threshold in 0..=255_u8 {
        below += count_of_threshold[usize::from(threshold)];
        best = best.min((below.abs_diff(wanted), threshold));
    }
    best.1
}
