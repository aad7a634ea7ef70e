//! Maps as methods take them: from a preset, or from files.

mod tone_table;

use std::sync::OnceLock;

use tam_gen::import::Imported;
use tam_gen::map::ThresholdLevel;
use tam_gen::preset::Tones;
use tam_gen::{GenerateError, Grid, Job, Preset, StrokeMap};

pub use tone_table::tone_table;

/// Columns of the array that `fine-tone` draws with (Webb and others 2002).
pub const FINE_COLUMNS: u32 = 64;

/// A hatching map with what the methods make of it.
#[derive(Debug)]
pub struct HatchMap {
    /// The preset's name or the file's stem.
    pub name: String,
    /// The tonal art map, with a full chain of levels.
    pub grid: Grid,
    /// The stroke map, where there is one.
    pub stroke_map: Option<StrokeMap>,
    /// What it was made from, where that is known.
    pub preset: Option<Preset>,
    /// How many times as many texels its strokes have as the preset says.
    pub texels: u32,
    fine: OnceLock<Grid>,
}

impl HatchMap {
    /// Generates the map of a preset.
    ///
    /// # Errors
    /// [`GenerateError`]: an invalid preset, or cancelled.
    pub fn from_preset(name: &str, preset: &Preset, job: &Job<'_>) -> Result<Self, GenerateError> {
        let map = tam_gen::generate(preset, job)?;
        Ok(Self::new(name, map.grid, Some(map.stroke_map), Some(preset.clone())))
    }

    /// The same strokes with so many times as many texels; see [`Preset::texels_for`].
    ///
    /// # Errors
    /// As [`HatchMap::from_preset`].
    pub fn finer(name: &str, preset: &Preset, texels: u32, job: &Job<'_>) -> Result<Self, GenerateError> {
        let map = tam_gen::generate_finer(preset, texels, job)?;
        Ok(Self { texels, ..Self::new(name, map.grid, Some(map.stroke_map), Some(preset.clone())) })
    }

    /// A map that was generated already.
    pub fn from_map(name: &str, map: &tam_gen::Map) -> Self {
        Self::new(name, map.grid.clone(), Some(map.stroke_map.clone()), Some(map.preset.clone()))
    }

    /// A map that was read from files. Where they hold their preset, it serves to make finer tones.
    pub fn from_import(name: &str, imported: Imported) -> Self {
        let preset = imported.preset_toml.and_then(|toml| Preset::from_toml(&toml, name).ok());
        Self::new(name, imported.grid, imported.stroke_map, preset)
    }

    fn new(name: &str, mut grid: Grid, stroke_map: Option<StrokeMap>, preset: Option<Preset>) -> Self {
        grid.append_tail();
        Self { name: name.to_owned(), grid, stroke_map, preset, texels: 1, fine: OnceLock::new() }
    }

    /// The array of many columns: made from the preset with the same sequences, or else the map's own columns.
    ///
    /// # Errors
    /// [`GenerateError`], where the preset cannot be generated.
    pub fn fine(&self) -> Result<&Grid, GenerateError> {
        self.fine_with(&Job::default())
    }

    /// Whether they are there already.
    #[cfg(feature = "app")]
    pub(crate) fn has_fine(&self) -> bool {
        self.fine.get().is_some()
    }

    /// The same, followed and stopped by a job where it has to be made first.
    ///
    /// # Errors
    /// [`GenerateError`]: the preset cannot be generated, or cancelled.
    pub fn fine_with(&self, job: &Job<'_>) -> Result<&Grid, GenerateError> {
        if let Some(fine) = self.fine.get() {
            return Ok(fine);
        }
        let Some(preset) = self.preset.as_ref().filter(|_| self.grid.columns() < FINE_COLUMNS as usize) else {
            return Ok(&self.grid);
        };
        let mut preset = preset.clone();
        preset.map.tones = Tones::Count(FINE_COLUMNS);
        let mut grid = tam_gen::generate_finer(&preset, self.texels, job)?.grid;
        grid.append_tail();
        Ok(self.fine.get_or_init(|| grid))
    }

    /// The columns that `six-way` blends: all, where there are six at most, else six of them, evenly chosen, the darkest
    /// included.
    pub fn six_columns(&self) -> Vec<usize> {
        let columns = self.grid.columns();
        if columns <= 6 { (0..columns).collect() } else { (1..=6).map(|k| k * columns / 6 - 1).collect() }
    }
}

/// Levels of a stroke map as they are drawn with, finest first: the side, and of each texel its threshold and how much it
/// changes, see [`threshold_steps`].
pub(crate) fn stroke_texels(map: &StrokeMap) -> Vec<(u32, Vec<u8>)> {
    let texels = |level: &ThresholdLevel| {
        let steps = threshold_steps(level.size, &level.threshold);
        level.threshold.iter().zip(steps).flat_map(|(threshold, step)| [*threshold, step]).collect()
    };
    map.levels.iter().map(|level| (level.size, texels(level))).collect()
}

/// How much thresholds change from texel to texel on the torus: the greater of the differences to the left and right,
/// and to above and below, as one length; 255 is a change by 1 or more.
pub(crate) fn threshold_steps(size: u32, thresholds: &[u8]) -> Vec<u8> {
    let size = size as usize;
    let at = |x: usize, y: usize| f64::from(thresholds[y % size * size + x % size]);
    let step = |texel: usize| {
        let (x, y) = (texel % size, texel / size);
        let here = at(x, y);
        let greater = |a: f64, b: f64| (a - here).abs().max((b - here).abs());
        let across = greater(at(x + size - 1, y), at(x + 1, y));
        let down = greater(at(x, y + size - 1), at(x, y + 1));
        across.hypot(down).min(255.0).round() as u8
    };
    (0..size * size).map(step).collect()
}
