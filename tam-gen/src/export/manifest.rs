//! The manifest: what lies in the other files, for programs and people who cannot read those.

use serde::{Deserialize, Serialize};

use crate::job::Job;
use crate::map::{Deficit, Map};
use crate::preset::{Preset, ToneMeasure};

/// The content of `NAME.json`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// The name that the files begin with.
    pub name: String,
    /// Version of the generator.
    pub version: String,
    /// Seed of the preset; with the preset and the version it decides every byte.
    pub seed: u64,
    /// Wanted darkness of each column, lightest first, `0.0 ..= 1.0`.
    pub tones: Vec<f64>,
    /// How many of the levels were drawn; the others are box-filtered from the coarsest of these.
    pub hand_built: usize,
    /// The levels, finest first.
    pub levels: Vec<ManifestLevel>,
    /// The families by name, in the order of [`ManifestLevel::strokes`].
    pub families: Vec<String>,
    /// Cells whose tone could not be reached.
    pub deficits: Vec<Deficit>,
    /// Share of samples whose filtered threshold is at most `i / (entries - 1)`, per half level of the stroke map.
    pub stroke_map_distribution: Vec<Vec<f32>>,
    /// The files written together with this one.
    pub files: Vec<ManifestFile>,
    /// The preset as it is written by hand.
    pub preset_toml: String,
    /// The preset.
    pub preset: Preset,
}

/// One level in a manifest.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ManifestLevel {
    /// Side in texels.
    pub size: u32,
    /// Tone of each column as measured on the finished texels.
    pub measured: Vec<f64>,
    /// For each column the strokes of each family, the closing stroke counted by its fraction; empty in the tail.
    pub strokes: Vec<Vec<f64>>,
}

/// One file in a manifest.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ManifestFile {
    /// Path relative to the manifest, with `/` between its parts.
    pub path: String,
    /// Size in bytes.
    pub bytes: u64,
    /// What it is.
    pub what: String,
}

impl Manifest {
    /// The manifest of a map; tones are measured as the job says, else as the preset says.
    pub fn new(map: &Map, name: &str, preset_toml: String, files: Vec<ManifestFile>, job: &Job<'_>) -> Self {
        let named = ToneMeasure::named(map.preset.map.tone_measure);
        let measure = job.measure.unwrap_or(&named);
        let levels = map.grid.levels.iter().enumerate().map(|(level, images)| ManifestLevel {
            size: images.size,
            measured: images.cells.iter().map(|ink| measure.tone(ink)).collect(),
            strokes: stroke_counts(map, level),
        });
        Self {
            name: name.into(),
            version: crate::export::VERSION.into(),
            seed: map.preset.seed,
            tones: map.grid.tones.clone(),
            hand_built: map.grid.hand_built,
            levels: levels.collect(),
            families: map.strokes.families.iter().map(|family| family.name.clone()).collect(),
            deficits: map.deficits.clone(),
            stroke_map_distribution: map.stroke_map.distribution.clone(),
            files,
            preset_toml,
            preset: map.preset.clone(),
        }
    }
}

fn stroke_counts(map: &Map, level: usize) -> Vec<Vec<f64>> {
    let strokes = &map.strokes;
    if level >= map.grid.hand_built || level >= strokes.first_column.len() || level >= strokes.closing.len() {
        return Vec::new();
    }
    let columns = map.grid.columns().min(strokes.closing[level].len());
    let count = |column, family| strokes.count(level, column, family as u16);
    (0..columns).map(|column| (0..strokes.families.len()).map(|family| count(column, family)).collect()).collect()
}
