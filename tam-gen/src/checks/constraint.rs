//! The constraints, by name and in words.

use serde::{Serialize, Serializer};

/// A constraint of a tonal art map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Constraint {
    /// Each cell has the tone of its column.
    ToneAverage,
    /// The levels of a column have the same tone.
    ToneSpread,
    /// A darker column keeps the ink of the lighter ones.
    ToneNesting,
    /// A finer level keeps the strokes of the coarser ones, by the list of strokes.
    LevelNestingList,
    /// Strokes are inked along their middle in all finer levels and darker columns.
    LevelNestingCentreLines,
    /// A finer level keeps the strokes of the coarser ones, by pixels alone.
    LevelNestingPixels,
    /// Images continue across their edges.
    Seams,
    /// Strokes are equally wide in all levels.
    StrokeWidth,
    /// The stroke map, thresholded at a column's tone, has that tone.
    StrokeMapTone,
    /// The stroke map, thresholded at a column's tone, shows that column.
    StrokeMapPattern,
}

impl Constraint {
    /// All constraints, in the order in which they are reported.
    pub const ALL: [Constraint; 10] = [
        Self::ToneAverage,
        Self::ToneSpread,
        Self::ToneNesting,
        Self::LevelNestingList,
        Self::LevelNestingCentreLines,
        Self::LevelNestingPixels,
        Self::Seams,
        Self::StrokeWidth,
        Self::StrokeMapTone,
        Self::StrokeMapPattern,
    ];

    /// Name for machines, as in JSON: `tone-average`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::ToneAverage => "tone-average",
            Self::ToneSpread => "tone-spread",
            Self::ToneNesting => "tone-nesting",
            Self::LevelNestingList => "level-nesting-list",
            Self::LevelNestingCentreLines => "level-nesting-centre-lines",
            Self::LevelNestingPixels => "level-nesting-pixels",
            Self::Seams => "seams",
            Self::StrokeWidth => "stroke-width",
            Self::StrokeMapTone => "stroke-map-tone",
            Self::StrokeMapPattern => "stroke-map-pattern",
        }
    }

    /// Name for people: `Tone average`.
    pub const fn title(self) -> &'static str {
        match self {
            Self::ToneAverage => "Tone average",
            Self::ToneSpread => "Tone spread",
            Self::ToneNesting => "Tone nesting",
            Self::LevelNestingList => "Level nesting: stroke list",
            Self::LevelNestingCentreLines => "Level nesting: centre lines",
            Self::LevelNestingPixels => "Level nesting: pixels",
            Self::Seams => "Seams",
            Self::StrokeWidth => "Stroke width",
            Self::StrokeMapTone => "Stroke map: tone",
            Self::StrokeMapPattern => "Stroke map: pattern",
        }
    }

    /// What it asks, in one sentence.
    pub const fn definition(self) -> &'static str {
        match self {
            Self::ToneAverage => "The mean ink of every image is the tone of its column.",
            Self::ToneSpread => "All levels of a column have the same mean ink, so nothing pops as the viewer moves.",
            Self::ToneNesting => "No texel of a darker column is lighter than the same texel of a lighter column.",
            Self::LevelNestingList => "Every stroke of a level is in all finer levels; counts never fall.",
            Self::LevelNestingCentreLines => {
                "Every stroke is inked along its middle in its level, all finer levels and all darker columns."
            }
            Self::LevelNestingPixels => {
                "Where a level is inked, the next finer level has a stroke too, far more often than by chance."
            }
            Self::Seams => "The step from the last row or column of texels to the first looks like any other step.",
            Self::StrokeWidth => "Strokes have the same width, in texels, in every level.",
            Self::StrokeMapTone => {
                "The stroke map inks as large a share of texels as the column whose tone it is cut at."
            }
            Self::StrokeMapPattern => "The stroke map, cut at a column's tone, inks the texels that the column inks.",
        }
    }
}

impl Serialize for Constraint {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}
