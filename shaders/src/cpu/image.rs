//! A map as a texture array, sampled as WebGPU samples it: `textureSampleLevel` with linear filters and repeated edges.

use glam::{DVec2, DVec4};

/// Levels of a texture array of 8-bit unorm texels.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MapImage {
    /// Finest first, each half the size of the one before.
    pub levels: Vec<MapLevel>,
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
        let here = self.levels[finer].sample(uv, layer);
        if share == 0.0 { here } else { here.lerp(self.levels[(finer + 1).min(last)].sample(uv, layer), share) }
    }
}

impl MapLevel {
    /// Bilinear sample; the middle of texel `i` is at `(i + 0.5) / size`.
    fn sample(&self, uv: DVec2, layer: i32) -> DVec4 {
        let texels = &self.layers[layer.clamp(0, self.layers.len() as i32 - 1) as usize];
        let place = uv * f64::from(self.size) - 0.5;
        let corner = place.floor();
        let share = place - corner;
        let size = self.size as usize;
        let wrap = |i: f64| i.rem_euclid(f64::from(self.size)) as usize % size;
        let (left, right) = (wrap(corner.x), wrap(corner.x + 1.0));
        let (top, bottom) = (wrap(corner.y), wrap(corner.y + 1.0));
        let at = |x: usize, y: usize| DVec4::from(texels[y * size + x].map(|channel| f64::from(channel) / 255.0));
        let above = at(left, top).lerp(at(right, top), share.x);
        let below = at(left, bottom).lerp(at(right, bottom), share.x);
        above.lerp(below, share.y)
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
}
