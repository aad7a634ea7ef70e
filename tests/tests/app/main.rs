//! The application, used through its window.

mod controls;
mod files;
mod helpers;
mod view;
