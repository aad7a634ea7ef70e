//! The panels: functions of the state that push commands.

mod camera;
mod chart;
mod checks;
mod export;
mod map;
mod map_pictures;
mod menu;
mod notices;
mod number;
mod objects;
mod orbit;
mod palette;
mod presets;
mod scene;
mod schedule;
mod shading;
mod status;
mod stroke_preview;
mod strokes;
mod view;
mod windows;

use egui::Ui;

use super::actions::Action;
use super::command::Command;
use super::layout::Pane;
use super::state::State;
use super::textures::Textures;
use super::work::Results;

pub(crate) use menu::menu_bar;
pub(crate) use notices::{Shown as ShownNotice, notices};
pub(crate) use presets::{file_key, preset_key};
pub(crate) use scene::{mesh_key, offered as offered_meshes};
pub(crate) use status::status_bar;
pub(crate) use view::ViewReport;
pub(crate) use windows::dialogs;

/// What panels are drawn from, and what they ask for.
pub(crate) struct Panel<'a> {
    /// All state.
    pub state: &'a State,
    /// What was made of it.
    pub results: &'a Results,
    /// Pictures on the screen.
    pub textures: &'a mut Textures,
    /// What the user asks for.
    pub commands: &'a mut Vec<Command>,
    /// What the view found out about itself.
    pub view: &'a mut ViewReport,
    /// Whether the chart is in sight.
    pub chart_shown: &'a mut bool,
    /// Every action, for menus.
    pub can: &'a dyn Fn(&Action) -> bool,
}

impl Panel<'_> {
    /// Asks for something.
    pub(crate) fn ask(&mut self, command: Command) {
        self.commands.push(command);
    }

    /// Draws a panel.
    pub(crate) fn show(&mut self, ui: &mut Ui, pane: Pane) {
        match pane {
            Pane::View => view::show(self, ui),
            Pane::Presets => presets::show(self, ui),
            Pane::Strokes => strokes::show(self, ui),
            Pane::Shading => shading::show(self, ui),
            Pane::Scene => scene::show(self, ui),
            Pane::Map => map::show(self, ui),
            Pane::Checks => checks::show(self, ui),
            Pane::Chart => chart::show(self, ui),
            Pane::Export => export::show(self, ui),
        }
    }
}
