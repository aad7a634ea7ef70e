//! A map as a texture array, sampled as WebGPU samples it: `textureSampleLevel` with linear filters and repeated edges.

use glam::{DVec2, DVec4};

/// Levels of a texture array of 8-bit unorm texels.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MapImage {
    /// Finest first, each half the size of the one before.
    pub levels: Vec<MapLevel>,
    /// How exactly they are sampled.
    pub sampling: Sampling,
}

/// How exactly texels are mixed; WebGPU leaves it to the adapter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sampling {
    /// As if in real numbers.
    #[default]
    Exact,
    /// Places in texels are rounded to 1/256, and what each of the three mixes gives to 1/255.
    EightBits,
}

impl Sampling {
    fn share(self, share: DVec2) -> DVec2 {
        match self {
            Self::Exact => share,
            Self::EightBits => (share * 256.0).round() / 256.0,
        }
    }

    fn mix(self, a: DVec4, b: DVec4, share: f64) -> DVec4 {
        let mixed = a.lerp(b, share);
        match self {
            Self::Exact => mixed,
            Self::EightBits => (mixed * 255.0).round() / 255.0,
        }
    }
}

/// One level of a [`MapImage`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MapLevel {
    /// Side in texels.
    pub size: u32,
    /// For each layer its texels by rows, 255 is 1.0. Channels that the texture lacks are 0, alpha is then 255.
    pub layers: Vec<Vec<[u8; 4]>>,
}

impl MapImage {
    /// Trilinear sample at tile coordinates. Level and layer are clamped to those that exist.
    ///
    /// # Panics
    /// If there is no level or no layer.
    pub fn sample_level(&self, uv: DVec2, layer: i32, level: f64) -> DVec4 {
        let last = self.levels.len() - 1;
        let level = level.clamp(0.0, last as f64);
        let finer = level.floor() as usize;
        let share = level - level.floor();
        let sample = |level: usize| self.levels[level].sample(uv, layer, self.sampling);
        let here = sample(finer);
        if share == 0.0 { here } else { self.sampling.mix(here, sample((finer + 1).min(last)), share) }
    }
}

impl MapLevel {
    /// Bilinear sample; the middle of texel `i` is at `(i + 0.5) / size`.
    fn sample(&self, uv: DVec2, layer: i32, sampling: Sampling) -> DVec4 {
        let texels = &self.layers[layer.clamp(0, self.layers.len() as i32 - 1) as usize];
        let place = uv * f64::from(self.size) - 0.5;
        let corner = place.floor();
        let share = sampling.share(place - corner);
        let size = self.size as usize;
        let wrap = |i: f64| i.rem_euclid(f64::from(self.size)) as usize % size;
        let (left, right) = (wrap(corner.x), wrap(corner.x + 1.0));
        let (top, bottom) = (wrap(corner.y), wrap(corner.y + 1.0));
        let at = |x: usize, y: usize| DVec4::from(texels[y * size + x].map(|channel| f64::from(channel) / 255.0));
        let above = sampling.mix(at(left, top), at(right, top), share.x);
        let below = sampling.mix(at(left, bottom), at(right, bottom), share.x);
        sampling.mix(above, below, share.y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn two_levels() -> MapImage {
        let grey = |inks: &[u8]| inks.iter().map(|ink| [*ink, 0, 0, 255]).collect();
        MapImage {
            levels: vec![
                MapLevel { size: 2, layers: vec![grey(&[0, 255, 51, 102])] },
                MapLevel { size: 1, layers: vec![grey(&[204])] },
            ],
            sampling: Sampling::Exact,
        }
    }

    fn ink(uv: [f64; 2], level: f64) -> f64 {
        two_levels().sample_level(uv.into(), 0, level).x
    }

    #[test]
    fn texel_middles_give_the_texels_and_edges_repeat() {
        assert_eq!(ink([0.25, 0.25], 0.0), 0.0);
        assert_eq!(ink([0.75, 0.25], 0.0), 1.0);
        assert_eq!(ink([-0.75, 3.75], 0.0), 0.2);
        // On the seam: half of the last column, half of the first.
        assert!((ink([1.0, 0.25], 0.0) - 0.5).abs() < 1e-12);
        assert!((ink([0.0, 0.25], 0.0) - 0.5).abs() < 1e-12);
    }

    #[test]
    fn levels_are_mixed_and_clamped() {
        assert!((ink([0.75, 0.25], 0.25) - (0.75 + 0.25 * 0.8)).abs() < 1e-12);
        assert_eq!(ink([0.75, 0.25], -3.0), 1.0);
        assert_eq!(ink([0.1, 0.3], 7.0), 0.8);
    }

    #[test]
    fn a_sampler_of_eight_bits_is_off_by_what_it_rounds() {
        let (exact, rounded) = (two_levels(), MapImage { sampling: Sampling::EightBits, ..two_levels() });
        let mut greatest: f64 = 0.0;
        for i in 0..1000 {
            let (uv, level) = (DVec2::new(0.0137, 0.0071) * f64::from(i), f64::from(i) / 999.0);
            let [exact, rounded] = [&exact, &rounded].map(|map| map.sample_level(uv, 0, level).x);
            greatest = greatest.max((exact - rounded).abs());
        }
        // Half a step of each place, and of each of three mixes.
        assert!((1.0 / 510.0..1.0 / 256.0 + 1.5 / 255.0).contains(&greatest), "{greatest}");
    }
}
