//! Whether a darker column keeps all the ink of a lighter one.

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
    let (mut any, mut visible, mut worst) = (0_usize, 0_usize, 0);
    for (&before, &after) in lighter.iter().zip(darker) {
        let loss = before.saturating_sub(after);
        any += usize::from(loss > 0);
        visible += usize::from(loss > 16);
        worst = loss.max(worst);
    }
    let texels = lighter.len().max(1) as f64;
    ToneNesting { any: any as f64 / texels, visible: visible as f64 / texels, worst }
}

/// The texels that [`tone_nesting`] counts.
pub fn lighter_than_before(lighter: &[u8], darker: &[u8]) -> Vec<bool> {
    lighter.iter().zip(darker).map(|(before, after)| before > after).collect()
}
