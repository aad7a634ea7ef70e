//! What every way to draw a scene costs, and how far it is from what is wanted.
//!
//! ```text
//! methods, mappings, forms, maps ─► ways ──┐
//! scene ─► views (still, moved, relit) ────┴─► figures of each way: cost, bytes, errors
//! ```
//!
//! Views and what is wanted in them are made once; each way is then drawn into all of them. METRICS of the measures are
//! in [`crate::measure`]; drawing charts of the figures is left to the caller, which finds
//! axes and fronts in [`MEASURES`].

mod cost;
mod figures;
mod maps;
mod measures;
mod views;
mod ways;

pub use cost::{Cost, Setting, cost};
pub use figures::{Figures, measure_way};
pub use maps::{MapChoice, Maps, one_family};
pub use measures::{COST_AXIS, COST_LOG_FROM, MEASURES, Measure, is_repeated};
pub use views::Views;
pub(crate) use views::relit;
pub use ways::{VARIETY, Way, WaysOptions, ways};
