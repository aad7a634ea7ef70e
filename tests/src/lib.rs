//! Helpers shared by the tests that cross crates.

pub mod adapter;
pub mod app;
pub mod charts;
pub mod command;
pub mod gpu;
pub mod measure;
