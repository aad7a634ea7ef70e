//! Surfaces: fields, patches and stripes of a mesh.

use std::sync::Arc;
use std::time::Duration;

use tam_gen::Job;

use super::worker::{Wake, Worker};
use crate::mesh::Mesh;
use crate::surface::{Surface, SurfaceError, SurfaceOptions};

/// A surface is for one mesh and one set of options.
#[derive(Clone, Debug)]
pub(super) struct SurfaceRequest {
    pub mesh: Arc<Mesh>,
    pub options: SurfaceOptions,
}

impl PartialEq for SurfaceRequest {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.mesh, &other.mesh) && self.options == other.options
    }
}

/// A mesh, cut finer where its patches need it, and its surface.
#[derive(Clone, Debug)]
pub(super) struct MadeSurface {
    pub request: SurfaceRequest,
    pub mesh: Arc<Mesh>,
    pub surface: Arc<Surface>,
}

pub(super) enum SurfaceReply {
    Made(Box<MadeSurface>),
    /// Which one could not be made, where that is known, and why.
    Failed(Option<Box<SurfaceRequest>>, String),
}

pub(super) type SurfaceWorker = Worker<SurfaceRequest, SurfaceReply>;

/// Starts the worker that makes surfaces.
pub(super) fn surface_worker(wake: Wake) -> std::io::Result<SurfaceWorker> {
    let work = |(): &mut (), request: SurfaceRequest, job: &Job<'_>, reply: &dyn Fn(SurfaceReply)| match make_surface(
        request.clone(),
        job,
    ) {
        Ok(made) => reply(SurfaceReply::Made(Box::new(made))),
        Err(SurfaceError::Cancelled) => {}
        Err(error) => {
            let words = format!("strokes cannot follow this mesh: {error}");
            reply(SurfaceReply::Failed(Some(Box::new(request)), words));
        }
    };
    let failed = |words: String| SurfaceReply::Failed(None, format!("strokes cannot follow this mesh: {words}"));
    Worker::start("surfaces", Duration::ZERO, wake, || (), work, failed)
}

/// Makes a surface.
pub(super) fn make_surface(request: SurfaceRequest, job: &Job<'_>) -> Result<MadeSurface, SurfaceError> {
    let mesh = request.options.cut(&request.mesh).map_or_else(|| Arc::clone(&request.mesh), Arc::new);
    let surface = Arc::new(Surface::new_with(&mesh, &request.options, job)?);
    Ok(MadeSurface { request, mesh, surface })
}
