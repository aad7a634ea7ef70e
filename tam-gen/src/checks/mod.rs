//! The promise of a tonal art map, checked on its pixels: each constraint gets a measured number, a limit and a verdict.
//!
//! [`check_map`] judges a map made here, with its stroke list and at tighter limits; [`check_grid`] anyone's images.
//! [`html`] makes a page of the findings with pictures of what is wrong. Nothing depends on chance or threads.

mod centre_lines;
mod constraint;
mod html;
mod level_list;
mod level_pixels;
mod picture;
mod report;
mod seams;
mod stroke_map;
mod subject;
mod tone;
mod tone_nesting;
mod width;

use rayon::prelude::*;

use crate::map::{Grid, Map, StrokeList, StrokeMap};
use crate::preset::ToneMeasure;

pub use constraint::Constraint;
pub use html::html;
pub use report::{CellFinding, Finding, Limit, Report, Verdict};
use subject::Subject;

/// What the checker needs to know about a map besides its pixels.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct CheckOptions {
    /// The map was made here: tones are held to 1e-4 (5e-4 below 16 px) instead of 1e-3.
    pub own: bool,
    /// The measure of tone that the map was made for; mean coverage by default.
    pub measure: ToneMeasure,
    /// The wanted tones are unknown ([`Grid::tones`] is a guess): judge only that the levels of a column agree.
    pub tone_spread_only: bool,
}

/// Checks a map made here against all constraints. Tones that the generation had to give up count as failures; the
/// finding then says why and what helps.
pub fn check_map(map: &Map) -> Report {
    let measure = ToneMeasure::named(map.preset.map.tone_measure);
    let options = CheckOptions { own: true, measure, tone_spread_only: false };
    let mut report = check_grid(&map.grid, Some(&map.stroke_map), Some(&map.strokes), &options);
    let worst =
        map.deficits.iter().max_by(|a, b| (a.wanted - a.reached).abs().total_cmp(&(b.wanted - b.reached).abs()));
    if let (Some(deficit), Some(finding)) = (worst, report.get_mut(Constraint::ToneAverage)) {
        finding.detail += &format!("; {}", deficit.cause.remedy());
    }
    report
}

/// Checks a grid of images, whoever made it, against all constraints that can be judged with what is given.
///
/// Levels are expected finest first, each half the size of the one before, all cells of a level of its size.
pub fn check_grid(
    grid: &Grid,
    stroke_map: Option<&StrokeMap>,
    strokes: Option<&StrokeList>,
    options: &CheckOptions,
) -> Report {
    let subject = Subject { grid, stroke_map, strokes, options };
    let judge = |&constraint: &Constraint| match (subject.defect(), constraint) {
        (Some(why), constraint) => Finding::not_judged(constraint, why),
        (None, Constraint::ToneAverage) => tone::average(&subject),
        (None, Constraint::ToneSpread) => tone::spread(&subject),
        (None, Constraint::ToneNesting) => tone_nesting::check(&subject),
        (None, Constraint::LevelNestingList) => level_list::check(&subject),
        (None, Constraint::LevelNestingCentreLines) => centre_lines::check(&subject),
        (None, Constraint::LevelNestingPixels) => level_pixels::check(&subject),
        (None, Constraint::Seams) => seams::check(&subject),
        (None, Constraint::StrokeWidth) => width::check(&subject),
        (None, Constraint::StrokeMapTone) => stroke_map::tone(&subject),
        (None, Constraint::StrokeMapPattern) => stroke_map::pattern(&subject),
    };
    Report { findings: Constraint::ALL.par_iter().map(judge).collect() }
}

#[cfg(test)]
pub(crate) mod synthetic;

#[cfg(test)]
mod tests;
