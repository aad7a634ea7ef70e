//! WGSL sources and their CPU twins; they come with the renderer.
