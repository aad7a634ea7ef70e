//! What placing strokes costs, and how even they lie for it.

use std::time::Duration;

use cpu_time::ProcessTime;

use crate::job::Job;
use crate::map::Map;
use crate::measure;
use crate::preset::{PlacementMethod, Preset, ToneMeasure};
use crate::{GenerateError, Generator};

/// A way of placing strokes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Ours, with so many candidates per stroke.
    Progressive(u32),
    /// The search of Praun and others (2001), with so many candidates per stroke in the lightest column, and a tenth in
    /// the darkest, as theirs.
    Praun(u32),
    /// Strokes lie where they fall.
    Random,
}

impl Way {
    /// The methods in the order of a chart's groups.
    pub const GROUPS: [&str; 3] = ["progressive", "praun", "random"];

    /// Its method, as an index of [`Way::GROUPS`].
    pub fn group(self) -> usize {
        match self {
            Self::Progressive(_) => 0,
            Self::Praun(_) => 1,
            Self::Random => 2,
        }
    }

    /// Candidates per stroke in the lightest column.
    pub fn candidates(self) -> u32 {
        match self {
            Self::Progressive(candidates) | Self::Praun(candidates) => candidates,
            Self::Random => 1,
        }
    }

    /// A preset with its strokes placed so.
    pub fn of(self, preset: &Preset) -> Preset {
        let mut preset = preset.clone();
        let placement = &mut preset.placement;
        match self {
            Self::Progressive(effort) => {
                (placement.method, placement.effort) = (PlacementMethod::Progressive, effort);
            }
            Self::Praun(candidates) => {
                placement.method = PlacementMethod::Praun;
                (placement.candidates_first, placement.candidates_last) = (candidates, (candidates / 10).max(1));
            }
            Self::Random => placement.method = PlacementMethod::Random,
        }
        preset
    }
}

/// How evenly the strokes of one column lie, at the finest level (see [`measure`]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evenness {
    /// Of means over windows of an eighth of the side.
    pub box_cv: f64,
    /// Of the gaps between strokes.
    pub gap_cv: f64,
    /// Share of power in clumps and holes.
    pub low_frequency: f64,
}

/// Figures of a way of placing strokes.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacementFigures {
    /// CPU time of a map over all threads, median of the runs.
    pub cpu_ms: f64,
    /// CPU time of drawing its strokes once, median of as many runs, taken in turn with the others.
    pub raster_ms: f64,
    /// Greatest error of a cell's tone.
    pub tone_max: f64,
    /// Root mean square of the same.
    pub tone_rms: f64,
    /// Of columns 1 and 3, the lightest being 1; none where a column holds strokes of more than the first family.
    pub evenness: [Option<Evenness>; 2],
}

impl PlacementFigures {
    /// Cost of the map over that of merely drawing it.
    pub fn ratio(&self) -> f64 {
        self.cpu_ms / self.raster_ms
    }
}

/// Generates a preset's map `runs` times (one at least), each in turn with drawing its strokes once.
///
/// # Errors
/// The preset cannot be generated, or the job was cancelled.
pub fn measure_placement(
    preset: &Preset,
    way: Way,
    runs: usize,
    job: &Job<'_>,
) -> Result<PlacementFigures, GenerateError> {
    let preset = way.of(preset);
    let (mut generator, mut map) = (Generator::new(), Map::default());
    let (mut whole, mut raster) = (Vec::new(), Vec::new());
    for _ in 0..runs.max(1) {
        let start = ProcessTime::now();
        generator.generate_into(&preset, job, &mut map)?;
        whole.push(start.elapsed());
        let start = ProcessTime::now();
        let drawn = measure::rasterise_once(&map)
            .map_err(|error| GenerateError::Preset { at: "stroke.tip".into(), problem: error.to_string() })?;
        raster.push(start.elapsed());
        std::hint::black_box(drawn);
    }
    let tone = measure::tone_errors(&map.grid, &ToneMeasure::named(preset.map.tone_measure));
    Ok(PlacementFigures {
        cpu_ms: median_ms(whole),
        raster_ms: median_ms(raster),
        tone_max: tone.max,
        tone_rms: tone.rms,
        evenness: [evenness(&map, 0), evenness(&map, 2)],
    })
}

/// Of a column of the finest level that holds strokes of the first family alone.
fn evenness(map: &Map, column: usize) -> Option<Evenness> {
    let level = map.grid.levels.first()?;
    let cell = level.cells.get(column)?;
    let first: Vec<&str> = map.preset.scheduled(0).collect();
    let alone = first.len() == 1 && (0..=column).all(|column| map.preset.scheduled(column).eq(first.iter().copied()));
    let axis = map.strokes.strokes.first().filter(|_| alone)?.axis;
    let half = measure::full_ink(cell) / 2;
    Some(Evenness {
        box_cv: measure::box_cv(cell, level.size, level.size / 8),
        gap_cv: measure::gap_cv(cell, level.size, axis, half),
        low_frequency: measure::low_frequency_share(cell, level.size, axis, half),
    })
}

fn median_ms(mut times: Vec<Duration>) -> f64 {
    times.sort_unstable();
    times.get(times.len() / 2).map_or(f64::NAN, |time| time.as_secs_f64() * 1e3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_of_two_families_have_no_evenness() {
        let mut preset = Preset::default();
        preset.map.size = 64;
        preset.schedule = ["h", "v", "h v"].map(String::from).to_vec();
        let found = measure_placement(&preset, Way::Random, 1, &Job::default()).expect("a valid preset");
        assert!(found.evenness[0].is_some() && found.evenness[1].is_none(), "{found:?}");
    }
}
