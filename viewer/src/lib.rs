//! Renders meshes with tonal art maps on the GPU, without a window.
//!
//! ```text
//! mesh ─► surface ─► gpu ─► passes ─► frame ─► image
//! ```

pub mod mesh;
pub mod surface;

pub mod maps;
pub mod params;
pub mod ranges;
pub mod scene;
pub mod scene_file;

pub mod reference;

pub mod chart;
pub mod fit;
pub mod inspect;
pub mod measure;
pub mod stability;

mod frame;
pub mod gpu;
mod object;
mod passes;
mod renderer;
mod stage;
mod timer;

pub mod sheet;
pub mod turntable;

#[cfg(feature = "app")]
pub mod app;

pub use object::Object;
pub use params::{Blend, DebugView, FaceFrameForm, Follow, Form, Inspect, Mapping, Method, RenderParams, Silhouettes};
pub use passes::{Tried, try_pipelines};
pub use renderer::{RenderError, Renderer};
pub use scene::{AxisView, Camera, Light, LightKind, Lights, Material, Projection, Scene};
pub use timer::FrameTimer;
