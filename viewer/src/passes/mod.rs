//! The passes: what each draws with, and how it is recorded. One stem with the shaders' entry files.

mod debug;
mod every;
mod face_frame;
mod faces;
mod fine_tone;
mod lines;
mod phong;
mod shading;
mod six_way;
mod stripes;
mod stroke_map;

pub use every::{Tried, try_pipelines};
pub(crate) use faces::Faces;
pub(crate) use lines::{LineKind, Lines};
pub(crate) use shading::{Shading, Variant, variant};
