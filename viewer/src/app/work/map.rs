//! Maps and their checks.

use std::sync::Arc;
use std::time::{Duration, Instant};

use tam_gen::checks::{Report, check_map};
use tam_gen::{GenerateError, Generator, Job, Map, Preset};

use super::named::Named;
use super::worker::{Manner, Wake, Worker};
use crate::maps::HatchMap;

/// A map younger than this is finished even if a newer one is wanted.
const PATIENCE: Duration = Duration::from_millis(250);

/// A map that was made, with all that panels and pictures need of it.
#[derive(Debug)]
pub struct MadeMap {
    /// Its preset; while a slider moves the map may be smaller than it asks for.
    pub preset: Preset,
    /// The map, with its strokes.
    pub map: Map,
    /// The same as the renderer takes it.
    pub hatch: Named<HatchMap>,
    /// How long that took.
    pub took: Duration,
    /// Greatest tone error of a cell.
    pub tone_error: f64,
    /// Whether it is smaller than the preset asks for.
    pub draft: bool,
}

/// What is wanted.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct MapRequest {
    pub name: String,
    pub preset: Preset,
    /// Side in texels of a smaller map that will do for now.
    pub draft_px: Option<u32>,
    /// Make the many columns of `fine-tone` too.
    pub fine: bool,
}

pub(super) type MapReply = Result<Arc<MadeMap>, String>;

pub(super) type MapWorker = Worker<MapRequest, MapReply>;

/// Starts the worker that makes maps.
pub(super) fn map_worker(wake: Wake) -> std::io::Result<MapWorker> {
    let work = |generator: &mut Generator, request: MapRequest, job: &Job<'_>, reply: &dyn Fn(MapReply)| match made(
        generator, &request, job,
    ) {
        Ok(made) => reply(Ok(Arc::new(made))),
        Err(GenerateError::Cancelled) => {}
        Err(error) => reply(Err(error.to_string())),
    };
    let failed = |words: String| Err(format!("the map could not be made: {words}"));
    Worker::start("maps", Manner { patience: PATIENCE, leaves_behind: false }, wake, Generator::new, work, failed)
}

fn made(generator: &mut Generator, request: &MapRequest, job: &Job<'_>) -> Result<MadeMap, GenerateError> {
    let mut preset = request.preset.clone();
    if let Some(size) = request.draft_px {
        preset.map.size = size;
        preset.map.coarsest = preset.map.coarsest.min(size);
    }
    let start = Instant::now();
    let mut map = Map::default();
    generator.generate_into(&preset, job, &mut map)?;
    let took = start.elapsed();
    let hatch = HatchMap::from_map(&request.name, &map);
    if request.fine {
        hatch.fine_with(job)?;
    }
    let tone_error = tone_error(&map);
    let (preset, draft) = (request.preset.clone(), request.draft_px.is_some());
    Ok(MadeMap { preset, map, hatch: Named::map(hatch), took, tone_error, draft })
}

/// Greatest difference between a cell's mean and its column's tone.
fn tone_error(map: &Map) -> f64 {
    let measure = tam_gen::preset::ToneMeasure::named(map.preset.map.tone_measure);
    let of_level = |level: &tam_gen::Level| {
        let cells = level.cells.iter().zip(&map.grid.tones);
        cells.map(|(cell, tone)| (measure.tone(cell) - tone).abs()).fold(0.0, f64::max)
    };
    map.grid.drawn().iter().map(of_level).fold(0.0, f64::max)
}

/// The map that was checked, unless the check broke down, and what was found.
pub(super) type CheckReply = (Option<Arc<MadeMap>>, Result<Arc<Report>, String>);

pub(super) type CheckWorker = Worker<Arc<MadeMap>, CheckReply>;

/// Starts the worker that checks maps.
pub(super) fn check_worker(wake: Wake) -> std::io::Result<CheckWorker> {
    let work = |(): &mut (), map: Arc<MadeMap>, _: &Job<'_>, reply: &dyn Fn(CheckReply)| {
        let report = check_map(&map.map);
        reply((Some(map), Ok(Arc::new(report))));
    };
    let failed = |words: String| (None, Err(format!("the map could not be checked: {words}")));
    Worker::start("checks", Manner { patience: Duration::MAX, leaves_behind: false }, wake, || (), work, failed)
}
