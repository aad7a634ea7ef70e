//! The search: frames first, then maps, then levels, and the views in between at last.

use std::cmp::Ordering;

use tam_gen::{GenerateError, Job, Preset};

use super::maps::{FitMap, smaller};
use super::range::{FitRange, FitView};
use crate::chart::{Setting, Way, cost};
use crate::gpu::GpuMap;
use crate::maps::HatchMap;
use crate::measure::{Aov, MeasureOptions, Plane, ink, tone};
use crate::mesh::Mesh;
use crate::params::RenderParams;
use crate::reference::ReferenceError;
use crate::renderer::{RenderError, Renderer};
use crate::scene::Scene;

/// Places along the ranges where is searched, and those where the result is tried after each round.
const SEARCHED: [f64; 3] = [0.0, 0.5, 1.0];
const BETWEEN: [[f64; 2]; 3] = [[0.25, 0.75], [0.125, 0.625], [0.375, 0.875]];

/// Mean change of the ink from which on pictures are told apart.
const TOLD_APART: f64 = 1e-3;

/// Share of the progress that is reported while frames are timed.
const COSTS_SHARE: f32 = 0.2;

/// What is drawn of, and with what.
pub struct Bench<'a> {
    /// The renderer.
    pub renderer: &'a mut Renderer,
    /// Mesh on the device, with every surface that a method needs; picture of one sample a pixel; timer.
    pub setting: Setting<'a>,
    /// The mesh that was uploaded.
    pub mesh: &'a Mesh,
    /// Name of the map.
    pub name: &'a str,
    /// The preset of the map.
    pub preset: &'a Preset,
}

/// What is asked for.
#[derive(Clone, Debug)]
pub struct FitOptions<'a> {
    /// Ranges of cameras and lights.
    pub range: FitRange,
    /// Greatest root mean square error of tone in any view, in linear ink, 0 < e < 1.
    pub error: f64,
    /// What the scene is drawn with now.
    pub full: RenderParams,
    /// What else may draw it.
    pub ways: &'a [RenderParams],
    /// Pairs of frames that are timed per way, at least 1.
    pub pairs: u32,
}

/// The greatest error of tone over some views.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Worst {
    /// Root mean square, in linear ink.
    pub error: f64,
    /// Where that is.
    pub view: String,
}

/// A way to draw that was tried.
#[derive(Clone, Debug)]
pub struct Tried {
    /// How it is drawn.
    pub params: RenderParams,
    /// With which map; `None` where it samples none.
    pub map: Option<FitMap>,
    /// Time of a frame over that of `phong`.
    pub cost_ratio: f64,
    /// Bytes of the buffers and textures that it reads.
    pub bytes: u64,
    /// Its error: the greatest of all views, or for one that fails, that of the first view in which it does.
    pub worst: Worst,
    /// Where levels were left out and are missed: the mean change of the picture.
    pub missed: Option<Worst>,
}

/// What a scene needs.
#[derive(Clone, Debug)]
pub struct Fit {
    /// What it is drawn with now.
    pub full: Tried,
    /// The least that stays within the error.
    pub best: Tried,
    /// What is cheaper than that and fails: ways with a cheaper frame, and smaller maps.
    pub failing: Vec<Tried>,
    /// Views in which the result was drawn and holds.
    pub views: usize,
    /// The view in which it errs most.
    pub scene: Scene,
}

/// Why nothing is recommended.
#[derive(Debug, thiserror::Error)]
pub enum FitError {
    /// No way stays within the error.
    #[error("no way stays within {error}: the present one errs by {:.4} at {}", full.error, full.view)]
    OutOfReach {
        /// The error asked for.
        error: f64,
        /// That of the present way.
        full: Worst,
    },
    /// The mesh is not seen in a view.
    #[error("nothing of the mesh is seen at {0}")]
    Unseen(String),
    /// It cannot be drawn.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// What is wanted cannot be computed.
    #[error(transparent)]
    Reference(#[from] ReferenceError),
    /// A smaller map cannot be made, or the job was cancelled.
    #[error(transparent)]
    Generate(#[from] GenerateError),
}

/// Finds the cheapest way to draw a scene: the cheapest frame first, then the smallest map.
///
/// # Errors
/// [`FitError`].
pub fn fit(bench: &mut Bench<'_>, scene: &Scene, options: &FitOptions<'_>, job: &Job<'_>) -> Result<Fit, FitError> {
    let size = bench.setting.target.size;
    let mesh = bench.mesh;
    let view_at = |places: &[f64]| options.range.views(mesh, scene, size, places);
    let mut views = view_at(&SEARCHED)?;
    let whole = bench.map(FitMap::of(bench.preset), job)?;
    let mut costs = Vec::new();
    for (timed, params) in options.ways.iter().chain([&options.full]).enumerate() {
        stop(job)?;
        job.report(COSTS_SHARE * timed as f32 / (options.ways.len() + 1) as f32);
        let cost = cost(bench.renderer, &bench.setting, scene, params, &whole, options.pairs)?;
        costs.push((*params, cost.ratio));
    }
    let full_ratio = costs.pop().map_or(1.0, |(_, ratio)| ratio);
    costs.sort_by(|a, b| a.1.partial_cmp(&b.1).unwrap_or(Ordering::Equal));

    for between in &BETWEEN {
        let full = bench.tried(&options.full, FitMap::of(bench.preset), full_ratio, &whole, &views, None)?;
        let found = search(bench, options, &costs, &whole, &views, job)?;
        let (best, failing) = found.ok_or(FitError::OutOfReach { error: options.error, full: full.worst.clone() })?;
        let map = bench.map(best.map.unwrap_or(FitMap::of(bench.preset)), job)?;
        let between = view_at(between)?;
        let worst = bench.worst(&best.params, &map, &between, Some(options.error))?;
        let checked = views.len() + between.len();
        if worst.error <= options.error {
            let worst = if worst.error > best.worst.error { worst } else { best.worst.clone() };
            let all = views.iter().chain(&between);
            let seen = all.into_iter().find(|view| view.name == worst.view).map(|view| view.scene.clone());
            let best = Tried { worst, ..best };
            let scene = seen.unwrap_or_else(|| scene.clone());
            return Ok(Fit { full, best, failing, views: checked, scene });
        }
        // What fails between the places that were searched is searched too.
        views.extend(between);
    }
    let full = bench.worst(&options.full, &whole, &views, None)?;
    Err(FitError::OutOfReach { error: options.error, full })
}

/// The cheapest way that holds in these views, and what is cheaper and fails.
fn search(
    bench: &mut Bench<'_>,
    options: &FitOptions<'_>,
    costs: &[(RenderParams, f64)],
    whole: &GpuMap,
    views: &[FitView],
    job: &Job<'_>,
) -> Result<Option<(Tried, Vec<Tried>)>, FitError> {
    let limit = Some(options.error);
    let mut failing = Vec::new();
    for (place, (params, ratio)) in costs.iter().enumerate() {
        let searched = |part: f32| COSTS_SHARE + (1.0 - COSTS_SHARE) * (place as f32 + part) / costs.len() as f32;
        stop(job)?;
        job.report(searched(0.0));
        let tried = bench.tried(params, FitMap::of(bench.preset), *ratio, whole, views, limit)?;
        if tried.worst.error > options.error {
            failing.push(tried);
            continue;
        }
        if tried.map.is_none() {
            return Ok(Some((tried, failing)));
        }
        let mut best = tried;
        let choices = smaller(bench.preset, Way { params: *params, map: 0 }.mixes_columns());
        for (tried, choice) in choices.iter().enumerate() {
            stop(job)?;
            job.report(searched(tried as f32 / choices.len() as f32));
            let choice = *choice;
            let map = bench.map(choice, job)?;
            let tried = bench.tried(params, choice, *ratio, &map, views, limit)?;
            if tried.worst.error <= options.error {
                best = tried;
                break;
            }
            failing.push(tried);
        }
        // Levels that no view samples.
        while let Some(choice) = best.map.filter(|map| map.coarsest < map.size) {
            let fewer = FitMap { coarsest: choice.coarsest * 2, ..choice };
            let maps = [bench.map(choice, job)?, bench.map(fewer, job)?];
            let tried = bench.tried(params, fewer, *ratio, &maps[1], views, limit)?;
            let missed = bench.change(params, &maps, views)?;
            if tried.worst.error > options.error || missed.is_some() {
                failing.push(Tried { missed, ..tried });
                break;
            }
            best = tried;
        }
        return Ok(Some((best, failing)));
    }
    Ok(None)
}

impl Bench<'_> {
    fn map(&self, choice: FitMap, job: &Job<'_>) -> Result<GpuMap, GenerateError> {
        let job = Job { progress: None, ..*job };
        Ok(self.renderer.map(HatchMap::from_preset(self.name, &choice.preset(self.preset), &job)?))
    }

    fn tried(
        &mut self,
        params: &RenderParams,
        choice: FitMap,
        cost_ratio: f64,
        map: &GpuMap,
        views: &[FitView],
        limit: Option<f64>,
    ) -> Result<Tried, FitError> {
        let worst = self.worst(params, map, views, limit)?;
        let samples = Way { params: *params, map: 0 }.samples_map();
        // Maps are uploaded as the method takes them: taken anew, so that no other method's textures count.
        let textures = if samples { self.texture_bytes(params, map, &views[0].scene)? } else { 0 };
        let bytes = self.setting.mesh.bytes_for(params) + textures;
        Ok(Tried { params: *params, map: samples.then_some(choice), cost_ratio, bytes, worst, missed: None })
    }

    fn texture_bytes(&mut self, params: &RenderParams, map: &GpuMap, scene: &Scene) -> Result<u64, RenderError> {
        let own = self.renderer.map(map.source.clone());
        self.renderer.render(scene, params, self.setting.mesh, &[&own], self.setting.target)?;
        Ok(own.bytes())
    }

    /// The first view in which two maps are told apart, and by how much in the mean.
    fn change(
        &mut self,
        params: &RenderParams,
        maps: &[GpuMap; 2],
        views: &[FitView],
    ) -> Result<Option<Worst>, FitError> {
        for FitView { name, scene, aov } in views {
            let [whole, fewer] = [&maps[0], &maps[1]].map(|map| self.ink(params, map, scene, aov));
            let (whole, fewer) = (whole?, fewer?);
            let pairs = whole.pixels.iter().zip(&fewer.pixels);
            let seen = aov.covered().into_iter().filter(|covered| *covered).count().max(1);
            let error = pairs.map(|(whole, fewer)| (whole - fewer).abs()).sum::<f64>() / seen as f64;
            if error > TOLD_APART {
                return Ok(Some(Worst { error, view: name.clone() }));
            }
        }
        Ok(None)
    }

    fn ink(&mut self, params: &RenderParams, map: &GpuMap, scene: &Scene, aov: &Aov) -> Result<Plane, RenderError> {
        let Setting { mesh, target, .. } = self.setting;
        self.renderer.render(scene, params, mesh, &[map], target)?;
        Ok(ink(&target.read(&self.renderer.gpu)?.linear(), aov, self.mesh, scene))
    }

    /// The greatest error of a way to draw over these views; beyond the limit, that of the first view.
    fn worst(
        &mut self,
        params: &RenderParams,
        map: &GpuMap,
        views: &[FitView],
        limit: Option<f64>,
    ) -> Result<Worst, FitError> {
        let mut worst = Worst { error: -1.0, view: String::new() };
        for FitView { name, scene, aov } in views {
            let ink = self.ink(params, map, scene, aov)?;
            let tone = tone(&ink, aov, MeasureOptions::default().tone_sigma_px);
            let error = tone.ok_or_else(|| FitError::Unseen(name.clone()))?.ink.rmse;
            if error > worst.error {
                worst = Worst { error, view: name.clone() };
            }
            if limit.is_some_and(|limit| error > limit) {
                break;
            }
        }
        Ok(worst)
    }
}

fn stop(job: &Job<'_>) -> Result<(), GenerateError> {
    if job.cancelled() { Err(GenerateError::Cancelled) } else { Ok(()) }
}
