//! Tonal art maps: nested, mipmapped hatching textures whose tone is exact.
//!
//! A [`Preset`] says what strokes look like. [`generate`] turns it into a [`Map`]:
//!
//! ```text
//! preset ─► sequence ─► raster ─► grid (TAM) ─► stroke map ─► checks ─► export
//! ```
//!
//! Generation is deterministic to the byte for a preset, whatever the number of threads or the machine.

#[doc(hidden)]
pub mod chart;
pub mod checks;
#[cfg(feature = "cli")]
pub mod command;
pub mod error;
pub mod export;
pub mod files;
mod generate;
pub mod import;
pub mod job;
pub mod map;
pub mod measure;
mod placement;
pub mod preset;
pub mod problems;
pub mod raster;
mod realise;
mod rounding;
pub mod sequence;
pub mod srgb;
pub mod stroke;
mod tail;

pub use error::GenerateError;
pub use generate::{Generator, generate, generate_finer, tone_tolerance};
pub use job::Job;
pub use map::{Closing, Deficit, DeficitCause, Family, Grid, Level, Map, StrokeList, StrokeMap, ThresholdLevel};
pub use preset::Preset;
pub use stroke::{Axis, Stroke};

/// The examples of the project's front page, so that they keep working.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;
