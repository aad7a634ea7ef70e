//! No more than a scene needs: the cheapest way to draw a scene that keeps its tone, over a range of cameras and lights.
//!
//! ```text
//! ranges ─► views (ends and middles) ─────────────┐
//! methods, mappings ─► cheapest frame that holds ─┼─► smallest map that holds ─► coarsest level ─► fitted
//!                                                 │                                                  │
//!           views in between, added on failure ◄──┴───────────────── verified ◄──────────────────────┘
//! ```
//!
//! All by measuring: what is recommended was drawn into every view, and what is cheaper was seen to fail in one.

mod maps;
mod range;
mod search;
mod words;

pub use maps::{FitMap, smaller};
pub use range::{FitRange, FitView};
pub use search::{Bench, Fit, FitError, FitOptions, Tried, Worst, fit};
