//! All that a mapping needs of a surface, made in one go.

use super::curvature::{Curvature, curvatures};
use super::field::{Field, FieldOptions, field};
use super::graph::Graph;
use super::patches::{PatchOptions, Patches, patches};
use super::solve::SolveError;
use crate::mesh::Mesh;

/// What is made of a surface.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurfaceOptions {
    /// Which way strokes run.
    pub field: FieldOptions,
    /// Patches, for the mapping of that name.
    pub patches: Option<PatchOptions>,
}

/// A surface that strokes lie on.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Nodes and links.
    pub graph: Graph,
    /// By node.
    pub curvatures: Vec<Curvature>,
    /// Directions of the strokes.
    pub field: Field,
    /// Overlapping patches.
    pub patches: Option<Patches>,
    /// Lapped patches.
    pub lapped: Option<Patches>,
}

impl Surface {
    /// Makes what the options ask for.
    ///
    /// # Errors
    /// [`SolveError`] if the field cannot be solved for.
    pub fn new(mesh: &Mesh, options: &SurfaceOptions) -> Result<Self, SolveError> {
        let graph = Graph::new(mesh);
        let curvatures = curvatures(&graph);
        let field = field(&graph, mesh, &curvatures, &options.field)?;
        let patches = options.patches.map(|options| patches(&graph, &curvatures, &field, &options));
        Ok(Self { graph, curvatures, field, patches, lapped: None })
    }
}
