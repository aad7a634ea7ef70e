//! The line at the bottom: what things cost, and whether all holds.

use egui::{RichText, Ui};
use tam_gen::checks::Verdict;

use super::Panel;
use super::checks::colour;
use crate::app::command::Command;
use crate::app::layout::Pane;
use crate::app::words;

/// The status line.
pub(crate) fn status_bar(panel: &mut Panel<'_>, ui: &mut Ui) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 14.0;
        let results = panel.results;
        match (&results.map_problem, &results.map) {
            (Some(problem), _) => {
                let text = RichText::new("The preset makes no map").color(colour(ui, &Verdict::Fail));
                if ui.add(egui::Button::new(text).frame(false)).on_hover_text(problem).clicked() {
                    panel.ask(Command::ShowPane(Pane::Strokes));
                }
            }
            (None, Some(made)) => {
                let size = made.map.grid.levels.first().map_or(0, |level| level.size);
                let draft = if made.draft { " draft" } else { "" };
                ui.label(format!("Map {size} px{draft} in {}", words::duration(made.took)))
                    .on_hover_text("Time to generate the whole map");
                ui.label(format!("Tone error {:.1e}", made.tone_error))
                    .on_hover_text("Greatest difference of a cell's mean from its tone");
            }
            (None, None) => {
                ui.weak("Making the map…");
            }
        }
        verdict(panel, ui);
        match &panel.results.picture {
            Some(shown) => {
                let adapter = panel.results.adapter.as_deref().unwrap_or("");
                let whole = panel.results.to_screen.unwrap_or(shown.cost);
                ui.label(format!("Frame {}", words::duration(whole))).on_hover_text(format!(
                    "Time from beginning a picture to having it on the screen; {} of it on the device: {adapter}",
                    words::duration(shown.cost)
                ));
            }
            None => {
                ui.weak("Frame –");
            }
        }
        if let Some((what, part)) = panel.results.writing.clone() {
            ui.add(egui::ProgressBar::new(part).desired_width(120.0).text(what));
            if ui.small_button("Stop").clicked() {
                panel.ask(Command::Cancel);
            }
        }
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            if let Some(adapter) = &panel.results.adapter {
                ui.add(egui::Label::new(RichText::new(adapter).weak().small()).truncate());
            }
        });
    });
}

fn verdict(panel: &mut Panel<'_>, ui: &mut Ui) {
    let Some(report) = panel.results.current_report() else {
        ui.weak("Checking…");
        return;
    };
    let failing = report.failing();
    let (text, verdict) = match failing.len() {
        0 => ("✔ Constraints hold".to_owned(), Verdict::Pass),
        1 => (format!("✖ {} fails", failing[0].title()), Verdict::Fail),
        count => (format!("✖ {count} constraints fail"), Verdict::Fail),
    };
    let button = egui::Button::new(RichText::new(text).color(colour(ui, &verdict))).frame(false);
    if ui.add(button).on_hover_text("See the checks").clicked() {
        panel.ask(Command::ShowPane(Pane::Checks));
    }
}
