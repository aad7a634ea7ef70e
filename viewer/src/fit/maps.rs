//! Maps that are smaller than a preset's own.

use tam_gen::Preset;
use tam_gen::preset::Tones;

/// Sides below which maps are not tried: their strokes are few, and repeat within sight.
const LEAST_PX: u32 = 64;
/// Counts of tones that are tried.
const TONES: [u32; 9] = [2, 3, 4, 5, 6, 8, 10, 12, 16];

/// What of a map is trimmed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
pub struct FitMap {
    /// Side of the finest level, in texels.
    pub size: u32,
    /// Columns.
    pub tones: u32,
    /// Side of the coarsest level, in texels.
    pub coarsest: u32,
}

impl FitMap {
    /// What a preset asks for.
    pub fn of(preset: &Preset) -> Self {
        let map = &preset.map;
        Self { size: map.size, tones: map.tones.count() as u32, coarsest: map.coarsest.min(map.size) }
    }

    /// The preset trimmed to this; its tones stay where their number is the same.
    pub fn preset(&self, preset: &Preset) -> Preset {
        let mut trimmed = preset.clone();
        (trimmed.map.size, trimmed.map.coarsest) = (self.size, self.coarsest);
        if self.tones != preset.map.tones.count() as u32 {
            trimmed.map.tones = Tones::Count(self.tones);
        }
        trimmed
    }

    /// Texels of all levels and columns.
    pub fn texels(&self) -> u64 {
        let levels = std::iter::successors(Some(self.size), |side| (*side > self.coarsest).then_some(side / 2));
        levels.map(|side| u64::from(side) * u64::from(side)).sum::<u64>() * u64::from(self.tones)
    }
}

/// All maps no larger than a preset's own that are worth trying, the smallest first. Methods that make columns of their
/// own, or have none, are given the preset's.
pub fn smaller(preset: &Preset, mixes_columns: bool) -> Vec<FitMap> {
    let whole = FitMap::of(preset);
    let sizes = std::iter::successors(Some(whole.size), |side| (side / 2 >= LEAST_PX).then_some(side / 2));
    let counts = |of: &u32| mixes_columns && *of < whole.tones;
    let mut maps: Vec<FitMap> = sizes
        .flat_map(|size| {
            let tones = TONES.into_iter().filter(counts).chain([whole.tones]);
            tones.map(move |tones| FitMap { size, tones, coarsest: whole.coarsest.min(size) })
        })
        .collect();
    maps.sort_by_key(|map| (map.texels(), map.size));
    maps
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_are_tried_from_the_smallest_to_the_whole_one() {
        let preset = Preset::default();
        let whole = FitMap::of(&preset);
        let maps = smaller(&preset, true);
        assert!(maps.is_sorted_by_key(FitMap::texels));
        assert_eq!(maps.last(), Some(&whole));
        assert!(maps.iter().all(|map| map.preset(&preset).validate().is_empty()));
        assert!(smaller(&preset, false).iter().all(|map| map.tones == whole.tones));
        assert_eq!(whole.preset(&preset), preset, "untrimmed is untouched");
    }
}
