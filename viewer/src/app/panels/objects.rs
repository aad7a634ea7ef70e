//! The objects of the scene: which there are, which is chosen, where it stands, and its parts.

use egui::Ui;
use glam::DVec3;

use super::Panel;
use super::number::{self, Number};
use super::strokes::section;
use crate::app::command::Command;
use crate::app::state::{MeshSource, Standing};
use crate::mesh::sample::Sample;
use crate::ranges;
use crate::scene::Material;
use crate::scene_file::{Place, part_name};
use crate::{Scene, app::words::counted};

/// Rows of the list before it scrolls.
const ROWS: f32 = 8.0;

/// The list of all objects; the chosen one is what the other panels show.
pub(super) fn list(panel: &mut Panel<'_>, ui: &mut Ui) {
    let document = &panel.state.document;
    let chosen = document.chosen();
    let rows: Vec<(String, Standing)> =
        document.objects().map(|object| (object.name(), object.standing.clone())).collect();
    let only = rows.len() == 1;
    let mut asked: Vec<Command> = Vec::new();
    let height = ui.spacing().interact_size.y + ui.spacing().item_spacing.y;
    egui::ScrollArea::vertical().id_salt("objects").max_height(height * ROWS).auto_shrink([false, true]).show_rows(
        ui,
        ui.spacing().interact_size.y,
        rows.len(),
        |ui, range| {
            for index in range {
                let (name, standing) = &rows[index];
                ui.horizontal(|ui| {
                    let mut visible = standing.visible;
                    let eye = ui.checkbox(&mut visible, "").on_hover_text("Whether it is drawn");
                    if number::named(eye, &format!("Show {name}")).changed() {
                        let standing = Standing { visible, ..standing.clone() };
                        asked.push(Command::SetStanding(index, Box::new(standing)));
                    }
                    let text = egui::RichText::new(name);
                    let text = if visible { text } else { text.weak() };
                    let row = ui.selectable_label(index == chosen, text);
                    if number::named(row, &format!("Object {}: {name}", index + 1)).clicked() {
                        asked.push(Command::Choose(index));
                    }
                });
            }
        },
    );
    ui.horizontal(|ui| {
        ui.menu_button("Add…", |ui| {
            for sample in Sample::ALL {
                if ui.button(sample.name()).on_hover_text(sample.description()).clicked() {
                    asked.push(Command::AddObject(Some(MeshSource::sample(sample))));
                }
            }
            ui.separator();
            if ui.button("From a file…").clicked() {
                asked.push(Command::AddObject(None));
            }
        })
        .response
        .on_hover_text("Another object");
        if ui.button("Duplicate").on_hover_text("The chosen object once more, beside it").clicked() {
            asked.push(Command::DuplicateObject);
        }
        if ui.add_enabled(!only, egui::Button::new("Remove")).on_hover_text("Take the chosen object away").clicked() {
            asked.push(Command::RemoveObject(chosen));
        }
    });
    panel.commands.extend(asked);
}

/// Name and place of the chosen object.
pub(super) fn standing(panel: &mut Panel<'_>, ui: &mut Ui) {
    let document = &panel.state.document;
    let before = &document.standing;
    let mut standing = before.clone();
    let shown = document.object(document.chosen()).name();
    ui.horizontal(|ui| {
        let label = number::name(ui, "Name", "What the object is called");
        ui.add(
            egui::TextEdit::singleline(&mut standing.name)
                .hint_text(shown)
                .desired_width(ui.available_width().min(160.0)),
        )
        .labelled_by(label.id);
    });
    let place = &mut standing.place;
    number::axes(ui, "Place", "In world units; meshes are 2 units long", ranges::COORDINATE, &mut place.translation);
    let turn = Number {
        name: "Turn about y",
        doc: "About the upright axis, as the camera's azimuth is counted",
        unit: "degrees",
        min: -180.0,
        max: 180.0,
        default: 0.0,
        whole: false,
    };
    number::row(ui, turn, &mut place.turn_deg);
    let size =
        Number { name: "Size", doc: "Factor of all axes", unit: "", min: 0.05, max: 5.0, default: 1.0, whole: false };
    number::row(ui, size, &mut place.scale);
    number::axes(ui, "Stretch", "Factors along the mesh's own axes", ranges::SCALE, &mut standing.stretch);
    let plain = Standing { place: Place::default(), stretch: DVec3::ONE, ..standing.clone() };
    if ui.add_enabled(plain != standing, egui::Button::new("Back to the middle")).clicked() {
        standing = plain;
    }
    if standing != *before {
        panel.ask(Command::SetStanding(panel.state.document.chosen(), Box::new(standing)));
    }
}

/// Parts of the chosen object's mesh, each with its material.
pub(super) fn parts(panel: &mut Panel<'_>, ui: &mut Ui) {
    let Some(mesh) = panel.results.mesh.clone() else { return };
    let document = &panel.state.document;
    let mut materials: Vec<Material> = Scene::of(&mesh.mesh).materials;
    for (own, set) in materials.iter_mut().zip(&document.materials) {
        *own = set.clone();
    }
    let before = materials.clone();
    let mut standing = document.standing.clone();
    ui.label(egui::RichText::new(counted(before.len(), "part")).weak().small());
    for (index, (material, part)) in materials.iter_mut().zip(&mesh.mesh.parts).enumerate() {
        let name = if part.name.is_empty() { format!("Part {}", index + 1) } else { part.name.clone() };
        ui.push_id(index, |ui| {
            section(ui, &name, before.len() == 1, |ui| {
                if before.len() > 1 {
                    visibility(ui, &name, &part_name(index, &mesh.mesh.parts), &mut standing);
                }
                material_rows(ui, &name, material);
            });
        });
    }
    if materials != before {
        panel.ask(Command::SetMaterials(materials));
    }
    if standing != panel.state.document.standing {
        panel.ask(Command::SetStanding(panel.state.document.chosen(), Box::new(standing)));
    }
}

fn visibility(ui: &mut Ui, name: &str, key: &str, standing: &mut Standing) {
    let entry = standing.parts.get(key);
    let mut visible = entry.is_none_or(|entry| entry.look.is_visible());
    if number::named(ui.checkbox(&mut visible, "Drawn"), &format!("Draw {name}")).changed() {
        let entry = standing.parts.entry(key.to_owned()).or_default();
        entry.look.visible = (!visible).then_some(false);
        if *entry == crate::scene_file::PartEntry::default() {
            standing.parts.remove(key);
        }
    }
}

fn material_rows(ui: &mut Ui, name: &str, material: &mut Material) {
    let default = Material::default();
    ui.horizontal(|ui| {
        let label = number::name(ui, "Colour", &format!("Under the strokes of {name}"));
        ui.color_edit_button_rgb(&mut material.colour).labelled_by(label.id);
    });
    let plain = |name, doc, min, max, default| Number { name, doc, unit: "", min, max, default, whole: false };
    number::row(
        ui,
        plain("Ambient", "Share of the ambient light that is seen", 0.0, 1.0, default.ambient),
        &mut material.ambient,
    );
    number::row(ui, plain("Diffuse", "Diffuse reflectance", 0.0, 1.0, default.diffuse), &mut material.diffuse);
    number::row(
        ui,
        plain("Highlight", "Strength of the highlight", 0.0, 1.0, default.specular),
        &mut material.specular,
    );
    number::row(
        ui,
        plain("Shininess", "How small the highlight is", 1.0, 200.0, default.shininess),
        &mut material.shininess,
    );
    let turn = Number {
        name: "Turn",
        doc: "Strokes turned about the normal",
        unit: "degrees",
        min: -180.0,
        max: 180.0,
        default: 0.0,
        whole: false,
    };
    number::row(ui, turn, &mut material.rotation_deg);
    number::row(
        ui,
        plain("Scale", "Repeats of the tile, relative to the others", 0.1, 8.0, default.scale),
        &mut material.scale,
    );
}
