//! All workers, and what to ask them for.

mod collect;
mod round;
mod view;

use std::path::PathBuf;
use std::sync::Arc;

use tam_gen::Preset;
use tam_gen::export::ExportOptions;

use super::files::{FileRequest, FileWorker, file_worker, formats};
use super::map::{CheckWorker, MadeMap, MapRequest, MapWorker, check_worker, map_worker};
use super::measuring::Measuring;
use super::mesh::{LoadedMesh, MeshWorker, mesh_worker};
use super::pace::Pace;
use super::painter::Shot;
use super::picture::{PictureRequest, PictureWorker, Stillness, picture_worker};
use super::results::Results;
use super::surface::{MadeSurface, SurfaceRequest, SurfaceWorker, surface_worker};
use super::thumbnails::{Subject, ThumbnailRequest};
use super::worker::Wake;
use crate::Method;
use crate::app::state::{Compare, Look, MeshSource, Motion, Notice, Severity, State};
use crate::app::words;
pub(crate) use round::MARGIN;
use round::Round;
use view::{looks, path_of, scene, surface_request};

/// Triangles up to which strokes follow a mesh: beyond, the field alone takes minutes and gigabytes.
pub(super) const SURFACE_TRIANGLES: usize = 2_000_000;

/// What the view is like at the moment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Demand {
    /// Size of the view; 0 while it is hidden.
    pub size_px: [u32; 2],
    /// A button is held or the wheel turns: what is asked for now is outdated a moment later.
    pub held: bool,
    /// Something plays: pictures follow each other, of one and the same document.
    pub plays: bool,
    /// The chart is in sight.
    pub chart_shown: bool,
}

impl Demand {
    /// Whether the next picture will be another one.
    pub(super) fn is_moving(self) -> bool {
        self.held || self.plays
    }
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
    /// Size of the view, when it was last in sight.
    view_px: [u32; 2],
    round: Round,
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
            view_px: [0; 2],
            round: Round::default(),
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
        if !demand.size_px.contains(&0) {
            self.view_px = demand.size_px;
        }
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
            draft_px: self.pace.draft_px(preset.map.size).filter(|_| demand.held),
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
        // While a slider moves, every surface would be outdated before it is made. What plays moves lights and vertices of
        // pictures, not those that surfaces are made from.
        if self.asked.surface.as_ref() != Some(&request) && !demand.held {
            self.asked.surface = Some(request.clone());
            self.surfaces.request(request);
        }
    }

    fn follow_picture(&mut self, state: &State, demand: Demand, mesh: &LoadedMesh, results: &Results) {
        let Some(map) = &results.map else { return };
        if demand.size_px.contains(&0) {
            return;
        }
        let motion = state.transient.motion;
        let Some(mut shot) = self.shot(state, mesh, map, demand.size_px, motion) else { return };
        let costly = self.pace.coarser() > 1;
        let changed = self.asked.shot.as_ref().is_none_or(|(asked, _)| !asked.shows_same(&shot));
        // As long as nothing has moved yet, the picture that is looked at is the best there is.
        if self.asked.shot.as_ref().is_some_and(|(asked, _)| *asked == shot) {
            return;
        }
        let asked_moving = self.asked.shot.as_ref().is_some_and(|(_, stillness)| *stillness == Stillness::Moving);
        // A change is shown at once, coarsely where pictures are costly, and then as it is to be looked at.
        let moving = demand.is_moving() || (costly && changed);
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
        let (settings, motion) = (&state.settings.picture, state.transient.motion);
        let Some(mut shot) = self.whole_shot(state, results, settings.size_px, motion) else { return false };
        shot.scene.transparent = settings.transparent;
        self.write("Picture", FileRequest::Picture { shot: Box::new(shot), path })
    }

    /// Saves a turntable of what plays, or else of the camera going round.
    pub(crate) fn save_turntable(&mut self, state: &State, results: &Results, path: PathBuf) -> bool {
        let settings = &state.settings.turntable;
        let motion = state.transient.motion.unwrap_or(Motion::Orbit);
        let Some(shot) = self.whole_shot(state, results, [settings.side_px; 2], Some(motion)) else { return false };
        let along = path_of(motion);
        let (frames, fps) = (settings.frames, settings.fps);
        self.write("Turntable", FileRequest::Turntable { shot: Box::new(shot), along, path, frames, fps })
    }

    fn whole_shot(
        &mut self,
        state: &State,
        results: &Results,
        size_px: [u32; 2],
        motion: Option<Motion>,
    ) -> Option<Shot> {
        let (mesh, map) = (results.mesh.as_ref()?, results.map.as_ref()?);
        self.shot(state, mesh, map, size_px, motion)
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
