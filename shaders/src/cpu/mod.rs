//! Twins of the shader functions in `f64`: the reference for what a GPU draws.
//!
//! The tree is that of `wgsl`: [`lib`] holds the shared pieces, a module beside it one pass each, and functions keep
//! their names and their shape. What a shader reads from its bindings and constants, a twin is handed:
//! [`Options`] for the constants of the pipeline, [`Scene`], [`Material`],
//! [`MapImage`] and [`Mesh`], or all of them as [`Bindings`]. Derivatives come from a [`Quad`] of
//! neighbouring fragments, as on a GPU.

pub mod builtin;
pub mod debug;
pub mod face_frame;
pub mod face_frame_vertex;
pub mod face_frames;
pub mod face_geometry;
pub mod fine_tone;
pub mod image;
pub mod lib;
pub mod line_edges;
pub mod lines;
pub mod options;
pub mod phong;
pub mod quad;
pub mod six_way;
pub mod stripes;
pub mod stroke_map;

pub use image::{MapImage, MapLevel, Sampling};
pub use lib::octahedral;
pub use options::{Blend, DebugView, Follow, Form, Frames, Mapping, Options, PatternKind};
pub use quad::Quad;

use glam::{DVec2, DVec4};

use lib::{material::Material, mesh::Mesh, scene::Scene};

/// All that a drawing pass is bound to.
#[derive(Clone, Copy, Debug)]
pub struct Bindings<'a> {
    /// Constants of the pipeline.
    pub options: Options,
    /// Group 0.
    pub scene: &'a Scene,
    /// Group 1.
    pub mesh: Mesh<'a>,
    /// Group 2, binding 0.
    pub material: &'a Material,
    /// Group 2, bindings 1 and 2.
    pub map: &'a MapImage,
    /// Group 2, binding 3: rows of the distribution table, [`lib::threshold::ROWS_PER_LEVEL`] from each level to the
    /// next: shares and their rates; may be empty where the material's `distribution_entries` is 0.
    pub distribution: &'a [Vec<DVec2>],
    /// Group 3, binding 2: [`lib::patches::TURNS`] per seed: its place on the tile, angle, share; empty where patches lie
    /// still.
    pub turns: &'a [DVec4],
}
