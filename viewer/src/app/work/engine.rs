//! All workers, and what to ask them for.

mod collect;
mod round;
mod view;

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

use tam_gen::Preset;
use tam_gen::export::ExportOptions;

use super::files::{FileRequest, FileWorker, file_worker, formats};
use super::map::{CheckWorker, MadeMap, MapRequest, MapWorker, check_worker, map_worker};
use super::measuring::Measuring;
use super::mesh::{MeshWorker, mesh_worker};
use super::pace::Pace;
use super::painter::Shot;
use super::picture::{PictureRequest, PictureWorker, ViewRequest, picture_worker};
use super::results::Results;
use super::surface::{MadeSurface, SurfaceRequest, SurfaceWorker, surface_worker};
use super::thumbnails::{Subject, ThumbnailRequest};
use super::worker::Wake;
use crate::Method;
use crate::app::state::{Look, MeshSource, Motion, Notice, Severity, State};
use crate::app::words;
use crate::gpu::Gpu;
pub(crate) use round::MARGIN;
use round::Round;
use view::{Cut, Wanted, path_of, scene};

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
    /// Maps of presets that are not the chosen object's.
    other_maps_made: Vec<Arc<MadeMap>>,
    /// Those that cannot be made.
    other_maps_failed: Vec<Preset>,
    /// Meshes that cannot be loaded.
    meshes_failed: Vec<MeshSource>,
    cuts: Vec<Cut>,
    /// Surfaces that the scene needs.
    needed: usize,
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
    other_map: Option<Preset>,
    mesh: Option<MeshSource>,
    /// The mesh that is being loaded, until it is collected.
    loading: Option<MeshSource>,
    surface: Option<SurfaceRequest>,
    /// With whether it is one of many that pass.
    shot: Option<(Shot, bool)>,
}

impl Engine {
    /// Starts all workers; the view is drawn on this device.
    ///
    /// # Errors
    /// Where the system gives no threads.
    pub(crate) fn start(wake: &Wake, gpu: Gpu) -> std::io::Result<Self> {
        Ok(Self {
            maps: map_worker(Arc::clone(wake))?,
            other_maps: map_worker(Arc::clone(wake))?,
            checks: check_worker(Arc::clone(wake))?,
            meshes: mesh_worker(Arc::clone(wake))?,
            surfaces: surface_worker(Arc::clone(wake))?,
            pictures: picture_worker(Arc::clone(wake), gpu)?,
            files: file_worker(Arc::clone(wake))?,
            measuring: Measuring::start(wake)?,
            asked: Asked::default(),
            made: Vec::new(),
            other_maps_made: Vec::new(),
            other_maps_failed: Vec::new(),
            meshes_failed: Vec::new(),
            cuts: Vec::new(),
            needed: 0,
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

    /// Whether a picture is being drawn.
    pub(crate) fn is_drawing(&self) -> bool {
        self.pictures.is_busy()
    }

    /// Asks for what the state needs and nobody was asked for yet.
    pub(crate) fn follow(&mut self, state: &State, demand: Demand, results: &mut Results) {
        if !demand.size_px.contains(&0) {
            self.view_px = demand.size_px;
        }
        self.follow_map(state, demand, results);
        self.follow_meshes(state, results);
        if let Some(mesh) = results.mesh.clone() {
            self.follow_surfaces(state, demand, results);
            self.follow_picture(state, demand, results);
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
        let fine_too = other.is_some_and(|other| other.preset.is_none() && fine(&other.look))
            || document.others.iter().any(|other| other.source == document.source && fine(&other.look));
        let wanted = request(state.preset_name(), &document.preset, fine(&document.look) || fine_too);
        if is_new(&self.asked.map, &wanted) {
            // What was made for an object that was chosen before is there at once.
            self.choose_map(&wanted, results);
            self.asked.map = Some(wanted.clone());
            match wanted.preset.validate().into_iter().next() {
                None => self.maps.request(wanted),
                Some(violation) => {
                    results.map_problem = Some(format!("{}: {}", violation.problem, violation.expected));
                }
            }
        }
        self.follow_other_maps(state);
    }

    /// Puts the map of a preset that becomes the chosen one into the results, and keeps the one before.
    fn choose_map(&mut self, wanted: &MapRequest, results: &mut Results) {
        let Some(index) = self.other_maps_made.iter().position(|made| made.preset == wanted.preset) else { return };
        let made = self.other_maps_made.remove(index);
        self.other_maps_made.extend(results.map.replace(made).filter(|before| !before.draft));
    }

    /// Makes the maps of the other objects and of the other side, one after another.
    fn follow_other_maps(&mut self, state: &State) {
        let document = &state.document;
        let compared = document.compare.iter().filter_map(|compare| {
            let (name, preset) = compare.preset.as_ref()?;
            Some((name.clone(), preset, compare.look.params.method == Method::FineTone))
        });
        let others = document
            .objects()
            .filter(|object| object.source != &document.source)
            .map(|object| (object.source.name(), object.preset, object.look.params.method == Method::FineTone));
        let of_parts = document.part_presets.iter().map(|(name, preset)| (name.display().to_string(), preset, false));
        let mut wanted: Vec<(String, &Preset, bool)> = Vec::new();
        for (name, preset, fine) in compared.chain(others).chain(of_parts) {
            if *preset == document.preset {
                continue;
            }
            match wanted.iter_mut().find(|(_, known, _)| *known == preset) {
                Some((_, _, known)) => *known |= fine,
                None => wanted.push((name, preset, fine)),
            }
        }
        let is_wanted = |preset: &Preset| wanted.iter().any(|(_, known, _)| *known == preset);
        self.other_maps_made.retain(|made| is_wanted(&made.preset));
        self.other_maps_failed.retain(is_wanted);
        if self.other_maps.is_busy() {
            return;
        }
        let missing = wanted.into_iter().find(|(_, preset, _)| {
            !self.other_maps_made.iter().any(|made| made.preset == **preset) && !self.other_maps_failed.contains(preset)
        });
        if let Some((name, preset, fine)) = missing {
            if preset.validate().is_empty() {
                self.other_maps.request(MapRequest { name, preset: preset.clone(), draft_px: None, fine });
                self.asked.other_map = Some(preset.clone());
            } else {
                self.other_maps_failed.push(preset.clone());
            }
        }
    }

    /// Loads the meshes of all objects, that of the chosen one first.
    fn follow_meshes(&mut self, state: &State, results: &mut Results) {
        let document = &state.document;
        if self.asked.mesh.as_ref() != Some(&document.mesh) {
            self.asked.mesh = Some(document.mesh.clone());
            match results.meshes.iter().find(|mesh| mesh.source == document.mesh) {
                Some(mesh) => results.mesh = Some(Arc::clone(mesh)),
                None => {
                    self.asked.loading = Some(document.mesh.clone());
                    self.meshes.request(document.mesh.clone());
                }
            }
        }
        let is_wanted = |source: &MeshSource| document.objects().any(|object| object.mesh == source);
        let shown = results.mesh.as_ref().map(|mesh| mesh.source.clone());
        let before = results.meshes.len();
        results.meshes.retain(|mesh| is_wanted(&mesh.source) || Some(&mesh.source) == shown.as_ref());
        if results.meshes.len() != before {
            self.forget_cuts(&results.meshes);
        }
        self.meshes_failed.retain(is_wanted);
        let missing = document.objects().map(|object| object.mesh).find(|source| {
            !results.meshes.iter().any(|mesh| mesh.source == **source) && !self.meshes_failed.contains(source)
        });
        results.meshes_to_come = missing.is_some();
        if self.meshes.is_busy() {
            return;
        }
        // What has just been loaded may wait to be collected.
        if let Some(source) = missing.filter(|source| self.asked.loading.as_ref() != Some(source)) {
            self.asked.loading = Some(source.clone());
            self.meshes.request(source.clone());
        }
    }

    fn follow_surfaces(&mut self, state: &State, demand: Demand, results: &mut Results) {
        let compare = state.document.compare.as_ref();
        let mut all = self.wanted(state, &results.meshes, None);
        if compare.is_some() {
            all.extend(self.wanted(state, &results.meshes, compare));
        }
        let lights = &state.document.lights;
        let mut requests: Vec<SurfaceRequest> = Vec::new();
        for request in all.iter().filter_map(|wanted: &Wanted<'_>| wanted.surface(lights)) {
            if !requests.contains(&request) {
                requests.push(request);
            }
        }
        self.needed = requests.len();
        let is_missing = |request: &SurfaceRequest| !self.made.iter().any(|made| made.request == *request);
        let (refused, mut missing): (Vec<_>, Vec<_>) =
            requests.into_iter().filter(is_missing).partition(|request| self.refused.contains(request));
        if refused.is_empty() {
            results.surface_problem = None;
        }
        let too_large = |request: &SurfaceRequest| request.mesh.triangles.len() > SURFACE_TRIANGLES;
        if let Some(index) = missing.iter().position(too_large) {
            let request = missing.swap_remove(index);
            let problem = format!(
                "Strokes follow meshes of up to {}; this one has {} and is drawn with three planes instead.",
                words::counted(SURFACE_TRIANGLES, "triangle"),
                words::grouped(request.mesh.triangles.len())
            );
            self.told.push(Notice { severity: Severity::Warning, text: problem.clone() });
            results.surface_problem = Some(problem);
            self.refused.push(request);
            return;
        }
        // What is worked on is finished first, as long as it is wanted.
        let asked = self.asked.surface.as_ref();
        let going_on = asked.filter(|asked| self.surfaces.is_busy() && missing.contains(asked)).cloned();
        let Some(request) = going_on.or_else(|| missing.into_iter().next()) else {
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

    fn follow_picture(&mut self, state: &State, demand: Demand, results: &Results) {
        if demand.size_px.contains(&0) {
            return;
        }
        let motion = state.transient.motion;
        let Some(mut shot) = self.shot(state, results, demand.size_px, motion) else { return };
        let coarser = self.pace.coarser(shot.size_px, shot.samples);
        let bands = self.pace.bands(shot.size_px, shot.samples);
        let changed = self.asked.shot.as_ref().is_none_or(|(asked, _)| !asked.shows_same(&shot));
        // As long as nothing has moved yet, the picture that is looked at is the best there is.
        if self.asked.shot.as_ref().is_some_and(|(asked, _)| *asked == shot) {
            return;
        }
        // A change is shown at once, coarsely where pictures are costly, and then as it is to be looked at.
        let passing = coarser > 1 && (changed || demand.is_moving());
        let after_passing = self.asked.shot.as_ref().is_some_and(|(_, passing)| *passing);
        // What passes is drawn once, whatever is found out about its cost meanwhile.
        if after_passing && if passing { !changed } else { self.pictures.is_busy() } {
            return;
        }
        if passing {
            shot.samples = 1;
            shot.size_px = demand.size_px.map(|side| side.div_ceil(coarser));
        }
        if self.asked.shot.as_ref().is_none_or(|(asked, _)| *asked != shot) {
            self.asked.shot = Some((shot.clone(), passing));
            let bands = if passing { 1 } else { bands };
            let request = ViewRequest { shot, passing, bands, asked: Instant::now() };
            self.pictures.request(PictureRequest::View(Box::new(request)));
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

    /// Loads the chosen object's mesh again, as its file has changed.
    pub(crate) fn reload_mesh(&mut self, results: &mut Results) {
        let asked = self.asked.mesh.take();
        results.meshes.retain(|mesh| Some(&mesh.source) != asked.as_ref());
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
        self.shot(state, results, size_px, motion)
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
