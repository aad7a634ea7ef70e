//! All that a mapping needs of a surface, made in one go.

use std::sync::Arc;

use glam::DMat4;
use tam_gen::Job;
use tam_shaders::types;

use super::coarse::{Coarse, Ground, radius_of_fields};
use super::curvature::{Curvature, curvatures, curvatures_on};
use super::field::{Field, FieldOptions, field};
use super::graph::Graph;
use super::lapped::{LappedOptions, lapped};
use super::patches::turns::Turns;
use super::patches::{PatchOptions, Patches, patches_on};
use super::solve::SolveError;
use super::stripes::rows::rows;
use super::stripes::{StripeError, StripeOptions, Stripes, stripes};
use crate::mesh::{Cut, Mesh};
use crate::params::{Mapping, Method, RenderParams};
use crate::stage::stage;

/// What is made of a surface.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct SurfaceOptions {
    /// Which way strokes run.
    pub field: FieldOptions,
    /// Patches, for the mapping of that name.
    pub patches: Option<PatchOptions>,
    /// Lapped patches, for the mapping of that name.
    pub lapped: Option<LappedOptions>,
    /// Stripes, for the method of that name.
    pub stripes: Option<StripeOptions>,
}

/// What of a surface ways to draw need beside its field; nothing at first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SurfaceNeeds {
    /// Patches, that strokes lie on or are cut by.
    pub patches: bool,
    /// Lapped patches.
    pub lapped: bool,
    /// Stripes.
    pub stripes: bool,
}

impl SurfaceNeeds {
    /// Those of one way to draw.
    pub fn of(params: &RenderParams) -> Self {
        let mapping = params.needed_mapping();
        Self {
            patches: mapping == Some(Mapping::Patches),
            lapped: mapping == Some(Mapping::Lapped),
            stripes: params.method == Method::Stripes,
        }
    }

    /// Those of this and of another way together.
    pub fn and(self, other: Self) -> Self {
        Self {
            patches: self.patches || other.patches,
            lapped: self.lapped || other.lapped,
            stripes: self.stripes || other.stripes,
        }
    }

    /// Options that give it: tiles and what patches follow are those of `params`. `None` where nothing is needed.
    pub fn options(
        self,
        field: FieldOptions,
        params: &RenderParams,
        planar: bool,
        lines_per_unit: f64,
    ) -> Option<SurfaceOptions> {
        let RenderParams { tiles_per_unit, follow, .. } = *params;
        let patches = PatchOptions { tiles_per_unit, follow, planar, ..PatchOptions::default() };
        let lapped = LappedOptions { tiles_per_unit, ..LappedOptions::default() };
        let stripes = StripeOptions { lines_per_unit, ..StripeOptions::default() };
        (self != Self::default()).then(|| SurfaceOptions {
            field,
            patches: self.patches.then_some(patches),
            lapped: self.lapped.then_some(lapped),
            stripes: self.stripes.then_some(stripes),
        })
    }
}

impl SurfaceOptions {
    /// The mesh cut as fine as its patches need it, or as fine as [`Mesh::cut`] goes; `None` where it is fine enough.
    pub fn cut(&self, mesh: &Mesh) -> Option<Cut> {
        let patches = self.patches.map(|patches| patches.longest_edge());
        let lapped = self.lapped.map(|lapped| lapped.longest_edge());
        let longest = patches.into_iter().chain(lapped).reduce(f64::min)?;
        mesh.cut(longest as f32)
    }
}

/// Tells how far it is, and stops when the job is cancelled.
struct Steps<'a>(&'a Job<'a>);

impl Steps<'_> {
    fn at(&self, part: f32) -> Result<(), SurfaceError> {
        self.0.report(part);
        if self.0.cancelled() { Err(SurfaceError::Cancelled) } else { Ok(()) }
    }
}

/// Why there is no surface.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SurfaceError {
    /// The field, or a lapped patch.
    #[error(transparent)]
    Field(#[from] SolveError),
    /// The stripes.
    #[error(transparent)]
    Stripes(#[from] StripeError),
    /// The job was cancelled.
    #[error("cancelled")]
    Cancelled,
}

/// What all surfaces of a mesh share along which strokes run alike, whatever their tiles and lines.
#[derive(Clone, Debug)]
pub struct SurfaceBase {
    /// Nodes and links.
    pub graph: Arc<Graph>,
    /// Directions of the strokes.
    pub field: Arc<Field>,
    found: Arc<Found>,
}

/// What directions were found from.
#[derive(Debug)]
struct Found {
    /// By node, or by cluster where there are clusters.
    curvatures: Vec<Curvature>,
    /// Of a mesh that is finer than strokes need, its clusters and the directions there.
    coarse: Option<(Coarse, Field)>,
}

impl SurfaceBase {
    /// Finds the directions of the strokes.
    ///
    /// # Errors
    /// [`SurfaceError`] if they cannot be solved for, or the job was cancelled.
    pub fn new(mesh: &Mesh, options: &FieldOptions, job: &Job<'_>) -> Result<Self, SurfaceError> {
        let step = Steps(job);
        step.at(0.0)?;
        let graph = stage("graph", || Graph::new(mesh));
        step.at(0.05)?;
        let coarse = stage("coarse graph", || Coarse::new(&graph, radius_of_fields(&graph)));
        step.at(0.1)?;
        let curvatures = stage("curvature", || match &coarse {
            Some(coarse) => curvatures_on(&graph, &coarse.graph, |node| coarse.clusters[node as usize]),
            None => curvatures(&graph),
        });
        step.at(0.15)?;
        let on = coarse.as_ref().map_or(&graph, |coarse| &coarse.graph);
        let found = stage("field", || field(on, mesh, &curvatures, options))?;
        let (field, coarse) = match coarse {
            Some(coarse) => (stage("field of all nodes", || coarse.field(&graph, &found)), Some((coarse, found))),
            None => (found, None),
        };
        let found = Found { curvatures, coarse };
        Ok(Self { graph: Arc::new(graph), field: Arc::new(field), found: Arc::new(found) })
    }

    /// What patches are laid out on: clusters, where those are as fine as patches need.
    fn ground(&self, options: &PatchOptions) -> Ground<'_> {
        let Found { curvatures, coarse } = &*self.found;
        let (graph, field) = (&*self.graph, &*self.field);
        match coarse {
            None => Ground { graph, curvatures: curvatures.into(), field, coarse: None },
            Some((coarse, of_clusters)) if coarse.serves(options) => {
                let curvatures = curvatures.into();
                Ground { graph: &coarse.graph, curvatures, field: of_clusters, coarse: Some(coarse) }
            }
            Some((coarse, _)) => {
                // Only how much it bends is asked for, not which way.
                let of_nodes: Vec<_> = coarse.clusters.iter().map(|cluster| curvatures[*cluster as usize]).collect();
                Ground { graph, curvatures: of_nodes.into(), field, coarse: None }
            }
        }
    }
}

/// A surface that strokes lie on.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Nodes and links.
    pub graph: Arc<Graph>,
    /// Directions of the strokes.
    pub field: Arc<Field>,
    /// Overlapping patches.
    pub patches: Option<Patches>,
    /// Lapped patches.
    pub lapped: Option<Patches>,
    /// Line fields.
    pub stripes: Option<Stripes>,
}

impl Surface {
    /// How patches that follow the light are turned in a scene: for each seed the copies that are drawn, each with its place
    /// on the tile, its angle and its share. Empty where there are no patches.
    pub fn turns(&self, scene: &types::Scene, world_from_mesh: DMat4) -> Vec<[f32; 4]> {
        let mut turns = Vec::new();
        if let Some(patches) = &self.patches {
            Turns::new(&self.graph, patches).under(&scene.into(), world_from_mesh, &mut turns);
        }
        turns
    }

    /// Makes what the options ask for.
    ///
    /// # Errors
    /// [`SurfaceError`] if field, lapped patches or stripes cannot be solved for, or the stripes' options are out of range.
    pub fn new(mesh: &Mesh, options: &SurfaceOptions) -> Result<Self, SurfaceError> {
        Self::new_with(mesh, options, &Job::default())
    }

    /// The same, followed and stopped by a job. It stops between two steps: on 100,000 triangles none takes a second.
    ///
    /// # Errors
    /// As [`Surface::new`], and [`SurfaceError::Cancelled`].
    pub fn new_with(mesh: &Mesh, options: &SurfaceOptions, job: &Job<'_>) -> Result<Self, SurfaceError> {
        Self::on(&SurfaceBase::new(mesh, &options.field, job)?, mesh, options, job)
    }

    /// The same, where the directions of the strokes are known: those of the mesh, by the field that the options ask for.
    ///
    /// # Errors
    /// As [`Surface::new_with`].
    pub fn on(base: &SurfaceBase, mesh: &Mesh, options: &SurfaceOptions, job: &Job<'_>) -> Result<Self, SurfaceError> {
        let step = Steps(job);
        let (graph, field) = (Arc::clone(&base.graph), Arc::clone(&base.field));
        step.at(0.3)?;
        let mut patches = options.patches.map(|options| patches_on(&base.ground(&options), &graph, &field, &options));
        step.at(0.6)?;
        let lapped = options.lapped.map(|options| stage("lapped patches", || lapped(&graph, &field, &options)));
        let lapped = lapped.transpose()?;
        step.at(0.8)?;
        let stripes = options
            .stripes
            .map(|options| stage("stripes", || stripes(&graph, &mesh.neighbours, &field, &options)))
            .transpose()?;
        if let (Some(patches), Some(stripes)) = (&mut patches, &stripes) {
            patches.rows = stage("rows", || rows(&graph, &mesh.neighbours, patches, stripes));
        }
        step.at(1.0)?;
        Ok(Self { graph, field, patches, lapped, stripes })
    }
}
