//! Surfaces: fields, patches and stripes of a mesh.

use std::sync::Arc;
use std::time::Duration;

use tam_gen::Job;

use super::named::Named;
use super::worker::{Manner, Wake, Worker};
use crate::mesh::{Cut, Mesh};
use crate::surface::{FieldOptions, Surface, SurfaceBase, SurfaceError, SurfaceOptions};

/// A surface is for one mesh and one set of options.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SurfaceRequest {
    pub mesh: Named<Mesh>,
    pub options: SurfaceOptions,
}

/// A mesh, cut finer where its patches need it, and its surface.
#[derive(Clone, Debug)]
pub(super) struct MadeSurface {
    pub request: SurfaceRequest,
    pub mesh: Named<Mesh>,
    pub surface: Named<Surface>,
    /// What to know of it.
    pub note: Option<String>,
}

pub(super) enum SurfaceReply {
    Made(Box<MadeSurface>),
    /// Which one could not be made, where that is known, and why.
    Failed(Option<Box<SurfaceRequest>>, String),
}

pub(super) type SurfaceWorker = Worker<SurfaceRequest, SurfaceReply>;

/// Starts the worker that makes surfaces.
pub(super) fn surface_worker(wake: Wake) -> std::io::Result<SurfaceWorker> {
    let work = |bases: &mut Bases, request: SurfaceRequest, job: &Job<'_>, reply: &dyn Fn(SurfaceReply)| match bases
        .surface(request.clone(), job)
    {
        Ok(made) => reply(SurfaceReply::Made(Box::new(made))),
        Err(SurfaceError::Cancelled) => {}
        Err(error) => {
            let words = format!("strokes cannot follow this mesh: {error}");
            reply(SurfaceReply::Failed(Some(Box::new(request)), words));
        }
    };
    let failed = |words: String| SurfaceReply::Failed(None, format!("strokes cannot follow this mesh: {words}"));
    Worker::start(
        "surfaces",
        Manner { patience: Duration::ZERO, leaves_behind: true },
        wake,
        Bases::default,
        work,
        failed,
    )
}

/// Makes a surface, of which nothing is known yet.
pub(super) fn make_surface(request: SurfaceRequest, job: &Job<'_>) -> Result<MadeSurface, SurfaceError> {
    Bases::default().surface(request, job)
}

/// What surfaces were made on, so that another one of the same mesh, of other tiles or lines, needs not begin anew.
#[derive(Default)]
pub(super) struct Bases {
    /// The last one was used last.
    kept: Vec<Base>,
}

struct Base {
    /// As it was loaded.
    of: Named<Mesh>,
    /// As it was cut.
    mesh: Named<Mesh>,
    field: FieldOptions,
    base: SurfaceBase,
}

/// Vertices of meshes whose bases are kept, all together.
const KEPT_VERTICES: usize = 2_000_000;

impl Bases {
    /// Makes a surface.
    pub(super) fn surface(&mut self, request: SurfaceRequest, job: &Job<'_>) -> Result<MadeSurface, SurfaceError> {
        let SurfaceRequest { mesh: of, options } = &request;
        let cut = options.cut(of);
        let note = cut.as_ref().and_then(Cut::note);
        let mut mesh = cut.map_or_else(|| of.clone(), |cut| of.cut(cut.mesh));
        // What is cut at the same places is the same mesh.
        if let Some(kept) = self.kept.iter().find(|kept| kept.mesh == mesh) {
            mesh = kept.mesh.clone();
        }
        let is_it = |kept: &Base| kept.mesh == mesh && kept.field == options.field;
        let kept = match self.kept.iter().position(is_it) {
            Some(index) => Base { of: of.clone(), ..self.kept.remove(index) },
            None => Base {
                of: of.clone(),
                mesh: mesh.clone(),
                field: options.field.clone(),
                base: SurfaceBase::new(&mesh, &options.field, job)?,
            },
        };
        let base = kept.base.clone();
        self.kept.push(kept);
        self.make_room();
        let surface = Named::surface(&mesh, options, Surface::on(&base, &mesh, options, job)?);
        Ok(MadeSurface { request, mesh, surface, note })
    }

    /// Drops what was used longest ago, and what nobody else has any more.
    fn make_room(&mut self) {
        let last = self.kept.pop();
        self.kept.retain(|kept| Arc::strong_count(kept.of.shared()) > 1);
        self.kept.extend(last);
        let mut vertices: usize = self.kept.iter().map(|kept| kept.mesh.positions.len()).sum();
        while vertices > KEPT_VERTICES && self.kept.len() > 1 {
            vertices -= self.kept.remove(0).mesh.positions.len();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::prepare;
    use crate::mesh::sample::Sample;
    use crate::surface::{FieldSource, PatchOptions};

    #[test]
    fn other_tiles_keep_mesh_graph_and_field_and_give_the_same_patches_as_alone() {
        let mesh = Named::mesh(prepare(Sample::Sphere.build(20_000)).expect("a mesh").mesh);
        let mut bases = Bases::default();
        let request = |tiles_per_unit, source| {
            let patches = Some(PatchOptions { tiles_per_unit, ..PatchOptions::default() });
            let field = FieldOptions { source, ..FieldOptions::default() };
            let options = SurfaceOptions { field, patches, ..SurfaceOptions::default() };
            SurfaceRequest { mesh: mesh.clone(), options }
        };
        let mut made =
            |tiles, source| bases.surface(request(tiles, source), &Job::default()).expect("a surface of the ball");
        let first = made(0.8, FieldSource::Curvature);
        let other = made(0.9, FieldSource::Curvature);
        assert!(first.mesh == other.mesh && Arc::ptr_eq(&first.surface.field, &other.surface.field));
        assert!(Arc::ptr_eq(&first.surface.graph, &other.surface.graph));
        let alone = Bases::default().surface(other.request.clone(), &Job::default()).expect("the same again");
        let entries = |made: &MadeSurface| made.surface.patches.as_ref().map(|patches| patches.entries.clone());
        assert!(entries(&other) == entries(&alone) && entries(&other) != entries(&first));
        let turned = made(0.8, FieldSource::LowerCurvature);
        assert!(first.mesh == turned.mesh && !Arc::ptr_eq(&first.surface.field, &turned.surface.field));
        // As fine as ten times as many tiles need it, it is another mesh.
        assert!(first.mesh != made(10.0, FieldSource::Curvature).mesh);
    }
}
