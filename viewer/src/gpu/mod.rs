//! The GPU: context, meshes and maps on it, targets and reading back. Needs no window.

mod context;
mod corners;
pub(crate) mod feeds;
mod layouts;
mod made;
mod map;
mod mesh;
mod placed;
mod surface;
mod target;
mod uniforms;
mod views;

pub use context::{AdapterSummary, Gpu, GpuError, GpuOptions};
pub use made::Made;
pub use map::{GpuMap, MapError, MapKind};
pub use mesh::GpuMesh;
pub use target::{Picture, PixelFormat, Target};
pub use views::{TargetFormats, TargetViews};

pub(crate) use layouts::Layouts;
pub(crate) use map::MapTextures;
pub(crate) use placed::{FaceData, FramesKey, GeometryKey, PlacedMesh};
pub(crate) use uniforms::{Offsets, Uniforms};
