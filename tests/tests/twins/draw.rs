//! Inputs by counters: the same on every machine and in any order.

use glam::{DVec2, DVec3, DVec4};

use crate::gpu::SIDE;

/// What one fragment is given: four vectors of 32-bit numbers.
pub(crate) type Case = [DVec4; 4];

/// The numbers of one fragment.
#[derive(Clone, Copy)]
pub(crate) struct Draw {
    key: u64,
    /// Pixel, by rows.
    pub(crate) index: usize,
}

/// Slots below this hold the same number for the four fragments of a quad.
pub(crate) const OWN: u64 = 1000;

impl Draw {
    /// Numbers for the pixel `index` of a run.
    pub(crate) fn new(name: &str, seed: u64, index: usize) -> Self {
        let key = name.bytes().fold(seed, |key, byte| mixed(key ^ u64::from(byte)));
        Self { key, index }
    }

    /// Place in the quad.
    pub(crate) fn lane(&self) -> usize {
        let (x, y) = self.place();
        x % 2 + y % 2 * 2
    }

    fn place(&self) -> (usize, usize) {
        (self.index % SIDE as usize, self.index / SIDE as usize)
    }

    /// Whole number below `below`. Slots from [`OWN`] on differ from fragment to fragment.
    pub(crate) fn pick(&self, slot: u64, below: usize) -> usize {
        (self.unit(slot) * below as f64) as usize
    }

    /// Uniform in `0.0 .. 1.0`, a 32-bit number.
    pub(crate) fn unit(&self, slot: u64) -> f64 {
        let (x, y) = self.place();
        let counter = if slot >= OWN { self.index } else { (y / 2) * SIDE as usize + x / 2 };
        let bits = mixed(mixed(self.key ^ slot.wrapping_mul(0x9e37_79b9)) ^ counter as u64);
        (bits >> 40) as f64 / (1_u64 << 24) as f64
    }

    /// Uniform in `low .. high`, rounded to 32 bits.
    pub(crate) fn between(&self, slot: u64, low: f64, high: f64) -> f64 {
        single(low + (high - low) * self.unit(slot))
    }

    /// Evenly spread over orders of magnitude.
    pub(crate) fn scale(&self, slot: u64, low: f64, high: f64) -> f64 {
        single(low * (high / low).powf(self.unit(slot)))
    }

    /// In a box around the origin.
    pub(crate) fn place_within(&self, slot: u64, half: f64) -> DVec3 {
        DVec3::from([0, 1, 2].map(|i| self.between(slot + i, -half, half)))
    }

    /// In a square of tiles around the origin.
    pub(crate) fn tile(&self, slot: u64, half: f64) -> DVec2 {
        DVec2::from([0, 1].map(|i| self.between(slot + i, -half, half)))
    }

    /// Unit to 32 bits. One in four is an axis, one of the directions of [`LIGHT`](crate::setting::LIGHT), one across it, or
    /// within 1e-4 of one of these.
    pub(crate) fn direction(&self, slot: u64) -> DVec3 {
        let z = self.between(slot, -1.0, 1.0);
        let (sin, cos) = (std::f64::consts::TAU * self.unit(slot + 1)).sin_cos();
        let r = (1.0 - z * z).sqrt();
        let anywhere = DVec3::new(r * cos, r * sin, z);
        let light = DVec3::from(crate::setting::LIGHT);
        let across = light.any_orthonormal_vector();
        let special = [DVec3::X, DVec3::Y, DVec3::Z, -DVec3::Y, -DVec3::Z, light, -light, across];
        let chosen = match self.pick(slot + 2, 8) {
            0 => special[self.pick(slot + 3, special.len())],
            1 => (special[self.pick(slot + 3, special.len())] + 1e-4 * anywhere).normalize(),
            _ => anywhere,
        };
        DVec3::from(chosen.to_array().map(single))
    }

    /// In `0.0 ..= 1.0`. One in four is an end, half, a tone of a column, or the number before or after it.
    pub(crate) fn tone(&self, slot: u64) -> f64 {
        if self.pick(slot + 1, 4) > 0 {
            return self.unit(slot);
        }
        let special = [0.0, 1.0, 0.5, 1e-7, 1.0 - 1e-6];
        let tones = crate::setting::TONES;
        let i = self.pick(slot + 2, special.len() + 3 * tones.len());
        if i < special.len() {
            return single(special[i]);
        }
        let tone = tones[(i - special.len()) / 3];
        f64::from([tone.next_down(), tone, tone.next_up()][(i - special.len()) % 3].clamp(0.0, 1.0))
    }
}

/// The nearest 32-bit number.
pub(crate) fn single(number: f64) -> f64 {
    f64::from(number as f32)
}

/// `splitmix64`'s finaliser.
fn mixed(mut z: u64) -> u64 {
    z = z.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ z >> 31
}
