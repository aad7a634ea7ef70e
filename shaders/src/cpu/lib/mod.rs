//! Twins of `wgsl/lib`.

pub mod adjacency;
pub mod barycentric;
pub mod blend;
pub mod colour;
pub mod columns;
pub mod corners;
pub mod directions;
pub mod edges;
pub mod face_frame;
pub mod form;
pub mod halftone;
pub mod light;
pub mod mapping;
pub mod material;
pub mod mesh;
pub mod mesh_types;
pub mod octahedral;
pub mod patched;
pub mod patches;
pub mod scene;
pub mod stripes;
pub mod strokes;
pub mod surface;
pub mod threshold;
