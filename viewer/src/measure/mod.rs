//! Measures of pictures: numbers that tell hatching that follows form and light from hatching that only looks busy.
//!
//! ```text
//! mesh, scene, field ─► aov (what is wanted at each pixel) ─┐
//! rendered pixels ────► ink ────────────────────────────────┴─► tone | direction | run length | greyness | edges | width
//! two or three frames ─► track (where surface points go) ─────► coherence | light swimming | popping | flicker | zoom
//! ```
//!
//! All are functions of pictures on the CPU, the same for any number of threads. Ink is averaged in linear light;
//! perceived differences are then taken in CIE L*. Every measure has a control in its tests that it must fail.

mod aov;
mod blur;
mod direction;
mod edge_continuity;
mod fit;
mod greyness;
mod motion_coherence;
mod plane;
mod popping;
mod run_length;
mod still;
mod structure;
#[cfg(test)]
mod testing;
mod tone;
mod track;
mod width;
mod zoom;

pub use aov::{Aov, Strokes, Surface};
pub use blur::MaskedBlur;
pub use direction::{Direction, direction};
pub use edge_continuity::{EdgeContinuity, edge_continuity};
pub use fit::log_slope;
pub use greyness::{Greyness, greyness, greyness_of};
pub use motion_coherence::{LightSwimming, MotionCoherence, light_swimming, motion_coherence};
pub use plane::{Plane, ink, lightness};
pub use popping::{Popping, flicker, largest_change, popping};
pub use run_length::{RunLength, run_length};
pub use still::{MeasureOptions, Measures, measures};
pub use structure::structure;
pub use tone::{Errors, Tone, tone};
pub use track::Track;
pub use width::{Width, stroke_width, width_constancy};
pub use zoom::{Zoom, zoom};
