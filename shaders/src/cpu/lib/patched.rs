//! Twin of `lib/patched.wgsl`: the vertex stage of methods that draw with all mappings.

use super::mapping::{frame_place, frame_st};
use super::material::Material;
use super::patches::{NO_SEED, Overlap, corner_overlap, corner_vertex};
use super::scene::Scene;
use super::surface::{FragmentIn, Point, VertexOut, mesh_vertex, surface_point, surface_vertex};
use crate::cpu::{Bindings, Mapping};

/// What the vertex at an index hands on: where patches are drawn on, the index names a corner, with what it sees of them;
/// where strokes lie by frames it counts three vertices to a face, and the first two seeds are shares and normal of the
/// face's frame.
pub fn patched_vertex(b: &Bindings<'_>, index: u32) -> (VertexOut, Overlap) {
    if b.options.mapping == Mapping::Patches {
        return (mesh_vertex(b, corner_vertex(b.patches, index)), corner_overlap(b.options.follow, b.patches, index));
    }
    if b.options.mapping == Mapping::Frames {
        let first = b.material.first_face;
        let frame = &b.mesh.face_frames[(index / 3 + first) as usize];
        let mut surface = mesh_vertex(b, b.mesh.indices[(index + 3 * first) as usize]);
        surface.uv = frame_st(frame, frame_place(b.options.form, b.scene, surface.p_world));
        let seeds = [frame.shares, frame.normal_oct, NO_SEED, NO_SEED];
        return (surface, Overlap { seeds, ..Overlap::default() });
    }
    (surface_vertex(b, index), Overlap::default())
}

/// A fragment's surface point, with the frame that its strokes lie by.
pub fn patched_point(scene: &Scene, material: &Material, input: &FragmentIn, front: bool) -> Point {
    let [shares, normal_oct, ..] = input.overlap.seeds;
    Point { framing: [shares, normal_oct], ..surface_point(scene, material, input, front) }
}

/// What a fragment gets of the patches that overlap there.
pub fn overlap_of(input: &FragmentIn) -> &Overlap {
    &input.overlap
}
