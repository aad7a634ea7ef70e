//! Presets whose strokes have more texels: the same strokes, for pictures that are larger than what they show.

use super::{Preset, Range};

impl Preset {
    /// How many times as many texels strokes can have to serve pictures so many times as large: a power of two, 1 at least,
    /// and as much as sizes and widths may be.
    pub fn texels_for(&self, times: f64) -> u32 {
        let room = |table: &str, key: &str, own: f64| Range::find(table, key).map_or(1.0, |range| range.max / own);
        let widths = self.families.values().filter_map(|family| family.width_px).chain([self.stroke.width_px]);
        let widest = widths.map(|width| room("stroke", "width_px", width)).fold(f64::MAX, f64::min);
        let most = widest.min(room("map", "size", self.map.size.into()));
        let mut texels = 1;
        while f64::from(texels) < times && f64::from(texels * 2) <= most {
            texels *= 2;
        }
        texels
    }

    /// The preset with so many times as many texels, and strokes as many times as wide.
    #[must_use]
    pub fn with_texels(&self, texels: u32) -> Self {
        let mut finer = self.clone();
        finer.map.size *= texels;
        finer.map.coarsest *= texels;
        finer.stroke.width_px *= f64::from(texels);
        finer.families.values_mut().for_each(|family| {
            family.width_px = family.width_px.map(|width| width * f64::from(texels));
        });
        finer
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Job, generate, generate_finer};

    #[test]
    fn presets_stay_valid_and_become_as_fine_as_they_may() {
        for (name, _) in Preset::embedded() {
            let preset = Preset::named(name).expect("shipped").expect("valid");
            assert_eq!((preset.texels_for(0.5), preset.texels_for(1.0)), (1, 1));
            for times in [2.0, 3.0, 1000.0] {
                let texels = preset.texels_for(times);
                let finer = preset.with_texels(texels);
                assert!(texels >= 2 && finer.validate().is_empty(), "{name} {texels}: {:?}", finer.validate());
                assert_eq!(finer.map.size, preset.map.size * texels);
            }
        }
    }

    #[test]
    fn a_finer_map_has_the_same_strokes() {
        for name in ["pencil", "stipple", "brush"] {
            let mut preset = Preset::named(name).expect("shipped").expect("valid");
            (preset.map.size, preset.map.coarsest) = (128, 32);
            let own = generate(&preset, &Job::default()).expect("a map");
            let finer = generate_finer(&preset, 2, &Job::default()).expect("a map");
            for family in 0..preset.families.len() as u16 {
                let of = |map: &crate::Map| {
                    let strokes = map.strokes.strokes.iter().filter(|stroke| stroke.family == family);
                    strokes.copied().collect::<Vec<_>>()
                };
                let (own, finer) = (of(&own), of(&finer));
                let same = own.iter().zip(&finer).filter(|(a, b)| {
                    let places = (a.start_uv, a.along_uv, a.across_uv) == (b.start_uv, b.along_uv, b.across_uv);
                    places && (2.0 * a.width_px - b.width_px).abs() < 1e-4
                });
                assert_eq!(same.count(), own.len().min(finer.len()), "{name}");
                assert!(own.len().abs_diff(finer.len()) * 10 < own.len().max(10), "{name}");
            }
            // Texels of the finer map in fours are those of the map itself, but for soft edges.
            let (level, half) = (&finer.grid.levels[0], own.grid.levels[0].size as usize);
            for (cell, wanted) in level.cells.iter().zip(&own.grid.levels[0].cells) {
                let four = |i: usize| {
                    let (x, y) = (i % half * 2, i / half * 2);
                    let at = |x: usize, y: usize| f64::from(cell[y * 2 * half + x]);
                    (at(x, y) + at(x + 1, y) + at(x, y + 1) + at(x + 1, y + 1)) / 4.0
                };
                let apart: f64 = (0..half * half).map(|i| (four(i) - f64::from(wanted[i])).abs()).sum();
                let apart = apart / (half * half) as f64;
                assert!(apart < 16.0, "{name}: {apart}");
            }
        }
    }
}
