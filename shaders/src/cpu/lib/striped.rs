//! Twin of `lib/striped.wgsl`: corners of triangles carry the phases of lines.

use glam::{DVec2, DVec4};

use super::mesh_types::Vertex;
use super::patches::{OVERLAPS, Overlap, carried_overlap, fetched};
use super::stripes::{wound_phase, wound_slope};
use super::surface::{VertexOut, surface_vertex};
use crate::cpu::{Bindings, Quad};
use crate::types::{LineCorner, PatchCorner};

/// The phase of one field at a fragment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Phase {
    /// In lines.
    pub at: f64,
    /// Its change to the next pixel and to the one below.
    pub slope: DVec2,
}

/// A corner with its phases; what it hands on of the ring.
pub fn line_vertex(b: &Bindings<'_>, vertex: &Vertex, lines: &LineCorner) -> (VertexOut, DVec4) {
    let phases = DVec2::from(lines.phases.map(f64::from));
    (surface_vertex(b.scene, vertex, phases), DVec4::from(lines.ring.map(f64::from)))
}

/// The same with the patches that strokes are counted on.
pub fn stroke_vertex(
    b: &Bindings<'_>,
    vertex: &Vertex,
    (patches, seeds): (&PatchCorner, [u32; OVERLAPS]),
    lines: &LineCorner,
) -> (VertexOut, Overlap, DVec4) {
    let (surface, ring) = line_vertex(b, vertex, lines);
    let (places, behind) = fetched(patches);
    (surface, carried_overlap(b.options.mapping, places, behind, seeds), ring)
}

/// The phase of a field, interpolated between the corners, as it is at a fragment.
pub fn phase_of(phases: &Quad<f64>, rings: &Quad<DVec4>, turns: f64, lane: usize) -> Phase {
    let ends = rings.map(|ring| DVec2::new(ring.x, ring.y));
    let at = ends[lane];
    let slope = |slope, change| wound_slope(slope, at, change, turns);
    Phase {
        at: wound_phase(phases[lane], at, turns),
        slope: DVec2::new(slope(phases.dpdx(lane), ends.dpdx(lane)), slope(phases.dpdy(lane), ends.dpdy(lane))),
    }
}
