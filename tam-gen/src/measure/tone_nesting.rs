//! Whether a darker column keeps all the ink of a lighter one.

use super::count::count_pairs;

/// Texels at which a darker column has less ink than the lighter column before it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ToneNesting {
    /// Share of texels that are lighter by any amount, `0.0 ..= 1.0`.
    pub any: f64,
    /// Share of texels that are lighter by more than 16/255: what an eye can find.
    pub visible: f64,
    /// Largest loss of ink, `0 ..= 255`.
    pub worst: u8,
}

/// Compares two cells of one level, given as ink of equal size.
pub fn tone_nesting(lighter: &[u8], darker: &[u8]) -> ToneNesting {
    let texels = lighter.len().max(1) as f64;
    let share = |of: usize| of as f64 / texels;
    let any = count_pairs(lighter, darker, |before, after| before > after);
    if any == 0 {
        return ToneNesting::default();
    }
    let loss = |before: u8, after: u8| before.saturating_sub(after);
    let visible = count_pairs(lighter, darker, |before, after| loss(before, after) > 16);
    let worst = lighter.iter().zip(darker).map(|(before, after)| loss(*before, *after)).max().unwrap_or(0);
    ToneNesting { any: share(any), visible: share(visible), worst }
}

/// The texels that [`tone_nesting`] counts.
pub fn lighter_than_before(lighter: &[u8], darker: &[u8]) -> Vec<bool> {
    lighter.iter().zip(darker).map(|(before, after)| before > after).collect()
}
