//! The switches over the view.

use egui::Ui;

use super::super::Panel;
use super::super::number::named;
use crate::app::actions::{debug_label, mapping_label, method_label};
use crate::app::command::Command;
use crate::app::state::{Compare, Look, Motion, PresetSource, Tool};
use crate::params::DebugView;
use crate::{Inspect, Mapping, Method};

/// Methods and mappings as switches, and what else is at hand.
pub(super) fn toolbar(panel: &mut Panel<'_>, ui: &mut Ui) {
    let look = &panel.state.document.look;
    let (params, inspect) = (look.params, panel.state.document.inspect);
    let mut asked = Vec::new();
    let mut set = |change: &dyn Fn(&mut crate::RenderParams)| {
        let mut look: Look = look.clone();
        change(&mut look.params);
        asked.push(Command::SetLook(Box::new(look)));
    };
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        for (number, method) in Method::ALL.into_iter().enumerate() {
            let button = ui.selectable_label(params.method == method, short_method(method));
            if button.on_hover_text(format!("{} ({})", method_label(method), number + 1)).clicked() {
                set(&|params| params.method = method);
            }
        }
        ui.separator();
        ui.add_enabled_ui(params.method.takes_mapping(), |ui| {
            let combo = egui::ComboBox::from_id_salt("mapping").selected_text(mapping_label(params.mapping));
            let shown = combo.width(128.0).show_ui(ui, |ui| {
                for (number, mapping) in Mapping::ALL.into_iter().enumerate() {
                    let text = format!("{}   Alt+{}", mapping_label(mapping), number + 1);
                    if ui.selectable_label(params.mapping == mapping, text).clicked() {
                        set(&|params| params.mapping = mapping);
                    }
                }
            });
            named(shown.response, "Mapping").on_hover_text("How strokes lie on the surface");
        });
        let combo = egui::ComboBox::from_id_salt("inspect");
        let combo = combo.selected_text(inspect.debug.map_or("Inspect", debug_label)).width(96.0);
        let shown = combo.show_ui(ui, |ui| {
            if ui.selectable_label(inspect.debug.is_none(), "The picture").clicked() {
                panel.ask(Command::SetInspect(Inspect { debug: None, ..inspect }));
            }
            for view in DebugView::ALL {
                let entry = ui.selectable_label(inspect.debug == Some(view), debug_label(view));
                if entry.on_hover_text(view.description()).clicked() {
                    panel.ask(Command::SetInspect(Inspect { debug: Some(view), ..inspect }));
                }
            }
        });
        named(shown.response, "Inspect").on_hover_text("Show what the shader decides instead of strokes");
    });
    panel.commands.append(&mut asked);
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        compare_controls(panel, ui);
        ui.separator();
        play_controls(panel, ui);
        ui.separator();
        let guiding = panel.state.transient.tool == Tool::Guide;
        let button = ui.selectable_label(guiding, "Guides");
        if button.on_hover_text("Draw strokes on the mesh that the others follow (G)").clicked() {
            panel.ask(Command::SetTool(if guiding { Tool::Navigate } else { Tool::Guide }));
        }
        let wired = inspect.wireframe.is_some();
        if ui.selectable_label(wired, "Wires").on_hover_text("Show the triangles' edges (W)").clicked() {
            panel.ask(Command::SetInspect(Inspect { wireframe: (!wired).then_some(1.0), ..inspect }));
        }
        if ui.button("Whole").on_hover_text("Show the whole mesh (F)").clicked() {
            panel.ask(Command::FrameMesh);
        }
    });
    ui.add_space(2.0);
}

pub(super) fn short_method(method: Method) -> &'static str {
    match method {
        Method::Phong => "Phong",
        Method::SixWay => "Six-way",
        Method::FaceFrame => "Face frames",
        Method::StrokeMap => "Stroke map",
        Method::Halftone => "Halftone",
        Method::FineTone => "Fine tones",
        Method::Stripes => "Stripes",
    }
}

fn compare_controls(panel: &mut Panel<'_>, ui: &mut Ui) {
    let compare = panel.state.document.compare.clone();
    let button = ui.selectable_label(compare.is_some(), "A | B");
    if button.on_hover_text("Wipe between two methods or presets (C)").clicked() {
        let started = Compare { look: panel.state.document.look.clone(), preset: None, split: 0.5 };
        let mut started = Box::new(started);
        started.look.params.method =
            if started.look.params.method == Method::Stripes { Method::SixWay } else { Method::Stripes };
        panel.ask(Command::SetCompare(compare.is_none().then_some(started)));
    }
    let Some(mut compare) = compare else { return };
    let before = compare.clone();
    let combo = egui::ComboBox::from_id_salt("other method").selected_text(short_method(compare.look.params.method));
    let shown = combo.width(86.0).show_ui(ui, |ui| {
        for method in Method::ALL {
            ui.selectable_value(&mut compare.look.params.method, method, method_label(method));
        }
    });
    named(shown.response, "Method of B");
    if compare.look.params.method.takes_mapping() {
        let combo =
            egui::ComboBox::from_id_salt("other mapping").selected_text(mapping_label(compare.look.params.mapping));
        let shown = combo.width(96.0).show_ui(ui, |ui| {
            for mapping in Mapping::ALL {
                ui.selectable_value(&mut compare.look.params.mapping, mapping, mapping_label(mapping));
            }
        });
        named(shown.response, "Mapping of B");
    }
    let name = compare.preset.as_ref().map_or("same preset", |(name, _)| name.as_str()).to_owned();
    let shown = egui::ComboBox::from_id_salt("other preset").selected_text(name).width(96.0).show_ui(ui, |ui| {
        if ui.selectable_label(compare.preset.is_none(), "same preset").clicked() {
            compare.preset = None;
        }
        for (name, _) in tam_gen::Preset::embedded() {
            let chosen = compare.preset.as_ref().is_some_and(|(other, _)| other == name);
            if ui.selectable_label(chosen, *name).clicked()
                && let Some(Ok(preset)) = tam_gen::Preset::named(name)
            {
                compare.preset = Some(((*name).to_owned(), preset));
            }
        }
        for path in &panel.state.settings.recent_presets {
            let name = PresetSource::File(path.clone()).name();
            let chosen = compare.preset.as_ref().is_some_and(|(other, _)| *other == name);
            if ui.selectable_label(chosen, &name).on_hover_text(path.display().to_string()).clicked() {
                match tam_gen::Preset::load(path) {
                    Ok(preset) => compare.preset = Some((name, preset)),
                    // What is wrong with it is told where it is opened.
                    Err(_) => panel.commands.push(Command::OpenPreset(Some(path.clone()))),
                }
            }
        }
    });
    named(shown.response, "Preset of B");
    if compare != before {
        panel.ask(Command::SetCompare(Some(Box::new(compare))));
    }
}

fn play_controls(panel: &mut Panel<'_>, ui: &mut Ui) {
    use crate::mesh::deform::Deform;
    let playing = panel.state.transient.motion;
    let button = ui.selectable_label(playing.is_some(), if playing.is_some() { "⏸" } else { "▶" });
    if named(button, "Play").on_hover_text("Play or stop (Space)").clicked() {
        panel.ask(Command::Play(if playing.is_some() { None } else { Some(Motion::Orbit) }));
    }
    let label = |motion: Motion| match motion {
        Motion::Orbit => "Camera".to_owned(),
        Motion::Light => "Light".to_owned(),
        Motion::Animation => "Animation".to_owned(),
        Motion::Deform(deform) => {
            let name = deform.name();
            name[..1].to_uppercase() + &name[1..]
        }
    };
    let shown = egui::ComboBox::from_id_salt("motion")
        .selected_text(playing.map_or_else(|| "Turntable".to_owned(), label))
        .width(84.0)
        .show_ui(ui, |ui| {
            let animated = panel.results.mesh.as_ref().is_some_and(|mesh| mesh.mesh.animation.is_some());
            let motions = [Motion::Orbit, Motion::Light].into_iter().chain(Deform::ALL.map(Motion::Deform));
            for motion in motions.chain(animated.then_some(Motion::Animation)) {
                if ui.selectable_label(playing == Some(motion), label(motion)).clicked() {
                    panel.commands.push(Command::Play(Some(motion)));
                }
            }
        });
    named(shown.response, "What plays");
}
