//! What the shaders read, laid out as WGSL lays it out.

use bytemuck::{Pod, Zeroable};

/// Lights of a scene, at most.
pub const MAX_LIGHTS: usize = 8;
/// Columns of a map, at most, without the implicit white.
pub const MAX_COLUMNS: usize = 64;
/// Mark of a face without area: no normal has this code.
pub const NO_NORMAL: u32 = 0x8000_8000;
/// Mark of a missing neighbour.
pub const NO_FACE: u32 = u32::MAX;

/// `Light` of `lib/scene.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Light {
    /// In the world; not used by directional lights.
    pub position: [f32; 3],
    /// 0 directional, 1 positional, 2 spot.
    pub kind: u32,
    /// Unit, from the light into the scene; not used by positional lights.
    pub direction: [f32; 3],
    /// Cosine of the angle beyond which a spot gives no light.
    pub cos_cutoff: f32,
    /// Luminance it gives a white surface that faces it.
    pub intensity: f32,
    /// Power of the cosine from a spot's axis.
    pub exponent: f32,
    /// Fills the record.
    pub _pad: [f32; 2],
}

/// `Scene` of `lib/scene.wgsl`: what every pass is told once per frame.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Scene {
    /// Columns of the projection of the world.
    pub clip_from_world: [[f32; 4]; 4],
    /// Columns of the placement of the mesh.
    pub world_from_mesh: [[f32; 4]; 4],
    /// Its inverse.
    pub mesh_from_world: [[f32; 4]; 4],
    /// Its cofactor matrix.
    pub world_from_mesh_normal: [[f32; 4]; 4],
    /// Place of the camera.
    pub camera_world: [f32; 3],
    /// Side of a pixel in world units at distance 1.
    pub pixel_world_at_1: f32,
    /// Unit, into the picture.
    pub camera_forward: [f32; 3],
    /// Number of lights.
    pub light_count: u32,
    /// Width and height.
    pub viewport_px: [f32; 2],
    /// Luminance from everywhere.
    pub ambient: f32,
    /// Distance of the camera's target where its lines of sight are parallel; 0 where they meet in its place.
    pub parallel_from: f32,
    /// Linear light.
    pub paper: [f32; 4],
    /// Linear light.
    pub ink: [f32; 4],
    /// The first `light_count` count.
    pub lights: [Light; MAX_LIGHTS],
}

/// `Vertex` of `lib/mesh_types.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Vertex {
    /// In the mesh's space.
    pub position: [f32; 3],
    /// Octahedral; see [`oct_encode`](crate::cpu::lib::octahedral::oct_encode).
    pub normal_oct: u32,
}

/// `FaceFrame` of `lib/mesh_types.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct FaceFrame {
    /// Along the strokes.
    pub tangent: [f32; 3],
    /// First coordinate of the bitangent.
    pub bitangent_x: f32,
    /// Its others.
    pub bitangent_yz: [f32; 2],
    /// Shares of the frame, its half turn and the fixed frame, ten bits each.
    pub shares: u32,
    /// Normal of the face, octahedral, or [`NO_NORMAL`] where it has no area.
    pub normal_oct: u32,
}

/// `Material` of `lib/material.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Material {
    /// Linear light, under the strokes.
    pub colour: [f32; 4],
    /// Share of the scene's ambient light that is seen.
    pub ambient: f32,
    /// Diffuse reflectance.
    pub diffuse: f32,
    /// Strength of the highlight.
    pub specular: f32,
    /// Its exponent.
    pub shininess: f32,
    /// Rows of the matrix from surface coordinates to tiles.
    pub tile_from_surface: [f32; 4],
    /// Added to tile coordinates.
    pub shift_uv: [f32; 2],
    /// Tiles per unit of the surface coordinates.
    pub tile_scale: f32,
    /// Side of the finest level.
    pub size_px: f32,
    /// Levels of the map.
    pub level_count: f32,
    /// Added to the level; negative is finer.
    pub level_bias: f32,
    /// Columns of the map, without white.
    pub column_count: u32,
    /// First triangle of the draw.
    pub first_face: u32,
    /// Slope of the one-sided threshold.
    pub slope: f32,
    /// Least distance of halftone lines on the screen.
    pub line_period_px: f32,
    /// Entries in a row of the distribution table, or 0.
    pub distribution_entries: f32,
    /// Darkness above which stripes are crossed by others; 1: never.
    pub cross_from: f32,
    /// How much the strokes of stripes differ, 0..=1.
    pub variety: f32,
    /// Columns to a darkness of 1 where they are evenly spaced; 0: they are not.
    pub columns_per_tone: f32,
    /// Fills the record.
    pub _pad_a: f32,
    /// Fills the record.
    pub _pad_b: f32,
    /// Tone of white (0) and of each column, increasing.
    pub tones: [[f32; 4]; 17],
}

/// `LineStyle` of `lib/edges.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct LineStyle {
    /// Linear light; alpha is opacity.
    pub colour: [f32; 4],
    /// Width on the screen.
    pub width_px: f32,
    /// Edges whose normals have a smaller dot product are creases.
    pub crease_cosine: f32,
    /// Not 0: draw contours.
    pub contours: u32,
    /// Not 0: draw borders.
    pub borders: u32,
    /// Not 0: draw creases.
    pub creases: u32,
    /// Not 0: draw every edge.
    pub edges: u32,
    /// Fills the record.
    pub _pad_a: u32,
    /// Fills the record.
    pub _pad_b: u32,
}

/// `Edge` of `lib/edges.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct Edge {
    /// Vertex of one end.
    pub a: u32,
    /// Vertex of the other.
    pub b: u32,
    /// Face on one side.
    pub left: u32,
    /// Face on the other, or [`NO_FACE`].
    pub right: u32,
}

/// What a corner of a triangle sees of up to four patches: the attributes of `CornerIn` in `lib/patched.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Pod, Zeroable)]
pub struct PatchCorner {
    /// Its places on the tile, two 16-bit snorm each, in units of 4 tiles.
    pub places: [u32; 4],
    /// How far each stands behind the nearest, two 16-bit unorm to the word, in units of 4 feathers; all that is not there
    /// stands that far behind. Of lapped textures the alphas, 0 for all that is not there.
    pub behind: [u32; 2],
}

/// What a corner carries of the lines of both fields: the attributes of `LineIn` in `lib/striped.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct LineCorner {
    /// Of the lines along and across, in lines.
    pub phases: [f32; 2],
    /// Around the middle of a triangle in which lines end: the weights of the side's two corners, 0 or 1, and how often the
    /// phases along and across wind. 0 elsewhere.
    pub ring: [i8; 4],
}
