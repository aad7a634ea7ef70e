//! Numbers that tell a tonal art map from a set of pictures that only looks like one.
//!
//! Images are rows of ink, one byte per texel: 0 paper, 255 solid. All images are toroidal. Every function here only
//! measures; limits and verdicts are in [`crate::checks`].

mod centre_lines;
mod count;
mod ink;
mod length;
mod level_nesting;
mod raster_once;
mod seam;
mod stroke_map;
mod tone;
mod tone_nesting;
mod uniformity;
mod width;

pub use centre_lines::{CentreLines, centre_line_floor, centre_lines, missing_centre_lines, visit_centre_line};
pub use ink::{full_ink, share_at_least};
pub use length::{LengthBias, length_bias};
pub use level_nesting::{LevelNesting, level_nesting, level_nesting_reach, lost_texels};
pub use raster_once::rasterise_once;
pub use seam::{Seam, line_differences, seam};
pub use stroke_map::{PatternMatch, pattern_match, pattern_matches, pattern_mismatch, threshold_share};
pub use tone::{ToneErrors, tone_errors, tones};
pub use tone_nesting::{ToneNesting, lighter_than_before, tone_nesting};
pub use uniformity::{box_cv, gap_cv, low_frequency_share};
pub use width::{StrokeWidth, stroke_width, stroke_width_at};

#[cfg(test)]
mod tests;
