//! The constraints.

use egui::{Color32, RichText, Ui};
use tam_gen::checks::{CellFinding, Finding, Verdict};

use super::Panel;
use crate::app::command::Command;
use crate::app::layout::Pane;
use crate::app::state::{CellView, MapTab};

/// Colours of a verdict, legible on light and dark.
pub(super) fn colour(ui: &Ui, verdict: &Verdict) -> Color32 {
    let dark = ui.visuals().dark_mode;
    match (verdict, dark) {
        (Verdict::Pass, true) => Color32::from_rgb(110, 200, 120),
        (Verdict::Pass, false) => Color32::from_rgb(20, 120, 50),
        (Verdict::Fail, true) => Color32::from_rgb(245, 110, 100),
        (Verdict::Fail, false) => Color32::from_rgb(190, 30, 30),
        (Verdict::NotJudged { .. }, _) => ui.visuals().weak_text_color(),
    }
}

pub(super) fn show(panel: &mut Panel<'_>, ui: &mut Ui) {
    let Some((_, report)) = panel.results.report.clone() else {
        ui.centered_and_justified(|ui| ui.weak("The map is being checked."));
        return;
    };
    let current = panel.results.current_report().is_some();
    let failing = report.failing().len();
    ui.horizontal(|ui| {
        if !current {
            ui.weak("Checking the new map…");
        } else if failing == 0 {
            ui.colored_label(
                colour(ui, &Verdict::Pass),
                RichText::new("Every constraint that can be judged holds.").strong(),
            );
        } else {
            let plural = if failing == 1 { "constraint fails" } else { "constraints fail" };
            ui.colored_label(colour(ui, &Verdict::Fail), RichText::new(format!("{failing} {plural}.")).strong());
            ui.weak("Click one to see where.");
        }
    });
    ui.add_space(4.0);
    egui::ScrollArea::both().auto_shrink(false).show(ui, |ui| {
        egui::Grid::new("constraints").num_columns(5).striped(true).spacing([14.0, 5.0]).show(ui, |ui| {
            for head in ["", "Constraint", "Measured", "Limit", "Where it is worst"] {
                ui.label(RichText::new(head).small().weak());
            }
            ui.end_row();
            for finding in &report.findings {
                row(panel, ui, finding);
            }
        });
    });
}

fn row(panel: &mut Panel<'_>, ui: &mut Ui, finding: &Finding) {
    let tint = colour(ui, &finding.verdict);
    let mark = match finding.verdict {
        Verdict::Pass => "✔",
        Verdict::Fail => "✖",
        Verdict::NotJudged { .. } => "–",
    };
    ui.colored_label(tint, mark).on_hover_text(finding.verdict.word());
    let title = RichText::new(finding.constraint.title()).color(tint);
    let response = ui.add(egui::Button::new(title).frame(false));
    if response.on_hover_text(finding.constraint.definition()).clicked() {
        show_worst(panel, finding);
    }
    let judged = !matches!(finding.verdict, Verdict::NotJudged { .. });
    let unit = if finding.unit.is_empty() { String::new() } else { format!(" {}", finding.unit) };
    ui.label(if judged { format!("{}{unit}", number(finding.measured)) } else { "–".to_owned() });
    ui.label(if judged { format!("{}{unit}", finding.limit) } else { "–".to_owned() });
    ui.add(egui::Label::new(RichText::new(finding.explanation()).weak()).extend());
    ui.end_row();
}

/// Takes the user to the cell, and to a texel that offends where there is one.
fn show_worst(panel: &mut Panel<'_>, finding: &Finding) {
    let excess = |cell: &&CellFinding| cell.limit.excess(cell.measured);
    let worst = finding.cells.iter().max_by(|a, b| excess(a).total_cmp(&excess(b)));
    let Some(worst) = worst else { return };
    let texel = worst.texels.get(worst.texels.len() / 2).copied();
    panel.ask(Command::ShowCell(CellView { tab: MapTab::Cell, level: worst.level, column: worst.column, texel }));
    panel.ask(Command::ShowPane(Pane::Map));
}

fn number(number: f64) -> String {
    match number.abs() {
        size if size < 1e-12 => "0".to_owned(),
        size if size < 1e-3 => format!("{number:.1e}"),
        size if size < 1.0 => format!("{number:.4}"),
        _ => format!("{number:.2}"),
    }
}
