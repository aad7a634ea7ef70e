//! Turntables: a scene along a path, as a series of frames that closes on itself.
//!
//! ```text
//! Path + phase ─► scene, vertex positions ─► Renderer ─► FrameWriter (folder of PNG, APNG, GIF)
//! ```

mod path;
mod swept;
mod writer;

pub use path::Path;
pub use swept::swept;
pub use writer::{FrameFile, FrameWriter, WriteError};
