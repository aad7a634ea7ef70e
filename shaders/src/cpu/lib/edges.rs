//! Twin of `lib/edges.wgsl`: edges of the mesh, and which of them are lines. Praun and others, "Real-Time Hatching",
//! 2001, section 2.

use glam::{DVec3, DVec4, Vec4};

use super::mesh::Mesh;
use super::mesh_types::NO_FACE;
use super::scene::Scene;
use crate::types::{self, Edge};

/// Which lines are drawn and how; fields as in [`types::LineStyle`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)]
pub struct LineStyle {
    pub colour: DVec4,
    pub width_px: f64,
    pub crease_cosine: f64,
    pub contours: bool,
    pub borders: bool,
    pub creases: bool,
    pub edges: bool,
}

impl From<&types::LineStyle> for LineStyle {
    fn from(style: &types::LineStyle) -> Self {
        Self {
            colour: Vec4::from(style.colour).as_dvec4(),
            width_px: style.width_px.into(),
            crease_cosine: style.crease_cosine.into(),
            contours: style.contours != 0,
            borders: style.borders != 0,
            creases: style.creases != 0,
            edges: style.edges != 0,
        }
    }
}

/// Whether a face is seen from its front.
pub fn faces_camera(scene: &Scene, mesh: &Mesh<'_>, face: u32, p_world: DVec3) -> bool {
    mesh.face_normals[face as usize].truncate().dot(scene.to_camera(p_world)) > 0.0
}

/// Which line an edge is: `LINE_NONE` and so on in the shader.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub enum LineKind {
    /// Not drawn.
    None = 0,
    /// In the middle of its edge.
    Centred = 1,
    /// A contour beside the edge, where the surface ends: to the right of a to b on the screen.
    Right = 2,
    /// The same to the left.
    Left = 3,
}

/// The kind of line that the edge is, as far as it is wanted.
pub fn line_kind(scene: &Scene, mesh: &Mesh<'_>, style: &LineStyle, edge: &Edge, p_world: DVec3) -> LineKind {
    let centred = |wanted: bool| if wanted { LineKind::Centred } else { LineKind::None };
    if style.edges {
        return LineKind::Centred;
    }
    let left = mesh.face_normals[edge.left as usize];
    if left.w == 0.0 {
        return LineKind::None;
    }
    if edge.right == NO_FACE {
        return centred(style.borders);
    }
    let right = mesh.face_normals[edge.right as usize];
    if right.w == 0.0 {
        return LineKind::None;
    }
    let front = faces_camera(scene, mesh, edge.left, p_world);
    if style.contours && front != faces_camera(scene, mesh, edge.right, p_world) {
        return if front { LineKind::Right } else { LineKind::Left };
    }
    let sharp = left.truncate().dot(right.truncate()) < style.crease_cosine;
    centred(style.creases && sharp)
}

/// Place of a vertex in the world.
pub fn end_world(scene: &Scene, mesh: &Mesh<'_>, vertex: u32) -> DVec3 {
    (scene.world_from_mesh * mesh.vertices[vertex as usize].position.extend(1.0)).truncate()
}
