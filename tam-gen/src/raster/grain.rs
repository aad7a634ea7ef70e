//! The tooth of the paper: what it withholds of every stroke, the same at the same texel, so that overlapping strokes fill
//! it gradually.

use super::Footprint;

/// Largest side of a grain tile; larger levels repeat it, unnoticeably at the scale of a texel.
const TILE: u32 = 256;

/// The grain of one level.
#[derive(Debug, Clone, Default)]
pub struct Grain {
    /// Part of the ink that stays, of 255, per texel of the tile; empty without grain.
    stays: Vec<u8>,
    tile_mask: u32,
    size_shift: u32,
}

impl Grain {
    /// The grain of a level. `amount` is the largest part of the ink that is withheld, `0.0 ..= 0.9`.
    pub fn new(amount: f32, size: u32, seed: u64) -> Self {
        if amount <= 0.0 {
            return Self::default();
        }
        let tile = size.min(TILE);
        let heights: Vec<f32> = (0..tile * tile)
            .map(|texel| hash(seed, texel & (tile - 1), texel / tile) as f32 / u32::MAX as f32)
            .collect();
        let height = |x: u32, y: u32| heights[((y & (tile - 1)) * tile + (x & (tile - 1))) as usize];
        let stays = (0..tile * tile)
            .map(|texel| {
                let (x, y) = (texel & (tile - 1), texel / tile);
                // A small tent blur gives the tooth a size of about two texels; the contrast lost is put back.
                let mut sum = 4.0 * height(x, y);
                for (dx, dy) in [(1, 0), (tile - 1, 0), (0, 1), (0, tile - 1)] {
                    sum += 1.5 * height(x + dx, y + dy);
                }
                let tooth = ((sum / 10.0 - 0.5) * 2.2 + 0.5).clamp(0.0, 1.0);
                (255.0 * (1.0 - amount * tooth) + 0.5) as u8
            })
            .collect();
        Self { stays, tile_mask: tile - 1, size_shift: size.ilog2() }
    }

    /// Takes away what the tooth withholds.
    pub(super) fn withhold(&self, footprint: &mut Footprint) {
        if self.stays.is_empty() {
            return;
        }
        let tile_shift = (self.tile_mask + 1).ilog2();
        let covers_level = tile_shift == self.size_shift;
        for (texel, ink) in footprint.texel.iter().zip(&mut footprint.ink) {
            let texel = if covers_level {
                *texel
            } else {
                let (x, y) = (texel & ((1 << self.size_shift) - 1), texel >> self.size_shift);
                ((y & self.tile_mask) << tile_shift) | (x & self.tile_mask)
            };
            let product = u32::from(*ink) * u32::from(self.stays[texel as usize]) + 128;
            *ink = ((product + (product >> 8)) >> 8) as u8;
        }
    }
}

/// A well-mixed hash of a texel (the finaliser of MurmurHash3 over its packed coordinates).
fn hash(seed: u64, x: u32, y: u32) -> u32 {
    let mut h = seed ^ (u64::from(y) << 32 | u64::from(x)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    h = (h ^ (h >> 33)).wrapping_mul(0xff51_afd7_ed55_8ccd);
    h = (h ^ (h >> 33)).wrapping_mul(0xc4ce_b9fe_1a85_ec53);
    ((h ^ (h >> 33)) >> 32) as u32
}
