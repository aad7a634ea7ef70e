//! Renders meshes with tonal art maps on the GPU, without a window.
//!
//! ```text
//! mesh ─► surface ─► gpu ─► passes ─► frame ─► image
//! ```

pub mod mesh;
