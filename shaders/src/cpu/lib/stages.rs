//! Twin of `lib/stages.wgsl`, whose entry points are those of [`super::patched`].

use glam::DVec2;

use super::mesh_types::Vertex;
use super::patched::{patched_corner, patched_face, patched_turning, patched_uv, patched_vertex};
use super::patches::{OVERLAPS, Overlap};
use super::surface::VertexOut;
use crate::Feed;
use crate::cpu::Bindings;
use crate::types::{LineCorner, PatchCorner};

/// All that a vertex may carry; a feed has some of it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Carried {
    /// Place and normal.
    pub vertex: Vertex,
    /// The mesh's own.
    pub uv: DVec2,
    /// What a corner sees of patches.
    pub patches: PatchCorner,
    /// Of lapped textures those that are painted over these.
    pub over: PatchCorner,
    /// Their seeds.
    pub seeds: [u32; OVERLAPS],
    /// Of both fields of lines.
    pub lines: LineCorner,
    /// Rows of lines on the patches.
    pub rows: [u32; OVERLAPS],
    /// Number of the vertex, where three are pulled to a face.
    pub index: u32,
}

/// What the entry point of a feed hands on.
///
/// # Panics
/// If it is another that hands on so.
pub fn stage(b: &Bindings<'_>, feed: Feed, carried: &Carried) -> (VertexOut, Overlap) {
    let Carried { vertex, uv, patches, seeds, index, .. } = carried;
    match feed {
        Feed::Vertices => patched_vertex(b, vertex),
        Feed::Uvs => patched_uv(b, vertex, *uv),
        Feed::Corners => patched_corner(b, vertex, patches),
        Feed::Turning => patched_turning(b, vertex, patches, *seeds),
        Feed::Faces => patched_face(b, *index),
        Feed::Lapped | Feed::Lines | Feed::Strokes | Feed::Faced => panic!("{feed:?} feed no mapped method"),
    }
}
