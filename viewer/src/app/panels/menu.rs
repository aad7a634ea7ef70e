//! The menus.

use egui::{Button, MenuBar, Ui};

use super::Panel;
use crate::app::actions::{Action, Group, keys_in_words};
use crate::app::command::Command;

/// The bar with all menus.
pub(crate) fn menu_bar(panel: &mut Panel<'_>, ui: &mut Ui, actions: &[Action]) {
    MenuBar::new().ui(ui, |ui| {
        for group in Group::ALL {
            ui.menu_button(group.title(), |ui| {
                for action in actions.iter().filter(|action| action.group == group) {
                    item(panel, ui, action);
                    if group == Group::File && action.command == Command::OpenMesh(None) {
                        recent(panel, ui);
                    }
                    if ends_section(&action.command) {
                        ui.separator();
                    }
                }
            });
        }
    });
}

fn item(panel: &mut Panel<'_>, ui: &mut Ui, action: &Action) {
    let keys = action.shortcut.map_or_else(String::new, |keys| keys_in_words(ui.ctx(), &keys));
    let button = Button::new(action.name.as_str()).shortcut_text(keys).selected(action.on == Some(true));
    if ui.add_enabled((panel.can)(action), button).clicked() {
        panel.ask(action.command.clone());
        ui.close();
    }
}

fn recent(panel: &mut Panel<'_>, ui: &mut Ui) {
    let settings = &panel.state.settings;
    let presets = settings.recent_presets.iter().map(|path| (path, Command::OpenPreset(Some(path.clone()))));
    let meshes = settings.recent_meshes.iter().map(|path| (path, Command::OpenMesh(Some(path.clone()))));
    let files: Vec<_> = presets.chain(meshes).map(|(path, command)| (path.clone(), command)).collect();
    ui.add_enabled_ui(!files.is_empty(), |ui| {
        ui.menu_button("Recent files", |ui| {
            for (path, command) in files {
                let name = path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
                if ui.button(name).on_hover_text(path.display().to_string()).clicked() {
                    panel.ask(command);
                    ui.close();
                }
            }
        });
    });
}

/// Whether a line follows in the menu.
fn ends_section(command: &Command) -> bool {
    use crate::app::state::Tool;
    matches!(
        command,
        Command::OpenMesh(None)
            | Command::Revert
            | Command::SaveTurntable(_)
            | Command::SaveGuides(_)
            | Command::RedoView
            | Command::ResetLayout
            | Command::SetTool(Tool::Guide | Tool::Navigate)
    )
}
