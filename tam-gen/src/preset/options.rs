//! Every number a preset can hold: its name, unit, default, range and meaning, once.
//!
//! The command line, the validation of preset files, their JSON schema and an application's sliders all read
//! [`RANGES`]; nothing repeats a default or a range.

use serde::{Deserialize, Serialize};

use super::tones::{MeasureName, Tones};

/// One number of a preset, as its users need to know it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// Table of the preset that holds it: `map`, `placement`, `stroke`, `tip` or `families`.
    pub table: &'static str,
    /// Key in that table.
    pub key: &'static str,
    /// Unit, or the empty string for a plain number.
    pub unit: &'static str,
    /// Smallest allowed number, inclusive.
    pub min: f64,
    /// Largest allowed number, inclusive.
    pub max: f64,
    /// Number used where the preset says nothing.
    pub default: f64,
    /// What it does, in one sentence.
    pub doc: &'static str,
}

impl Range {
    /// The range of a key in a table, if there is one.
    pub fn find(table: &str, key: &str) -> Option<&'static Range> {
        RANGES.iter().find(|range| range.table == table && range.key == key)
    }

    /// Whether a number lies in the range; NaN does not.
    pub fn contains(&self, number: f64) -> bool {
        (self.min..=self.max).contains(&number)
    }

    /// The range in words, with its unit: `0.3 to 128 px`.
    pub fn describe(&self) -> String {
        let space = if self.unit.is_empty() { "" } else { " " };
        format!("{} to {}{space}{}", self.min, self.max, self.unit)
    }
}

/// Numbers that are whole in a struct are rounded to, not cut; others stay as they are.
trait Rounded {
    fn rounded(number: f64) -> Self;
}

impl Rounded for u32 {
    fn rounded(number: f64) -> Self {
        number.round() as Self
    }
}

impl Rounded for f64 {
    fn rounded(number: f64) -> Self {
        number
    }
}

/// Declares an options struct, its `Default`, its rows of the range table, and a listing of its numbers.
macro_rules! options {
    (
        $(#[$meta:meta])*
        $Name:ident in $table:literal as $rows:ident {
            $( $(#[doc = $doc:literal])+ $field:ident : $ty:ty = $default:literal, $unit:literal, $min:literal .. $max:literal; )*
        }
        $( plus { $( $(#[$extra_meta:meta])* $extra:ident : $extra_ty:ty, )* } )?
    ) => {
        $(#[$meta])*
        #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
        #[serde(default, deny_unknown_fields)]
        pub struct $Name {
            $(
                $(#[doc = $doc])+
                #[schemars(range(min = $min, max = $max))]
                pub $field: $ty,
            )*
            $($( $(#[$extra_meta])* pub $extra: $extra_ty, )*)?
        }

        impl Default for $Name {
            fn default() -> Self {
                Self { $( $field: $default, )* $($( $extra: Default::default(), )*)? }
            }
        }

        impl $Name {
            /// Every number of the struct with its key, for validation.
            pub fn numbers(&self) -> Vec<(&'static str, f64)> {
                vec![$( (stringify!($field), self.$field as f64), )*]
            }

            /// Sets the number of this key; `false`, and nothing is changed, where there is none. Whole numbers are
            /// rounded to; whether the result makes sense is for [`Preset::validate`](crate::Preset::validate) to say.
            pub fn set_number(&mut self, key: &str, number: f64) -> bool {
                match key {
                    $( stringify!($field) => self.$field = Rounded::rounded(number), )*
                    _ => return false,
                }
                true
            }
        }

        const $rows: &[Range] = &[$(
            Range {
                table: $table,
                key: stringify!($field),
                unit: $unit,
                min: $min as f64,
                max: $max as f64,
                default: $default as f64,
                doc: concat!($($doc),+),
            },
        )*];
    };
}

options! {
    /// What to make: the size of the grid, its tones, and what comes beside it.
    MapOptions in "map" as MAP_RANGES {
        /// Side of the finest level; a power of two.
        size: u32 = 256, "px", 64..4096;
        /// Side of the coarsest hand-built level; a power of two, not above `size`.
        coarsest: u32 = 32, "px", 8..4096;
    }
    plus {
        /// The columns: a count of evenly spaced tones, or the tones themselves, lightest first.
        tones: Tones,
        /// How the tone of an image is measured.
        tone_measure: MeasureName,
        /// Whether box-filtered levels below the coarsest follow, down to one texel.
        tail: bool,
    }
}

options! {
    /// How strokes find their places, and how hard to try.
    PlacementOptions in "placement" as PLACEMENT_RANGES {
        /// Candidates per stroke of the progressive placement.
        effort: u32 = 4, "candidates", 1..256;
        /// Candidates per stroke of Praun's placement in the lightest column.
        candidates_first: u32 = 1000, "candidates", 1..100000;
        /// Candidates per stroke of Praun's placement in the darkest column.
        candidates_last: u32 = 100, "candidates", 1..100000;
    }
    plus {
        /// The way of placing.
        method: PlacementMethod,
    }
}

/// Declares the stroke options twice from one list: whole (`[stroke]`) and as overrides (`[families.NAME]`).
macro_rules! stroke_options {
    ($( $(#[doc = $doc:literal])+ $field:ident = $default:literal, $unit:literal, $min:literal .. $max:literal; )*) => {
        options! {
            /// The character of a stroke. Lengths and offsets are fractions of the tile, widths are pixels of every level.
            StrokeOptions in "stroke" as STROKE_RANGES {
                $( $(#[doc = $doc])+ $field: f64 = $default, $unit, $min .. $max; )*
            }
            plus {
                /// The shape stamped along the stroke; a plain line without it.
                #[serde(skip_serializing_if = "Option::is_none")]
                tip: Option<TipOptions>,
            }
        }

        /// A family: its direction, and whatever it wants other than `[stroke]` says.
        #[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, schemars::JsonSchema)]
        #[serde(default, deny_unknown_fields)]
        pub struct FamilyOptions {
            /// Direction of the strokes in degrees: 0 runs along a row of texels, 90 along a column.
            #[schemars(range(min = -180, max = 180))]
            pub angle_deg: f64,
            $(
                $(#[doc = $doc])+
                #[serde(skip_serializing_if = "Option::is_none")]
                #[schemars(range(min = $min, max = $max))]
                pub $field: Option<f64>,
            )*
            /// The shape stamped along the family's strokes.
            #[serde(skip_serializing_if = "Option::is_none")]
            pub tip: Option<TipOptions>,
        }

        impl FamilyOptions {
            /// The stroke options of this family: its own where it has them, else the common ones.
            pub fn stroke(&self, common: &StrokeOptions) -> StrokeOptions {
                StrokeOptions {
                    $( $field: self.$field.unwrap_or(common.$field), )*
                    tip: self.tip.clone().or_else(|| common.tip.clone()),
                }
            }

            /// Every number the family sets, with its key, for validation.
            pub fn numbers(&self) -> Vec<(&'static str, f64)> {
                let mut numbers = vec![("angle_deg", self.angle_deg)];
                $( numbers.extend(self.$field.map(|number| (stringify!($field), number))); )*
                numbers
            }

            /// Sets the number of this key, or leaves it to `[stroke]` again; `false`, and nothing is changed, where
            /// there is no such key or the direction is to be left out.
            pub fn set_number(&mut self, key: &str, number: Option<f64>) -> bool {
                match (key, number) {
                    ("angle_deg", Some(angle_deg)) => self.angle_deg = angle_deg,
                    $( (stringify!($field), number) => self.$field = number, )*
                    _ => return false,
                }
                true
            }
        }
    };
}

stroke_options! {
    /// Shortest stroke, as a fraction of the tile. Shortest and longest 0 make dots (stippling).
    length_min = 0.3, "tile", 0..1;
    /// Longest stroke, as a fraction of the tile.
    length_max = 1.0, "tile", 0..1;
    /// Width, the same in every level.
    width_px = 1.6, "px", 0.3..128;
    /// Spread of the width from stroke to stroke: 0.2 varies it by up to a fifth either way.
    width_jitter = 0.0, "", 0..0.9;
    /// Spread of the direction from stroke to stroke, either way.
    angle_jitter_deg = 0.0, "degrees", 0..30;
    /// Largest bow: how far the middle of a stroke leaves its chord, as a fraction of its length.
    bow = 0.0, "", 0..0.3;
    /// Largest s-curve: how far the quarter points leave the chord to opposite sides, as a fraction of the length.
    s_curve = 0.0, "", 0..0.3;
    /// Part of the stroke over which the pressure rises at its start.
    taper_in = 0.0, "", 0..1;
    /// Part of the stroke over which the pressure falls at its end.
    taper_out = 0.0, "", 0..1;
    /// What falling pressure does: 0 narrows the stroke (pen), 1 lightens it (pencil).
    taper_fade = 0.0, "", 0..1;
    /// Ink that one stroke lays down where it covers a texel fully.
    opacity = 1.0, "", 0.05..1;
    /// How much of the ink the tooth of the paper can withhold.
    grain = 0.0, "", 0..0.9;
}

options! {
    /// The shape that draws a stroke: stamped along it, as wide as the stroke, turned with its direction.
    TipOptions in "tip" as TIP_RANGES {
        /// Distance between stamps, in lengths of the tip along the stroke: below 1 they run together.
        spacing: f64 = 0.25, "tip lengths", 0.02..4;
    }
    plus {
        /// The shape as SVG path data (`M0 0 L1 0 …`), filled; scaled to the stroke's width.
        #[serde(skip_serializing_if = "Option::is_none")]
        path: Option<String>,
        /// The shape as a picture: a PNG (black inks, white or transparent does not) or SVG file, relative to the preset, or
        /// a `data:` address that holds one.
        #[serde(skip_serializing_if = "Option::is_none")]
        image: Option<String>,
    }
}

/// A way of placing strokes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Hash, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum PlacementMethod {
    /// One sequence per family, well spaced at every length; every cell draws a prefix of it.
    #[default]
    Progressive,
    /// The search of Praun and others (2001, section 4), made incremental: his order, score and stop rule.
    Praun,
    /// No search: every stroke where chance puts it.
    Random,
}

impl PlacementMethod {
    /// All ways, in the order in which they are offered.
    pub const ALL: [PlacementMethod; 3] = [Self::Progressive, Self::Praun, Self::Random];

    /// The name used in presets and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Progressive => "progressive",
            Self::Praun => "praun",
            Self::Random => "random",
        }
    }
}

impl PlacementOptions {
    /// Candidates per stroke of Praun's placement in a column: evenly from the first number to the last.
    pub fn candidates(&self, column: usize, columns: usize) -> u32 {
        let part = column as f64 / (columns.max(2) - 1) as f64;
        let (first, last) = (f64::from(self.candidates_first), f64::from(self.candidates_last));
        (first + (last - first) * part).round() as u32
    }
}

const FAMILY_RANGES: &[Range] = &[Range {
    table: "families",
    key: "angle_deg",
    unit: "degrees",
    min: -180.0,
    max: 180.0,
    default: 0.0,
    doc: "Direction of the strokes: 0 runs along a row of texels, 90 along a column.",
}];

/// Fewest and most columns of a map.
pub const TONE_COUNT: std::ops::RangeInclusive<usize> = 1..=64;

/// The range of a seed; TOML integers end there.
pub const SEED_MAX: u64 = i64::MAX as u64;

const fn total(parts: &[&[Range]]) -> usize {
    let mut count = 0;
    let mut part = 0;
    while part < parts.len() {
        count += parts[part].len();
        part += 1;
    }
    count
}

const PARTS: [&[Range]; 5] = [MAP_RANGES, PLACEMENT_RANGES, STROKE_RANGES, TIP_RANGES, FAMILY_RANGES];

const fn join() -> [Range; total(&PARTS)] {
    let mut rows = [MAP_RANGES[0]; total(&PARTS)];
    let (mut part, mut row) = (0, 0);
    while part < PARTS.len() {
        let mut i = 0;
        while i < PARTS[part].len() {
            rows[row] = PARTS[part][i];
            row += 1;
            i += 1;
        }
        part += 1;
    }
    rows
}

/// Every number of a preset. A family may set any `stroke` number too.
pub static RANGES: [Range; total(&PARTS)] = join();

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn candidates_fall_from_the_first_number_to_the_last() {
        let placement = PlacementOptions::default();
        let counts: Vec<u32> = (0..6).map(|column| placement.candidates(column, 6)).collect();
        assert_eq!(counts, [1000, 820, 640, 460, 280, 100]);
        assert_eq!(placement.candidates(0, 1), 1000);
    }

    #[test]
    fn numbers_are_set_by_the_keys_under_which_they_are_listed() {
        let mut stroke = StrokeOptions::default();
        for (key, number) in StrokeOptions::default().numbers() {
            assert!(stroke.set_number(key, number + 0.125), "{key}");
        }
        let moved = stroke.numbers().into_iter().zip(StrokeOptions::default().numbers());
        assert!(moved.into_iter().all(|((_, now), (_, before))| now == before + 0.125));
        assert!(!stroke.set_number("size", 1.0));
        let mut map = MapOptions::default();
        assert!(map.set_number("size", 511.6) && map.size == 512);

        let mut family = FamilyOptions::default();
        assert!(family.set_number("angle_deg", Some(30.0)) && family.set_number("width_px", Some(2.0)));
        assert_eq!(family.numbers(), [("angle_deg", 30.0), ("width_px", 2.0)]);
        assert!(family.set_number("width_px", None) && family.numbers() == [("angle_deg", 30.0)]);
        assert!(!family.set_number("angle_deg", None) && !family.set_number("nothing", Some(1.0)));
    }

    #[test]
    fn every_default_lies_in_its_range() {
        for range in &RANGES {
            assert!(range.contains(range.default), "{}.{}", range.table, range.key);
        }
    }
}
