//! The application, used through its window.

mod chart;
mod controls;
mod device;
mod files;
mod helpers;
mod scenes;
mod view;
