//! Twin of `lib/patched.wgsl`: the vertex stage of methods that draw with all mappings.

use super::patches::{Overlap, corner_overlap, corner_vertex};
use super::surface::{FragmentIn, VertexOut, mesh_vertex, surface_vertex};
use crate::cpu::{Bindings, Mapping};

/// What the vertex at an index hands on: where patches are drawn on, the index names a corner, with what it sees of them.
pub fn patched_vertex(b: &Bindings<'_>, index: u32) -> (VertexOut, Overlap) {
    if b.options.mapping == Mapping::Patches {
        return (mesh_vertex(b, corner_vertex(b.patches, index)), corner_overlap(b.options.follow, b.patches, index));
    }
    (surface_vertex(b, index), Overlap::default())
}

/// What a fragment gets of the patches that overlap there.
pub fn overlap_of(input: &FragmentIn) -> &Overlap {
    &input.overlap
}
