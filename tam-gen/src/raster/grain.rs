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
        let heights = heights(seed, tile);
        let side = tile as usize;
        let row = |y: usize| &heights[(y & (side - 1)) * side..][..side];
        // A small tent blur gives the tooth a size of about two texels. Contrast lost to it is put back; then heights of
        // 0 ..= 1 become parts of the ink.
        let stays_of = |[left, here, right]: [u16; 3], above: u16, below: u16| {
            let [left, here, right, above, below] = [left, here, right, above, below].map(i32::from);
            let tooth = 4 * here + (3 * (left + right + above + below)) / 2;
            let tooth = ((tooth as f32 / (10.0 * 65535.0) - 0.5) * 2.2 + 0.5).clamp(0.0, 1.0);
            (255.0 * (1.0 - amount * tooth) + 0.5) as i32 as u8
        };
        let mut stays = vec![0; side * side];
        for (y, stays) in stays.chunks_exact_mut(side).enumerate() {
            let (above, here, below) = (row(y + side - 1), row(y), row(y + 1));
            let inner = here.windows(3).zip(&above[1..]).zip(&below[1..]);
            for (stays, ((here, above), below)) in stays[1..].iter_mut().zip(inner) {
                *stays = stays_of([here[0], here[1], here[2]], *above, *below);
            }
            let last = side - 1;
            stays[0] = stays_of([here[last], here[0], here[1]], above[0], below[0]);
            stays[last] = stays_of([here[last - 1], here[last], here[0]], above[last], below[last]);
        }
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

/// White noise on a tile, four heights from each hash.
fn heights(seed: u64, tile: u32) -> Vec<u16> {
    let quads = u64::from(tile) * u64::from(tile) / 4;
    let mut heights = Vec::with_capacity(4 * quads as usize);
    for quad in 0..quads {
        let hash = hash(seed, (u64::from(tile) << 32) | quad);
        heights.extend([hash as u16, (hash >> 16) as u16, (hash >> 32) as u16, (hash >> 48) as u16]);
    }
    heights
}

/// A well-mixed hash of a counter (the finaliser of MurmurHash3).
fn hash(seed: u64, counter: u64) -> u64 {
    let mut h = seed ^ counter.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    h = (h ^ (h >> 33)).wrapping_mul(0xff51_afd7_ed55_8ccd);
    h = (h ^ (h >> 33)).wrapping_mul(0xc4ce_b9fe_1a85_ec53);
    h ^ (h >> 33)
}
