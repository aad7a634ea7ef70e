//! Whether a stroke map, thresholded, gives the columns of the tonal art map it belongs to.

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
    thresholds.iter().filter(|&&threshold| f64::from(threshold) <= limit).count() as f64
        / thresholds.len().max(1) as f64
}

/// Compares a thresholded level of a stroke map with a cell of the same size, of which texels of at least `half_ink` count
/// as inked.
///
/// # Panics
///
/// If the two differ in size.
pub fn pattern_match(thresholds: &[u8], ink: &[u8], size: u32, half_ink: u8) -> PatternMatch {
    let threshold = matching_threshold(thresholds, ink, half_ink);
    let half = size as usize / 2;
    let size = size as usize;
    let rolled = |i: usize| ((i / size + half) % size) * size + (i % size + half) % size;
    let differing = |of: &dyn Fn(usize) -> usize| {
        let differs = |&i: &usize| (thresholds[of(i)] <= threshold) != (ink[i] >= half_ink.max(1));
        (0..ink.len()).filter(differs).count() as f64 / ink.len().max(1) as f64
    };
    PatternMatch { threshold, differing: differing(&|i| i), differing_by_chance: differing(&rolled) }
}

/// The texels that [`pattern_match`] counts as differing.
pub fn pattern_mismatch(thresholds: &[u8], ink: &[u8], half_ink: u8) -> Vec<bool> {
    let threshold = matching_threshold(thresholds, ink, half_ink);
    thresholds.iter().zip(ink).map(|(&at, &ink)| (at <= threshold) != (ink >= half_ink.max(1))).collect()
}

/// The threshold whose count of inked texels comes nearest to the cell's.
fn matching_threshold(thresholds: &[u8], ink: &[u8], half_ink: u8) -> u8 {
    assert_eq!(thresholds.len(), ink.len(), "stroke map and cell must have the same size");
    let wanted = ink.iter().filter(|&&ink| ink >= half_ink.max(1)).count();
    let mut count_of_threshold = [0_usize; 256];
    for &threshold in thresholds {
        count_of_threshold[usize::from(threshold)] += 1;
    }
    let (mut below, mut best) = (0, (usize::MAX, 0));
    for threshold in 0..=255_u8 {
        below += count_of_threshold[usize::from(threshold)];
        best = best.min((below.abs_diff(wanted), threshold));
    }
    best.1
}
