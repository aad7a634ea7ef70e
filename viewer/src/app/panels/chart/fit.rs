//! The least that the scene needs: what is asked for, and what was found.

use egui::{RichText, Ui};

use super::super::Panel;
use super::super::number::{self, Number};
use super::{capitalised, column};
use crate::app::actions::{mapping_label, method_label};
use crate::app::command::Command;
use crate::app::state::{FitSettings, Look};
use crate::app::words;
use crate::app::work::FittedScene;
use crate::fit::Tried;
use crate::{Mapping, Method, ranges};

/// Width of what is asked for, in points.
const ASKED_WIDTH: f32 = 330.0;

/// Width from which it stands beside what was found, in points.
const WIDE: f32 = 620.0;

/// Errors beyond this are seen by anyone; what is greater is for the command line.
const MOST_ERROR: f64 = 0.2;

/// What fails is listed up to so many ways.
const FAILING: usize = 8;

pub(super) fn show(panel: &mut Panel<'_>, ui: &mut Ui) {
    if ui.available_width() < WIDE {
        egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            asked(panel, ui);
            ui.separator();
            found(panel, ui);
        });
        return;
    }
    let size = ui.available_size();
    ui.horizontal_top(|ui| {
        let gap = ui.spacing().item_spacing.x;
        column(ui, ASKED_WIDTH, |ui| {
            egui::ScrollArea::vertical().id_salt("asked").auto_shrink(false).show(ui, |ui| asked(panel, ui));
        });
        column(ui, size.x - ASKED_WIDTH - gap, |ui| {
            egui::ScrollArea::both().id_salt("found").auto_shrink(false).show(ui, |ui| found(panel, ui));
        });
    });
}

/// Begins, shows how far it is, and stops.
pub(super) fn controls(panel: &mut Panel<'_>, ui: &mut Ui) {
    let results = panel.results;
    let Some(part) = results.fit.progress else {
        let ready = results.map.is_some() && results.mesh.is_some();
        let button = egui::Button::new(RichText::new("Fit to this scene").strong());
        let doc = "Finds the cheapest method, mapping and map that keep the tone, by drawing and measuring them";
        if ui.add_enabled(ready, button).on_hover_text(doc).clicked() {
            panel.ask(Command::Fit);
        }
        return;
    };
    ui.add(egui::ProgressBar::new(part).desired_width(140.0).desired_height(10.0));
    if ui.button("Stop fitting").clicked() {
        panel.ask(Command::CancelFit);
    }
    ui.weak("drawn and measured in every view of the range");
}

fn asked(panel: &mut Panel<'_>, ui: &mut Ui) {
    let mut settings = panel.state.settings.fit.clone();
    let default = FitSettings::default();
    let doc = "Of the camera, as multiples of the present one";
    number::range_row(
        ui,
        Number::view("Distance", doc, ranges::FIT_DISTANCE, 1.0),
        default.distance,
        &mut settings.distance,
    );
    let doc = "Turns of the camera about the upright axis, from the present one";
    let turns = |name, doc| Number::view(name, doc, ranges::FIT_TURN_DEG, 0.0);
    number::range_row(ui, turns("Camera turns", doc), default.orbit_deg, &mut settings.orbit_deg);
    let doc = "Turns of all lights about the upright axis, from where they are";
    number::range_row(ui, turns("Light turns", doc), default.light_deg, &mut settings.light_deg);
    let doc = "Greatest root mean square error of tone in any view, in linear ink";
    let error = Number::view("Error at most", doc, ranges::FIT_ERROR, default.error).between(0.0, MOST_ERROR);
    number::row(ui, error, &mut settings.error);
    let params = panel.state.document.look.params;
    ui.weak("May take the place of the present way:");
    ui.horizontal_wrapped(|ui| {
        let has_map = |method: &Method| *method != Method::Phong;
        for method in Method::ALL.into_iter().filter(has_map) {
            tick(ui, &mut settings.methods, method, params.method, method_label(method));
        }
    });
    ui.horizontal_wrapped(|ui| {
        let has_uv = panel.results.mesh.as_ref().is_some_and(|mesh| !mesh.mesh.uvs.is_empty());
        for mapping in Mapping::ALL.into_iter().filter(|mapping| has_uv || *mapping != Mapping::Uv) {
            tick(ui, &mut settings.mappings, mapping, params.mapping, mapping_label(mapping));
        }
    });
    if settings != panel.state.settings.fit {
        panel.ask(Command::SetFit(settings));
    }
}

/// A tick box for one of many; the present one is tried in any case.
fn tick<T: PartialEq>(ui: &mut Ui, chosen: &mut Vec<T>, one: T, present: T, label: &str) {
    let is_present = one == present;
    let mut on = is_present || chosen.contains(&one);
    let response = ui.add_enabled(!is_present, egui::Checkbox::new(&mut on, label));
    let response = response.on_disabled_hover_text("The present one is tried in any case");
    if response.changed() {
        chosen.retain(|other| *other != one);
        if on {
            chosen.push(one);
        }
    }
}

fn found(panel: &mut Panel<'_>, ui: &mut Ui) {
    let results = panel.results;
    match &results.fit.outcome {
        None if results.fit.progress.is_some() => {
            ui.weak("What holds and what fails is listed here when it is done.");
        }
        None => {
            ui.weak("Finds the cheapest method, mapping and map that keep the tone, by drawing and measuring them.");
            ui.weak("Choose how near and how far the scene is seen and how far tones may be off, then fit.");
        }
        Some(Err(problem)) => {
            let text = RichText::new(capitalised(problem)).color(ui.visuals().error_fg_color);
            ui.add(egui::Label::new(text).wrap());
        }
        Some(Ok(fitted)) => {
            if !results.fit.is_current {
                ui.weak("The scene or what is asked for has changed since; fit again to be sure.");
            }
            let [memory, frame] = fitted.fit.saved_percent();
            ui.horizontal_wrapped(|ui| {
                ui.strong(saved(memory, frame));
                let ready = results.fit.progress.is_none();
                let button = ui.add_enabled(ready, egui::Button::new("Use it"));
                if button.on_hover_text("Take the smaller map and the way to draw; one step to undo").clicked() {
                    use_it(panel, fitted);
                }
            });
            let now = &fitted.fit.full.worst;
            if now.error > fitted.asked().error {
                ui.weak(format!("The present way errs by {:.4} at {}: more than is allowed.", now.error, now.view));
            }
            table(ui, fitted);
        }
    }
}

/// `Saves 40 % of the memory and 5 % of the frame.`
fn saved(memory: f64, frame: f64) -> String {
    let part = |percent: f64, what: &str| format!("{:.0} % of the {what}", percent.round().abs());
    let [memory_part, frame_part] = [part(memory, "memory"), part(frame, "frame")];
    // What rounds to nothing is neither saved nor added.
    match (memory.round() >= 0.0, frame.round() >= 0.0) {
        (true, true) => format!("Saves {memory_part} and {frame_part}."),
        (true, false) => format!("Saves {memory_part}, and adds {frame_part}."),
        (false, true) => format!("Saves {frame_part}, and adds {memory_part}."),
        (false, false) => format!("Adds {memory_part} and {frame_part}."),
    }
}

fn table(ui: &mut Ui, fitted: &FittedScene) {
    let fit = &fitted.fit;
    egui::Grid::new("fitted").num_columns(6).striped(true).spacing([12.0, 3.0]).show(ui, |ui| {
        for head in ["", "Way and map", "Memory", "Cost", "Error", "Worst at"] {
            ui.label(RichText::new(head).small().weak());
        }
        ui.end_row();
        row(ui, "now", &fit.full, false);
        row(ui, "fitted", &fit.best, false);
        for tried in fit.failing.iter().take(FAILING) {
            row(ui, "fails", tried, true);
        }
    });
    let left = fit.failing.len().saturating_sub(FAILING);
    if left > 0 {
        ui.weak(format!("and {left} more that fail"));
    }
    if fit.failing.is_empty() {
        ui.weak("Nothing cheaper was left to try.");
    }
    let [width, height] = fitted.size_px;
    ui.weak(format!(
        "Holds in {}, drawn {width} × {height} px large; took {}.",
        words::counted(fit.views, "view"),
        words::duration(fitted.took)
    ));
}

fn row(ui: &mut Ui, title: &str, tried: &Tried, fails: bool) {
    let dress = |text: String| {
        let text = RichText::new(text);
        if fails { text.weak() } else { text }
    };
    let (error, view) = match &tried.missed {
        Some(missed) => (format!("levels missed: {:.4}", missed.error), &missed.view),
        None => (format!("{:.4}", tried.worst.error), &tried.worst.view),
    };
    ui.label(dress(title.to_owned()));
    ui.label(dress(tried.label()));
    ui.label(dress(words::bytes(tried.bytes)));
    ui.label(dress(format!("{:.2}x phong", tried.cost_ratio)));
    ui.label(dress(error));
    ui.label(dress(view.clone()));
    ui.end_row();
}

/// Takes the fitted map and way in one step.
fn use_it(panel: &mut Panel<'_>, fitted: &FittedScene) {
    let document = &panel.state.document;
    let best = &fitted.fit.best;
    let preset = best.map.map_or_else(|| document.preset.clone(), |map| map.preset(&document.preset));
    let look: Look = document.look.with_way(&best.params);
    panel.ask(Command::SetMaterial(Box::new(preset), Box::new(look)));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_saved_and_what_is_added_is_told_apart() {
        assert_eq!(saved(40.2, 4.8), "Saves 40 % of the memory and 5 % of the frame.");
        assert_eq!(saved(-201.0, 12.0), "Saves 12 % of the frame, and adds 201 % of the memory.");
        assert_eq!(saved(0.3, -5.0), "Saves 0 % of the memory, and adds 5 % of the frame.");
        assert_eq!(saved(-1.0, -5.0), "Adds 1 % of the memory and 5 % of the frame.");
    }
}
