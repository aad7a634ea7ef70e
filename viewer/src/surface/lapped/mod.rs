//! Lapped textures: irregular patches pasted one over the other until the surface is covered. Praun, Finkelstein and
//! Hoppe, "Lapped textures", 2000, in the form that Praun, Hoppe, Webb and Finkelstein, "Real-time hatching", 2001,
//! section 6, give to tonal art maps. It is what [`patches`](super::patches()) are measured against.
//!
//! ```text
//! graph, field ─► flat faces ─► until all are covered: outline ─► grown and flattened ─► faded ─► pasted
//! ```
//!
//! Patches take their places one after the other, so one core makes them.

mod cover;
mod faces;
mod fade;
mod flatten;
mod grow;
mod outline;
#[cfg(test)]
mod tests;

use glam::DVec2;
use tam_gen::sequence::Draw;

use super::field::Field;
use super::graph::Graph;
use super::patches::{Patches, Seed};
use super::solve::SolveError;
use crate::params::Follow;
use cover::Cover;
use grow::Grower;
use outline::Outline;

/// How lapped patches are made.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LappedOptions {
    /// Repeats of the tile per unit of the mesh for which patches are made: they grow with the tile.
    pub tiles_per_unit: f64,
    /// Mean radius of a patch in tiles, 0.1..=2.
    pub radius_tiles: f64,
    /// Width of the alpha ramp within the outline in tiles, 0.01..=`radius_tiles`.
    pub feather_tiles: f64,
    /// By how much of the radius the outline may leave a circle, 0..=0.6.
    pub irregularity: f64,
}

impl Default for LappedOptions {
    fn default() -> Self {
        Self { tiles_per_unit: 1.5, radius_tiles: 0.45, feather_tiles: 0.12, irregularity: 0.3 }
    }
}

impl LappedOptions {
    /// Length of edges, in mesh units, above which outlines are coarse.
    pub fn longest_edge(&self) -> f64 {
        self.feather_tiles / self.tiles_per_unit
    }
}

/// The lapped patches of a surface. Every triangle has one at least, whatever the mesh, and the first one that a
/// triangle has is opaque; [`Entry::behind`](super::patches::Entry::behind) holds the alpha of the corners.
///
/// Patches end at hard edges, where the graph ends too. Places of triangles more than four tiles long are cut off.
///
/// # Errors
/// [`SolveError`] if a patch cannot be laid flat.
pub fn lapped(graph: &Graph, field: &Field, options: &LappedOptions) -> Result<Patches, SolveError> {
    let (seeds, cover) = painted(graph, field, options)?;
    let (starts, entries) = cover.finish();
    Ok(Patches {
        seeds,
        starts,
        entries,
        rows: Vec::new(),
        tiles_per_unit: options.tiles_per_unit,
        follow: Follow::Surface,
        lapped: true,
    }
    .in_steps())
}

/// Patches pasted until all triangles are covered, and their seeds.
fn painted(graph: &Graph, field: &Field, options: &LappedOptions) -> Result<(Vec<Seed>, Cover), SolveError> {
    let &LappedOptions { tiles_per_unit, radius_tiles, feather_tiles, irregularity } = options;
    let faces = faces::faces(graph, field);
    let mut cover = Cover::new(faces.len());
    let mut grower = Grower::new(graph, &faces, tiles_per_unit);
    let mut seeds = Vec::new();
    for seed in by_chance(faces.len()) {
        if cover.is_covered(seed as usize) {
            continue;
        }
        let mut draw = Draw::new(seeds.len() as u64, "lapped patch");
        let offset_uv = [draw.unit(), draw.unit()];
        let outline = Outline::new(radius_tiles, irregularity, &mut draw);
        let mut patch = grower.grow(seed, &outline)?;
        if !fade::is_sound(&faces, &patch, &patch.members[0], tiles_per_unit) {
            patch = grower.alone(seed);
        }
        fade::cut_folds(&faces, &mut patch, tiles_per_unit);
        let alphas = fade::alphas(&patch, &outline, feather_tiles);
        cover.paste(seeds.len() as u32, &patch, &alphas, DVec2::from(offset_uv));
        let node = graph.triangles[seed as usize][0];
        seeds.push(Seed { node, angle_rad: field.angles_rad[node as usize], offset_uv });
    }
    Ok((seeds, cover))
}

/// All triangles in an order that has nothing to do with their places.
fn by_chance(triangles: usize) -> Vec<u32> {
    let mut draw = Draw::new(0, "lapped seeds");
    let mut order: Vec<(f64, u32)> = (0..triangles as u32).map(|triangle| (draw.unit(), triangle)).collect();
    order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    order.into_iter().map(|(_, triangle)| triangle).collect()
}
