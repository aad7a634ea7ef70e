//! Realising: drawing prefixes of the sequences into the cells of one level, each to its exact tone.

mod canvas;
mod closing;
mod threshold;

pub(crate) use canvas::Canvas;
pub(crate) use threshold::{ThresholdCanvas, distribution};

use std::sync::Arc;

use crate::error::GenerateError;
use crate::job::Job;
use crate::map::DeficitCause;
use crate::preset::ToneMeasure;
use crate::raster::{Footprint, Grain, Nib};
use crate::stroke::Stroke;
use closing::Closing;

/// Strokes between looks at the cancel flag, and over which progress towards a tone is judged.
const WINDOW: u32 = 256;
/// Strokes in a row that gain nothing, after which more are not tried.
const IDLE_STROKES: u32 = 64;
/// Less ink gained than this part of the ink laid down, over a window, and the image is saturated.
const SATURATED: f64 = 1.0 / 5000.0;

/// What all levels share.
pub(crate) struct Plan<'a> {
    /// Darkness of each column, lightest first.
    pub(crate) tones: &'a [f64],
    /// For each column the families it adds, in turn.
    pub(crate) schedule: &'a [Vec<u16>],
    /// Nib of each family.
    pub(crate) nibs: &'a [Nib],
    /// Largest part of the ink that the paper's tooth withholds, of each family.
    pub(crate) grain: &'a [f32],
    pub(crate) seed: u64,
    pub(crate) measure: &'a ToneMeasure,
    pub(crate) job: &'a Job<'a>,
}

impl Plan<'_> {
    /// The grain of each family at a level; families with the same grain share one.
    pub(crate) fn grains(&self, size: u32) -> Vec<Arc<Grain>> {
        let mut grains: Vec<Arc<Grain>> = Vec::new();
        for (i, amount) in self.grain.iter().enumerate() {
            let shared = self.grain[..i].iter().position(|other| other == amount).map(|same| grains[same].clone());
            grains.push(shared.unwrap_or_else(|| Arc::new(Grain::new(*amount, size, self.seed))));
        }
        grains
    }

    /// The weight sum at which an image of a level has a column's tone.
    pub(crate) fn target(&self, column: usize, size: u32) -> u64 {
        let texels = f64::from(size) * f64::from(size);
        (self.tones[column] * f64::from(ToneMeasure::SOLID) * texels).round() as u64
    }
}

/// How many strokes of each family a level draws in each column.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Counts {
    pub(crate) columns: Vec<ColumnCounts>,
}

/// How many strokes of each family a cell draws.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct ColumnCounts {
    /// Whole strokes, by family.
    pub(crate) whole: Vec<u32>,
    /// The family whose next stroke is drawn in part, and the part.
    pub(crate) closing: Option<(u16, f32)>,
    /// What the cell's texels weigh.
    pub(crate) sum: u64,
    /// Why the cell misses its tone, if it does.
    pub(crate) deficit: Option<DeficitCause>,
}

/// What a cell came to.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Reached {
    /// What its texels weigh.
    pub(crate) sum: u64,
    /// Why it misses its tone, if it does.
    pub(crate) cause: Option<DeficitCause>,
}

/// How much of a stroke a level may draw so that it stays nested in the finer one.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Allowance {
    Whole,
    Part(f32),
    None,
}

impl Counts {
    fn allowance(&self, column: usize, family: u16, index: u32) -> Allowance {
        let column = &self.columns[column];
        let whole = column.whole[usize::from(family)];
        match column.closing {
            _ if index < whole => Allowance::Whole,
            Some((closing, part)) if closing == family && index == whole => Allowance::Part(part),
            _ => Allowance::None,
        }
    }

    /// Whether every cell draws at most what the finer level draws.
    pub(crate) fn nests_in(&self, finer: &Counts) -> bool {
        self.columns.iter().enumerate().all(|(column, counts)| {
            counts.whole.iter().enumerate().all(|(family, &whole)| {
                let part = counts.closing.filter(|(closing, _)| usize::from(*closing) == family).map_or(0.0, |c| c.1);
                let finer = &finer.columns[column];
                let finer_part =
                    finer.closing.filter(|(closing, _)| usize::from(*closing) == family).map_or(0.0, |c| c.1);
                let finer_whole = finer.whole[family];
                whole < finer_whole || (whole == finer_whole && part <= finer_part)
            })
        })
    }
}

/// Buffers of one level, kept between maps.
#[derive(Debug, Clone, Default)]
pub(crate) struct LevelScratch {
    pub(crate) canvas: Canvas,
    pub(crate) thresholds: ThresholdCanvas,
    pub(crate) footprint: Footprint,
    pub(crate) piece: Footprint,
}

/// Draws all cells of a level, lightest first.
///
/// `stroke_of(family, index)` gives the strokes of the sequences, or `None` where a sequence ends. `finer` caps the counts at
/// those of the next finer level. `cells` receives one image per column; buffers in it are reused.
pub(crate) fn realise_level(
    plan: &Plan<'_>,
    size: u32,
    stroke_of: &mut dyn FnMut(u16, u32) -> Option<Stroke>,
    finer: Option<&Counts>,
    scratch: &mut LevelScratch,
    cells: &mut Vec<Vec<u8>>,
) -> Result<Counts, GenerateError> {
    let LevelScratch { canvas, thresholds, footprint, piece } = scratch;
    let grains = plan.grains(size);
    canvas.reset(size);
    thresholds.reset(size);
    cells.resize_with(plan.tones.len(), Vec::new);

    let mut counts = Counts::default();
    let mut whole = vec![0_u32; plan.nibs.len()];
    let mut pending: Option<(u16, Vec<u8>)> = None;
    let mut drawn = 0_u32;

    for (column, families) in plan.schedule.iter().enumerate() {
        let target = plan.target(column, size);
        let mut cell = ColumnCounts::default();
        let mut turn = 0;
        let mut exhausted = 0;
        let mut window = Window::default();
        let mut closing = None;

        while canvas.sum() < target {
            // A stroke that the lighter column left unfinished comes first, also where its family no longer does.
            let (family, shown) = match pending.take() {
                Some((family, shown)) => (family, Some(shown)),
                None => (families[turn % families.len()], None),
            };
            turn += usize::from(shown.is_none());
            let index = whole[usize::from(family)];
            let allowance = finer.map_or(Allowance::Whole, |finer| finer.allowance(column, family, index));
            let stroke = if allowance == Allowance::None { None } else { stroke_of(family, index) };
            let Some(stroke) = stroke else {
                // What lighter columns show of a stroke, the finer level shows too, so it is always allowed.
                debug_assert!(shown.is_none());
                exhausted += 1;
                if exhausted >= families.len() {
                    cell.deficit = Some(DeficitCause::Capped);
                    break;
                }
                continue;
            };

            let nib = &plan.nibs[usize::from(family)];
            nib.footprint(&stroke, size, &grains[usize::from(family)], footprint);
            let before = canvas.sum();
            canvas.draw(footprint, nib.opacity, plan.measure);
            if allowance == Allowance::Whole && canvas.sum() <= target {
                whole[usize::from(family)] += 1;
                exhausted = 0;
                thresholds.add(canvas.fresh());
                window.note(footprint, canvas.sum() - before);
                drawn += 1;
                if drawn.is_multiple_of(WINDOW) && plan.job.cancelled() {
                    return Err(GenerateError::Cancelled);
                }
                if window.saturated() {
                    cell.deficit = Some(DeficitCause::Saturated);
                    break;
                }
                continue;
            }

            let (gain, most) = (canvas.sum() - before, canvas.ink_under(footprint));
            canvas.undo(footprint, before);
            let mut limit = target - before;
            if let Allowance::Part(part) = allowance {
                let most = (f64::from(part) * gain as f64) as u64;
                if most < limit {
                    limit = most;
                    cell.deficit = Some(DeficitCause::Capped);
                }
            }
            let under = canvas.under().to_vec();
            let partial =
                Closing { stroke: &stroke, nib, grain: &grains[usize::from(family)], size, measure: plan.measure };
            let shown = partial.draw(canvas, footprint, &most, piece, (limit, gain), shown.as_deref());
            let part = ((canvas.sum() - before) as f64 / gain.max(1) as f64) as f32;
            cell.closing = Some((family, part));
            closing = Some((family, shown));
            canvas.copy_ink_to(&mut cells[column]);
            cell.sum = canvas.sum();
            canvas.restore(footprint, &under, before);
            break;
        }

        if cell.closing.is_none() {
            canvas.copy_ink_to(&mut cells[column]);
            cell.sum = canvas.sum();
        }
        cell.whole.clone_from(&whole);
        pending = closing;
        counts.columns.push(cell);
        if finer.is_none() {
            plan.job.report((column + 1) as f32 / plan.schedule.len() as f32);
        }
    }

    fill_thresholds(plan, size, &grains, whole, scratch, stroke_of)?;
    Ok(counts)
}

/// Carries a level's stroke map on with the darkest column's families until little paper is left, and closes the gaps.
/// `next` is the index of each family's next stroke.
pub(crate) fn fill_thresholds(
    plan: &Plan<'_>,
    size: u32,
    grains: &[Arc<Grain>],
    mut next: Vec<u32>,
    scratch: &mut LevelScratch,
    stroke_of: &mut dyn FnMut(u16, u32) -> Option<Stroke>,
) -> Result<(), GenerateError> {
    let LevelScratch { canvas, thresholds, footprint, .. } = scratch;
    let families = plan.schedule.last().map_or(&[][..], Vec::as_slice);
    for family in families.iter().cycle() {
        let family_index = usize::from(*family);
        if thresholds.dense_enough() {
            break;
        }
        if plan.job.cancelled() {
            return Err(GenerateError::Cancelled);
        }
        let Some(stroke) = stroke_of(*family, next[family_index]) else { break };
        next[family_index] += 1;
        let nib = &plan.nibs[family_index];
        nib.footprint(&stroke, size, &grains[family_index], footprint);
        // The cells are done, so that their ink may grow along.
        canvas.draw(footprint, nib.opacity, plan.measure);
        if !thresholds.add(canvas.fresh()) {
            break;
        }
    }
    thresholds.close_gaps(canvas);
    Ok(())
}

/// Ink laid down and ink gained over the latest strokes of a column.
#[derive(Default)]
pub(crate) struct Window {
    strokes: u32,
    laid: u64,
    gained: u64,
    idle: u32,
    saturated: bool,
}

impl Window {
    pub(crate) fn note(&mut self, footprint: &Footprint, gained: u64) {
        self.strokes += 1;
        self.idle = if gained == 0 { self.idle + 1 } else { 0 };
        self.laid += footprint.ink.iter().map(|ink| u64::from(*ink)).sum::<u64>() * u64::from(ToneMeasure::SOLID / 255);
        self.gained += gained;
        if self.strokes == WINDOW {
            let saturated = self.gained as f64 <= SATURATED * self.laid as f64;
            *self = Self { saturated, idle: self.idle, ..Self::default() };
        }
        self.saturated |= self.idle >= IDLE_STROKES;
    }

    pub(crate) fn saturated(&self) -> bool {
        self.saturated
    }
}
