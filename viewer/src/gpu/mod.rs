//! The GPU: context, meshes and maps on it, targets and reading back. Needs no window.

mod context;
mod layouts;
mod map;
mod mesh;
mod surface;
mod target;

pub use context::{AdapterSummary, Gpu, GpuError, GpuOptions};
pub use map::{GpuMap, MapError, MapKind};
pub use mesh::GpuMesh;
pub use target::{Picture, PixelFormat, Target};

pub(crate) use layouts::Layouts;
pub(crate) use map::MapTextures;
pub(crate) use mesh::{FramesKey, GeometryKey};
pub(crate) use surface::SurfaceBuffers;
pub(crate) use target::DEPTH_FORMAT;
