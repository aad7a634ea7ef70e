//! Hatching shaders for tonal art maps: WGSL, the types it shares with Rust, and twins of its functions on the CPU.
//!
//! - [`compose()`]: the source of a pass, with the pieces it includes; [`feed`]: by which vertices it is fed.
//! - [`types`]: what the passes read, laid out as the shaders expect it; a test compares every offset.
//! - [`cpu`]: the shader functions in `f64`, one for one, as the reference for what a GPU draws.

pub mod compose;
pub mod cpu;
pub mod feed;
pub mod types;

pub use compose::{Pass, compose};
pub use feed::Feed;
