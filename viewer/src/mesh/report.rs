//! What preparation found and mended.

use serde::Serialize;

/// Counts of what a mesh is and of what was done to it.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct MeshReport {
    /// Vertices, split where uv or normal differ.
    pub vertices: usize,
    /// Points, welded.
    pub points: usize,
    /// Triangles kept.
    pub triangles: usize,
    /// Objects kept.
    pub parts: usize,
    /// Sets of triangles connected through edges that exactly two share.
    pub components: usize,
    /// Whether every edge has exactly two triangles, consistently oriented.
    pub closed: bool,
    /// Points - edges + triangles; 2 for a sphere, 0 for a torus.
    pub euler: i64,
    /// Edges of one triangle.
    pub boundary_edges: usize,
    /// Edges of three or more triangles; boundaries to all of them.
    pub non_manifold_edges: usize,
    /// Edges cut because no orientation is consistent across all (Möbius strip); boundaries to both triangles.
    pub cut_edges: usize,
    /// Triangles dropped since they have no area, or none after welding.
    pub dropped_degenerate: usize,
    /// Triangles dropped since an earlier one has the same three points, either way round.
    pub dropped_doubled: usize,
    /// Triangles dropped since an index is not below the number of vertices.
    pub dropped_out_of_range: usize,
    /// Triangles dropped since a coordinate is infinite or not a number.
    pub dropped_non_finite: usize,
    /// Vertices of the source that no kept triangle uses.
    pub dropped_vertices: usize,
    /// Triangles kept whose area is below 1e-6 of the square of their longest edge.
    pub slivers: usize,
    /// Triangles turned around.
    pub flipped: usize,
    /// Used vertices of the source that fell onto an earlier one.
    pub welded: usize,
    /// Whether there is a parametrisation.
    pub has_uv: bool,
    /// Texture coordinates that were not finite, and are zero now.
    pub mended_uvs: usize,
    /// Vertices whose normal is that of the file.
    pub normals_from_file: usize,
    /// Triangle corners whose normal in the file was missing, not finite or opposed to the face.
    pub normals_refused: usize,
    /// Whether it is a sample, of which there is no file.
    #[serde(skip)]
    pub made: bool,
    /// What the reader of the file has to say.
    pub reader_notes: Vec<String>,
}

impl MeshReport {
    /// What was found and mended, in whole sentences; empty for a mesh in good order.
    pub fn notes(&self) -> Vec<String> {
        let mut notes = self.reader_notes.clone();
        let mut note = |count: usize, one: &str, many: &str| match count {
            0 => {}
            1 => notes.push(format!("1 {one}.")),
            _ => notes.push(format!("{count} {many}.")),
        };
        note(
            self.dropped_out_of_range,
            "triangle was dropped: it points to a vertex that is not there",
            "triangles were dropped: they point to vertices that are not there",
        );
        note(
            self.dropped_non_finite,
            "triangle was dropped: its coordinates are not finite",
            "triangles were dropped: their coordinates are not finite",
        );
        note(self.dropped_degenerate, "triangle without area was dropped", "triangles without area were dropped");
        note(
            self.dropped_doubled,
            "triangle was dropped: another has the same corners",
            "triangles were dropped: others have the same corners",
        );
        note(self.slivers, "triangle is a sliver", "triangles are slivers");
        note(
            self.flipped,
            "triangle was turned around to agree with its neighbours",
            "triangles were turned around to agree with their neighbours",
        );
        note(
            self.non_manifold_edges,
            "edge has more than two triangles and counts as a boundary",
            "edges have more than two triangles and count as boundaries",
        );
        note(
            self.cut_edges,
            "edge was cut: the surface has only one side",
            "edges were cut: the surface has only one side",
        );
        note(
            self.mended_uvs,
            "texture coordinate was not finite and is zero now",
            "texture coordinates were not finite and are zero now",
        );
        // Without any normal in the file there is nothing to refuse, and at the tips of a sample, where its form has no
        // normal, made ones are what is wanted.
        if self.normals_from_file > 0 && !self.made {
            note(
                self.normals_refused,
                "corner has a made normal: the file's is unusable",
                "corners have made normals: the file's are unusable",
            );
        }
        notes
    }
}
