//! Stripes: one line field over the whole surface, as engravers draw, from the direction field.
//!
//! ```text
//! field ─► growth (per link) ─► spacing (per node) ─► wave (per cluster) ─► settle (per node) ─► phases (per corner) ─► agree
//! ```
//!
//! The phase counts lines: it is whole in the middle of each, grows across them, and is known up to sign and whole
//! numbers. Lines can be doubled, phase by phase, without an old one moving, but not halved; so they are laid as far
//! apart as they are ever drawn.
//!
//! Knöppel, Crane, Pinkall and Schröder, "Stripe patterns on surfaces", 2015. Their lines stand evenly, so new ones
//! must branch off wherever directions spread. Ours may stand closer where directions draw together (`spacing.rs`),
//! since drawing doubles them by their distance on the screen; few branches are left.

mod agree;
mod clusters;
mod growth;
pub(crate) mod phase;
mod phases;
pub(crate) mod rows;
mod settle;
mod spacing;
mod wave;

#[cfg(test)]
mod tests;

use faer::c64;
use rayon::prelude::*;

use super::field::Field;
use super::graph::Graph;
use super::solve::SolveError;
use crate::ranges;
use crate::stage::Held;
pub use phase::StripePhases;

use growth::{Loop, growths, loops};

/// How stripes are laid.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct StripeOptions {
    /// Lines per mesh unit before any is doubled, 0.25..=64; a mesh is 2 units long. The coarsest that are drawn.
    pub lines_per_unit: f64,
    /// Whether a second field is made, whose lines cross those of the first at right angles.
    pub across: bool,
}

impl Default for StripeOptions {
    fn default() -> Self {
        Self { lines_per_unit: 4.0, across: true }
    }
}

/// Why there are no stripes.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum StripeError {
    /// Lines too many, too few, or no number.
    #[error("{0} lines per unit; allowed: {range}", range = ranges::LINES_PER_UNIT)]
    LinesPerUnit(f64),
    /// A system cannot be factorised.
    #[error(transparent)]
    Solve(#[from] SolveError),
}

/// The phases of the line fields of a surface, 16 bytes per triangle and field.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stripes {
    /// Per triangle: lines along the direction field.
    pub along: Vec<StripePhases>,
    /// Per triangle: lines across it; empty where none were asked for.
    pub across: Vec<StripePhases>,
}

impl Held for Stripes {
    fn held(&self) -> usize {
        self.along.held() + self.across.held()
    }
}

/// The stripes of a surface; `neighbours` are those of its triangles, edge k from corner k to the next. The same for any number
/// of threads.
///
/// # Errors
/// [`StripeError`]: options out of range, or a system that cannot be factorised.
pub fn stripes(
    graph: &Graph,
    neighbours: &[[u32; 3]],
    field: &Field,
    options: &StripeOptions,
) -> Result<Stripes, StripeError> {
    if !ranges::LINES_PER_UNIT.contains(options.lines_per_unit) {
        return Err(StripeError::LinesPerUnit(options.lines_per_unit));
    }
    let loops = loops(graph);
    // Both fields need it.
    graph.pattern()?;
    let along: Vec<c64> = field.angles_rad.par_iter().map(|angle| c64::from_polar(1.0, *angle)).collect();
    let (along, across) = rayon::join(
        || lines(graph, neighbours, &loops, &along, options),
        || {
            // A quarter turn is a multiplication by i.
            let across = || along.iter().map(|z| c64::new(-z.im, z.re)).collect::<Vec<_>>();
            if options.across { lines(graph, neighbours, &loops, &across(), options) } else { Ok(Vec::new()) }
        },
    );
    Ok(Stripes { along: along?, across: across? })
}

fn lines(
    graph: &Graph,
    neighbours: &[[u32; 3]],
    loops: &[Option<Loop>],
    along: &[c64],
    options: &StripeOptions,
) -> Result<Vec<StripePhases>, StripeError> {
    let growths = growths(graph, along);
    let frequencies = spacing::frequencies(graph, loops, &growths, along, options.lines_per_unit)?;
    let steps = growth::steps(graph, &growths, &frequencies);
    let clusters = clusters::clusters(graph, &steps);
    let wave = wave::wave(graph, &steps, &clusters)?;
    let settled = settle::settled(graph, &steps, &clusters, &wave)?;
    Ok(agree::agreed(graph, neighbours, &phases::phases(graph, loops, &steps, &settled)))
}
