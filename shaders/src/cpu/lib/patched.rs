//! Twin of `lib/patched.wgsl`: the vertex stages of methods that draw with all mappings, by what their vertices carry.

use glam::{DVec2, DVec4};

use super::faced::{face_of, pulled_vertex};
use super::mapping::{frame_place, frame_st};
use super::mesh_types::Vertex;
use super::patches::{NO_SEED, OVERLAPS, Overlap, carried_overlap, fetched};
use super::scene::Scene;
use super::surface::{FragmentIn, Point, VertexOut, surface_point, surface_vertex};
use crate::cpu::Bindings;
use crate::types::PatchCorner;

/// What a vertex hands on.
pub fn patched(surface: VertexOut, overlap: Overlap) -> (VertexOut, Overlap) {
    (surface, overlap)
}

/// What a vertex sees that sees no patches.
pub fn no_overlap() -> Overlap {
    Overlap { places: [DVec2::ZERO; OVERLAPS], behind: DVec4::ZERO, seeds: [NO_SEED; OVERLAPS] }
}

/// A vertex that carries nothing more.
pub fn patched_vertex(b: &Bindings<'_>, vertex: &Vertex) -> (VertexOut, Overlap) {
    patched(surface_vertex(b.scene, vertex, DVec2::ZERO), no_overlap())
}

/// A vertex with its uv.
pub fn patched_uv(b: &Bindings<'_>, vertex: &Vertex, uv: DVec2) -> (VertexOut, Overlap) {
    patched(surface_vertex(b.scene, vertex, uv), no_overlap())
}

/// A corner of a triangle.
pub fn patched_corner(b: &Bindings<'_>, vertex: &Vertex, corner: &PatchCorner) -> (VertexOut, Overlap) {
    patched_turning(b, vertex, corner, [NO_SEED; OVERLAPS])
}

/// The same of patches that turn with the light.
pub fn patched_turning(
    b: &Bindings<'_>,
    vertex: &Vertex,
    corner: &PatchCorner,
    seeds: [u32; OVERLAPS],
) -> (VertexOut, Overlap) {
    let (places, behind) = fetched(corner);
    let overlap = carried_overlap(b.options.mapping, places, behind, seeds);
    patched(surface_vertex(b.scene, vertex, DVec2::ZERO), overlap)
}

/// Lapped textures at a fragment or a vertex, in the order of painting.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lapped {
    /// The four that are painted first.
    pub first: Overlap,
    /// Those over them.
    pub then: Overlap,
}

/// A corner of a triangle with its lapped textures.
pub fn lapped_vertex(b: &Bindings<'_>, vertex: &Vertex, corners: [&PatchCorner; 2]) -> (VertexOut, Lapped) {
    let [first, then] = corners.map(|corner| {
        let (places, behind) = fetched(corner);
        carried_overlap(b.options.mapping, places, behind, [NO_SEED; OVERLAPS])
    });
    (surface_vertex(b.scene, vertex, DVec2::ZERO), Lapped { first, then })
}

/// Three vertices to a face, counted from the first face of the draw: the first two seeds are shares and normal of the
/// face's frame.
pub fn patched_face(b: &Bindings<'_>, index: u32) -> (VertexOut, Overlap) {
    let frame = &b.mesh.face_frames[face_of(b.material, index) as usize];
    let mut surface = surface_vertex(b.scene, &pulled_vertex(b, index), DVec2::ZERO);
    surface.uv = frame_st(frame, frame_place(b.options.form, b.scene, surface.p_world));
    patched(surface, Overlap { seeds: [frame.shares, frame.normal_oct, NO_SEED, NO_SEED], ..no_overlap() })
}

/// A fragment's surface point, with the frame that its strokes lie by.
pub fn patched_point(scene: &Scene, input: &FragmentIn, front: bool) -> Point {
    let [shares, normal_oct, ..] = input.overlap.seeds;
    Point { framing: [shares, normal_oct], ..surface_point(scene, input, front) }
}

/// What a fragment gets of lapped textures.
pub fn lapped_of(input: &FragmentIn) -> Lapped {
    Lapped { first: input.overlap, then: input.over }
}

/// The same without the one that is painted first.
pub fn stepped(lapped: &Lapped) -> Lapped {
    let Lapped { first, then } = lapped;
    let next = |here: &Overlap, place: DVec2, alpha: f64| Overlap {
        places: [here.places[1], here.places[2], here.places[3], place],
        behind: DVec4::new(here.behind.y, here.behind.z, here.behind.w, alpha),
        seeds: here.seeds,
    };
    Lapped { first: next(first, then.places[0], then.behind.x), then: next(then, DVec2::ZERO, 0.0) }
}

/// What a fragment gets of the patches that overlap there.
pub fn overlap_of(input: &FragmentIn) -> &Overlap {
    &input.overlap
}
