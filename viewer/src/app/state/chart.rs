//! The chart of the open scene, and what a fit is asked for.

use serde::{Deserialize, Serialize};

use crate::chart::MEASURES;
use crate::fit::FitRange;
use crate::{Mapping, Method};

/// What the chart shows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ChartSettings {
    /// Name of the error that is charted against the cost, of [`MEASURES`].
    pub measure: String,
    /// Measure nothing.
    pub paused: bool,
}

impl Default for ChartSettings {
    fn default() -> Self {
        Self { measure: MEASURES[0].name.to_owned(), paused: false }
    }
}

/// What a fit has to hold for, and what it may change.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct FitSettings {
    /// Distances of the camera as multiples of the present one, within `ranges::FIT_DISTANCE`, the nearer first.
    pub distance: [f64; 2],
    /// Turns of the camera from the present one, in degrees, within `ranges::FIT_TURN_DEG`, in order.
    pub orbit_deg: [f64; 2],
    /// The same of all lights.
    pub light_deg: [f64; 2],
    /// Greatest root mean square error of tone in any view, in linear ink, within `ranges::FIT_ERROR`.
    pub error: f64,
    /// Methods that may take the place of the present one.
    pub methods: Vec<Method>,
    /// Mappings that may take the place of the present one.
    pub mappings: Vec<Mapping>,
}

impl Default for FitSettings {
    /// From half the distance to twice it, by methods that draw the map's cells, so that what is seen stays the same.
    fn default() -> Self {
        Self {
            distance: [0.5, 2.0],
            orbit_deg: [0.0, 0.0],
            light_deg: [-30.0, 30.0],
            // What the shipped pencil keeps at half the distance in a view of full size, which a first try should find.
            error: 0.05,
            methods: vec![Method::SixWay, Method::FineTone],
            mappings: Vec::new(),
        }
    }
}

impl FitSettings {
    /// Where cameras and lights are.
    pub fn range(&self) -> FitRange {
        FitRange { distance: self.distance, orbit_deg: self.orbit_deg, light_deg: self.light_deg }
    }
}

/// Which part of the chart's panel is shown, and how.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ChartView {
    /// Which part.
    pub tab: ChartTab,
    /// What the table is sorted by.
    pub sort: ChartSort,
    /// From the largest down.
    pub descending: bool,
}

/// A part of the chart's panel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ChartTab {
    /// All ways to draw the scene, by cost and error.
    #[default]
    Ways,
    /// The least that the scene needs.
    Fit,
}

impl ChartTab {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Ways, Self::Fit];

    /// What it is called.
    pub fn label(self) -> &'static str {
        match self {
            Self::Ways => "All ways",
            Self::Fit => "Fit",
        }
    }
}

/// A column of the chart's table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ChartSort {
    /// Method, mapping and form.
    Way,
    /// Cost over `phong`.
    #[default]
    Cost,
    /// The error that is charted.
    Error,
}
