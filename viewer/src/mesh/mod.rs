//! Meshes, from a file or made here, to what the renderer takes: checked, welded, oriented, with neighbours and
//! smooth normals.
//!
//! ```text
//! file | sample ─► RawMesh ─► prepare (clean, weld, orient, adjacency, normals, scale) ─► Mesh + MeshReport
//! ```

mod animation;
pub mod deform;
mod error;
#[cfg(test)]
mod invariants;
mod joined;
mod load;
mod normals;
mod prepare;
mod query;
mod raw;
mod report;
pub mod sample;
mod subdivide;
mod table;
#[cfg(test)]
mod test_files;

use std::ops::Range;

pub use animation::Animation;
pub use error::MeshError;
pub use load::{BYTES_MAX, Kind, Resolve, load, read_raw};
pub use normals::{CREASE_DEGREES, SLIVER};
pub use prepare::{TRIANGLES_MAX, prepare};
pub use query::Edge;
pub use raw::{RawMesh, RawPart};
pub use report::MeshReport;
pub use subdivide::Cut;

use glam::{Vec2, Vec3};

use crate::stage::Held;

/// No neighbour: a boundary, or an edge that more than two triangles share.
pub const NONE: u32 = u32::MAX;

/// A mesh and what was done to it.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The mesh.
    pub mesh: Mesh,
    /// What was found and mended.
    pub report: MeshReport,
}

/// A checked triangle mesh, as the renderer takes it.
///
/// Vertices are split where uv or normal differ; `points` welds them again, and adjacency is that of the points.
#[derive(Clone, Debug)]
pub struct Mesh {
    /// The file's stem or the sample's name.
    pub name: String,
    /// Per vertex, normalised: the bounding box is centred at the origin and its longest side is 2.
    pub positions: Vec<Vec3>,
    /// Per vertex, unit length.
    pub normals: Vec<Vec3>,
    /// Per vertex, or empty where the mesh has no parametrisation.
    pub uvs: Vec<Vec2>,
    /// Per vertex: its welded point.
    pub points: Vec<u32>,
    /// Number of welded points.
    pub point_count: usize,
    /// Per vertex: vertices of one group share one smooth normal.
    pub normal_groups: Vec<u32>,
    /// Per vertex: its index in the [`RawMesh`], for animation; `u32::MAX` for those of `midpoints`.
    pub sources: Vec<u32>,
    /// The vertices by which edges were cut, the last ones, in order: each stands half way between two earlier ones.
    pub midpoints: Vec<[u32; 2]>,
    /// Vertex indices, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Per triangle: the triangle across the edge from corner k to corner k + 1, or [`NONE`].
    pub neighbours: Vec<[u32; 3]>,
    /// Objects, in order, covering all triangles.
    pub parts: Vec<Part>,
    /// How the file's coordinates became `positions`.
    pub placement: Placement,
    /// Movement, in the file's coordinates and the file's vertex order; see [`Mesh::pose`].
    pub animation: Option<Animation>,
}

impl Held for Loaded {
    fn held(&self) -> usize {
        let Mesh { positions, normals, uvs, points, normal_groups, sources, midpoints, triangles, neighbours, .. } =
            &self.mesh;
        let of_vertices = positions.held() + normals.held() + uvs.held() + points.held() + normal_groups.held();
        of_vertices + sources.held() + midpoints.held() + triangles.held() + neighbours.held()
    }
}

/// One object of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Its name in the file; may be empty.
    pub name: String,
    /// Base colour, linear light, each 0..=1; white where the file gives none.
    pub colour: [f32; 3],
    /// Its triangles.
    pub triangles: Range<u32>,
}

/// `p_mesh = (p_file - centre) * scale`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Centre of the file's bounding box, in the file's units.
    pub centre: glam::DVec3,
    /// Mesh units per file unit.
    pub scale: f64,
}
