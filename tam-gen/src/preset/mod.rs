//! Presets: what a material is made of.

mod embedded;
mod finer;
mod options;
mod overrides;
mod parse;
mod place;
mod schema;
mod structure;
pub(crate) mod tip_source;
mod tones;
mod validate;
mod validate_stroke;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

pub use options::{
    FamilyOptions, MapOptions, PlacementMethod, PlacementOptions, RANGES, Range, SEED_MAX, StrokeOptions, TONE_COUNT,
    TipOptions,
};
pub use overrides::Overrides;
pub use parse::PRESET_BYTES_MAX;
pub use place::{Place, Step, Violation, nearest};
pub use schema::{schema, schema_text};
pub use tones::{MeasureName, ToneMeasure, Tones};

/// A material: everything that decides the bytes of its map.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Preset {
    /// What it looks like, in one line.
    pub description: String,
    /// Same preset, same seed, same bytes.
    #[schemars(range(min = 0, max = 9_223_372_036_854_775_807_i64))]
    pub seed: u64,
    /// For each column, lightest first, the families that it adds: `"h"`, or `"h v"` in turn. Stretched or squeezed to
    /// the number of tones.
    #[schemars(length(min = 1, max = 64))]
    pub schedule: Vec<String>,
    /// Size, tones and levels.
    pub map: MapOptions,
    /// How strokes find their places.
    pub placement: PlacementOptions,
    /// The strokes of all families.
    pub stroke: StrokeOptions,
    /// The families by name.
    pub families: BTreeMap<String, FamilyOptions>,
    /// Colours of paper and ink, for pictures.
    pub colours: Colours,
}

/// Colours of paper and ink as CSS writes them; exported maps hold luminance and leave colour to the engine.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Colours {
    /// Colour of the paper.
    pub paper: String,
    /// Colour of the ink.
    pub ink: String,
}

fn parsed(key: &str, css: &str) -> Result<csscolorparser::Color, String> {
    csscolorparser::parse(css).map_err(|error| format!("colours.{key} = \"{css}\" is no colour: {error}"))
}

impl Colours {
    /// Paper and ink in linear light.
    ///
    /// # Errors
    /// Which of the two is no colour, and why.
    pub fn linear(&self) -> Result<([f32; 3], [f32; 3]), String> {
        let linear = |colour: csscolorparser::Color| {
            let [r, g, b, _] = colour.to_linear_rgba();
            [r, g, b]
        };
        Ok((linear(parsed("paper", &self.paper)?), linear(parsed("ink", &self.ink)?)))
    }

    /// Paper and ink as sRGB.
    ///
    /// # Errors
    /// Which of the two is no colour, and why.
    pub fn srgb(&self) -> Result<([u8; 3], [u8; 3]), String> {
        let bytes = |colour: csscolorparser::Color| {
            let [r, g, b, _] = colour.to_rgba8();
            [r, g, b]
        };
        Ok((bytes(parsed("paper", &self.paper)?), bytes(parsed("ink", &self.ink)?)))
    }
}

impl Default for Colours {
    fn default() -> Self {
        Self { paper: "#ffffff".into(), ink: "#000000".into() }
    }
}

impl Default for Preset {
    /// Cross-hatching in two directions, as in Praun and others (2001), figure 2.
    fn default() -> Self {
        let family = |angle_deg| FamilyOptions { angle_deg, ..FamilyOptions::default() };
        Self {
            description: String::new(),
            seed: 1,
            schedule: ["h", "h", "h", "v", "v", "h v"].map(String::from).to_vec(),
            map: MapOptions::default(),
            placement: PlacementOptions::default(),
            stroke: StrokeOptions::default(),
            families: BTreeMap::from([("h".into(), family(0.0)), ("v".into(), family(90.0))]),
            colours: Colours::default(),
        }
    }
}

impl Preset {
    /// Number of hand-built levels, finest to coarsest.
    pub fn level_count(&self) -> usize {
        (self.map.size / self.map.coarsest).ilog2() as usize + 1
    }

    /// The names of the families that a column adds, in the order in which they take turns.
    pub fn scheduled(&self, column: usize) -> impl Iterator<Item = &str> {
        let entry = column * self.schedule.len() / self.map.tones.count().max(1);
        self.schedule[entry].split_whitespace()
    }
}
