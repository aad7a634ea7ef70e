//! All that a mapping needs of a surface, made in one go.

use super::curvature::{Curvature, curvatures};
use super::field::{Field, FieldOptions, field};
use super::graph::Graph;
use super::patches::{PatchOptions, Patches, patches};
use super::solve::SolveError;
use super::stripes::rows::rows;
use super::stripes::{StripeError, StripeOptions, Stripes, stripes};
use crate::mesh::Mesh;

/// What is made of a surface.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurfaceOptions {
    /// Which way strokes run.
    pub field: FieldOptions,
    /// Patches, for the mapping of that name.
    pub patches: Option<PatchOptions>,
    /// Stripes, for the method of that name.
    pub stripes: Option<StripeOptions>,
}

/// Why there is no surface.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SurfaceError {
    /// The field.
    #[error(transparent)]
    Field(#[from] SolveError),
    /// The stripes.
    #[error(transparent)]
    Stripes(#[from] StripeError),
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
    /// Line fields.
    pub stripes: Option<Stripes>,
}

impl Surface {
    /// Makes what the options ask for.
    ///
    /// # Errors
    /// [`SurfaceError`] if field or stripes cannot be solved for, or the stripes' options are out of range.
    pub fn new(mesh: &Mesh, options: &SurfaceOptions) -> Result<Self, SurfaceError> {
        let graph = Graph::new(mesh);
        let curvatures = curvatures(&graph);
        let field = field(&graph, mesh, &curvatures, &options.field)?;
        let mut patches = options.patches.map(|options| patches(&graph, &curvatures, &field, &options));
        let stripes = options.stripes.map(|options| stripes(&graph, &field, &options)).transpose()?;
        if let (Some(patches), Some(stripes)) = (&mut patches, &stripes) {
            patches.rows = rows(&graph, &mesh.neighbours, patches, stripes);
        }
        Ok(Self { graph, curvatures, field, patches, lapped: None, stripes })
    }
}
