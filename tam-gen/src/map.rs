//! What a generation makes: the grid of images, the stroke map, and the strokes themselves.

use serde::{Deserialize, Serialize};

use crate::preset::{Preset, StrokeOptions};
use crate::sequence::Direction;
use crate::stroke::{Stroke, Taper};

/// A finished map with all that it was made from.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Map {
    /// The preset it was made from; preset and version decide every byte.
    pub preset: Preset,
    /// The tonal art map.
    pub grid: Grid,
    /// Freudenberg's composited map.
    pub stroke_map: StrokeMap,
    /// The strokes, and in which cells each is drawn.
    pub strokes: StrokeList,
    /// Cells whose tone could not be reached, with the reason.
    pub deficits: Vec<Deficit>,
}

/// A tonal art map: one image of ink per level and column.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Grid {
    /// Wanted darkness of each column, lightest first, `0.0 ..= 1.0`.
    pub tones: Vec<f64>,
    /// Levels, finest first, each half the size of the one before.
    pub levels: Vec<Level>,
    /// How many of the levels were drawn by hand; the others, the tail, are box-filtered from the coarsest of these.
    pub hand_built: usize,
}

/// One level of a grid.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Level {
    /// Side in texels.
    pub size: u32,
    /// For each column, lightest first, the ink of each texel by rows: 0 paper, 255 solid ink.
    pub cells: Vec<Vec<u8>>,
}

impl Grid {
    /// The levels that were drawn by hand, finest first.
    pub fn drawn(&self) -> &[Level] {
        &self.levels[..self.hand_built]
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.tones.len()
    }

    /// Appends box-filtered levels down to one texel, which keep the tone: textures want a full chain.
    pub fn append_tail(&mut self) {
        crate::tail::append(self);
    }
}

/// Freudenberg's stroke map: one channel, the levels of the grid, each texel the darkness at which it becomes inked.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StrokeMap {
    /// Levels, finest first (hand-built ones only: averaging thresholds would flip whole regions).
    pub levels: Vec<ThresholdLevel>,
    /// What bilinear filtering and blending of levels leave of the distribution of thresholds, per half level: rows for
    /// level 0, between 0 and 1, level 1, and so on. Entry `i` of a row is the share of samples whose filtered threshold
    /// is at most `i / (entries - 1)`, so looking a filtered threshold up keeps the tone.
    pub distribution: Vec<Vec<f32>>,
}

/// One level of a stroke map.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ThresholdLevel {
    /// Side in texels.
    pub size: u32,
    /// For each texel, by rows, the darkness at which it becomes inked: 0 first, 255 last.
    pub threshold: Vec<u8>,
}

/// The strokes of a map and the cells in which they appear.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct StrokeList {
    /// The families, by name, with the options their strokes share.
    pub families: Vec<Family>,
    /// The strokes, each family's in the order in which they are added.
    pub strokes: Vec<Stroke>,
    /// For each level, finest first, and each stroke: the lightest column that draws it whole, or [`StrokeList::NEVER`].
    pub first_column: Vec<Vec<u8>>,
    /// For each level and column the strokes that are drawn in part, to meet the tone.
    pub closing: Vec<Vec<Vec<Closing>>>,
}

/// A family as the map used it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Family {
    /// Its name in the preset.
    pub name: String,
    /// Direction in degrees.
    pub angle_deg: f64,
    /// What all its strokes share.
    pub stroke: StrokeOptions,
}

impl Family {
    /// How the pressure rises and falls along its strokes.
    pub fn taper(&self) -> Taper {
        Taper::new(&self.stroke, Direction::new(self.angle_deg).reversed)
    }
}

/// A stroke of which a cell shows only a part.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Closing {
    /// Index of the stroke.
    pub stroke: u32,
    /// Part of its ink that the cell shows, `0.0 .. 1.0`.
    pub fraction: f32,
}

impl StrokeList {
    /// Mark of a stroke that a level never draws whole.
    pub const NEVER: u8 = u8::MAX;

    /// The strokes of a family drawn in a cell, counting the closing stroke by its fraction.
    pub fn count(&self, level: usize, column: usize, family: u16) -> f64 {
        let whole = self
            .strokes
            .iter()
            .zip(&self.first_column[level])
            .filter(|(stroke, first)| {
                stroke.family == family && usize::from(**first) <= column && **first != Self::NEVER
            })
            .count();
        let part: f32 = self.closing[level][column]
            .iter()
            .filter(|closing| self.strokes[closing.stroke as usize].family == family)
            .map(|closing| closing.fraction)
            .sum();
        whole as f64 + f64::from(part)
    }
}

/// A cell that misses its tone.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Deficit {
    /// Level of the cell, 0 finest.
    pub level: usize,
    /// Column of the cell, 0 lightest.
    pub column: usize,
    /// Tone asked for.
    pub wanted: f64,
    /// Tone reached.
    pub reached: f64,
    /// Why it was not reached.
    pub cause: DeficitCause,
}

/// Why a tone was not reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DeficitCause {
    /// More strokes no longer darken the image: ink too thin, too grainy or rounded away.
    Saturated,
    /// The finer level has no more strokes to share; anti-aliasing favours it at this size.
    Capped,
    /// Praun's stop rule adds whole strokes only, and the last one overshoots.
    WholeStrokes,
}

impl DeficitCause {
    /// The closest remedy, as an imperative sentence.
    pub fn remedy(self) -> &'static str {
        match self {
            Self::Saturated => {
                "raise stroke.opacity or stroke.width_px, lower stroke.grain, or ask for a lighter darkest tone"
            }
            Self::Capped => "raise map.coarsest, or make strokes narrower (stroke.width_px)",
            Self::WholeStrokes => {
                "use placement.method = \"progressive\", which closes each cell with part of a stroke"
            }
        }
    }
}
