//! Tonal art maps: nested, mipmapped hatching textures whose tone is exact.
//!
//! A [`Preset`] says what strokes look like. [`generate`] turns it into a [`Map`]:
//!
//! ```text
//! preset ─► sequence ─► raster ─► grid (TAM) ─► stroke map ─► checks ─► export
//! ```
//!
//! Generation is deterministic to the byte for a preset, whatever the number of threads or the machine.

pub mod error;
pub mod export;
pub mod import;
pub mod job;
pub mod map;
pub mod preset;
pub mod stroke;

pub use error::GenerateError;
pub use job::Job;
pub use map::{Closing, Deficit, DeficitCause, Family, Grid, Level, Map, StrokeList, StrokeMap, ThresholdLevel};
pub use preset::Preset;
pub use stroke::{Axis, Stroke};
