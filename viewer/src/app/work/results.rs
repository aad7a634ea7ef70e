//! What work has brought so far.

use std::collections::HashMap;
use std::sync::Arc;
use std::time::Duration;

use tam_gen::checks::Report;

use super::canvases::Canvas;
use super::chart::ChartResults;
use super::fit::FitResults;
use super::map::MadeMap;
use super::mesh::LoadedMesh;
use super::picture::Shown;

/// What panels show beside the state; all of it may be older than the state.
#[derive(Default)]
pub struct Results {
    /// The map of the preset.
    pub map: Option<Arc<MadeMap>>,
    /// Why there is no newer one.
    pub map_problem: Option<String>,
    /// What the checks found, and about which map.
    pub report: Option<(Arc<MadeMap>, Arc<Report>)>,
    /// The mesh of the chosen object.
    pub mesh: Option<Arc<LoadedMesh>>,
    /// Those of all objects, as far as they are there.
    pub meshes: Vec<Arc<LoadedMesh>>,
    /// Whether more of them are still to come.
    pub meshes_to_come: bool,
    /// Why strokes cannot follow it.
    pub surface_problem: Option<String>,
    /// The picture of the view.
    pub picture: Option<Shown>,
    /// Why there is no newer one.
    pub picture_problem: Option<String>,
    /// Time from beginning to draw the picture until the window had it on the screen.
    pub to_screen: Option<Duration>,
    /// Small pictures, by key.
    pub thumbnails: HashMap<String, Arc<Canvas>>,
    /// Device and driver.
    pub adapter: Option<String>,
    /// Why the window's device is gone; then nothing is drawn any more.
    pub device_lost: Option<String>,
    /// What every way to draw the scene costs.
    pub chart: ChartResults,
    /// The least that the scene needs.
    pub fit: FitResults,
    /// What is going on, each with its part done, 0..=1.
    pub running: Vec<(&'static str, f32)>,
    /// Part done of the file that is being written.
    pub writing: Option<(String, f32)>,
}

impl Results {
    /// The report of the map that is shown, unless that is newer.
    pub fn current_report(&self) -> Option<&Report> {
        let (of, report) = self.report.as_ref()?;
        self.map.as_ref().is_some_and(|map| map.hatch == of.hatch).then_some(report)
    }
}
