//! What a surface says about strokes: curvature, and the direction field that strokes follow.
//!
//! ```text
//! mesh ─► graph ─► (coarse graph) ─► curvature ─► field ─► patches | lapped | stripes
//! ```

mod build;
mod coarse;
pub mod corners;
pub mod curvature;
pub mod field;
pub mod graph;
pub mod guides;
pub mod lapped;
pub mod patches;
mod solve;
pub mod store;
pub mod stripes;

pub use build::{Surface, SurfaceBase, SurfaceError, SurfaceNeeds, SurfaceOptions};
pub use corners::Corners;
pub use curvature::{Curvature, curvatures};
pub use field::{Field, FieldOptions, FieldSource, field};
pub use graph::Graph;
pub use guides::Guide;
pub use lapped::{LappedOptions, lapped};
pub use patches::{PatchOptions, Patches, patches};
pub use solve::SolveError;
pub use stripes::{StripeError, StripeOptions, Stripes, stripes};

#[cfg(test)]
pub(crate) mod tests;
