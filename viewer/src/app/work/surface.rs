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

pub(super) type SurfaceReply = Result<MadeSurface, (Option<SurfaceRequest>, String)>;

pub(super) type SurfaceWorker = Worker<SurfaceRequest, SurfaceReply>;

/// Starts the worker that makes surfaces.
pub(super) fn surface_worker(wake: Wake) -> std::io::Result<SurfaceWorker> {
    let work = |(): &mut (), request: SurfaceRequest, job: &Job<'_>, reply: &dyn Fn(SurfaceReply)| {
        let SurfaceOptions { patches, lapped, .. } = &request.options;
        let edges = [patches.map(|patches| patches.longest_edge()), lapped.map(|lapped| lapped.longest_edge())];
        let mesh = match edges.into_iter().flatten().reduce(f64::min) {
            Some(longest) => Arc::new(request.mesh.subdivided(longest as f32)),
            None => Arc::clone(&request.mesh),
        };
        match Surface::new_with(&mesh, &request.options, job) {
            Ok(surface) => reply(Ok(MadeSurface { request, mesh, surface: Arc::new(surface) })),
            Err(SurfaceError::Cancelled) => {}
            Err(error) => reply(Err((Some(request), format!("strokes cannot follow this mesh: {error}")))),
        }
    };
    let failed = |words: String| Err((None, format!("strokes cannot follow this mesh: {words}")));
    Worker::start("surfaces", Duration::ZERO, wake, || (), work, failed)
}
