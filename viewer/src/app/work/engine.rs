//! All workers, and what to ask them for.

use std::path::PathBuf;
use std::sync::Arc;

use tam_gen::Preset;
use tam_gen::export::ExportOptions;

use super::files::{FileReply, FileRequest, FileWorker, file_worker, formats};
use super::map::{CheckWorker, MadeMap, MapRequest, MapWorker, check_worker, map_worker};
use super::measuring::Measuring;
use super::mesh::{LoadedMesh, MeshWorker, mesh_worker};
use super::pace::Pace;
use super::painter::{Shot, Side};
use super::picture::{PictureReply, PictureRequest, PictureWorker, Stillness, picture_worker};
use super::results::{Results, Thumbnail};
use super::surface::{MadeSurface, SurfaceReply, SurfaceRequest, SurfaceWorker, surface_worker};
use super::thumbnails::{Subject, ThumbnailRequest, linear_colours};
use super::worker::Wake;
use crate::app::state::{Compare, Look, MeshSource, Motion, Notice, Severity, State};
use crate::app::words;
use crate::turntable::Path;
use crate::{Mapping, Method, Scene};

/// Surfaces that are kept, so that switching back is at once.
const SURFACES: usize = 6;

/// Triangles up to which strokes follow a mesh: beyond, the field alone takes minutes and gigabytes.
pub(super) const SURFACE_TRIANGLES: usize = 2_000_000;

/// What the view is like at the moment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Demand {
    /// Size of the view; 0 while it is hidden.
    pub size_px: [u32; 2],
    /// A button is held or something plays.
    pub moving: bool,
    /// The chart is in sight.
    pub chart_shown: bool,
}

/// The workers.
pub(crate) struct Engine {
    maps: MapWorker,
    other_maps: MapWorker,
    checks: CheckWorker,
    meshes: MeshWorker,
    surfaces: SurfaceWorker,
    pictures: PictureWorker,
    files: FileWorker,
    measuring: Measuring,
    asked: Asked,
    made: Vec<MadeSurface>,
    other_map: Option<Arc<MadeMap>>,
    /// Surfaces that cannot be made are not asked for again.
    refused: Vec<SurfaceRequest>,
    writing: Option<String>,
    pace: Pace,
    /// Messages for the next time that replies are collected.
    told: Vec<Notice>,
}

/// What was last asked for.
#[derive(Default)]
struct Asked {
    map: Option<MapRequest>,
    other_map: Option<MapRequest>,
    mesh: Option<MeshSource>,
    surface: Option<SurfaceRequest>,
    shot: Option<(Shot, Stillness)>,
}

impl Engine {
    /// Starts all workers.
    ///
    /// # Errors
    /// Where the system gives no threads.
    pub(crate) fn start(wake: &Wake) -> std::io::Result<Self> {
        Ok(Self {
            maps: map_worker(Arc::clone(wake))?,
            other_maps: map_worker(Arc::clone(wake))?,
            checks: check_worker(Arc::clone(wake))?,
            meshes: mesh_worker(Arc::clone(wake))?,
            surfaces: surface_worker(Arc::clone(wake))?,
            pictures: picture_worker(Arc::clone(wake))?,
            files: file_worker(Arc::clone(wake))?,
            measuring: Measuring::start(wake)?,
            asked: Asked::default(),
            made: Vec::new(),
            other_map: None,
            refused: Vec::new(),
            writing: None,
            pace: Pace::default(),
            told: Vec::new(),
        })
    }

    /// Whether anything is being made, or is yet to be asked for.
    pub(crate) fn is_busy(&self) -> bool {
        self.maps.is_busy()
            || self.other_maps.is_busy()
            || self.checks.is_busy()
            || self.meshes.is_busy()
            || self.surfaces.is_busy()
            || self.pictures.is_busy()
            || self.files.is_busy()
    }

    /// Asks for what the state needs and nobody was asked for yet.
    pub(crate) fn follow(&mut self, state: &State, demand: Demand, results: &mut Results) {
        self.follow_map(state, demand, results);
        self.follow_mesh(state);
        if let Some(mesh) = results.mesh.clone() {
            self.follow_surfaces(state, demand, &mesh, results);
            self.follow_picture(state, demand, &mesh, results);
            let busy = self.is_busy();
            self.measuring.follow(state, &scene(state, &mesh), demand, busy, &self.made, results);
        }
        let running = [
            ("Map", self.maps.progress()),
            ("Other map", self.other_maps.progress()),
            ("Checks", self.checks.progress()),
            ("Mesh", self.meshes.progress()),
            ("Surface", self.surfaces.progress()),
        ];
        results.running = running.into_iter().filter_map(|(name, part)| Some((name, part?))).collect();
        results.writing = self.writing.clone().zip(self.files.progress());
    }

    fn follow_map(&mut self, state: &State, demand: Demand, results: &mut Results) {
        let document = &state.document;
        let fine = |look: &Look| look.params.method == Method::FineTone;
        let request = |name: String, preset: &Preset, fine| MapRequest {
            name,
            preset: preset.clone(),
            draft_px: self.pace.draft_px(preset.map.size).filter(|_| demand.moving),
            fine,
        };
        let other = document.compare.as_ref();
        let fine_too = other.is_some_and(|other| other.preset.is_none() && fine(&other.look));
        let wanted = request(state.preset_name(), &document.preset, fine(&document.look) || fine_too);
        if is_new(&self.asked.map, &wanted) {
            self.asked.map = Some(wanted.clone());
            match wanted.preset.validate().into_iter().next() {
                None => self.maps.request(wanted),
                Some(violation) => {
                    results.map_problem = Some(format!("{}: {}", violation.problem, violation.expected));
                }
            }
        }
        let Some(Compare { preset: Some((name, preset)), look, .. }) = other else {
            (self.other_map, self.asked.other_map) = (None, None);
            return;
        };
        let wanted = request(name.clone(), preset, fine(look));
        if is_new(&self.asked.other_map, &wanted) {
            self.asked.other_map = Some(wanted.clone());
            if wanted.preset.validate().is_empty() {
                self.other_maps.request(wanted);
            }
        }
    }

    fn follow_mesh(&mut self, state: &State) {
        if self.asked.mesh.as_ref() != Some(&state.document.mesh) {
            self.asked.mesh = Some(state.document.mesh.clone());
            self.meshes.request(state.document.mesh.clone());
        }
    }

    fn follow_surfaces(&mut self, state: &State, demand: Demand, mesh: &LoadedMesh, results: &mut Results) {
        let looks = looks(state, mesh);
        let wanted = looks.iter().filter_map(|look| surface_request(look, state, mesh));
        let is_missing = |request: &SurfaceRequest| !self.made.iter().any(|made| made.request == *request);
        let (refused, missing): (Vec<_>, Vec<_>) =
            wanted.filter(is_missing).partition(|request| self.refused.contains(request));
        if refused.is_empty() {
            results.surface_problem = None;
        }
        if mesh.mesh.triangles.len() > SURFACE_TRIANGLES && !missing.is_empty() {
            let problem = format!(
                "Strokes follow meshes of up to {}; this one has {} and is drawn with three planes instead.",
                words::counted(SURFACE_TRIANGLES, "triangle"),
                words::grouped(mesh.mesh.triangles.len())
            );
            self.told.push(Notice { severity: Severity::Warning, text: problem.clone() });
            results.surface_problem = Some(problem);
            self.refused.extend(missing);
            return;
        }
        let Some(request) = missing.into_iter().next() else {
            if self.surfaces.is_busy() {
                self.surfaces.cancel();
            }
            self.asked.surface = None;
            return;
        };
        // While a slider moves, every surface would be outdated before it is made.
        if self.asked.surface.as_ref() != Some(&request) && !demand.moving {
            self.asked.surface = Some(request.clone());
            self.surfaces.request(request);
        }
    }

    fn follow_picture(&mut self, state: &State, demand: Demand, mesh: &LoadedMesh, results: &Results) {
        let Some(map) = &results.map else { return };
        if demand.size_px.contains(&0) {
            return;
        }
        let Some(mut shot) = self.shot(state, mesh, map, demand.size_px, 4) else { return };
        let costly = self.pace.coarser() > 1;
        let changed = self.asked.shot.as_ref().is_none_or(|(asked, _)| !asked.shows_same(&shot));
        // As long as nothing has moved yet, the picture that is looked at is the best there is.
        if self.asked.shot.as_ref().is_some_and(|(asked, _)| *asked == shot) {
            return;
        }
        let asked_moving = self.asked.shot.as_ref().is_some_and(|(_, stillness)| *stillness == Stillness::Moving);
        // A change is shown at once, coarsely where pictures are costly, and then as it is to be looked at.
        let moving = demand.moving || (costly && changed);
        if !moving && asked_moving && self.pictures.is_busy() {
            return;
        }
        let stillness = if moving { Stillness::Moving } else { Stillness::Still };
        if moving {
            shot.samples = 1;
        }
        if moving && costly {
            shot.size_px = demand.size_px.map(|side| side.div_ceil(self.pace.coarser()));
        }
        if self.asked.shot.as_ref().is_none_or(|(asked, _)| *asked != shot) {
            self.asked.shot = Some((shot.clone(), stillness));
            self.pictures.request(PictureRequest::View(Box::new(shot), stillness));
        }
    }

    /// Whether ways to draw are being measured, or wait to be.
    pub(crate) fn is_measuring(&self) -> bool {
        self.measuring.is_busy()
    }

    /// Looks for the least that the open scene needs. `false`: that is being done already, or the scene is not there yet.
    pub(crate) fn fit(&self, state: &State, results: &mut Results, view_px: [u32; 2]) -> bool {
        let Some(mesh) = results.mesh.clone() else { return false };
        self.measuring.fit(state, &scene(state, &mesh), view_px, &self.made, results)
    }

    /// Stops that.
    pub(crate) fn cancel_fit(&self) {
        self.measuring.cancel_fit();
    }

    /// What the view shows, at this size; `None` while something of it is still to be made.
    fn shot(
        &self,
        state: &State,
        mesh: &LoadedMesh,
        map: &Arc<MadeMap>,
        size_px: [u32; 2],
        samples: u32,
    ) -> Option<Shot> {
        let looks = looks(state, mesh);
        let mut sides = vec![self.side(&looks[0], state, mesh, map, &state.document.preset)];
        let mut split = 1.0;
        if let (Some(look), Some(compare)) = (looks.get(1), &state.document.compare) {
            let (map, preset) = match &compare.preset {
                Some((_, preset)) => (self.other_map.as_ref()?, preset),
                None => (map, &state.document.preset),
            };
            sides.push(self.side(look, state, mesh, map, preset));
            split = compare.split;
        }
        let scene = scene(state, mesh);
        let pose = state.transient.motion.map(|motion| (path_of(motion), state.transient.phase));
        Some(Shot { size_px, samples, scene, pose, sides, split })
    }

    /// One side, with the surface that is there: that of an older choice until the new one is made, and three planes until
    /// there is any.
    fn side(&self, look: &Look, state: &State, mesh: &LoadedMesh, map: &Arc<MadeMap>, preset: &Preset) -> Side {
        let side = |params, mesh: &Arc<_>, surface| Side {
            params,
            mesh: Arc::clone(mesh),
            surface,
            map: Arc::clone(&map.hatch),
            colours: linear_colours(preset),
        };
        let Some(request) = surface_request(look, state, mesh) else {
            return side(look.params, &mesh.mesh, None);
        };
        let exact = self.made.iter().find(|made| made.request == request);
        let serves =
            |made: &&MadeSurface| Arc::ptr_eq(&made.request.mesh, &request.mesh) && serves(&made.request, &request);
        match exact.or_else(|| self.made.iter().rev().find(serves)) {
            Some(made) => side(look.params, &made.mesh, Some(Arc::clone(&made.surface))),
            None => {
                let mut params = look.params;
                params.mapping = Mapping::Triplanar;
                if params.method == Method::Stripes {
                    params.method = Method::Phong;
                }
                side(params, &mesh.mesh, None)
            }
        }
    }

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
                Ok(made) => self.other_map = Some(made),
                Err(problem) => notice(Severity::Error, problem),
            }
        }
        for (map, report) in self.checks.replies() {
            match (map, report) {
                (Some(map), Ok(report)) => results.report = Some((map, report)),
                (_, Ok(_)) => {}
                (_, Err(problem)) => notice(Severity::Error, problem),
            }
        }
        for reply in self.meshes.replies() {
            match reply.result {
                Ok(mesh) => {
                    self.refused.clear();
                    self.made.retain(|made| Arc::ptr_eq(&made.request.mesh, &mesh.mesh));
                    results.mesh = Some(mesh);
                }
                Err(problem) => {
                    notice(Severity::Error, problem);
                    if self.asked.mesh.as_ref() == Some(&reply.source) {
                        // What is shown needs not be loaded again.
                        self.asked.mesh = results.mesh.as_ref().map(|mesh| mesh.source.clone());
                        back = true;
                    }
                }
            }
        }
        for reply in self.surfaces.replies() {
            match reply {
                SurfaceReply::Made(made) => keep(&mut self.made, *made),
                SurfaceReply::Failed(request, problem) => {
                    notice(Severity::Error, problem.clone());
                    results.surface_problem = Some(problem);
                    self.refused.extend(request.map(|request| *request).or_else(|| self.asked.surface.clone()));
                }
            }
        }
        for reply in self.pictures.replies() {
            match reply {
                PictureReply::Adapter(adapter) => results.adapter = Some(adapter),
                PictureReply::Shown(shown) => {
                    if shown.stillness == Stillness::Still {
                        self.pace.picture_drawn(shown.cost);
                    }
                    (results.picture, results.picture_problem) = (Some(shown), None);
                }
                PictureReply::Thumbnail { key, image } => {
                    results.thumbnails.insert(key, Thumbnail(image));
                }
                PictureReply::Reopened(cause) => {
                    notice(Severity::Warning, format!("{cause}. It was opened again; nothing is lost."));
                }
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
            if results.mesh.as_ref().is_some_and(|mesh| Arc::ptr_eq(&mesh.mesh, &made.request.mesh)) {
                keep(&mut self.made, made);
            }
        }
        (notices, back)
    }

    /// Loads the mesh again, as its file has changed.
    pub(crate) fn reload_mesh(&mut self) {
        self.asked.mesh = None;
    }

    /// Asks for a small picture of a preset.
    pub(crate) fn preset_thumbnail(&self, key: String, preset: &Preset) {
        let of = Subject::Preset(Box::new(preset.clone()));
        self.pictures.queue(PictureRequest::Thumbnail(ThumbnailRequest { key, of }));
    }

    /// Asks for a small picture of a mesh.
    pub(crate) fn mesh_thumbnail(&self, key: String, mesh: &MeshSource) {
        let of = Subject::Mesh(mesh.clone());
        self.pictures.queue(PictureRequest::Thumbnail(ThumbnailRequest { key, of }));
    }

    /// Writes the map in the formats of the settings. `false`: something is being written already.
    pub(crate) fn export(&mut self, state: &State) -> bool {
        let settings = &state.settings.export;
        let options =
            ExportOptions { formats: formats(&settings.formats), overwrite: settings.overwrite, sheet: settings.sheet };
        let (name, preset) = (state.preset_name(), Box::new(state.document.preset.clone()));
        self.write("Export", FileRequest::Export { name, preset, folder: settings.folder.clone(), options })
    }

    /// Saves the view as a picture. `false`: something is being written already, or there is nothing to draw yet.
    pub(crate) fn save_picture(&mut self, state: &State, results: &Results, path: PathBuf) -> bool {
        let settings = &state.settings.picture;
        let Some(mut shot) = self.whole_shot(state, results, settings.size_px) else { return false };
        shot.scene.transparent = settings.transparent;
        self.write("Picture", FileRequest::Picture { shot: Box::new(shot), path })
    }

    /// Saves a turntable of what plays, or else of the camera going round.
    pub(crate) fn save_turntable(&mut self, state: &State, results: &Results, path: PathBuf) -> bool {
        let settings = &state.settings.turntable;
        let Some(shot) = self.whole_shot(state, results, [settings.side_px; 2]) else { return false };
        let along = path_of(state.transient.motion.unwrap_or(Motion::Orbit));
        let (frames, fps) = (settings.frames, settings.fps);
        self.write("Turntable", FileRequest::Turntable { shot: Box::new(shot), along, path, frames, fps })
    }

    fn whole_shot(&self, state: &State, results: &Results, size_px: [u32; 2]) -> Option<Shot> {
        let (mesh, map) = (results.mesh.as_ref()?, results.map.as_ref()?);
        self.shot(state, mesh, map, size_px, 4)
    }

    fn write(&mut self, what: &str, request: FileRequest) -> bool {
        if self.files.is_busy() {
            return false;
        }
        self.writing = Some(what.to_owned());
        self.files.request(request);
        true
    }

    /// Stops what is being written.
    pub(crate) fn cancel_file(&self) {
        self.files.cancel();
    }
}

/// Whether a map is to be asked for: something has changed, or a draft is no longer enough.
fn is_new(asked: &Option<MapRequest>, wanted: &MapRequest) -> bool {
    asked.as_ref().is_none_or(|asked| {
        let changed = (&asked.preset, &asked.name) != (&wanted.preset, &wanted.name);
        changed || (wanted.fine && !asked.fine) || (asked.draft_px.is_some() && wanted.draft_px.is_none())
    })
}

/// Keeps a surface, in place of the oldest.
fn keep(kept: &mut Vec<MadeSurface>, made: MadeSurface) {
    if kept.len() >= SURFACES {
        kept.remove(0);
    }
    kept.push(made);
}

/// The open scene.
fn scene(state: &State, mesh: &LoadedMesh) -> Scene {
    let mut scene = Scene { camera: state.camera, lights: state.document.lights.clone(), ..Scene::of(&mesh.mesh) };
    for (own, wanted) in scene.materials.iter_mut().zip(&state.document.materials) {
        *own = wanted.clone();
    }
    scene
}

/// The looks of both sides, as far as the mesh allows.
fn looks(state: &State, mesh: &LoadedMesh) -> Vec<Look> {
    let document = &state.document;
    let other = document.compare.as_ref().map(|compare| &compare.look);
    std::iter::once(&document.look).chain(other).map(|look| look.fitted(&mesh.mesh)).collect()
}

fn surface_request(look: &Look, state: &State, mesh: &LoadedMesh) -> Option<SurfaceRequest> {
    let options = look.surface_options(&state.document.lights)?;
    Some(SurfaceRequest { mesh: Arc::clone(&mesh.mesh), options })
}

/// Whether a surface can stand in for another of the same mesh: it has all that is drawn with.
fn serves(made: &SurfaceRequest, wanted: &SurfaceRequest) -> bool {
    let (made, wanted) = (&made.options, &wanted.options);
    let follow = match (&made.patches, &wanted.patches) {
        (Some(made), Some(wanted)) => made.follow == wanted.follow,
        (None, Some(_)) => false,
        (_, None) => true,
    };
    follow && (wanted.lapped.is_none() || made.lapped.is_some()) && (wanted.stripes.is_none() || made.stripes.is_some())
}

fn path_of(motion: Motion) -> Path {
    match motion {
        Motion::Orbit => Path::Orbit,
        Motion::Light => Path::Light,
        Motion::Deform(deform) => Path::Deform(deform),
        Motion::Animation => Path::Animation,
    }
}
