//! The application: a stroke material is made here, live, on any mesh.
//!
//! ```text
//! panels ─► Command ─► apply ─► State ─► Engine (workers) ─► Results ─► panels
//! ```
//!
//! Panels are functions of the state that push commands; `apply` is the one place where state changes.
//! Workers make maps, surfaces and pictures beside the window, which never waits; the newest request wins. Pictures of the
//! view are drawn on the window's device and stay there; files have a device of their own. If the window's device is lost,
//! another window is opened with everything that was in this one.

mod actions;
mod apply;
mod ask;
mod command;
mod history;
mod layout;
mod panels;
mod pick;
mod randomise;
mod run;
mod scenes;
mod session;
mod state;
mod style;
mod textures;
mod watch;
mod window;
mod words;
mod work;

pub use apply::{Effect, MESH_KINDS};
pub use command::Command;
pub use layout::Pane;
pub use run::{AppError, WindowOptions, run, setup};
pub use session::default_path as default_session;
pub use state::*;
pub use window::{App, Leaving, Options};
pub use work::{Canvas, ChartResults, FitResults, FittedScene, MeasuredWay, Named, Results, Shown};
