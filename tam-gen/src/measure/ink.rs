//! What "inked" means for an image whose ink may be soft.

use super::count::{count, histogram};

/// The ink of a texel that a stroke covers fully: the 90th percentile of all texels with any ink, `1 ..= 255`, or 0 for
/// bare paper.
///
/// Solid ink gives 255; ink of opacity 0.4 about 102; lines thinner than a texel what their middle leaves. Taken in light
/// columns, where few strokes overlap.
pub fn full_ink(ink: &[u8]) -> u8 {
    let count_of_ink = histogram(ink);
    let inked = ink.len() - count_of_ink[0];
    let mut above = 0;
    for ink in (1..=255_u8).rev() {
        above += count_of_ink[usize::from(ink)];
        if above * 10 >= inked && above > 0 {
            return ink;
        }
    }
    0
}

/// Share of texels with at least so much ink, `0.0 ..= 1.0`.
pub fn share_at_least(ink: &[u8], threshold: u8) -> f64 {
    count(ink, |ink| ink >= threshold) as f64 / ink.len().max(1) as f64
}
