//! What a file or a sample hands over before anything is checked.

use std::ops::Range;

use glam::{Vec2, Vec3};

use crate::stage::Held;

use super::Animation;

/// An unchecked triangle mesh: indices may be out of range, positions may be non-finite, triangles may be slivers,
/// doubled or turned around. [`prepare`](super::prepare) makes a [`Mesh`](super::Mesh) of it.
#[derive(Clone, Debug, Default)]
pub struct RawMesh {
    /// What the mesh calls itself; shown in reports.
    pub name: String,
    /// One per vertex, in the file's own units and place.
    pub positions: Vec<Vec3>,
    /// One per vertex, or empty: normals are then made from the triangles.
    pub normals: Vec<Vec3>,
    /// One per vertex, or empty. 1.0 is one repeat of a texture.
    pub uvs: Vec<Vec2>,
    /// Vertex indices, counter-clockwise seen from outside where the source is consistent.
    pub triangles: Vec<[u32; 3]>,
    /// Ranges of `triangles` that are one object each, in order and without gaps; empty means one part.
    pub parts: Vec<RawPart>,
    /// Movement of the vertices, where the file has one.
    pub animation: Option<Animation>,
    /// Whether it was made by [`Sample::build`](super::sample::Sample::build), and no file has to do with it.
    pub made: bool,
    /// What the reader found and left out, in whole sentences.
    pub notes: Vec<String>,
}

impl Held for RawMesh {
    fn held(&self) -> usize {
        self.positions.held() + self.normals.held() + self.uvs.held() + self.triangles.held()
    }
}

/// One object of a [`RawMesh`].
#[derive(Clone, Debug, PartialEq)]
pub struct RawPart {
    /// The object's or its material's name.
    pub name: String,
    /// Base colour, linear light, each 0..=1; `None` where the source gives none.
    pub colour: Option<[f32; 3]>,
    /// Its triangles.
    pub triangles: Range<usize>,
}
