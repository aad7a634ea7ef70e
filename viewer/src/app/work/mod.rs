//! Long work, away from the window: maps, checks, meshes, surfaces, pictures, files, and what every way to draw costs.
//!
//! [`Engine::follow`] compares the state with what was last asked for and asks for what is missing; replies become
//! [`Results`], which panels read. Nothing here waits.

mod canvases;
mod chart;
mod engine;
mod files;
mod fit;
mod map;
mod measuring;
mod mesh;
mod named;
mod pace;
mod painter;
mod picture;
mod results;
mod stand;
mod subject;
mod surface;
mod thumbnails;
mod worker;

pub use canvases::Canvas;
pub use chart::{ChartResults, MeasuredWay};
pub(crate) use engine::{Demand, Engine, MARGIN};
pub use fit::{FitResults, FittedScene};
pub(crate) use map::MadeMap;
pub(crate) use mesh::LoadedMesh;
pub use named::Named;
pub use picture::Shown;
pub use results::Results;
pub(crate) use worker::Wake;
