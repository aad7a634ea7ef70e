//! Charts of cost against error, and the page that shows them; both commands draw theirs here.
//!
//! ```text
//! points ─► front (Pareto) ─► labels ─► drawing (SVG, PNG) ─► page (HTML), with a table (CSV)
//! ```

mod axis;
mod colours;
mod pareto;

#[cfg(feature = "cli")]
mod drawing;
mod labels;
#[cfg(feature = "cli")]
mod page;
#[cfg(feature = "cli")]
pub mod placement;
#[cfg(feature = "cli")]
mod report;
#[cfg(feature = "cli")]
mod table;

pub use axis::{Axis, tick};
pub use colours::GROUP_COLOURS;
#[cfg(feature = "cli")]
pub use drawing::{Chart, ChartPoint, Drawn, draw};
pub use labels::{Label, along, place_labels};
#[cfg(feature = "cli")]
pub use page::{PAGE_CSS, Page, Thumbnail, html};
pub use pareto::pareto_front;
#[cfg(feature = "cli")]
pub use report::{ChartError, Report, check_folder};
#[cfg(feature = "cli")]
pub use table::{Table, figure};
