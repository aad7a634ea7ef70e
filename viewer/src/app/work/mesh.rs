//! Meshes, from samples and files.

use std::sync::Arc;
use std::time::Duration;

use tam_gen::Job;

use super::super::state::MeshSource;
use super::named::Named;
use super::worker::{Manner, Wake, Worker};
use crate::mesh::{Mesh, MeshReport, load, prepare};

/// A mesh that was loaded.
#[derive(Debug)]
pub struct LoadedMesh {
    /// Where from.
    pub source: MeshSource,
    /// The mesh.
    pub mesh: Named<Mesh>,
    /// What was found and mended.
    pub report: MeshReport,
}

/// What became of a mesh that was asked for.
pub(super) struct MeshReply {
    pub source: MeshSource,
    pub result: Result<Arc<LoadedMesh>, String>,
}

pub(super) type MeshWorker = Worker<MeshSource, MeshReply>;

/// Starts the worker that loads meshes.
pub(super) fn mesh_worker(wake: Wake) -> std::io::Result<MeshWorker> {
    let work = |(): &mut (), source: MeshSource, _: &Job<'_>, reply: &dyn Fn(MeshReply)| {
        let loaded = match &source {
            MeshSource::Sample(sample, triangles) => prepare(sample.build(*triangles)),
            MeshSource::File(path) => load(path),
        };
        let result = match loaded {
            Ok(loaded) => {
                let mesh = Named::mesh(loaded.mesh);
                Ok(Arc::new(LoadedMesh { source: source.clone(), mesh, report: loaded.report }))
            }
            Err(error) => Err(error.to_string()),
        };
        reply(MeshReply { source, result });
    };
    let failed = |words: String| MeshReply {
        source: MeshSource::default(),
        result: Err(format!("the mesh could not be loaded: {words}")),
    };
    Worker::start("meshes", Manner { patience: Duration::ZERO, leaves_behind: true }, wake, || (), work, failed)
}
