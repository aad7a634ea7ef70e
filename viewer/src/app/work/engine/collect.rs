//! What workers have made.

use std::sync::Arc;

use super::super::files::FileReply;
use super::super::picture::PictureReply;
use super::super::results::Results;
use super::super::surface::{MadeSurface, SurfaceReply};
use super::Engine;
use crate::app::state::{Notice, Severity};

/// Surfaces that are kept, so that switching back is at once.
const SURFACES: usize = 6;

impl Engine {
    /// Takes what workers have made; returns what the user should know, and whether the mesh asked for could not be loaded.
    pub(crate) fn collect(&mut self, results: &mut Results) -> (Vec<Notice>, bool) {
        let mut notices = std::mem::take(&mut self.told);
        let mut notice = |severity, text: String| notices.push(Notice { severity, text });
        let mut back = false;
        for reply in self.maps.replies() {
            match reply {
                Ok(made) => {
                    if !made.draft {
                        self.pace.map_made(made.preset.map.size, made.took);
                        self.checks.request(Arc::clone(&made));
                    }
                    (results.map, results.map_problem) = (Some(made), None);
                }
                Err(problem) => results.map_problem = Some(problem),
            }
        }
        for reply in self.other_maps.replies() {
            match reply {
                Ok(made) => self.other_maps_made.push(made),
                Err(problem) => {
                    self.other_maps_failed.extend(self.asked.other_map.take());
                    notice(Severity::Error, problem);
                }
            }
        }
        for (map, report) in self.checks.replies() {
            match (map, report) {
                (Some(map), Ok(report)) => results.report = Some((map, report)),
                (_, Ok(_)) => {}
                (_, Err(problem)) => notice(Severity::Error, problem),
            }
        }
        let mut loaded = false;
        for reply in self.meshes.replies() {
            self.asked.loading = None;
            match reply.result {
                Ok(mesh) => {
                    self.refused.clear();
                    results.meshes.retain(|known| known.source != mesh.source);
                    results.meshes.push(Arc::clone(&mesh));
                    if self.asked.mesh.as_ref() == Some(&mesh.source) {
                        results.mesh = Some(mesh);
                    }
                    loaded = true;
                }
                Err(problem) => {
                    notice(Severity::Error, problem);
                    self.meshes_failed.push(reply.source.clone());
                    if self.asked.mesh.as_ref() == Some(&reply.source) {
                        // What is shown needs not be loaded again.
                        self.asked.mesh = results.mesh.as_ref().map(|mesh| mesh.source.clone());
                        back = true;
                    }
                }
            }
        }
        if loaded {
            self.forget_cuts(&results.meshes);
        }
        let room = SURFACES.max(self.needed + 2);
        for reply in self.surfaces.replies() {
            match reply {
                SurfaceReply::Made(mut made) => {
                    if let Some(note) = made.note.take() {
                        notice(Severity::Info, note);
                    }
                    keep(&mut self.made, *made, room);
                }
                SurfaceReply::Failed(request, problem) => {
                    notice(Severity::Error, problem.clone());
                    results.surface_problem = Some(problem);
                    self.refused.extend(request.map(|request| *request).or_else(|| self.asked.surface.clone()));
                }
            }
        }
        for reply in self.pictures.replies() {
            match reply {
                PictureReply::Shown(shown) => {
                    self.pace.picture_drawn(shown.canvas.size_px(), shown.samples, shown.cost);
                    (results.picture, results.picture_problem) = (Some(shown), None);
                }
                PictureReply::Thumbnail { key, canvas } => {
                    results.thumbnails.insert(key, canvas);
                }
                PictureReply::Lost(cause) => results.device_lost = Some(cause),
                PictureReply::Failed(problem) => {
                    if results.picture_problem.as_ref() != Some(&problem) {
                        notice(Severity::Error, problem.clone());
                    }
                    results.picture_problem = Some(problem);
                }
            }
        }
        for reply in self.files.replies() {
            let what = self.writing.take().unwrap_or_default();
            match reply {
                FileReply::Written { text, .. } => notice(Severity::Done, format!("{what}: {text}")),
                FileReply::Failed(problem) => notice(Severity::Error, format!("{what}: {problem}")),
                FileReply::Cancelled => notice(Severity::Info, format!("{what} was stopped; nothing was written.")),
            }
        }
        for made in self.measuring.collect(results) {
            // What was made for a mesh that is still there saves the view from making it again.
            if results.mesh.as_ref().is_some_and(|mesh| mesh.mesh == made.request.mesh) {
                keep(&mut self.made, made, room);
            }
        }
        (notices, back)
    }
}

/// Keeps a surface, in place of the oldest.
fn keep(kept: &mut Vec<MadeSurface>, made: MadeSurface, room: usize) {
    if kept.len() >= room {
        kept.remove(0);
    }
    kept.push(made);
}
