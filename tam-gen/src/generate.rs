//! A generation from preset to finished map.

use rayon::prelude::*;

use crate::error::GenerateError;
use crate::job::Job;
use crate::map::{Closing, Deficit, DeficitCause, Family, Grid, Level, Map, StrokeList, ThresholdLevel};
use crate::placement::praun;
use crate::preset::{FamilyOptions, PlacementMethod, Preset, ToneMeasure};
use crate::raster::Nib;
use crate::realise::{ColumnCounts, Counts, LevelScratch, Plan, Reached, distribution, realise_level};
use crate::sequence::Sequence;

/// Generates a map; one that makes many keeps a [`Generator`].
///
/// # Errors
/// When cancelled, or when the preset holds something no map can be made from.
pub fn generate(preset: &Preset, job: &Job<'_>) -> Result<Map, GenerateError> {
    let mut map = Map::default();
    Generator::new().generate_into(preset, job, &mut map)?;
    Ok(map)
}

/// Generates the map of a preset with so many times as many texels, of the strokes that its own map has.
///
/// # Errors
/// As [`generate`]; the preset with that many texels must be valid, see [`Preset::texels_for`].
pub fn generate_finer(preset: &Preset, texels: u32, job: &Job<'_>) -> Result<Map, GenerateError> {
    let mut map = Map::default();
    Generator::new().generate_strokes(preset, texels, job, &mut map)?;
    Ok(map)
}

/// Generates maps one after another, keeping its buffers.
#[derive(Debug, Clone, Default)]
pub struct Generator {
    scratch: Vec<LevelScratch>,
}

impl Generator {
    /// A generator without buffers yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Generates a map into the buffers of an older one.
    ///
    /// The result depends on nothing but the preset (and the job's measure, if it has one). After an error `map` holds no
    /// particular images, but may be used again.
    ///
    /// # Errors
    /// When cancelled, or when the preset holds something no map can be made from: the first of [`Preset::validate`].
    pub fn generate_into(&mut self, preset: &Preset, job: &Job<'_>, map: &mut Map) -> Result<(), GenerateError> {
        self.generate_strokes(preset, 1, job, map)
    }

    /// The strokes of a preset, in a map with so many times as many texels as it says.
    fn generate_strokes(
        &mut self,
        of: &Preset,
        texels: u32,
        job: &Job<'_>,
        map: &mut Map,
    ) -> Result<(), GenerateError> {
        let preset = &of.with_texels(texels);
        if let Some(violation) = preset.validate().into_iter().next() {
            let problem = format!("{}; allowed: {}", violation.problem, violation.expected);
            return Err(GenerateError::Preset { at: violation.at.to_string(), problem });
        }
        let named = ToneMeasure::named(preset.map.tone_measure);
        let families = families(preset);
        let mut sequences: Vec<Sequence> = (0..)
            .zip(&self::families(of))
            .map(|(i, family)| Sequence::new(of, i, family).with_texels(texels as f32))
            .collect();
        let nib = |family: &Family| {
            Nib::new(family).map_err(|error| GenerateError::Preset {
                at: format!("families.{}.tip", family.name),
                problem: error.to_string(),
            })
        };
        let nibs = families.iter().map(nib).collect::<Result<Vec<_>, _>>()?;
        let tones = preset.map.tones.list();
        let schedule = schedule(preset, &families)?;
        let grain: Vec<f32> = families.iter().map(|family| family.stroke.grain as f32).collect();
        let plan = Plan {
            tones: &tones,
            schedule: &schedule,
            nibs: &nibs,
            grain: &grain,
            seed: preset.seed,
            measure: job.measure.unwrap_or(&named),
            job,
        };

        let level_count = preset.level_count();
        self.scratch.resize_with(level_count, LevelScratch::default);
        map.grid.levels.resize_with(level_count, Level::default);
        map.grid.levels.truncate(level_count);
        for (l, level) in map.grid.levels.iter_mut().enumerate() {
            level.size = preset.map.size >> l;
        }
        map.stroke_map.levels.resize_with(level_count, ThresholdLevel::default);

        let (scratch, levels) = (&mut self.scratch[..], &mut map.grid.levels[..]);
        let reached: Vec<Vec<Reached>>;
        (map.strokes, reached) = match preset.placement.method {
            PlacementMethod::Progressive | PlacementMethod::Random => {
                let counts = draw_levels(&plan, &mut sequences, scratch, levels)?;
                let reached = |cell: &ColumnCounts| Reached { sum: cell.sum, cause: cell.deficit };
                let reached = counts.iter().map(|counts| counts.columns.iter().map(reached).collect()).collect();
                (list_strokes(&families, &sequences, &counts), reached)
            }
            PlacementMethod::Praun => praun::draw_levels(&plan, preset, &families, &mut sequences, scratch, levels)?,
        };
        for (scratch, level) in self.scratch.iter().zip(&mut map.stroke_map.levels) {
            scratch.thresholds.copy_to(level);
        }
        map.stroke_map.distribution = distribution(&map.stroke_map.levels);
        map.grid.tones.clone_from(&tones);
        map.grid.hand_built = level_count;
        map.deficits = deficits(&map.grid, &reached);
        if preset.map.tail {
            crate::tail::append(&mut map.grid);
        }
        map.preset = preset.clone();
        job.report(1.0);
        Ok(())
    }
}

/// The families of a preset, by name.
fn families(preset: &Preset) -> Vec<Family> {
    let family = |(name, options): (&String, &FamilyOptions)| Family {
        name: name.clone(),
        angle_deg: options.angle_deg,
        stroke: options.stroke(&preset.stroke),
    };
    preset.families.iter().map(family).collect()
}

/// For each column, the indices of the families it adds.
fn schedule(preset: &Preset, families: &[Family]) -> Result<Vec<Vec<u16>>, GenerateError> {
    let index = |name: &str| {
        let found = families.iter().position(|family| family.name == name);
        found.map(|index| index as u16).ok_or_else(|| GenerateError::Preset {
            at: "schedule".into(),
            problem: format!("names the family `{name}`, which does not exist"),
        })
    };
    let column = |column| {
        let families = preset.scheduled(column).map(index).collect::<Result<Vec<_>, _>>()?;
        if families.is_empty() {
            return Err(GenerateError::Preset {
                at: "schedule".into(),
                problem: format!("column {column} adds no family"),
            });
        }
        Ok(families)
    };
    (0..preset.map.tones.count()).map(column).collect()
}

/// Draws all levels as prefixes of the sequences, the finest first, since it needs the most strokes.
fn draw_levels(
    plan: &Plan<'_>,
    sequences: &mut [Sequence],
    scratch: &mut [LevelScratch],
    levels: &mut [Level],
) -> Result<Vec<Counts>, GenerateError> {
    let (finest, coarser) = levels.split_first_mut().ok_or_else(no_levels)?;
    let (finest_scratch, coarser_scratch) = scratch.split_first_mut().ok_or_else(no_levels)?;
    let mut extend = |family: u16, index| sequences[usize::from(family)].stroke(index);
    let mut counts = vec![realise_level(plan, finest.size, &mut extend, None, finest_scratch, &mut finest.cells)?];

    let sequences = &*sequences;
    let read = |family: u16, index: u32| sequences[usize::from(family)].strokes().get(index as usize).copied();
    let realise = |finer: Option<&Counts>, scratch: &mut LevelScratch, level: &mut Level| {
        realise_level(plan, level.size, &mut { read }, finer, scratch, &mut level.cells)
    };
    let alone: Vec<Counts> = coarser_scratch
        .par_iter_mut()
        .zip(coarser.par_iter_mut())
        .map(|(scratch, level)| realise(None, scratch, level))
        .collect::<Result<_, _>>()?;

    // Anti-aliasing can make a very coarse level ask for more strokes than the next finer one has.
    for ((mut own, scratch), level) in alone.into_iter().zip(coarser_scratch).zip(coarser) {
        let finer = &counts[counts.len() - 1];
        if !own.nests_in(finer) {
            own = realise(Some(finer), scratch, level)?;
        }
        counts.push(own);
    }
    Ok(counts)
}

fn no_levels() -> GenerateError {
    GenerateError::Preset { at: "map.coarsest".into(), problem: "leaves no level to draw".into() }
}

/// The strokes that any cell draws, and which cells those are.
fn list_strokes(families: &[Family], sequences: &[Sequence], counts: &[Counts]) -> StrokeList {
    let mut strokes = Vec::new();
    let mut first_index = Vec::new();
    for (family, sequence) in sequences.iter().enumerate() {
        let used = counts
            .iter()
            .flat_map(|level| &level.columns)
            .map(|cell| {
                cell.whole[family] + u32::from(cell.closing.is_some_and(|(closing, _)| usize::from(closing) == family))
            })
            .max()
            .unwrap_or(0);
        first_index.push(strokes.len());
        strokes.extend_from_slice(&sequence.strokes()[..used as usize]);
    }
    let first_column = counts
        .iter()
        .map(|level| {
            let mut first_column = vec![StrokeList::NEVER; strokes.len()];
            for (column, cell) in level.columns.iter().enumerate().rev() {
                for (family, whole) in cell.whole.iter().enumerate() {
                    first_column[first_index[family]..][..*whole as usize].fill(column as u8);
                }
            }
            first_column
        })
        .collect();
    let closing_of = |cell: &ColumnCounts| {
        cell.closing
            .map(|(family, fraction)| {
                let family = usize::from(family);
                Closing { stroke: first_index[family] as u32 + cell.whole[family], fraction }
            })
            .into_iter()
            .collect()
    };
    let closing = counts.iter().map(|level| level.columns.iter().map(closing_of).collect()).collect();
    StrokeList { families: families.to_vec(), strokes, first_column, closing }
}

/// The cells that miss their tones by more than quantisation explains.
fn deficits(grid: &Grid, reached: &[Vec<Reached>]) -> Vec<Deficit> {
    let mut deficits = Vec::new();
    for (level, reached) in reached.iter().enumerate() {
        let size = grid.levels[level].size;
        for (column, Reached { sum, cause }) in reached.iter().enumerate() {
            let wanted = grid.tones[column];
            let reached = *sum as f64 / (f64::from(ToneMeasure::SOLID) * f64::from(size) * f64::from(size));
            if (reached - wanted).abs() > tone_tolerance(size) {
                let cause = cause.unwrap_or(DeficitCause::Saturated);
                deficits.push(Deficit { level, column, wanted, reached, cause });
            }
        }
    }
    deficits
}

/// Largest error of tone that a cell drawn here may have: at 8 px a step of 255 in a few texels is already 1e-4.
pub fn tone_tolerance(size: u32) -> f64 {
    if size >= 16 { 1e-4 } else { 5e-4 }
}
