//! Whether the strokes of a level are kept by the next finer one, judged on pixels alone.
//!
//! Strokes keep their width in texels, so they are twice as wide in uv one level up: that the fine texels under a dark
//! coarse texel are dark cannot be asked. What can: a coarse texel of at least half ink holds the middle of a stroke, and
//! the same stroke passes through the 4x4 finer texels centred on the coarse texel's four children.

/// What became of the inked texels of a coarse image in the next finer one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct LevelNesting {
    /// Coarse texels of at least half ink.
    pub inked: usize,
    /// Those of them without a stroke in the finer image.
    pub lost: usize,
    /// The same against the finer image rolled by half a tile and a few texels: what unrelated images would lose.
    pub lost_by_chance: usize,
}

impl LevelNesting {
    /// Share of inked coarse texels without a finer stroke, `0.0 ..= 1.0`.
    pub fn share(&self) -> f64 {
        self.lost as f64 / self.inked.max(1) as f64
    }

    /// The same share for unrelated images, `0.0 ..= 1.0`.
    pub fn control(&self) -> f64 {
        self.lost_by_chance as f64 / self.inked.max(1) as f64
    }
}

/// Slack of the finer level's threshold, for ink rounded at every stroke that passes a texel.
const ROUNDING: u8 = 2;

/// Compares a coarse image with the next finer one of twice its side.
///
/// `half_ink` is half the ink of a fully covered texel, the same for both (see [`super::full_ink`]); 128 for solid ink.
/// Accuracy: correctly nested maps lose up to a few per cent of `control`, where several thin edges add up to half ink.
///
/// # Panics
///
/// If the finer image has not twice the side of the coarse one.
pub fn level_nesting(coarse: &[u8], coarse_size: u32, fine: &[u8], half_ink: u8) -> LevelNesting {
    let fine_size = fine_size(coarse, coarse_size, fine);
    let roll = (fine_size / 2 + 3, fine_size / 2 + 5);
    let mut nesting = LevelNesting::default();
    for (index, _) in coarse.iter().enumerate().filter(|(_, ink)| **ink >= half_ink.max(1)) {
        nesting.inked += 1;
        nesting.lost += usize::from(is_lost(index, coarse_size, fine, half_ink, (0, 0)));
        nesting.lost_by_chance += usize::from(is_lost(index, coarse_size, fine, half_ink, roll));
    }
    nesting
}

/// The texels of the coarse image that [`level_nesting`] counts as lost.
///
/// # Panics
///
/// If the finer image has not twice the side of the coarse one.
pub fn lost_texels(coarse: &[u8], coarse_size: u32, fine: &[u8], half_ink: u8) -> Vec<bool> {
    fine_size(coarse, coarse_size, fine);
    let lost =
        |(index, ink): (usize, &u8)| *ink >= half_ink.max(1) && is_lost(index, coarse_size, fine, half_ink, (0, 0));
    coarse.iter().enumerate().map(lost).collect()
}

fn fine_size(coarse: &[u8], coarse_size: u32, fine: &[u8]) -> u32 {
    assert_eq!(fine.len(), 4 * coarse.len(), "the finer image must have twice the side of the coarse one");
    2 * coarse_size
}

fn is_lost(index: usize, coarse_size: u32, fine: &[u8], half_ink: u8, roll: (u32, u32)) -> bool {
    let fine_size = 2 * coarse_size as usize;
    let (x, y) = (index % coarse_size as usize, index / coarse_size as usize);
    let enough = half_ink.saturating_sub(ROUNDING).max(1);
    // One texel before the children, kept positive by a whole tile.
    let (left, top) = (2 * x + fine_size - 1 + roll.0 as usize, 2 * y + fine_size - 1 + roll.1 as usize);
    (0..4).all(|dy| {
        let row = (top + dy) % fine_size * fine_size;
        (0..4).all(|dx| fine[row + (left + dx) % fine_size] < enough)
    })
}
