//! Patches: many small parametrisations that follow the direction field and overlap, so that whole strokes follow the
//! form of any mesh. Praun and others, "Real-Time Hatching", 2001, section 6, made current: seeds spread evenly, a
//! discrete exponential map around each, and blending by distance instead of painting.
//!
//! ```text
//! graph, field ─► density ─► seeds ─► exponential maps ─► bent along the field ─► corners of the triangles
//! ```

mod bend;
mod corners;
mod exp_map;
mod fallback;
mod maps;
mod seeds;
pub(crate) mod turns;
pub use rayon::prelude::*;

use super::coarse::Ground;
use super::curvature::Curvature;
use super::field::Field;
use super::graph::Graph;
use crate::params::Follow;
use crate::stage::{Held, stage};

pub use corners::{Entry, MAX_ENTRIES};
pub use exp_map::exponential_map;
pub(super) use seeds::Ordered;

/// How patches are made.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PatchOptions {
    /// Repeats of the tile per unit of the mesh for which patches are made: they grow with the tile.
    pub tiles_per_unit: f64,
    /// Distance of the seeds in tiles, 0.1..=1.5.
    pub spacing_tiles: f64,
    /// Width in tiles over which patches pass into each other, 0.01..=1.
    pub feather_tiles: f64,
    /// How much denser seeds are where the surface bends, 1..=8.
    pub greatest_density: f64,
    /// Whether patches bend along the field within themselves.
    pub bent: bool,
    /// Whether patches are projections on the seeds' tangent planes: cheaper, and strokes are squeezed where the surface
    /// turns away.
    pub planar: bool,
    /// Along the field; or straight in the seeds' own frames, to be turned with the light when they are drawn.
    pub follow: Follow,
}

impl Default for PatchOptions {
    fn default() -> Self {
        Self {
            tiles_per_unit: 1.5,
            spacing_tiles: 0.4,
            feather_tiles: 0.18,
            greatest_density: 2.5,
            bent: true,
            planar: false,
            follow: Follow::Surface,
        }
    }
}

impl PatchOptions {
    /// Length of edges, in mesh units, above which patches are coarse. Where the surface bends they stand up to
    /// `greatest_density` times closer than the spacing, so that even there two or three edges lie between seeds.
    pub fn longest_edge(&self) -> f64 {
        self.spacing_tiles / self.tiles_per_unit / 6.0
    }
}

/// The centre of a patch.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Seed {
    /// Its node.
    pub node: u32,
    /// Angle of the patch's first axis in the node's frame, in radians.
    pub angle_rad: f64,
    /// Place of the seed on the tile, each 0..1, so that no two patches show the same strokes; 0 where it follows the
    /// light.
    pub offset_uv: [f64; 2],
}

/// The patches of a surface, as a shader reads them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Patches {
    /// The centres.
    pub seeds: Vec<Seed>,
    /// Per triangle: the first of its entries, and after the last triangle their number.
    pub starts: Vec<u32>,
    /// What each triangle sees of its patches, by triangle; 1..=[`MAX_ENTRIES`] each.
    pub entries: Vec<Entry>,
    /// Per entry, how the stripes' phases in the triangle become those of the patch: 16 bits for the lines along, 16
    /// for those across, each a sign (lowest bit) and a number. Empty where there are no stripes.
    pub rows: Vec<u32>,
    /// Repeats of the tile per unit for which they were made.
    pub tiles_per_unit: f64,
    /// What they follow.
    pub follow: Follow,
    /// Whether they are painted one over another, by alpha, instead of blended.
    pub lapped: bool,
}

impl Patches {
    /// The entries of a triangle.
    pub fn of(&self, triangle: usize) -> &[Entry] {
        &self.entries[self.starts[triangle] as usize..self.starts[triangle + 1] as usize]
    }

    /// Rounds what entries say of distances and alphas to the steps in which corners are drawn and files are kept, so that
    /// all draw the same.
    #[must_use]
    pub(super) fn in_steps(mut self) -> Self {
        let lapped = self.lapped;
        self.entries.par_iter_mut().for_each(|entry| *entry = entry.in_steps(lapped));
        self
    }
}

impl Held for Patches {
    fn held(&self) -> usize {
        self.seeds.held() + self.starts.held() + self.entries.held() + self.rows.held()
    }
}

/// The patches of a surface. Every triangle has one at least, whatever the mesh.
pub fn patches(graph: &Graph, curvatures: &[Curvature], field: &Field, options: &PatchOptions) -> Patches {
    patches_on(&Ground { graph, curvatures: curvatures.into(), field, coarse: None }, graph, field, options)
}

/// The same, laid out on fewer nodes where the ground has them; `graph` and `field` are those of all nodes.
pub(super) fn patches_on(ground: &Ground<'_>, graph: &Graph, field: &Field, options: &PatchOptions) -> Patches {
    let spacing = options.spacing_tiles / options.tiles_per_unit;
    let density = seeds::density(ground, spacing, options.greatest_density);
    let nodes = stage("patches: seeds", || seeds::spread(ground.graph, &density, spacing));
    let maps = stage("patches: maps", || maps::maps(ground, graph, &density, &nodes, options));
    stage("patches: corners", || corners::gather(graph, field, maps, options).in_steps())
}

#[cfg(test)]
mod tests;
