//! The placement of Praun and others (2001), section 4, made incremental.
//!
//! His order: columns from light to dark, in each column levels from coarse to fine, adding strokes until the image has its
//! tone. His score: of many random candidates the one that darkens most, summed over this level, all finer ones, and the
//! image pyramid of each, divided by its length. His stop rule: whole strokes, until the mean reaches the tone.
//!
//! A pyramid level p of an image feels a candidate s as mean(s_p · (1 - D_p)), D_p its darkness: linear in the candidate's
//! texels, each weighing Σ_p (1 - D_p) at the texel's ancestors. That sum is kept per texel, so a candidate costs one look
//! per texel it covers, and only the accepted stroke updates pyramids.

use std::sync::Arc;

use rayon::prelude::*;

use crate::error::GenerateError;
use crate::map::{DeficitCause, Family, Level, StrokeList};
use crate::preset::Preset;
use crate::raster::{Footprint, Grain};
use crate::realise::{Canvas, LevelScratch, Plan, Reached, Window, fill_thresholds};
use crate::sequence::{Draw, Sequence};
use crate::stroke::Stroke;

/// Draws all levels, and returns the strokes and, for each level and column, what the cell came to.
pub(crate) fn draw_levels(
    plan: &Plan<'_>,
    preset: &Preset,
    families: &[Family],
    sequences: &mut [Sequence],
    scratch: &mut [LevelScratch],
    levels: &mut [Level],
) -> Result<(StrokeList, Vec<Vec<Reached>>), GenerateError> {
    let (level_count, columns) = (levels.len(), plan.tones.len());
    let mut pyramids: Vec<Pyramid> =
        levels.iter().enumerate().map(|(l, level)| Pyramid::new(level.size, level_count - 1 - l)).collect();
    let grains: Vec<Vec<Arc<Grain>>> = levels.iter().map(|level| plan.grains(level.size)).collect();
    for (scratch, level) in scratch.iter_mut().zip(levels.iter_mut()) {
        scratch.canvas.reset(level.size);
        scratch.thresholds.reset(level.size);
        level.cells.resize_with(columns, Vec::new);
    }

    let mut draw = Draw::new(preset.seed, "praun");
    let mut strokes: Vec<Stroke> = Vec::new();
    let mut first_column = vec![Vec::new(); level_count];
    let mut reached = vec![vec![Reached { sum: 0, cause: Some(DeficitCause::WholeStrokes) }; columns]; level_count];
    let mut candidates: Vec<Stroke> = Vec::new();

    for column in 0..columns {
        let count = preset.placement.candidates(column, columns);
        for l in (0..level_count).rev() {
            let target = plan.target(column, levels[l].size);
            let mut window = Window::default();
            while scratch[l].canvas.sum() < target {
                if plan.job.cancelled() {
                    return Err(GenerateError::Cancelled);
                }
                draw.seek(strokes.len() as u32);
                candidates.clear();
                candidates.extend((0..count).map(|_| {
                    let turn = (draw.unit() * plan.schedule[column].len() as f64) as usize;
                    sequences[usize::from(plan.schedule[column][turn])].random_stroke(&mut draw)
                }));
                let best = best_candidate(plan, &candidates, &pyramids[..=l], &grains);

                let family = usize::from(best.family);
                let before = scratch[l].canvas.sum();
                for finer in 0..=l {
                    let LevelScratch { canvas, thresholds, footprint, .. } = &mut scratch[finer];
                    let nib = &plan.nibs[family];
                    nib.footprint(&best, levels[finer].size, &grains[finer][family], footprint);
                    canvas.draw(footprint, nib.opacity, plan.measure);
                    thresholds.add(canvas.fresh());
                    pyramids[finer].update(footprint, canvas);
                }
                strokes.push(best);
                for (level, first) in first_column.iter_mut().enumerate() {
                    first.push(if level <= l { column as u8 } else { StrokeList::NEVER });
                }
                window.note(&scratch[l].footprint, scratch[l].canvas.sum() - before);
                if window.saturated() {
                    reached[l][column].cause = Some(DeficitCause::Saturated);
                    break;
                }
            }
            reached[l][column].sum = scratch[l].canvas.sum();
            scratch[l].canvas.copy_ink_to(&mut levels[l].cells[column]);
            plan.job.report((column as f32 + 1.0 - l as f32 / level_count as f32) / columns as f32);
        }
    }

    for (scratch, (level, grains)) in scratch.iter_mut().zip(levels.iter().zip(&grains)) {
        let next = vec![0; families.len()];
        fill_thresholds(plan, level.size, grains, next, scratch, &mut |family, index| {
            sequences[usize::from(family)].stroke(index)
        })?;
    }
    let closing = vec![vec![Vec::new(); columns]; level_count];
    Ok((StrokeList { families: families.to_vec(), strokes, first_column, closing }, reached))
}

/// The candidate with the highest score; of equals the first, so that threads do not matter.
fn best_candidate(plan: &Plan<'_>, candidates: &[Stroke], pyramids: &[Pyramid], grains: &[Vec<Arc<Grain>>]) -> Stroke {
    let scores: Vec<f32> = candidates
        .par_iter()
        .with_min_len(32)
        .map_init(Footprint::default, |footprint, candidate| {
            let family = usize::from(candidate.family);
            let darkens: f32 = pyramids
                .iter()
                .zip(grains)
                .map(|(pyramid, grains)| {
                    plan.nibs[family].footprint(candidate, pyramid.size, &grains[family], footprint);
                    pyramid.darkening(footprint)
                })
                .sum();
            // Dots have no length; their width stands in.
            darkens / candidate.length_uv().max(candidate.width_px / pyramids[0].size as f32)
        })
        .collect();
    let mut best = 0;
    for (i, score) in scores.iter().enumerate() {
        if *score > scores[best] {
            best = i;
        }
    }
    candidates[best]
}

/// The image pyramid of one level, as its candidates feel it.
struct Pyramid {
    size: u32,
    /// Darkness of the pyramid's levels above the image itself, each half the size of the one before.
    darkness: Vec<Vec<f32>>,
    /// For each texel, the paper left at it and at its ancestors: Σ_p (1 - D_p).
    paper: Vec<f32>,
}

impl Pyramid {
    /// The pyramid of white paper, with `depth` levels above the image: none for the coarsest level, one more for each finer.
    fn new(size: u32, depth: usize) -> Self {
        let side = size as usize;
        Self {
            size,
            darkness: (1..=depth).map(|p| vec![0.0; (side >> p) * (side >> p)]).collect(),
            paper: vec![(depth + 1) as f32; side * side],
        }
    }

    /// What a stroke would add to the mean darkness of the image and its pyramid, together.
    fn darkening(&self, footprint: &Footprint) -> f32 {
        let sum: f32 = footprint.iter().map(|(texel, ink)| f32::from(ink) * self.paper[texel]).sum();
        sum / (255.0 * self.size as f32 * self.size as f32)
    }

    /// Takes in the stroke that the canvas has drawn last.
    fn update(&mut self, footprint: &Footprint, canvas: &Canvas) {
        let (shift, mask) = (self.size.ilog2(), self.size - 1);
        let depth = self.darkness.len() as u32;
        let mut blocks: Vec<u32> = Vec::with_capacity(footprint.len());
        for (&texel, under) in footprint.texel.iter().zip(canvas.under()) {
            let (x, y) = (texel & mask, texel >> shift);
            let more = f32::from(canvas.ink_at(texel).saturating_sub(under.ink())) / 255.0;
            for (p, darkness) in (1..).zip(&mut self.darkness) {
                darkness[(((y >> p) << (shift - p)) | (x >> p)) as usize] += more / (1_u32 << (2 * p)) as f32;
            }
            blocks.push((y >> depth) << (shift - depth) | (x >> depth));
        }
        blocks.sort_unstable();
        blocks.dedup();
        for block in blocks {
            let (left, top) = ((block & (mask >> depth)) << depth, (block >> (shift - depth)) << depth);
            for y in top..top + (1 << depth) {
                for x in left..left + (1 << depth) {
                    let texel = y << shift | x;
                    let mut paper = 1.0 - f32::from(canvas.ink_at(texel)) / 255.0;
                    for (p, darkness) in (1..).zip(&self.darkness) {
                        paper += 1.0 - darkness[(((y >> p) << (shift - p)) | (x >> p)) as usize];
                    }
                    self.paper[texel as usize] = paper;
                }
            }
        }
    }
}
