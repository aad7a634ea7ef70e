//! The maps that ways are drawn with, in several sizes and counts of tones.

use std::collections::BTreeMap;
use std::sync::Arc;

use tam_gen::preset::Tones;
use tam_gen::{GenerateError, Job, Preset};

use crate::maps::HatchMap;

/// Size and tones of a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
pub struct MapChoice {
    /// Side of its finest level, in texels.
    pub size: u32,
    /// Its columns.
    pub tones: u32,
}

/// A map, and what tells the direction of its strokes.
#[derive(Clone, Debug)]
pub struct Maps {
    /// Size and tones.
    pub choice: MapChoice,
    /// The map itself.
    pub whole: Arc<HatchMap>,
    /// The strokes of its first family alone, along u: direction and length of crossing strokes mean nothing. The map
    /// itself where it has no preset.
    pub single: Arc<HatchMap>,
}

impl Maps {
    /// The map of a preset in another size, and with another count of tones where one is given.
    ///
    /// # Errors
    /// [`GenerateError`]: the preset cannot be generated so, or the job was cancelled.
    pub fn generate(
        name: &str,
        preset: &Preset,
        size: u32,
        tones: Option<u32>,
        job: &Job<'_>,
    ) -> Result<Self, GenerateError> {
        let mut preset = preset.clone();
        preset.map.size = size;
        preset.map.coarsest = preset.map.coarsest.min(size);
        if let Some(tones) = tones {
            preset.map.tones = Tones::Count(tones);
        }
        let whole = HatchMap::from_preset(name, &preset, job)?;
        let single = HatchMap::from_preset(name, &one_family(&preset), job)?;
        let choice = MapChoice { size, tones: whole.grid.columns() as u32 };
        Ok(Self { choice, whole: Arc::new(whole), single: Arc::new(single) })
    }

    /// A map as it is.
    pub fn of(map: HatchMap) -> Self {
        let size = map.grid.levels.first().map_or(0, |level| level.size);
        let choice = MapChoice { size, tones: map.grid.columns() as u32 };
        let whole = Arc::new(map);
        Self { choice, single: Arc::clone(&whole), whole }
    }
}

/// A preset with the strokes of its first scheduled family only, along u.
pub fn one_family(preset: &Preset) -> Preset {
    let mut preset = preset.clone();
    let Some(first) = preset.scheduled(0).next().map(str::to_owned) else { return preset };
    preset.schedule = vec![first.clone()];
    preset.families = BTreeMap::from_iter(preset.families.remove(&first).map(|mut family| {
        family.angle_deg = 0.0;
        (first, family)
    }));
    preset
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_family_is_left_and_lies_along_u() {
        let single = one_family(&Preset::default());
        assert!(single.validate().is_empty(), "{:?}", single.validate());
        assert_eq!(single.families.len(), 1);
        assert!(single.families.values().all(|family| family.angle_deg == 0.0));
        let map = Maps::generate("test", &Preset::default(), 64, Some(3), &Job::default()).expect("a valid preset");
        assert_eq!(map.choice, MapChoice { size: 64, tones: 3 });
        assert_eq!(map.single.grid.levels[0].size, 64);
    }
}
