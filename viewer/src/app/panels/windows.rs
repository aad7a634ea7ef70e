//! Questions and lists over the window.

use egui::{Context, Id, Key, Modal, RichText, Ui};

use super::Panel;
use super::palette;
use crate::app::actions::{Action, Group, keys_in_words};
use crate::app::command::Command;
use crate::app::state::{Dialog, Navigation};

/// Draws what lies over the window.
pub(crate) fn dialogs(panel: &mut Panel<'_>, ctx: &Context, actions: &[Action]) {
    let Some(dialog) = panel.state.transient.dialog.clone() else { return };
    let modal = Modal::new(Id::unique("dialog"));
    let shown = modal.show(ctx, |ui| match &dialog {
        Dialog::Help => help(panel, ui, actions),
        Dialog::Palette(typed) => palette::show(panel, ui, typed, actions),
        Dialog::Unsaved(then) => unsaved(panel, ui, then),
        Dialog::About => about(panel, ui),
        Dialog::Replace(path, save) => {
            ui.set_max_width(380.0);
            ui.heading("Replace the file?");
            ui.label(format!("{} is there already.", path.display()));
            ui.horizontal(|ui| {
                if ui.button("Replace").clicked() {
                    panel.ask(Command::Replace(save.clone()));
                }
                if ui.button("Cancel").clicked() {
                    panel.ask(Command::ShowDialog(None));
                }
            });
        }
        Dialog::ChangedOnDisk(path) => {
            ui.heading("The preset was changed by another program");
            ui.label(format!("{} is newer than what is open here, which has changes of its own.", path.display()));
            ui.horizontal(|ui| {
                if ui.button("Read the file").clicked() {
                    panel.ask(Command::Reload);
                }
                if ui.button("Keep mine").clicked() {
                    panel.ask(Command::ShowDialog(None));
                }
            });
        }
    });
    if shown.should_close() {
        panel.ask(Command::ShowDialog(None));
    }
}

fn unsaved(panel: &mut Panel<'_>, ui: &mut Ui, then: &Command) {
    ui.set_max_width(380.0);
    ui.heading("Unsaved changes");
    ui.add_space(4.0);
    ui.label(format!("“{}” has changes that are not saved.", panel.state.preset_name()));
    ui.add_space(8.0);
    ui.horizontal(|ui| {
        if ui.button("Save").clicked() {
            panel.ask(Command::ShowDialog(None));
            panel.ask(Command::Save);
            // Where a place was to be asked for, the rest waits until there is one.
            if panel.state.document.source.file().is_some() {
                panel.ask(then.clone());
            }
        }
        if ui.button("Discard").clicked() {
            panel.ask(Command::Discard(Box::new(then.clone())));
        }
        if ui.button("Cancel").clicked() {
            panel.ask(Command::ShowDialog(None));
        }
    });
}

fn about(panel: &mut Panel<'_>, ui: &mut Ui) {
    ui.set_max_width(420.0);
    ui.heading(format!("tam-viewer {}", env!("CARGO_PKG_VERSION")));
    ui.label("Tonal art maps: strokes that keep their tone on any form and at any distance.");
    ui.add_space(6.0);
    for paper in [
        "Praun, Hoppe, Webb, Finkelstein: Real-Time Hatching (2001)",
        "Freudenberg, Masuch, Strothotte: Real-time stroke textures (2001)",
        "Webb, Praun, Finkelstein, Hoppe: Fine tone control in hardware hatching (2002)",
        "Suarez, Belhadj, Boyer: GPU real-time hatching (2013)",
        "Knöppel, Crane, Pinkall, Schröder: Stripe patterns on surfaces (2015)",
    ] {
        ui.label(RichText::new(format!("· {paper}")).small());
    }
    ui.add_space(6.0);
    if let Some(adapter) = &panel.results.adapter {
        ui.weak(adapter);
    }
    ui.weak("MIT or Apache-2.0");
    if ui.button("Close").clicked() {
        panel.ask(Command::ShowDialog(None));
    }
}

fn help(panel: &mut Panel<'_>, ui: &mut Ui, actions: &[Action]) {
    ui.heading("Keyboard and mouse");
    let height = ui.ctx().content_rect().height() * 0.72;
    egui::ScrollArea::vertical().max_height(height).show(ui, |ui| {
        ui.horizontal_top(|ui| {
            let columns: [&[Group]; 3] = [
                &[Group::File, Group::Edit],
                &[Group::Method, Group::Mapping],
                &[Group::View, Group::Light, Group::Window, Group::Help],
            ];
            for groups in columns {
                ui.vertical(|ui| {
                    for group in groups {
                        keys_of(ui, *group, actions);
                    }
                });
                ui.add_space(14.0);
            }
        });
        ui.strong("Mouse in the view");
        ui.label(panel.state.settings.navigation.describe());
        ui.label("Right drag, or the sun: moves the light.");
        if panel.state.settings.navigation == Navigation::Simple {
            ui.label("In the Blender and Maya schemes Shift + left drag moves the light too.");
        }
        ui.strong("Files");
        ui.label("Drop presets (.toml), meshes (.obj .gltf .glb .ply .stl) or guides (.json) onto the window.");
    });
    if ui.button("Close").clicked() || ui.input(|input| input.key_pressed(Key::F1)) {
        panel.ask(Command::ShowDialog(None));
    }
}

fn keys_of(ui: &mut Ui, group: Group, actions: &[Action]) {
    let with_keys: Vec<_> = actions
        .iter()
        .filter(|action| action.group == group)
        .filter_map(|action| Some((action, action.shortcut?)))
        .collect();
    if with_keys.is_empty() {
        return;
    }
    ui.strong(group.title());
    egui::Grid::new(group.title()).spacing([12.0, 2.0]).show(ui, |ui| {
        for (action, keys) in with_keys {
            ui.label(&action.name);
            ui.label(RichText::new(keys_in_words(ui.ctx(), &keys)).monospace().weak());
            ui.end_row();
        }
    });
    ui.add_space(6.0);
}
