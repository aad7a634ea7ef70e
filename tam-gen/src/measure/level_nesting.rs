//! Whether the strokes of a level are kept by the next finer one, judged on pixels alone.
//!
//! Strokes keep their width in texels, so they are twice as wide in uv one level up: that the fine texels under a dark
//! coarse texel are dark cannot be asked. What can: a coarse texel of at least half ink lies within half a width of the
//! middle of a stroke, and the same stroke passes through the finer texels around it: for strokes of up to two texels
//! the 4x4 centred on the coarse texel's four children, for wider ones so many more as they are wider.

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

/// How many finer texels to either side of a coarse texel's middle to look at, for strokes of a width in texels.
///
/// A coarse texel of half ink is up to half a coarse width, one fine width, from the middle of its stroke, of which the fine
/// stroke covers half a width; one texel more for the raster. 2, a window of 4x4, up to a width of 2.
pub fn level_nesting_reach(width_px: f64) -> u32 {
    (0.5 * width_px + 1.0).ceil().clamp(2.0, 64.0) as u32
}

/// Compares a coarse image with the next finer one of twice its side.
///
/// `reach` is that of [`level_nesting_reach`].
/// `half_ink` is half the ink of a fully covered texel, the same for both (see [`super::full_ink`]); 128 for solid ink.
/// Accuracy: correctly nested maps lose up to a few per cent of `control`, where several thin edges add up to half ink.
///
/// # Panics
///
/// If the finer image has not twice the side of the coarse one.
pub fn level_nesting(coarse: &[u8], coarse_size: u32, fine: &[u8], half_ink: u8, reach: u32) -> LevelNesting {
    let fine_size = fine_size(coarse, coarse_size, fine);
    let roll = (fine_size / 2 + 3, fine_size / 2 + 5);
    let mut nesting = LevelNesting::default();
    for (index, _) in coarse.iter().enumerate().filter(|(_, ink)| **ink >= half_ink.max(1)) {
        nesting.inked += 1;
        nesting.lost += usize::from(is_lost(index, coarse_size, fine, half_ink, reach, (0, 0)));
        nesting.lost_by_chance += usize::from(is_lost(index, coarse_size, fine, half_ink, reach, roll));
    }
    nesting
}

/// The texels of the coarse image that [`level_nesting`] counts as lost.
///
/// # Panics
///
/// If the finer image has not twice the side of the coarse one.
pub fn lost_texels(coarse: &[u8], coarse_size: u32, fine: &[u8], half_ink: u8, reach: u32) -> Vec<bool> {
    fine_size(coarse, coarse_size, fine);
    let lost = |(index, ink): (usize, &u8)| {
        *ink >= half_ink.max(1) && is_lost(index, coarse_size, fine, half_ink, reach, (0, 0))
    };
    coarse.iter().enumerate().map(lost).collect()
}

fn fine_size(coarse: &[u8], coarse_size: u32, fine: &[u8]) -> u32 {
    assert_eq!(fine.len(), 4 * coarse.len(), "the finer image must have twice the side of the coarse one");
    2 * coarse_size
}

fn is_lost(index: usize, coarse_size: u32, fine: &[u8], half_ink: u8, reach: u32, roll: (u32, u32)) -> bool {
    let fine_size = 2 * coarse_size as usize;
    let (x, y) = (index % coarse_size as usize, index / coarse_size as usize);
    let enough = half_ink.saturating_sub(ROUNDING).max(1);
    let reach = (reach as usize).min(fine_size / 2);
    // From the first child, kept positive by a whole tile.
    let (left, top) =
        (2 * x + 1 + fine_size - reach + roll.0 as usize, 2 * y + 1 + fine_size - reach + roll.1 as usize);
    let (left, top, across) = (left % fine_size, top % fine_size, 2 * reach);
    // Most windows lie within a row.
    let (within, wrapped) = (across.min(fine_size - left), across.saturating_sub(fine_size - left));
    (0..across).all(|dy| {
        let y = top + dy;
        let row = &fine[(if y < fine_size { y } else { y - fine_size }) * fine_size..][..fine_size];
        let bare = |texels: &[u8]| texels.iter().all(|ink| *ink < enough);
        bare(&row[left..left + within]) && bare(&row[..wrapped])
    })
}
