//! Long work, away from the window: maps, checks, meshes, surfaces, pictures, files.
//!
//! [`Engine::follow`] compares the state with what was last asked for and asks for what is missing; replies become
//! [`Results`], which panels read. Nothing here waits.

mod engine;
mod files;
mod map;
mod mesh;
mod pace;
mod painter;
mod picture;
mod results;
mod surface;
mod thumbnails;
mod worker;

pub(crate) use engine::{Demand, Engine};
pub(crate) use map::MadeMap;
pub use results::Results;
pub(crate) use worker::Wake;
