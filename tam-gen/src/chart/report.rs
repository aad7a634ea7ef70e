//! Charts, table and page as files in a folder.

use std::path::{Path, PathBuf};

use super::drawing::{Chart, draw};
use super::page::{Page, html};
use super::table::Table;
use crate::command::{Failure, files};

/// A chart or table that cannot be made, which no input should cause.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("cannot make the chart: {0}")]
pub struct ChartError(pub String);

impl From<ChartError> for Failure {
    fn from(error: ChartError) -> Self {
        Self::Work { kind: "chart", message: error.to_string(), help: None }
    }
}

/// All that a run of measuring gives.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// Figures of every point.
    pub table: Table,
    /// Charts of them.
    pub charts: Vec<Chart>,
    /// What the page says beside.
    pub page: Page,
}

/// Name of the table's file.
const TABLE: &str = "points.csv";
/// Name of the page's file.
const PAGE: &str = "index.html";

impl Report {
    /// Writes `points.csv`, an SVG and a PNG of each chart, and `index.html`; the files written, in this order.
    ///
    /// # Errors
    /// One cannot be made or written, or is there already and not to be replaced.
    pub fn write(&self, folder: &Path, force: bool) -> Result<Vec<PathBuf>, Failure> {
        let mut made = vec![(folder.join(TABLE), self.table.csv()?)];
        let mut charts = Vec::new();
        for chart in &self.charts {
            let drawn = draw(chart)?;
            made.push((folder.join(format!("{}.svg", chart.name)), drawn.svg.clone().into_bytes()));
            made.push((folder.join(format!("{}.png", chart.name)), drawn.png.clone()));
            charts.push((chart.clone(), drawn));
        }
        made.push((folder.join(PAGE), html(&self.page, &charts, &self.table).into_bytes()));
        for (path, _) in &made {
            files::check_free(path, force)?;
        }
        for (path, bytes) in &made {
            files::write(path, bytes, force)?;
        }
        Ok(made.into_iter().map(|(path, _)| path).collect())
    }
}

/// Refuses a folder that cannot take a report, before work is put into one.
///
/// # Errors
/// As [`files::check_folder`], or it has a report already that is not to be replaced.
pub fn check_folder(folder: &Path, force: bool) -> Result<(), Failure> {
    files::check_folder(folder, "-o")?;
    [TABLE, PAGE].iter().try_for_each(|name| files::check_free(&folder.join(name), force))
}
